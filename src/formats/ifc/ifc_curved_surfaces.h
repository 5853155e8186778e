// Curved surfaces of IFC, over a plane of two parameters, and faces on them. A part of the module
// ifcplusplus.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "formats/ifc/ifc_breps.h"

class IfcSurface;
class RepresentationConverter;

namespace parvis::scene {

/// One of the two parameters of a surface.
struct SurfaceParameter {
  double period = 0.0;  ///< after which the surface comes round; 0: it does not
  double step = std::numeric_limits<double>::infinity();  ///< at most between two corners, at multiples of it
  std::vector<double> lines;  ///< in place of `step`: values of its kinks and divisions, rising
};

/// A surface without its bounds. Where u grows to the right and v upward, it is seen from its front.
class CurvedSurface {
 public:
  CurvedSurface() = default;
  CurvedSurface(const CurvedSurface&) = delete;
  CurvedSurface& operator=(const CurvedSurface&) = delete;
  virtual ~CurvedSurface() = default;

  /// The point at two parameters, metres.
  virtual glm::dvec3 point(glm::dvec2 at) const = 0;
  /// Where a point lies on it, or nearest to it; of periodic ones any of the values.
  virtual glm::dvec2 parameters(glm::dvec3 point) const = 0;

  std::array<SurfaceParameter, 2> along;  ///< u and v
  /// The values of v, lowest and highest, at which the surface is one point; NaN: there is none.
  std::array<double, 2> poles{std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::quiet_NaN()};
  double same = 1e-9;                ///< parameters that differ by less are one
  bool is_seen_from_behind = false;  ///< in place of from its front
};

/// A cylinder, a sphere, a torus, a surface of revolution or of linear extrusion, or a B-spline; null where
/// `surface` is none of these, or has no size.
std::unique_ptr<CurvedSurface> curved_surface(const IfcSurface& surface, RepresentationConverter& converter,
                                              double unit_m);

/// Appends a face within `rings`, which run counter-clockwise seen from the front of the face, in strips of
/// its surface. `has_its_front` says whether front of face and surface are one side.
void add_curved_face(const std::vector<Ring>& rings, std::unique_ptr<CurvedSurface> surface,
                     bool has_its_front, Faces& faces);

}  // namespace parvis::scene
