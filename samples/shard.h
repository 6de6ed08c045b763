// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace bladecurve {

// One of `count` shares of a catalog; index 1 .. count.
struct Shard {
  int index = 1, count = 1;
  // Items are dealt like cards: item k (from 0) belongs to shard k mod count + 1.
  [[nodiscard]] bool Holds(int item) const { return item % count == index - 1; }
};

// "i/N". Throws std::invalid_argument unless 1 <= i <= N.
[[nodiscard]] Shard ParseShard(const std::string& text);

// The share of this process as the cluster states it in the environment: a Slurm job array or step,
// a Kubernetes indexed job, an MPI rank, a GNU Parallel job. Kubernetes and GNU Parallel give no
// count: it is then taken from BLADECURVE_SHARDS. std::nullopt where nothing is stated.
// `environment` returns a variable's value, or nothing. Throws std::invalid_argument for nonsense.
[[nodiscard]] std::optional<Shard> ShardFromEnvironment(
    const std::function<std::optional<std::string>(const char*)>& environment);

}  // namespace bladecurve
