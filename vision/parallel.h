// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace bladecurve {

// Calls work(0) .. work(count - 1), each once, on up to num_threads threads (this one included),
// and returns when all are done. The order of the calls is open. If calls throw, the exception of
// the lowest index is rethrown, so that the outcome does not depend on the number of threads.
// Threads that are left over are shared out: each call may use its part of them.
void ParallelFor(int count, int num_threads, const std::function<void(int)>& work);

// How many threads the work of this one may use: those that the ParallelFor it works for leaves it,
// or all of the machine's. So photographs measured beside each other do not split their own work.
[[nodiscard]] int UsableThreads();

// ParallelFor on all usable threads.
void ParallelFor(int count, const std::function<void(int)>& work);

}  // namespace bladecurve
