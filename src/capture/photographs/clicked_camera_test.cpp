#include "capture/photographs/clicked_camera.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/test_data.h"
#include "capture/photographs/camera_files.h"
#include "capture/photographs/test_clicks.h"

namespace parvis::photographs {
namespace {

Photograph taken_from(glm::vec3 eye, glm::vec3 target, double fov = 0.8) {
  Photograph photograph = photograph_of({.world_from_camera = look_at(eye, target)}, "corner", 1600, 1200);
  photograph.lens = centred_lens(1600, 1200, fov);
  return photograph;
}

std::vector<ClickedPoint> clicked(const Photograph& photograph, const std::vector<glm::dvec3>& places) {
  std::vector<ClickedPoint> points;
  for (const glm::dvec3& place : places) points.push_back({*pixel_of_world(photograph, place), place});
  return points;
}

const std::vector<glm::dvec3> corners{{0, 0, 0}, {8, 0, 0}, {8, 6, 0}, {0, 6, 0}, {0, 6, 4}, {8, 6, 7}};

TEST(ClickedCamera, IsTheOneThatTookThePicture) {
  const Photograph truth = taken_from({3, -14, 1.7f}, {4, 3, 2});
  const Result<ClickedCamera> found = camera_of_points(clicked(truth, corners), 1600, 1200);
  ASSERT_TRUE(found) << to_string(found.errors());
  EXPECT_LT(glm::distance(found->photograph.position_in_world(), truth.position_in_world()), 0.01);
  EXPECT_NEAR(focal_px(found->photograph.lens).x, focal_px(truth.lens).x, 1.0);
  const glm::dvec3 elsewhere(2, 2, 3);
  EXPECT_LT(glm::distance(*pixel_of_world(found->photograph, elsewhere), *pixel_of_world(truth, elsewhere)),
            0.1);
}

TEST(ClickedCamera, IsFoundFromThePavingAlone) {
  const Photograph truth = taken_from({3, -9, 4.5f}, {4, 3, 0});
  const std::vector<glm::dvec3> paving{{0, 0, 0}, {8, 0, 0}, {8, 6, 0}, {0, 6, 0}, {3, 2, 0}, {6, 9, 0}};
  const Result<ClickedCamera> found = camera_of_points(clicked(truth, paving), 1600, 1200);
  ASSERT_TRUE(found) << to_string(found.errors());
  EXPECT_LT(glm::distance(found->photograph.position_in_world(), truth.position_in_world()), 0.05);
}

TEST(ClickedCamera, TakesMapCoordinatesAsTheyAre) {
  const Photograph truth = taken_from({3, -14, 1.7f}, {4, 3, 2});
  std::vector<ClickedPoint> points = clicked(truth, corners);
  const glm::dvec3 on_map(1'044'000.0, 6'298'000.0, 12.0);
  for (ClickedPoint& each : points) each.position_in_world += on_map;
  const Result<ClickedCamera> found = camera_of_points(points, 1600, 1200);
  ASSERT_TRUE(found) << to_string(found.errors());
  EXPECT_LT(glm::distance(found->photograph.position_in_world(), truth.position_in_world() + on_map), 0.01);
}

TEST(ClickedCamera, NamesTheClickOfAnotherPoint) {
  std::vector<ClickedPoint> points = clicked(taken_from({3, -14, 1.7f}, {4, 3, 2}), corners);
  points.push_back({{1500, 100}, {2, 0, 0}});
  const Result<ClickedCamera> found = camera_of_points(points, 1600, 1200);
  ASSERT_FALSE(found);
  EXPECT_NE(found.errors().front().message.find("point 7 (at 1500,100) does not fit"), std::string::npos)
      << to_string(found.errors());
}

TEST(ClickedCamera, IsNotMadeUpFromTooLittle) {
  const Photograph truth = taken_from({3, -14, 1.7f}, {4, 3, 2});
  EXPECT_FALSE(camera_of_points(clicked(truth, {{0, 0, 0}, {8, 0, 0}, {8, 6, 0}}), 1600, 1200));
  const std::vector<glm::dvec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}};
  const Result<ClickedCamera> found = camera_of_points(clicked(truth, line), 1600, 1200);
  ASSERT_FALSE(found);
  EXPECT_NE(found.errors().front().message.find("on one line"), std::string::npos);
}

TEST(ClickedCamera, ReadsPointsWithTheirLines) {
  const auto points =
      parse_clicked_points("# corners\n10 20 1.5 -2 0\n\n 11.5, 21 = 3, 4, 5 # door\n", "p.txt");
  ASSERT_TRUE(points);
  ASSERT_EQ(points->size(), 2u);
  EXPECT_EQ((*points)[1].pixel, glm::dvec2(11.5, 21));
  EXPECT_EQ((*points)[1].position_in_world, glm::dvec3(3, 4, 5));
  for (const char* bad : {"1 2 3 4\n", "1 2 3 4 5 6\n", "1 2 x 4 5\n", "1 2 3 4 nan\n", "1 2 3 4 1e30\n"}) {
    const auto refused = parse_clicked_points(bad, "p.txt");
    ASSERT_FALSE(refused) << bad;
    EXPECT_EQ(refused.errors().front().where.line, 1);
  }
}

TEST(ClickedCamera, OfSixPointsFitsTheCourtyard) {
  const std::optional<std::filesystem::path> folder = shared_data("photos_castle_p30");
  if (!folder) GTEST_SKIP() << "photos_castle_p30 is absent";
  const Result<LoadedSet> loaded = read_cameras(*folder / "colmap", *folder / "images");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  std::vector<glm::dvec3> places;
  for (const SparsePoint& point : loaded->set.points) places.push_back(point.position_in_world);
  std::vector<double> errors;
  for (std::size_t i = 0; i < loaded->set.photographs.size(); ++i)
    errors.push_back(clicked_camera_error_px(loaded->set.photographs[i], places, 0.5, i));
  std::ranges::sort(errors);
  EXPECT_LT(errors[errors.size() / 2], 1.0);
  EXPECT_LT(errors.back(), 5.0);
}

}  // namespace
}  // namespace parvis::photographs
