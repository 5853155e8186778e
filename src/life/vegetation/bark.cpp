#include "life/vegetation/bark.h"

#include "base/colour.h"
#include "synthesis/leaf_texture.h"

namespace parvis::vegetation {

const scene::Texture& bark_texture() {
  static const scene::Texture texture = [] {
    synthesis::SurfacePictures pictures = synthesis::bark_pictures(glm::vec3(0.5f), 77);
    // Cracks are darker: their openness is in the colour, for there is no other map.
    for (int y = 0; y < pictures.colour.height; ++y)
      for (int x = 0; x < pictures.colour.width; ++x) {
        const int shrink = pictures.colour.width / pictures.surface.width;
        const float openness = float(pictures.surface.at(x / shrink, y / shrink)[0]) / 255.0f;
        std::uint8_t* texel = pictures.colour.at(x, y);
        for (int c = 0; c < 3; ++c) texel[c] = std::uint8_t(float(texel[c]) * (0.6f + 0.4f * openness));
      }
    scene::Texture result;
    result.name = "bark", result.image = std::move(pictures.colour);
    return result;
  }();
  return texture;
}

}  // namespace parvis::vegetation
