#include "formats/ifc/ifc_edge_loops.h"

#include <fmt/format.h>
#include <ifcpp/IFC4/include/IfcAxis2Placement3D.h>
#include <ifcpp/IFC4/include/IfcBoolean.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcClosedShell.h>
#include <ifcpp/IFC4/include/IfcCylindricalSurface.h>
#include <ifcpp/IFC4/include/IfcEdgeCurve.h>
#include <ifcpp/IFC4/include/IfcEdgeLoop.h>
#include <ifcpp/IFC4/include/IfcFaceOuterBound.h>
#include <ifcpp/IFC4/include/IfcFaceSurface.h>
#include <ifcpp/IFC4/include/IfcFacetedBrep.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcLine.h>
#include <ifcpp/IFC4/include/IfcManifoldSolidBrep.h>
#include <ifcpp/IFC4/include/IfcOrientedEdge.h>
#include <ifcpp/IFC4/include/IfcPlane.h>
#include <ifcpp/IFC4/include/IfcPolyLoop.h>
#include <ifcpp/IFC4/include/IfcPositiveLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcVertexPoint.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>
#include <ifcpp/model/BuildingModel.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "formats/ifc/ifc_arcs.h"
#include "formats/ifc/ifc_breps.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double full_turn = 2.0 * std::numbers::pi, strip = std::numbers::pi / 24.0, same = 1e-9;

bool is_true(const std::shared_ptr<IfcBoolean>& flag) { return !flag || flag->m_value; }

std::optional<dvec3> place_of(const IfcCartesianPoint* point, double unit_m) {
  if (!point || point->m_Coordinates.size() < 3) return std::nullopt;
  dvec3 place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!point->m_Coordinates[axis]) return std::nullopt;
    place[int(axis)] = point->m_Coordinates[axis]->m_value * unit_m;
  }
  return place;
}

std::optional<dvec3> place_of(const std::shared_ptr<IfcVertex>& vertex, double unit_m) {
  const auto* at = dynamic_cast<const IfcVertexPoint*>(vertex.get());
  return at ? place_of(dynamic_cast<const IfcCartesianPoint*>(at->m_VertexGeometry.get()), unit_m)
            : std::nullopt;
}

/// The points of a curved edge between its ends.
Ring between_ends(const IfcEdgeCurve& edge, dvec3 start, dvec3 end, RepresentationConverter& converter,
                  double unit_m) {
  std::shared_ptr<IfcCurve> curve = edge.m_EdgeGeometry;
  if (!curve || dynamic_cast<const IfcLine*>(curve.get())) return {};
  if (std::optional<Ring> arc =
          arc_between(*curve, {start, end}, is_true(edge.m_SameSense), converter, unit_m))
    return *std::move(arc);
  std::vector<vec3> points, starts;
  converter.getCurveConverter()->convertIfcCurve(curve, points, starts);
  Ring ring;
  for (const vec3& point : points) ring.emplace_back(point.x, point.y, point.z);
  if (ring.size() < 3) return {};
  if (glm::distance(ring.front(), start) > glm::distance(ring.back(), start)) std::ranges::reverse(ring);
  return Ring(ring.begin() + 1, ring.end() - 1);
}

/// Appends the points of an edge as it is run through, its last one left out. False where it has no ends.
bool add_edge(const IfcOrientedEdge& oriented, RepresentationConverter& converter, double unit_m,
              Ring& ring) {
  const IfcEdge* edge = oriented.m_EdgeElement.get();
  const auto start = edge ? place_of(edge->m_EdgeStart, unit_m) : std::nullopt,
             end = edge ? place_of(edge->m_EdgeEnd, unit_m) : std::nullopt;
  if (!start || !end) return false;
  Ring points{*start};
  if (const auto* curved = dynamic_cast<const IfcEdgeCurve*>(edge)) {
    const Ring between = between_ends(*curved, *start, *end, converter, unit_m);
    points.insert(points.end(), between.begin(), between.end());
  }
  points.push_back(*end);
  if (!is_true(oriented.m_Orientation)) std::ranges::reverse(points);
  ring.insert(ring.end(), points.begin(), points.end() - 1);
  return true;
}

