#include "bench/light/city_views.h"

#include <array>
#include <cmath>

#include "base/random.h"
#include "bench/street_views.h"

namespace parvis::bench {
namespace {

/// How high a viewer is, and between which pitches the view lies, radians.
struct Viewpoint {
  float height_m, min_pitch, max_pitch;
};
constexpr Viewpoint eyes{1.6f, -0.1f, 0.1f}, balcony{11.0f, -0.35f, 0.0f}, plan{120.0f, -1.5f, -1.1f};
constexpr std::array in_turn{eyes, balcony, eyes, plan};

constexpr double min_room_m = 0.5, same_m = 1e-6;
constexpr std::size_t tries_per_view = 4;

/// True if all that is nearest along the axes shows its front, as that which one stands inside of does not.
bool is_free(const DoubleTracer& tracer, glm::dvec3 eye) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 direction(0.0);
      direction[axis] = side;
      const auto nearest = tracer.nearest(eye, direction, 0.0, StoppedBy::both);
      if (!nearest) continue;
      const auto front = tracer.nearest(eye, direction, 0.0, StoppedBy::front);
      if (nearest->distance_m < min_room_m || !front || front->distance_m > nearest->distance_m + same_m)
        return false;
    }
  return true;
}

}  // namespace

Result<std::vector<Camera>> city_views(const scene::Scene& city, const DoubleTracer& tracer,
                                       std::size_t count, int width, int height) {
  if (city.roads.empty()) return error("the city has no lanes above which its views could stand");
  Random random(11);
  std::vector<Camera> views;
  views.reserve(count);
  for (Camera camera : street_views(city, tries_per_view * count, 0.0f, 0.0f, width, height)) {
    if (views.size() == count) break;
    const Viewpoint& viewpoint = in_turn[views.size() % in_turn.size()];
    const float heading = random.uniform(0.0f, 6.2831853f),
                pitch = random.uniform(viewpoint.min_pitch, viewpoint.max_pitch);
    const glm::vec3 eye = camera.position_in_world() + glm::vec3(0.0f, 0.0f, viewpoint.height_m);
    if (!is_free(tracer, glm::dvec3(eye))) continue;
    camera.world_from_camera =
        look_at(eye, eye + glm::vec3(std::cos(heading) * std::cos(pitch), std::sin(heading) * std::cos(pitch),
                                     std::sin(pitch)));
    views.push_back(camera);
  }
  if (views.size() < count)
    return error("of {} places above the city's lanes {} are free, of which {} were asked for",
                 tries_per_view * count, views.size(), count);
  return views;
}

}  // namespace parvis::bench
