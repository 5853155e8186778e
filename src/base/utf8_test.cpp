#include "base/utf8.h"

#include <gtest/gtest.h>

namespace parvis {
namespace {

std::string repaired(std::string text) {
  repair_utf8(text);
  return text;
}

TEST(Utf8, TextThatIsRightStays) {
  for (const char* text :
       {"", "Place de la République", "\xf0\x9f\x8c\xb3", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
    EXPECT_EQ(repaired(text), text);
  }
}

TEST(Utf8, BytesThatAreNoCharactersAreReplaced) {
  EXPECT_EQ(repaired("caf\xe9"), "caf\xef\xbf\xbd");
  for (const char* text :
       {"\x80", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff", "a\xe2\x82"}) {
    EXPECT_FALSE(is_utf8(text));
    EXPECT_TRUE(is_utf8(repaired(text)));
  }
}

}  // namespace
}  // namespace parvis
