// Points on a scene's surfaces with the pictures that see them: what a reconstruction from the photographs
// would find at best.
#pragma once

#include "base/image.h"
#include "graphics/reference/ray_scene.h"
#include "scene/data/taken_picture.h"

namespace parvis::reference {

/// Points that every `step`-th pixel of each picture sees in its centre, coloured by `photographs` (8-bit,
/// one for each picture, of its size). Points that one picture alone sees are kept: some scenes have one
/// camera.
std::vector<scene::SeenPoint> seen_points(const RayScene& rays,
                                          const std::vector<scene::TakenPicture>& pictures,
                                          const std::vector<Image8>& photographs, int step);

}  // namespace parvis::reference
