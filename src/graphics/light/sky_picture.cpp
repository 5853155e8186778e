#include "graphics/light/sky_picture.h"

#include "base/image_io.h"
#include "graphics/shading/sky.h"
#include "scene/script/scene_builder.h"

namespace parvis::light {

std::optional<ImageF> read_sky_picture(const scene::Node& node, const char* name,
                                       scene::SceneBuilder& builder) {
  std::size_t replaced = 0;
  Result<ImageF> picture = read_image_float(node.file(name), &replaced);
  if (!picture) {
    builder.fail(picture.errors(), node.where_of(name));
    return std::nullopt;
  }
  if (replaced > 0)
    builder.warn(error_at(node.where_of(name),
                          "{} values of the sky's picture are infinite or no numbers; its brightest finite "
                          "value, or black, stands for each",
                          replaced));
  return shading::without_sun(*std::move(picture));
}

}  // namespace parvis::light
