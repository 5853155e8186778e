#include "planning/study/log.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/files.h"
#include "base/test_folder.h"

namespace parvis::study {
namespace {

Frame frame_at(std::int64_t time_us) {
  Frame frame{time_us, 1.0 / 60.0, 0.1f, {}, glm::vec3(1.25f, -3.0f, 0.1f)};
  frame.eye.world_from_camera = look_at({0.1f, -7.3f, 1.7f}, {0.0f, 0.0f, 1.0f});
  return frame;
}

void run_sql(const std::filesystem::path& file, const char* sql, int expected = SQLITE_OK) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), expected) << sql;
  sqlite3_close(database);
}

class LogTest : public ::testing::Test {
 protected:
  /// A log with a session of P1 of two events and a frame.
  void SetUp() override {
    Result<Log> log = Log::open(file_);
    ASSERT_TRUE(log) << to_string(log.errors());
    const Result<LoggedSession> session = log->begin({0, "P1", "s", "study()", 1, 12.5});
    ASSERT_TRUE(session) << to_string(session.errors());
    for (const Record& record : records_) log->add(record);
    const Status status = log->flush();
    ASSERT_TRUE(status) << to_string(status.errors());
  }
  std::string problem() const {
    const Result<Log> log = Log::read(file_);
    return log ? "" : to_string(log.errors());
  }

  TestFolder folder_;
  std::filesystem::path file_ = folder_.path() / "s.sqlite";
  std::vector<Record> records_{Event{0, "part", "0 left calm"}, frame_at(16'667),
                               Event{20'000, "note", "\"é\"\n"}};
};

TEST_F(LogTest, GivesBackWhatWasPutIn) {
  const Result<Log> log = Log::read(file_);
  ASSERT_TRUE(log) << to_string(log.errors());
  const auto session = log->session_of("P1");
  ASSERT_TRUE(session && *session);
  EXPECT_EQ((*session)->row, 1);
  EXPECT_EQ((*session)->clock_s, 12.5);
  const auto records = log->records((*session)->id);
  ASSERT_TRUE(records) << to_string(records.errors());
  EXPECT_EQ(*records, records_);
  EXPECT_FALSE(*log->session_of("P2"));
}

TEST_F(LogTest, HasOneSessionOfEachParticipant) {
  Result<Log> log = Log::open(file_);
  ASSERT_TRUE(log);
  EXPECT_NE(to_string(log->begin({0, "P1", "s", "", 0, 0.0}).errors()).find("has a session"),
            std::string::npos);
  EXPECT_FALSE(log->begin({0, "Anna Miller", "s", "", 0, 0.0})) << "no names";
  EXPECT_TRUE(log->begin({0, "P2", "s", "", 0, 0.0}));
}

TEST_F(LogTest, IsOnlyAppendedTo) {
  run_sql(file_, "UPDATE event SET text='other'", SQLITE_CONSTRAINT);
  run_sql(file_, "DELETE FROM frame", SQLITE_CONSTRAINT);
}

TEST_F(LogTest, ForgetsAParticipantWithAllBytes) {
  {
    Result<Log> log = Log::open(file_);
    ASSERT_TRUE(log && log->begin({0, "P2", "s", "", 0, 0.0}));
    log->add(Event{5, "note", "the secret of P2"});
    ASSERT_TRUE(log->flush());
    EXPECT_FALSE(log->forget("P3"));
    const Status status = log->forget("P2");
    ASSERT_TRUE(status) << to_string(status.errors());
    EXPECT_EQ(log->sessions()->size(), 1u);
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    EXPECT_EQ(read_file(entry.path())->find("secret"), std::string::npos) << entry.path();
  run_sql(file_, "DELETE FROM event", SQLITE_CONSTRAINT);
}

TEST_F(LogTest, OfAnotherVersionIsRefused) {
  run_sql(file_, "PRAGMA user_version=7");
  EXPECT_NE(problem().find("is of version 7"), std::string::npos) << problem();
}

TEST_F(LogTest, ThatIsCutOrNoLogIsRefused) {
  std::filesystem::resize_file(file_, std::filesystem::file_size(file_) / 2);
  EXPECT_NE(problem().find("damaged or cut"), std::string::npos) << problem();
  folder_.write("s.sqlite", std::string(5000, 'x'));
  EXPECT_NE(problem().find("damaged or cut"), std::string::npos) << problem();
  std::filesystem::remove(file_);
  EXPECT_NE(problem().find("no log"), std::string::npos) << problem();
  run_sql(file_, "CREATE TABLE t(a)");
  EXPECT_NE(problem().find("no log of a study"), std::string::npos) << problem();
}

TEST_F(LogTest, HoldsWhatAFullDiskRefusesAndWritesItLater) {
  Result<Log> log = Log::open(file_);
  ASSERT_TRUE(log && log->begin({0, "P2", "s", "", 0, 0.0}));
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{4096, before.rlim_max};  // fails as a full disk does
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  for (int i = 0; i < 50; ++i) log->add(Event{i, "note", std::string(200, 'x')});
  const Status full = log->flush();
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(full);
  EXPECT_NE(to_string(full.errors()).find("make room"), std::string::npos) << to_string(full.errors());
  EXPECT_EQ(log->held(), 50u);
  log->add(Event{50, "note", "later"});
  const Status status = log->flush();
  ASSERT_TRUE(status) << to_string(status.errors());
  EXPECT_EQ(log->records((*log->session_of("P2"))->id)->size(), 51u);
}

TEST_F(LogTest, KeepsWhatWasAcknowledgedWhenItsWriterIsKilled) {
  int pipes[2];
  ASSERT_EQ(pipe(pipes), 0);
  const pid_t child = fork();
  if (child == 0) {
    Result<Log> log = Log::open(file_);
    if (!log || !log->begin({0, "P2", "s", "", 0, 0.0})) _exit(1);
    for (int i = 0;; ++i) {
      log->add(Event{i, "note", "kept"});
      if (!log->flush() || write(pipes[1], "x", 1) != 1) _exit(1);
    }
  }
  close(pipes[1]);
  std::size_t acknowledged = 0;
  char byte = 0;
  while (acknowledged < 40 && read(pipes[0], &byte, 1) == 1) ++acknowledged;
  kill(child, SIGKILL);
  while (read(pipes[0], &byte, 1) == 1) ++acknowledged;
  close(pipes[0]);
  waitpid(child, nullptr, 0);
  ASSERT_GE(acknowledged, 40u);
  const Result<Log> log = Log::read(file_);
  ASSERT_TRUE(log) << to_string(log.errors());
  EXPECT_GE(log->records((*log->session_of("P2"))->id)->size(), acknowledged);
}

}  // namespace
}  // namespace parvis::study
