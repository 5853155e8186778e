// Which photographs the triangles of a facade are looked up in from one viewpoint: chosen once for both eyes
// and for as long as the viewpoint hardly moves, so that a pixel compares two or three photographs instead of
// all (thesis 3.6.2: the closest views are chosen on the CPU).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "capture/facades/facade_lookup.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {

inline constexpr std::size_t max_chosen = 8;  ///< per triangle; where more are needed it keeps its whole list

/// Shorter lists of candidates.
struct ViewChoice {
  std::vector<glm::uvec2> lists;  ///< per triangle: first and number, counted over the facade's candidates
                                  ///< and, after them, these:
  std::vector<std::uint32_t> candidates;  ///< layers
  /// The photographs and weights of each triangle for which they are chosen once for all its pixels. None at
  /// all: every pixel compares photographs.
  std::vector<std::optional<ChosenTriangle>> triangles;
};

/// Chooses for one facade, which must outlive it.
class ViewChooser {
 public:
  explicit ViewChooser(const PackedFacade& facade);

  /// The choice for an eye in the facade's frame that sees `pixel_angle` radians per pixel. The best three
  /// photographs at a triangle's centre; of a large triangle, at points all over it; all where fewer than two
  /// show it, or where it fills much of the view. `resident`: per photograph, 0 where its tiles are not at
  /// hand, so that it is not chosen; empty: all are.
  ViewChoice choice(glm::vec3 eye, float pixel_angle, std::span<const char> resident = {}) const;
  /// All photographs that hold each triangle.
  ViewChoice all() const { return {facade_.lists, {}, {}}; }
  /// How far the eye may move until photographs have to be chosen again: less beside a photograph's own
  /// viewpoint, where its weight changes fast.
  float step(glm::vec3 eye) const;

 private:
  const PackedFacade& facade_;
  TileAlphas alphas_;
  bool has_holes_ = false;
  float step_ = 0.0f;
};

}  // namespace parvis::facades
