#include "graphics/light/sun_hours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "base/image_io.h"
#include "base/test_folder.h"
#include "graphics/light/finer_mesh.h"
#include "graphics/light/sun_plan.h"
#include "graphics/light/sun_study.h"
#include "graphics/light/test_box.h"

namespace parvis::light {
namespace {

const SunPeriod equinox{.place = {.day_of_year = 80}, .first_day = 80, .last_day = 80};

TEST(SunHours, AnOpenPlainHasTheWholeDay) {
  const scene::Scene scene = box_on_a_plain({20, 20, 0}, {21, 21, 1});
  const reference::RayScene rays(scene);
  const std::vector<float> hours = sun_hours(rays, {{{-20, -20, 0.02f}, {0, 0, 1}}}, equinox);
  EXPECT_NEAR(hours[0], 12.1f, 0.1f);
}

TEST(SunHours, WallsFaceTheirHalfOfTheDay) {
  const scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 5, 20});
  const reference::RayScene rays(scene);
  const std::vector<float> hours = sun_hours(rays,
                                             {{{0, -5.02f, 10}, {0, -1, 0}},
                                              {{5.02f, 0, 10}, {1, 0, 0}},
                                              {{-5.02f, 0, 10}, {-1, 0, 0}},
                                              {{0, 5.02f, 10}, {0, 1, 0}}},
                                             equinox);
  EXPECT_GT(hours[0], 11.5f);          // the south has all but minutes after sunrise and before sunset
  EXPECT_NEAR(hours[1], 6.05f, 0.1f);  // the east has the morning
  EXPECT_NEAR(hours[1] + hours[2], 12.1f, 0.1f);
  EXPECT_LT(hours[3], 0.6f);  // the north has next to nothing
}

TEST(SunHours, TheShadowOfAWallIsWhereTrigonometryPutsIt) {
  // North of a long wall 10 m high the noon shadow of the equinox at 43.7 degrees is 10 * tan(43.7) = 9.6 m
  // long, and at the equinox a straight wall that runs east and west casts one of constant length: shade all
  // day within, sun all day beyond.
  const scene::Scene scene = box_on_a_plain({-2000, -1, 0}, {2000, 0, 10});
  const reference::RayScene rays(scene);
  const std::vector<float> hours =
      sun_hours(rays, {{{0, 6.0f, 0.02f}, {0, 0, 1}}, {{0, 10.2f, 0.02f}, {0, 0, 1}}}, equinox);
  EXPECT_LT(hours[0], 1.5f);
  EXPECT_GT(hours[1], 10.5f);
}

TEST(SunHours, AgreesWithRaysEveryMinute) {
  const scene::Scene scene = box_on_a_plain({-4, -3, 0}, {5, 6, 14});
  const reference::RayScene rays(scene);
  std::vector<SunPoint> points;
  for (float x = -28; x < 28; x += 3)
    for (float y = -28; y < 28; y += 3) points.push_back({{x, y, 0.02f}, {0, 0, 1}});
  const std::vector<float> quick = sun_hours(rays, points, equinox),
                           truth = sun_hours_by_minutes(rays, points, equinox);
  const auto error_percent = [&](const std::vector<float>& hours) {
    double off = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < hours.size(); ++i)
      off += std::abs(double(hours[i] - truth[i])), sum += double(truth[i]);
    return 100.0 * off / sum;
  };
  EXPECT_LT(error_percent(quick), 0.5);
  // A control: one number for all points would not do.
  EXPECT_GT(error_percent(std::vector<float>(truth.size(), 11.0f)), 3.0);
}

TEST(SunHours, PolarNightHasNone) {
  const scene::Scene scene = box_on_a_plain({20, 20, 0}, {21, 21, 1});
  const reference::RayScene rays(scene);
  SunPeriod winter{.place = {.latitude_deg = 78.2, .longitude_deg = 15.6}, .first_day = 350, .last_day = 352};
  EXPECT_EQ(sun_hours(rays, {{{0, 0, 0.02f}, {0, 0, 1}}}, winter)[0], 0.0f);
}

