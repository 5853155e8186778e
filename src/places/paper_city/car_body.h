// A vehicle's body as meshes, one per material.
#pragma once

#include <array>

#include "base/mesh.h"
#include "places/paper_city/car_shape.h"
#include "synthesis/spline_surface.h"

namespace parvis::city {

/// One mesh for each CarSurface.
using CarMeshes = std::array<Mesh, std::size_t(CarSurface::count)>;

/// The spline surface of one side of the body, with the sections as columns of its control net.
synthesis::SplineSurface body_surface(const CarShape& shape);

/// The complete body with wheel arches and underside; closed except for seams between its surfaces.
CarMeshes body_meshes(const CarShape& shape);

}  // namespace parvis::city
