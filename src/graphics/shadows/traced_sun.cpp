#include "graphics/shadows/traced_sun.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/parallel.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/sun_disc.h"

namespace parvis::shadows {
namespace {

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

/// A square of pixels, which are one packet of rays.
struct TracedSun::Tile {
  static constexpr int side = 4;
  static_assert(side * side == reference::RayScene::packet_size);
  std::size_t number = 0;  ///< in the picture
  std::size_t count = 0;
  std::array<std::size_t, reference::RayScene::packet_size> pixels;       ///< bottom row of the picture first
  std::array<reference::FineRay, reference::RayScene::packet_size> seen;  ///< through their middles
};

/// A picture in tiles.
class TracedSun::Tiles {
 public:
  Tiles(const Camera& camera, glm::ivec2 size) : rays_(camera, size.x, size.y), size_(size) {}

  std::size_t rows() const { return std::size_t((size_.y + Tile::side - 1) / Tile::side); }
  std::size_t columns() const { return std::size_t((size_.x + Tile::side - 1) / Tile::side); }

  /// Calls `body` with each tile of a row.
  template <class Body>
  void for_each(std::size_t row, const Body& body) const {
    const int bottom = int(row) * Tile::side, top = std::min(bottom + Tile::side, size_.y);
    Tile tile;
    for (int left = 0; left < size_.x; left += Tile::side) {
      tile.count = 0;
      tile.number = row * columns() + std::size_t(left / Tile::side);
      for (int y = bottom; y < top; ++y)
        for (int x = left; x < std::min(left + Tile::side, size_.x); ++x) {
          tile.pixels[tile.count] = std::size_t(y) * std::size_t(size_.x) + std::size_t(x);
          tile.seen[tile.count++] = ray_through(x, y);
        }
      body(tile);
    }
  }

 private:
  /// The ray through a pixel's middle.
  reference::FineRay ray_through(int x, int row) const {
    const reference::Ray ray = rays_.through({float(x) + 0.5f, float(size_.y - row) - 0.5f});
    return {glm::dvec3(ray.origin), glm::normalize(glm::dvec3(ray.direction)), double(ray.min_m)};
  }

  reference::CameraRays rays_;
  glm::ivec2 size_;
};

/// Whether something that moved may stand before a tile, or between its surfaces and the sun.
class TracedSun::Touch {
 public:
  Touch(std::span<const Bounds> moved, const scene::SunLight& sun, glm::vec3 eye)
      : moved_(moved), sun_(sun), eye_(eye) {
    for (const Bounds& box : moved_) reach_m_ = std::max(reach_m_, reach_of(eye, box));
  }

  bool may_concern(const Tile& tile, const std::vector<Surface>& surfaces) const {
    Bounds about, lit;  // what the tile shows, the sky as far as anything that moved; and of that, surfaces
    for (std::size_t k = 0; k < tile.count; ++k) {
      const reference::FineRay& seen = tile.seen[k];
      const double distance = surfaces[tile.pixels[k]].distance_m;
      (distance > 0.0 ? lit : about)
          .add(glm::vec3(seen.origin + (distance > 0.0 ? distance : reach_m_) * seen.direction));
    }
    if (!lit.empty()) about.add(lit);
    return std::ranges::any_of(moved_, [&](const Bounds& box) {
      return passes(box, about, eye_ - about.centre(), 1.0f, 0.0f) || (!lit.empty() && may_shade(box, lit));
    });
  }

 private:
  bool may_shade(const Bounds& box, const Bounds& lit) const {
    if (sun_.spot) return passes(box, lit, sun_.spot->position - lit.centre(), 1.0f, 0.0f);
    constexpr double disc = 0.0048;  // tangent of the sun's radius, and a little more
    return passes(box, lit, glm::normalize(sun_.direction_to_sun), 1e30f,
                  float(disc * reach_of(lit.centre(), box)));
  }
  /// How far the farthest of a box can be.
  static double reach_of(glm::vec3 from, const Bounds& box) {
    return double(glm::distance(from, box.centre())) + double(box.radius());
  }
  /// True if `from`, moved by up to `max_share` of `way`, may come within `margin` of the box.
  static bool passes(const Bounds& box, const Bounds& from, glm::vec3 way, float max_share, float margin) {
    const glm::vec3 half = 0.5f * from.size() + margin + 1e-3f, start = from.centre();
    float enters = 0.0f, leaves = max_share;
    for (int axis = 0; axis < 3; ++axis) {
      const float low = box.min[axis] - half[axis] - start[axis],
                  high = box.max[axis] + half[axis] - start[axis];
      if (std::abs(way[axis]) < 1e-9f) {
        if (low > 0.0f || high < 0.0f) return false;
        continue;
      }
      const float a = low / way[axis], b = high / way[axis];
      enters = std::max(enters, std::min(a, b)), leaves = std::min(leaves, std::max(a, b));
    }
    return enters <= leaves;
  }

