// What the photographs show of points of the model, as colours that can be compared.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "capture/facades/prepared_photo.h"

namespace parvis::facades {

/// A surface point's colour in a photograph that sees it.
struct Sighting {
  std::uint32_t photo;
  glm::vec3 srgb;
};
using Sightings = std::vector<Sighting>;

/// The photographs' colours in sRGB, each the mean over 5 x 5 pixels: what is off by a pixel or two still is
/// the same.
std::vector<ImageF> blurred_srgb(std::span<const PreparedPhoto> photos);

/// The colours of such images behind a point of the world, of those photographs that see it and are not
/// masked there.
Sightings sightings(std::span<const PreparedPhoto> photos, std::span<const ImageF> srgb, glm::dvec3 point);

}  // namespace parvis::facades
