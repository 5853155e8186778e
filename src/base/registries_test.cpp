#include "base/registries.h"

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

void register_room(Registries& registries) {
  registries.get<Names>().all.push_back("quad");
  registries.get<Numbers>().all.push_back(7);
}

TEST(Registries, KeepsARegistryOfEachType) {
  Registries registries;
  register_room(registries);
  register_room(registries);
  const Registries& finished = registries;
  EXPECT_EQ(finished.get<Names>().all, (std::vector<std::string>{"quad", "quad"}));
  EXPECT_EQ(finished.get<Numbers>().all, (std::vector<int>{7, 7}));
}

TEST(Registries, ThoseOfOtherProgramsAreOthers) {
  Registries first;
  register_room(first);
  const Registries second;
  EXPECT_TRUE(second.get<Names>().all.empty());
}

TEST(Registries, RegistriesStayInPlace) {
  Registries registries;
  const Names* names = &registries.get<Names>();
  register_room(registries);
  EXPECT_EQ(names, &registries.get<Names>());
}

}  // namespace
}  // namespace parvis
