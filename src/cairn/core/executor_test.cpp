// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/executor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr std::size_t kCount = 200;

std::vector<std::size_t> numbers_below(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

/// Later items are ready first, so that order has to be made.
void work_unevenly(std::size_t i) {
  std::this_thread::sleep_for(std::chrono::microseconds(i % 4 == 0 ? 300 : 10));
}

class ExecutorTest : public testing::TestWithParam<int> {
 protected:
  const Executor executor_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Threads, ExecutorTest, testing::Values(1, 2, 3, 4),
                         [](const auto& instance) { return "threads_" + std::to_string(instance.param); });

TEST_P(ExecutorTest, for_each_visits_every_item_once) {
  std::vector<std::atomic<int>> visits(kCount);
  executor_.for_each(kCount, [&](std::size_t i) { ++visits[i]; });
  EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](const auto& v) { return v == 1; }));
}

TEST_P(ExecutorTest, for_each_of_nothing_does_nothing) {
  executor_.for_each(0, [](std::size_t) { FAIL(); });
}

TEST_P(ExecutorTest, for_each_rethrows) {
  EXPECT_THROW(executor_.for_each(kCount,
                                  [](std::size_t i) {
                                    if (i == 17) throw std::runtime_error("17");
                                  }),
               std::runtime_error);
}

TEST_P(ExecutorTest, chunks_cover_all_items_whatever_the_number_of_threads) {
  std::mutex mutex;
  std::set<std::pair<std::size_t, std::size_t>> chunks;
  executor_.for_each_chunk(10, 4, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock(mutex);
    chunks.emplace(begin, end);
  });
  EXPECT_EQ(chunks, (std::set<std::pair<std::size_t, std::size_t>>{{0, 4}, {4, 8}, {8, 10}}));
}

TEST_P(ExecutorTest, chunks_need_a_grain) {
  EXPECT_THROW(executor_.for_each_chunk(10, 0, [](std::size_t, std::size_t) {}), PreconditionError);
}

TEST_P(ExecutorTest, map_keeps_the_order) {
  const auto results = executor_.map<std::size_t>(kCount, [](std::size_t i) {
    work_unevenly(i);
    return i;
  });
  EXPECT_EQ(results, numbers_below(kCount));
}

TEST_P(ExecutorTest, loops_may_be_nested) {
  std::atomic<int> visits = 0;
  executor_.for_each(8, [&](std::size_t) { executor_.for_each(8, [&](std::size_t) { ++visits; }); });
  EXPECT_EQ(visits, 64);
}

TEST_P(ExecutorTest, pipeline_consumes_in_order) {
  std::vector<std::size_t> consumed;
  executor_.ordered_pipeline<std::string>(
      kCount,
      [](std::size_t i) {
        work_unevenly(i);
        return std::to_string(i);
      },
      [&](std::size_t i, std::string&& item) {
        EXPECT_EQ(item, std::to_string(i));
        consumed.push_back(i);
        return true;
      });
  EXPECT_EQ(consumed, numbers_below(kCount));
}

TEST_P(ExecutorTest, pipeline_of_nothing_does_nothing) {
  executor_.ordered_pipeline<int>(
      0, [](std::size_t) { return 0; }, [](std::size_t, int&&) { return ADD_FAILURE(), false; });
}

TEST_P(ExecutorTest, pipeline_holds_few_items_at_a_time) {
  struct Counted {
    explicit Counted(std::atomic<int>& count) : alive(&count) { ++*alive; }
    Counted(Counted&& other) noexcept : alive(std::exchange(other.alive, nullptr)) {}
    Counted& operator=(Counted&&) = delete;
    ~Counted() {
      if (alive != nullptr) --*alive;
    }
    std::atomic<int>* alive;
  };
  std::atomic<int> alive = 0;
  int most = 0;
  executor_.ordered_pipeline<Counted>(
      kCount, [&](std::size_t) { return Counted(alive); },
      [&](std::size_t, Counted&&) {
        most = std::max(most, alive.load());
        return true;
      });
  EXPECT_LE(most, 2 * GetParam());
  EXPECT_EQ(alive, 0);
}

TEST_P(ExecutorTest, pipeline_stops_when_the_consumer_says_so) {
  std::atomic<std::size_t> produced = 0;
  std::vector<std::size_t> consumed;
  executor_.ordered_pipeline<std::size_t>(
      kCount, [&](std::size_t i) { return ++produced, i; },
      [&](std::size_t i, std::size_t&&) {
        consumed.push_back(i);
        return i < 5;
      });
  EXPECT_EQ(consumed, numbers_below(6));
  EXPECT_LE(produced, 6U + 2U * static_cast<std::size_t>(GetParam()));
}

