// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/photo/photo.h"

#include <gtest/gtest.h>
#include <png.h>
#include <tiffio.h>

#include <Eigen/LU>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>
// jpeglib.h needs FILE and size_t declared before it.
#include <jpeglib.h>

#include "jpeg_images.h"
#include "process_folder.h"
#include "vision/parallel.h"
#include "vision/photo/png_writer.h"
#include "vision/photo/sha256.h"
#include "vision/refused.h"
#include "vision/render/render.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

fs::path Write(const std::string& name, const std::string& bytes) {
  const fs::path path = ProcessFolder() / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

// A gradient, so that places can be told apart.
cv::Mat Gradient(int width, int height) {
  cv::Mat grey(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      grey.at<uchar>(y, x) = static_cast<uchar>(10 + (150 * x) / width + (80 * y) / height);
  }
  return grey;
}

std::string Short(int value) { return {static_cast<char>(value), static_cast<char>(value >> 8)}; }
std::string Long(int value) { return Short(value & 0xffff) + Short(value >> 16); }

// Little-endian EXIF with an orientation and a 35 mm equivalent focal length; zero leaves one out.
std::string Exif(int orientation, int focal_length_35mm) {
  const std::string header = "II*" + std::string(1, '\0') + Long(8);
  const std::string turn = Short(0x0112) + Short(3) + Long(1) + Long(orientation);
  const std::string pointer = Short(0x8769) + Short(4) + Long(1) + Long(8 + 2 + 24 + 4);
  const std::string focal = Short(0xa405) + Short(3) + Long(1) + Long(focal_length_35mm);
  return std::string("Exif\0\0", 6) + header + Short(2) + turn + pointer + Long(0) +
         Short(focal_length_35mm > 0 ? 1 : 0) + (focal_length_35mm > 0 ? focal : "") + Long(0);
}

struct PngSettings {
  int colour_type, bit_depth, interlace;
};

// `row` holds one row of raw samples, written again and again.
fs::path WriteRawPng(const std::string& name,
                     cv::Size size,
                     const PngSettings& settings,
                     std::vector<png_byte> row) {
  const fs::path path = ProcessFolder() / name;
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png,
               info,
               static_cast<png_uint_32>(size.width),
               static_cast<png_uint_32>(size.height),
               settings.bit_depth,
               settings.colour_type,
               settings.interlace,
               PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  const png_color palette[2] = {{0, 0, 0}, {255, 255, 255}};
  if (settings.colour_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 2);
  png_write_info(png, info);
  std::vector<png_bytep> rows(static_cast<size_t>(size.height), row.data());
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
  return path;
}

void ExpectUnreadable(const fs::path& path, const std::string& cause) {
  try {
    static_cast<void>(Photo::Load(path));
    ADD_FAILURE() << path << " was read";
  } catch (const Refused& refused) {
    EXPECT_EQ(refused.reason(), Reason::kUnreadable);
    EXPECT_NE(std::string(refused.what()).find(cause), std::string::npos) << refused.what();
    EXPECT_NE(std::string(refused.what()).find(path.string()), std::string::npos) << refused.what();
  }
}

TEST(PhotoLoad, RefusesWhatIsNoPicture) {
  ExpectUnreadable("/nonexistent/photo.jpg", "no such file");
  ExpectUnreadable(testing::TempDir(), "folder");
  ExpectUnreadable(Write("empty.jpg", ""), "empty");
  ExpectUnreadable(Write("text.jpg", "This is no photograph.\n"), "no JPEG, PNG, TIFF or HEIC");
  ExpectUnreadable(Write("header.jpg", "\xff\xd8\xff\xe0"), "");
}

TEST(PhotoLoad, RefusesTruncatedFilesWhereverTheyEnd) {
  const std::string jpeg = Jpeg(Gradient(320, 240), {});
  const fs::path png_path = ProcessFolder() / "whole.png";
  WritePng(png_path, Gradient(320, 240));
  std::ifstream stream(png_path, std::ios::binary);
  const std::string png((std::istreambuf_iterator<char>(stream)), {});
  for (const double share : {0.05, 0.3, 0.6, 0.95}) {
    ExpectUnreadable(
        Write("cut.jpg",
              jpeg.substr(0, static_cast<size_t>(share * static_cast<double>(jpeg.size())))),
        "");
    ExpectUnreadable(
        Write("cut.png",
              png.substr(0, static_cast<size_t>(share * static_cast<double>(png.size())))),
        "");
  }
}

// Loads with as many threads.
cv::Mat GreyOn(int num_threads, const fs::path& path) {
  cv::Mat grey;
  ParallelFor(1, num_threads, [&](int) { grey = Photo::Load(path).grey(); });
  return grey;
}

TEST(PhotoLoad, ReadsLargePicturesAlikeOnAnyNumberOfThreads) {
  cv::Mat picture = Gradient(1531, 1023);
  cv::circle(picture, {700, 614}, 200, 30, 7);  // where the upper and the lower rows meet
  const JpegSettings colour{JCS_RGB, 3, 0, ""};
  JpegSettings restarted = colour;
  restarted.restart_rows = 3;
  for (const JpegSettings& settings : {JpegSettings{}, colour, restarted}) {
    const fs::path path = Write("large.jpg", Jpeg(picture, settings));
    const cv::Mat whole = GreyOn(1, path), in_two = GreyOn(2, path);
    EXPECT_EQ(cv::norm(whole, in_two, cv::NORM_INF), 0);
    EXPECT_LT(cv::norm(whole, picture, cv::NORM_INF), 16);
  }
}

TEST(PhotoDecodeColour, IsALittleSmallerOnlyWhereTheFileGivesThat) {
  constexpr double kSlack = 1.1, kLeast = 0.9;
  const Photo photo = Photo::Load(Write("halved.jpg", Jpeg(Gradient(1531, 1023), {})));
  EXPECT_EQ(photo.DecodeColour(800, kSlack, kLeast).cols, 766);  // half
  EXPECT_EQ(photo.DecodeColour(800, kSlack).cols, 800);
  EXPECT_EQ(photo.DecodeColour(900, kSlack, kLeast).cols, 900);
}

cv::Mat ColourOn(int num_threads, const Photo& photo, int least_side) {
  cv::Mat colour;
  ParallelFor(1, num_threads, [&](int) { colour = photo.DecodeColour(least_side, 2); });
  return colour;
}

// Upright ones, too: their lower rows are no longer than they are wide.
TEST(PhotoDecodeColour, ReadsLargePicturesAlikeOnAnyNumberOfThreads) {
  cv::Mat lying, upright;
  const cv::Mat across = Gradient(1531, 1023), down = Gradient(1023, 1531).t();
  cv::merge(std::vector{across, down, across}, lying);
  cv::circle(lying, {700, 614}, 200, {200, 20, 20}, 7);  // where the upper and the lower rows meet
  cv::rotate(lying, upright, cv::ROTATE_90_CLOCKWISE);
  for (const cv::Mat& bgr : {lying, upright}) {
    const Photo photo = Photo::Load(Write("large-colour.jpg", EncodeJpeg(bgr, 92)));
    for (const int side : {1531, 700, 300, 150}) {
      const cv::Mat whole = ColourOn(1, photo, side), in_two = ColourOn(2, photo, side);
      ASSERT_EQ(whole.size(), in_two.size());
      EXPECT_EQ(cv::norm(whole, in_two, cv::NORM_INF), 0);
      cv::Mat expected;
      cv::resize(bgr, expected, whole.size(), 0, 0, cv::INTER_AREA);
      EXPECT_LT(cv::norm(whole, expected, cv::NORM_L1) / static_cast<double>(3 * whole.total()), 3);
    }
  }
}

// With hardly a row of blocks above where they might be divided.
TEST(PhotoLoad, ReadsLargePicturesOfFewRowsAlikeOnAnyNumberOfThreads) {
  for (const int height : {17, 30, 50}) {
    const fs::path path = Write("flat.jpg", Jpeg(Gradient(60000, height), {JCS_RGB, 3, 0, ""}));
    EXPECT_EQ(cv::norm(GreyOn(1, path), GreyOn(2, path), cv::NORM_INF), 0) << height;
  }
}

TEST(PhotoLoad, RefusesTruncatedLargePicturesOnAnyNumberOfThreads) {
  const std::string jpeg = Jpeg(Gradient(1531, 1023), {});
  for (const double share : {0.3, 0.65, 0.75, 0.95}) {
    const fs::path path =
        Write("cut-large.jpg",
              jpeg.substr(0, static_cast<size_t>(share * static_cast<double>(jpeg.size()))));
    EXPECT_THROW(GreyOn(1, path), Refused);
    EXPECT_THROW(GreyOn(2, path), Refused);
  }
}

// The pixels of a file that need not be whole; empty where it is refused.
cv::Mat GreyUnlessRefused(int num_threads, const fs::path& path) {
  try {
    return GreyOn(num_threads, path);
  } catch (const Refused&) {
    return {};
  }
}

// Some damage goes unnoticed: the codes of other pixels.
TEST(PhotoLoad, ReadsDamagedLargePicturesAlikeOnAnyNumberOfThreads) {
  const std::string jpeg = Jpeg(Gradient(1531, 1023), {JCS_RGB, 3, 0, ""});
  std::mt19937 random(1);
  int num_read = 0, num_refused = 0;
  for (int i = 0; i < 60; ++i) {
    std::string damaged = jpeg;
    const size_t place = jpeg.size() / 50 + random() % (jpeg.size() / 2);
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << random() % 8));
    const fs::path path = Write("damaged-large.jpg", damaged);
    const cv::Mat whole = GreyUnlessRefused(1, path), in_two = GreyUnlessRefused(2, path);
    ASSERT_EQ(whole.size(), in_two.size()) << "byte " << place;
    ++(whole.empty() ? num_refused : num_read);
    if (whole.empty()) continue;
    EXPECT_EQ(cv::norm(whole, in_two, cv::NORM_INF), 0) << "byte " << place;
  }
  EXPECT_GT(num_read, 3);
  EXPECT_GT(num_refused, 3);
}

