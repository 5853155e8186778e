#include "formats/readers/texture_limit.h"

#include <algorithm>

#include "scene/data/mip_levels.h"

namespace parvis::formats {

void limit_textures(scene::Model& model, scene::FileAccount& account) {
  const auto fits = [](const Image8& image) {
    return std::max(image.width, image.height) <= max_texture_side;
  };
  for (scene::Texture& texture : model.textures) {
    if (fits(texture.image)) continue;
    std::vector<Image8> levels = scene::smaller_mip_levels(texture, 0);
    account.left_out(
        "full sizes of images",
        fmt::format("graphics drivers hold {} pixels in width and height: a smaller one is shown",
                    max_texture_side),
        texture.name);
    texture.image = std::move(*std::ranges::find_if(levels, fits));
  }
}

}  // namespace parvis::formats
