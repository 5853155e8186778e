#include "capture/trees/capture_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/image_io.h"
#include "base/test_folder.h"
#include "capture/photographs/colmap_set.h"
#include "capture/photographs/colmap_writer.h"

namespace parvis::trees {
namespace {

constexpr int photo_side_px = 120;
constexpr double photo_focal_px = 100.0, disc_tangent = 0.4;  // of the angle to the disc's rim

/// A folder with one photograph of a green disc, by a lens.
void write_disc(const std::filesystem::path& folder, const photographs::Lens& lens) {
  photographs::Photograph photograph;
  photograph.name = "disc.png";
  photograph.lens = lens;
  Image8 picture(photo_side_px, photo_side_px, 4);
  for (int y = 0; y < photo_side_px; ++y)
    for (int x = 0; x < photo_side_px; ++x) {
      const auto direction = photographs::direction_of(lens, {x + 0.5, y + 0.5});
      if (!direction || glm::length(glm::dvec2(*direction)) > disc_tangent * -direction->z) continue;
      picture.at(x, y)[1] = 200, picture.at(x, y)[3] = 255;
    }
  ASSERT_TRUE(write_image(folder / photograph.name, picture).ok());
  photographs::PhotographSet set;
  set.photographs.push_back(photograph);
  ASSERT_TRUE(photographs::write_colmap_model(folder, photographs::colmap_model_of(set),
                                              photographs::ColmapFormat::text)
                  .ok());
}

/// The radius of the disc in what is read, pixels.
double radius_read(const std::filesystem::path& folder) {
  const Result<std::vector<TreeView>> views = read_capture(folder);
  EXPECT_TRUE(views) << to_string(views.errors());
  if (!views) return 0.0;
  EXPECT_NEAR((*views)[0].camera.focal.x, photo_focal_px, 1e-3);
  double opaque = 0.0;
  const Image8& picture = (*views)[0].picture;
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4) opaque += picture.pixels[i] / 255.0;
  return std::sqrt(opaque / 3.14159265);
}

TEST(CaptureFolder, LensesWithDistortionAreStraightened) {
  const double right = photo_focal_px * disc_tangent;
  for (const auto& [model, distortion] : {std::pair(photographs::LensModel::simple_radial, -0.3),
                                          std::pair(photographs::LensModel::simple_radial_fisheye, 0.0)}) {
    const TestFolder folder;
    photographs::Lens lens;
    lens.model = model, lens.width = lens.height = photo_side_px;
    lens.parameters = {photo_focal_px, 0.5 * photo_side_px, 0.5 * photo_side_px, distortion};
    write_disc(folder.path(), lens);
    EXPECT_NEAR(radius_read(folder.path()), right, 0.5) << "of " << int(model);
    // The control: the same picture, were its lens taken for one without distortion.
    const auto flat = photographs::pixel_of(lens, {disc_tangent, 0.0, -1.0}).value_or(glm::dvec2(0.0)).x -
                      0.5 * photo_side_px;
    EXPECT_GT(right - flat, 1.0);
  }
}

}  // namespace
}  // namespace parvis::trees