TEST(PhotoLoad, RefusesDecompressionBombs) {
  std::string jpeg = Jpeg(Gradient(16, 16), {});
  const size_t frame = jpeg.find("\xff\xc0");
  jpeg.replace(frame + 5, 4, std::string("\xff\0\xff\0", 4));  // 65280 x 65280
  ExpectUnreadable(Write("bomb.jpg", jpeg), "400 million; give a smaller picture");
}

TEST(PhotoLoad, ReadsEverySizeAndKind) {
  EXPECT_EQ(Photo::Load(Write("one.jpg", Jpeg(Gradient(1, 1), {}))).grey().size(), cv::Size(1, 1));
  EXPECT_EQ(Photo::Load(Write("wide.jpg", Jpeg(Gradient(20000, 20), {}))).grey().size(),
            cv::Size(20000, 20));
  const fs::path deep = WriteRawPng(
      "deep.png", {2, 2}, {PNG_COLOR_TYPE_GRAY, 16, PNG_INTERLACE_NONE}, {0x7f, 0xff, 0xff, 0xff});
  EXPECT_EQ(Photo::Load(deep).grey().at<uchar>(1, 0), 127);  // 32767 / 257 = 127.498
  EXPECT_EQ(Photo::Load(deep).grey().at<uchar>(1, 1), 255);
  const fs::path palette =
      WriteRawPng("palette.png", {8, 3}, {PNG_COLOR_TYPE_PALETTE, 1, PNG_INTERLACE_NONE}, {0x0f});
  EXPECT_EQ(Photo::Load(palette).grey().at<uchar>(2, 3), 0);
  EXPECT_EQ(Photo::Load(palette).grey().at<uchar>(2, 4), 255);
  const fs::path alpha = WriteRawPng("alpha.png",
                                     {2, 2},
                                     {PNG_COLOR_TYPE_RGB_ALPHA, 8, PNG_INTERLACE_NONE},
                                     {0, 0, 0, 0, 0, 0, 0, 255});
  EXPECT_EQ(Photo::Load(alpha).grey().at<uchar>(0, 0), 255);
  EXPECT_EQ(Photo::Load(alpha).grey().at<uchar>(0, 1), 0);
  const fs::path laced = WriteRawPng("laced.png",
                                     {9, 9},
                                     {PNG_COLOR_TYPE_GRAY, 8, PNG_INTERLACE_ADAM7},
                                     {0, 1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_EQ(Photo::Load(laced).grey().at<uchar>(7, 5), 5);
}

TEST(PhotoLoad, ReadsInksAsLight) {
  // libjpeg marks CMYK as Adobe's: 255 is no ink, so light is the product of ink and black.
  const Photo photo = Photo::Load(
      Write("cmyk.jpg", Jpeg(cv::Mat(32, 32, CV_8UC1, cv::Scalar(200)), {JCS_CMYK, 4, 0, ""})));
  EXPECT_NEAR(photo.grey().at<uchar>(16, 16), 200 * 200 / 255, 2);
  EXPECT_EQ(photo.DecodeColour(16).size(), cv::Size(16, 16));
}

TEST(PhotoLoad, ReadsTiff) {
  const fs::path path = ProcessFolder() / "scan.tif";
  TIFF* const tiff = TIFFOpen(path.c_str(), "w");
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 4);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 2);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 600.0);
  TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 600.0);
  TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
  unsigned char row[] = {0, 50, 100, 255};
  TIFFWriteScanline(tiff, row, 0, 0);
  TIFFWriteScanline(tiff, row, 1, 0);
  TIFFClose(tiff);
  const Photo photo = Photo::Load(path);
  EXPECT_EQ(photo.metadata().format, "tiff");
  EXPECT_EQ(photo.grey().at<uchar>(1, 2), 100);
  EXPECT_EQ(photo.metadata().dpi, 600);
}

