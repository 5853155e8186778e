#include <gtest/gtest.h>

#include "bench/all_benches.h"

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

TEST(Benches, HaveANameAndASummary) {
  EXPECT_GE(all_benches().all().size(), 5u);
  for (const Bench& bench : all_benches().all()) {
    EXPECT_FALSE(bench.name.empty());
    EXPECT_FALSE(bench.summary.empty()) << bench.name;
  }
  EXPECT_TRUE(all_benches().find("frame"));
}

}  // namespace
}  // namespace parvis::bench
