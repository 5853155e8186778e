#include "bench/environment_rays/timed_pictures.h"

#include "bench/flip_between.h"

namespace parvis::bench {

Result<FlipOverNone> flip_over_none(house::Stage& stage, const TimedPictures& methods, const Camera& camera,
                                    int width, int height, const reference::PixelWindow& window) {
  const Result<Image8> expected = picture_of(stage, methods.rays, camera, width, height, window);
  if (!expected) return expected.errors();
  const auto flip = [&](const JudgedMethod& method) {
    return flip_between(picture_of(stage, method, camera, width, height, window), *expected);
  };
  const Result<double> none = flip(methods.none), timed = flip(methods.timed),
                       none_again = flip(methods.none);
  for (const Result<double>* one : {&none, &timed, &none_again})
    if (!*one) return one->errors();
  if (*none <= 0.0) return error("mirror rays show nothing in this view");
  return FlipOverNone{*timed / *none, *none_again / *none};
}

void report_shown(const FlipOverNone& flip, const std::string& key, Report& report) {
  const Target less_than_half = up_to(0.4);
  report.add(key, flip.timed, less_than_half);
  report.add_control(key + "_without_reflections", flip.none_again, less_than_half);
}

}  // namespace parvis::bench
