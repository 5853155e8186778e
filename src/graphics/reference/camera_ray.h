// The ray through a point of a picture.
#pragma once

#include "base/camera.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::reference {

/// Through `pixel`, counted in pixels from the picture's top left; it begins at the near plane, as the
/// renderer's picture does.
Ray camera_ray(const Camera& camera, int width, int height, glm::vec2 pixel);

}  // namespace parvis::reference
