#include "capture/photographs/panorama.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "base/image_io.h"
#include "base/test_folder.h"

namespace parvis::photographs {
namespace {

const glm::dvec3 standpoint(3.0, 4.0, 1.7);

/// A smooth world: each channel is a wave across directions.
glm::dvec3 colour_along(glm::dvec3 d) {
  return 127.5 + 100.0 * glm::sin(glm::dvec3(5.0 * d.x + d.z, 4.0 * d.y, 6.0 * d.z));
}

Image8 test_panorama(int width) {
  Image8 panorama(width, width / 2, 4, 255);
  for (int y = 0; y < panorama.height; ++y)
    for (int x = 0; x < width; ++x) {
      const double heading = ((x + 0.5) / width - 0.5) * 2.0 * std::numbers::pi;
      const double height = (0.5 - (y + 0.5) / panorama.height) * std::numbers::pi;
      const glm::dvec3 direction(std::sin(heading) * std::cos(height), std::cos(heading) * std::cos(height),
                                 std::sin(height));
      for (int c = 0; c < 3; ++c) panorama.at(x, y)[c] = std::uint8_t(colour_along(direction)[c] + 0.5);
    }
  return panorama;
}

TEST(Panorama, ItsFacesAreWhatCamerasThereSee) {
  const auto faces = faces_of_panorama(test_panorama(1024), "square", standpoint);
  ASSERT_TRUE(faces) << to_string(faces.errors());
  ASSERT_EQ(faces->size(), 6u);
  for (const Picture& face : *faces) {
    double max_difference = 0.0;
    for (int y = 2; y < face.image.height - 2; ++y)
      for (int x = 0; x < face.image.width; ++x) {
        const auto direction = direction_in_world(face.photograph, {x + 0.5, y + 0.5});
        ASSERT_TRUE(direction);
        const bool is_at_a_pole = std::abs(direction->z) > 0.999;  // one row there spans all headings
        for (int c = 0; c < 3 && !is_at_a_pole; ++c)
          max_difference = std::max(max_difference,
                                    std::abs(double(face.image.at(x, y)[c]) - colour_along(*direction)[c]));
      }
    EXPECT_LT(max_difference, 2.0) << face.photograph.name << ": rounded twice";
  }
  EXPECT_GT((*faces)[1].photograph.forward_in_world().x, 0.999) << "east";
}

TEST(Panorama, ItsMiddleLooksWhereItIsSaidTo) {
  const auto north = faces_of_panorama(test_panorama(256), "square", standpoint),
             east = faces_of_panorama(test_panorama(256), "square", standpoint, 90.0);
  ASSERT_TRUE(north);
  ASSERT_TRUE(east);
  EXPECT_EQ((*east)[1].image.pixels, (*north)[0].image.pixels) << "east now shows the middle";
  EXPECT_NE((*east)[0].image.pixels, (*north)[0].image.pixels) << "the control";
}

TEST(Panorama, BecomesFilesWithCameras) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "square.png", test_panorama(64)));
  const auto set = split_panorama(folder.path() / "square.png", folder.path() / "faces", standpoint);
  ASSERT_TRUE(set) << to_string(set.errors());
  ASSERT_EQ(set->photographs.size(), 6u);
  for (const Photograph& photograph : set->photographs)
    EXPECT_TRUE(read_picture(photograph)) << photograph.name;
}

TEST(Panorama, APhotographThatWasCutToItsShapeIsNoPanorama) {
  const TestFolder folder;
  const auto file = folder.path() / "street.jpg";
  ASSERT_TRUE(write_image(file, test_panorama(64)));
  std::ifstream stream(file, std::ios::binary);
  std::string jpeg((std::istreambuf_iterator<char>(stream)), {});
  // EXIF behind the first marker, big-endian: a lens as of 28 mm on film.
  std::string exif(
      "Exif\0\0MM\0*\0\0\0\x08\0\x01\x87\x69\0\x04\0\0\0\x01\0\0\0\x1a\0\0\0\0"
      "\0\x01\xa4\x05\0\x03\0\0\0\x01\0\x1c\0\0\0\0\0\0",
      6 + 8 + 2 + 12 + 4 + 2 + 12 + 4);
  jpeg.insert(2, std::string("\xff\xe1\0", 3) + char(exif.size() + 2) + exif);
  folder.write("street.jpg", jpeg);
  const auto cut = split_panorama(file, folder.path() / "faces", standpoint);
  ASSERT_FALSE(cut);
  EXPECT_NE(to_string(cut.errors()).find("a lens of 28 mm"), std::string::npos) << to_string(cut.errors());
  folder.write("stitched.jpg", jpeg + "<GPano:ProjectionType>equirectangular</GPano:ProjectionType>");
  const auto stitched = split_panorama(folder.path() / "stitched.jpg", folder.path() / "faces", standpoint);
  EXPECT_TRUE(stitched) << to_string(stitched.errors());
}

TEST(Panorama, AnotherShapeIsRefused) {
  const auto faces = faces_of_panorama(Image8(300, 100, 4), "strip.jpg", standpoint);
  ASSERT_FALSE(faces);
  EXPECT_NE(to_string(faces.errors()).find("strip.jpg: 300 x 100 pixels are no full panorama"),
            std::string::npos);
}

}  // namespace
}  // namespace parvis::photographs
