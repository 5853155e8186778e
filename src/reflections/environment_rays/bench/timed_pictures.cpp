#include "reflections/environment_rays/bench/timed_pictures.h"

#include "graphics/reference/metrics.h"

namespace parvis::bench {

Result<double> flip_over_none(house::Stage& stage, const TimedPictures& methods, const Camera& camera,
                              int width, int height, const reference::PixelWindow& window) {
  const Result<Image8> expected = picture_of(stage, methods.rays, camera, width, height, window);
  if (!expected) return expected.errors();
  const auto flip = [&](const JudgedMethod& method) -> Result<double> {
    const Result<Image8> picture = picture_of(stage, method, camera, width, height, window);
    if (!picture) return picture.errors();
    const Result<reference::Difference> difference = reference::compare(*picture, *expected);
    if (!difference) return difference.errors();
    return difference->flip;
  };
  const Result<double> timed = flip(methods.timed), none = flip(methods.none);
  if (!timed) return timed.errors();
  if (!none) return none.errors();
  if (*none <= 0.0) return error("mirror rays show nothing in this view");
  return *timed / *none;
}

}  // namespace parvis::bench
