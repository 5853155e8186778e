#include "capture/photographs/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/image_io.h"
#include "base/test_folder.h"
#include "capture/photographs/picture_header.h"
#include "capture/photographs/set_file.h"
#include "capture/photographs/test_place.h"

namespace parvis::photographs {
namespace {

Photograph of_file(const std::filesystem::path& file, int width, int height) {
  Photograph photograph;
  photograph.name = file.filename().string();
  photograph.file = file;
  photograph.lens = centred_lens(width, height, 0.8);
  return photograph;
}

TEST(Picture, CutShortIsAnError) {
  const TestFolder folder;
  const PhotographSet set = test_photographs(1, 160, 120);
  ASSERT_TRUE(write_image(folder.path() / "whole.jpg", test_picture(set.photographs[0], 1)));
  std::ifstream in(folder.path() / "whole.jpg", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const auto cut = folder.write("cut.jpg", bytes.substr(0, bytes.size() / 2));
  EXPECT_TRUE(read_picture(of_file(folder.path() / "whole.jpg", 160, 120)));
  const auto read = read_picture(of_file(cut, 160, 120));
  ASSERT_FALSE(read);
  EXPECT_NE(to_string(read.errors()).find("cut.jpg"), std::string::npos);
}

TEST(Picture, TooManyPixelsAreRefusedByTheirHeader) {
  const TestFolder folder;
  // A PNG's header says its size: 20000 = 0x4e20, 10000 = 0x2710. Nobody gets to the pixels.
  const std::string header("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x4e\x20\0\0\x27\x10\x08\x02\0\0\0", 29);
  const auto file = folder.write("large.png", header);
  const auto read = read_picture(of_file(file, 20000, 10000));
  ASSERT_FALSE(read);
  EXPECT_NE(to_string(read.errors()).find("20000 x 10000 pixels are too many"), std::string::npos)
      << to_string(read.errors());
}

TEST(Picture, ExifSaysHowItWasHeldAndHowFarItWasZoomed) {
  // A JPEG of 3 x 2 pixels' header: EXIF (little-endian) with orientation 6 and, below, 35 mm and 52 mm.
  const std::string tiff(
      "II*\0\x08\0\0\0"
      "\x02\0"
      "\x12\x01\x03\0\x01\0\0\0\x06\0\0\0"
      "\x69\x87\x04\0\x01\0\0\0\x26\0\0\0"
      "\0\0\0\0"
      "\x02\0"
      "\x0a\x92\x05\0\x01\0\0\0\x44\0\0\0"
      "\x05\xa4\x03\0\x01\0\0\0\x34\0\0\0"
      "\0\0\0\0"
      "\x46\0\0\0\x02\0\0\0",
      8 + 2 + 24 + 4 + 2 + 24 + 4 + 8);
  std::string jpeg("\xff\xd8\xff\xe1\0", 5);
  jpeg.push_back(char(2 + 6 + tiff.size()));
  jpeg.append("Exif\0\0", 6);
  jpeg.append(tiff);
  jpeg.append("\xff\xc0\0\x0b\x08\0\x02\0\x03\x01\x01\x11\0", 13);
  const auto header = parse_picture_header(jpeg, "p.jpg");
  ASSERT_TRUE(header) << to_string(header.errors());
  EXPECT_EQ(header->width, 3);
  EXPECT_EQ(header->height, 2);
  EXPECT_EQ(header->orientation, 6);
  EXPECT_DOUBLE_EQ(header->focal_length_mm, 35.0);
  EXPECT_DOUBLE_EQ(header->focal_length_35mm_mm, 52.0);
  for (std::size_t size = 0; size < jpeg.size() - 6; ++size)
    EXPECT_FALSE(parse_picture_header(jpeg.substr(0, size), "p.jpg")) << size;
}

TEST(Picture, HeldUprightIsTurned) {
  const TestFolder folder;
  Image8 stored(4, 2, 3, 0);
  stored.at(0, 1)[0] = 200;  // lower left: shown upper left by orientation 6
  ASSERT_TRUE(write_image(folder.path() / "plain.png", stored));
  EXPECT_FALSE(read_picture(of_file(folder.path() / "plain.png", 2, 4))) << "nothing says that it was turned";
}

TEST(Picture, MaskBecomesAlpha) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "p.png", Image8(4, 2, 3, 200)));
  Image8 mask(4, 2, 1, 255);
  mask.at(3, 1)[0] = 0;
  ASSERT_TRUE(write_image(folder.path() / "m.png", mask));
  Photograph photograph = of_file(folder.path() / "p.png", 4, 2);
  photograph.mask = folder.path() / "m.png";
  const auto read = read_picture(photograph);
  ASSERT_TRUE(read) << to_string(read.errors());
  EXPECT_EQ(read->at(0, 0)[3], 255);
  EXPECT_EQ(read->at(3, 1)[3], 0);
  ASSERT_TRUE(write_image(folder.path() / "m.png", Image8(3, 2, 1)));
  EXPECT_FALSE(read_picture(photograph));
}

