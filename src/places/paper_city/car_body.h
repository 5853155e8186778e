// A vehicle's body as meshes, one for each thing it is made of.
#pragma once

#include <array>

#include "base/mesh.h"
#include "places/paper_city/car_shape.h"
#include "places/paper_city/spline_surface.h"

namespace parvis::city {

using CarMeshes = std::array<Mesh, std::size_t(CarSurface::count)>;

SplineSurface body_surface(const CarShape& shape);

/// The whole body with wheel arches and underside; closed but for the seams between its surfaces.
CarMeshes body_meshes(const CarShape& shape);

}  // namespace parvis::city
