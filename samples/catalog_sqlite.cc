// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/catalog_sqlite.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kTables = R"(
  PRAGMA journal_mode = OFF;
  BEGIN;
  CREATE TABLE instruments(instrument TEXT PRIMARY KEY, status TEXT NOT NULL, reason TEXT, detail TEXT,
    warnings TEXT, curve TEXT, rms_mm REAL, settings TEXT, version TEXT, key TEXT);
  CREATE TABLE photos(instrument TEXT NOT NULL REFERENCES instruments, file TEXT NOT NULL, sha256 TEXT,
    theta_rad REAL, theta_sigma_rad REAL, pivot_x_px REAL, pivot_y_px REAL, pivot_sigma_px REAL,
    mm_per_px REAL, scale_source TEXT);
)";
constexpr const char* kInsertInstrument = "INSERT INTO instruments VALUES(?,?,?,?,?,?,?,?,?,?)";
constexpr const char* kInsertPhoto = "INSERT INTO photos VALUES(?,?,?,?,?,?,?,?,?,?)";

// An open database that is written once. Invariant: `handle_` is open.
class Database {
 public:
  explicit Database(const fs::path& path) : path_(path) {
    sqlite3* opened = nullptr;
    const int result = sqlite3_open(path.c_str(), &opened);
    handle_.reset(opened);
    Require(result == SQLITE_OK);
  }

  void Execute(const char* statements) {
    Require(sqlite3_exec(handle_.get(), statements, nullptr, nullptr, nullptr) == SQLITE_OK);
  }

  // null, numbers and text as they are; anything else as JSON text.
  void Insert(const char* statement, const std::vector<Json>& values) {
    sqlite3_stmt* prepared = nullptr;
    Require(sqlite3_prepare_v2(handle_.get(), statement, -1, &prepared, nullptr) == SQLITE_OK);
    const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> owner(prepared, sqlite3_finalize);
    for (std::size_t i = 0; i < values.size(); ++i)
      Bind(prepared, static_cast<int>(i) + 1, values[i]);
    Require(sqlite3_step(prepared) == SQLITE_DONE);
  }

 private:
  void Bind(sqlite3_stmt* statement, int column, const Json& value) {
    if (value.is_null()) {
      Require(sqlite3_bind_null(statement, column) == SQLITE_OK);
    } else if (value.is_number()) {
      Require(sqlite3_bind_double(statement, column, value.get<double>()) == SQLITE_OK);
    } else {
      const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
      Require(
          sqlite3_bind_text(
              statement, column, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT) ==
          SQLITE_OK);
    }
  }

  void Require(bool success) const {
    if (success) return;
    throw std::runtime_error(
        fmt::format("cannot write {}: {}", path_.string(), sqlite3_errmsg(handle_.get())));
  }

  fs::path path_;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> handle_{nullptr, sqlite3_close};
};

Json At(const Json& object, const char* key) { return object.value(key, Json()); }

Json Coordinate(const Json& photo, std::size_t axis) {
  return photo.contains("pivot_px") ? photo["pivot_px"].at(axis) : Json();
}

void InsertRow(Database& database, const Json& row) {
  database.Insert(kInsertInstrument,
                  {At(row, "instrument"),
                   At(row, "status"),
                   At(row, "reason"),
                   At(row, "detail"),
                   At(row, "warnings"),
                   At(row, "curve"),
                   At(row, "rms_mm"),
                   At(row, "settings"),
                   At(row, "version"),
                   At(row, "key")});
  for (const Json& photo : row.at("photos")) {
    database.Insert(kInsertPhoto,
                    {At(row, "instrument"),
                     At(photo, "file"),
                     At(photo, "sha256"),
                     At(photo, "theta_rad"),
                     At(photo, "theta_sigma_rad"),
                     Coordinate(photo, 0),
                     Coordinate(photo, 1),
                     At(photo, "pivot_sigma_px"),
                     At(photo, "mm_per_px"),
                     At(photo, "scale_source")});
  }
}

}  // namespace

void WriteSqlite(const fs::path& path, const std::vector<Json>& rows) {
  const fs::path draft = path.string() + fmt::format(".{}.part", getpid());
  std::error_code error;
  fs::remove(draft, error);
  {
    Database database(draft);
    database.Execute(kTables);
    for (const Json& row : rows) InsertRow(database, row);
    database.Execute("COMMIT");
  }
  fs::rename(draft, path);
}

}  // namespace bladecurve
