// The `material` nodes of a car's script.
#pragma once

#include <string>
#include <vector>

#include "places/car_bodies/body_surfaces.h"

namespace parvis::car_bodies {

/// One node for each surface and for the masks of its picture, in an order in which each finds what it names:
/// a node gives its triangles another material, and with it another name. Comments say what stays as it is
/// and what was not found.
std::string material_lines(const scene::Model& model, const std::vector<BodySurface>& surfaces,
                           const std::vector<SurfaceSample>& samples);

/// `text` as a quoted value of a script.
std::string in_quotes(const std::string& text);

}  // namespace parvis::car_bodies
