#include "base/image_io.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <optional>

#include "base/files.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/test_data.h"
#include "base/test_folder.h"

namespace parvis {
namespace {
namespace fs = std::filesystem;

Image8 noise(int width, int height, int channels) {
  Image8 picture(width, height, channels);
  Random random(7);
  for (std::uint8_t& value : picture.pixels) value = std::uint8_t(random.next());
  return picture;
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(ImageIo, GreyAndOpaquePicturesBecomeRgba) {
  const TestFolder folder;
  for (const int channels : {1, 3}) {
    const Image8 picture = noise(5, 4, channels);
    ASSERT_TRUE(write_image(folder.path() / "p.png", picture));
    const Result<Image8> again = read_image8(folder.path() / "p.png");
    ASSERT_TRUE(again) << to_string(again.errors());
    ASSERT_EQ(again->channels, 4);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 5; ++x) {
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(again->at(x, y)[c], picture.at(x, y)[channels == 1 ? 0 : c]) << channels << " channels";
        ASSERT_EQ(again->at(x, y)[3], 255);
      }
  }
}

TEST(ImageIo, ColourBehindGlassIsNotPremultiplied) {
  const TestFolder folder;
  Image8 picture(1, 1, 4);
  picture.pixels = {200, 100, 50, 10};
  ASSERT_TRUE(write_image(folder.path() / "glass.png", picture));
  const Result<Image8> again = read_image8(folder.path() / "glass.png");
  ASSERT_TRUE(again) << to_string(again.errors());
  EXPECT_EQ(again->pixels, picture.pixels);
}

/// A Radiance picture, two wide and one high, or turned: 1 0.5 0.25 and 2 4 8 in the order of the file.
std::string radiance(const std::string& lines, const std::string& order) {
  const std::string pixels{char(128), 64, 32, char(129), 32, 64, char(128), char(132)};
  return "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n" + order + "\n" + pixels;
}

TEST(ImageIo, RadianceIsThePixelByAllExposuresInTheOrderOfTheHeader) {
  const TestFolder folder;
  const auto read = [&](const std::string& lines, const std::string& order) {
    const Result<ImageF> image = read_image_float(folder.write("sky.hdr", radiance(lines, order)));
    EXPECT_TRUE(image) << to_string(image.errors());
    return image ? *image : ImageF(1, 1, 3);
  };
  const ImageF plain = read("", "-Y 1 +X 2");
  ASSERT_EQ(plain.width, 2);
  EXPECT_NEAR(plain.at(0, 0)[0], 1.0f, 0.01f);
  EXPECT_NEAR(plain.at(1, 0)[2], 8.0f, 0.1f);
  const ImageF exposed = read("EXPOSURE=0.5\nEXPOSURE= 0.5\nCOLORCORR= 1 2 1\n", "-Y 1 +X 2");
  EXPECT_NEAR(exposed.at(0, 0)[0], 4.0f * plain.at(0, 0)[0], 1e-5f);
  EXPECT_NEAR(exposed.at(0, 0)[1], 2.0f * plain.at(0, 0)[1], 1e-5f);
  EXPECT_EQ(read("EXPOSURE=0\nEXPOSURE=nan\nEXPOSURE=words\n", "-Y 1 +X 2").pixels, plain.pixels);
  const ImageF mirrored = read("", "-Y 1 -X 2");
  EXPECT_EQ(mirrored.at(1, 0)[0], plain.at(0, 0)[0]);
  const ImageF upward = read("", "+Y 2 +X 1");
  ASSERT_EQ(upward.height, 2);
  EXPECT_EQ(upward.at(0, 1)[0], plain.at(0, 0)[0]) << "the first row is the lowest";
  std::string xyz = radiance("", "-Y 1 +X 2");
  xyz.replace(xyz.find("rgbe"), 4, "xyze");
  EXPECT_NE(read_image_float(folder.write("xyz.hdr", xyz)).errors().front().message.find("CIE XYZ"),
            std::string::npos);
  const ImageF columns = read("", "+X 2 -Y 1");
  ASSERT_EQ(columns.width, 2);
  EXPECT_EQ(columns.at(1, 0)[2], plain.at(1, 0)[2]);
}

TEST(ImageIo, AnEvenJpegComesBackNearly) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "p.jpg", Image8(32, 16, 3, 120)));
  const Result<Image8> again = read_image8(folder.path() / "p.jpg");
  ASSERT_TRUE(again) << to_string(again.errors());
  EXPECT_EQ(again->width, 32);
  EXPECT_NEAR(again->at(10, 10)[1], 120, 2);
}

