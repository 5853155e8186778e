#include "bench/street_views.h"

#include "base/random.h"
#include "graphics/render/frustum.h"
#include "life/traffic/traffic_process.h"

namespace parvis::bench {
namespace {

Camera at(glm::vec3 eye, float heading_rad, float pitch_rad, float aspect) {
  const glm::vec3 ahead(std::cos(heading_rad) * std::cos(pitch_rad),
                        std::sin(heading_rad) * std::cos(pitch_rad), std::sin(pitch_rad));
  Camera camera;
  camera.vertical_fov = vertical_fov(glm::radians(65.0f), aspect);
  camera.world_from_camera = look_at(eye, eye + ahead);
  return camera;
}

/// Vehicles in the frustum, hidden or not: a first sieve that draws nothing.
int vehicles_ahead(const scene::Scene& scene, const Camera& camera, float aspect) {
  const render::Frustum frustum(camera.clip_from_camera(aspect) * camera.camera_from_world());
  int count = 0;
  for (const scene::Object& object : scene.objects) {
    const glm::vec3 position(object.world_from_model[3]);
    count += object.is_dynamic && frustum.may_see({position - 1.0f, position + 1.0f});
  }
  return count;
}

}  // namespace

std::vector<Camera> street_views(const scene::Scene& scene, std::size_t count, float eye_height_m,
                                 float pitch_rad, int width, int height) {
  Random random(5);
  std::vector<Camera> cameras;
  while (cameras.size() < count) {
    const scene::Lane& lane = scene.roads.lanes[std::size_t(random.index(int(scene.roads.lanes.size())))];
    const std::size_t i = std::size_t(random.index(int(lane.points.size()) - 1));
    const glm::vec3 along = lane.points[i + 1] - lane.points[i];
    const glm::vec3 eye = lane.points[i] + random.uniform() * along + glm::vec3(0, 0, eye_height_m);
    if (!scene.data<scene::DrivingArea>().contains(glm::vec2(eye))) continue;
    cameras.push_back(at(eye, std::atan2(along.y, along.x), pitch_rad, float(width) / float(height)));
  }
  return cameras;
}

house::Play play_with(const House& house, const scene::Scene& scene, int vehicles) {
  scene::Scene copy = scene;  // models are shared
  copy.data<traffic::TrafficDemand>().vehicles = vehicles;
  return house::make_play(house, std::move(copy));
}

int reflectors_seen(house::Stage& stage, const Camera& camera, int width, int height) {
  stage.renderer().begin_frame(stage.scene(), camera);
  stage.renderer().prepare_main_view(camera, width, height);
  std::vector<methods::VisibleReflector> reflectors;
  methods::find_reflectors(stage.renderer(), stage.scene(), camera, reflectors);
  return int(reflectors.size());
}

Result<Camera> view_of_cars(house::Stage& stage, int minimum, int maximum, int width, int height,
                            Report& report) {
  const float aspect = float(width) / float(height);
  constexpr int longest_search_s = 120;
  for (int second = 0; second < longest_search_s; ++second) {
    for (const float height_m : {9.0f, 25.0f, 60.0f})
      for (const Camera& camera :
           street_views(stage.scene(), 24, height_m, -0.004f * height_m, width, height)) {
        if (vehicles_ahead(stage.scene(), camera, aspect) < minimum) continue;
        const int seen = reflectors_seen(stage, camera, width, height);
        if (seen < minimum || seen > maximum) continue;
        report.note(fmt::format("{} cars, {} seen, from {} m above a street, after {} s",
                                stage.play().clock.find<traffic::TrafficProcess>()->traffic().vehicle_count(),
                                seen, height_m, second));
        return camera;
      }
    stage.play().advance(1.0);
  }
  return error("no view of {} to {} cars was found within {} s of traffic", minimum, maximum,
               longest_search_s);
}

}  // namespace parvis::bench
