// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

// photo - vision -> EdgePoints - curvefit -> BladeCurve - model -> torque: who may include and link
// whom.
namespace {

namespace fs = std::filesystem;

struct Include {
  fs::path file;
  std::string target;    // as written between the quotes or brackets
  bool project = false;  // "..." rather than <...>
};

struct Layer {
  std::string folder;
  std::vector<std::string> project;      // prefixes of "..." includes
  std::vector<std::string> third_party;  // prefixes of <...> includes, anywhere
  std::vector<std::string> only_in_cc;   // prefixes of <...> includes that headers must not have
};

// What the C++ library, C and POSIX offer: no slash and no ending, or one of these.
bool IsStandard(const std::string& target) {
  static const std::regex kNames(
      "[a-z_0-9]+|(math|stdint|stddef|stdio|stdlib|string|dlfcn|unistd|fcntl)\\.h|sys/.*");
  return std::regex_match(target, kNames);
}

bool HasPrefix(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& prefix) {
    return text.starts_with(prefix);
  });
}

std::vector<Include> IncludesOf(const fs::path& file) {
  static const std::regex kInclude("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  std::ifstream stream(file);
  std::vector<Include> includes;
  std::smatch match;
  for (std::string line; std::getline(stream, line);) {
    if (std::regex_match(line, match, kInclude))
      includes.push_back({file, match[2], match[1] == "\""});
  }
  return includes;
}

std::vector<Include> IncludesOfFolder(const std::string& folder) {
  std::vector<Include> all;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(BLADECURVE_SOURCE_DIR) / folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".h" && ending != ".cc" && ending != ".c") continue;
    const std::vector<Include> includes = IncludesOf(entry.path());
    all.insert(all.end(), includes.begin(), includes.end());
  }
  return all;
}

bool IsAllowed(const Layer& layer, const Include& include) {
  if (include.project) return HasPrefix(include.target, layer.project);
  if (IsStandard(include.target) || HasPrefix(include.target, layer.third_party)) return true;
  return include.file.extension() == ".cc" && HasPrefix(include.target, layer.only_in_cc);
}

void ExpectLayerHolds(const Layer& layer) {
  const std::vector<Include> includes = IncludesOfFolder(layer.folder);
  ASSERT_FALSE(includes.empty()) << "no source found in " << layer.folder;
  for (const Include& include : includes) {
    EXPECT_TRUE(IsAllowed(layer, include))
        << include.file.string() << " must not include " << include.target;
  }
}

std::string OutputOf(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string output;
  std::array<char, 4096> buffer{};
  while (pipe && std::fgets(buffer.data(), buffer.size(), pipe.get())) output += buffer.data();
  return output;
}

// Symbols that a static library takes from others.
std::string ForeignSymbols(const std::string& archive) {
  return OutputOf(BLADECURVE_NM " --undefined-only --demangle " + archive + " 2>&1");
}

TEST(Layers, ModelIncludesOnlyStdAndJsonInSources) {
  ExpectLayerHolds({"model", {"model/"}, {}, {"nlohmann/"}});
}

TEST(Layers, VisionKnowsNeitherModelNorCurvefit) {
  ExpectLayerHolds({"vision",
                    {"vision/"},
                    {"Eigen/",
                     "opencv2/core",
                     "opencv2/imgproc",
                     "opencv2/calib3d",
                     "opencv2/aruco",
                     "opencv2/objdetect"},
                    {"nlohmann/",
                     "jpeglib.h",
                     "jerror.h",
                     "png.h",
                     "libdeflate.h",
                     "tiffio.h",
                     "libheif/",
                     "libexif/",
                     "tbb/",
                     "immintrin.h",
                     "cpuid.h"}});
}

// The rooms of vision/ in the order in which a photograph goes through them. What lies directly in
// vision/ ties them together; of that they know refusals, threads, hints and the log of
// stages alone.
struct Room {
  std::string name;
  std::vector<std::string> knows;
};

std::vector<Room> RoomsOfVision() {
  return {{"image", {}},
          {"photo", {"image"}},
          {"scale", {"image", "photo"}},
          {"scene", {"image", "photo", "scale"}},
          {"edge", {"image"}},
          {"pivot", {"image", "scale", "scene"}},
          {"scissors", {"image", "photo", "scale", "scene", "edge", "pivot"}},
          {"render", {"image"}},
          {"overlay", {"photo"}}};
}

