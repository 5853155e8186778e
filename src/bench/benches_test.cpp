#include "bench/benches.h"

#include <gtest/gtest.h>

#include "house/rooms.h"

namespace parvis::bench {
namespace {

TEST(Benches, AreFoundByNameAndRunWithTheirSetup) {
  const House house;
  Benches benches;
  benches.add(
      {"quick_only", "fails unless it is quick", [&](const BenchSetup& setup, Report& report) -> Status {
         EXPECT_EQ(&setup.house, &house);
         report.add("runs", 1);
         return setup.is_quick ? Status(Done{}) : error("not quick");
       }});
  const Bench* found = benches.find("quick_only");
  ASSERT_TRUE(found);
  Report report("quick_only");
  EXPECT_TRUE(found->run({house, true}, report));
  EXPECT_FALSE(found->run({house, false}, report));
  EXPECT_EQ(benches.find("quick"), nullptr);
}

TEST(Benches, OfTheHouseHaveANameAndASummary) {
  EXPECT_GE(house::benches().all().size(), 5u);
  for (const Bench& bench : house::benches().all()) {
    EXPECT_FALSE(bench.name.empty());
    EXPECT_FALSE(bench.summary.empty()) << bench.name;
  }
  EXPECT_TRUE(house::benches().find("frame"));
}

}  // namespace
}  // namespace parvis::bench
