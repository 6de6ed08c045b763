// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/card.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "samples/commands.h"
#include "samples/flag_values.h"
#include "vision/photo/png_writer.h"
#include "vision/photo/whole_file.h"
#include "vision/scale/card_drawing.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

struct CardCommand {
  std::string output = "card.svg", paper = "a4", json;
  double dpi = 600;  // laser printers' own raster
};

std::string Lowered(std::string text) {
  std::transform(
      text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

void RequirePossible(const CardCommand& command) {
  if (!command.json.empty() && fs::path(command.json) == fs::path(command.output))
    throw std::invalid_argument("--json: " + command.json +
                                " is the sheet itself; give another name");
  if (command.json == "-") throw std::invalid_argument("--json: '-' is no file; name one");
  RequireWithin("--dpi", command.dpi, {150, 1200});
  RequireWritable(command.output);
  if (!command.json.empty()) RequireWritable(command.json);
}

int RunCard(const CardCommand& command) {
  const Card card = BuiltInCard(command.paper == "a4" ? Paper::kA4 : Paper::kLetter);
  const CardDrawing drawing = DrawCard(card);
  const std::string kind = Lowered(fs::path(command.output).extension().string());
  if (kind != ".svg" && kind != ".pdf" && kind != ".png")
    throw std::invalid_argument("-o: " + command.output + " ends in none of .svg, .pdf and .png");
  RequirePossible(command);
  if (kind == ".svg") WriteFileWhole(command.output, CardSvg(drawing));
  if (kind == ".pdf") WriteFileWhole(command.output, CardPdf(drawing));
  if (kind == ".png") WritePng(command.output, CardPicture(drawing, command.dpi), {command.dpi});
  if (!command.json.empty()) WriteFileWhole(command.json, CardText(card));
  std::cout << command.output << ": print it at 100 % and check that the bar is 100 mm long\n";
  return kExitOk;
}

}  // namespace

void AddCard(CLI::App& app, int* exit_code) {
  const auto command = std::make_shared<CardCommand>();
  CLI::App* subcommand =
      app.add_subcommand("card", "Write a sheet to print and lay under the scissors");
  subcommand->add_option("-o,--output", command->output, "card.svg, card.pdf or card.png")
      ->capture_default_str();
  subcommand->add_option("--paper", command->paper, "a4 or letter")
      ->check(CLI::IsMember({"a4", "letter"}))
      ->capture_default_str();
  subcommand->add_option("--dpi", command->dpi, "of a PNG, 150 to 1200")->capture_default_str();
  subcommand->add_option(
      "--json", command->json, "also write the card's description, for fit --card FILE");
  subcommand->callback([command, exit_code] { *exit_code = RunCard(*command); });
}

}  // namespace bladecurve
