// Views from the pavement of cars that pass: where reflections are looked at.
#pragma once

#include <optional>

#include "base/random.h"
#include "graphics/reference/tracer.h"
#include "house/stage/stage.h"

namespace parvis::bench {

/// A car near the eye, as the scene stands now.
struct NearView {
  Camera camera;
  int object;                     ///< the car, in the scene
  glm::vec3 car;                  ///< middle of its bounds, in the world
  reference::PixelWindow window;  ///< the car's pixels and a margin
};

/// The pixels that show a car in the frame of now, and a margin; nothing: it is small, cut off, or others
/// cover much of the picture.
std::optional<reference::PixelWindow> window_of_car(house::Stage& stage, const Camera& camera, int object,
                                                    int width, int height);

/// Views of cars that nothing hides, at different times and from all sides: the same for the same scene.
class NearViews {
 public:
  /// Keeps the stage, which must outlive this, and the size of the pictures.
  NearViews(house::Stage& stage, int width, int height) : stage_(stage), width_(width), height_(height) {}

  /// Lets traffic drive on to the next one. An error where it shows no near car for long.
  Result<NearView> next();

 private:
  house::Stage& stage_;
  int width_, height_;
  Random random_{23};
};

}  // namespace parvis::bench
