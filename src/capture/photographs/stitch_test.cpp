// Stitching of photographs whose cameras are known. Skipped where COLMAP is not installed.
#include "capture/photographs/stitch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/image_io.h"
#include "base/test_folder.h"
#include "capture/photographs/panorama.h"
#include "capture/photographs/program.h"
#include "capture/photographs/test_place.h"

namespace parvis::photographs {
namespace {

const glm::dvec3 eye(6.0, 5.0, 1.7);

/// Photographs all around, overlapping by half, with exposures of their own.
std::vector<Photograph> around(int count, int width, int height) {
  std::vector<Photograph> photographs;
  for (int i = 0; i < count; ++i) {
    Camera camera;
    const double turn = 2.0 * std::acos(-1.0) * i / count;
    const glm::vec3 ahead(float(std::sin(turn)), float(std::cos(turn)), 0.02f * float(i % 3));
    camera.world_from_camera = look_at(glm::vec3(eye), glm::vec3(eye) + ahead);
    camera.vertical_fov = 0.9f;
    photographs.push_back(photograph_of(camera, fmt::format("{:02}.png", i), width, height));
  }
  return photographs;
}

/// Mean difference of a face from what its camera truly sees, where it shows anything.
double difference(const Picture& face, std::size_t& compared) {
  const Image8 truth = test_picture(face.photograph, 1);
  double sum = 0.0;
  compared = 0;
  for (int y = 0; y < truth.height; y += 3)
    for (int x = 0; x < truth.width; x += 3) {
      if (face.image.at(x, y)[3] == 0) continue;
      for (int c = 0; c < 3; ++c) sum += std::abs(double(face.image.at(x, y)[c]) - double(truth.at(x, y)[c]));
      compared += 3;
    }
  return sum / double(std::max<std::size_t>(compared, 1));
}

TEST(Stitch, PlacedPicturesBecomeTheFacesOfTheSphere) {
  std::vector<Image8> pictures;
  std::vector<glm::dmat3> rotations;
  double focal = 0.0;
  for (const Photograph& photograph : around(12, 480, 360)) {
    const Image8 rgb = test_picture(photograph, 1);
    const double gain = pictures.size() % 2 == 0 ? 1.1 : 0.9;  // exposures that alternate
    Image8 rgba(rgb.width, rgb.height, 4, 255);
    for (std::size_t i = 0; i < rgb.pixels.size(); ++i)
      rgba.pixels[i / 3 * 4 + i % 3] = std::uint8_t(std::min(gain * rgb.pixels[i], 255.0));
    pictures.push_back(rgba), rotations.push_back(glm::dmat3(photograph.world_from_camera));
    focal = focal_px(photograph.lens).x;
  }
  const std::vector<Picture> faces = stitched_faces(pictures, rotations, focal, "spot", eye);
  ASSERT_EQ(faces.size(), 6u);
  for (std::size_t i = 0; i < 4; ++i) {
    std::size_t compared = 0;
    EXPECT_LT(difference(faces[i], compared), 8.0) << faces[i].photograph.name;
    EXPECT_GT(compared, 1000u);
  }
  Picture other = faces[0];
  other.photograph.world_from_camera = faces[1].photograph.world_from_camera;
  std::size_t compared = 0;
  EXPECT_GT(difference(other, compared), 20.0) << "the control: another direction";
}

TEST(Stitch, AFolderOfPhotographsIsPlacedByWhatTheyShare) {
  const TestFolder folder;
  if (!run_program({"colmap", "help"}, folder.path() / "help.log", [] {}))
    GTEST_SKIP() << "colmap is not installed";
  const auto pictures = folder.path() / "spot";
  std::filesystem::create_directories(pictures);
  const std::vector<Photograph> truth = around(9, 400, 300);
  for (const Photograph& photograph : truth)
    ASSERT_TRUE(write_image(pictures / photograph.name, test_picture(photograph, 1)));
  const Result<StitchedSpot> spot = stitch(pictures, folder.path() / "work", "spot", eye, 0.0);
  ASSERT_TRUE(spot) << to_string(spot.errors());
  EXPECT_EQ(spot->used, 9u) << to_string(spot->problems);
  EXPECT_NEAR(spot->focal_px, focal_px(truth[0].lens).x, 0.01 * spot->focal_px);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(difference(spot->faces[i], compared), 12.0) << i;
  const Result<PhotographSet> set = write_faces(spot->faces, folder.path() / "place" / "faces");
  ASSERT_TRUE(set) << to_string(set.errors());
  EXPECT_GE(set->photographs.size(), 4u);
  for (const Photograph& photograph : set->photographs)
    EXPECT_TRUE(read_picture(photograph)) << photograph.name;
}

TEST(Stitch, OneOrDifferentSizesAreRefused) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "spot" / "a.png", Image8(64, 48, 3, 9)));
  EXPECT_NE(to_string(stitch(folder.path() / "spot", folder.path() / "w", "spot", eye, 0.0).errors())
                .find("2 or more"),
            std::string::npos);
  ASSERT_TRUE(write_image(folder.path() / "spot" / "b.png", Image8(32, 48, 3, 9)));
  EXPECT_NE(to_string(stitch(folder.path() / "spot", folder.path() / "w", "spot", eye, 0.0).errors())
                .find("one size"),
            std::string::npos);
}

}  // namespace
}  // namespace parvis::photographs
