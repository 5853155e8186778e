#include "planning/sun_hours/sun_hours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "base/files.h"
#include "base/image_io.h"
#include "base/test_folder.h"
#include "graphics/light/test_box.h"
#include "planning/sun_hours/finer_mesh.h"
#include "planning/sun_hours/sun_ground.h"
#include "planning/sun_hours/sun_plan.h"
#include "planning/sun_hours/sun_study.h"
#include "scene/data/surroundings.h"
#include "scene/data/test_scene.h"

namespace parvis::sun_hours {
namespace {

const SunPeriod at_equinox{.place = {.day_of_year = 80}, .first_day = 80, .last_day = 80};

TEST(SunHours, AnOpenPlainHasTheWholeDay) {
  const scene::Scene scene = light::box_on_a_plain({20, 20, 0}, {21, 21, 1});
  const reference::RayScene rays(scene);
  const std::vector<float> hours = sun_hours(rays, {{{-20, -20, 0.02f}, {0, 0, 1}}}, at_equinox);
  EXPECT_NEAR(hours[0], 12.1f, 0.1f);
}

TEST(SunHours, WallsFaceTheirHalfOfTheDay) {
  const scene::Scene scene = light::box_on_a_plain({-5, -5, 0}, {5, 5, 20});
  const reference::RayScene rays(scene);
  const std::vector<float> hours = sun_hours(rays,
                                             {{{0, -5.02f, 10}, {0, -1, 0}},
                                              {{5.02f, 0, 10}, {1, 0, 0}},
                                              {{-5.02f, 0, 10}, {-1, 0, 0}},
                                              {{0, 5.02f, 10}, {0, 1, 0}}},
                                             at_equinox);
  EXPECT_GT(hours[0], 11.5f);          // the south has all but minutes after sunrise and before sunset
  EXPECT_NEAR(hours[1], 6.05f, 0.1f);  // the east has the morning
  EXPECT_NEAR(hours[1] + hours[2], 12.1f, 0.1f);
  EXPECT_LT(hours[3], 0.6f);  // the north has next to nothing
}

TEST(SunHours, TheShadowOfAWallIsWhereTrigonometryPutsIt) {
  // North of a long wall 10 m high the noon shadow of the equinox at 43.7 degrees is 10 * tan(43.7) = 9.6 m
  // long, and at the equinox a straight wall that runs east and west casts one of constant length: shade all
  // day within, sun all day beyond.
  const scene::Scene scene = light::box_on_a_plain({-2000, -1, 0}, {2000, 0, 10});
  const reference::RayScene rays(scene);
  const std::vector<float> hours =
      sun_hours(rays, {{{0, 6.0f, 0.02f}, {0, 0, 1}}, {{0, 10.2f, 0.02f}, {0, 0, 1}}}, at_equinox);
  EXPECT_LT(hours[0], 1.5f);
  EXPECT_GT(hours[1], 10.5f);
}

TEST(SunHours, AgreesWithRaysEveryMinute) {
  const scene::Scene scene = light::box_on_a_plain({-4, -3, 0}, {5, 6, 14});
  const reference::RayScene rays(scene);
  std::vector<SunPoint> points;
  for (float x = -28; x < 28; x += 3)
    for (float y = -28; y < 28; y += 3) points.push_back({{x, y, 0.02f}, {0, 0, 1}});
  const std::vector<float> quick = sun_hours(rays, points, at_equinox),
                           truth = sun_hours_by_minutes(rays, points, at_equinox);
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

TEST(SunHours, ADayWhoseNightLiesOnOneDateHasAllButThatNight) {
  // Longyearbyen on 18 April 2026: the sun sets at 00:12 by summer time and rises at 01:39.
  const SunPeriod day{.place = {78.2232, 15.6267, 2.0, 2026, 108, 12.0}, .first_day = 108, .last_day = 108};
  const scene::Scene scene = light::box_on_a_plain({20, 20, 0}, {21, 21, 1});
  const reference::RayScene rays(scene);
  const std::vector<float> hours = sun_hours(rays, {{{-20, -20, 0.02f}, {0, 0, 1}}}, day);
  EXPECT_NEAR(hours[0], 22.4f, 0.3f);
}

TEST(SunHours, PolarNightHasNone) {
  const scene::Scene scene = light::box_on_a_plain({20, 20, 0}, {21, 21, 1});
  const reference::RayScene rays(scene);
  SunPeriod winter{.place = {.latitude_deg = 78.2, .longitude_deg = 15.6}, .first_day = 350, .last_day = 352};
  EXPECT_EQ(sun_hours(rays, {{{0, 0, 0.02f}, {0, 0, 1}}}, winter)[0], 0.0f);
}

TEST(SunHours, ASeasonGoesOnIntoTheNextYear) {
  const scene::Scene scene = light::box_on_a_plain({20, 20, 0}, {21, 21, 1});
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
  const SunStudyOptions options{.period = at_equinox, .cell_m = 1.0, .area = glm::dvec4(-3, -3, 9, 3)};
  const Result<SunStudy> study = study_sun(scene, options);
  ASSERT_TRUE(study) << to_string(study.errors());
  ASSERT_FALSE(study->surfaces.positions.empty());
  for (const glm::vec2 uv : study->surfaces.uvs) EXPECT_GT(uv.x, 0.9f) << "a wall to the south";
  scene.traced_kinds[0].is_recorded = false;
  EXPECT_FALSE(study_sun(scene, options)) << "leaves of trees, say";
}

/// A photographed place ends in a dome over everything, and so does a model that was made of one.
TEST(SunStudy, ABackdropHidesNoSun) {
  const scene::Scene plain = light::box_on_a_plain({20, 20, 0}, {21, 21, 1});
  const auto sky = std::make_shared<Mesh>();
  sky->positions = {{-300, -300, 90}, {-300, 300, 90}, {300, 300, 90}, {300, -300, 90}};
  sky->normals.assign(4, {0, 0, -1}), sky->uvs.assign(4, {0, 0});
  sky->indices = {0, 1, 2, 0, 2, 3};
  const auto hours = [&](const scene::Scene& scene, bool is_backdrop) {
    const Result<SunStudy> study = study_sun(
        scene, {.period = at_equinox, .cell_m = 2.0, .area = glm::dvec4(-9, -9, 9, 9), .has_facades = true});
    EXPECT_TRUE(study) << to_string(study.errors());
    EXPECT_LT(study->surfaces.bounds().max.z, is_backdrop ? 2.0f : 91.0f);
    return study->cells.front().position.z < 1.0f ? study->cells.front().hours : 0.0f;
  };
  const auto below_photographs = [&](const scene::TracedPlacing& placing) {
    scene::Scene scene = plain;
    scene.traced_kinds = {{.name = "facades",
                           .count = [](const scene::Scene&) { return 1; },
                           .trace =
                               [=](const scene::Scene&, scene::TracedScene& traced) {
                                 traced.add(sky, std::make_shared<Plaster>(), glm::mat4(1.0f), placing);
                               },
                           .is_recorded = true}};
    return hours(scene, placing.is_backdrop);
  };
  const auto below_model = [&](bool is_backdrop) {
    const auto model = std::make_shared<scene::Model>();
    model->materials.emplace_back().is_double_sided = true;
    model->parts.push_back(
        {.object = "sky", .mesh = *sky, .casts_shadow = !is_backdrop, .is_backdrop = is_backdrop});
    scene::Scene scene = plain;
    scene.objects.emplace_back().model = model;
    return hours(scene, is_backdrop);
  };
  EXPECT_GT(below_photographs({.casts_shadow = false, .is_backdrop = true}), 11.5f);
  EXPECT_GT(below_model(true), 11.5f);
  EXPECT_LT(below_photographs({}), 0.1f) << "the control: a roof";
  EXPECT_LT(below_photographs({.casts_shadow = false}), 0.1f) << "whatever pictures are to show of shadows";
  EXPECT_LT(below_model(false), 0.1f);
}

TEST(SunStudy, PlanTableAndModel) {
  const scene::Scene scene = light::box_on_a_plain({-4, -3, 0}, {5, 6, 14});
  const Result<SunStudy> study =
      study_sun(scene, {.period = at_equinox, .cell_m = 2.0, .area = {}, .has_facades = true});
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

TEST(SunStudy, LandToTheHorizonIsNoPartOfThePlace) {
  scene::Scene scene = light::box_on_a_plain({-4, -3, 0}, {5, 6, 14});
  const auto land = std::make_shared<scene::Model>();
  land->materials.push_back(scene::matt(glm::vec3(0.5f)));
  scene::Part part;
  part.mesh.positions = {{-9000, -9000, -1}, {9000, -9000, -1}, {9000, 9000, -1}, {-9000, 9000, -1}};
  part.mesh.normals.assign(4, {0, 0, 1}), part.mesh.uvs.assign(4, {0, 0});
  part.mesh.indices = {0, 1, 2, 0, 2, 3};
  land->parts.push_back(part);
  scene.objects.emplace_back().model = land;
  const SunStudyOptions options{.period = at_equinox, .cell_m = 2.0, .area = {}, .has_facades = false};
  EXPECT_FALSE(study_sun(scene, options)) << "the control: 81 million cells";
  scene.data<scene::ItemsOf<scene::Surroundings>>().items.push_back({land});
  const Result<SunStudy> study = study_sun(scene, options);
  ASSERT_TRUE(study) << to_string(study.errors());
  EXPECT_LT(study->columns, 100);
  EXPECT_GT(study->columns, 20);
}

TEST(SunStudy, ACourtyardWithoutSunBreaksTheRule) {
  // A deck over most of the plain.
  const scene::Scene scene = light::box_on_a_plain({-29, -29, 3}, {29, 29, 60});
  const Result<SunStudy> study =
      study_sun(scene, {.period = at_equinox, .cell_m = 1.0, .area = {}, .has_facades = false});
  ASSERT_TRUE(study) << to_string(study.errors());
  EXPECT_TRUE(study->surfaces.indices.empty());
  EXPECT_LT(open_space_rule(*study).share, 1.0);
}

TEST(SunStudy, RefusesWhatItCannotHold) {
  const scene::Scene scene = light::box_on_a_plain({-4, -3, 0}, {5, 6, 14});
  const auto study =
      study_sun(scene, {.period = at_equinox, .cell_m = 0.001, .area = {}, .has_facades = true});
  ASSERT_FALSE(study);
  EXPECT_NE(study.errors().front().message.find("take a larger cell"), std::string::npos);
  EXPECT_FALSE(
      study_sun(scene::Scene(), {.period = at_equinox, .cell_m = 2.0, .area = {}, .has_facades = true}));
}

/// A level slab of one quad that faces up.
scene::Object slab(const std::string& name, glm::vec2 low, glm::vec2 high, float z) {
  scene::Part part;
  part.object = name + " part";
  part.mesh.positions = {{low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}};
  part.mesh.normals.assign(4, {0, 0, 1}), part.mesh.uvs.assign(4, {0, 0});
  part.mesh.indices = {0, 1, 2, 0, 2, 3};
  auto model = std::make_shared<scene::Model>();
  model->materials.push_back({.name = name + " stone"});
  model->parts.push_back(std::move(part));
  scene::Object object;
  object.name = name, object.model = model;
  return object;
}

/// A wall of 60 m that runs east and west, a plain about it, and a roof 14 m over the plain in the south.
scene::Scene wall_and_roof() {
  scene::Scene scene = light::box_on_a_plain({-30, 0, 0}, {30, 1, 40});
  scene.objects.push_back(slab("roof garden", {-10, -25}, {10, -15}, 14.0f));
  return scene;
}

Result<SunStudy> study_judging(const JudgedGround& judged) {
  return study_sun(wall_and_roof(),
                   {.period = at_equinox, .cell_m = 1.0, .area = {}, .has_facades = false, .judged = judged});
}

TEST(JudgedGround, AnOutlineIsJudgedByItself) {
  const Result<SunStudy> north =
                             study_judging({.names = {}, .outline = {{-20, 1}, {20, 1}, {20, 3}, {-20, 3}}}),
                         south = study_judging({.names = {}, .outline = {{-20, -13}, {20, -13}, {20, -3}}}),
                         all = study_judging({});
  for (const Result<SunStudy>* study : {&north, &south, &all})
    ASSERT_TRUE(*study) << to_string(study->errors());
  EXPECT_NEAR(open_space_rule(*north).area_m2, 80.0, 1.0);
  EXPECT_FALSE(open_space_rule(*north).is_kept()) << "in the shade of the wall";
  EXPECT_NEAR(open_space_rule(*south).area_m2, 200.0, 25.0) << "a triangle, in cells of a metre";
  EXPECT_EQ(open_space_rule(*south).share, 1.0);
  EXPECT_GT(open_space_rule(*all).area_m2, 3000.0);
  EXPECT_TRUE(north->is_chosen);
  EXPECT_FALSE(all->is_chosen);
  EXPECT_EQ(to_string(OpenSpaceRule{.share = 0.615, .area_m2 = 1234.2}), "1234 m2, 61.5 % with 2 h or more");
}

TEST(JudgedGround, WhatIsNamedIsGroundWhereverItLies) {
  for (const char* name : {"roof garden", "roof*", "roof garden part", "*stone"}) {
    const Result<SunStudy> study = study_judging({.names = {name}, .outline = {}});
    ASSERT_TRUE(study) << name << to_string(study.errors());
    EXPECT_NEAR(open_space_rule(*study).area_m2, 200.0, 1.0) << name;
  }
  const Result<SunStudy> half =
      study_judging({.names = {"roof garden"}, .outline = {{0, -30}, {30, -30}, {30, 30}, {0, 30}}});
  ASSERT_TRUE(half) << to_string(half.errors());
  EXPECT_NEAR(open_space_rule(*half).area_m2, 100.0, 1.0) << "both: what lies in both";
  const Result<SunStudy> both = study_judging({.names = {"roof garden", "box"}, .outline = {}});
  ASSERT_TRUE(both) << to_string(both.errors());
  EXPECT_NEAR(open_space_rule(*both).area_m2, 3600.0, 1.0) << "the wall's top, too";
}

TEST(JudgedGround, SaysWhichNamesThereAre) {
  for (const char* name : {"rof garden", ""}) {
    const Result<SunStudy> study = study_judging({.names = {name}, .outline = {}});
    ASSERT_FALSE(study) << name;
    const std::string message = to_string(study.errors());
    EXPECT_NE(message.find("\"roof garden\""), std::string::npos) << message;
    EXPECT_NE(message.find("\"box\""), std::string::npos) << message;
  }
  const Result<SunStudy> nowhere =
      study_judging({.names = {}, .outline = {{100, 100}, {110, 100}, {110, 110}}});
  ASSERT_FALSE(nowhere);
  EXPECT_NE(to_string(nowhere.errors()).find("check its names, its outline"), std::string::npos);
}

TEST(JudgedGround, OutlinesThatAreNoneAreRefused) {
  const auto message = [](std::vector<glm::dvec2> corners) {
    const auto outline = checked_outline(std::move(corners));
    return outline ? std::string() : to_string(outline.errors());
  };
  const auto says = [&](const std::vector<glm::dvec2>& corners, const char* words) {
    EXPECT_NE(message(corners).find(words), std::string::npos) << message(corners);
  };
  says({}, "3 to 1000 corners; this one has 0");
  says({{0, 0}, {5, 0}}, "this one has 2");
  says({{0, 0}, {5, 0}, {5, 0}, {0, 0}}, "this one has 2");
  says(std::vector<glm::dvec2>(5000, glm::dvec2(1.0)), "this one has 1");
  says({{0, 0}, {5, 5}, {5, 0}, {0, 5}},
       "crosses itself: its side from corner 1 to 2 meets that from corner 3 to 4");
  says({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, "crosses itself");  // touches
  says({{0, 0}, {4, 0}, {2, 0}}, "goes back over itself");
  says({{0, 0}, {1e-3, 0}, {0, 1e-3}}, "no area");
  std::vector<glm::dvec2> circle;
  circle.reserve(1001);
  for (int i = 0; i < 1001; ++i) circle.emplace_back(50.0 * std::cos(i / 160.0), 50.0 * std::sin(i / 160.0));
  says(circle, "this one has 1001");
  circle.pop_back();
  EXPECT_EQ(message(circle), "");
  EXPECT_EQ(message({{0, 0}, {0, 5}, {5, 5}, {5, 0}}), "") << "clockwise";
  const auto closed = checked_outline({{0, 0}, {5, 0}, {5, 5}, {0, 0}});
  ASSERT_TRUE(closed) << to_string(closed.errors());
  EXPECT_EQ(closed->size(), 3u) << "the first corner once more";
}

TEST(JudgedGround, CellsInsideAConcaveOutline) {
  // A U of 10 x 10 m around a notch of 4 x 6 m, in cells of half a metre.
  const std::vector<glm::dvec2> outline{{0, 0}, {10, 0}, {10, 10}, {7, 10}, {7, 4}, {3, 4}, {3, 10}, {0, 10}};
  const std::vector<std::uint8_t> inside = cells_inside(outline, {-2, -2}, 0.5, 30, 30);
  EXPECT_EQ(std::ranges::count(inside, 1), 4 * (100 - 24));
  const auto at = [&](double x, double y) {
    return inside[std::size_t((y + 2.0) / 0.5) * 30 + std::size_t((x + 2.0) / 0.5)] != 0;
  };
  EXPECT_TRUE(at(1.2, 9.2) && at(9.2, 9.2) && at(5.2, 2.2));
  EXPECT_FALSE(at(5.2, 7.2) || at(-1.2, 5.2) || at(11.2, 5.2) || at(5.2, 11.2));
}

/// A line around it, and its figures below.
TEST(JudgedGround, StandsInPlanAndTable) {
  const Result<SunStudy> study = study_judging(
                             {.names = {}, .outline = {{-20, 3}, {20, 3}, {20, 13}, {-20, 13}}}),
                         all = study_judging({});
  ASSERT_TRUE(study && all);
  const SunPlan plan = sun_plan(*study), without = sun_plan(*all);
  EXPECT_GT(plan.picture.height, without.picture.height) << "a line of text more";
  const auto difference_at = [&](double x, double y) {
    const glm::ivec2 at =
        plan.corner + glm::ivec2(int((x + 30.0) * plan.cell_px), int((30.0 - y) * plan.cell_px));
    const std::uint8_t *one = plan.picture.at(at.x, at.y), *other = without.picture.at(at.x, at.y);
    return std::abs(one[0] - other[0]) + std::abs(one[1] - other[1]) + std::abs(one[2] - other[2]);
  };
  EXPECT_GT(difference_at(0, 12.97), 20) << "its northern side";
  EXPECT_GT(difference_at(-19.97, 8), 20) << "its western side";
  EXPECT_EQ(difference_at(0.5, 8.5), 0) << "inside";
  EXPECT_EQ(difference_at(0.5, -8.5), 0) << "outside";
  const TestFolder folder;
  ASSERT_TRUE(write_sun_study(folder.path() / "judged", *study));
  const Result<std::string> table = read_file(folder.path() / "judged.csv");
  ASSERT_TRUE(table);
  EXPECT_TRUE(table->starts_with("x_m,y_m,z_m,kind,hours,judged\n"));
  std::size_t judged = 0;
  for (std::size_t at = table->find(",1\n"); at != std::string::npos; at = table->find(",1\n", at + 1))
    ++judged;
  EXPECT_EQ(judged, 400u);
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
}  // namespace parvis::sun_hours
