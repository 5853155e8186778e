// The light in which a place was photographed: where the sun stood, by the shadows that the place casts on
// itself, and the sky. Things that are inserted are lit by it (thesis, section 5.3.4).
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>

#include "base/image.h"
#include "base/result.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {

struct PhotographedLight {
  bool is_overcast = true;         ///< no shadow that photographs show is explained by a sun
  glm::vec3 to_sun{0, 0, 1};       ///< unit, in the facade's frame; the best that was found, overcast or not
  double agreement = 0.0;          ///< phi coefficient of `to_sun`, see find_photographed_light
  std::size_t points = 0;          ///< that were lit or shaded without doubt; 0: no surface shows both
  glm::vec3 sun_irradiance{0.0f};  ///< on a plane that faces the sun, for an exposure of 1
  ImageF sky;                      ///< equirectangular radiance, as scene::Sky has it, for an exposure of 1
};

/// The phi coefficient from which on the sun is believed.
inline constexpr double sunlit_agreement = 0.35;

/// Finds the sun of a facade whose photographs were taken within a short time. Points of surfaces that are
/// partly lit and partly shaded (photographs::lit_and_shaded) are compared with the shadows that the model
/// casts from 2000 directions, evenly over the sky, and from 400 about the four best; the phi coefficient of
/// both (the correlation of two things that are true or false) judges a direction. Points on soft edges count
/// by how far they are lit, so that an edge lies where half of its light is left. The sky is what the
/// backdrop shows, scaled so that a wall of common plaster is as bright under it as the photographs show
/// walls in shade. Errors: a facade without photographs or without a surface beside its backdrop.
Result<PhotographedLight> find_photographed_light(const PackedFacade& facade);

/// Writes light.hdr (the sky) and light.xp (sun, sky and exposure, for scenes to include) into a place's
/// folder. A light.xp that somebody changed is left alone: an error says so.
Status write_photographed_light(const std::filesystem::path& folder, const PhotographedLight& light);

}  // namespace parvis::facades
