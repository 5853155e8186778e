// Nodes that come, go, or change place and name: what a running scene then is, is what a fresh load of its
// script gives.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "scene/script/node_text.h"
#include "scene/script/test_fountains.h"

namespace parvis::scene {
namespace {

class LiveSceneEditsTest : public FountainTest {
 protected:
  const Node* insert(const std::string& script, NodePosition at = {}) {
    const auto inserted = live_.insert_script(scene_, script, at, Roots(folder_.path()),
                                              (folder_.path() / "piece.xp").string());
    EXPECT_TRUE(inserted) << (inserted ? "" : to_string(inserted.errors()));
    return inserted ? inserted->front() : nullptr;
  }
  std::string refusal(const Status& status) const {
    return status ? "" : without_folder(to_string(status.errors()));
  }

  /// All that is to be seen, independent of the order in which objects came.
  static std::vector<std::string> seen(const Scene& scene) {
    std::vector<std::string> all;
    for (const Object& object : scene.objects)
      if (object.is_visible)
        all.push_back(fmt::format("{} at {:.3f} {:.3f}", object.name, object.world_from_model[3].x,
                                  object.world_from_model[3].y));
    for (const NamedCamera& camera : scene.cameras)
      all.push_back(fmt::format("camera {} at {:.3f}", camera.name, camera.camera.position_in_world().x));
    std::ranges::sort(all);
    return all;
  }
  static std::vector<std::string> items(const Scene& scene) {
    std::vector<std::string> all;
    for (const Jet& jet : scene.items<Jet>())
      all.push_back(fmt::format("{:.3f} {}", jet.foot.x, jet.height_m));
    return all;
  }
  void expect_as_loaded_afresh(const std::string& what) {
    const std::string script = script_of(live_.nodes());
    const Result<LoadedScene> fresh = ScriptTest::load(script);
    ASSERT_TRUE(fresh) << what << "\n" << script << "\n" << to_string(fresh.errors());
    EXPECT_EQ(seen(scene_), seen(fresh->scene)) << what << "\n" << script;
    EXPECT_EQ(items(scene_), items(fresh->scene)) << what << "\n" << script;
  }
};

constexpr const char* place =
    "fountain(name=a, position=\"1 0 0\") { jet(height=1) }\n"
    "group(name=g, position=\"10 0 0\") { fountain(name=b) { jet(height=2) } }\n"
    "camera(name=eye, position=\"5 5 2\")\n";

TEST_F(LiveSceneEditsTest, ANodeComesWithAllThatStandsInIt) {
  load(place);
  const Node* group = live_.find("g");
  insert("group(position=\"2 0 0\") { fountain(name=c) { jet(height=3) jet(height=4) } }",
         {group, live_.find("b")});
  EXPECT_EQ(items(scene_), (std::vector<std::string>{"1.000 1", "12.000 3", "12.000 4", "10.000 2"}))
      << "before what stands behind it in the script";
  EXPECT_EQ(live_.parent_of(*live_.parent_of(*live_.find("c"))), group);
  EXPECT_EQ(live_.edits(), 1);
  expect_as_loaded_afresh("a group in a group");
  live_.set(*group, "position", glm::vec3(20, 0, 0));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  expect_as_loaded_afresh("its parent moves it");
}

TEST_F(LiveSceneEditsTest, WhatIsRemovedIsGoneAndComesBackAtItsAddress) {
  load(place);
  const Node* b = live_.find("b");
  const Node* group = live_.find("g");
  ASSERT_TRUE(live_.remove(scene_, *b));
  EXPECT_EQ(live_.find("b"), nullptr);
  EXPECT_FALSE(live_.holds(*b));
  expect_as_loaded_afresh("removed");
  const std::size_t objects = scene_.objects.size();
  ASSERT_TRUE(live_.put_back(scene_, *b, {group, nullptr}));
  EXPECT_EQ(live_.find("b"), b);
  EXPECT_EQ(scene_.objects.size(), objects) << "it takes the place that it has left";
  expect_as_loaded_afresh("back");
}

TEST_F(LiveSceneEditsTest, CamerasComeAndGo) {
  load(place);
  insert("camera(name=balcony, position=\"0 0 9\")", {nullptr, live_.find("a")});
  ASSERT_TRUE(live_.remove(scene_, *live_.find("eye")));
  ASSERT_EQ(scene_.cameras.size(), 1u);
  live_.set(*live_.find("balcony"), "position", glm::vec3(3, 0, 9));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(scene_.cameras.front().camera.position_in_world(), glm::vec3(3, 0, 9));
}

TEST_F(LiveSceneEditsTest, PartsComeAndGoWithTheirParentRebuilt) {
  load(place);
  const Node* jet = insert("jet(height=5)", {live_.find("a"), nullptr});
  EXPECT_EQ(items(scene_), (std::vector<std::string>{"1.000 1", "1.000 5", "10.000 2"}));
  ASSERT_TRUE(live_.remove(scene_, *jet));
  EXPECT_EQ(items(scene_), (std::vector<std::string>{"1.000 1", "10.000 2"}));
  const auto dry =
      live_.insert_script(scene_, "jet(height=0)", {live_.find("a"), nullptr}, Roots(""), "piece.xp");
  ASSERT_FALSE(dry);
  EXPECT_EQ(to_string(dry.errors()), "piece.xp:1:1: a jet without water\n");
  EXPECT_EQ(items(scene_), (std::vector<std::string>{"1.000 1", "10.000 2"})) << "nothing has changed";
  expect_as_loaded_afresh("parts");
}

TEST_F(LiveSceneEditsTest, ARenamedNodeKeepsThoseThatReferToIt) {
  load(std::string(place) + "scenario(name=dry) { override(of=b, visible=0) }");
  ASSERT_TRUE(live_.rename(scene_, *live_.find("b"), "basin"));
  EXPECT_EQ(live_.find("b"), nullptr);
  EXPECT_EQ(scene_.objects[1].name, "basin");
  ASSERT_TRUE(live_.choose(scene_, "dry"));
  EXPECT_FALSE(scene_.objects[1].is_visible);
  ASSERT_TRUE(live_.choose(scene_, ""));
  expect_as_loaded_afresh("renamed");
  EXPECT_NE(refusal(live_.rename(scene_, *live_.find("basin"), "a")).find("the name \"a\" is taken"),
            std::string::npos);
}

TEST_F(LiveSceneEditsTest, WhatOthersReferToStays) {
  load(std::string(place) + "scenario(name=dry) { override(of=b, visible=0) }");
  const std::string why = refusal(live_.remove(scene_, *live_.find("g")));
  EXPECT_NE(why.find("scene.xp:4:22: a override refers to what is to be removed"), std::string::npos) << why;
  EXPECT_EQ(seen(scene_).size(), 3u);
}

TEST_F(LiveSceneEditsTest, WhatCannotStandThereChangesNothing) {
  load(place);
  const std::vector<std::string> before = seen(scene_);
  const auto refused = [&](const std::string& script, const Node* parent) {
    const auto inserted = live_.insert_script(scene_, script, {parent, nullptr}, Roots(""), "piece.xp");
    EXPECT_FALSE(inserted) << script;
    EXPECT_EQ(seen(scene_), before);
    return inserted ? "" : to_string(inserted.errors());
  };
  EXPECT_NE(refused("fountain(name=a)", nullptr).find("the name \"a\" is taken"), std::string::npos);
  EXPECT_NE(refused("fountain(nmae=d)", nullptr).find("did you mean \"name\"?"), std::string::npos);
  EXPECT_NE(refused("fountain(name=d", nullptr).find("piece.xp:1"), std::string::npos);
  EXPECT_NE(refused("jet()", nullptr).find("jet does not stand by itself"), std::string::npos);
  EXPECT_NE(refused("fountain() { jet(height=0) }", live_.find("g")).find("a jet without water"),
            std::string::npos);
  EXPECT_NE(refused("fountain(name=d, position=\"2000 0 0\")", nullptr).find("no pavement there"),
            std::string::npos);
  expect_as_loaded_afresh("refused");
}

TEST_F(LiveSceneEditsTest, ANodeMovesBetweenGroups) {
  load(place);
  ASSERT_TRUE(live_.move(scene_, *live_.find("a"), {live_.find("g"), live_.find("b")}));
  EXPECT_EQ(items(scene_), (std::vector<std::string>{"11.000 1", "10.000 2"}));
  ASSERT_TRUE(live_.move(scene_, *live_.find("a"), {live_.find("g"), nullptr}));
  EXPECT_EQ(items(scene_), (std::vector<std::string>{"10.000 2", "11.000 1"}));
  EXPECT_FALSE(live_.move(scene_, *live_.find("g"), {live_.find("g"), nullptr}));
  expect_as_loaded_afresh("moved");
}

TEST_F(LiveSceneEditsTest, RandomEditsGiveWhatAFreshLoadGives) {
  load(place);
  Random random(7);
  std::vector<const Node*> removed;
  int named = 0;
  const auto pick = [&](int count) { return int(random.uniform() * float(count)) % count; };
  for (int step = 0; step < 150; ++step) {
    std::vector<const Node*> all, groups{nullptr};
    const std::function<void(const Nodes&)> gather = [&](const Nodes& nodes) {
      for (const Node& node : nodes) {
        if (node.schema->type == "jet") continue;
        all.push_back(&node);
        if (node.schema->type == "group") groups.push_back(&node);
        gather(node.children);
      }
    };
    gather(live_.nodes());
    const Node* parent = groups[std::size_t(pick(int(groups.size())))];
    const Nodes& beside = parent ? parent->children : live_.nodes();
    const int place_in = pick(int(beside.size()) + 1);
    const Node* before =
        place_in == int(beside.size()) ? nullptr : &*std::next(beside.begin(), std::ptrdiff_t(place_in));
    const Node* node = all.empty() ? nullptr : all[std::size_t(pick(int(all.size())))];
    switch (pick(6)) {
      case 0:
        insert(fmt::format("fountain(name=n{}, position=\"{} 0 0\") {{ jet(height=0.5) }}", named++, step),
               {parent, before});
        break;
      case 1:
        insert(fmt::format("group(name=n{}, position=\"0 {} 0\") {{ fountain() {{ jet(height=0.25) "
                           "jet(height=0.75) }} }}",
                           named++, step),
               {parent, before});
        break;
      case 2:
        if (node && live_.remove(scene_, *node)) removed.push_back(node);
        break;
      case 3:
        if (!removed.empty()) {
          EXPECT_TRUE(live_.put_back(scene_, *removed.back(), {parent, before}));
          removed.pop_back();
        }
        break;
      case 4:
        if (node && node != before) (void)live_.move(scene_, *node, {parent, before});
        break;
      default:
        if (node && node->schema->find("position")) {
          live_.set(*node, "position", glm::vec3(float(step), 1, 0));
          EXPECT_TRUE(live_.refresh(scene_).empty());
        }
    }
    if (step % 10 == 9) expect_as_loaded_afresh(fmt::format("step {}", step));
  }
  EXPECT_LT(scene_.objects.size(), 150u) << "places are used again";
}

}  // namespace
}  // namespace parvis::scene
