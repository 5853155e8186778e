// The colours that surfaces take where no photograph shows them.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// Mean colours of triangles, balanced sRGB.
struct TriangleColours {
  /// Of a model of so many triangles, none of which is known yet.
  explicit TriangleColours(std::size_t triangles)
      : sums(triangles, glm::dvec3(0.0)), counts(triangles, 0.0) {}

  std::vector<glm::dvec3> sums;
  std::vector<double> counts;
};

/// Adds what a photograph shows. `layers`: the layer that each of its pixels shows, or none.
void add_colours(const PlaceLayers& place, std::size_t photo, const ItemBuffer& seen,
                 const std::vector<std::uint32_t>& layers, TriangleColours& colours);

/// The model's triangles, those of a surface together.
std::vector<std::uint32_t> by_surface(const LayerModel& model);

/// Adds the model's surfaces, each corner with the colour that it takes where nothing is known.
void add_surfaces(const PlaceLayers& place, const TriangleColours& colours, PackedFacade& facade);

}  // namespace parvis::facades
