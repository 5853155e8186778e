// Bodies, gait, and feet that stay where they stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "life/people/person_model.h"
#include "life/people/test_feet.h"
#include "life/people/walking_body.h"
#include "room_list.h"
#include "scene/script/test_script.h"

namespace parvis::people {
namespace {

constexpr float frame_s = 1.0f / 60.0f;

BodyField adult() { return BodyField(shape_of({.sex = Sex::male, .age = 35.0f, .bmi = 23.0f})); }

TEST(BodyShape, FollowsTheTablesByAgeAndSex) {
  EXPECT_NEAR(shape_of({.sex = Sex::male, .age = 30.0f}).stature, 1.76f, 0.005f);
  EXPECT_NEAR(shape_of({.sex = Sex::female, .age = 30.0f}).stature, 1.63f, 0.01f);
  EXPECT_NEAR(shape_of({.sex = Sex::female, .age = 8.0f}).stature, 1.275f, 0.005f);
  EXPECT_LT(mean_stature_m(Sex::male, 85.0f), mean_stature_m(Sex::male, 40.0f));
  const BodyShape child = shape_of({.age = 5.0f}), grown = shape_of({.age = 30.0f});
  EXPECT_GT(child.head / child.stature, 1.25f * grown.head / grown.stature)
      << "small children have large heads";
  EXPECT_NEAR(grown.stature / grown.head, 7.6f, 0.4f);
  for (const BodyShape& s : {child, grown}) {
    EXPECT_LT(s.ankle_z, s.knee_z);
    EXPECT_LT(s.knee_z, s.hip_z);
    EXPECT_LT(s.hip_z, s.shoulder_z);
    EXPECT_LT(s.shoulder_z, s.chin_z);
  }
}

std::size_t vertices_of(const scene::Model& model) {
  std::size_t count = 0;
  for (const scene::Part& part : model.parts) count += part.mesh.positions.size();
  return count;
}

TEST(PersonModel, IsSoundAtEveryLevelForPeopleOfAllKinds) {
  for (const std::uint64_t number : {1u, 4u, 12u, 15u}) {
    const Someone who = someone(number);
    const Colours colours = colours_of(who, number);
    std::array<std::size_t, detail_count> count{};
    const PersonLevels person = make_levels(who, colours);
    for (std::size_t level = 0; level < detail_count; ++level) {
      const scene::Model& model = *person.models[level];
      ASSERT_EQ(model.nodes.size(), std::size_t(bone_count) + 1);
      for (const scene::Part& part : model.parts) {
        EXPECT_TRUE(check(part.mesh, part.object)) << number << " " << part.object;
        ASSERT_LT(std::size_t(part.material), model.materials.size());
        ASSERT_TRUE(part.deformation) << "skinned";
        for (std::size_t v = 0; v < part.mesh.positions.size(); ++v) {
          const glm::vec4 w = part.deformation->skin.weights[v];
          ASSERT_NEAR(w.x + w.y + w.z + w.w, 1.0f, 1e-4f);
          ASSERT_NEAR(glm::length(part.mesh.normals[v]), 1.0f, 0.02f) << part.object;
        }
      }
      const float stature = person.body.shape().stature;
      const Bounds box = scene::bounds(model);
      EXPECT_NEAR(box.min.z, 0.0f, 0.03f);
      EXPECT_NEAR(box.max.z, stature, 0.09f * stature) << "hair and hats above the vertex";
      EXPECT_LT(box.size().x, 0.45f * stature);
      count[level] = vertices_of(model);
    }
    EXPECT_LE(count[0], 10'000u) << number;
    EXPECT_LT(2 * count[1], count[0]);
    EXPECT_LT(2 * count[2], count[1]);
    EXPECT_LT(count[2], 1'200u);
    EXPECT_LT(count[3], 200u);
  }
}

TEST(PersonModel, WearsOtherColoursAsOnePart) {
  const Someone who = someone(5);
  const PersonLevels person = make_levels(who, colours_of(who, 5));
  for (const Detail detail : {Detail::far, Detail::distant}) {
    const auto level = std::size_t(detail);
    ASSERT_EQ(person.models[level]->parts.size(), 1u);
    const PersonLevels::Cover& cover = person.covers[level];
    ASSERT_EQ(cover.surfaces.size(), vertices_of(*person.models[level]));
    Colours red = colours_of(who, 5);
    const std::vector<glm::vec4> before = painted_vertices(cover, who, red);
    red.top = {1, 0, 0};
    const std::vector<glm::vec4> after = painted_vertices(cover, who, red);
    for (std::size_t v = 0; v < after.size(); ++v)
      if (cover.surfaces[v] == top_cloth)
        EXPECT_EQ(after[v].y, 0.0f);
      else
        EXPECT_EQ(after[v], before[v]);
    EXPECT_GT(std::ranges::count(cover.surfaces, top_cloth), 5);
  }
}

TEST(PersonModel, FollowsFromItsNumberAndDiffersByIt) {
  const auto model = [](std::uint64_t number) {
    return make_person(someone(number), colours_of(someone(number), number)).model;
  };
  const auto a = model(3), b = model(3), c = model(4);
  ASSERT_EQ(vertices_of(*a), vertices_of(*b));
  for (std::size_t p = 0; p < a->parts.size(); ++p)
    EXPECT_EQ(a->parts[p].mesh.positions, b->parts[p].mesh.positions);
  EXPECT_NE(a->parts.front().mesh.positions, c->parts.front().mesh.positions);
  EXPECT_NE(a->textures.front().image.pixels, c->textures.front().image.pixels);
}

TEST(Gait, LegsMoveAsInNormalGait) {
  const BodyField body = adult();
  const Stride stride = stride_of(body.shape(), 1.34f);
  EXPECT_NEAR(stride.length_m, 1.43f, 0.12f);
  constexpr int samples = 60;
  float knee_error = 0.0f, peak = 0.0f;
  std::vector<float> hip_difference;  // but for the tilt of the pelvis against which a laboratory measures
  for (int i = 0; i < samples; ++i) {
    const float phase = float(i) / float(samples);
    const Posture posture = walking(body, stride, straight_feet(body, stride, phase));
    const glm::quat thigh = posture.turn[pelvis] * posture.turn[left_thigh];
    const auto pitch = [](glm::quat q) {  // flexion forward, of what hangs down
      const glm::vec3 down = q * glm::vec3(0, 0, -1);
      return glm::degrees(std::atan2(down.x, -down.z));
    };
    const float knee = pitch(thigh) - pitch(thigh * posture.turn[left_shin]);
    const LegAngles truth = normal_angles(phase);
    knee_error += (knee - truth.knee) * (knee - truth.knee) / float(samples);
    hip_difference.push_back(pitch(thigh) - truth.hip);
    peak = std::max(peak, knee);
  }
  EXPECT_LT(std::sqrt(knee_error), 9.0f);
  float mean = 0.0f, hip_error = 0.0f;
  for (const float d : hip_difference) mean += d / float(samples);
  for (const float d : hip_difference) hip_error += (d - mean) * (d - mean) / float(samples);
  EXPECT_LT(std::sqrt(hip_error), 6.0f);
  EXPECT_NEAR(mean, 0.0f, 13.0f);
  EXPECT_NEAR(peak, 60.0f, 12.0f) << "the knee of the leg that swings";
}

constexpr float lead_step_s = 0.1f;

/// Leads a body along and measures its feet; `along` gives the lead at a time.
template <class Along>
SlideMeter measured(const BodyField& body, float seconds, const Along& along) {
  WalkingBody walker(body, along(0.0f), 0.4f);
  SlideMeter meter;
  constexpr int frames_per_step = int(lead_step_s / frame_s + 0.5f);
  for (int s = 1; float(s) * lead_step_s < seconds; ++s) {
    walker.step(along(float(s) * lead_step_s), lead_step_s, [](glm::vec3) { return 0.0f; });
    for (int f = 0; f < frames_per_step; ++f) {
      const float part = float(f) / float(frames_per_step);
      meter.add(contact_points(body, walker.lead_at(part), walker.posture_at(part)));
    }
  }
  return meter;
}

TEST(WalkingBody, FeetDoNotSlide) {
  for (const float age : {8.0f, 35.0f}) {
    const BodyField body(shape_of({.age = age}));
    for (const float speed : {0.6f, 1.0f, 1.34f, 1.7f}) {
      const float own = age < 18.0f ? 0.8f * speed : speed;
      SlideMeter meter = measured(body, 20.0f, [&](float t) { return Lead{{own * t, 0, 0}, 0.0f}; });
      EXPECT_LT(meter.slide_m(), 0.01f) << own << " m/s at " << age;
      EXPECT_GT(meter.lowest(), -0.01f) << "no foot goes through the ground";
    }
  }
}

TEST(WalkingBody, FeetDoNotSlideInTurnsNorWhenPeopleStopAndGo) {
  const BodyField body = adult();
  SlideMeter turns = measured(body, 30.0f, [](float t) {
    const float radius = 2.0f, angle = 1.2f * t / radius;
    return Lead{{radius * std::sin(angle), radius * (1.0f - std::cos(angle)), 0}, angle};
  });
  EXPECT_LT(turns.slide_m(), 0.01f);
  float way = 0.0f, last = 0.0f;
  SlideMeter stops = measured(body, 40.0f, [&](float t) {
    const float speed = 1.3f * std::clamp(2.0f * std::sin(0.9f * t), 0.0f, 1.0f);
    way += speed * (t - last), last = t;
    return Lead{{way, 0, 0}, 0.0f};
  });
  EXPECT_LT(stops.slide_m(), 0.01f);
}

TEST(WalkingBody, AStrideThatDoesNotFitTheSpeedSlides) {
  // The control: the cycle on the spot, carried along a fifth too fast.
  const BodyField body = adult();
  const Stride stride = stride_of(body.shape(), 1.3f);
  const auto carried = [&](float factor) {
    SlideMeter meter;
    for (int f = 0; f < 600; ++f) {
      const float way = 1.3f * frame_s * float(f), phase = way / stride.length_m;
      meter.add(
          contact_points(body, Lead{{factor * way, 0, 0}, 0.0f},
                         walking(body, stride, straight_feet(body, stride, phase - std::floor(phase)))));
    }
    return meter.slide_m();
  };
  EXPECT_LT(carried(1.0f), 0.01f);
  EXPECT_GT(carried(1.2f), 0.05f);
}

TEST(WalkingBody, StandsOnBothFeetWhenItIsAtRest) {
  const BodyField body = adult();
  WalkingBody walker(body, {}, 0.2f);
  const auto ground = [](glm::vec3) { return 0.0f; };
  float x = 0.0f;
  for (int s = 0; s < 40; ++s) walker.step({{x += 0.12f, 0, 0}, 0.0f}, lead_step_s, ground);
  EXPECT_TRUE(walker.walks());
  for (int s = 0; s < 40; ++s) walker.step({{x, 0, 0}, 0.0f}, lead_step_s, ground);
  EXPECT_FALSE(walker.walks());
  const std::array<glm::vec3, 4> points = contact_points(body, walker.lead_at(1.0f), walker.posture_at(1.0f));
  for (const glm::vec3 p : points) {
    EXPECT_NEAR(p.z, 0.0f, 0.005f);
    EXPECT_NEAR(p.x, x, 0.25f) << "under the body";
  }
}

TEST(OnTheSpot, WhoSitsSitsOnTheSeatWithFeetOnTheGround) {
  const BodyField body = adult();
  const Posture posture = on_the_spot(body, Activity::sit, 1.0f, 0.3f, 0.45f);
  const std::vector<glm::mat4> pose = pose_of(body.skeleton(), posture);
  EXPECT_NEAR(pose[left_thigh + 1][3].z, 0.45f + 0.035f * body.shape().stature, 0.03f)
      << "hip joints above the seat";
  EXPECT_GT(pose[left_shin + 1][3].x, 0.3f) << "knees in front";
  for (const glm::vec3 p : contact_points(body, {}, posture)) EXPECT_NEAR(p.z, 0.0f, 0.01f);
}

class PersonNodeTest : public scene::ScriptTest<> {
 protected:
  PersonNodeTest()
      : ScriptTest([] {
          Registries registries;
          script::register_room(registries), action::register_room(registries),
              people::register_room(registries);
          return registries;
        }()) {}
};

TEST_F(PersonNodeTest, PlacesSomebodyWhoDoesWhatIsAsked) {
  const scene::Scene scene = scene_of(
      "person(name=\"ann\", seed=4, sex=\"female\", age=30, does=\"sit\", position=\"2 3 0.1\", "
      "heading_deg=90)\n"
      "person(seed=4, sex=\"female\", age=30, does=\"walk\")\n");
  ASSERT_EQ(scene.objects.size(), 2u);
  const scene::Object& ann = scene.objects[0];
  EXPECT_EQ(ann.name, "ann");
  EXPECT_EQ(ann.model, scene.objects[1].model) << "the same person is made once";
  EXPECT_NEAR(glm::distance(glm::vec3(ann.world_from_model[3]), glm::vec3(2, 3, 0.1f)), 0.0f, 1e-4f);
  EXPECT_NEAR(ann.world_from_model[0].y, -1.0f, 1e-4f) << "turned clockwise";
  EXPECT_EQ(ann.model->animations[std::size_t(ann.played.animation)].name, "sit");
  EXPECT_EQ(ann.deformed_meshes.size(), ann.model->parts.size());
}

TEST_F(PersonNodeTest, BadValuesAreErrors) {
  EXPECT_TRUE(holds(errors_of("person(does=\"fly\")"), "scene.xp:1:13: "));
  EXPECT_TRUE(holds(errors_of("person(age=200)"), "scene.xp:1:12: "));
  EXPECT_TRUE(holds(errors_of("person(seed=-1)"), "scene.xp:1:13: "));
}

}  // namespace
}  // namespace parvis::people
