// Whether a drawn picture of a place shows it, judged by the ray tracer.
#pragma once

#include "base/camera.h"
#include "base/image.h"
#include "base/result.h"
#include "house/stage/stage.h"

namespace parvis::bench {

/// False for terrain and for the land around a place.
bool is_of_place(const scene::Scene& scene, const scene::Object& object);

/// One channel, 255 where a picture of this size shows the place: neither sky nor the land around it.
Image8 pixels_of_place(const scene::Scene& scene, const Camera& camera, int width, int height);

/// FLIP against the ray tracer's picture, over the pixels that show the place.
struct PictureError {
  double drawn = 0.0;  ///< of the drawn picture
  double black = 0.0;  ///< of a black one: a control
};
/// Of a picture that the stage has drawn with this camera; both are compared at an eighth of its size. Fails
/// where no pixel shows the place.
Result<PictureError> error_of_picture(house::Stage& stage, const Camera& camera, const Image8& picture);

}  // namespace parvis::bench
