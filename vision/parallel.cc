// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

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

// What a call throws, if anything.
std::exception_ptr ErrorOf(const std::function<void()>& call) {
  try {
    call();
  } catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

// In the arena of the calling thread; each call may use its part of num_threads for certain.
void CallEach(int count, int num_threads, const std::function<void(int)>& work) {
  const int share = std::max(1, num_threads / count);
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(count));
  const auto call = [&](int i) {
    const ThreadShare mine(share);
    errors[static_cast<std::size_t>(i)] = ErrorOf([&] { work(i); });
  };
  tbb::parallel_for(
      tbb::blocked_range<int>(0, count, 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int i = range.begin(); i < range.end(); ++i) call(i);
      },
      tbb::simple_partitioner());
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace

void ParallelFor(int count, int num_threads, const std::function<void(int)>& work) {
  if (count < 1) return;
  const int threads = std::max(1, num_threads);
  std::optional<tbb::global_control> more;  // than the machine has: only if asked for
  if (threads > MachineThreads()) {
    more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  tbb::task_arena(threads).execute([&] {
    CallEach(count, threads, [&](int i) {
      // A call that waits for its own parts must not begin another call meanwhile.
      tbb::this_task_arena::isolate([&] { work(i); });
    });
  });
}

void ParallelFor(int count, const std::function<void(int)>& work) {
  if (count > 0) CallEach(count, usable_threads, work);
}

void ParallelAside(const std::function<void()>& work, const std::function<void()>& aside) {
  if (usable_threads < 2) {
    work();
    aside();
    return;
  }
  tbb::task_arena idle(1, 0, tbb::task_arena::priority::low);
  tbb::task_group group;
  std::exception_ptr of_aside;
  idle.execute([&] { group.run([&] { of_aside = ErrorOf(aside); }); });
  const std::exception_ptr of_work = ErrorOf(work);
  idle.execute([&] { group.wait(); });
  if (of_work) std::rethrow_exception(of_work);
  if (of_aside) std::rethrow_exception(of_aside);
}

void ParallelForBands(int rows, int band, const std::function<void(int, int)>& work) {
  ParallelFor((rows + band - 1) / band,
              [&](int i) { work(i * band, std::min((i + 1) * band, rows)); });
}

void ParallelForBands(int rows, const std::function<void(int, int)>& work) {
  constexpr int kBand = 128;
  ParallelForBands(rows, kBand, work);
}

int UsableThreads() { return usable_threads; }

}  // namespace bladecurve
