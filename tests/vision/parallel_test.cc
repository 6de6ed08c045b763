// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace bladecurve {
namespace {

// The threads on which `inner` calls run, asked for from within `outer` calls on num_threads.
std::set<std::thread::id> ThreadsWithin(int outer, int num_threads, int inner) {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  ParallelFor(outer, num_threads, [&](int) {
    ParallelFor(inner, [&](int) {
      const std::lock_guard lock(mutex);
      threads.insert(std::this_thread::get_id());
    });
  });
  return threads;
}

TEST(ParallelFor, CallsEachOnceWhateverTheThreads) {
  for (const int threads : {1, 2, 7, 100}) {
    std::vector<int> calls(50, 0);
    ParallelFor(50, threads, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(calls, std::vector<int>(50, 1)) << threads << " threads";
  }
}

TEST(ParallelFor, RethrowsTheFirstByIndex) {
  for (const int threads : {1, 4}) {
    try {
      ParallelFor(20, threads, [](int i) {
        if (i % 7 == 3) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3") << threads << " threads";
    }
  }
}

TEST(ParallelFor, WorkWithinOneThreadIsNotSplit) {
  EXPECT_EQ(ThreadsWithin(3, 1, 20), std::set{std::this_thread::get_id()});
}

TEST(ParallelFor, WorkWithinManyThreadsUsesNoMoreThanThose) {
  for (const int threads : {2, 3}) {
    EXPECT_LE(ThreadsWithin(20, threads, 20).size(), static_cast<std::size_t>(threads));
  }
}

TEST(ParallelFor, LeftOverThreadsAreSharedOut) {
  // Four calls that wait for each other: done only if each has a thread of its own.
  std::mutex mutex;
  std::set<std::thread::id> threads;
  ParallelFor(1, 4, [&](int) {
    ParallelFor(4, [&](int) {
      {
        const std::lock_guard lock(mutex);
        threads.insert(std::this_thread::get_id());
      }
      const auto all_here = [&] {
        const std::lock_guard lock(mutex);
        return threads.size() == 4;
      };
      while (!all_here()) std::this_thread::yield();
    });
  });
  EXPECT_EQ(threads.size(), 4u);
}

TEST(ParallelAside, CallsBothWhateverTheThreads) {
  for (const int threads : {1, 2, 5}) {
    std::atomic<int> works = 0, asides = 0;
    ParallelFor(10, threads, [&](int) {
      ParallelAside([&] { ParallelFor(3, [&](int) { ++works; }); }, [&] { ++asides; });
    });
    EXPECT_EQ(works, 30) << threads << " threads";
    EXPECT_EQ(asides, 10) << threads << " threads";
  }
}

TEST(ParallelAside, RethrowsTheErrorOfTheWorkFirst) {
  const auto fail = [](const std::string& cause) {
    return [cause] { throw std::runtime_error(cause); };
  };
  const auto caught = [](const std::function<void()>& work, const std::function<void()>& aside) {
    try {
      ParallelAside(work, aside);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(caught(fail("work"), fail("aside")), "work");
  EXPECT_EQ(caught(fail("work"), [] {}), "work");
  EXPECT_EQ(caught([] {}, fail("aside")), "aside");
}

TEST(ParallelAside, WorkWithinOneThreadStaysOnIt) {
  ParallelFor(1, 1, [&](int) {
    std::thread::id aside;
    ParallelAside([] {}, [&] { aside = std::this_thread::get_id(); });
    EXPECT_EQ(aside, std::this_thread::get_id());
  });
}

}  // namespace
}  // namespace bladecurve