TEST(SunHours, ASeasonGoesOnIntoTheNextYear) {
  const scene::Scene scene = box_on_a_plain({20, 20, 0}, {21, 21, 1});
  const reference::RayScene rays(scene);
  const std::vector<SunPoint> plain{{{-20, -20, 0.02f}, {0, 0, 1}}};
  const auto hours = [&](int year, int first_day, int last_day) {
    return sun_hours(rays, plain, {.place = {.year = year}, .first_day = first_day, .last_day = last_day})[0];
  };
  const float december = hours(2026, 356, 365), january = hours(2027, 1, 30);
  EXPECT_GT(january, december + 0.1f);
  EXPECT_NEAR(hours(2026, 356, 395), (10.0f * december + 30.0f * january) / 40.0f, 1e-4f);
}

class Plaster final : public scene::TracedSurface {
 public:
  scene::TracedPoint point(const scene::TracedHit& hit) const override { return {.normal = hit.normal}; }
};

TEST(SunStudy, PhotographedSurfacesHaveHours) {
  scene::Scene scene;
  const auto wall = std::make_shared<Mesh>();
  wall->positions = {{0, 0, 0}, {6, 0, 0}, {6, 0, 4}, {0, 0, 4}};
  wall->normals.assign(4, {0, -1, 0}), wall->uvs.assign(4, {0, 0});
  wall->indices = {0, 1, 2, 0, 2, 3};
  scene.traced_kinds.push_back({.name = "wall",
                                .count = [](const scene::Scene&) { return 1; },
                                .trace =
                                    [wall](const scene::Scene&, scene::TracedScene& traced) {
                                      traced.add(wall, std::make_shared<Plaster>(), glm::mat4(1.0f), {});
                                    },
                                .is_recorded = true});
  const SunStudyOptions options{.period = equinox, .cell_m = 1.0, .area = glm::dvec4(-3, -3, 9, 3)};
  const Result<SunStudy> study = study_sun(scene, options);
  ASSERT_TRUE(study) << to_string(study.errors());
  ASSERT_FALSE(study->surfaces.positions.empty());
  for (const glm::vec2 uv : study->surfaces.uvs) EXPECT_GT(uv.x, 0.9f) << "a wall to the south";
  scene.traced_kinds[0].is_recorded = false;
  EXPECT_FALSE(study_sun(scene, options)) << "leaves of trees, say";
}

