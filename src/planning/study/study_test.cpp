#include "planning/study/study.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "planning/study/test_study.h"

namespace parvis::study {
namespace {

std::string errors_of(const std::string& script) {
  const TestFolder folder;
  const Result<Study> study = write_test_study(folder.path(), script);
  return study ? "" : to_string(study.errors());
}

TEST(StudyScripts, GiveTasksConditionsAndQuestions) {
  const TestFolder folder;
  const Result<Study> study = write_test_study(folder.path());
  ASSERT_TRUE(study) << to_string(study.errors());
  EXPECT_EQ(study->orders(), (Orders{{0, 1}, {1, 0}}));
  const std::vector<Part> parts = parts_of(*study, {1, 0});
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0].task->name, "left");
  EXPECT_EQ(parts[0].condition, 1);
  EXPECT_EQ(parts[1].asked, std::vector<std::string>{"quick"});
  EXPECT_EQ(parts[1].condition, 1) << "answers after a task are those under its condition";
  EXPECT_EQ(parts[2].task->instruction.in(design::Language::french), "à droite");
  EXPECT_EQ(parts[3].asked, (std::vector<std::string>{"sus", "remarks"}));
  EXPECT_EQ(study->questionnaire("sus").questions.size(), 10u);
}

TEST(StudyScripts, OneTaskIsDoneUnderEachCondition) {
  const TestFolder folder;
  const Result<Study> study = write_test_study(folder.path(),
                                               "study(name=s, scene=\"scene.xp\") { condition(name=a) "
                                               "condition(name=b) condition(name=c) task(name=t) }");
  ASSERT_TRUE(study) << to_string(study.errors());
  EXPECT_EQ(parts_of(*study, study->orders().front()).size(), 3u);
}

TEST(StudyScripts, SayWhatIsWrongAndWhere) {
  EXPECT_NE(errors_of("study(name=s) { task(name=t) }").find("tiny.study:1:1: study needs scene="),
            std::string::npos);
  EXPECT_NE(errors_of("study(name=s, scene=\"absent.xp\") { task(name=t) }").find("absent.xp"),
            std::string::npos);
  EXPECT_NE(errors_of("").find("has no study"), std::string::npos);
  EXPECT_NE(errors_of("study(name=s, scene=\"scene.xp\") { }").find("has no task"), std::string::npos);
  EXPECT_NE(errors_of("study(name=s, scene=\"scene.xp\") { tusk(name=t) }").find("did you mean \"task\""),
            std::string::npos);
  EXPECT_NE(errors_of("study(name=s, scene=\"scene.xp\", asked=suss) { task(name=t) }")
                .find("did you mean \"sus\""),
            std::string::npos);
  EXPECT_NE(errors_of("study(name=s, scene=\"scene.xp\") { task(name=a) task(name=b) condition(name=c) }")
                .find("2 tasks and 1"),
            std::string::npos);
  EXPECT_NE(errors_of("study(name=s, scene=\"scene.xp\") { task(name=t) task(name=t) }").find("is taken"),
            std::string::npos);
  EXPECT_NE(errors_of("study(name=s, scene=\"scene.xp\") { task(name=\"a b\") }").find("letters, digits"),
            std::string::npos);
  EXPECT_NE(errors_of("study(name=s, scene=\"scene.xp\") { task(name=t, area=\"0 0, 1 1\") }")
                .find("three corners"),
            std::string::npos);
}

}  // namespace
}  // namespace parvis::study