/// The rings of a face, the outer one first; none where a loop is of another kind.
std::vector<Ring> rings_of_face(const IfcFace& face, RepresentationConverter& converter, double unit_m) {
  std::vector<Ring> rings;
  for (const auto& bound : face.m_Bounds) {
    Ring ring;
    const auto* edges = bound ? dynamic_cast<const IfcEdgeLoop*>(bound->m_Bound.get()) : nullptr;
    const auto* corners = bound ? dynamic_cast<const IfcPolyLoop*>(bound->m_Bound.get()) : nullptr;
    if (edges)
      for (const auto& edge : edges->m_EdgeList)
        if (!edge || !add_edge(*edge, converter, unit_m, ring)) return {};
    if (corners)
      for (const auto& corner : corners->m_Polygon) {
        const std::optional<dvec3> place = place_of(corner.get(), unit_m);
        if (!place) return {};
        ring.push_back(*place);
      }
    if (ring.size() < 2) return {};
    if (!is_true(bound->m_Orientation)) std::ranges::reverse(ring);
    const bool is_outer = dynamic_cast<const IfcFaceOuterBound*>(bound.get()) != nullptr;
    rings.insert(is_outer ? rings.begin() : rings.end(), std::move(ring));
  }
  return rings;
}

/// A cylinder that is rolled out: points of it are angles about its axis and heights along it.
class Cylinder {
 public:
  Cylinder(const IfcCylindricalSurface& surface, RepresentationConverter& converter, double unit_m)
      : radius_(metres_of(surface.m_Radius, unit_m)) {
    std::shared_ptr<TransformData> position;
    if (surface.m_Position)
      converter.getPlacementConverter()->convertIfcAxis2Placement3D(surface.m_Position, position);
    if (!position) return;
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) frame_[column][row] = position->m_matrix.m[column][row];
  }
  bool has_radius() const { return radius_ > 0.0; }
  dvec2 rolled_out(dvec3 point) const {
    const dvec3 from = point - frame_[3];
    return {std::atan2(glm::dot(from, frame_[1]), glm::dot(from, frame_[0])), glm::dot(from, frame_[2])};
  }
  dvec3 point(dvec2 at) const {
    return frame_[3] + radius_ * (std::cos(at.x) * frame_[0] + std::sin(at.x) * frame_[1]) + at.y * frame_[2];
  }

 private:
  double radius_;
  glm::dmat4x3 frame_{dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(0.0)};
};

/// A side of a rolled-out ring, from the lesser angle to the greater one.
struct Side {
  dvec2 from, to;
};

std::vector<Side> sides_of(const std::vector<Ring>& rings, const Cylinder& cylinder) {
  std::vector<Side> sides;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const dvec2 a = cylinder.rolled_out(ring[i]);
      dvec2 b = cylinder.rolled_out(ring[(i + 1) % ring.size()]);
      b.x = a.x + std::remainder(b.x - a.x, full_turn);
      if (std::abs(b.x - a.x) < same) continue;  // along the cylinder: between two strips
      sides.push_back(a.x < b.x ? Side{a, b} : Side{b, a});
    }
  return sides;
}

/// Heights at which a side crosses the beginning and the end of a strip; nothing where it does not.
std::optional<dvec2> crossing(const Side& side, double begin, double end) {
  const double middle = 0.5 * (begin + end);
  const double turn = full_turn * std::ceil((side.from.x - middle) / full_turn);
  if (middle + turn > side.to.x) return std::nullopt;
  const auto at = [&](double angle) {
    return glm::mix(side.from.y, side.to.y, (angle + turn - side.from.x) / (side.to.x - side.from.x));
  };
  return dvec2(at(begin), at(end));
}

/// The part of a strip between two heights at its beginning and at its end.
void add_strip(const Cylinder& cylinder, dvec2 angles, dvec2 low, dvec2 high, bool faces_out, Faces& faces) {
  const int pieces = std::max(1, int(std::ceil((angles.y - angles.x) / strip - 1e-6)));
  const auto add = [&](Ring triangle) {
    faces.push_back({faces_out ? std::move(triangle) : reversed(std::move(triangle))});
  };
  for (int i = 0; i < pieces; ++i) {
    const double a = double(i) / pieces, b = double(i + 1) / pieces;
    const auto at = [&](double along, dvec2 heights) {
      return cylinder.point({glm::mix(angles.x, angles.y, along), glm::mix(heights.x, heights.y, along)});
    };
    const dvec3 a0 = at(a, low), a1 = at(a, high), b0 = at(b, low), b1 = at(b, high);
    if (glm::distance(b0, b1) > same) add({a0, b0, b1});
    if (glm::distance(a0, a1) > same) add({a0, b1, a1});
  }
}

