// What clicked points make of a photograph's camera, for tests and benches.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "capture/photographs/photograph.h"

namespace parvis::photographs {

/// How far, root mean square over the places that lie in the picture, the camera of six well-spread clicks
/// shows them from where the photograph's own camera does, pixels; infinite where the clicks give none. Each
/// click is off by `sigma_px` (standard deviation). Needs a hundred places in the picture.
double clicked_camera_error_px(const Photograph& truth, std::span<const glm::dvec3> places, double sigma_px,
                               std::uint64_t seed);

}  // namespace parvis::photographs
