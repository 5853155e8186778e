// Crowds of generated people: they need no model, keep their feet on the ground, and are shown as fine as the
// eye is near.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "life/crowd/crowd_process.h"
#include "life/vegetation/scene_plant.h"

namespace parvis::crowd {
namespace {

scene::Object level_ground(float half_m) {
  auto model = std::make_shared<scene::Model>();
  model->materials.resize(1);
  scene::Part part;
  part.mesh.positions = {
      {-half_m, -half_m, 0}, {half_m, -half_m, 0}, {half_m, half_m, 0}, {-half_m, half_m, 0}};
  part.mesh.normals.assign(4, {0, 0, 1}), part.mesh.uvs.resize(4);
  part.mesh.indices = {0, 1, 2, 0, 2, 3};
  model->parts.push_back(std::move(part));
  scene::Object object;
  object.name = "ground", object.model = std::move(model);
  return object;
}

/// A scene of so many people who have walked for a while.
class GeneratedPeople : public testing::Test {
 protected:
  void begin(int people) {
    scene_.objects.push_back(level_ground(15.0f));
    CrowdDemand demand;
    demand.people = people, demand.radius_m = 14.0f, demand.seed = 3, demand.flows = flows_;
    scene_.data<CrowdDemand>() = demand;
    process_.begin(scene_, shared_);
  }
  void advance(int steps) {
    for (int s = 0; s < steps; ++s) process_.step(scene_);
    process_.present(scene_, 0.0);
  }
  /// Levels of detail as for an eye in the middle of the place, or far from it.
  void look_from(glm::vec3 eye) { process_.adapt(scene_, std::span(&eye, 1)); }
  const scene::Object* person(std::size_t number) const {
    const auto found = std::ranges::find_if(scene_.objects, [&](const scene::Object& object) {
      return object.is_visible && object.name == person_name(number);
    });
    return found == scene_.objects.end() ? nullptr : &*found;
  }
  static Bounds bounds_of(const scene::Object& object) {
    Bounds box;
    for (const Mesh& mesh : object.deformed_meshes)
      for (const glm::vec3 p : mesh.positions)
        box.add(glm::vec3(object.world_from_model * glm::vec4(p, 1.0f)));
    return box;
  }

  std::vector<Flow> flows_;
  scene::Scene scene_;
  action::SharedByProcesses shared_;
  CrowdProcess process_;
};

TEST_F(GeneratedPeople, AreHiddenAndShownWhileTheyWalkOn) {
  begin(5);
  advance(30);
  scene_.data<CrowdDemand>().is_visible = false;
  advance(1);
  for (std::size_t p = 0; p < 5; ++p) EXPECT_FALSE(person(p)) << p;
  scene_.data<CrowdDemand>().is_visible = true;
  advance(1);
  for (std::size_t p = 0; p < 5; ++p) EXPECT_TRUE(person(p)) << p;
}

TEST_F(GeneratedPeople, WalkRoundWhatIsInsertedWhileTheyWalk) {
  begin(40);
  const auto inside = [&](float half_m) {
    int count = 0;
    for (int s = 0; s < 60; ++s) {
      advance(60);
      for (const glm::vec2 p : process_.crowd()->walkers().position)
        count += std::abs(p.x) < half_m && std::abs(p.y) < half_m;
    }
    return count;
  };
  ASSERT_GT(inside(2.0f), 10) << "they cross the middle";
  scene::Object block = level_ground(2.0f);
  block.world_from_model = glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, 1.0f));
  scene_.objects.push_back(block);
  advance(60);
  EXPECT_EQ(inside(2.0f), 0);
  scene_.objects.back().is_visible = false;  // taken away again
  advance(60);
  EXPECT_GT(inside(2.0f), 10);
}

TEST_F(GeneratedPeople, WalkRoundTrunks) {
  vegetation::PlantShape shape;
  shape.recipe = {vegetation::find_kind("oak"), 9.0f, 1.0f, 1};
  vegetation::ScenePlant tree;
  tree.shape = std::make_shared<const vegetation::PlantShape>(std::move(shape));
  scene_.data<vegetation::ScenePlants>().items.push_back(tree);
  begin(40);
  for (int s = 0; s < 60; ++s) {
    advance(60);
    for (const glm::vec2 p : process_.crowd()->walkers().position)
      EXPECT_FALSE(std::abs(p.x) < 0.3f && std::abs(p.y) < 0.3f);
  }
}