TEST(ImageIo, PicturesWithColourProfilesAreReadSideBySide) {
  // OpenImageIO 2.4 converts the profile's texts with one converter for all threads: without a lock this
  // crashed.
  const std::optional<fs::path> town = shared_data("cities/citygml/appearances");
  if (!town) GTEST_SKIP() << "skipped: shared data absent";
  std::vector<fs::path> pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(*town))
    if (entry.path().extension() == ".jpg") pictures.push_back(entry.path());
  ASSERT_FALSE(pictures.empty());
  std::atomic<int> read = 0;
  parallel_for(pictures.size() * 40, [&](std::size_t i) {
    if (read_image8(pictures[i % pictures.size()])) ++read;
  });
  EXPECT_EQ(read, int(pictures.size()) * 40);
}

TEST(ImageIo, RadianceOfDaylightComesBackFromHdr) {
  const TestFolder folder;
  ImageF radiance(16, 8, 3);
  for (std::size_t i = 0; i < radiance.pixels.size(); ++i) radiance.pixels[i] = 0.5f + 90.0f * float(i);
  ASSERT_TRUE(write_image(folder.path() / "sky.hdr", radiance));
  const Result<ImageF> again = read_image_float(folder.path() / "sky.hdr");
  ASSERT_TRUE(again) << to_string(again.errors());
  for (std::size_t i = 3; i < radiance.pixels.size(); ++i)  // 8 bits of mantissa for the largest of three
    ASSERT_NEAR(again->pixels[i], radiance.pixels[i], 2.0f + 0.02f * radiance.pixels[i]);
}

TEST(ImageIo, MemoryIsReadAsFilesAre) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "p.png", noise(9, 7, 4)));
  const std::string bytes = *read_file(folder.path() / "p.png");
  const Result<Image8> from_memory = read_image8(bytes_of(bytes), "car.glb image 0");
  ASSERT_TRUE(from_memory) << to_string(from_memory.errors());
  EXPECT_EQ(from_memory->pixels, noise(9, 7, 4).pixels);
}

TEST(ImageIo, FilesCutShortAnywhereAreErrorsThatNameThem) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "p.png", noise(24, 24, 4)));
  ImageF light(24, 24, 3, 1.0f);
  for (std::size_t i = 0; i < light.pixels.size(); ++i) light.pixels[i] = float(i * 7919 % 1000);
  ASSERT_TRUE(write_image(folder.path() / "l.exr", light));
  ASSERT_TRUE(write_image(folder.path() / "l.hdr", light));
  for (const char* name : {"p.png", "l.exr", "l.hdr"}) {
    const std::string whole = *read_file(folder.path() / name);
    for (const double share : {0.0, 0.01, 0.1, 0.5, 0.9}) {
      const std::string kind = fs::path(name).extension().string();
      const fs::path cut = folder.write(
          "short" + kind, std::string_view(whole).substr(0, std::size_t(share * double(whole.size()))));
      const Status read = [&]() -> Status {
        if (kind == ".png") {
          if (Result<Image8> picture = read_image8(cut); !picture) return picture.errors();
        } else if (Result<ImageF> picture = read_image_float(cut); !picture) {
          return picture.errors();
        }
        return Ok{};
      }();
      ASSERT_FALSE(read) << share << " of " << name;
      EXPECT_NE(to_string(read.errors()).find("short" + kind), std::string::npos) << to_string(read.errors());
    }
  }
}

TEST(ImageIo, MemoryCutShortIsAnErrorWithTheNameGiven) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "p.png", noise(24, 24, 4)));
  const std::string whole = *read_file(folder.path() / "p.png");
  for (const std::size_t size : {std::size_t(0), std::size_t(3), std::size_t(8), whole.size() / 2}) {
    const std::string part = whole.substr(0, size);
    const Result<Image8> picture = read_image8(bytes_of(part), "car.glb image 0");
    ASSERT_FALSE(picture) << size << " bytes";
    EXPECT_NE(to_string(picture.errors()).find("car.glb image 0"), std::string::npos);
  }
}