TEST(Picture, UndistortionShowsWhatAPinholeWould) {
  Photograph bent = test_photographs(1, 320, 240).photographs[0];
  bent.lens = {LensModel::opencv, 320, 240, {280, 285, 165, 118, -0.15, 0.03, 0.001, -0.002}};
  Photograph straight = bent;
  straight.lens = undistorted(bent.lens);
  const auto with_alpha = [](const Image8& rgb) {
    Image8 rgba(rgb.width, rgb.height, 4, 255);
    for (int y = 0; y < rgb.height; ++y)
      for (int x = 0; x < rgb.width; ++x) std::copy_n(rgb.at(x, y), 3, rgba.at(x, y));
    return rgba;
  };
  const Image8 truth = test_picture(straight, 3);
  const Picture picture = undistorted(bent, with_alpha(test_picture(bent, 3)));
  EXPECT_EQ(picture.photograph.lens, straight.lens);
  double squares = 0.0, plain_squares = 0.0;
  int count = 0;
  const Image8 plain = test_picture(bent, 3);
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x) {
      if (picture.image.at(x, y)[3] < 255) continue;
      ++count;
      for (int c = 0; c < 3; ++c) {
        squares += std::pow(double(picture.image.at(x, y)[c]) - truth.at(x, y)[c], 2) / 3.0;
        plain_squares += std::pow(double(plain.at(x, y)[c]) - truth.at(x, y)[c], 2) / 3.0;
      }
    }
  EXPECT_GT(count, 320 * 240 * 8 / 10);
  EXPECT_LT(std::sqrt(squares / count), 6.0) << "of 255; blotches of a pixel are resampled";
  EXPECT_GT(std::sqrt(plain_squares / count), 12.0) << "as a control: without undistortion";
}

TEST(Picture, ASetIsKeptWithGainsAndMasks) {
  const TestFolder folder;
  const auto pictures = folder.path() / "pictures";
  std::filesystem::create_directories(pictures);
  PhotographSet set = test_photographs(3, 80, 60);
  for (Photograph& photograph : set.photographs) {
    photograph.file = pictures / photograph.name;
    ASSERT_TRUE(write_image(photograph.file, test_picture(photograph, 1)));
  }
  set.photographs[1].gain = {1.25, 0.75, 1.5};
  set.photographs[2].mask = pictures / "masks" / "2.png";
  set.world_from_given = glm::dmat4(0, 0, 0.3, 0, 0, -0.3, 0, 0, 0.3, 0, 0, 0, 5, 6, 7, 1);
  ASSERT_TRUE(write_photograph_set(folder.path() / "out", set, pictures));
  const auto loaded = read_photograph_set(folder.path() / "out");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_TRUE(loaded->problems.empty()) << to_string(loaded->problems);
  ASSERT_EQ(loaded->set.photographs.size(), 3u);
  EXPECT_EQ(loaded->set.photographs[1].gain, glm::dvec3(1.25, 0.75, 1.5));
  EXPECT_EQ(loaded->set.photographs[2].mask, pictures / "masks" / "2.png");
  EXPECT_EQ(loaded->set.photographs[0].file, pictures / "place_0.png");
  EXPECT_EQ(loaded->set.world_from_given, set.world_from_given);
  EXPECT_TRUE(read_picture(loaded->set.photographs[0]));
  std::filesystem::rename(pictures, folder.path() / "moved");
  const auto moved = read_photograph_set(folder.path() / "out");
  ASSERT_FALSE(moved) << "the place is there, its photographs are elsewhere";
  EXPECT_NE(to_string(moved.errors()).find("the folder of the photographs is not there"), std::string::npos)
      << to_string(moved.errors());
  std::filesystem::rename(folder.path() / "moved", pictures);
  for (const char* wrong : {"[1, 2]", "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, \"one\"]]"}) {
    folder.write("out/photographs.json",
                 fmt::format(R"({{"pictures": "../pictures", "world_from_given": {}}})", wrong));
    const auto unread = read_photograph_set(folder.path() / "out");
    ASSERT_FALSE(unread) << wrong;
    EXPECT_NE(to_string(unread.errors()).find("world_from_given"), std::string::npos);
  }
  std::string deep = R"({"pictures":"..","photographs":)";
  for (int level = 0; level < 80'000; ++level) deep += "[";
  folder.write("out/photographs.json", deep + std::string(80'000, ']') + "}");
  const auto refused = read_photograph_set(folder.path() / "out");
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.errors()).find("photographs.json: lists and objects"), std::string::npos);
}

}  // namespace
}  // namespace parvis::photographs
