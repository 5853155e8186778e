#include "reflections/reflector_maps/shown_patch.h"

#include <algorithm>

namespace parvis::reflector_maps {

bool is_scaled_evenly(const glm::mat4& m) {
  const glm::vec3 sizes(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
  const float minimum = std::min({sizes.x, sizes.y, sizes.z}),
              maximum = std::max({sizes.x, sizes.y, sizes.z});
  return minimum > 0.999f * maximum && glm::determinant(glm::mat3(m)) > 0.0f;
}

glm::vec3 in_reflector(const glm::mat4& world_from_reflector, glm::vec3 point) {
  return glm::inverse(world_from_reflector) * glm::vec4(point, 1.0f);
}

Layers layers_of(const GpuReflector::Patch& patch) {
  return patch.shows_once ? Layers{-1, 0} : Layers{0, int(layer_start_count) + 1};
}

bool is_shown(std::span<const ShownPatch> patches, int object) {
  return std::ranges::any_of(patches, [&](const ShownPatch& patch) { return patch.object == object; });
}

glm::ivec4 pixels_of(const ShownPatch& patch, const render::View& view) {
  const glm::ivec2 size(view.width, view.height);
  const Bounds& box = patch.patch->bounds.box;
  glm::vec2 low(1e9f), high(-1e9f);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                      corner & 4 ? box.max.z : box.min.z);
    const glm::vec4 clip = view.clip_from_world * patch.world_from_reflector * glm::vec4(p, 1.0f);
    if (clip.w < 1e-3f) return {0, 0, size};  // beside the eye
    const glm::vec2 at = (0.5f + 0.5f * glm::vec2(clip) / clip.w) * glm::vec2(size);
    low = glm::min(low, at), high = glm::max(high, at);
  }
  const glm::vec2 end(size);
  const glm::ivec2 first(glm::clamp(glm::floor(low), glm::vec2(0.0f), end - 1.0f));
  return {first, glm::ivec2(glm::clamp(glm::ceil(high), glm::vec2(first) + 1.0f, end)) - first};
}

void begin_marks(const render::View& view) {
  glBindFramebuffer(GL_FRAMEBUFFER, view.framebuffer);
  glViewport(0, 0, view.width, view.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glEnable(GL_CULL_FACE);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
}

void end_marks() { glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP); }

void mark_patches(const gl::Program& patch_pixels, const render::View& view,
                  std::span<const ShownPatch> patches, std::optional<int> number) {
  begin_marks(view);
  patch_pixels.use();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    glStencilFunc(GL_ALWAYS, number.value_or(int(i) + 1), 0xff);
    patch_pixels.set("clip_from_reflector", view.clip_from_world * patches[i].world_from_reflector);
    patches[i].reflector->draw(*patches[i].patch);
  }
  end_marks();
}

}  // namespace parvis::reflector_maps
