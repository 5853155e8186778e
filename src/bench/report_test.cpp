#include "bench/report.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace parvis::bench
