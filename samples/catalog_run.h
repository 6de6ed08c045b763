// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>

#include "samples/shard.h"

namespace bladecurve {

struct CatalogRunOptions {
  Shard shard;
  int num_threads = 1;
  bool overlays = false;  // OUT/overlays/NAME.overlay.png as well
  std::function<void(int done, int all)> progress = [](int, int) {};  // called from any thread
};

struct CatalogRunSummary {
  int already_done = 0, measured = 0, refused = 0, errors = 0;
};

// Works through this shard's part of OUT/manifest.csv: what has no row yet is measured, its curve
// goes to OUT/blades/NAME.blade.json and its row to OUT/rows. One bad photograph is one row with
// its reason.
[[nodiscard]] CatalogRunSummary RunCatalog(const std::filesystem::path& out,
                                           const CatalogRunOptions& options);

}  // namespace bladecurve