TEST_F(GeneratedPeople, WalkWithoutAModelAndStandOnTheGround) {
  begin(12);
  look_from({0.0f, 0.0f, 1.6f});
  advance(30);
  std::size_t moved = 0;
  std::vector<glm::vec3> before;
  for (std::size_t p = 0; p < 12; ++p) {
    ASSERT_TRUE(person(p)) << p;
    before.push_back(glm::vec3(person(p)->world_from_model[3]));
    const Bounds box = bounds_of(*person(p));
    EXPECT_NEAR(box.min.z, 0.0f, 0.04f) << p;
    EXPECT_GT(box.max.z, 0.9f);
    EXPECT_LT(box.max.z, 2.2f);
  }
  advance(120);
  for (std::size_t p = 0; p < 12; ++p)
    moved += glm::distance(before[p], glm::vec3(person(p)->world_from_model[3])) > 0.5f ? 1 : 0;
  EXPECT_GT(moved, 5u);
}

TEST_F(GeneratedPeople, AreFineWhereTheEyeIsNearAndEachIsShownOnce) {
  begin(30);
  advance(10);
  const glm::vec3 eye = glm::vec3(person(4)->world_from_model[3]) + glm::vec3(1.5f, 0.0f, 1.6f);
  EXPECT_TRUE(person(4)->model->parts.empty()) << "nobody has looked yet";
  look_from(eye);
  EXPECT_EQ(process_.generated()->level(4), people::Detail::near);
  EXPECT_GT(person(4)->model->triangle_count(), 12'000u);
  const std::shared_ptr<FarPeople>& far = scene_.data<SharedFarPeople>().now;
  const auto shown = [&](std::size_t p) {
    return std::ranges::count_if(scene_.objects, [&](const scene::Object& object) {
      return object.is_visible && object.name == person_name(p);
    });
  };
  for (std::size_t p = 0; p < 30; ++p) {
    EXPECT_EQ(shown(p), 1) << p;
    EXPECT_EQ(far->people[p].is_shown, person(p)->model->parts.empty()) << "as a mesh or as a picture: " << p;
  }
  EXPECT_NEAR(bounds_of(*person(4)).min.z, 0.0f, 0.04f) << "posed at once";
  look_from({900.0f, 0.0f, 1.6f});
  for (std::size_t p = 0; p < 30; ++p) {
    EXPECT_EQ(process_.generated()->level(p), people::Detail::distant);
    EXPECT_EQ(shown(p), 1) << p;
    EXPECT_TRUE(far->people[p].is_shown) << p;
    EXPECT_NEAR(glm::distance(far->people[p].place, glm::vec3(person(p)->world_from_model[3])), 0.0f, 1e-4f);
  }
  scene_.data<CrowdDemand>().is_visible = false;
  advance(1);
  for (std::size_t p = 0; p < 30; ++p)
    EXPECT_FALSE(far->people[p].is_shown) << "hidden with the crowd: " << p;
}

TEST_F(GeneratedPeople, AreCoarserWhereAWindowCannotHoldItsRate) {
  begin(30);
  advance(10);
  const glm::vec3 eye = glm::vec3(person(4)->world_from_model[3]) + glm::vec3(3.0f, 0.0f, 1.2f);
  process_.adapt(scene_, std::span(&eye, 1));
  ASSERT_EQ(process_.generated()->level(4), people::Detail::near);
  process_.set_detail(0.25f);
  process_.adapt(scene_, std::span(&eye, 1));
  EXPECT_EQ(process_.generated()->level(4), people::Detail::far);
  process_.set_detail(1.0f);
  process_.adapt(scene_, std::span(&eye, 1));
  EXPECT_EQ(process_.generated()->level(4), people::Detail::near);
}

TEST_F(GeneratedPeople, OfWhomThereAreManyShareTheirMeshes) {
  begin(100);
  std::size_t near = 0;
  std::set<const scene::Model*> models;
  for (const scene::Object& object : scene_.objects) {
    if (object.deformed_meshes.empty()) continue;
    models.insert(object.model.get());
    near += object.model->triangle_count() > 12'000 ? 1 : 0;
  }
  EXPECT_EQ(models.size(), std::size_t((people::detail_count - 1) * ShownPeople::max_shapes));
  EXPECT_LE(near, std::size_t(ShownPeople::max_looks));
}

TEST_F(GeneratedPeople, SomeOfThemWalkTogetherWhereverTheyGo) {
  begin(40);
  const auto& people = process_.crowd()->people();
  const auto in_groups = [&] {
    return std::ranges::count_if(people, [](const PersonOnTheWay& it) { return it.leader >= 0; });
  };
  EXPECT_GT(in_groups(), 6);
  EXPECT_LT(in_groups(), 30);
  float apart_m = 0.0f, apart_from_others_m = 0.0f;
  int looks = 0;
  for (int s = 0; s < 60; ++s) {
    advance(60);
    for (std::size_t p = 0; p < people.size(); ++p) {
      if (people[p].leader < 0) continue;
      const auto& at = process_.crowd()->walkers().position;
      apart_m += glm::distance(at[p], at[std::size_t(people[p].leader)]);
      apart_from_others_m += glm::distance(at[p], at[(p + 20) % people.size()]), ++looks;
    }
  }
  EXPECT_LT(apart_m / float(looks), 2.5f) << "for a minute, with new destinations";
  EXPECT_GT(apart_from_others_m / float(looks), 5.0f);
}

TEST_F(GeneratedPeople, DoNotStepOntoGroundThatATramCoversNext) {
  const scene::StreetCrossing track{{-15, 0, 0}, {15, 0, 0}, 1.6f};
  const auto streets = std::make_shared<scene::StreetTraffic>();
  scene_.data<scene::SharedStreets>().now = streets;
  begin(12);
  const auto stepped_on = [&](int seconds) {
    std::vector<bool> was_on(12, true);
    int count = 0;
    for (int s = 0; s < 10 * seconds; ++s) {
      advance(6);
      for (std::size_t p = 0; p < 12; ++p) {
        constexpr float pushed_m = 0.3f;
        const bool is_on = track.contains(process_.crowd()->walkers().position[p], -pushed_m);
        count += is_on && !was_on[p] ? 1 : 0;
        was_on[p] = is_on || (was_on[p] && track.contains(process_.crowd()->walkers().position[p]));
      }
    }
    return count;
  };
  EXPECT_GT(stepped_on(30), 3) << "without a tram they walk over its track";
  streets->kept_clear = {track};
  EXPECT_EQ(stepped_on(60), 0);
}

TEST_F(GeneratedPeople, BoardAndAlightWhileDoorsAreOpen) {
  const auto stops = std::make_shared<std::vector<scene::TransitStop>>();
  scene::TransitStop stop{{-10, 12, 0}, {10, 12, 0}, {0, -1}, 2.5f, {}};
  for (const float x : {-7.0f, -2.0f, 3.0f, 8.0f}) stop.doors.push_back({x, 12, 0});
  stops->push_back(stop);
  scene_.data<scene::SharedStops>().now = stops;
  begin(40);
  ASSERT_TRUE(process_.passengers());
  scene::TransitStop& now = stops->front();
  const auto gone = [&] {
    int count = 0;
    for (std::size_t p = 0; p < 40; ++p) count += person(p) ? 0 : 1;
    return count;
  };
  const int aboard_at_first = gone();
  EXPECT_GT(aboard_at_first, 0);
  int waiting = 0;
  for (int round = 0; round < 4; ++round) {
    const int boarded = now.boarded, alighted = now.alighted;
    advance(60 * 60);
    EXPECT_EQ(now.boarded, boarded) << "nobody passes closed doors";
    EXPECT_EQ(now.alighted, alighted);
    for (std::size_t p = 0; p < 40; ++p) {
      if (process_.passengers()->trip(p) != Passengers::Trip::waits) continue;
      ++waiting;
      EXPECT_GT(process_.crowd()->walkers().position[p].y, 8.5f) << "they wait on the platform";
    }
    now.is_open = true;
    int longest = 0;
    for (int s = 0; s < 25; ++s) {
      now.open_s = float(18 - s);
      advance(60);
      longest = std::max(longest, now.boarding);
    }
    EXPECT_GT(longest, 0) << "doors are asked to wait";
    EXPECT_EQ(now.boarding, 0) << "and then no longer";
    now.is_open = false;
  }
  EXPECT_GT(waiting, 3);
  EXPECT_GT(now.boarded, 3);
  EXPECT_GT(now.alighted, 3);
  EXPECT_EQ(gone(), aboard_at_first + now.boarded - now.alighted) << "nobody is lost";
}

TEST_F(GeneratedPeople, OfFlowsComeAndLeaveAsManyAsWereCounted) {
  flows_ = {{{-12, -12, 0}, {12, 12, 0}, 1200.0f}, {{12, -12, 0}, {-12, 10, 0}, 0.0f}};
  begin(30);
  std::vector<bool> was_here(30, false);
  int came = 0, here = 0;
  for (int s = 0; s < 600; ++s) {
    advance(60);
    here = 0;
    for (std::size_t p = 0; p < 30; ++p) {
      const bool is_here = person(p) != nullptr;
      came += is_here && !was_here[p] ? 1 : 0, here += is_here ? 1 : 0;
      was_here[p] = is_here;
    }
  }
  EXPECT_NEAR(came, 200, 50) << "1200 per hour, for ten minutes: four standard deviations";
  EXPECT_LT(here, 20) << "who has arrived leaves";
  EXPECT_TRUE(process_.take_warnings().empty());
}

TEST_F(GeneratedPeople, OfAFlowToNowhereAreMissedWithAMessage) {
  flows_ = {{{-12, -12, 0}, {500, 12, 0}, 60.0f}};
  begin(5);
  const Errors warnings = process_.take_warnings();
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings.front().message.find("500.0 12.0"), std::string::npos) << warnings.front().message;
}

