// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "samples/csv_text.h"
#include "samples/shard.h"
#include "tests/samples/program_run.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Two photographs of scissors, a text file named .jpg, and a note that is no picture.
fs::path FolderOfPhotographs() {
  const fs::path folder = TestFolder();
  fs::create_directory(folder / "photos");
  for (const char* name : {"mayo.jpg", "metzenbaum_drape.jpg"}) {
    fs::copy_file(SamplePhotos() / name, folder / "photos" / name);
  }
  WriteText(folder / "photos/broken.jpg", "this is no picture");
  WriteText(folder / "photos/notes.txt", "blade 3 reground");
  return folder;
}

ProgramRun Catalog(const fs::path& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "catalog");
  return RunBladecurve(arguments, folder);
}

ProgramRun WholeCatalog(const fs::path& folder,
                        const std::string& out,
                        const std::string& threads = "2") {
  return Catalog(folder, {"photos", "-o", out, "--marker-mm", "25", "--threads", threads});
}

std::vector<Json> JsonLines(const fs::path& path) {
  std::vector<Json> rows;
  std::istringstream stream(ReadText(path));
  for (std::string line; std::getline(stream, line);) rows.push_back(Json::parse(line));
  return rows;
}

TEST(Catalog, GivesOneRowForEachPhotograph) {
  const fs::path folder = FolderOfPhotographs();
  const ProgramRun run = WholeCatalog(folder, "out");
  EXPECT_EQ(run.exit_code, 0) << run.standard_error;
  const std::vector<Json> rows = JsonLines(folder / "out/catalog.jsonl");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["instrument"], "broken");
  EXPECT_EQ(rows[0]["status"], "refused");
  EXPECT_EQ(rows[0]["reason"], "unreadable");
  EXPECT_EQ(rows[1]["instrument"], "mayo");
  EXPECT_TRUE(rows[1].contains("curve")) << rows[1];
  EXPECT_TRUE(fs::exists(folder / "out/blades/mayo.blade.json"));
  const auto table = ParseCsv(ReadText(folder / "out/catalog.csv"));
  ASSERT_EQ(table.size(), 4u);
  for (const auto& line : table) EXPECT_EQ(line.size(), table[0].size());
}

TEST(Catalog, SecondRunDoesOnlyWhatIsMissing) {
  const fs::path folder = FolderOfPhotographs();
  WholeCatalog(folder, "out");
  EXPECT_NE(WholeCatalog(folder, "out")
                .standard_output.find("0 measured, 0 refused, 0 errors, 3 done before"),
            std::string::npos);
  fs::copy_file(SamplePhotos() / "mayo_wide.jpg", folder / "photos/new.jpg");
  EXPECT_NE(WholeCatalog(folder, "out").standard_output.find("3 done before"), std::string::npos);
  EXPECT_EQ(JsonLines(folder / "out/catalog.jsonl").size(), 4u);
}

TEST(Catalog, ChangedPhotographIsMeasuredAgain) {
  const fs::path folder = FolderOfPhotographs();
  WholeCatalog(folder, "out");
  fs::copy_file(SamplePhotos() / "mayo_wide.jpg",
                folder / "photos/broken.jpg",
                fs::copy_options::overwrite_existing);
  WholeCatalog(folder, "out");
  const std::vector<Json> rows = JsonLines(folder / "out/catalog.jsonl");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_TRUE(rows[0].contains("curve")) << rows[0];
}

TEST(Catalog, OtherSettingsAreOtherResults) {
  const fs::path folder = FolderOfPhotographs();
  WholeCatalog(folder, "out");
  const ProgramRun run =
      Catalog(folder, {"photos", "-o", "out", "--marker-mm", "25", "--loss", "cauchy"});
  EXPECT_NE(run.standard_output.find("0 done before"), std::string::npos) << run.standard_output;
}

// A run killed in the middle of a line loses that row and no other.
TEST(Catalog, HalfWrittenRowIsDoneAgain) {
  const fs::path folder = FolderOfPhotographs();
  WholeCatalog(folder, "out", "1");
  const std::string whole = ReadText(folder / "out/catalog.jsonl");
  const fs::path rows = folder / "out/rows/1-of-1.jsonl";
  const std::string text = ReadText(rows);
  WriteText(rows, text.substr(0, text.size() - 40));
  const ProgramRun run = WholeCatalog(folder, "out", "1");
  EXPECT_NE(run.standard_output.find("2 done before"), std::string::npos) << run.standard_output;
  EXPECT_EQ(ReadText(folder / "out/catalog.jsonl"), whole);
}

TEST(Catalog, ShardsMergeToTheSameBytes) {
  const fs::path folder = FolderOfPhotographs();
  WholeCatalog(folder, "whole");
  EXPECT_EQ(Catalog(folder, {"plan", "photos", "-o", "split", "--marker-mm", "25"}).exit_code, 0);
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    EXPECT_EQ(Catalog(folder, {"run", "split", "--shard", shard}).exit_code, 0) << shard;
  }
  EXPECT_EQ(Catalog(folder, {"merge", "split"}).exit_code, 0);
  for (const char* file : {"catalog.jsonl", "catalog.csv", "catalog.sqlite"}) {
    EXPECT_TRUE(ReadText(folder / "whole" / file) == ReadText(folder / "split" / file)) << file;
  }
}

