// Rays from lit vertices that are answered together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "graphics/reference/ray_scene.h"

namespace parvis::light {

/// Rays leave a surface so far above it.
inline constexpr float lift_m = 1e-3f;

/// Rays that go about the same way, answered together. Everything but backdrops stops light, from both sides.
class Packet {
 public:
  /// Empty; the scene must outlive it.
  explicit Packet(const reference::RayScene& scene) : scene_(scene) {}

  /// The tag by which a caller knows a ray.
  struct Tag {
    std::size_t vertex, ray;  ///< numbers: of a vertex or a place, and of one of its rays
  };

  /// Adds a ray; blended surfaces let it pass by its tag.
  void add(glm::vec3 from, glm::vec3 direction, Tag tag) {
    rays_[count_] = {from, direction};
    tags_[count_] = tag;
    passages_[count_++] = {.random = Random(tag.vertex + tag.ray), .passes_backdrops = true};
  }
  /// True where no other ray fits in.
  bool is_full() const { return count_ == rays_.size(); }
  /// Number of rays.
  std::size_t count() const { return count_; }
  /// The direction as it was added.
  glm::vec3 direction(std::size_t ray) const { return rays_[ray].direction; }
  /// The tag as it was added.
  Tag tag(std::size_t ray) const { return tags_[ray]; }
  /// Takes all rays out.
  void clear() { count_ = 0; }

  /// A bit for each ray that something stops.
  std::uint32_t blocked() {
    return count_ > 0 ? scene_.are_blocked(std::span(rays_.data(), count_), {passages_.data(), count_}) : 0;
  }
  /// The first hit of each ray.
  std::span<const std::optional<reference::Hit>> hits() {
    if (count_ > 0) scene_.nearest_hits(std::span(rays_.data(), count_), {passages_.data(), count_}, hits_);
    return {hits_.data(), count_};
  }

 private:
  const reference::RayScene& scene_;
  std::size_t count_ = 0;
  std::array<reference::Ray, reference::RayScene::packet_size> rays_;
  std::array<Tag, reference::RayScene::packet_size> tags_{};
  std::array<reference::Passage, reference::RayScene::packet_size> passages_{};
  std::array<std::optional<reference::Hit>, reference::RayScene::packet_size> hits_;
};

}  // namespace parvis::light
