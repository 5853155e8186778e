#include "planning/plan_drawing/qr_code.h"

#include <gtest/gtest.h>

namespace parvis::plan_drawing {
namespace {

/// A finder pattern: a dark ring of 7 modules, a light one, a dark square of 3.
bool is_finder(const QrCode& code, int left, int top) {
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 7; ++x) {
      const int ring = std::max(std::abs(x - 3), std::abs(y - 3));
      if (code.dark(left + x, top + y) != (ring != 2)) return false;
    }
  return true;
}

TEST(QrCode, HasItsFindersInThreeCorners) {
  const Result<QrCode> code = qr_code("https://example.org/square");
  ASSERT_TRUE(code) << to_string(code.errors());
  EXPECT_EQ(code->side, 25) << "version 2 holds 26 bytes at level M";
  EXPECT_TRUE(is_finder(*code, 0, 0));
  EXPECT_TRUE(is_finder(*code, code->side - 7, 0));
  EXPECT_TRUE(is_finder(*code, 0, code->side - 7));
  EXPECT_FALSE(is_finder(*code, code->side - 7, code->side - 7)) << "the control: none in the fourth";
  EXPECT_NE(qr_code("https://example.org/squarf")->is_dark, code->is_dark);
}

TEST(QrCode, RefusesWhatIsNoAddress) {
  for (const std::string& link :
       {std::string(), std::string("square"), std::string("file:///etc/passwd"), std::string("https://a b"),
        std::string("https://\"><script>"), "https://" + std::string(400, 'a')})
    EXPECT_FALSE(qr_code(link)) << link;
}

TEST(QrCode, ItsPictureHasAQuietZone) {
  const std::string svg = qr_svg(*qr_code("https://example.org/square"));
  EXPECT_NE(svg.find("viewBox=\"0 0 33 33\""), std::string::npos);
  EXPECT_EQ(svg.find("M3 "), std::string::npos);
  EXPECT_NE(svg.find("M4 4h1"), std::string::npos);
}

}  // namespace
}  // namespace parvis::plan_drawing
