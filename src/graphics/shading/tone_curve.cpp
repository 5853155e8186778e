#include "graphics/shading/tone_curve.h"

#include "base/colour.h"

namespace parvis::shading {

Image8 tone_mapped_picture(const ImageF& radiance, float exposure) {
  ImageF display(radiance.width, radiance.height, 3);
  for (int y = 0; y < radiance.height; ++y)
    for (int x = 0; x < radiance.width; ++x) {
      const float* in = radiance.at(x, y);
      const vec3 mapped = tone_mapped(exposure * vec3(in[0], in[1], in[2]));
      for (int c = 0; c < 3; ++c) display.at(x, y)[c] = mapped[c];
    }
  return srgb8_from_linear(display);
}

}  // namespace parvis::shading
