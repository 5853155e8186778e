// Tracks, timetables, trams on their rails, and scripts that cannot be run.
#include <gtest/gtest.h>

#include <cmath>

#include "life/tram/track.h"
#include "life/tram/tram_process.h"
#include "room_list.h"
#include "scene/action/scene_clock.h"
#include "scene/script/test_script.h"

namespace parvis::tram {
namespace {

scene::MeasuredPath bend(float radius_m) {
  auto line = driveable(smooth_line({{-120, 0, 0}, {0, 0, 0}, {0, 120, 0}}, radius_m));
  EXPECT_TRUE(line);
  return line ? *line : scene::MeasuredPath();
}

float distance_to(const scene::MeasuredPath& line, glm::vec3 point) {
  float best = 1e9f;
  for (std::size_t i = 0; i + 1 < line.points().size(); ++i) {
    const glm::vec2 a(line.points()[i]), along = glm::vec2(line.points()[i + 1]) - a;
    const float t = glm::clamp(glm::dot(glm::vec2(point) - a, along) / glm::dot(along, along), 0.0f, 1.0f);
    best = std::min(best, glm::distance(glm::vec2(point), a + t * along));
  }
  return best;
}

TEST(Track, CurvesAreSmoothAndKeepToTheirRadius) {
  const scene::MeasuredPath line = bend(25.0f);
  const scene::Path& p = line.points();
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const glm::vec3 a = p[i] - p[i - 1], b = p[i + 1] - p[i];
    EXPECT_LT(std::abs(std::atan2(scene::cross_in_plan(a, b), glm::dot(glm::vec2(a), glm::vec2(b)))),
              glm::radians(2.0f));
  }
  EXPECT_NEAR(distance_to(line, {-25.0f * (1.0f - std::sqrt(0.5f)), 25.0f * (1.0f - std::sqrt(0.5f)), 0}),
              0.0f, 0.12f)
      << "the middle of the arc";
}

TEST(Track, WhatNoTramCanRunIsAnError) {
  EXPECT_FALSE(driveable(smooth_line({{0, 0, 0}, {40, 0, 0}}, 25.0f))) << "shorter than a tram needs";
  EXPECT_FALSE(driveable(smooth_line({{0, 0, 0}, {30'000, 0, 0}}, 25.0f)));
  EXPECT_FALSE(driveable(smooth_line({{-50, 0, 0}, {0, 0, 0}, {6, 6, 0}, {6, 60, 0}}, 25.0f)))
      << "too tight: no room for the radius";
  EXPECT_FALSE(driveable(smooth_line({{0, 0, 0}, {100, 0, 30}}, 25.0f))) << "climbs 30 %";
  EXPECT_TRUE(driveable(smooth_line({{0, 0, 0}, {100, 0, 6}}, 25.0f)));
  EXPECT_FALSE(driveable({})) << "no points";
}

TEST(Track, RailsLieAtTheGaugeInThePaving) {
  const auto model = track_model(bend(25.0f), false, {});
  const scene::MeasuredPath line = bend(25.0f);
  int rails = 0;
  for (const scene::Part& part : model->parts) {
    EXPECT_TRUE(check(part.mesh, part.object));
    if (part.object != "rail") continue;
    for (const glm::vec3 p : part.mesh.positions) {
      const float away = distance_to(line, p);
      EXPECT_TRUE(std::abs(away - 0.5f * gauge_m) < 0.01f || std::abs(away - 0.5f * gauge_m - 0.056f) < 0.01f)
          << away;
      EXPECT_NEAR(p.z, 0.03f, 1e-4f);
      ++rails;
    }
    for (const glm::vec3 n : part.mesh.normals) EXPECT_GT(n.z, 0.9f) << "seen from above";
  }
  EXPECT_GT(rails, 100);
}

TEST(Timetable, KeepsToSpeedAndAccelerationAndStopsAtItsStops) {
  const scene::MeasuredPath line = bend(30.0f);
  const Timetable timetable(line, length_m, line.length(), {{80.0f, 15.0f, true}}, 11.0f, length_m);
  constexpr double step = 0.05;
  float dwelt = 0.0f, before = timetable.at(0.0).speed_m_s, slowest_in_curve = 1e9f;
  double front = timetable.at(0.0).front_m;
  EXPECT_NEAR(front, double(length_m), 1e-3);
  for (double t = step; t < timetable.duration_s(); t += step) {
    const Moment m = timetable.at(t);
    EXPECT_GE(m.front_m, front - 1e-6) << "never backward";
    EXPECT_NEAR((m.front_m - front) / step, 0.5 * double(m.speed_m_s + before), 0.05)
        << "the speed is that of the motion at " << t;
    EXPECT_LE(m.speed_m_s, timetable.speed_limit_m_s(float(m.front_m)) + 0.35f);
    EXPECT_LT(std::abs(m.speed_m_s - before) / step, 1.15) << "at " << t;
    if (m.stop >= 0) {
      dwelt += float(step);
      EXPECT_NEAR(m.front_m, 80.0, 0.26);
    } else {
      EXPECT_EQ(m.doors, 0.0f) << "doors are shut while it moves";
    }
    if (m.front_m > 125.0 && m.front_m < 135.0) slowest_in_curve = std::min(slowest_in_curve, m.speed_m_s);
    front = m.front_m, before = m.speed_m_s;
  }
  EXPECT_NEAR(dwelt, 15.0f, 0.11f);
  EXPECT_NEAR(slowest_in_curve, std::sqrt(lateral_m_s2 * 30.0f), 0.5f);
  EXPECT_EQ(timetable.at(timetable.duration_s() + 100.0).front_m,
            timetable.at(timetable.duration_s()).front_m);
}

TEST(Timetable, TramsAtTheShortestHeadwayStayApart) {
  const scene::MeasuredPath line = bend(20.0f);
  const Timetable timetable(line, length_m, line.length(), {{90.0f, 30.0f, false}}, 11.0f, length_m);
  const double headway = min_headway_s(timetable);
  EXPECT_GT(headway, 30.0) << "the dwell";
  const auto nearest_m = [&](double headway_s) {
    double least = 1e9;
    for (double t = headway_s; t < timetable.duration_s(); t += 0.25)
      least = std::min(least, timetable.at(t).front_m - timetable.at(t - headway_s).front_m);
    return least - double(length_m);
  };
  EXPECT_GT(nearest_m(headway), 3.5);
  EXPECT_LT(nearest_m(headway - 12.0), 0.0) << "the control: they collide";
}

TEST(TramBody, BogiesFollowTheRailsAndSectionsHoldTogether) {
  const scene::MeasuredPath line = bend(20.0f);
  for (double front = double(length_m); front < double(line.length()); front += 1.3) {
    const auto placed = placed_sections(line, front);
    float begins = 0.0f;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const auto in_world = [&](std::size_t s, float x) {
        return glm::vec3(placed[s] * glm::vec4(x, 0, 0, 1));
      };
      if (bogie_m[i] > 0.0f) {
        for (const float axle : {0.5f, -0.5f})
          EXPECT_LT(distance_to(line, in_world(i, -bogie_m[i] + axle * wheelbase_m)), 0.03f)
              << "axles on the rails";
      }
      if (i > 0) {
        EXPECT_LT(glm::distance(in_world(i - 1, -section_length_m[i - 1]), in_world(i, 0.0f)), 0.12f)
            << "joint " << i << " at " << front;
      }
      begins += section_length_m[i];
    }
    EXPECT_NEAR(begins, length_m, 1e-4f);
  }
}

TEST(TramBody, ModelsAreSoundAndDoorsOpenOnOneSideOnly) {
  for (const SectionKind kind :
       {SectionKind::front, SectionKind::hung, SectionKind::middle, SectionKind::rear}) {
    const auto model = section_model(kind, glm::vec3(0.5f));
    for (const scene::Part& part : model->parts) EXPECT_TRUE(check(part.mesh, part.object)) << part.object;
    for (const scene::Part& part : model->parts)
      for (std::size_t v = 0; v < part.mesh.positions.size(); ++v)
        if (part.node == 0 && part.object == "lacquer" && std::abs(part.mesh.normals[v].y) > 0.9f) {
          EXPECT_GT(part.mesh.normals[v].y * part.mesh.positions[v].y, 0.0f) << "walls are seen from outside";
        }
    const Bounds box = scene::bounds(*model);
    EXPECT_NEAR(box.size().y, width_m, 0.12f);
    EXPECT_GE(box.min.z, -0.01f);
  }
  const auto hung = section_model(SectionKind::hung, glm::vec3(0.5f));
  const auto shut = section_pose(*hung, 0.0f, true, 0.0), open = section_pose(*hung, 1.0f, true, 0.0);
  int moved = 0;
  for (std::size_t n = 0; n < shut.size(); ++n) {
    const bool is_left = hung->nodes[n].name.starts_with("door left");
    EXPECT_EQ(shut[n] != open[n], is_left) << hung->nodes[n].name;
    if (is_left) {
      EXPECT_NEAR(glm::distance(glm::vec3(shut[n][3]), glm::vec3(open[n][3])), 0.65f, 0.05f);
    }
    moved += is_left ? 1 : 0;
  }
  EXPECT_EQ(moved, 4);
}

class TramNodeTest : public scene::ScriptTest<> {
 protected:
  TramNodeTest()
      : ScriptTest([] {
          Registries registries;
          script::register_room(registries), action::register_room(registries),
              tram::register_room(registries);
          return registries;
        }()) {}
};

const std::string script_of_line =
    "tram(path=\"-150 0, 0 0, 150 80\", radius=40, headway_s=60) {\n  tramStop(position=\"-40 -3 0\")\n}\n";

TEST_F(TramNodeTest, AnySecondIsTheSameWhicheverWayItIsReached) {
  const auto at = [&](std::vector<double> steps) {
    auto loaded = load(script_of_line);
    EXPECT_TRUE(loaded) << (loaded ? "" : to_string(loaded.errors()));
    TramProcess process;
    action::SharedByProcesses shared;
    process.begin(loaded->scene, shared);
    for (const double seconds : steps)
      for (int i = 0; i < int(std::lround(seconds / action::step_s)); ++i) process.step(loaded->scene);
    process.present(loaded->scene, 0.0);
    std::vector<glm::mat4> places;
    for (const scene::Object& object : loaded->scene.objects)
      places.push_back(object.world_from_model),
          places.insert(places.end(), object.pose.begin(), object.pose.end());
    return places;
  };
  EXPECT_EQ(at({10.0, 20.0, 17.0}), at({47.0}));
  EXPECT_NE(at({47.0}), at({46.0}));
}

TEST_F(TramNodeTest, TramsDwellAtTheStopWithTheirDoorsOnItsSide) {
  const scene::Scene scene = scene_of(script_of_line);
  ASSERT_EQ(scene.items<TramLine>().size(), 1u);
  const TramLine& line = scene.items<TramLine>().front();
  ASSERT_EQ(line.timetable->stops().size(), 1u);
  EXPECT_FALSE(line.timetable->stops()[0].is_on_left);
  EXPECT_NEAR(line.timetable->stops()[0].front_m, 110.0f + 0.5f * length_m, 0.5f);
  EXPECT_EQ(scene.objects.front().name, "tram track");
}

TEST_F(TramNodeTest, BadValuesAreErrorsWithTheirPlace) {
  EXPECT_TRUE(holds(errors_of("tram(path=\"0 0, 30 0\")"), "scene.xp:1:11: ")) << "too short";
  EXPECT_TRUE(holds(errors_of("tram(path=\"0 0 0, 100 0 30\")"), "climbs 30 %"));
  EXPECT_TRUE(holds(errors_of("tram(path=\"0 0, 200 0\") { tramStop(position=\"100 40 0\") }"),
                    "40.0 m from the track"));
  EXPECT_TRUE(holds(errors_of("tram(path=\"0 0, 200 0\") { tramStop(position=\"3 3 0\") }"), "half a tram"));
  EXPECT_TRUE(holds(
      errors_of("tram(path=\"0 0, 200 0\") { tramStop(position=\"80 3 0\") tramStop(position=\"90 3 0\") }"),
      "another stop"));
  EXPECT_TRUE(holds(
      errors_of("tram(path=\"0 0, 200 0\", headway_s=30) { tramStop(position=\"80 3 0\", dwell_s=60) }"),
      "needs"));
  EXPECT_TRUE(holds(errors_of("tramStop(position=\"0 0 0\")"), "tramStop"));
}

}  // namespace
}  // namespace parvis::tram
