#include "bench/reflection_cost.h"

#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "house/rooms.h"
#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

constexpr int width = 64, height = 36;

/// A method that lacks its surroundings in the first frames that it draws.
class Lacking final : public methods::Reflections {
 public:
  explicit Lacking(int frames) : lacking_frames_(frames) {}
  render::SurfaceSource source() const override { return {.reflection = "vec3(0.0f)"}; }
  void bind(const gl::Program&, int) override {}
  bool supply(render::Renderer&, const scene::Scene&) override { return updates_ <= lacking_frames_; }

  int updates() const { return updates_; }

 private:
  void update_maps(render::Renderer&, const scene::Scene&,
                   const std::vector<methods::VisibleReflector>&) override {
    ++updates_;
  }

  int lacking_frames_, updates_ = 0;
};

class ReflectionCostTest : public gl::ContextTest {
 protected:
  /// Two samples of each frame, without reflections and with a method.
  Result<std::vector<ReflectionCost>> costs_of(const std::shared_ptr<Lacking>& method) {
    scene::Scene scene;
    scene::add(scene, scene::model_of(scene::ground(20), scene::matt(glm::vec3(0.3f))));
    methods::settings(scene).method = "none";
    Result<std::unique_ptr<house::Stage>> stage =
        house::Stage::create(house::make_play(house::all_rooms(), std::move(scene)));
    if (!stage) return stage.errors();
    Result<JudgedMethod> none = judged_method(**stage, "none", methods::Settings{"none"});
    if (!none) return none.errors();
    Camera camera;
    camera.world_from_camera = look_at({0, -8, 2}, glm::vec3(0.0f));
    Result<std::vector<ReflectionCost>> costs =
        reflection_costs(**stage, {*none, {"lacking", method}}, camera, width, height, 2, Frames::whole);
    if (Status status = (*stage)->renderer().set_reflection(nullptr); !status) return status.errors();
    return costs;
  }
};

TEST_F(ReflectionCostTest, FramesThatLackSurroundingsAreNoSamples) {
  const auto method = std::make_shared<Lacking>(3);
  const Result<std::vector<ReflectionCost>> costs = costs_of(method);
  ASSERT_TRUE(costs) << to_string(costs.errors());
  ASSERT_EQ(costs->size(), 2u);
  for (const ReflectionCost& cost : *costs) {
    EXPECT_EQ(cost.ms.size(), 2u);
    EXPECT_EQ(cost.frame_ms.size(), 2u);
  }
  EXPECT_EQ(method->updates(), 3 + 2) << "the first of those that lack is not timed anyway";
}

TEST_F(ReflectionCostTest, AMethodThatIsNeverSuppliedIsAnError) {
  const Result<std::vector<ReflectionCost>> costs = costs_of(std::make_shared<Lacking>(1000));
  ASSERT_FALSE(costs);
  EXPECT_NE(to_string(costs.errors()).find("lack surroundings"), std::string::npos);
}

}  // namespace
}  // namespace parvis::bench
