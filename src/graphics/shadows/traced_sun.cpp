#include "graphics/shadows/traced_sun.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/shading_point.h"
#include "graphics/reference/sun_disc.h"

namespace parvis::shadows {
namespace {

constexpr float lift_m = 1e-3f;       // rays begin off the surface
constexpr float jump_m = 5.0f;        // a view that is so far from the last, or
constexpr float jump_cosine = 0.94f;  // has turned by 20 degrees, is no step of a movement

/// The R2 sequence (Roberts 2018), begun elsewhere in each pixel (Cranley and Patterson 1976).
glm::vec2 on_disc(int sample, std::uint32_t pixel) {
  const std::uint32_t mixed = (pixel * 747796405u + 2891336453u) ^ (pixel >> 13);
  const glm::dvec2 shift(double(mixed >> 16) / 65536.0, double(mixed & 0xffff) / 65536.0);
  return glm::vec2(glm::fract(shift + double(sample) * glm::dvec2(0.7548776662466927, 0.5698402909980532)));
}

bool has_jumped(const glm::mat4& before, const glm::mat4& now) {
  return glm::distance(glm::vec3(before[3]), glm::vec3(now[3])) > jump_m ||
         glm::dot(glm::vec3(before[2]), glm::vec3(now[2])) < jump_cosine;
}

}  // namespace

/// What the pixels' middles show: distances, and where rays to the sun begin.
void TracedSun::find_surfaces(const reference::RayScene& rays, const Camera& camera) {
  const glm::ivec2 size = view_.size;
  parallel_for(std::size_t(size.y), [&](std::size_t row) {
    for (int x = 0; x < size.x; ++x) {
      const std::size_t i = row * std::size_t(size.x) + std::size_t(x);
      const glm::vec2 at(float(x) + 0.5f, float(size.y - int(row)) - 0.5f);
      const reference::Ray ray = reference::camera_ray(camera, size.x, size.y, at);
      const auto hit = rays.nearest_hit(ray);
      pixels_[i] = glm::vec2(1.0f, hit ? hit->distance_m : 0.0f);
      surfaces_[i] = glm::vec4(0.0f);
      if (!hit) continue;
      const glm::vec3 normal = reference::shading_point(*hit, ray.direction, 0.0f).geometric_normal;
      surfaces_[i] = glm::vec4(ray.origin + hit->distance_m * ray.direction + lift_m * normal, 1.0f);
    }
  });
  std::ranges::fill(lit_, std::uint16_t(0));
}

/// A direction for each pixel; sample -1 is the middle of the disc, which later ones replace.
void TracedSun::add_sample(const reference::RayScene& rays, int sample) {
  const reference::SunDisc disc(view_.sun);
  const glm::ivec2 size = view_.size;
  parallel_for(std::size_t(size.y), [&](std::size_t row) {
    for (std::size_t i = row * std::size_t(size.x), end = i + std::size_t(size.x); i < end; ++i) {
      if (surfaces_[i].w == 0.0f) continue;
      reference::Ray ray{glm::vec3(surfaces_[i]), disc.to_middle()};
      if (view_.sun.spot) {
        const glm::vec3 to_light = view_.sun.spot->position - ray.origin;
        ray.max_m = glm::length(to_light);
        ray.direction = to_light / ray.max_m;
      } else if (sample >= 0) {
        ray.direction = disc.direction(on_disc(sample, std::uint32_t(i)));
      }
      const bool is_lit = !rays.is_blocked(ray);
      lit_[i] = std::uint16_t(lit_[i] + (sample >= 0 && is_lit));
      pixels_[i].x = sample >= 0 ? float(lit_[i]) / float(sample + 1) : float(is_lit);
    }
  });
}

void TracedSun::trace(const reference::RayScene& rays, std::uint64_t scene_version,
                      const scene::SunLight& sun, const Camera& camera, int width, int height,
                      int sun_samples) {
  const View view{camera.world_from_camera,
                  camera.clip_from_camera(float(width) / float(height)),
                  {width, height},
                  sun,
                  scene_version};
  const int limit = sun.spot ? 0 : sun_samples;
  if (view == view_) {
    if (samples_ < limit) add_sample(rays, samples_++);
    return;
  }
  const bool is_still =
      view_.size != view.size || has_jumped(view_.world_from_camera, view.world_from_camera);
  view_ = view;
  const std::size_t count = std::size_t(width) * std::size_t(height);
  pixels_.resize(count), surfaces_.resize(count), lit_.resize(count);
  find_surfaces(rays, camera);
  samples_ = 0;
  if (!is_still || limit == 0) return add_sample(rays, -1);
  while (samples_ < limit) add_sample(rays, samples_++);
}

GLuint TracedSun::upload() {
  if (texture_size_ != view_.size) {
    texture_ = gl::texture_2d(GL_RG32F, view_.size.x, view_.size.y);
    texture_size_ = view_.size;
  }
  glTextureSubImage2D(texture_.name(), 0, 0, 0, view_.size.x, view_.size.y, GL_RG, GL_FLOAT, pixels_.data());
  return texture_.name();
}

}  // namespace parvis::shadows
