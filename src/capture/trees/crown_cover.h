// What billboards in front leave visible of those behind them, on a coarse picture of a view: a crown is
// opaque after a few of its cells, and a wood after a few of its trees.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "graphics/render/view.h"

namespace parvis::trees {

/// Mean opacities of a texture's parts, `side` x `side`, 0..255, top row first.
struct OpacityMask {
  int side = 1;
  std::span<const std::uint8_t> opacities;
};

/// A billboard as it covers others. In the world, metres.
struct CoveringBillboard {
  glm::vec3 centre, half_right, half_up;
  glm::vec4 slants;  ///< of its cell's silhouette, as display::silhouette_slants
};

/// The share of light that passes what was added, per square of the picture. Billboards are asked for and
/// added from front to back.
class CrownCover {
 public:
  /// Starts a view in which nothing is covered. What lets less than `min_visible` pass hides what is behind
  /// it; 0: nothing is hidden.
  void begin(const render::View& view, float min_visible);
  /// The part of the billboard (low and high corner, -1..1 but for a margin of two squares of the picture)
  /// out of which more than that share is visible nowhere; none: all of it is hidden.
  std::optional<glm::vec4> visible_part(const CoveringBillboard& billboard) const;
  /// Covers what is behind the billboard. `mask_scale`: from the billboard (-1..1) to its texture.
  void add(const CoveringBillboard& billboard, const OpacityMask& mask, glm::vec2 mask_scale);

  /// Squares in each row and column of the picture.
  glm::ivec2 squares() const { return size_; }
  /// The squares that billboards which were added may touch: low corner, high corner excluded.
  glm::ivec4 touched() const { return {touched_low_, touched_high_}; }
  /// The depth of each square, row by row from below, (1 near, 0 far: as the renderer reverses it) behind
  /// which less than `min_visible` is seen in it and in its neighbours; 0: nothing is hidden. Good until the
  /// next call.
  std::span<const float> hiding_depths();

 private:
  struct Placed {
    glm::vec2 centre;
    glm::mat2 squares_from_billboard;
    glm::ivec2 low, high;  // squares that it may touch, high excluded
    bool is_before_eye;
  };
  Placed place(const CoveringBillboard& billboard) const;
  /// The depth behind the billboard and its whole cell, reversed.
  float depth_behind(const CoveringBillboard& billboard) const;

  glm::mat4 clip_from_world_{1.0f};
  glm::vec3 eye_{0.0f};
  glm::ivec2 size_{0}, touched_low_{0}, touched_high_{0};
  float min_visible_ = 0.0f;
  std::vector<float> visible_;
  std::vector<float> depths_;  // behind all that a square needs to hide the rest
  std::vector<float> hiding_;  // what hiding_depths gave out: its memory is used again in each frame
};

}  // namespace parvis::trees
