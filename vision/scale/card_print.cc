// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Cards as SVG and PDF: both hold rectangles and text only, so they are written by hand.
#include <charconv>

#include "vision/photo/photo.h"
#include "vision/scale/card_drawing.h"

namespace bladecurve {
namespace {

constexpr double kPointsPerMm = 72 / kMmPerInch;

// Shortest text that reads back exactly, never with an exponent: PDF knows none.
std::string Number(double value) {
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed).ptr;
  return {buffer, end};
}

std::string Joined(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += Number(number) + " ";
  return text;
}

std::string XmlEscaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

std::string PdfEscaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '(' || c == ')' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string PdfContent(const CardDrawing& drawing) {
  std::string content = Number(kPointsPerMm) + " 0 0 " + Number(kPointsPerMm) + " 0 0 cm\n";
  for (const CardDrawing::Rectangle& r : drawing.rectangles) {
    content +=
        (r.black ? "0 g " : "1 g ") + Joined({r.x_mm, r.y_mm, r.width_mm, r.height_mm}) + "re f\n";
  }
  content += "0 g\n";
  for (const CardDrawing::Text& text : drawing.texts) {
    content += "BT /F1 " + Number(text.size_mm) + " Tf " +
               Joined({text.baseline_mm.x(), text.baseline_mm.y()}) + "Td (" +
               PdfEscaped(text.text) + ") Tj ET\n";
  }
  return content;
}

}  // namespace

std::string CardSvg(const CardDrawing& drawing) {
  const std::string width = Number(drawing.width_mm), height = Number(drawing.height_mm);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width +
                    "mm\" height=\"" + height + "mm\" viewBox=\"0 0 " + width + " " + height +
                    "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  for (const CardDrawing::Rectangle& r : drawing.rectangles) {
    svg += "<rect x=\"" + Number(r.x_mm) + "\" y=\"" +
           Number(drawing.height_mm - r.y_mm - r.height_mm) + "\" width=\"" + Number(r.width_mm) +
           "\" height=\"" + Number(r.height_mm) + "\" fill=\"" + (r.black ? "black" : "white") +
           "\"/>\n";
  }
  for (const CardDrawing::Text& text : drawing.texts) {
    svg += "<text x=\"" + Number(text.baseline_mm.x()) + "\" y=\"" +
           Number(drawing.height_mm - text.baseline_mm.y()) +
           "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"" + Number(text.size_mm) +
           "\">" + XmlEscaped(text.text) + "</text>\n";
  }
  return svg + "</svg>\n";
}

std::string CardPdf(const CardDrawing& drawing) {
  const std::string content = PdfContent(drawing);
  const std::string page_size =
      Joined({0, 0, drawing.width_mm * kPointsPerMm, drawing.height_mm * kPointsPerMm});
  const std::vector<std::string> objects = {
      // PrintScaling /None asks viewers not to fit the page.
      "<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>",
      "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      "<< /Type /Page /Parent 2 0 R /MediaBox [" + page_size +
          "] /Contents 4 0 R /Resources << /Font << /F1 5 0 R >> >> >>",
      "<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content + "endstream",
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"};
  std::string pdf = "%PDF-1.4\n";
  std::string table = "0000000000 65535 f \n";
  for (size_t i = 0; i < objects.size(); ++i) {
    const std::string offset = std::to_string(pdf.size());
    table += std::string(10 - offset.size(), '0') + offset + " 00000 n \n";
    pdf += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
  }
  const std::string count = std::to_string(objects.size() + 1);
  return pdf + "xref\n0 " + count + "\n" + table + "trailer\n<< /Size " + count +
         " /Root 1 0 R >>\nstartxref\n" + std::to_string(pdf.size()) + "\n%%EOF\n";
}

}  // namespace bladecurve
