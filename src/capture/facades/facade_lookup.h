// C++ face of facade_lookup.glsl: the colour of a packed facade's points, for rays and for measurements.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "capture/facades/blend.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// The textures of a packed facade, decompressed: 4 bytes per texel, for looking up on the CPU.
class FacadeTexels {
 public:
  explicit FacadeTexels(const PackedFacade& facade);
  /// A sample as the hardware filters: bilinear within two levels, and between them. `at` in texels of level
  /// 0.
  glm::vec4 at(int slot, glm::vec2 at, float level) const;

 private:
  glm::vec4 bilinear(int slot, glm::vec2 at, int level) const;
  std::vector<std::uint8_t> texels_;  ///< RGBA, per slot all levels
};

/// The alpha of a packed facade's mixed tiles: how much of a texel their photographs see.
class TileAlphas {
 public:
  explicit TileAlphas(const PackedFacade& facade);
  /// A sample as FacadeTexels::at of level 0; 1 of tiles that are not mixed.
  float at(int slot, glm::vec2 at) const;

 private:
  std::vector<std::uint8_t> alphas_;   ///< tile_side x tile_side of each mixed tile
  std::vector<std::int32_t> of_slot_;  ///< which of them is a slot's; -1: none
};

/// Weights of two photographs at a corner of a triangle: sRGB = of_first * the first one's stored colour +
/// of_second * the second one's + rest.
struct ChosenCorner {
  glm::vec4 at{0.0f};  ///< where they are looked up: of the first x, y; of the second z, w (facade_stored)
  glm::vec3 of_first{0.0f}, of_second{0.0f}, rest{0.0f};
};
/// A triangle whose photographs are chosen, see chosen_triangle.h.
struct ChosenTriangle {
  std::array<ChosenCorner, 3> corners;
  /// Tiles of the first photograph x, y, of the second z, w: a tile, and 0; or the first of a layer's tiles,
  /// and how many it has in a row.
  glm::ivec4 tiles{0};
  glm::vec2 pixel_sizes{0.0f};  ///< of the two photographs on the triangle, log2 of world units
};

/// The shader's own function over a packed facade. Both must outlive it.
class FacadeLookup {
 public:
  static constexpr float no_opinion = 1e9f;  ///< key of a layer that says nothing about a point

  /// `texels` are those of `facade`. Null: what is stored counts as seen, and only keys can be asked for.
  /// `alphas` stand in for the texels there.
  FacadeLookup(const PackedFacade& facade, const FacadeTexels* texels, const TileAlphas* alphas = nullptr)
      : facade_(facade), texels_(texels), alphas_(alphas), first_depths_(first_depths(facade)) {}

  /// Balanced sRGB and alpha of a point of a triangle; see `facade_colour`.
  glm::vec4 colour(std::uint32_t triangle, glm::vec3 position, glm::vec3 to_eye, float pixel_m,
                   glm::vec2 barycentric);
  /// The same of a triangle whose photographs are chosen.
  glm::vec3 colour(const ChosenTriangle& chosen, float pixel_m, glm::vec2 barycentric);
  /// How a layer stands among others at a point: the least is the best; see `facade_opinion`.
  float key(std::uint32_t layer, glm::vec3 position, glm::vec3 to_eye, float pixel_m) {
    return facade_opinion(int(layer), position, to_eye, pixel_m).key;
  }

 private:
  // What the text below asks for and makes, and its functions. NOLINTBEGIN
  using vec2 = glm::vec2;
  using vec3 = glm::vec3;
  using vec4 = glm::vec4;
  using uvec4 = glm::uvec4;
#include "capture/facades/facade_photo.glsl"
  FacadePhoto facade_photo(int photo) const;
  uvec4 facade_layer(int layer) const;
  int facade_candidate(int index) const;
  uvec4 facade_tile(int tile) const;
  vec4 facade_texel(int slot, vec2 at, float level) const;
  float facade_depth(int index) const;
#include "capture/facades/facade_lookup.glsl"
  // NOLINTEND

 public:
  using Opinion = FacadeOpinion;
  /// A layer's opinion about a point that is seen from `to_eye` (unit), where a pixel is `pixel_m` wide.
  Opinion opinion(std::uint32_t layer, glm::vec3 position, glm::vec3 to_eye, float pixel_m) {
    return facade_opinion(int(layer), position, to_eye, pixel_m);
  }
  /// The opinion of a layer that says nothing.
  static Opinion no_opinion_at_all() {
    return {no_opinion, MAX_PENALTY, 0.0f, 0.0f, 0.0f, vec2(0.0f), 0, 0, 0};
  }
  /// See facade_shares.
  glm::vec3 shares(const Opinion& best, const Opinion& second, float third_key) {
    return facade_shares(best, second, third_key);
  }

 private:
  const PackedFacade& facade_;
  const FacadeTexels* texels_;
  const TileAlphas* alphas_;
  std::vector<std::size_t> first_depths_;
};

/// The facade in `view`: sRGB (0..1) with alpha 0 where there is nothing. `model` is the one that was
/// packed.
ImageF view_of_facade(const PackedFacade& facade, const FacadeTexels& texels, const View& view);
/// The same where it is known what the view sees of `model_of(facade)`. `chosen`: of a ViewChoice, or none.
ImageF view_of_facade(const PackedFacade& facade, const FacadeTexels& texels, const View& view,
                      const ItemBuffer& seen, std::span<const std::optional<ChosenTriangle>> chosen = {});

/// The packed facade's surfaces as a model: its triangles in their order.
LayerModel model_of(const PackedFacade& facade);

}  // namespace parvis::facades
