#include "base/isolated_process.h"

#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>
#include <tuple>

#include "base/process_limits.h"
#include "base/test_folder.h"

namespace parvis {
namespace {

Status repeat_backwards(std::string_view input, IsolatedOutput& output) {
  const std::span<std::byte> bytes = output.allocate(input.size());
  for (std::size_t i = 0; i < input.size(); ++i) bytes[i] = std::byte(input[input.size() - 1 - i]);
  return Ok{};
}

Status refuse(std::string_view input, IsolatedOutput&) {
  return Errors{error("{}: first", input), error("{}: second", input)};
}

Status crash(std::string_view, IsolatedOutput&) {
  raise(SIGSEGV);
  return Ok{};
}
Status give_up(std::string_view, IsolatedOutput&) { std::abort(); }
Status leave(std::string_view, IsolatedOutput&) { std::exit(0); }
Status hang(std::string_view, IsolatedOutput&) {
  for (;;) pause();
}
Status throw_it(std::string_view, IsolatedOutput&) { throw std::runtime_error("no such chunk"); }

Status take_all_memory(std::string_view, IsolatedOutput&) {
  std::vector<std::vector<char>> all;
  for (;;) all.emplace_back(std::size_t{64} << 20, 'x');
}

Status read_path(std::string_view path, IsolatedOutput& output) {
  std::ifstream stream{std::string(path)};
  std::string text;
  if (!std::getline(stream, text)) return error("cannot open {}", path);
  const std::span<std::byte> bytes = output.allocate(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return Ok{};
}

std::string text_of(const Result<IsolatedBytes>& result) {
  if (!result) return to_string(result.errors());
  return {reinterpret_cast<const char*>(result->bytes().data()), result->bytes().size()};
}

TEST(IsolatedProcess, GivesWhatTheWorkMade) {
  EXPECT_EQ(text_of(run_isolated(repeat_backwards, "parvis", "x")), "sivrap");
  const Result<IsolatedBytes> nothing = run_isolated(repeat_backwards, "", "x");
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->bytes().empty());
}

Status repeat_in_worker(std::string_view input, IsolatedOutput& output) {
  const Result<IsolatedBytes> inside = run_isolated(repeat_backwards, input, "inside");
  if (!inside) return inside.errors();
  const std::span<std::byte> bytes = output.allocate(inside->bytes().size());
  std::memcpy(bytes.data(), inside->bytes().data(), bytes.size());
  return Ok{};
}

TEST(IsolatedProcess, InnerWorkRunsInItsWorker) {
  const std::uint64_t before = begun_workers();
  EXPECT_EQ(text_of(run_isolated(repeat_in_worker, "parvis", "x")), "sivrap");
  EXPECT_EQ(begun_workers(), before + 1);
  const WithoutIsolation here;
  EXPECT_EQ(text_of(run_isolated(repeat_in_worker, "parvis", "x")), "sivrap");
  EXPECT_EQ(begun_workers(), before + 1);
}

/// Its inner work does not survive; it does.
Status outlive(std::string_view input, IsolatedOutput& output) {
  const IsolatedWork inner = input == "crash" ? crash : input == "leave" ? leave : hang;
  const Result<IsolatedBytes> inside = run_isolated(inner, "", "inside");
  const std::string said = inside ? "" : to_string(inside.errors());
  const std::span<std::byte> bytes = output.allocate(said.size());
  std::memcpy(bytes.data(), said.data(), said.size());
  return Ok{};
}

TEST(IsolatedProcess, AWorkerIsNotLostWithItsInnerWork) {
  const std::uint64_t before = begun_workers();
  for (const char* end : {"crash", "leave"}) {
    const Result<IsolatedBytes> made = run_isolated(outlive, end, "outside");
    EXPECT_NE(text_of(made).find("inside: its reader crashed"), std::string::npos) << text_of(made);
  }
  EXPECT_EQ(begun_workers(), before + 6) << "one that did not survive, and one with a worker of its own";
}

TEST(IsolatedProcess, AWorkerIsNotLostWithInnerWorkThatHangs) {
  IsolationLimits limits;
  limits.seconds = 2.0;
  const Result<IsolatedBytes> made = run_isolated(outlive, "hang", "outside", limits);
  EXPECT_NE(text_of(made).find("inside: its reader took more than 1 s"), std::string::npos) << text_of(made);
}

Status hang_after_inner_work(std::string_view, IsolatedOutput&) {
  std::ignore = run_isolated(repeat_backwards, "parvis", "inside");
  for (;;) pause();
}

TEST(IsolatedProcess, AWorkerThatHangsItselfIsNotTriedAgain) {
  const std::uint64_t before = begun_workers();
  IsolationLimits limits;
  limits.seconds = 0.5;
  const Result<IsolatedBytes> made = run_isolated(hang_after_inner_work, "", "outside", limits);
  EXPECT_NE(text_of(made).find("outside: its reader took more than"), std::string::npos) << text_of(made);
  EXPECT_EQ(begun_workers(), before + 1);
}

TEST(IsolatedProcess, AWorkerThatCrashesWithoutInnerWorkIsNotTriedAgain) {
  const std::uint64_t before = begun_workers();
  EXPECT_FALSE(run_isolated(crash, "", "x"));
  EXPECT_EQ(begun_workers(), before + 1);
}

TEST(IsolatedProcess, HandsOnEveryError) {
  const Result<IsolatedBytes> result = run_isolated(refuse, "car.dae", "car.dae");
  ASSERT_FALSE(result);
  ASSERT_EQ(result.errors().size(), 2u);
  EXPECT_EQ(result.errors()[1].message, "car.dae: second");
}

TEST(IsolatedProcess, WhatEndsAReaderIsAnErrorThatNamesTheFile) {
  for (const IsolatedWork work : {crash, give_up, leave}) {
    const Result<IsolatedBytes> result = run_isolated(work, "", "car.dae");
    ASSERT_FALSE(result);
    EXPECT_NE(text_of(result).find("car.dae: its reader crashed"), std::string::npos) << text_of(result);
  }
  EXPECT_NE(text_of(run_isolated(throw_it, "", "car.dae")).find("no such chunk"), std::string::npos);
}

TEST(IsolatedProcess, AReaderThatHangsIsEnded) {
  IsolationLimits limits;
  limits.seconds = 0.3;
  EXPECT_NE(text_of(run_isolated(hang, "", "car.dae", limits)).find("took more than"), std::string::npos);
}

TEST(IsolatedProcess, MemoryIsLimited) {
  if (has_shadow_memory) GTEST_SKIP() << "the address sanitizer needs an address space without a limit";
  IsolationLimits limits;
  limits.memory_bytes = std::uint64_t{512} << 20;
  EXPECT_NE(text_of(run_isolated(take_all_memory, "", "car.dae", limits)).find("needs more than"),
            std::string::npos);
}

TEST(IsolatedProcess, OpensOnlyWhatTheCallNames) {
  const TestFolder folder;
  folder.write("inside/a.txt", "inside");
  folder.write("outside.txt", "outside");
  IsolationLimits limits;
  limits.readable = {folder.path() / "inside"};
  EXPECT_EQ(text_of(run_isolated(read_path, (folder.path() / "inside/a.txt").string(), "x", limits)),
            "inside");
  const auto of_outside = [&] {
    return text_of(run_isolated(read_path, (folder.path() / "outside.txt").string(), "x", limits));
  };
  if (syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) <= 0)
    GTEST_SKIP() << "this kernel has no Landlock";
  EXPECT_NE(of_outside().find("cannot open"), std::string::npos);
  limits.readable.push_back(folder.path() / "outside.txt");
  EXPECT_EQ(of_outside(), "outside") << "the limit alone keeps the file closed";
}

TEST(IsolatedProcess, ManyThreadsMayCallAtOnce) {
  std::atomic<int> right = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 10; ++i) right += text_of(run_isolated(repeat_backwards, "abc", "x")) == "cba";
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 80);
}

}  // namespace
}  // namespace parvis
