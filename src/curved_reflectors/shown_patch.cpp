#include "curved_reflectors/shown_patch.h"

#include <algorithm>

namespace parvis::curved_reflectors {

bool is_scaled_evenly(const glm::mat4& m) {
  const glm::vec3 sizes(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
  const float least = std::min({sizes.x, sizes.y, sizes.z}), most = std::max({sizes.x, sizes.y, sizes.z});
  return least > 0.999f * most && glm::determinant(glm::mat3(m)) > 0.0f;
}

glm::vec3 in_reflector(const glm::mat4& world_from_reflector, glm::vec3 point) {
  return glm::inverse(world_from_reflector) * glm::vec4(point, 1.0f);
}

void mark_patches(const gl::Program& patch_pixels, const render::View& view,
                  std::span<const ShownPatch> patches) {
  glBindFramebuffer(GL_FRAMEBUFFER, view.framebuffer);
  glViewport(0, 0, view.width, view.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glEnable(GL_CULL_FACE);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);  // a shader without colour leaves it undefined
  patch_pixels.use();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    glStencilFunc(GL_ALWAYS, GLint(i) + 1, 0xff);
    patch_pixels.set("clip_from_reflector", view.clip_from_world * patches[i].world_from_reflector);
    patches[i].reflector->draw(*patches[i].patch);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

}  // namespace parvis::curved_reflectors
