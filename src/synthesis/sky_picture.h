// A picture of the whole sky on a fair day: blue that pales toward a hazy horizon, soft cumulus clouds with
// lit and shaded sides, hills and distant roofs along the horizon, and the ground below.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "base/image.h"

namespace parvis::synthesis {

/// Equirectangular radiance as scene::Sky wants it, `width_px` by half as many. `to_sun` is a unit vector;
/// the sun's own disc is not in the picture, its glow is.
ImageF sky_picture(int width_px, glm::vec3 to_sun, std::uint64_t seed);

}  // namespace parvis::synthesis
