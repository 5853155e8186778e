#include <gtest/gtest.h>

#include "graphics/shading/lamps.h"

namespace parvis::shading {
namespace {

const auto unhindered = [](const Lamp&, vec3, vec3) { return 1.0f; };
using Lookup = LampLookup<decltype(unhindered)>;

/// Lamps above the origin, each as bright as twice the last, so that sums tell which of them were counted.
std::vector<Lamp> lamps_above(int count) {
  std::vector<Lamp> lamps;
  for (int i = 0; i < count; ++i)
    lamps.push_back({vec4(0.0f, 0.0f, 3.0f, 10.0f), vec4(vec3(float(1 << i)), 0.0f),
                     vec4(0.0f, 0.0f, -1.0f, -2.0f), vec4(0.0f, 0.0f, 0.0f, 0.05f)});
  return lamps;
}

TEST(LampLookup, EachLampOfACellCountsOnce) {
  const vec3 ground(0.0f), up(0.0f, 0.0f, 1.0f);
  const Surface white =
      assembled_surface(up, vec3(1.0f), vec3(1.0f), vec3(0.0f), vec4(0.0f, 1.0f, 0.0f, 0.0f), 0.0f);
  const float one = [&] {
    const LampTable table = make_lamp_table(lamps_above(1));
    return Lookup{table, unhindered}.irradiance_of_lamps(ground, up).x;
  }();
  ASSERT_GT(one, 0.0f);
  for (int count = 0; count <= max_lamps_per_cell; ++count) {
    const LampTable table = make_lamp_table(lamps_above(count));
    Lookup lookup{table, unhindered};
    const float expected = float((1 << count) - 1) * one;
    EXPECT_FLOAT_EQ(lookup.irradiance_of_lamps(ground, up).x, expected) << count;
    EXPECT_FLOAT_EQ(lookup.lamp_light(white, ground, up, up).irradiance.x, expected) << count;
  }
}

}  // namespace
}  // namespace parvis::shading
