#include "viewer/key_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "scene/action/key_names.h"

namespace parvis::viewer {
namespace {

TEST(KeyNames, EveryNameOfScriptsBelongsToOneKeyOrButton) {
  std::multiset<std::string> names;
  for (int key = -1; key < 400; ++key)
    if (const std::string name = key_name(key); !name.empty()) names.insert(name);
  for (int button = 0; button < 8; ++button) names.insert(mouse_button_name(button));
  for (int button = 0; button < 16; ++button) names.insert(controller_button_name(button));
  for (const std::string& name : action::key_names()) EXPECT_EQ(names.count(name), 1u) << name;
  EXPECT_EQ(names.size(), action::key_names().size());
}

}  // namespace
}  // namespace parvis::viewer
