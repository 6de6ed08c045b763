// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace bladecurve {

// Calls work(0) .. work(count - 1), each once, on up to num_threads threads (this one included),
// and returns when all are done. The order of the calls is open. If calls throw, the exception of
// the lowest index is rethrown, so that the outcome does not depend on the number of threads.
// Threads that have no call left to begin help with the parts into which the others split theirs.
void ParallelFor(int count, int num_threads, const std::function<void(int)>& work);

// The same for parts of such a call, on those of its threads that are idle then; outside of any, on
// all of the machine's. So photographs measured beside each other leave each other their threads.
void ParallelFor(int count, const std::function<void(int)>& work);

// Calls both and returns when both are done: `aside` on a thread of the machine that is idle
// meanwhile, even if work's parts leave it so for a moment only, or after `work`; there too where
// this work has one thread. If both throw, the exception of `work` is rethrown.
void ParallelAside(const std::function<void()>& work, const std::function<void()>& aside);

// work(first, last) for bands of rows that together are [0, rows), by that ParallelFor; each of
// `band` rows, or, of pictures, as high as is worth a thread, the last one perhaps less.
void ParallelForBands(int rows, int band, const std::function<void(int, int)>& work);
void ParallelForBands(int rows, const std::function<void(int, int)>& work);

// make(0) .. make(count - 1), made by that ParallelFor.
template <typename Make>
[[nodiscard]] auto ParallelMap(int count, const Make& make) {
  std::vector<std::invoke_result_t<const Make&, int>> made(static_cast<std::size_t>(count));
  ParallelFor(count, [&](int i) { made[static_cast<std::size_t>(i)] = make(i); });
  return made;
}

// How many threads are this work's for certain: its part of those of the ParallelFor that it works
// for, or all of the machine's.
[[nodiscard]] int UsableThreads();

}  // namespace bladecurve
