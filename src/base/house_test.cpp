#include "base/house.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace parvis {
namespace {

struct Names {
  std::vector<std::string> all;
};
struct Numbers {
  std::vector<int> all;
};

void furnish(House& house) {
  house.get<Names>().all.push_back("quad");
  house.get<Numbers>().all.push_back(7);
}

TEST(House, KeepsARegistryOfEachType) {
  House house;
  furnish(house);
  furnish(house);
  const House& finished = house;
  EXPECT_EQ(finished.get<Names>().all, (std::vector<std::string>{"quad", "quad"}));
  EXPECT_EQ(finished.get<Numbers>().all, (std::vector<int>{7, 7}));
}

TEST(House, RegistriesOfOtherHousesAreOthers) {
  House first;
  furnish(first);
  const House second;
  EXPECT_TRUE(second.get<Names>().all.empty());
}

TEST(House, RegistriesStayInPlace) {
  House house;
  const Names* names = &house.get<Names>();
  furnish(house);
  EXPECT_EQ(names, &house.get<Names>());
}

}  // namespace
}  // namespace parvis
