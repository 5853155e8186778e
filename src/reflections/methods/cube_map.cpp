#include "reflections/methods/cube_map.h"

#include <array>
#include <bit>
#include <glm/gtc/matrix_transform.hpp>

namespace parvis::methods {
namespace {

struct FaceFrame {
  glm::vec3 forward, up;
};
/// OpenGL 4.5, table 8.19: where s and t of each face point, as a camera's axes.
constexpr std::array<FaceFrame, 6> face_frames{{{{1, 0, 0}, {0, -1, 0}},
                                                {{-1, 0, 0}, {0, -1, 0}},
                                                {{0, 1, 0}, {0, 0, 1}},
                                                {{0, -1, 0}, {0, 0, -1}},
                                                {{0, 0, 1}, {0, -1, 0}},
                                                {{0, 0, -1}, {0, -1, 0}}}};

constexpr int max_culled = 256;  // texels per side: the renderer's picture of occluders has 360 rows

}  // namespace

render::View face_view(int face, glm::vec3 centre, int resolution, GLuint framebuffer) {
  const FaceFrame& frame = face_frames[std::size_t(face)];
  render::View view;
  view.kind = render::ViewKind::cube_face;
  view.clip_from_world = glm::perspective(glm::radians(90.0f), 1.0f, cube_near_m, cube_far_m) *
                         glm::lookAt(centre, centre + frame.forward, frame.up);
  view.position_in_world = centre;
  view.framebuffer = framebuffer;
  view.width = view.height = resolution;
  return view;
}

CubeMap::CubeMap(int resolution)
    : resolution_(resolution),
      texture_(gl::Texture::create(GLenum(GL_TEXTURE_CUBE_MAP))),
      depth_(gl::texture_2d(GL_DEPTH_COMPONENT32F, resolution, resolution)),
      framebuffer_(gl::Framebuffer::create()) {
  glTextureStorage2D(texture_.name(), int(std::bit_width(unsigned(resolution))), GL_RGBA16F, resolution,
                     resolution);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
}

void CubeMap::draw_face(render::Renderer& renderer, int face, glm::vec3 centre, int excluded,
                        render::Subjects subjects, const std::vector<std::uint8_t>* shown) {
  glNamedFramebufferTextureLayer(framebuffer_.name(), GL_COLOR_ATTACHMENT0, texture_.name(), 0, face);
  render::View view = face_view(face, centre, resolution_, framebuffer_.name());
  view.excluded_object = excluded;
  view.subjects = subjects;
  view.shown_objects = shown;
  // Static occluders are one list, of all objects: what this view leaves out of them must move, or it would
  // hide what stands behind it.
  const bool leaves_out_fixed = shown || (excluded >= 0 && !renderer.gpu().is_moving(excluded));
  view.culls_hidden = excluded >= 0 && !leaves_out_fixed && resolution_ <= max_culled;
  renderer.draw_view(view);
}

void CubeMap::read_points(int face, glm::vec3 centre, std::vector<glm::vec3>& points) const {
  std::vector<float> depth(std::size_t(resolution_) * std::size_t(resolution_));
  glGetTextureImage(depth_.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, GLsizei(depth.size() * sizeof(float)),
                    depth.data());
  const glm::mat4 world_from_clip = glm::inverse(face_view(face, centre, resolution_, 0).clip_from_world);
  points.clear();
  for (int y = 0; y < resolution_; ++y)
    for (int x = 0; x < resolution_; ++x) {
      const float z = depth[std::size_t(y) * std::size_t(resolution_) + std::size_t(x)];
      if (z <= 0.0f) continue;  // the renderer's depth is reversed: 1 near, 0 far
      const glm::vec3 uvz{(float(x) + 0.5f) / float(resolution_), (float(y) + 0.5f) / float(resolution_),
                          1.0f - z};
      const glm::vec4 world = world_from_clip * glm::vec4(2.0f * uvz - 1.0f, 1.0f);
      points.push_back(glm::vec3(world) / world.w);
    }
}

void CubeMap::update_levels() { glGenerateTextureMipmap(texture_.name()); }

void CubeMap::update_levels(const LobeFilter& filter) {
  update_levels();
  filter.blur(texture_.name(), resolution_);
}

}  // namespace parvis::methods
