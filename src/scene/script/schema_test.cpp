#include "scene/script/schema.h"

#include <gtest/gtest.h>

namespace parvis::scene {
namespace {

template <class T>
T parsed(const AttributeSchema& schema, const std::string& text) {
  const auto value = parse_value(schema, text, Roots(""), {});
  EXPECT_TRUE(value) << text << (value ? "" : to_string(value.errors()));
  return value ? std::get<T>(*value) : T();
}

bool refuses(const AttributeSchema& schema, const std::string& text) {
  return !parse_value(schema, text, Roots(""), {});
}

TEST(Schema, ReadsNumbers) {
  const AttributeSchema number{.name = "n", .type = AttributeType::number};
  EXPECT_EQ(parsed<double>(number, "-1.5e2"), -150.0);
  EXPECT_EQ(parsed<double>(number, " +3 "), 3.0);
  for (const char* text :
       {"", "x", "1 2", "1e999", "nan", "inf", "-inf", "0x10", "1,5 2", "1e10", "--1", "1.5m", "+-1"})
    EXPECT_TRUE(refuses(number, text)) << text;
}

TEST(Schema, ReadsWholeNumbersFlagsAndAngles) {
  const AttributeSchema integer{.name = "n", .type = AttributeType::integer, .minimum = 0, .maximum = 10};
  EXPECT_EQ(parsed<long>(integer, "10"), 10);
  EXPECT_TRUE(refuses(integer, "1.5"));
  EXPECT_TRUE(refuses(integer, "11"));
  EXPECT_TRUE(refuses(integer, "99999999999999999999999"));
  const AttributeSchema flag{.name = "f", .type = AttributeType::flag};
  EXPECT_TRUE(parsed<bool>(flag, "yes"));
  EXPECT_FALSE(parsed<bool>(flag, "0"));
  EXPECT_TRUE(refuses(flag, "2"));
  EXPECT_NEAR(parsed<double>({.name = "a_deg", .type = AttributeType::angle}, "180"), glm::radians(180.0),
              1e-12);
}

TEST(Schema, ReadsColours) {
  const AttributeSchema colour{.name = "c", .type = AttributeType::colour, .minimum = 0};
  EXPECT_NEAR(parsed<glm::vec3>(colour, "#FF8000").y, 0.2159f, 1e-4f);
  EXPECT_EQ(parsed<glm::vec3>(colour, "0.5, 0.25 2"), glm::vec3(0.5f, 0.25f, 2.0f));
  for (const char* text : {"#FFF", "#GG0000", "#FF80001", "red", "1 2", "1 2 3 4", "-1 0 0", "# FF000"})
    EXPECT_TRUE(refuses(colour, text)) << text;
}

TEST(Schema, ReadsPoints) {
  const AttributeSchema path{.name = "p", .type = AttributeType::path};
  const auto points = parsed<std::vector<glm::vec3>>(path, "0 1, 2 3 4; 5 6,");
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0], glm::vec3(0, 1, 0));
  EXPECT_EQ(points[1], glm::vec3(2, 3, 4));
  for (const char* text : {"", ",", "1 2", "1, 2", "1 2, 3", "1 2, 3 4 5 6", "1 2, x y", "1 2,,3 4"})
    EXPECT_TRUE(refuses(path, text)) << text;
  EXPECT_EQ(parsed<std::vector<glm::vec3>>({.name = "p", .type = AttributeType::points}, "1 2").size(), 1u);
}

TEST(Schema, MorePointsThanASceneNeedsAreRefused) {
  std::string text;
  for (std::size_t i = 0; i <= max_points; ++i) text += "1 2,";
  EXPECT_TRUE(refuses({.name = "p", .type = AttributeType::points}, text));
}

TEST(Schema, ErrorsStayShort) {
  const AttributeSchema number{.name = "n", .type = AttributeType::number};
  const auto value = parse_value(number, std::string(1 << 20, 'x'), Roots(""), {});
  ASSERT_FALSE(value);
  EXPECT_LT(value.errors().front().message.size(), 200u);
}

TEST(Schema, AValueIsWrittenAsItIsRead) {
  const auto written_again = [](AttributeType type, const std::string& text) {
    AttributeSchema schema{.name = "it", .type = type, .choices = {"when"}};
    const Result<AttributeValue> value = parse_value(schema, text, Roots(""), {});
    EXPECT_TRUE(value) << text;
    return written_value(schema, *value);
  };
  EXPECT_EQ(written_again(AttributeType::number, "1.25"), "1.25");
  EXPECT_EQ(written_again(AttributeType::angle, "-30"), "-30");
  EXPECT_EQ(written_again(AttributeType::integer, "7"), "7");
  EXPECT_EQ(written_again(AttributeType::flag, "yes"), "1");
  EXPECT_EQ(written_again(AttributeType::vec3, "1 2.5 -3"), "1 2.5 -3");
  EXPECT_EQ(written_again(AttributeType::path, "0 0, 1 2 3"), "0 0 0, 1 2 3");
  EXPECT_EQ(written_again(AttributeType::choice, "when"), "when");
  EXPECT_EQ(written_again(AttributeType::event, "when,  tree, show oaks, 0.5"), "when, tree, show oaks, 0.5");
}

}  // namespace
}  // namespace parvis::scene
