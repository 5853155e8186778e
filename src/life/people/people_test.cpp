// Bodies, gait, and feet that stay where they stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "life/people/companions.h"
#include "life/people/person_pictures.h"
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
    EXPECT_LT(count[2], 1'300u);
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

/// Heights at which a level of somebody has no surface on one side of the body, from the ankles to the hips.
int gaps_of_legs(const PersonLevels& levels, Detail detail) {
  const BodyShape& s = levels.body.shape();
  constexpr int slices = 24;
  int gaps = 0;
  for (const float side : {1.0f, -1.0f})
    for (int i = 0; i < slices; ++i) {
      const float z = std::lerp(0.03f * s.stature, 0.9f * s.hip_z, (float(i) + 0.5f) / float(slices));
      bool is_there = false;
      for (const scene::Part& part : levels.models[std::size_t(detail)]->parts)
        for (std::size_t t = 0; t + 2 < part.mesh.indices.size() && !is_there; t += 3) {
          Bounds box;
          for (std::size_t c = 0; c < 3; ++c) box.add(part.mesh.positions[part.mesh.indices[t + c]]);
          const bool is_leg = std::abs(box.centre().y) < 0.14f * s.stature && side * box.centre().y > 0.0f;
          is_there = is_leg && box.min.z <= z && box.max.z >= z;
        }
      gaps += is_there ? 0 : 1;
    }
  return gaps;
}

TEST(PersonLevels, HaveWholeLegsFromHipToAnkle) {
  for (std::uint64_t number = 0; number < 16; ++number) {
    const Someone who = someone(number);
    const PersonLevels levels = make_levels(who, colours_of(who, number));
    for (const Detail detail : {Detail::near, Detail::middle, Detail::far, Detail::distant})
      EXPECT_EQ(gaps_of_legs(levels, detail), 0) << "person " << number << ", level " << int(detail);
  }
}

TEST(PersonPictures, AreFoundByTheirDirection) {
  for (int d = 0; d < picture_directions; ++d) EXPECT_EQ(nearest_picture(17.0f * picture_view(d)), d);
  EXPECT_EQ(nearest_picture({0.0f, 0.0f, 5.0f}), picture_rings[0].azimuths) << "from straight above";
  EXPECT_EQ(nearest_picture({-3.0f, -0.01f, 0.0f}), picture_rings[0].azimuths / 2)
      << "from behind, a turn less";
  EXPECT_EQ(picture_of(0.99f, Activity::stand), 0) << "the cycle begins again";
  EXPECT_EQ(picture_of(std::nullopt, Activity::phone), picture_postures - 1);
}

TEST(PersonPictures, ShowWholePeopleFromHeadToFoot) {
  for (const std::uint64_t number : {2u, 7u, 11u}) {
    const Someone who = someone(number);
    const Colours own = colours_of(who, number);
    const PersonPictures pictures = make_pictures(make_levels(who, own), who, std::span(&own, 1));
    for (int posture = 0; posture < picture_postures; ++posture)
      for (int d = 0; d < picture_rings[0].azimuths; ++d) {
        const glm::ivec4 box = pictures.covered[PersonPictures::index(d, posture)];
        const float high = float(box.w - box.y) / picture_px_per_stature;
        EXPECT_NEAR(high, 1.0f, 0.07f) << "person " << number << " from " << d << " in " << posture;
        EXPECT_GT(box.x, 0) << "nothing is cut off";
        EXPECT_LT(box.z, picture_width_px);
        const float foot_px = float(picture_height_px) + picture_px_per_stature * picture_rings[0].lowest;
        EXPECT_NEAR(float(box.w), foot_px, 1.6f) << "they stand on the ground";
        for (int y = box.y; y < box.w; ++y) {
          int covered = 0;
          for (int x = box.x; x < box.z; ++x)
            covered +=
                pictures.shapes.at(d * picture_width_px + x, posture * picture_height_px + y)[3] > 0 ? 1 : 0;
          EXPECT_GT(covered, 0) << "row " << y << " from " << d << " in " << posture;
        }
      }
  }
}

TEST(PersonPictures, ShowFrontsInFrontAndColoursAsTheyAreWorn) {
  Someone who = someone(4, Sex::female, 30.0f);
  who.outfit.bottom = Bottom::trousers;
  std::array<Colours, 2> worn;
  worn[0].bottom = {0.7f, 0.02f, 0.02f}, worn[1].bottom = {0.02f, 0.02f, 0.7f};
  const PersonPictures pictures = make_pictures(make_levels(who, worn[0]), who, worn);
  ASSERT_EQ(pictures.colours.size(), 2u);
  const int x = picture_width_px / 2,
            y = walking_pictures * picture_height_px;  // who stands, seen from the front
  const int knee = y + picture_height_px - int(0.30f * picture_px_per_stature);
  glm::ivec3 red(0), blue(0), normal(0);
  for (int i = 0; i < picture_width_px; ++i) {
    if (pictures.shapes.at(i, knee)[3] == 0) continue;
    for (int c = 0; c < 3; ++c) {
      red[c] += pictures.colours[0].at(i / pixels_per_colour, knee / pixels_per_colour)[c];
      blue[c] += pictures.colours[1].at(i / pixels_per_colour, knee / pixels_per_colour)[c];
      normal[c] += int(pictures.shapes.at(i, knee)[c]) - 127;
    }
  }
  EXPECT_GT(red.x, 2 * red.z);
  EXPECT_GT(blue.z, 2 * blue.x);
  EXPECT_GT(normal.x, std::abs(normal.y)) << "the front faces ahead";
  EXPECT_GT(pictures.shapes.at(x, y + picture_height_px / 3)[0], 170) << "so does the breast";
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

TEST_F(PersonNodeTest, HaveWithThemWhatIsAsked) {
  const scene::Scene scene = scene_of(
      "person(name=\"a\", seed=4, age=30, with=\"pram\")\nperson(name=\"b\", seed=4, age=70, "
      "with=\"wheelchair\")\n"
      "person(name=\"c\", seed=4, age=40, with=\"dog\")\n");
  ASSERT_EQ(scene.objects.size(), 6u);
  const auto bounds_called = [&](const std::string& name) {
    const auto found = std::ranges::find(scene.objects, name, &scene::Object::name);
    return found == scene.objects.end() ? Bounds{} : scene::bounds(*found->model);
  };
  const Bounds pram = bounds_called("a's pram"), chair = bounds_called("b's wheelchair"),
               dog = bounds_called("c's dog");
  for (const Bounds& box : {pram, chair, dog}) EXPECT_NEAR(box.min.z, 0.0f, 0.01f) << "stands on the ground";
  EXPECT_GT(pram.min.x, 0.15f) << "before the body";
  EXPECT_NEAR(pram.size().x, 1.1f, 0.3f);
  EXPECT_NEAR(chair.size().y, 0.62f, 0.15f);
  EXPECT_LT(dog.min.y, -0.5f) << "at the right side";
  EXPECT_NEAR(dog.max.z, 0.8f, 0.35f);
  const auto person = std::ranges::find(scene.objects, std::string("b"), &scene::Object::name);
  EXPECT_NEAR(person->world_from_model[3].z, footrest_m, 1e-5f) << "on the footrests";
  EXPECT_EQ(person->model->animations[std::size_t(person->played.animation)].name, "sit");
}

TEST(Companions, HandsLieOnTheHandle) {
  const BodyField body = adult();
  Posture posture = on_the_spot(body, Activity::stand, 0.0f, 0.0f);
  hold_handle(body, posture);
  const std::vector<glm::mat4> pose = pose_of(body.skeleton(), posture);
  const scene::Model model = *companion_model(Companion::pram, body, 1);
  for (const int bone : {int(left_fingers), int(right_fingers)}) {
    float nearest_m = 1e9f;
    for (const scene::Part& part : model.parts)
      if (part.node == 0)
        for (const glm::vec3 p : part.mesh.positions)
          nearest_m = std::min(nearest_m, glm::distance(p, glm::vec3(pose[std::size_t(bone) + 1][3])));
    EXPECT_LT(nearest_m, 0.09f) << "the joint of the fingers is a palm away from it";
  }
}

TEST_F(PersonNodeTest, BadValuesAreErrors) {
  EXPECT_TRUE(holds(errors_of("person(does=\"fly\")"), "scene.xp:1:13: "));
  EXPECT_TRUE(holds(errors_of("person(age=200)"), "scene.xp:1:12: "));
  EXPECT_TRUE(holds(errors_of("person(seed=-1)"), "scene.xp:1:13: "));
}

}  // namespace
}  // namespace parvis::people
