// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/shard.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "samples/flag_values.h"

namespace bladecurve {
namespace {

// Where a cluster writes which share a process is. `first` names the variable of the lowest index,
// or the index itself.
struct Convention {
  const char* index;
  const char* count;
  const char* first;  // variable, may be unset
  int default_first;
};

constexpr std::array<Convention, 6> kConventions = {{
    {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN", 0},
    {"JOB_COMPLETION_INDEX", "BLADECURVE_SHARDS", nullptr, 0},
    {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", nullptr, 0},
    {"PMI_RANK", "PMI_SIZE", nullptr, 0},
    {"SLURM_PROCID", "SLURM_NTASKS", nullptr, 0},
    {"PARALLEL_SEQ", "BLADECURVE_SHARDS", nullptr, 1},
}};

Shard CheckedShard(int index, int count, const std::string& source) {
  if (count < 1 || index < 1 || index > count) {
    throw std::invalid_argument(fmt::format(
        "{}: share {} of {} cannot be; shares run from 1 to the count", source, index, count));
  }
  return {index, count};
}

}  // namespace

Shard ParseShard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) {
    throw std::invalid_argument(fmt::format("--shard: wants i/N, got '{}'", text));
  }
  return CheckedShard(ParseWholeNumber("--shard", text.substr(0, slash)),
                      ParseWholeNumber("--shard", text.substr(slash + 1)),
                      "--shard");
}

std::optional<Shard> ShardFromEnvironment(
    const std::function<std::optional<std::string>(const char*)>& environment) {
  for (const Convention& convention : kConventions) {
    const auto index = environment(convention.index);
    const auto count = environment(convention.count);
    if (!index || !count) continue;
    const auto stated = convention.first ? environment(convention.first) : std::nullopt;
    const int first =
        stated ? ParseWholeNumber(convention.first, *stated) : convention.default_first;
    return CheckedShard(ParseWholeNumber(convention.index, *index) - first + 1,
                        ParseWholeNumber(convention.count, *count),
                        convention.index);
  }
  return std::nullopt;
}

}  // namespace bladecurve