TEST(ImageIo, WhatCannotBeWrittenLeavesNothing) {
  const TestFolder folder;
  const Status unknown_kind = write_image(folder.path() / "picture.xyz", noise(4, 4, 3));
  ASSERT_FALSE(unknown_kind);
  EXPECT_NE(to_string(unknown_kind.errors()).find("picture.xyz"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ImageIo, FormatsAreKnownByTheirContent) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "p.png", noise(5, 4, 3)));
  fs::copy(folder.path() / "p.png", folder.path() / "p.jpg");
  EXPECT_TRUE(read_image8(folder.path() / "p.jpg"));
  for (const char* name : {"t.avi", "x.null?RES=32768x32768", "icon.ico", "s.psd"}) {
    folder.write(name, "#EXTM3U\nfile:///etc/passwd\n");
    const Result<Image8> picture = read_image8(folder.path() / name);
    ASSERT_FALSE(picture) << name;
    EXPECT_NE(to_string(picture.errors()).find("expected PNG"), std::string::npos)
        << to_string(picture.errors());
    EXPECT_FALSE(write_image(folder.path() / name, noise(2, 2, 3))) << name;
  }
}

TEST(ImageIo, EveryFormatThatIsWrittenIsRead) {
  const TestFolder folder;
  for (const char* name : {"p.png", "p.JPG", "p.exr", "p.hdr", "p.tif", "p.bmp", "p.webp", "p.tga"}) {
    ASSERT_TRUE(write_image(folder.path() / name, Image8(16, 8, 3, 120))) << name;
    const Result<Image8> again = read_image8(folder.path() / name);
    ASSERT_TRUE(again) << name << ": " << to_string(again.errors());
    EXPECT_EQ(again->width, 16) << name;
  }
}

TEST(ImageIo, HdrHasNoAlphaAndIsWrittenWithoutIt) {
  const TestFolder folder;
  const fs::path file = folder.path() / "picture.hdr";
  const Image8 picture(7, 5, 4, 128);
  ASSERT_TRUE(write_image(file, picture));
  const Result<Image8> back = read_image8(file);
  ASSERT_TRUE(back);
  for (std::size_t i = 0; i < back->pixels.size(); ++i)
    EXPECT_NEAR(back->pixels[i], i % 4 == 3 ? 255 : 128, 1);
}

TEST(ImageIo, NoFileSaysWhenItWasWritten) {
  const Result<std::string> bytes = encode_image(ImageF(2, 2, 3, 1.0f), "a.exr");
  ASSERT_TRUE(bytes);
  const std::size_t date = bytes->find("capDate");
  ASSERT_NE(date, std::string::npos);
  EXPECT_NE(bytes->find("2003:01:01 00:00:00", date), std::string::npos) << "the library's clock";
}

TEST(ImageIo, AHeaderThatClaimsMoreThanItsFileHoldsIsRefused) {
  const TestFolder folder;
  std::vector<char> header(54);
  const auto put = [&](std::size_t at, std::uint32_t value) {
    std::memcpy(header.data() + at, &value, sizeof value);
  };
  std::memcpy(header.data(), "BM", 2);
  put(10, 54), put(14, 40), put(18, 32768), put(22, 32768), put(26, 24u << 16 | 1);
  folder.write("bomb.bmp", {header.data(), header.size()});
  const Result<Image8> picture = read_image8(folder.path() / "bomb.bmp");
  ASSERT_FALSE(picture);
  EXPECT_NE(to_string(picture.errors()).find("claims 32768 x 32768"), std::string::npos)
      << to_string(picture.errors());
}

TEST(ImageIo, RadianceIsFinite) {
  const TestFolder folder;
  ImageF radiance(2, 1, 3, 2.0f);
  radiance.pixels[0] = std::numeric_limits<float>::infinity();
  radiance.pixels[1] = std::numeric_limits<float>::quiet_NaN();
  radiance.pixels[3] = 5.0f;
  ASSERT_TRUE(write_image(folder.path() / "sun.exr", radiance));
  std::size_t replaced = 0;
  const Result<ImageF> again = read_image_float(folder.path() / "sun.exr", &replaced);
  ASSERT_TRUE(again) << to_string(again.errors());
  EXPECT_EQ(replaced, 2u);
  EXPECT_EQ(again->pixels, (std::vector<float>{5.0f, 0.0f, 2.0f, 5.0f, 2.0f, 2.0f}));
}

}  // namespace
}  // namespace parvis
