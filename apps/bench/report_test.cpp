#include "bench/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/test_folder.h"
#include "bench/bench.h"

namespace parvis::bench {
namespace {

TEST(Median, LiesInTheMiddleOfItsInterval) {
  const Median odd = median({5, 1, 3}), even = median({4, 1, 2, 3}), none = median({});
  EXPECT_EQ(odd.value, 3);
  EXPECT_EQ(even.value, 2.5);
  EXPECT_EQ(none.value, 0);
  EXPECT_LE(odd.low, odd.value);
  EXPECT_GE(odd.high, odd.value);
  EXPECT_EQ(ratio_in_turn({2, 6, 4}, {1, 2, 2}).value, 2);
}

TEST(Report, WritesFiguresWithTheirTargets) {
  const TestFolder folder;
  Report report("trees", true);
  report.add("psnr_db_22", 27.0);
  report.add("not_in_the_table", 12.5);
  report.skip("ssim_100", "there are no trees");
  ASSERT_TRUE(report.write(folder.path() / "report.json"));
  const auto json = nlohmann::json::parse(*read_file(folder.path() / "report.json"));
  EXPECT_EQ(json["bench"], "trees");
  EXPECT_EQ(json["quick"], true);
  EXPECT_EQ(json["figures"], nlohmann::json({{"psnr_db_22", 27.0}, {"not_in_the_table", 12.5}}));
  EXPECT_EQ(json["keys"][0]["target"], ">= 26");
  EXPECT_EQ(json["keys"][0]["reached"], true);
  EXPECT_FALSE(json["keys"][1].contains("target"));
  EXPECT_EQ(json["rows"].back(), "ssim_100 is skipped: there are no trees");
}

TEST(Report, NamesControlsThatDoNotFail) {
  Report report("trees", false);
  report.add("psnr_db_22", 27.0);
  report.add("psnr_db_22_naive", 20.0);
  report.add("a_measured_target", 3.0, maximum(4.0), {{"its_control", 5.0}});
  EXPECT_TRUE(report.controls());
  report.add("psnr_db_22_of_an_empty_picture", 26.5);
  report.add("minutes_22_if_seconds_were_minutes", std::nan(""));
  report.add("a_measured_target", 3.0, maximum(4.0), {{"its_other_control", 4.0}});
  const Status status = report.controls();
  ASSERT_FALSE(status);
  EXPECT_NE(
      to_string(status.errors())
          .find(": psnr_db_22_of_an_empty_picture, minutes_22_if_seconds_were_minutes, its_other_control"),
      std::string::npos)
      << to_string(status.errors());
}

TEST(Keys, AreNamedOnceAndTheirControlsAreNoKeys) {
  for (const Key& key : all_keys()) {
    EXPECT_EQ(key_named(key.name), &key);
    for (const std::string_view control : key.controls) {
      if (control.empty()) continue;
      EXPECT_EQ(key_named(control), nullptr) << control;
      const bool finds_target_as_it_runs = key.shows.find("target: ") != std::string_view::npos;
      EXPECT_TRUE(finds_target_as_it_runs || key.target.kind != Target::Kind::none) << key.name;
    }
  }
}

TEST(Parts, AreFoundByBenchAndByName) {
  EXPECT_EQ(parts_named("frame").size(), 2u);
  ASSERT_EQ(parts_named("shadows").size(), 1u);
  EXPECT_EQ(parts_named("light/shadows"), parts_named("shadows"));
  EXPECT_EQ(parts_named("facades_sceaux"), parts_named("facades/sceaux"));
  EXPECT_EQ(parts_named("facades").size(), 3u) << "drawing is a part of sceaux";
  EXPECT_TRUE(parts_named("balloons").empty());
}

TEST(Parts, ThatFailDoNotStopTheNext) {
  const Part fails{"a", "fails", "", [](const BenchSetup&, Report&) { fail("no city"); }, false},
      adds{"a", "adds", "", [](const BenchSetup&, Report&report) { report.add("runs", 1); }, false};
  const TestFolder folder;
  Report report("a", true);
  const std::array parts{&fails, &adds};
  const Status status = run_parts({true, folder.path()}, parts, report);
  ASSERT_FALSE(status);
  EXPECT_NE(to_string(status.errors()).find("no city"), std::string::npos);
  ASSERT_TRUE(report.write(folder.path() / "report.json"));
  EXPECT_EQ(nlohmann::json::parse(*read_file(folder.path() / "report.json"))["figures"]["runs"], 1.0);
}

}  // namespace
}  // namespace parvis::bench