TEST(Photo, DisplaysEveryOrientationAsViewersDo) {
  // EXIF 2.3: the corner of the stored picture that is displayed at the top left.
  const std::vector<cv::Point> top_left = {
      {0, 0}, {29, 0}, {29, 19}, {0, 19}, {0, 0}, {0, 19}, {29, 19}, {29, 0}};
  const cv::Mat stored = Photo::Load(Write("stored.jpg", Jpeg(Gradient(30, 20), {}))).grey();
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const Photo photo = Photo::Load(
        Write("turned.jpg", Jpeg(Gradient(30, 20), {JCS_GRAYSCALE, 1, 0, Exif(orientation, 0)})));
    EXPECT_EQ(photo.displayed_width(), orientation < 5 ? 30 : 20);
    EXPECT_EQ(photo.displayed_height(), orientation < 5 ? 20 : 30);
    const Eigen::Vector2d corner = photo.StoredFromDisplayed({0, 0});
    EXPECT_EQ(photo.grey().at<uchar>(cv::Point2d(corner.x(), corner.y())),
              stored.at<uchar>(top_left[static_cast<size_t>(orientation) - 1]))
        << orientation;
    const Eigen::Vector2d place(7, 3);
    EXPECT_EQ(photo.DisplayedFromStored(photo.StoredFromDisplayed(place)), place) << orientation;
    Eigen::Matrix2d turn;
    turn << photo.DisplayedFromStored({1, 0}) - photo.DisplayedFromStored({0, 0}),
        photo.DisplayedFromStored({0, 1}) - photo.DisplayedFromStored({0, 0});
    EXPECT_GT(turn.determinant(), 0) << orientation << ": a turn, no reflection";
  }
}

