// What the registries of all rooms must agree on.
#include "rooms/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "graphics/render/bake_steps.h"

namespace parvis::rooms {
namespace {

TEST(Rooms, MethodsNameBakeStepsThatThereAre) {
  const std::vector<render::BakeStep>& steps = all_registries().get<render::BakeSteps>().all();
  ASSERT_GE(steps.size(), 2u);
  int named = 0;
  for (const methods::Method& method : method_registry().all())
    for (const std::string& step : method.unused_bake_steps) {
      EXPECT_NE(std::ranges::find(steps, step, &render::BakeStep::name), steps.end())
          << method.name << ": " << step;
      ++named;
    }
  EXPECT_GE(named, 1) << "virtual objects read no reference maps";
}

TEST(Rooms, ASceneOfVirtualObjectsReadsNoReferenceMaps) {
  scene::Scene scene;
  EXPECT_TRUE(method_registry().reads_baked(scene, "reference maps"));
  methods::settings(scene).method = "virtual_objects";
  EXPECT_FALSE(method_registry().reads_baked(scene, "reference maps"));
  EXPECT_TRUE(method_registry().reads_baked(scene, "reflector maps of curved mirrors and solid glass"));
}

}  // namespace
}  // namespace parvis::rooms
