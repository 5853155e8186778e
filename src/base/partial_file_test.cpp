#include "base/partial_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "base/files.h"
#include "base/test_folder.h"

namespace parvis {
namespace {
namespace fs = std::filesystem;

std::size_t count_of(const fs::path& folder) {
  return std::size_t(std::distance(fs::directory_iterator(folder), {}));
}

/// Ends a child process that writes a file and a folder by the signal `number`; returns its status.
int ended_by(int number, const fs::path& folder) {
  const pid_t child = fork();
  if (child == 0) {
    remove_partial_files_on_signals();
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDERR_FILENO);
    const Result<PartialFile> file = PartialFile::create(folder / "out.txt");
    const Result<PartialFolder> inner = PartialFolder::create(folder);
    const bool is_made = file && inner && file->write("half") && write_file(inner->path() / "one", "1") &&
                         write_file(inner->path() / "two", "2");
    if (is_made) raise(number);
    _exit(77);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(PartialFile, TakesItsPlaceWhenKeptAndGoesElse) {
  const TestFolder folder;
  folder.write("out.txt", "old");
  {
    const Result<PartialFile> dropped = PartialFile::create(folder.path() / "out.txt");
    ASSERT_TRUE(dropped && dropped->write("new"));
    EXPECT_EQ(count_of(folder.path()), 2u);
  }
  EXPECT_EQ(*read_file(folder.path() / "out.txt"), "old");
  EXPECT_EQ(count_of(folder.path()), 1u);
  Result<PartialFile> kept = PartialFile::create(folder.path() / "out.txt");
  ASSERT_TRUE(kept && kept->write("new") && kept->keep());
  EXPECT_EQ(*read_file(folder.path() / "out.txt"), "new");
}

TEST(PartialFile, SignalsThatCanBeHeardRemoveFilesAndFolders) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const TestFolder folder;
    folder.write("out.txt", "old");
    const int status = ended_by(number, folder.path());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status;
    EXPECT_EQ(count_of(folder.path()), 1u) << number;
    EXPECT_EQ(*read_file(folder.path() / "out.txt"), "old");
  }
}

/// A child process whose threads write into folders that they make again and again, ended after a while.
int ended_while_writing(int after_us, const fs::path& folder) {
  sigset_t term;
  sigemptyset(&term), sigaddset(&term, SIGTERM);
  sigprocmask(SIG_BLOCK, &term, nullptr);  // until the child listens
  const pid_t child = fork();
  if (child == 0) {
    remove_partial_files_on_signals();
    sigprocmask(SIG_UNBLOCK, &term, nullptr);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDERR_FILENO);
    constexpr int count = 4;
    std::vector<std::thread> writers;
    writers.reserve(count);
    for (int writer = 0; writer < count; ++writer)
      writers.emplace_back([&] {
        for (;;) {
          const Result<PartialFolder> inner = PartialFolder::create(folder);
          for (int file = 0; inner && file < 8; ++file)
            std::ignore = write_file(inner->path() / std::to_string(file), "1");
        }
      });
    pause();
  }
  sigprocmask(SIG_UNBLOCK, &term, nullptr);
  usleep(useconds_t(after_us));
  kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(PartialFile, ASignalLeavesNothingOfThreadsThatGoOnWriting) {
  const TestFolder folder;
  for (int time = 0; time < 60; ++time) {
    const int status = ended_while_writing(3000 + 311 * time, folder.path());
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status;
    ASSERT_EQ(count_of(folder.path()), 0u) << time;
  }
}

TEST(PartialFile, WhatAKilledProgramHasLeftIsRemovedByTheNext) {
  const TestFolder folder;
  folder.write("out.txt", "old");
  folder.write(".partial-s-out.txt", "somebody's own");
  const int status = ended_by(SIGKILL, folder.path());
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_EQ(count_of(folder.path()), 4u);
  ASSERT_TRUE(write_file(folder.path() / "out.txt", "new"));
  EXPECT_EQ(count_of(folder.path()), 3u) << "the folder is left";
  { ASSERT_TRUE(PartialFolder::create(folder.path())); }
  EXPECT_EQ(count_of(folder.path()), 2u);
  EXPECT_EQ(*read_file(folder.path() / ".partial-s-out.txt"), "somebody's own");
}

TEST(PartialFile, TwoWritersOfOneFileLeaveEachOtherAlone) {
  const TestFolder folder;
  Result<PartialFile> first = PartialFile::create(folder.path() / "out.txt"),
                      second = PartialFile::create(folder.path() / "out.txt");
  ASSERT_TRUE(first && second);
  ASSERT_TRUE(first->write("first") && second->write("second"));
  EXPECT_TRUE(second->keep() && first->keep());
  EXPECT_EQ(*read_file(folder.path() / "out.txt"), "first");
  EXPECT_EQ(count_of(folder.path()), 1u);
}

}  // namespace
}  // namespace parvis
