#include "bench/environment_rays/near_views.h"

#include "bench/street_views.h"

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
                                                const scene::Scene& scene, int object, int width, int height,
                                                float max_others_share) {
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
  if (is_cut || float(own) < min_share * pixels || float(others) > max_others_share * pixels)
    return std::nullopt;
  const glm::vec2 scale(float(width) / float(sketch.width), float(height) / float(sketch.height));
  const glm::ivec2 first = glm::max(glm::ivec2(glm::vec2(low) * scale) - margin_px, glm::ivec2(0));
  const glm::ivec2 end =
      glm::min(glm::ivec2(glm::vec2(high + 1) * scale) + margin_px, glm::ivec2(width, height));
  return reference::PixelWindow{first.x, first.y, end.x - first.x, end.y - first.y};
}

}  // namespace

std::optional<reference::PixelWindow> window_of_car(house::Stage& stage, const Camera& camera, int object,
                                                    int width, int height, float max_others_share) {
  const render::ObjectPicture sketch = stage.renderer().pick(camera, sketch_width, sketch_height, true);
  return window_of(sketch, stage.scene(), object, width, height, max_others_share);
}

Result<NearView> NearViews::next() {
  std::vector<int> cars;
  const scene::Scene& scene = stage_.scene();
  for (int second = 0; second < longest_search_s; second += seconds_apart) {
    stage_.play().advance(seconds_apart);
    stage_.renderer().begin_frame(scene, Camera{});
    cars.clear();
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
      if (scene.objects[i].takes_reflection && scene.objects[i].is_dynamic &&
          scene.objects[i].model->name.find(wish_.model) != std::string::npos)
        cars.push_back(int(i));
    if (cars.empty()) return error("the scene has no car \"{}\" that reflects", wish_.model);
    for (int attempt = 0; attempt < tries_per_time; ++attempt) {
      const int car = cars[std::size_t(random_.index(int(cars.size())))];
      const Bounds& bounds = stage_.renderer().gpu().object_bounds()[std::size_t(car)];
      const Camera camera = look_at_car(bounds, random_, float(width_) / float(height_));
      const auto window = window_of_car(stage_, camera, car, width_, height_, wish_.max_others_share);
      if (window &&
          (wish_.min_seen <= 1 || reflectors_seen(stage_, camera, width_, height_) >= wish_.min_seen))
        return NearView{camera, car, bounds.centre(), *window};
    }
  }
  return error("no car came near, with {} seen, within {} s of traffic", wish_.min_seen, longest_search_s);
}

}  // namespace parvis::bench
