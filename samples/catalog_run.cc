// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/catalog_run.h"

#include <atomic>
#include <set>
#include <string>
#include <vector>

#include "samples/analysis.h"
#include "samples/analysis_flags.h"
#include "samples/blade_record.h"
#include "samples/catalog_plan.h"
#include "samples/catalog_row.h"
#include "samples/catalog_rows_file.h"
#include "samples/fit_overlay.h"
#include "vision/parallel.h"
#include "vision/photo/png_writer.h"
#include "vision/photo/whole_file.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::set<std::string> FinishedKeys(const fs::path& out) {
  std::set<std::string> keys;
  for (const Json& row : ReadRows(out)) {
    if (row.value("status", "") != "error") keys.insert(row.value("key", ""));
  }
  return keys;
}

std::vector<Instrument> ShareOf(const CatalogPlan& plan, const Shard& shard) {
  std::vector<Instrument> share;
  for (std::size_t i = 0; i < plan.instruments.size(); ++i) {
    if (shard.Holds(static_cast<int>(i))) share.push_back(plan.instruments[i]);
  }
  return share;
}

// The curve is on the disk before its row says so.
void WriteResults(const fs::path& out,
                  const std::string& name,
                  const Analysis& analysis,
                  bool overlays) {
  const fs::path blade = out / "blades" / (name + ".blade.json");
  WriteFileWhole(blade, BladeRecordText(analysis, {name, /*times=*/false}));
  if (!overlays) return;
  for (std::size_t i = 0; i < analysis.photos.size(); ++i) {
    const std::string number = analysis.photos.size() == 1 ? "" : "." + std::to_string(i + 1);
    WritePng(out / "overlays" / (name + number + ".overlay.png"), DrawFitOverlay(analysis, i));
  }
}

Json MeasureInstrument(const fs::path& out,
                       const CatalogPlan& plan,
                       const Instrument& instrument,
                       bool overlays) {
  const RowIdentity identity = IdentityOf(plan, instrument);
  try {
    AnalysisSettings settings =
        SettingsFromFlags(FlagsFromArguments(ArgumentsFor(plan, instrument)));
    settings.num_threads = 1;  // instruments run beside each other, not the photographs of one
    settings.measure.keep_photo = overlays;
    const Analysis analysis = AnalyzeScissors(instrument.photos, settings);
    WriteResults(out, instrument.name, analysis, overlays);
    return MeasuredRow(identity, analysis);
  } catch (const PhotoRefused& refusal) {
    return RefusedRow(identity, refusal);
  } catch (const std::exception& error) {
    return ErrorRow(identity, error.what());
  }
}

void RequireValidFlags(const CatalogPlan& plan) {
  for (const Instrument& instrument : plan.instruments) {
    (void)SettingsFromFlags(FlagsFromArguments(ArgumentsFor(plan, instrument)));
  }
}

}  // namespace

CatalogRunSummary RunCatalog(const fs::path& out, const CatalogRunOptions& options) {
  const CatalogPlan plan = ReadPlan(out);
  RequireValidFlags(plan);
  fs::create_directories(out / "blades");
  if (options.overlays) fs::create_directories(out / "overlays");
  const std::set<std::string> finished = FinishedKeys(out);
  const std::vector<Instrument> share = ShareOf(plan, options.shard);
  RowWriter rows(out, options.shard);
  std::atomic<int> done = 0, already_done = 0, measured = 0, refused = 0, errors = 0;
  ParallelFor(static_cast<int>(share.size()), options.num_threads, [&](int i) {
    const Instrument& instrument = share[static_cast<std::size_t>(i)];
    if (finished.contains(RowKey(IdentityOf(plan, instrument)))) {
      ++already_done;
    } else {
      const Json row = MeasureInstrument(out, plan, instrument, options.overlays);
      rows.Append(row);
      const std::string status = row.value("status", "");
      ++(status == "refused" ? refused : status == "error" ? errors : measured);
    }
    options.progress(++done, static_cast<int>(share.size()));
  });
  return {already_done, measured, refused, errors};
}

}  // namespace bladecurve
