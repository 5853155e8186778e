#include "graphics/reference/mip_texture.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/data/mip_levels.h"

namespace parvis::reference {

MipTexture::MipTexture(const scene::Texture& texture, int visible_alpha)
    : source_(&texture),
      visible_alpha_(visible_alpha),
      level_count_(std::bit_width(unsigned(std::max({texture.image.width, texture.image.height, 1})))),
      value_of_byte_(scene::values_of_bytes(texture.is_srgb).data()),
      wrap_u_(texture.wrap_u),
      wrap_v_(texture.wrap_v) {}

const Image8& MipTexture::level(int number) const {
  if (number == 0) return source_->image;
  std::call_once(smaller_->made,
                 [&] { smaller_->levels = scene::smaller_mip_levels(*source_, visible_alpha_); });
  return smaller_->levels[std::size_t(number) - 1];
}

glm::vec4 MipTexture::texel(const Image8& level, int x, int y) const {
  const std::uint8_t* p = level.at(x, y);
  return {value_of_byte_[p[0]], value_of_byte_[p[1]], value_of_byte_[p[2]], float(p[3]) / 255.0f};
}

glm::vec4 MipTexture::bilinear(const Image8& level, glm::vec2 uv) const {
  // Coordinates lie in 0..1, and so x and y above -1.
  const auto wrapped = [](int i, int size, scene::Wrap wrap) {
    if (i >= 0 && i < size) return i;
    return (i < 0) == (wrap == scene::Wrap::repeat) ? size - 1 : 0;
  };
  const float x = uv.x * float(level.width) - 0.5f, y = uv.y * float(level.height) - 0.5f;
  const int left = int(x + 1.0f) - 1, top = int(y + 1.0f) - 1;
  const int x0 = wrapped(left, level.width, wrap_u_), x1 = wrapped(left + 1, level.width, wrap_u_);
  const int y0 = wrapped(top, level.height, wrap_v_), y1 = wrapped(top + 1, level.height, wrap_v_);
  const float fx = x - float(left), fy = y - float(top);
  return glm::mix(glm::mix(texel(level, x0, y0), texel(level, x1, y0), fx),
                  glm::mix(texel(level, x0, y1), texel(level, x1, y1), fx), fy);
}

glm::vec4 MipTexture::sample(glm::vec2 uv, float texels) const {
  uv = glm::clamp(uv, glm::vec2(-1e6f), glm::vec2(1e6f));
  uv = {scene::wrapped(uv.x, wrap_u_), scene::wrapped(uv.y, wrap_v_)};
  const float at = std::clamp(std::log2(std::max(texels, 1.0f)), 0.0f, float(level_count_ - 1));
  const int fine = int(at), coarse = std::min(fine + 1, level_count_ - 1);
  const float t = at - float(fine);
  const glm::vec4 first = bilinear(level(fine), uv);
  return t > 0.0f ? glm::mix(first, bilinear(level(coarse), uv), t) : first;
}

}  // namespace parvis::reference
