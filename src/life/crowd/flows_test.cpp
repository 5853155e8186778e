#include "life/crowd/flows.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace parvis::crowd {
namespace {

Result<std::vector<Flow>> read(const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "parvis_flows_test.csv";
  std::ofstream(file) << text;
  return read_flows(file);
}

std::string complaint(const std::string& text) {
  const Result<std::vector<Flow>> flows = read(text);
  return flows ? "" : to_string(flows.errors());
}

TEST(Flows, AreReadWithTwoOrThreeNumbersAPlace) {
  const auto flows = read("# counted in May\nfrom, to, per_hour\n0 1, 20 -3.5 0.2, 120\n5 5;6 6;0\r\n\n");
  ASSERT_TRUE(flows) << to_string(flows.errors());
  ASSERT_EQ(flows->size(), 2u);
  EXPECT_EQ((*flows)[0].from, glm::vec3(0, 1, 0));
  EXPECT_EQ((*flows)[0].to, glm::vec3(20, -3.5f, 0.2f));
  EXPECT_EQ((*flows)[0].per_hour, 120.0f);
  EXPECT_EQ((*flows)[1].per_hour, 0.0f);
}

TEST(Flows, OfBadLinesSayWhichAndWhy) {
  const std::string head = "from,to,per_hour\n";
  EXPECT_NE(complaint(head + "0 0,9 9,-20\n").find(".csv:2:1: per_hour is -20"), std::string::npos)
      << complaint(head + "0 0,9 9,-20\n");
  EXPECT_NE(complaint(head + "0 0,9 9,1e9\n").find("expected 0 to 36000"), std::string::npos);
  EXPECT_NE(complaint(head + "0 0,9 9,many\n").find("\"many\""), std::string::npos);
  EXPECT_NE(complaint(head + "0 0,9,5\n").find("\"9\" is no place"), std::string::npos);
  EXPECT_NE(complaint(head + "0 0,9 nan,5\n").find("is no place"), std::string::npos);
  EXPECT_NE(complaint(head + "0 0,9 9\n").find("2 fields"), std::string::npos);
  EXPECT_NE(complaint("0 0,9 9,5\n").find("from, to, per_hour"), std::string::npos);
  EXPECT_NE(complaint(head).find("no flow"), std::string::npos);
  std::string many = head;
  for (int i = 0; i < 2'001; ++i) many += "0 0,9 9,1\n";
  EXPECT_NE(complaint(many).find("more than 2000"), std::string::npos);
  EXPECT_EQ(read(head + "0 0,9 9,-1\n1 1,2 2,-1\n").errors().size(), 2u) << "all bad lines at once";
}

}  // namespace
}  // namespace parvis::crowd
