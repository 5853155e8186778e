#include "base/json_guard.h"

#include <gtest/gtest.h>

namespace parvis {
namespace {

std::string nested(int depth, const std::string& front = "[", const std::string& back = "]") {
  std::string text;
  for (int i = 0; i < depth; ++i) text += front;
  text += "1";
  for (int i = 0; i < depth; ++i) text += back;
  return text;
}

TEST(JsonGuard, DepthIsBounded) {
  EXPECT_TRUE(check_json_depth(nested(max_json_depth), "f"));
  const Status deep = check_json_depth(nested(80'000, "{\"a\":[", "]}"), "f.gltf");
  ASSERT_FALSE(deep.ok());
  EXPECT_NE(to_string(deep.errors()).find("f.gltf"), std::string::npos);
  EXPECT_FALSE(check_json_depth(nested(max_json_depth + 1), "f"));
}

TEST(JsonGuard, BracketsInStringsDoNotCount) {
  EXPECT_TRUE(check_json_depth("[\"" + std::string(1000, '[') + "\"]", "f"));
  EXPECT_TRUE(check_json_depth("[\"\\\"" + std::string(1000, '[') + "\"]", "f")) << "an escaped quote";
  EXPECT_FALSE(check_json_depth("[\"\\\\\"" + std::string(1000, '['), "f")) << "an escaped backslash ends it";
  EXPECT_TRUE(check_json_depth("\"\\", "f")) << "cut short";
}

TEST(JsonGuard, ReasonsAreThoseOfTheFile) {
  EXPECT_EQ(json_reason("[json.exception.type_error.302] type must be number"), "type must be number");
  EXPECT_EQ(json_reason("[1, 2"), "[1, 2");
}

}  // namespace
}  // namespace parvis
