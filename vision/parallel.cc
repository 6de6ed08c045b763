// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <opencv2/core/utility.hpp>
#include <thread>
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

}  // namespace

void ParallelFor(int count, int num_threads, const std::function<void(int)>& work) {
  if (count < 1) return;
  const int workers = std::clamp(num_threads, 1, count);
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(count));
  std::atomic<int> next = 0;
  const auto take_turns = [&] {
    const ThreadShare share(std::max(1, num_threads / workers));
    for (int i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        errors[static_cast<std::size_t>(i)] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int t = 1; t < workers; ++t) helpers.emplace_back(take_turns);
    take_turns();
  }
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

int UsableThreads() { return usable_threads; }

void ParallelFor(int count, const std::function<void(int)>& work) {
  ParallelFor(count, usable_threads, work);
}

}  // namespace bladecurve
