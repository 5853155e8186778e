#include "bench/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/test_folder.h"

namespace parvis::bench {
namespace {

TEST(Median, LiesInTheMiddleOfItsInterval) {
  const Median odd = median({5, 1, 3}), even = median({4, 1, 2, 3}), none = median({});
  EXPECT_EQ(odd.value, 3);
  EXPECT_EQ(even.value, 2.5);
  EXPECT_EQ(none.value, 0);
  EXPECT_LE(odd.low, odd.value);
  EXPECT_GE(odd.high, odd.value);
}

TEST(Report, WritesFiguresAsNumbersAndSaysWhatIsSkipped) {
  const TestFolder folder;
  Report report("import_export");
  report.add("loaded_ms", 12.5);
  report.skip("errors", "node is absent");
  ASSERT_TRUE(report.write(folder.path() / "report.json"));
  const auto json = nlohmann::json::parse(*read_file(folder.path() / "report.json"));
  EXPECT_EQ(json["bench"], "import_export");
  EXPECT_EQ(json["figures"], nlohmann::json({{"loaded_ms", 12.5}}));
  EXPECT_EQ(json["rows"].back(), "errors is skipped: node is absent");
}

TEST(Report, NamesControlsThatDoNotFail) {
  Report report("light");
  report.add_control("error_of_a_wrong_sun", 2.0, up_to(0.5));
  report.add_control("share_without_it", 0.5, {.limit = 0.9, .is_floor = true});
  EXPECT_TRUE(report.controls());
  report.add_control("error_of_another_wrong_sun", 0.4, up_to(0.5));
  report.add_control("nothing_was_measured", std::nan(""), up_to(0.5));
  const Status status = report.controls();
  ASSERT_FALSE(status);
  EXPECT_NE(to_string(status.errors()).find(": error_of_another_wrong_sun, nothing_was_measured"),
            std::string::npos)
      << to_string(status.errors());
}

}  // namespace
}  // namespace parvis::bench
