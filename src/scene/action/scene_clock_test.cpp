// What a room brings to a scene that runs: here a bell tower, whose process takes messages to its node.
// Nothing outside this file knows it.
#include "scene/action/scene_clock.h"

#include <gtest/gtest.h>

#include "base/registries.h"
#include "room_list.h"
#include "scene/data/test_scene.h"
#include "scene/script/test_script.h"

namespace parvis::action {
namespace {

using scene::Node, scene::Scene;

/// Rises while it rings.
class Bells final : public Process {
 public:
  std::string name() const override { return "bells"; }
  std::string status() const override { return fmt::format("{} strokes", strokes_); }
  void begin(Scene& scene, SharedByProcesses& shared) override {
    tower_ = shared.live.find("%belltower");
    object_ = scene.objects.size();
    scene::Object bell;
    bell.name = "bell", bell.is_dynamic = true;
    bell.model = scene::model_of(scene::ground(1.0f), {});
    scene.objects.push_back(std::move(bell));
  }
  void step(const Scene&) override { ++steps_; }
  void present(Scene& scene, double ahead_s) override {
    scene.objects[object_].world_from_model[3].z = float(double(steps_) + ahead_s / step_s);
  }
  bool receive(Scene&, const Node& node, const scene::Message& message) override {
    if (&node != tower_ || message.schema->name != "ring") return false;
    strokes_ += int(std::get<long>(message.arguments.at(0)));
    return true;
  }

 private:
  const Node* tower_ = nullptr;
  std::size_t object_ = 0;
  int strokes_ = 0;
  long steps_ = 0;
};

void register_bells(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(
      {.type = "belltower",
       .help = "Rings.",
       .attributes = {},
       .example = "belltower()",
       .messages = {{"ring",
                     "so often",
                     {{.name = "strokes", .type = scene::AttributeType::integer, .is_required = true}}},
                    {"melt", "which nobody does", {}}},
       .is_unique = true},
      [](const Node&, scene::SceneBuilder&) {});
  registries.get<Processes>().add([] { return std::make_unique<Bells>(); });
}

class SceneClockTest : public scene::ScriptTest<> {
 protected:
  SceneClockTest() {
    script::register_room(registries_), register_room(registries_), register_bells(registries_);
  }

  void load(const std::string& script) {
    auto loaded = ScriptTest::load(script);
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    scene_ = std::move(loaded->scene);
    clock_.emplace(registries_.get<Processes>(), scene::LiveScene(std::move(loaded->script)), scene_);
  }
  float height() const { return scene_.objects.at(0).world_from_model[3].z; }
  Process& bells() const { return *clock_->find("bells"); }

  Scene scene_;
  std::optional<SceneClock> clock_;
};

TEST_F(SceneClockTest, AnEventReachesTheProcessOfAnotherRoom) {
  load("belltower()\ntimer(onTime=\"0.5, %belltower, ring 3\", onTime=\"1, %belltower, ring 4\")");
  clock_->advance(scene_, 0.4);
  EXPECT_EQ(bells().status(), "0 strokes");
  clock_->advance(scene_, 0.2);
  EXPECT_EQ(bells().status(), "3 strokes");
  ASSERT_TRUE(clock_->send("%belltower", "ring 5"));
  clock_->advance(scene_, 1.0);
  EXPECT_EQ(bells().status(), "12 strokes");
  EXPECT_TRUE(clock_->take_warnings().empty());
}

TEST_F(SceneClockTest, AMessageThatNobodyTakesIsReported) {
  load("belltower()\ntimer(onTime=\"0.1, %belltower, melt\")");
  clock_->advance(scene_, 0.5);
  const Errors warnings = clock_->take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  const std::string text = to_string(warnings[0]);
  EXPECT_NE(text.find("no process of the scene receives \"melt\", sent to a belltower"), std::string::npos)
      << text;
  EXPECT_NE(text.find("scene.xp:2:"), std::string::npos) << text;
  EXPECT_TRUE(clock_->take_warnings().empty()) << "once";
}

TEST_F(SceneClockTest, StepsAreFixedAndTheMomentBetweenThemIsShown) {
  load("belltower()");
  clock_->advance(scene_, 10.25 * step_s);
  EXPECT_NEAR(height(), 10.25f, 1e-4f);
  for (int i = 0; i < 7; ++i) clock_->advance(scene_, 0.25 * step_s);
  EXPECT_NEAR(height(), 12.0f, 1e-4f);
  EXPECT_NEAR(clock_->time_s(), 12.0 * step_s, 1e-9);
}

TEST_F(SceneClockTest, APausedProcessStandsAndCanBeMovedByHand) {
  load("belltower()");
  clock_->advance(scene_, 2.5 * step_s);
  clock_->pause(bells(), true);
  clock_->advance(scene_, 3.25 * step_s);
  EXPECT_NEAR(height(), 2.5f, 1e-4f);
  clock_->step_alone(scene_, bells(), 4.0 * step_s);
  clock_->advance(scene_, 0.0);
  EXPECT_NEAR(height(), 6.5f, 1e-4f);
  clock_->pause(bells(), false);
  clock_->advance(scene_, 0.25 * step_s);
  EXPECT_NEAR(height(), 7.0f, 1e-4f) << "a step that the pause had left over, and no more";
}

}  // namespace
}  // namespace parvis::action
