#include "bench/reflections/views.h"

#include "graphics/render/frustum.h"
#include "life/traffic/traffic_process.h"

namespace parvis::bench {
namespace {

constexpr int seconds_apart = 3;  // by then another car, or another street, is near
constexpr int longest_search_s = 360;
constexpr int tries_per_time = 6;
constexpr float min_share = 0.06f;  // of the picture, that the near car covers
constexpr int sketch_width = 160, sketch_height = 90;
constexpr int margin_px = 12;  // the filters of FLIP look so far

/// An eye at a walker's height, five to eight metres from a car.
Camera look_at_car(const Bounds& car, Random& random, float aspect) {
  const float azimuth = random.uniform(0.0f, 6.2831853f), away_m = random.uniform(5.0f, 8.0f);
  const glm::vec3 eye(car.centre().x + away_m * std::cos(azimuth),
                      car.centre().y + away_m * std::sin(azimuth), car.min.z + 1.6f);
  Camera camera;
  camera.vertical_fov = vertical_fov(glm::radians(55.0f), aspect);
  camera.world_from_camera = look_at(eye, car.centre());
  return camera;
}

/// The pixels that show `object`, in a picture of another size, where they are many and other movables few.
std::optional<reference::PixelWindow> window_of(const render::ObjectPicture& sketch,
                                                const scene::Scene& scene, int object, glm::ivec2 size,
                                                float max_others_fraction) {
  glm::ivec2 low(sketch.width, sketch.height), high(-1);
  int own = 0, others = 0;
  for (int y = 0; y < sketch.height; ++y)
    for (int x = 0; x < sketch.width; ++x) {
      const int shown = int(*sketch.at(x, y)) - 1;
      if (shown < 0 || !scene.objects[std::size_t(shown)].is_dynamic) continue;
      ++(shown == object ? own : others);
      if (shown == object) low = glm::min(low, glm::ivec2(x, y)), high = glm::max(high, glm::ivec2(x, y));
    }
  const float pixels = float(sketch.width * sketch.height);
  const bool is_cut = low.x == 0 || low.y == 0 || high.x == sketch.width - 1 || high.y == sketch.height - 1;
  if (is_cut || float(own) < min_share * pixels || float(others) > max_others_fraction * pixels)
    return std::nullopt;
  const glm::vec2 scale = glm::vec2(size) / glm::vec2(sketch.width, sketch.height);
  const glm::ivec2 first = glm::max(glm::ivec2(glm::vec2(low) * scale) - margin_px, glm::ivec2(0));
  const glm::ivec2 end = glm::min(glm::ivec2(glm::vec2(high + 1) * scale) + margin_px, size);
  return reference::PixelWindow{first.x, first.y, end.x - first.x, end.y - first.y};
}

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
                                 float pitch_rad, glm::ivec2 size) {
  Random random(5);
  std::vector<Camera> cameras;
  while (cameras.size() < count) {
    const scene::Lane& lane = scene.roads.lanes[std::size_t(random.index(int(scene.roads.lanes.size())))];
    const std::size_t i = std::size_t(random.index(int(lane.points.size()) - 1));
    const glm::vec3 along = lane.points[i + 1] - lane.points[i];
    const glm::vec3 eye = lane.points[i] + random.uniform() * along + glm::vec3(0, 0, eye_height_m);
    if (!scene.data<scene::DrivingArea>().contains(glm::vec2(eye))) continue;
    cameras.push_back(at(eye, std::atan2(along.y, along.x), pitch_rad, aspect_of(size)));
  }
  return cameras;
}

std::unique_ptr<stage::Stage> stage_with(scene::Scene scene, int vehicles) {
  scene.data<traffic::TrafficDemand>().vehicles = vehicles;
  return stage_of(scene);
}

int reflectors_seen(stage::Stage& stage, const Camera& camera, glm::ivec2 size) {
  stage.renderer().begin_frame(stage.scene(), camera);
  stage.renderer().prepare_main_view(camera, size.x, size.y);
  std::vector<methods::VisibleReflector> reflectors;
  methods::find_reflectors(stage.renderer(), stage.scene(), camera, reflectors);
  return int(reflectors.size());
}

Camera view_of_cars(stage::Stage& stage, int minimum, int maximum, glm::ivec2 size, Report& report) {
  const float aspect = aspect_of(size);
  constexpr int longest_search_s = 120;
  for (int second = 0; second < longest_search_s; ++second) {
    for (const float height_m : {9.0f, 25.0f, 60.0f})
      for (const Camera& camera : street_views(stage.scene(), 24, height_m, -0.004f * height_m, size)) {
        if (vehicles_ahead(stage.scene(), camera, aspect) < minimum) continue;
        const int seen = reflectors_seen(stage, camera, size);
        if (seen < minimum || seen > maximum) continue;
        report.note(
            fmt::format("{} cars, {} seen, from {} m above a street, after {} s",
                        stage.simulation().clock.find<traffic::TrafficProcess>()->traffic().vehicle_count(),
                        seen, height_m, second));
        return camera;
      }
    stage.simulation().advance(1.0);
  }
  fail("no view of {} to {} cars was found within {} s of traffic", minimum, maximum, longest_search_s);
}

std::optional<reference::PixelWindow> window_of_car(stage::Stage& stage, const Camera& camera, int object,
                                                    glm::ivec2 size, float max_others_fraction) {
  const render::ObjectPicture sketch = stage.renderer().pick(camera, sketch_width, sketch_height, true);
  return window_of(sketch, stage.scene(), object, size, max_others_fraction);
}

NearView NearViews::next() {
  std::vector<int> cars;
  const scene::Scene& scene = stage_.scene();
  for (int second = 0; second < longest_search_s; second += seconds_apart) {
    stage_.simulation().advance(seconds_apart);
    stage_.renderer().begin_frame(scene, Camera{});
    cars.clear();
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
      if (scene.objects[i].takes_reflection && scene.objects[i].is_dynamic &&
          scene.objects[i].model->name.find(wish_.model) != std::string::npos)
        cars.push_back(int(i));
    if (cars.empty()) fail("the scene has no car \"{}\" that reflects", wish_.model);
    for (int attempt = 0; attempt < tries_per_time; ++attempt) {
      const int car = cars[std::size_t(random_.index(int(cars.size())))];
      const Bounds& bounds = stage_.renderer().gpu().object_bounds()[std::size_t(car)];
      const Camera camera = look_at_car(bounds, random_, aspect_of(size_));
      const auto window = window_of_car(stage_, camera, car, size_, wish_.max_others_fraction);
      if (window && (wish_.min_seen <= 1 || reflectors_seen(stage_, camera, size_) >= wish_.min_seen))
        return NearView{camera, car, bounds.centre(), *window};
    }
  }
  fail("no car came near, with {} seen, within {} s of traffic", wish_.min_seen, longest_search_s);
}

}  // namespace parvis::bench