TEST_F(GeneratedPeople, WaitAtRed) {
  const scene::StreetCrossing crossing{{-15, 0, 0}, {15, 0, 0}, 2.0f};  // all of the place's breadth
  const auto streets = std::make_shared<scene::StreetTraffic>();
  streets->crossings = {crossing}, streets->people = {0}, streets->taken = {0};
  streets->lights = {scene::WalkLight::walk};
  scene_.data<scene::SharedStreets>().now = streets;
  begin(16);
  const auto stepped_on = [&](int seconds) {
    std::vector<bool> was_on(16, true);
    int count = 0;
    for (int s = 0; s < 10 * seconds; ++s) {
      advance(6);
      for (std::size_t p = 0; p < 16; ++p) {
        const bool is_on =
            crossing.contains(process_.crowd()->walkers().position[p], was_on[p] ? 0.5f : 0.0f);
        count += is_on && !was_on[p] ? 1 : 0;
        was_on[p] = is_on;
      }
    }
    return count;
  };
  EXPECT_GT(stepped_on(30), 3) << "at green";
  streets->lights = {scene::WalkLight::wait};
  EXPECT_EQ(stepped_on(60), 0);
  EXPECT_EQ(streets->people[0], 0) << "who waits at red stops nobody";
  process_.heeds_lights = false;
  EXPECT_GT(stepped_on(30), 3) << "the control";
}

