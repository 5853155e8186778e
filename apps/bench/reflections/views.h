// Views along the streets where traffic drives: those that show many cars at once, and near ones from the
// pavement, where reflections are looked at.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "bench/bench.h"
#include "graphics/reference/tracer.h"

namespace parvis::bench {

/// Width over height.
inline float aspect_of(glm::ivec2 size) { return float(size.x) / float(size.y); }

/// Points on the lanes where traffic drives, from which a visitor or a driver looks, in an order that a seed
/// shuffles.
std::vector<Camera> street_views(const scene::Scene& scene, std::size_t count, float eye_height_m,
                                 float pitch_rad, glm::ivec2 size);

/// The scene with so many vehicles, running.
std::unique_ptr<stage::Stage> stage_with(scene::Scene scene, int vehicles);

/// Number of reflecting objects that a frame of this camera draws.
int reflectors_seen(stage::Stage& stage, const Camera& camera, glm::ivec2 size);

/// Lets traffic drive until some view, from a balcony or a roof, sees between `minimum` and `maximum` cars.
Camera view_of_cars(stage::Stage& stage, int minimum, int maximum, glm::ivec2 size, Report& report);

/// Which near views are wanted.
struct NearViewWish {
  int min_seen = 1;                   ///< reflecting cars that the view shows, near and far
  std::string model = {};             ///< the near car's model has this in its name; empty: any
  float max_others_fraction = 0.03f;  ///< of the picture, that other cars may cover
};

/// A car near the eye, as the scene stands now.
struct NearView {
  Camera camera;
  int object;                     ///< the car, in the scene
  glm::vec3 car;                  ///< middle of its bounds, in the world
  reference::PixelWindow window;  ///< the car's pixels and a margin
};

/// The pixels that show a car in the frame of now, and a margin; nothing: it is small, cut off, or others
/// cover much of the picture.
std::optional<reference::PixelWindow> window_of_car(
    stage::Stage& stage, const Camera& camera, int object, glm::ivec2 size,
    float max_others_fraction = NearViewWish{}.max_others_fraction);

/// Views of cars that nothing hides, at different times and from all sides: the same for the same scene.
class NearViews {
 public:
  /// Keeps the stage, which must outlive this, and the size of the pictures.
  NearViews(stage::Stage& stage, glm::ivec2 size, NearViewWish wish = {})
      : stage_(stage), size_(size), wish_(std::move(wish)) {}

  /// Lets traffic drive on to the next one.
  NearView next();

 private:
  stage::Stage& stage_;
  glm::ivec2 size_;
  NearViewWish wish_;
  Random random_{23};
};

}  // namespace parvis::bench