/// A face on a cylinder, by strips between the angles of its corners; between pairs of sides it is filled.
void add_on_cylinder(const std::vector<Ring>& rings, const Cylinder& cylinder, bool faces_out, Faces& faces) {
  const std::vector<Side> sides = sides_of(rings, cylinder);
  std::vector<double> angles;
  for (const Side& side : sides)
    for (const double angle : {side.from.x, side.to.x})
      angles.push_back(angle - full_turn * std::floor(angle / full_turn));
  std::ranges::sort(angles);
  angles.erase(std::unique(angles.begin(), angles.end(), [](double a, double b) { return b - a < same; }),
               angles.end());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const dvec2 strip_angles(angles[i], i + 1 < angles.size() ? angles[i + 1] : angles.front() + full_turn);
    if (strip_angles.y - strip_angles.x < same) continue;
    std::vector<dvec2> crossings;
    for (const Side& side : sides)
      if (const std::optional<dvec2> heights = crossing(side, strip_angles.x, strip_angles.y))
        crossings.push_back(*heights);
    std::ranges::sort(crossings, {}, [](dvec2 heights) { return heights.x + heights.y; });
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      add_strip(cylinder, strip_angles, crossings[k], crossings[k + 1], faces_out, faces);
  }
}

bool has_edge_loops(const IfcManifoldSolidBrep& brep) {
  if (!brep.m_Outer) return false;
  return std::ranges::any_of(brep.m_Outer->m_CfsFaces, [](const auto& face) {
    return face && std::ranges::any_of(face->m_Bounds, [](const auto& bound) {
             return bound && dynamic_cast<const IfcEdgeLoop*>(bound->m_Bound.get());
           });
  });
}

/// The faces of a body; the kinds of those that are left out.
Faces faces_of(const IfcManifoldSolidBrep& brep, RepresentationConverter& converter, double unit_m,
               std::set<std::string>& left_out) {
  Faces faces;
  for (const auto& face : brep.m_Outer->m_CfsFaces) {
    if (!face) continue;
    std::vector<Ring> rings = rings_of_face(*face, converter, unit_m);
    const auto* on_surface = dynamic_cast<const IfcFaceSurface*>(face.get());
    const IfcSurface* surface = on_surface ? on_surface->m_FaceSurface.get() : nullptr;
    const auto* round = dynamic_cast<const IfcCylindricalSurface*>(surface);
    const bool is_plane = !surface || dynamic_cast<const IfcPlane*>(surface);
    if (rings.empty()) {
      left_out.insert("bounds of a kind that is not read");
    } else if (round) {
      const Cylinder cylinder(*round, converter, unit_m);
      if (cylinder.has_radius()) add_on_cylinder(rings, cylinder, is_true(on_surface->m_SameSense), faces);
    } else if (is_plane) {
      std::erase_if(rings, [](const Ring& ring) { return ring.size() < 3; });
      if (!rings.empty()) faces.push_back(std::move(rings));
    } else {
      left_out.insert(dynamic_cast<const BuildingEntity*>(surface)->className());
    }
  }
  return faces;
}

}  // namespace

void replace_edge_loops(BuildingModel& building, RepresentationConverter& converter,
                        const std::function<void(int, const std::string&)>& complain) {
  const double unit_m = building.getUnitConverter()->getLengthInMeterFactor();
  ReplacedBodies replaced;
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    const auto* brep = dynamic_cast<const IfcManifoldSolidBrep*>(entity.get());
    if (!brep || !has_edge_loops(*brep)) continue;
    std::set<std::string> left_out;
    try {
      if (const Faces faces = faces_of(*brep, converter, unit_m, left_out); !faces.empty())
        replaced.add(*entity, brep_of(faces, unit_m));
    } catch (const std::exception& failure) {  // of IFC++: a curve that it cannot follow
      left_out.insert(failure.what());
    }
    for (const std::string& kind : left_out)
      complain(id, fmt::format("its faces on {} are left out; export it as a body of plane faces", kind));
  }
  replaced.put_into(building);
}

}  // namespace parvis::scene
