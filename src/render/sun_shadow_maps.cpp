#include "render/sun_shadow_maps.h"

#include <algorithm>
#include <cmath>

#include "render/bindings.h"

namespace parvis::render {
namespace {

constexpr std::array<int, 3> sizes{4096, 4096, 2048};
constexpr float near_half_width_m = 90.0f;    // a texel is 4.4 cm: cornices and railings throw shadows
constexpr float near_stay_m = 25.0f;          // how far the viewer goes before it is drawn again
constexpr float moving_half_width_m = 80.0f;  // a texel is 8 cm
constexpr float moving_height_m = 30.0f;      // vehicles stand no higher over the viewer's surroundings

glm::mat3 sun_frame(glm::vec3 to_sun) {
  const glm::vec3 helper = std::abs(to_sun.z) < 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::normalize(glm::cross(helper, to_sun));
  return glm::transpose(glm::mat3(right, glm::cross(to_sun, right), to_sun));
}

}  // namespace

SunShadowMaps::SunShadowMaps(glm::vec3 to_sun, const Bounds& fixed)
    : fixed_(fixed.empty() ? Bounds{glm::vec3(-1), glm::vec3(1)} : fixed) {
  turn_to(to_sun);
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    Map& target = targets_[i];
    target.size = sizes[i];
    target.depth = gl::texture_2d(GL_DEPTH_COMPONENT32F, target.size, target.size);
    glTextureParameteri(target.depth.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(target.depth.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    target.framebuffer = gl::Framebuffer::create();
    glNamedFramebufferTexture(target.framebuffer.name(), GL_DEPTH_ATTACHMENT, target.depth.name(), 0);
    glNamedFramebufferDrawBuffer(target.framebuffer.name(), GL_NONE);
  }
}

void SunShadowMaps::turn_to(glm::vec3 to_sun) {
  to_sun_ = glm::normalize(to_sun);
  sun_from_world_ = sun_frame(to_sun_);
  fixed_in_sun_ = transformed(glm::mat4(sun_from_world_), fixed_);
  far_is_drawn_ = false;
  near_centre_ = glm::vec3(1e30f);
}

View SunShadowMaps::aim(int map, glm::vec3 centre, float half_width_m) {
  const std::size_t index = std::size_t(map);
  const float texel = 2.0f * half_width_m / float(targets_[index].size);
  glm::vec3 middle = sun_from_world_ * centre;
  middle.x = std::round(middle.x / texel) * texel;  // whole texels: edges do not crawl when the viewer moves
  middle.y = std::round(middle.y / texel) * texel;
  // Casters toward the sun all count, however far: depth spans the whole place.
  const float top = std::max(fixed_in_sun_.max.z, middle.z + half_width_m) + moving_height_m;
  const float bottom = std::min(fixed_in_sun_.min.z, middle.z - half_width_m) - 1.0f;

  glm::mat4 clip_from_sun(1.0f);
  clip_from_sun[0][0] = clip_from_sun[1][1] = 1.0f / half_width_m;
  clip_from_sun[2][2] = -2.0f / (top - bottom);
  clip_from_sun[3] = {-middle.x / half_width_m, -middle.y / half_width_m, (top + bottom) / (top - bottom),
                      1.0f};

  View view;
  view.kind = ViewKind::shadow;
  view.clip_from_world = clip_from_sun * glm::mat4(sun_from_world_);
  view.position_in_world = centre + 1e5f * to_sun_;
  view.framebuffer = targets_[index].framebuffer.name();
  view.width = view.height = targets_[index].size;
  view.subjects = map == shading::shadow_moving_map ? Subjects::moving : Subjects::fixed;

  const glm::mat4 uvz_from_clip(0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0.5f, 0.5f, 1);
  maps_.uvz_from_world[index] = uvz_from_clip * view.clip_from_world;
  maps_.texel_m[map] = texel;
  return view;
}

void SunShadowMaps::update(glm::vec3 position, glm::vec3 to_sun,
                           const std::function<void(const View&)>& draw) {
  if (glm::normalize(to_sun) != to_sun_) turn_to(to_sun);
  if (!far_is_drawn_) {
    const glm::vec3 size = fixed_in_sun_.size();
    draw(aim(shading::shadow_far_map, fixed_.centre(), 0.51f * std::max(size.x, size.y)));
    far_is_drawn_ = true;
  }
  if (glm::distance(position, near_centre_) > near_stay_m) {
    near_centre_ = position;
    draw(aim(shading::shadow_near_map, position, near_half_width_m));
  }
  draw(aim(shading::shadow_moving_map, position, moving_half_width_m));
}

void SunShadowMaps::bind() const {
  for (std::size_t i = 0; i < targets_.size(); ++i)
    glBindTextureUnit(first_shadow_unit + GLuint(i), targets_[i].depth.name());
}

glm::vec3 SunShadowMaps::texel_uv() const {
  return {1.0f / float(sizes[0]), 1.0f / float(sizes[1]), 1.0f / float(sizes[2])};
}

shading::SunShadow SunShadowMaps::read_back() const {
  shading::SunShadow shadow;
  shadow.maps = maps_;
  shadow.texel_uv = texel_uv();
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    ImageF& depth = shadow.depth[i];
    depth = ImageF(targets_[i].size, targets_[i].size, 1);
    glGetTextureImage(targets_[i].depth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                      GLsizei(depth.pixels.size() * sizeof(float)), depth.pixels.data());
  }
  return shadow;
}

}  // namespace parvis::render