TEST_P(ExecutorTest, pipeline_rethrows_what_the_consumer_throws) {
  EXPECT_THROW(executor_.ordered_pipeline<int>(
                   kCount, [](std::size_t) { return 0; },
                   [](std::size_t i, int&&) -> bool {
                     if (i == 9) throw std::runtime_error("9");
                     return true;
                   }),
               std::runtime_error);
}

/// At any number of threads: what is before the failure is consumed, the first failure in order is thrown.
TEST_P(ExecutorTest, pipeline_rethrows_the_producers_failure_in_its_turn) {
  std::vector<std::size_t> consumed;
  try {
    executor_.ordered_pipeline<int>(
        kCount,
        [](std::size_t i) -> int {
          if (i == 20) std::this_thread::sleep_for(std::chrono::milliseconds(5));
          if (i >= 20) throw std::runtime_error(std::to_string(i));
          return 0;
        },
        [&](std::size_t i, int&&) {
          consumed.push_back(i);
          return true;
        });
    ADD_FAILURE() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "20");
  }
  EXPECT_EQ(consumed, numbers_below(20));
}

TEST_P(ExecutorTest, pipeline_that_stops_before_a_failure_does_not_throw) {
  EXPECT_NO_THROW(executor_.ordered_pipeline<int>(
      kCount,
      [](std::size_t i) -> int {
        if (i == 10) throw std::runtime_error("10");
        return 0;
      },
      [](std::size_t i, int&&) { return i < 9; }));
}

TEST_P(ExecutorTest, a_task_is_done_when_it_was_waited_for) {
  int result = 0;
  Executor::Task task = executor_.start([&] { result = 42; });
  task.wait();
  EXPECT_EQ(result, 42);
}

TEST_P(ExecutorTest, a_task_rethrows_when_it_is_waited_for) {
  Executor::Task task = executor_.start([] { throw std::runtime_error("task"); });
  EXPECT_THROW(task.wait(), std::runtime_error);
}

/// So that what it uses may go, too. Alone it has not begun, and does not begin.
TEST_P(ExecutorTest, a_task_that_nobody_waits_for_is_over_when_it_goes) {
  bool begun = false, done = false;
  {
    const Executor::Task task = executor_.start([&] {
      begun = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      done = true;
    });
  }
  EXPECT_EQ(begun, GetParam() > 1);
  EXPECT_EQ(done, begun);
}

TEST_P(ExecutorTest, a_task_that_throws_may_go_without_being_waited_for) {
  EXPECT_NO_THROW((void)executor_.start([] { throw std::runtime_error("lost"); }));
}

TEST_P(ExecutorTest, a_task_may_be_moved) {
  int result = 0;
  Executor::Task task = executor_.start([&] { result = 1; });
  Executor::Task moved = std::move(task);
  moved.wait();
  EXPECT_EQ(result, 1);
}

/// As the adjustment of the map runs beside tracking: begun at one item, waited for some items later.
TEST_P(ExecutorTest, a_task_may_run_beside_a_pipeline) {
  std::size_t sum = 0, expected = 0;
  std::size_t last = 0;
  std::optional<Executor::Task> task;
  const auto consume = [&](std::size_t i, std::size_t&& item) {
    EXPECT_EQ(item, i);
    if (i % 4 != 0) return true;
    if (task) {
      task->wait();
      expected += last;
      EXPECT_EQ(sum, expected);
    }
    last = i;
    task.emplace(executor_.start([&sum, i] {
      work_unevenly(i);
      sum += i;
    }));
    return true;
  };
  executor_.ordered_pipeline<std::size_t>(
      kCount, [](std::size_t i) { return work_unevenly(i), i; }, consume);
  ASSERT_TRUE(task.has_value());
  task->wait();
  EXPECT_EQ(sum, expected + last);
}

TEST_P(ExecutorTest, a_task_may_hold_loops) {
  std::atomic<int> visits = 0;
  Executor::Task task = executor_.start([&] { executor_.for_each(8, [&](std::size_t) { ++visits; }); });
  executor_.for_each(8, [&](std::size_t) { ++visits; });
  task.wait();
  EXPECT_EQ(visits, 16);
}

TEST(Executor, needs_a_thread) {
  EXPECT_THROW(Executor(0), PreconditionError);
}

/// 0.1, 0.2, 0.3 ... summed in chunks: one bit pattern, because results are stored by item.
TEST(Executor, ordered_sums_do_not_depend_on_the_number_of_threads) {
  const auto sum = [](int threads) {
    const Executor executor(threads);
    const auto parts = executor.map<float>(1000, [](std::size_t i) { return 0.1F * static_cast<float>(i); });
    return std::accumulate(parts.begin(), parts.end(), 0.0F);
  };
  EXPECT_EQ(sum(1), sum(2));
  EXPECT_EQ(sum(1), sum(4));
}

}  // namespace
}  // namespace cairn
