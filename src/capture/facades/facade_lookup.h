// C++ face of facade_lookup.glsl: the colour of a packed facade's points, for rays and for measurements.
#pragma once

#include <memory>
#include <vector>

#include "base/image.h"
#include "capture/facades/blend.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// The textures of a packed facade, decompressed: 4 bytes per texel, for looking up on the CPU.
class FacadeTexels {
 public:
  explicit FacadeTexels(const PackedFacade& facade);
  /// As the hardware filters: bilinear within two levels, and between them. `at` in texels of level 0.
  glm::vec4 at(int slot, glm::vec2 at, float level) const;

 private:
  glm::vec4 bilinear(int slot, glm::vec2 at, int level) const;
  std::vector<std::uint8_t> texels_;  ///< RGBA, per slot all levels
};

/// The shader's own function over a packed facade. Both must outlive it.
class FacadeLookup {
 public:
  static constexpr float no_opinion = 1e9f;  ///< key of a layer that says nothing about a point

  /// `texels` are those of `facade`. Null: what is stored counts as seen, and only keys can be asked for.
  FacadeLookup(const PackedFacade& facade, const FacadeTexels* texels)
      : facade_(facade), texels_(texels), first_depths_(first_depths(facade)) {}

  /// Balanced sRGB and alpha of a point of a triangle; see `facade_colour`.
  glm::vec4 colour(std::uint32_t triangle, glm::vec3 position, glm::vec3 to_eye, float pixel_m,
                   glm::vec2 barycentric);
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

  const PackedFacade& facade_;
  const FacadeTexels* texels_;
  std::vector<std::size_t> first_depths_;
};

/// What `view` sees of the facade: sRGB (0..1) with alpha 0 where there is nothing. `model` is the one that
/// was packed.
ImageF view_of_facade(const PackedFacade& facade, const FacadeTexels& texels, const View& view);
/// The same where it is known what the view sees of `model_of(facade)`.
ImageF view_of_facade(const PackedFacade& facade, const FacadeTexels& texels, const View& view,
                      const ItemBuffer& seen);

/// The packed facade's surfaces as a model: its triangles in their order.
LayerModel model_of(const PackedFacade& facade);

}  // namespace parvis::facades
