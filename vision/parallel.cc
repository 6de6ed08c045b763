// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <vector>

namespace bladecurve {
namespace {

// Of the machine, as far as this process may use it.
int MachineThreads() { return std::max(1, cv::getNumberOfCPUs()); }

thread_local int usable_threads = MachineThreads();

// Changes them for the lifetime of the object.
class ThreadShare {
 public:
  explicit ThreadShare(int count) : before_(usable_threads) { usable_threads = count; }
  ~ThreadShare() { usable_threads = before_; }
  ThreadShare(const ThreadShare&) = delete;
  ThreadShare& operator=(const ThreadShare&) = delete;

 private:
  int before_;
};

// In the arena of the calling thread; call(i) must not throw.
template <typename Call>
void ForEach(int count, const Call& call) {
  tbb::parallel_for(
      tbb::blocked_range<int>(0, count, 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int i = range.begin(); i < range.end(); ++i) call(i);
      },
      tbb::simple_partitioner());
}

// What calls throw, each kept until all are done.
class Errors {
 public:
  explicit Errors(int count) : errors_(static_cast<std::size_t>(count)) {}

  void Call(const std::function<void(int)>& work, int i) {
    try {
      work(i);
    } catch (...) {
      errors_[static_cast<std::size_t>(i)] = std::current_exception();
    }
  }

  void RethrowFirst() const {
    for (const std::exception_ptr& error : errors_) {
      if (error) std::rethrow_exception(error);
    }
  }

 private:
  std::vector<std::exception_ptr> errors_;
};

}  // namespace

void ParallelFor(int count, int num_threads, const std::function<void(int)>& work) {
  if (count < 1) return;
  const int threads = std::max(1, num_threads), share = std::max(1, threads / count);
  Errors errors(count);
  std::optional<tbb::global_control> more;  // than the machine has: only if asked for
  if (threads > MachineThreads()) {
    more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  tbb::task_arena(threads).execute([&] {
    ForEach(count, [&](int i) {
      const ThreadShare mine(share);
      // A call that waits for its own parts must not begin another call meanwhile.
      tbb::this_task_arena::isolate([&] { errors.Call(work, i); });
    });
  });
  errors.RethrowFirst();
}

int UsableThreads() { return usable_threads; }

void ParallelFor(int count, const std::function<void(int)>& work) {
  if (count < 1) return;
  const int share = std::max(1, usable_threads / count);
  Errors errors(count);
  ForEach(count, [&](int i) {
    const ThreadShare mine(share);
    errors.Call(work, i);
  });
  errors.RethrowFirst();
}

}  // namespace bladecurve