TEST(Photo, DecodesColourAsSmallAsAsked) {
  const Photo photo =
      Photo::Load(Write("large.jpg", Jpeg(Gradient(1600, 1200), {JCS_RGB, 3, 0, ""})));
  for (const int side : {100, 333, 1600, 5000}) {
    const cv::Mat colour = photo.DecodeColour(side);
    EXPECT_EQ(colour.type(), CV_8UC3);
    EXPECT_EQ(std::max(colour.cols, colour.rows), std::min(side, 1600));
    EXPECT_NEAR(cv::mean(colour)[0], cv::mean(photo.grey())[0], 1) << side;
  }
  EXPECT_THROW(static_cast<void>(photo.DecodeColour(0)), std::invalid_argument);
}

TEST(Photo, DecodesColourLargerThanAskedOnlyWithinTheSlack) {
  const Photo photo =
      Photo::Load(Write("slack.jpg", Jpeg(Gradient(1600, 1200), {JCS_RGB, 3, 0, ""})));
  EXPECT_EQ(photo.DecodeColour(790, 1.02).size(), cv::Size(800, 600));  // half of each side
  EXPECT_EQ(photo.DecodeColour(790, 1.01).cols, 790);
  EXPECT_EQ(photo.DecodeColour(1000, 1.25).cols, 1000);
}

TEST(Photo, DecodesTheColourOfItsTop) {
  const cv::Mat picture = Gradient(1600, 1200);
  const fs::path png = ProcessFolder() / "top.png";
  WritePng(png, picture);
  for (const fs::path& path : {Write("top.jpg", Jpeg(picture, {JCS_RGB, 3, 0, ""})), png}) {
    const Photo photo = Photo::Load(path);
    const cv::Mat all = photo.DecodeColour(800), top = photo.DecodeTopColour(0.1, 800);
    EXPECT_EQ(top.rows * 10, 1200 * top.cols / 1600) << path;
    cv::Mat reduced;
    cv::resize(top, reduced, {800, 60}, 0, 0, cv::INTER_AREA);
    EXPECT_LE(cv::norm(reduced, all.rowRange(0, 60), cv::NORM_INF), 1) << path;
    EXPECT_THROW(static_cast<void>(photo.DecodeTopColour(0, 800)), std::invalid_argument);
  }
}

