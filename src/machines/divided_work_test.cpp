#include "machines/divided_work.h"

#include <gtest/gtest.h>

#include <mutex>
#include <numeric>
#include <set>

#include "machines/test_processes.h"

namespace parvis::machines {
namespace {

Tasks numbers(std::uint32_t count) {
  Tasks tasks(count);
  std::iota(tasks.begin(), tasks.end(), 0u);
  return tasks;
}

TEST(DividedWork, EveryTaskIsRunOnceAndItsResultKept) {
  for (const bool uses_threads : {false, true}) {
    std::multiset<std::uint32_t> kept;
    DividedWork work;
    work.uses_threads = uses_threads;
    work.run = [](std::uint32_t task) -> Result<std::string> { return std::to_string(3 * task); };
    work.keep = [&](std::uint32_t task, std::string_view result) -> Status {
      EXPECT_EQ(result, std::to_string(3 * task));
      kept.insert(task);
      return Ok{};
    };
    const Result<std::size_t> count = divide({}, numbers(1000), work);
    ASSERT_TRUE(count);
    EXPECT_EQ(*count, 1000u);
    EXPECT_EQ(kept.size(), 1000u);
    EXPECT_EQ(std::set<std::uint32_t>(kept.begin(), kept.end()).size(), 1000u);
  }
}

TEST(DividedWork, TasksOfOneThreadComeInOrder) {
  Tasks begun;
  DividedWork work;
  work.uses_threads = false;
  work.run = [&](std::uint32_t task) -> Result<std::string> {
    begun.push_back(task);
    return std::string();
  };
  work.keep = [](std::uint32_t, std::string_view) -> Status { return Ok{}; };
  const Tasks to_do{4, 9, 2, 30};
  ASSERT_TRUE(divide({}, to_do, work));
  EXPECT_EQ(begun, to_do);
}

TEST(DividedWork, NothingToDoIsDone) {
  const Result<std::size_t> count = divide({}, {}, {});
  ASSERT_TRUE(count);
  EXPECT_EQ(*count, 0u);
}

TEST(DividedWork, TheErrorOfATaskOrOfKeepingEndsIt) {
  for (const bool fails_to_keep : {false, true}) {
    std::atomic<int> runs = 0;
    DividedWork work;
    work.uses_threads = false;
    work.run = [&](std::uint32_t task) -> Result<std::string> {
      ++runs;
      if (!fails_to_keep && task == 5) return error("task {} fails", task);
      return std::string("result");
    };
    work.keep = [&](std::uint32_t task, std::string_view) -> Status {
      if (fails_to_keep && task == 5) return error("task {} is not kept", task);
      return Ok{};
    };
    const Result<std::size_t> count = divide({}, numbers(100), work);
    ASSERT_FALSE(count);
    EXPECT_NE(count.errors().front().message.find("task 5"), std::string::npos);
    EXPECT_EQ(runs, 6);
  }
}

TEST(DividedWork, InterruptedItSaysHowManyAreKept) {
  std::atomic<bool> is_interrupted = false;
  DividedWork work;
  work.uses_threads = false;
  work.is_interrupted = &is_interrupted;
  work.run = [&](std::uint32_t task) -> Result<std::string> {
    is_interrupted = task == 7;
    return std::string();
  };
  work.keep = [](std::uint32_t, std::string_view) -> Status { return Ok{}; };
  const Result<std::size_t> count = divide({}, numbers(100), work);
  ASSERT_TRUE(count);
  EXPECT_EQ(*count, 8u);
}

TEST(Processes, WithoutMpirunThereIsOne) {
  const Processes alone;
  EXPECT_TRUE(alone.is_first());
  EXPECT_FALSE(alone.are_several());
  EXPECT_TRUE(alone.has(0) && alone.has(1));
  std::string bytes = "as they are";
  alone.share_of_first(bytes);
  EXPECT_EQ(bytes, "as they are");
  std::vector<float> values{1.0f, 2.0f};
  alone.sum(values);
  EXPECT_EQ(values, (std::vector<float>{1.0f, 2.0f}));
  EXPECT_TRUE(alone.any_of(true));
  EXPECT_FALSE(alone.any_of(false));
  alone.wait_for_all();
  alone.leave();
}

TEST(Processes, TogetherTheyShareAndAddUp) {
  const auto found = in_two_processes([](const Processes& process) {
    std::string bytes = process.is_first() ? "of the first" : "another";
    process.share_of_first(bytes);
    std::array<double, 2> values{1.0 + process.rank(), 5.0};
    process.sum(std::span<double>(values));
    EXPECT_EQ(values, (std::array{3.0, 10.0}));
    EXPECT_TRUE(process.any_of(process.rank() == 1));
    EXPECT_FALSE(process.any_of(false));
    return bytes;
  });
  EXPECT_EQ(found, (std::array<std::string, 2>{"of the first", "of the first"}));
}

}  // namespace
}  // namespace parvis::machines
