// Views from the pavement of cars that pass: where reflections are looked at.
#pragma once

#include <optional>
#include <string>

#include "base/random.h"
#include "graphics/reference/tracer.h"
#include "house/stage/stage.h"

namespace parvis::bench {

/// Which near views are wanted.
struct NearViewWish {
  int min_seen = 1;                ///< reflecting cars that the view shows, near and far
  std::string model = {};          ///< the near car's model has this in its name; empty: any
  float max_others_share = 0.03f;  ///< of the picture, that other cars may cover
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
std::optional<reference::PixelWindow> window_of_car(house::Stage& stage, const Camera& camera, int object,
                                                    int width, int height,
                                                    float max_others_share = NearViewWish{}.max_others_share);

/// Views of cars that nothing hides, at different times and from all sides: the same for the same scene.
class NearViews {
 public:
  /// Keeps the stage, which must outlive this, and the size of the pictures.
  NearViews(house::Stage& stage, int width, int height, NearViewWish wish = {})
      : stage_(stage), width_(width), height_(height), wish_(std::move(wish)) {}

  /// Lets traffic drive on to the next one. An error where it shows no near car for long.
  Result<NearView> next();

 private:
  house::Stage& stage_;
  int width_, height_;
  NearViewWish wish_;
  Random random_{23};
};

}  // namespace parvis::bench
