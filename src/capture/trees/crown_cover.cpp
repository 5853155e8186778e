#include "capture/trees/crown_cover.h"

#include <algorithm>
#include <cmath>

#include "capture/trees/billboard_math.h"

namespace parvis::trees {
namespace {

constexpr float square_side_px = 4.0f;
constexpr int around_squares = 1;  // of what is visible: billboards that end at one line leave a bright seam
constexpr float large_squares = 4.0f;  // a quarter of a billboard's area in squares: it is four squares wide

/// The opacity at a place of the billboard.
float opacity_at(glm::vec2 q, glm::vec4 slants, const OpacityMask& mask, glm::vec2 mask_scale) {
  if (display::silhouette_reach(q, slants) > 1.0f) return 0.0f;
  const glm::vec2 uv = 0.5f + 0.5f * glm::vec2(q.x, -q.y) * mask_scale;
  const glm::ivec2 part =
      glm::clamp(glm::ivec2(uv * float(mask.side)), glm::ivec2(0), glm::ivec2(mask.side - 1));
  return float(mask.opacities[std::size_t(part.y) * std::size_t(mask.side) + std::size_t(part.x)]) / 255.0f;
}

}  // namespace

void CrownCover::begin(const render::View& view, float min_visible) {
  clip_from_world_ = view.clip_from_world, eye_ = view.position_in_world;
  size_ = glm::ivec2(glm::ceil(glm::vec2(float(view.width), float(view.height)) / square_side_px));
  touched_low_ = size_, touched_high_ = glm::ivec2(0);
  min_visible_ = min_visible;
  visible_.assign(std::size_t(size_.x) * std::size_t(size_.y), 1.0f);
  depths_.assign(visible_.size(), 1.0f);
}

CrownCover::Placed CrownCover::place(const CoveringBillboard& billboard) const {
  const glm::vec4 middle = clip_from_world_ * glm::vec4(billboard.centre, 1.0f),
                  right = clip_from_world_ * glm::vec4(billboard.half_right, 0.0f),
                  up = clip_from_world_ * glm::vec4(billboard.half_up, 0.0f);
  Placed placed{};
  placed.is_before_eye = middle.w > std::abs(right.w) + std::abs(up.w);
  if (!placed.is_before_eye) return placed;
  const glm::vec2 scale = 0.5f * glm::vec2(size_) / middle.w, at = glm::vec2(middle) / middle.w;
  placed.centre = (0.5f + 0.5f * at) * glm::vec2(size_);
  // Seen from the front, a billboard has one depth.
  placed.squares_from_billboard = {scale * (glm::vec2(right) - at * right.w),
                                   scale * (glm::vec2(up) - at * up.w)};
  const glm::vec2 reach =
      glm::abs(placed.squares_from_billboard[0]) + glm::abs(placed.squares_from_billboard[1]);
  placed.low = glm::clamp(glm::ivec2(glm::floor(placed.centre - reach)), glm::ivec2(0), size_);
  placed.high = glm::clamp(glm::ivec2(glm::ceil(placed.centre + reach)), glm::ivec2(0), size_);
  return placed;
}

std::optional<glm::vec4> CrownCover::visible_part(const CoveringBillboard& billboard) const {
  constexpr float all = 2.0f;
  if (min_visible_ <= 0.0f) return glm::vec4(-all, -all, all, all);
  const Placed placed = place(billboard);
  if (!placed.is_before_eye) return glm::vec4(-all, -all, all, all);
  glm::ivec2 low = placed.high, high = placed.low;
  for (int y = placed.low.y; y < placed.high.y; ++y)
    for (int x = placed.low.x; x < placed.high.x; ++x)
      if (visible_[std::size_t(y) * std::size_t(size_.x) + std::size_t(x)] >= min_visible_)
        low = glm::min(low, glm::ivec2(x, y)), high = glm::max(high, glm::ivec2(x, y) + 1);
  if (low.x >= high.x) return std::nullopt;
  low -= around_squares, high += around_squares;
  const glm::mat2 billboard_from_squares = glm::inverse(placed.squares_from_billboard);
  glm::vec2 low_corner(all), high_corner(-all);
  for (int corner = 0; corner < 4; ++corner) {
    const glm::vec2 at(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y);
    const glm::vec2 q = billboard_from_squares * (at - placed.centre);
    low_corner = glm::min(low_corner, q), high_corner = glm::max(high_corner, q);
  }
  return glm::vec4(low_corner, high_corner);
}

void CrownCover::add(const CoveringBillboard& billboard, const OpacityMask& mask, glm::vec2 mask_scale) {
  if (min_visible_ <= 0.0f) return;
  const Placed placed = place(billboard);
  if (!placed.is_before_eye) {
    touched_low_ = glm::ivec2(0), touched_high_ = size_;
    return;
  }
  touched_low_ = glm::min(touched_low_, placed.low), touched_high_ = glm::max(touched_high_, placed.high);
  const float depth = depth_behind(billboard);
  const float area = std::abs(glm::determinant(placed.squares_from_billboard));
  if (area < 1e-6f) return;
  const glm::mat2 billboard_from_squares = glm::inverse(placed.squares_from_billboard);
  const glm::ivec2 touched = placed.high - placed.low;
  // Of squares that are larger than the billboard it covers a share, wherever in them it lies; of smaller
  // ones the least opaque corner counts, so that what is seen past its edge is not hidden.
  const float share = std::min(4.0f * area, 1.0f);
  const float to_corner = area > large_squares ? 0.45f : 0.0f;
  for (int y = 0; y < touched.y; ++y)
    for (int x = 0; x < touched.x; ++x) {
      const glm::vec2 at = glm::vec2(placed.low + glm::ivec2(x, y)) + 0.5f - placed.centre;
      float opacity = 1.0f;
      for (int corner = 0; corner < (to_corner > 0.0f ? 4 : 1) && opacity > 0.0f; ++corner) {
        const glm::vec2 off(corner & 1 ? to_corner : -to_corner, corner & 2 ? to_corner : -to_corner);
        opacity = std::min(
            opacity, opacity_at(billboard_from_squares * (at + off), billboard.slants, mask, mask_scale));
      }
      const std::size_t square =
          std::size_t(placed.low.y + y) * std::size_t(size_.x) + std::size_t(placed.low.x + x);
      if (opacity > 0.0f && visible_[square] >= min_visible_)
        depths_[square] = std::min(depths_[square], depth);
      visible_[square] *= 1.0f - share * opacity;
    }
}

float CrownCover::depth_behind(const CoveringBillboard& billboard) const {
  const float reach_m = glm::length(billboard.half_right) + glm::length(billboard.half_up);
  const glm::vec3 place = billboard.centre + reach_m * glm::normalize(billboard.centre - eye_);
  const glm::vec4 behind = clip_from_world_ * glm::vec4(place, 1.0f);
  return 0.5f - 0.5f * behind.z / behind.w;
}

std::span<const float> CrownCover::hiding_depths() {
  hiding_.assign(visible_.size(), 1.0f);
  for (int y = 0; y < size_.y; ++y)
    for (int x = 0; x < size_.x; ++x) {
      float& farthest = hiding_[std::size_t(y) * std::size_t(size_.x) + std::size_t(x)];
      for (int row = std::max(y - around_squares, 0); row <= std::min(y + around_squares, size_.y - 1); ++row)
        for (int column = std::max(x - around_squares, 0);
             column <= std::min(x + around_squares, size_.x - 1); ++column) {
          const std::size_t near = std::size_t(row) * std::size_t(size_.x) + std::size_t(column);
          farthest = std::min(farthest, visible_[near] < min_visible_ ? depths_[near] : 0.0f);
        }
    }
  return hiding_;
}

}  // namespace parvis::trees
