// The node bouncedLight: its ranges, what is wrong with others, and that nothing changes it while a scene
// runs.
#include <gtest/gtest.h>

#include "room_list.h"
#include "scene/data/bounced_settings.h"
#include "scene/script/test_script.h"

namespace parvis::bounced_light {
namespace {

class BouncedNode : public scene::ScriptTest<> {
 protected:
  BouncedNode() {
    script::register_room(registries_);
    bounced_light::register_room(registries_);
  }
  scene::BouncedSettings settings_of(const std::string& script) const {
    return scene_of(script).data<scene::BouncedSettings>();
  }
};

TEST_F(BouncedNode, IsOffWithoutTheNodeAndTakesItsAttributes) {
  EXPECT_FALSE(settings_of("// nothing\n").is_on);
  const scene::BouncedSettings by_default = settings_of("bouncedLight()\n");
  EXPECT_TRUE(by_default.is_on);
  EXPECT_FLOAT_EQ(by_default.spacing_m, 8.0f);
  EXPECT_EQ(by_default.rays, 64);
  const scene::BouncedSettings chosen = settings_of("bouncedLight(spacing=0.5, rays=1024)\n");
  EXPECT_FLOAT_EQ(chosen.spacing_m, 0.5f);
  EXPECT_EQ(chosen.rays, 1024);
}

TEST_F(BouncedNode, SaysWhatIsWrong) {
  for (const auto& [script, word] : {std::pair{"bouncedLight(spacing=0.4)\n", "spacing"},
                                     {"bouncedLight(spacing=51)\n", "spacing"},
                                     {"bouncedLight(rays=15)\n", "rays"},
                                     {"bouncedLight(rays=1025)\n", "rays"},
                                     {"bouncedLight(rays=64.5)\n", "rays"},
                                     {"bouncedLight(bounces=2)\n", "bounces"},
                                     {"bouncedLight()\nbouncedLight()\n", "bouncedLight"}})
    EXPECT_TRUE(holds(errors_of(script), word)) << script;
}

/// Its places are laid out once: what would change them is refused when the scene is loaded.
TEST_F(BouncedNode, IsTheSameInAllScenariosAndTakesNoMessages) {
  action::register_room(registries_);
  for (const auto& [script, words] :
       {std::pair{
            "bouncedLight()\nscenario(name=\"fine\") { override(of=\"%bouncedLight\", spacing=2) }\n",
            "bouncedLight \"%bouncedLight\" is laid out once: its \"spacing\" is the same in all scenarios"},
        {"scenario(name=\"fine\") { bouncedLight() }\n", "bouncedLight does not stand in scenario"},
        {"scenario(name=\"fine\") { group() { bouncedLight() } }\n",
         "a bouncedLight is laid out once, for all scenarios; it does not stand in \"fine\""},
        {"bouncedLight()\ntimer(period_s=10, onTime=\"5, %bouncedLight, spacing 2\")\n",
         "bouncedLight takes no messages"},
        {"timer(period_s=10, onTime=\"5, %bouncedLight, spacing 2\")\n", "%bouncedLight"}}) {
    const std::string errors = errors_of(script);
    EXPECT_TRUE(holds(errors, words)) << script << errors;
  }
}

}  // namespace
}  // namespace parvis::bounced_light