TEST_F(GeneratedPeople, WithoutGroundAreMissedWithAMessage) {
  CrowdDemand demand;
  demand.people = 5;
  scene_.data<CrowdDemand>() = demand;
  process_.begin(scene_, shared_);
  EXPECT_TRUE(scene_.objects.empty());
  EXPECT_FALSE(process_.take_warnings().empty());
}

TEST_F(GeneratedPeople, OfWhomThereAreTooManyAreAsManyAsThereIsRoomFor) {
  scene_.objects.push_back(level_ground(5.0f));
  CrowdDemand demand;
  demand.people = 20'000, demand.radius_m = 14.0f;
  scene_.data<CrowdDemand>() = demand;
  process_.begin(scene_, shared_);
  EXPECT_LE(process_.crowd()->size(), 100u);
  EXPECT_GT(process_.crowd()->size(), 40u);
  const Errors warnings = process_.take_warnings();
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings.front().message.find("20000 people"), std::string::npos) << warnings.front().message;
}

TEST(PersonModel, WithTooManyJointsIsRefused) {
  scene::Model model;
  model.nodes.resize(501);
  model.animations.push_back({});
  model.animations.back().duration_s = 1.0f;
  scene::Part part;
  auto deformation = std::make_shared<scene::Deformation>();
  deformation->skin.joints.resize(500);
  part.deformation = std::move(deformation);
  model.parts.push_back(std::move(part));
  const Result<crowd::PersonModel> person = person_model(std::make_shared<const scene::Model>(model));
  ASSERT_FALSE(person);
  EXPECT_NE(to_string(person.errors()).find("500 joints"), std::string::npos);
  model.animations.clear(), model.parts.clear();
  EXPECT_FALSE(person_model(std::make_shared<const scene::Model>(model))) << "nor one without a skeleton";
}

TEST_F(GeneratedPeople, StandBesideTheLanes) {
  scene::Lane lane;
  lane.points = {{-14, 0, 0}, {14, 0, 0}}, lane.width_m = 6.0f;
  scene_.roads.lanes.push_back(lane);
  begin(20);
  for (const Destination& destination : process_.crowd()->destinations()) {
    EXPECT_GT(std::abs(destination.a.y), 3.0f);
    EXPECT_LT(std::abs(destination.a.y), 9.5f);
  }
}

}  // namespace
}  // namespace parvis::crowd
