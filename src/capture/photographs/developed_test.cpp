#include "capture/photographs/developed.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/image_io.h"
#include "base/test_folder.h"
#include "capture/photographs/picture.h"

namespace parvis::photographs {
namespace {
namespace fs = std::filesystem;

Image8 plain(std::uint8_t grey) { return Image8(32, 24, 3, grey); }

TEST(Developed, AFolderOfJpegAndPngIsTakenAsItIs) {
  const TestFolder folder;
  fs::create_directories(folder.path() / "photos");
  ASSERT_TRUE(write_image(folder.path() / "photos/a.jpg", plain(80)));
  const auto result = developed(folder.path() / "photos", folder.path() / "out");
  ASSERT_TRUE(result) << to_string(result.errors());
  EXPECT_EQ(result->folder, folder.path() / "photos");
  EXPECT_TRUE(result->problems.empty());
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST(Developed, OtherFormatsBecomeJpegUnderTheirNames) {
  const TestFolder folder;
  const fs::path photos = folder.path() / "photos", kept = photos / "out/developed";
  fs::create_directories(photos / "more");
  ASSERT_TRUE(write_image(photos / "a.jpg", plain(80)));
  ASSERT_TRUE(write_image(photos / "more/b.webp", plain(120)));
  ASSERT_TRUE(write_image(photos / "a.tif", plain(10)));  // as raw files stand beside a camera's own JPEG
  folder.write("photos/c.heic", "no picture");
  const auto result = developed(photos, kept);
  ASSERT_TRUE(result) << to_string(result.errors());
  EXPECT_EQ(result->folder, kept);
  EXPECT_EQ(picture_names(kept), (std::vector<std::string>{"a.jpg", "more/b.jpg"}));
  const Result<Image8> b = read_image8(kept / "more/b.jpg");
  ASSERT_TRUE(b) << to_string(b.errors());
  EXPECT_EQ(b->width, 32);
  EXPECT_NEAR(b->pixels[0], 120, 3);
  ASSERT_EQ(result->problems.size(), 2u) << to_string(result->problems);
  EXPECT_NE(to_string(result->problems).find("a.tif"), std::string::npos);
  EXPECT_NE(to_string(result->problems).find("c.heic"), std::string::npos);
  const auto made = fs::last_write_time(kept / "more/b.jpg");
  ASSERT_TRUE(developed(photos, kept)) << "its own pictures are no photographs of the folder";
  EXPECT_EQ(fs::last_write_time(kept / "more/b.jpg"), made);
}

}  // namespace
}  // namespace parvis::photographs
