#include "planning/study/performance.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "planning/design/test_design.h"
#include "planning/study/measures.h"
#include "planning/study/report.h"
#include "planning/study/test_study.h"
#include "planning/study/xdf.h"

namespace parvis::study {
namespace {

class SessionTest : public ::testing::Test {
 protected:
  SessionTest() { action::register_room(registries_); }
  void SetUp() override {
    Result<Study> study = write_test_study(folder_.path());
    ASSERT_TRUE(study) << to_string(study.errors());
    study_ = *std::move(study);
    Result<Log> log = Log::open(folder_.path() / "log.sqlite");
    ASSERT_TRUE(log) << to_string(log.errors());
    log_.emplace(*std::move(log));
  }

  Status take_part(const std::string& participant, const std::string& inputs) {
    Result<Session> session = Session::begin(study_, *log_, participant, 100.0);
    if (!session) return session.errors();
    Performance performance(study_, session->parts(), registries_);
    return run_inputs(*session, performance, folder_.write(participant + ".txt", inputs));
  }
  LoggedSession logged(const std::string& participant) { return **log_->session_of(participant); }
  std::vector<Record> records(const std::string& participant) {
    return *log_->records(logged(participant).id);
  }
  Replay replayed(const std::vector<Record>& records) {
    const std::vector<Part> parts = parts_of(study_, study_.orders().front());
    Performance performance(study_, parts, registries_);
    const Result<Replay> outcome = replay(performance, records);
    EXPECT_TRUE(outcome) << to_string(outcome.errors());
    return *outcome;
  }
  static std::vector<std::string> texts(const std::vector<Record>& records, const std::string& kind) {
    std::vector<std::string> found;
    for (const Record& record : records)
      if (const Event* event = std::get_if<Event>(&record); event && event->kind == kind)
        found.push_back(event->text);
    return found;
  }

