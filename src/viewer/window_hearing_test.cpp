// What the window sounds like, on the null device and with a server that is not there.
#include "viewer/window_hearing.h"

#include <gtest/gtest.h>

#include <chrono>

namespace parvis::viewer {
namespace {

scene::Scene with_fountain() {
  scene::Scene scene;
  scene.data<scene::ItemsOf<sound::PlacedSound>>().add(sound::PlacedSound{}, 0);
  return scene;
}

/// Steps until something is heard, or ten seconds have passed.
void hear(Hearing& hearing, const scene::Scene& scene) {
  Camera ears;
  ears.world_from_camera[3] = {0, -5, 1.7f, 1};
  for (int i = 0; i < 1000 && !hearing.is_on(); ++i) {
    hearing.step(scene, ears, 0.1 * i, 0.1);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  hearing.step(scene, ears, 200.0, 0.1);
}

TEST(Hearing, BeginsWhereSomethingSoundsAndCanBeMuted) {
  Hearing silent("null"), off("off"), on("null");
  hear(on, with_fountain());
  EXPECT_TRUE(on.is_on());
  EXPECT_EQ(on.sounds(), 1u);
  on.mute(true);
  EXPECT_TRUE(on.is_muted());
  EXPECT_TRUE(on.take_message().empty());
  for (int i = 0; i < 3; ++i) {
    silent.step(scene::Scene(), Camera(), 0.1 * i, 0.1);
    off.step(with_fountain(), Camera(), 0.1 * i, 0.1);
  }
  EXPECT_FALSE(silent.is_on());
  EXPECT_FALSE(off.is_on());
}

TEST(Hearing, SaysThatAServerDoesNotAnswer) {
  Hearing hearing("osc://127.0.0.1:9");
  const scene::Scene scene = with_fountain();
  hear(hearing, scene);
  ASSERT_TRUE(hearing.is_on());
  for (int i = 0; i < 40; ++i) hearing.step(scene, Camera(), 0.1 * i, 0.1);
  EXPECT_NE(hearing.take_message().find("does not answer"), std::string::npos);
  Hearing nowhere("osc://nowhere");
  hear(nowhere, scene);
  EXPECT_NE(nowhere.take_message().find("HOST:PORT"), std::string::npos);
}

}  // namespace
}  // namespace parvis::viewer