  std::span<const Bounds> moved_;
  scene::SunLight sun_;
  glm::vec3 eye_;
  double reach_m_ = 0.0;  ///< of all that moved, from the eye
};

void TracedSun::find_surfaces(const reference::RayScene& rays, const Tile& tile) {
  std::array<reference::FineHit, reference::RayScene::packet_size> hits;
  rays.nearest_hits({tile.seen.data(), tile.count}, {hits.data(), tile.count});
  for (std::size_t k = 0; k < tile.count; ++k) {
    const std::size_t i = tile.pixels[k];
    surfaces_[i] = {};
    if (hits[k].place) {
      const glm::vec3 normal = reference::facet_normal(*hits[k].place, hits[k].triangle);
      const bool is_back = glm::dot(normal, glm::vec3(tile.seen[k].direction)) > 0.0f;
      surfaces_[i] = {hits[k].distance_m, is_back ? -normal : normal};
    }
    pixels_[i] = glm::vec2(1.0f, float(surfaces_[i].distance_m));
    lit_[i] = 0;
  }
}

/// A direction for each pixel; sample -1 is the middle of the disc, which later ones replace as soon as there
/// are enough of them. Surfaces that face away from it are dark without a ray.
void TracedSun::add_sample(const reference::RayScene& rays, const Tile& tile, int sample) {
  constexpr int enough = 4;  // a mean of fewer is noise
  const bool is_shown = sample < 0 || sample + 1 >= std::min(enough, limit_);
  const reference::SunDisc disc(view_.sun);
  const glm::dvec3 to_middle = glm::normalize(glm::dvec3(view_.sun.direction_to_sun));
  std::array<reference::FineRay, reference::RayScene::packet_size> to_sun;
  std::array<std::size_t, reference::RayScene::packet_size> asking;
  std::size_t count = 0;
  for (std::size_t k = 0; k < tile.count; ++k) {
    const std::size_t i = tile.pixels[k];
    if (surfaces_[i].distance_m == 0.0) continue;
    if (is_shown) pixels_[i].x = sample > 0 ? float(lit_[i]) / float(sample + 1) : 0.0f;
    const reference::FineRay& seen = tile.seen[k];
    reference::FineRay ray{seen.origin + surfaces_[i].distance_m * seen.direction, to_middle};
    if (view_.sun.spot) {
      const glm::dvec3 to_light = glm::dvec3(view_.sun.spot->position) - ray.origin;
      ray.max_m = glm::length(to_light);
      ray.direction = to_light / ray.max_m;
    } else if (sample >= 0) {
      ray.direction = glm::normalize(glm::dvec3(disc.direction(on_disc(sample, std::uint32_t(i)))));
    }
    if (glm::dot(ray.direction, glm::dvec3(surfaces_[i].normal)) <= 0.0) continue;
    to_sun[count] = ray, asking[count++] = i;
  }
  if (count == 0) return;
  const std::uint32_t blocked = rays.are_blocked(std::span<const reference::FineRay>(to_sun.data(), count));
  for (std::size_t k = 0; k < count; ++k) {
    if ((blocked >> k & 1u) != 0) continue;
    const std::size_t i = asking[k];
    lit_[i] = std::uint16_t(lit_[i] + (sample >= 0));
    if (is_shown) pixels_[i].x = sample >= 0 ? float(lit_[i]) / float(sample + 1) : 1.0f;
  }
}

void TracedSun::trace(const reference::RayScene& rays, std::uint64_t scene_version,
                      std::span<const Bounds> moved, const scene::SunLight& sun, const Camera& camera,
                      int width, int height, int sun_samples) {
  const View view{camera.world_from_camera,
                  camera.clip_from_camera(float(width) / float(height)),
                  {width, height},
                  sun,
                  scene_version};
  limit_ = sun.spot || sun_samples == 1 ? 0 : sun_samples;  // one is to the middle
  const Tiles tiles(camera, view.size);
  if (view == view_) {
    if (moved.empty() && samples() >= limit_) return;
    const Touch touch(moved, sun, glm::vec3(camera.world_from_camera[3]));
    parallel_for(tiles.rows(), [&](std::size_t row) {
      tiles.for_each(row, [&](const Tile& tile) {
        int& samples = samples_[tile.number];
        if (touch.may_concern(tile, surfaces_)) {
          find_surfaces(rays, tile);
          add_sample(rays, tile, -1);
          samples = 0;
        } else if (samples < limit_) {
          add_sample(rays, tile, samples++);
        }
      });
    });
    return;
  }
  const bool is_still =
      view_.size != view.size || has_jumped(view_.world_from_camera, view.world_from_camera);
  view_ = view;
  const std::size_t count = std::size_t(width) * std::size_t(height);
  pixels_.resize(count), surfaces_.resize(count), lit_.resize(count);
  const int samples = is_still ? limit_ : 0;
  samples_.assign(tiles.rows() * tiles.columns(), samples);
  parallel_for(tiles.rows(), [&](std::size_t row) {
    tiles.for_each(row, [&](const Tile& tile) {
      find_surfaces(rays, tile);
      if (samples == 0) add_sample(rays, tile, -1);
      for (int sample = 0; sample < samples; ++sample) add_sample(rays, tile, sample);
    });
  });
}

int TracedSun::samples() const { return samples_.empty() ? 0 : std::ranges::min(samples_); }

GLuint TracedSun::upload() {
  if (texture_size_ != view_.size) {
    texture_ = gl::texture_2d(GL_RG32F, view_.size.x, view_.size.y);
    texture_size_ = view_.size;
  }
  glTextureSubImage2D(texture_.name(), 0, 0, 0, view_.size.x, view_.size.y, GL_RG, GL_FLOAT, pixels_.data());
  return texture_.name();
}

}  // namespace parvis::shadows