TEST(Catalog, StatusCountsWhatIsMissing) {
  const fs::path folder = FolderOfPhotographs();
  Catalog(folder, {"plan", "photos", "-o", "out", "--marker-mm", "25"});
  EXPECT_NE(Catalog(folder, {"status", "out"}).standard_output.find("3 planned, 3 missing"),
            std::string::npos);
  Catalog(folder, {"run", "out", "--shard", "1/3"});
  const std::string status = Catalog(folder, {"status", "out"}).standard_output;
  EXPECT_NE(status.find("3 planned, 2 missing"), std::string::npos) << status;
  EXPECT_NE(status.find("unreadable"), std::string::npos) << status;
}

TEST(Catalog, SubFolderIsOneInstrument) {
  const fs::path folder = TestFolder();
  fs::create_directories(folder / "photos/mayo 14");
  fs::copy_file(SamplePhotos() / "mayo.jpg", folder / "photos/mayo 14/a.jpg");
  fs::copy_file(SamplePhotos() / "mayo_wide.jpg", folder / "photos/mayo 14/b.jpg");
  WholeCatalog(folder, "out");
  const std::vector<Json> rows = JsonLines(folder / "out/catalog.jsonl");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["instrument"], "mayo 14");
  EXPECT_EQ(rows[0]["photos"].size(), 2u);
  EXPECT_EQ(ParseCsv(ReadText(folder / "out/catalog.csv")).size(), 3u);
}

TEST(Catalog, ManifestRowMayHaveItsOwnFlags) {
  const fs::path folder = FolderOfPhotographs();
  WriteText(folder / "list.csv",
            "instrument,photos,flags\r\nmayo,photos/mayo.jpg,--marker-mm=12.5\r\n");
  EXPECT_EQ(Catalog(folder, {"list.csv", "-o", "half", "--marker-mm", "25"}).exit_code, 0);
  WriteText(folder / "list.csv", "instrument,photos\nmayo,photos/mayo.jpg\n");
  EXPECT_EQ(Catalog(folder, {"list.csv", "-o", "full", "--marker-mm", "25"}).exit_code, 0);
  const double half = JsonLines(folder / "half/catalog.jsonl").at(0)["photos"][0]["mm_per_px"];
  const double full = JsonLines(folder / "full/catalog.jsonl").at(0)["photos"][0]["mm_per_px"];
  EXPECT_NEAR(full / half, 2, 1e-3);
}

TEST(Catalog, WrongUseIsSaidBeforeAnyWork) {
  const fs::path folder = TestFolder();
  const std::map<std::string, std::vector<std::string>> cases = {
      {"give a folder", {}},
      {"no such folder", {"nowhere"}},
      {"no photographs", {"."}},
      {"above zero", {".", "--dpi", "0"}},
      {"plan", {"run", "nowhere"}}};
  for (const auto& [message, arguments] : cases) {
    const ProgramRun run = Catalog(folder, arguments);
    EXPECT_EQ(run.exit_code, 2) << message;
    EXPECT_NE(run.standard_error.find(message), std::string::npos) << run.standard_error;
  }
}

TEST(Shard, EveryItemBelongsToExactlyOne) {
  for (int item = 0; item < 30; ++item) {
    int holders = 0;
    for (int index = 1; index <= 7; ++index) holders += Shard{index, 7}.Holds(item) ? 1 : 0;
    EXPECT_EQ(holders, 1) << item;
  }
}

TEST(Shard, ImpossibleSharesAreRefused) {
  for (const char* text : {"", "1", "0/3", "4/3", "-1/3", "1/0", "a/b", "1/3x"}) {
    EXPECT_THROW((void)ParseShard(text), std::invalid_argument) << text;
  }
}

TEST(Shard, ComesFromTheClustersEnvironment) {
  const auto shard = [](std::map<std::string, std::string> variables) {
    const auto found = ShardFromEnvironment([&](const char* name) -> std::optional<std::string> {
      const auto it = variables.find(name);
      return it == variables.end() ? std::nullopt : std::optional(it->second);
    });
    return found ? std::to_string(found->index) + "/" + std::to_string(found->count) : "none";
  };
  EXPECT_EQ(shard({}), "none");
  EXPECT_EQ(shard({{"SLURM_ARRAY_TASK_ID", "7"},
                   {"SLURM_ARRAY_TASK_COUNT", "4"},
                   {"SLURM_ARRAY_TASK_MIN", "5"}}),
            "3/4");
  EXPECT_EQ(shard({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "2"}}), "1/2");
  EXPECT_EQ(shard({{"JOB_COMPLETION_INDEX", "2"}, {"BLADECURVE_SHARDS", "3"}}), "3/3");
  EXPECT_EQ(shard({{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "2"}}), "2/2");
  EXPECT_EQ(shard({{"PARALLEL_SEQ", "1"}, {"BLADECURVE_SHARDS", "9"}}), "1/9");
  EXPECT_EQ(shard({{"PARALLEL_SEQ", "1"}}), "none");
}

TEST(CsvText, RoundTripsAwkwardFields) {
  const std::vector<std::string> fields = {
      "", "a,b", "say \"hi\"", "two\nlines", " spaced ", "ümlaut"};
  EXPECT_EQ(ParseCsv(CsvLine(fields) + CsvLine({"x"})),
            (std::vector<std::vector<std::string>>{fields, {"x"}}));
}

TEST(CsvText, UnderstandsWindowsFilesAndSkipsEmptyLines) {
  EXPECT_EQ(ParseCsv("\xef\xbb\xbf"
                     "a,b\r\n\r\n\"1\",2"),
            (std::vector<std::vector<std::string>>{{"a", "b"}, {"1", "2"}}));
}

TEST(CsvText, OpenQuoteIsRefused) {
  EXPECT_THROW((void)ParseCsv("a,\"b\n"), std::invalid_argument);
}

}  // namespace
}  // namespace bladecurve