  TestFolder folder_;
  Registries registries_ = design::test_registries();
  Study study_;
  std::optional<Log> log_;
};

TEST_F(SessionTest, IsLoggedWithAllThatHappened) {
  const Status status = take_part("P1", test_inputs);
  ASSERT_TRUE(status) << to_string(status.errors());
  const std::vector<Record> all = records("P1");
  EXPECT_EQ(texts(all, "part"),
            (std::vector<std::string>{"0 left calm", "1 questions calm", "2 right busy", "3 questions -"}));
  EXPECT_EQ(texts(all, "command").size(), 4u) << "two insertions, an undo, a row";
  ASSERT_EQ(texts(all, "refused").size(), 1u);
  EXPECT_NE(texts(all, "refused").front().find("nonsense"), std::string::npos);
  EXPECT_EQ(texts(all, "answer"), (std::vector<std::string>{"quick.liked 6", "sus.1 4"}));
  EXPECT_EQ(texts(all, "end").size(), 1u);
  EXPECT_EQ(
      std::ranges::count_if(all, [](const Record& record) { return std::holds_alternative<Frame>(record); }),
      26 * 60);
  EXPECT_TRUE(std::ranges::is_sorted(all, {}, time_of)) << "one clock";
}

TEST_F(SessionTest, ReplaysBitByBitAndNoticesAFrameThatWasLonger) {
  ASSERT_TRUE(take_part("P1", test_inputs));
  std::vector<Record> all = records("P1");
  const Replay same = replayed(all);
  EXPECT_GE(same.states, 4u);
  EXPECT_FALSE(same.differs_at_us);
  for (Record& record : all)
    if (Frame* frame = std::get_if<Frame>(&record)) {
      frame->step_s *= 1.001;
      break;
    }
  EXPECT_TRUE(replayed(all).differs_at_us);
}

TEST_F(SessionTest, OfASecondParticipantHasTheOtherOrder) {
  ASSERT_TRUE(take_part("P1", test_inputs));
  ASSERT_TRUE(take_part("P2", test_inputs));
  EXPECT_EQ(texts(records("P2"), "part").front(), "0 left busy");
  EXPECT_FALSE(take_part("P1", test_inputs)) << "the code is taken";
  ASSERT_TRUE(log_->forget("P1"));
  ASSERT_TRUE(take_part("P3", test_inputs));
  EXPECT_EQ(texts(records("P3"), "part").front(), "0 left calm") << "the order that became free";
}

TEST_F(SessionTest, EndsATaskWhoseTimeIsOver) {
  ASSERT_TRUE(take_part("P1", "75 do insert bin 1,1\n"));
  const std::vector<PartMeasures> parts = measures_of(study_, logged("P1"), records("P1"));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_TRUE(parts[0].is_time_over);
  EXPECT_NEAR(parts[0].duration_s, 60.0, 0.02);
  EXPECT_FALSE(parts[1].is_whole);
}

TEST_F(SessionTest, GoesOnWhereItWasInterrupted) {
  ASSERT_TRUE(take_part("P1", "1.5 do insert bin -2,3\n5 do insert bin -3,3\n"));
  std::vector<Record> before;
  Result<Session> session = Session::resume(study_, *log_, "P1", before);
  ASSERT_TRUE(session) << to_string(session.errors());
  {
    Performance performance(study_, session->parts(), registries_);
    ASSERT_TRUE(replay(performance, before));
    ASSERT_TRUE(performance.apply(Event{0, "resumed", ""}));
    EXPECT_EQ(performance.design()->objects().size(), 3u);
    const Status status = run_inputs(*session, performance,
                                     folder_.write("on.txt", "6 do insert bin -4,3\n7 do undo\n8 done\n"));
    ASSERT_TRUE(status) << to_string(status.errors());
  }
  EXPECT_EQ(session->index(), 1u);
  EXPECT_FALSE(replayed(records("P1")).differs_at_us);
}

TEST_F(SessionTest, RefusesInputsByLine) {
  const auto refusal = [&](const std::string& participant, const std::string& inputs) {
    const Status status = take_part(participant, inputs);
    return status ? "" : to_string(status.errors());
  };
  EXPECT_NE(refusal("A", "1 dance\n").find("A.txt:1:1: \"dance\" is no input"), std::string::npos);
  EXPECT_NE(refusal("B", "2 done\n1 done\n").find("B.txt:2:1"), std::string::npos);
  EXPECT_NE(refusal("C", "nan done\n").find("is no time"), std::string::npos);
  EXPECT_NE(refusal("D", "1 view nowhere\n").find("nowhere"), std::string::npos);
  EXPECT_NE(refusal("E", "1 answer quick.liked 3\n").find("is not asked now"), std::string::npos);
  EXPECT_NE(refusal("F", "1 eye 3\n").find("an eye is written"), std::string::npos);
  EXPECT_NE(refusal("G", "1 press nokey\n").find("nothing in the scene waits"), std::string::npos);
  EXPECT_EQ(texts(records("A"), "part").size(), 1u) << "what was before the error is there";
}

TEST_F(SessionTest, IsMeasured) {
  ASSERT_TRUE(take_part("P1", test_inputs));
  const std::vector<PartMeasures> parts = measures_of(study_, logged("P1"), records("P1"));
  ASSERT_EQ(parts.size(), 4u);
  const PartMeasures& left = parts[0];
  EXPECT_NEAR(left.duration_s, 12.0, 1e-6);
  EXPECT_NEAR(*left.first_placing_s, 1.5, 1e-6);
  EXPECT_EQ(left.commands, 3);
  EXPECT_EQ(left.refused, 1);
  EXPECT_EQ(left.outside, 1) << "4,3 lies outside of the area";
  EXPECT_EQ(left.undone, 1);
  EXPECT_EQ(left.placings.size(), 2u);
  EXPECT_NEAR(left.view_s.at("plan"), 3.5, 0.05);
  EXPECT_NEAR(left.view_s.at("street"), 8.5, 0.05);
  EXPECT_EQ(parts[1].answers.at("quick.liked"), "6");
  EXPECT_EQ(parts[2].placings.size(), 3u);
}

TEST_F(SessionTest, IsReportedByConditionAndPaired) {
  ASSERT_TRUE(take_part("P1", test_inputs));
  ASSERT_TRUE(take_part("P2", test_inputs));
  ReportInput input{study_, {}, {{{-9, -9}, {9, -9}}}};
  for (const char* participant : {"P1", "P2"})
    for (const PartMeasures& part : measures_of(study_, logged(participant), records(participant)))
      input.parts.push_back(part);
  const std::string html = report_html(input);
  EXPECT_NE(html.find("2 participants, 2 of them to the end"), std::string::npos);
  EXPECT_NE(html.find("busy &minus; calm, paired"), std::string::npos);
  EXPECT_NE(html.find("no score: item 2 is missing"), std::string::npos);
  EXPECT_NE(html.find("I liked it"), std::string::npos);
  input.is_blind = true;
  EXPECT_EQ(report_html(input).find("calm"), std::string::npos);
  EXPECT_NE(report_tables(input).at("parts.csv").find("P2,0,left,busy,1,1,0,12.000,1.500,3,1,1,1,"),
            std::string::npos)
      << report_tables(input).at("parts.csv");
  EXPECT_NE(report_tables(input).at("answers.csv").find("P1,1,questions,calm,1,quick,liked,6"),
            std::string::npos);
}

TEST_F(SessionTest, IsWrittenAsXdfWithItsClock) {
  ASSERT_TRUE(take_part("P1", test_inputs));
  const std::string file = xdf_of(logged("P1"), records("P1"));
  ASSERT_EQ(file.substr(0, 4), "XDF:");
  std::size_t at = 4;
  std::vector<int> tags;
  while (at < file.size()) {  // each chunk says how long it is
    ASSERT_EQ(file[at], 4);
    std::uint32_t length = 0;
    std::uint16_t tag = 0;
    std::memcpy(&length, file.data() + at + 1, sizeof length),
        std::memcpy(&tag, file.data() + at + 5, sizeof tag);
    tags.push_back(tag);
    at += 5 + length;
  }
  EXPECT_EQ(at, file.size());
  EXPECT_EQ(tags.front(), 1);
  EXPECT_EQ(std::ranges::count(tags, 2), 4) << "a header for each stream";
  EXPECT_NE(file.find("<first_timestamp>100</first_timestamp>"), std::string::npos)
      << "the machine's steady clock";
}

TEST(QuestionPages, AskWhatTheStudyAsksInBothLanguages) {
  const TestFolder folder;
  const Result<Study> study = write_test_study(folder.path());
  ASSERT_TRUE(study);
  const std::string page = questionnaire_page(*study, design::Language::french);
  EXPECT_NE(page.find("name='sus.10' value='5'"), std::string::npos);
  EXPECT_NE(page.find("<textarea name='remarks.good'"), std::string::npos);
  EXPECT_NE(page.find("Je voudrais utiliser"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos) << "nothing is loaded from elsewhere";
}

}  // namespace
}  // namespace parvis::study
