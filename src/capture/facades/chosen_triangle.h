// A small triangle of a facade whose photographs and weights are chosen once for a viewpoint (thesis 3.6.2):
// a pixel of it looks two photographs up, and compares none.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "capture/facades/facade_lookup.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// Where an eye is, in the facade's frame, and radians per pixel.
struct ChosenEye {
  glm::vec3 position{0.0f};
  float pixel_angle = 0.0f;
};

/// The photographs of a triangle, and what they weigh at its corners. `layers`: the best at its centre, the
/// best first, each of which says something there; of a third only the penalty counts. None: no photograph
/// shows the triangle. Nothing where a triangle is too large for weights that change evenly, or partly beside
/// what a photograph has stored: there each pixel has to compare photographs.
std::optional<ChosenTriangle> chosen_triangle(const PackedFacade& facade, FacadeLookup& lookup,
                                              std::size_t triangle, const ChosenEye& eye,
                                              std::span<const std::uint32_t> layers);

}  // namespace parvis::facades
