// The colours that surfaces take where no photograph shows them: the last step of filling. Like all of it
// they are proposals, which can be refused for each surface (PlaceLayers::surfaces).
#pragma once

#include <cstdint>
#include <vector>

#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// Mean colours of triangles, balanced sRGB.
struct TriangleColours {
  /// Colours of a model of so many triangles, none of which is known yet.
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

/// Adds the model's surfaces, each corner with the colour that is proposed for what no photograph shows: the
/// mean of the nearest known triangles of its surface; of a surface that is nowhere seen, of all triangles
/// that lie as it does (level or upright), and if there are none, of all. Where the proposal is refused they
/// have no_colour.
void add_surfaces(const PlaceLayers& place, const TriangleColours& colours, PackedFacade& facade);

}  // namespace parvis::facades
