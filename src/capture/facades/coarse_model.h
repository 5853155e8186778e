// A coarse model of a place from its photographs' sparse points: ground, walls and roofs as named planar
// polygons; openings are left to the textures (thesis, section 3.3: there built by hand in ImageModeler). A
// small file of hints corrects it.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/mesh.h"
#include "base/result.h"
#include "capture/facades/layer_model.h"
#include "capture/facades/plane_search.h"

namespace parvis::facades {

/// A convex planar polygon.
struct CoarseSurface {
  std::string name;  ///< "ground", "wall_1", "roof_2", "slope_1", ...: by falling number of points
  SurfaceKind kind = SurfaceKind::wall;
  std::vector<glm::dvec3> corners;  ///< in world, counter-clockwise seen from the cameras
  std::size_t points = 0;           ///< that support it; 0 for one that a hint gives
};

/// Named surfaces of a place, and what was left out.
struct CoarseModel {
  std::vector<CoarseSurface> surfaces;
  Errors notes;  ///< what was left out, and why
};

/// Proposes a model: planes (plane_search.h), their extents by gaps between points, walls down to the ground
/// and joined at their corners, roofs down to the walls that carry them,
/// slopes (stairs, ramps) from the ground up to the wall that ends them. A wall that photographs look through
/// is left out with a note. Errors: no points (run parvis facade calibrate), or no plane in them.
Result<CoarseModel> propose_coarse_model(const photographs::PhotographSet& set);

/// Corrects a model by the lines of a hint file; # begins a comment:
///   remove NAME
///   rename NAME NEW
///   top NAME Z, bottom NAME Z              height of a wall's upper or lower edge
///   left NAME X Y, right NAME X Y          a wall's end, seen from its front: where it is nearest to this
///   place plane NAME X Y Z  X Y Z  X Y Z ...     a polygon, counter-clockwise seen from the front; replaces
///   one of its name
/// Errors carry file and line; all are reported, and nothing is changed then.
Status apply_hints(CoarseModel& model, const std::string& text, const std::string& file);

/// The surfaces as triangles, a mesh per surface.
std::vector<NamedMesh> meshes_of(const CoarseModel& model);

}  // namespace parvis::facades