TEST(Photo, DecodesAPartInColour) {
  constexpr int kBorderPx = 2;  // at a part's border colours lack a neighbour
  const cv::Mat picture = Gradient(333, 250);
  const fs::path png = ProcessFolder() / "part.png";
  WritePng(png, picture);
  std::vector<fs::path> files = {
      png,
      Write("mirrored_part.jpg", Jpeg(picture, {JCS_YCbCr, 3, 0, Exif(2, 0)})),
      Write("progressive_part.jpg", Jpeg(picture, {JCS_YCbCr, 3, 0, "", {2, 2}, true}))};
  for (const cv::Size& sampling :
       {cv::Size(1, 1), cv::Size(2, 1), cv::Size(1, 2), cv::Size(2, 2)}) {
    files.push_back(Write("part" + std::to_string(files.size()) + ".jpg",
                          Jpeg(picture, {JCS_YCbCr, 3, 0, "", sampling})));
  }
  for (const fs::path& file : files) {
    const Photo photo = Photo::Load(file);
    const cv::Mat all = photo.DecodeColour(333);
    for (const cv::Rect& asked : {cv::Rect(0, 0, 333, 250),
                                  cv::Rect(101, 77, 90, 60),
                                  cv::Rect(0, 200, 40, 50),
                                  cv::Rect(300, -20, 50, 41)}) {
      const PicturePart part = photo.DecodeColourPart(asked);
      const cv::Rect wanted = asked & cv::Rect({0, 0}, all.size());
      ASSERT_EQ(part.Area() & wanted, wanted) << file << asked;
      const cv::Rect inner(wanted.tl() + cv::Point(kBorderPx, 0),
                           wanted.size() - cv::Size(2 * kBorderPx, 0));
      EXPECT_EQ(cv::norm(part.pixels(inner - part.corner_px), all(inner), cv::NORM_INF), 0)
          << file << asked;
    }
    EXPECT_THROW(static_cast<void>(photo.DecodeColourPart({400, 0, 10, 10})),
                 std::invalid_argument);
  }
}

TEST(WritePng, ComesBackAsItWas) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(7, 300), cv::Size(301, 5)}) {
    for (const int type : {CV_8UC1, CV_8UC3}) {
      cv::Mat picture(size, type);
      cv::randu(picture, 0, 256);
      const fs::path file = ProcessFolder() / "written.png";
      WritePng(file, picture);
      const Photo photo = Photo::Load(file);
      const cv::Mat back =
          type == CV_8UC1 ? photo.grey() : photo.DecodeColour(std::max(size.width, size.height));
      EXPECT_EQ(cv::norm(back, picture, cv::NORM_INF), 0) << size << " type " << type;
    }
  }
}

TEST(PhotoMetadata, TrustsAResolutionOnlyFromAScanner) {
  const cv::Mat grey = Gradient(40, 30);
  EXPECT_EQ(Photo::Load(Write("scan.jpg", Jpeg(grey, {JCS_GRAYSCALE, 1, 300, ""}))).metadata().dpi,
            300);
  EXPECT_FALSE(Photo::Load(Write("web.jpg", Jpeg(grey, {JCS_GRAYSCALE, 1, 72, ""})))
                   .metadata()
                   .dpi.has_value());
  EXPECT_FALSE(Photo::Load(Write("camera.jpg", Jpeg(grey, {JCS_GRAYSCALE, 1, 300, Exif(1, 28)})))
                   .metadata()
                   .dpi.has_value());
}

TEST(PhotoMetadata, KnowsTheFocalLengthInPixels) {
  const Photo photo =
      Photo::Load(Write("phone.jpg", Jpeg(Gradient(400, 300), {JCS_GRAYSCALE, 1, 0, Exif(1, 28)})));
  ASSERT_TRUE(photo.metadata().focal_length_px.has_value());
  EXPECT_NEAR(*photo.metadata().focal_length_px,
              28 * 500 / 43.2666,
              1e-3);  // 28 mm to the diagonal of 35 mm film
}

TEST(Sha256Hex, AgreesWithTheStandard) {
  EXPECT_EQ(Sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256Hex(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace bladecurve