TEST(Layers, EveryFolderInVisionIsARoom) {
  std::vector<std::string> folders, rooms;
  for (const auto& entry : fs::directory_iterator(fs::path(BLADECURVE_SOURCE_DIR) / "vision")) {
    if (entry.is_directory()) folders.push_back(entry.path().filename().string());
  }
  for (const Room& room : RoomsOfVision()) rooms.push_back(room.name);
  std::sort(folders.begin(), folders.end());
  std::sort(rooms.begin(), rooms.end());
  EXPECT_EQ(folders, rooms);
}

TEST(Layers, RoomsOfVisionKnowEarlierOnesAlone) {
  for (const Room& room : RoomsOfVision()) {
    std::vector<std::string> may = {"vision/" + room.name + "/",
                                    "vision/parallel.h",
                                    "vision/refused.h",
                                    "vision/stage_log.h",
                                    "vision/hints.h"};
    for (const std::string& known : room.knows) may.push_back("vision/" + known + "/");
    for (const Include& include : IncludesOfFolder("vision/" + room.name)) {
      if (!include.project) continue;
      EXPECT_TRUE(HasPrefix(include.target, may))
          << include.file.string() << " must not include " << include.target;
    }
  }
}

TEST(Layers, CurvefitSeesOnlyTheResultsOfVisionAndCeresInSources) {
  ExpectLayerHolds({"curvefit",
                    {"curvefit/", "model/", "vision/edge_points.h", "vision/refused.h"},
                    {"Eigen/"},
                    {"ceres/"}});
}

// As their CMake targets list them.
std::vector<fs::path> InstalledHeaders() {
  std::istringstream list(BLADECURVE_INSTALLED_HEADERS);
  std::vector<fs::path> headers;
  for (std::string path; std::getline(list, path, ':');) headers.emplace_back(path);
  return headers;
}

TEST(Layers, InstalledHeadersIncludeInstalledOnes) {
  const std::vector<fs::path> installed = InstalledHeaders();
  ASSERT_GT(installed.size(), 20U);
  for (const fs::path& header : installed) {
    ASSERT_TRUE(fs::exists(header)) << header;
    for (const Include& include : IncludesOf(header)) {
      const fs::path included = fs::path(BLADECURVE_SOURCE_DIR) / include.target;
      const bool found = std::find(installed.begin(), installed.end(), included) != installed.end();
      EXPECT_TRUE(found || !include.project) << header << " includes " << include.target;
    }
  }
}

TEST(Layers, ModelLinksNeitherOpenCvNorCeres) {
  const std::string symbols = ForeignSymbols(BLADECURVE_MODEL_ARCHIVE);
  ASSERT_NE(symbols.find("operator new"), std::string::npos) << "nm read nothing: " << symbols;
  EXPECT_EQ(symbols.find(" cv::"), std::string::npos) << symbols;
  EXPECT_EQ(symbols.find(" ceres::"), std::string::npos) << symbols;
}

TEST(Layers, CurvefitLinksNoOpenCv) {
  const std::string symbols = ForeignSymbols(BLADECURVE_CURVEFIT_ARCHIVE);
  ASSERT_NE(symbols.find(" ceres::"), std::string::npos) << "nm read nothing: " << symbols;
  EXPECT_EQ(symbols.find(" cv::"), std::string::npos) << symbols;
}

TEST(Layers, VisionLinksNoCeres) {
  const std::string symbols = ForeignSymbols(BLADECURVE_VISION_ARCHIVE);
  ASSERT_NE(symbols.find(" cv::"), std::string::npos) << "nm read nothing: " << symbols;
  EXPECT_EQ(symbols.find(" ceres::"), std::string::npos) << symbols;
}

// Each of these loads GDAL and a hundred more libraries at every start of the program.
TEST(Layers, ProgramLoadsNoHeavyOpenCvModule) {
  const std::string libraries = OutputOf("ldd " BLADECURVE_PROGRAM " 2>&1");
  ASSERT_NE(libraries.find("libopencv_core"), std::string::npos) << libraries;
  for (const char* heavy :
       {"libopencv_imgcodecs", "libopencv_highgui", "libopencv_ximgproc", "libgdal"}) {
    EXPECT_EQ(libraries.find(heavy), std::string::npos) << heavy << " in\n" << libraries;
  }
}

}  // namespace