TEST(SunStudy, PlanTableAndModel) {
  const scene::Scene scene = box_on_a_plain({-4, -3, 0}, {5, 6, 14});
  const Result<SunStudy> study =
      study_sun(scene, {.period = equinox, .cell_m = 2.0, .area = {}, .has_facades = true});
  ASSERT_TRUE(study) << to_string(study.errors());
  EXPECT_EQ(study->columns, 30);
  EXPECT_EQ(study->rows, 30);
  EXPECT_NEAR(study->max_hours, 12.1, 0.1);
  int built = 0;
  for (const GroundCell& cell : study->cells) built += cell.kind == GroundCell::Kind::built ? 1 : 0;
  EXPECT_NEAR(built * 4.0, 9.0 * 9.0, 30.0);
  const OpenSpaceRule rule = open_space_rule(*study);
  EXPECT_NEAR(rule.area_m2, 3600.0 - built * 4.0, 1.0);
  EXPECT_TRUE(rule.is_kept());
  for (std::size_t i = 0; i + 2 < study->surfaces.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE(glm::distance(study->surfaces.positions[study->surfaces.indices[i + k]],
                              study->surfaces.positions[study->surfaces.indices[i + (k + 1) % 3]]),
                2.001f);
  const TestFolder folder;
  const Status written = write_sun_study(folder.path() / "box", *study);
  ASSERT_TRUE(written) << to_string(written.errors());
  const Result<Image8> plan = read_image8(folder.path() / "box.png");
  ASSERT_TRUE(plan);
  const SunPlan expected = sun_plan(*study);
  EXPECT_EQ(plan->width, expected.picture.width);
  EXPECT_EQ(expected.cell_px, 16);
  // The middle of the south-western cell, which is open, and of one of the box, which is paler than its
  // hours.
  const auto colour_at = [&](int column, int row) {
    const glm::ivec2 at = expected.corner + expected.cell_px * glm::ivec2(column, row) + expected.cell_px / 2;
    const std::uint8_t* pixel = plan->at(at.x, at.y);
    return glm::vec3(pixel[0], pixel[1], pixel[2]);
  };
  const glm::vec3 of_open = hours_colour(double(study->cells.front().hours) / study->max_hours);
  EXPECT_LT(glm::distance(colour_at(0, 29), of_open), 2.0f) << "row 0 of the study is the southernmost";
  EXPECT_GT(glm::distance(colour_at(15, 14), of_open), 20.0f);
  // The scale begins below with the colour of none, and ends with that of the most.
  EXPECT_LT(glm::distance(glm::vec3(plan->at(25, 560)[0], plan->at(25, 560)[1], plan->at(25, 560)[2]),
                          hours_colour(0.0)),
            2.0f);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "box.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "box.glb"));
}

TEST(SunStudy, ACourtyardWithoutSunBreaksTheRule) {
  // A deck over most of the plain.
  const scene::Scene scene = box_on_a_plain({-29, -29, 3}, {29, 29, 60});
  const Result<SunStudy> study =
      study_sun(scene, {.period = equinox, .cell_m = 1.0, .area = {}, .has_facades = false});
  ASSERT_TRUE(study) << to_string(study.errors());
  EXPECT_TRUE(study->surfaces.indices.empty());
  EXPECT_LT(open_space_rule(*study).share, 1.0);
}

TEST(SunStudy, RefusesWhatItCannotHold) {
  const scene::Scene scene = box_on_a_plain({-4, -3, 0}, {5, 6, 14});
  const auto study = study_sun(scene, {.period = equinox, .cell_m = 0.001, .area = {}, .has_facades = true});
  ASSERT_FALSE(study);
  EXPECT_NE(study.errors().front().message.find("take a larger cell"), std::string::npos);
  EXPECT_FALSE(
      study_sun(scene::Scene(), {.period = equinox, .cell_m = 2.0, .area = {}, .has_facades = true}));
}

TEST(FinerMesh, CoversTheSameArea) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {7, 0, 0}, {0, 5, 0}}, mesh.normals.assign(3, {0, 0, 1}),
  mesh.uvs.assign(3, {0, 0});
  mesh.indices = {0, 1, 2};
  Mesh fine;
  append_finer(fine, mesh, 0.5f, glm::vec2(-10), glm::vec2(10));
  const auto area = [](const Mesh& of) {
    float sum = 0.0f;
    for (std::size_t i = 0; i < of.indices.size(); i += 3) {
      const glm::vec3 a = of.positions[of.indices[i]], b = of.positions[of.indices[i + 1]],
                      c = of.positions[of.indices[i + 2]];
      sum += 0.5f * glm::cross(b - a, c - a).z;
    }
    return sum;
  };
  EXPECT_NEAR(area(fine), 17.5f, 1e-3f);
  Mesh part;
  append_finer(part, mesh, 0.1f, glm::vec2(5, 0.1f), glm::vec2(6, 0.6f));
  EXPECT_NEAR(area(part), 0.5f, 0.04f) << "of a triangle whose middle lies outside";
  Mesh outside;
  append_finer(outside, mesh, 0.5f, glm::vec2(20), glm::vec2(30));
  EXPECT_TRUE(outside.positions.empty());
}

}  // namespace
}  // namespace parvis::light
