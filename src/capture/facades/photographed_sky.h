// The sky as photographs show it around a place, in radiance.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "base/image.h"
#include "capture/facades/facade_lookup.h"

namespace parvis::facades {

/// A point of a surface that is lit by the sky alone.
struct WallSample {
  glm::vec3 normal;    ///< unit, towards the photographs
  glm::vec3 radiance;  ///< as the photographs show it
};

/// Equirectangular radiance about `middle`, 3 channels, as scene::Sky has it: above the horizon what the
/// backdrop shows, below it the mean of the walls. Pictures show a sky as white at most, however bright it
/// was: all of it is scaled, so that the median wall reflects as much of it as common plaster does. Without a
/// backdrop the sky is even.
ImageF photographed_sky(const PackedFacade& facade, const FacadeTexels& texels, glm::vec3 middle,
                        std::span<const WallSample> walls);

}  // namespace parvis::facades
