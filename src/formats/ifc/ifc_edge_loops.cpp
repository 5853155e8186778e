#include "formats/ifc/ifc_edge_loops.h"

#include <fmt/format.h>
#include <ifcpp/IFC4/include/IfcAdvancedBrepWithVoids.h>
#include <ifcpp/IFC4/include/IfcBoolean.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcClosedShell.h>
#include <ifcpp/IFC4/include/IfcEdgeCurve.h>
#include <ifcpp/IFC4/include/IfcEdgeLoop.h>
#include <ifcpp/IFC4/include/IfcFaceBasedSurfaceModel.h>
#include <ifcpp/IFC4/include/IfcFaceOuterBound.h>
#include <ifcpp/IFC4/include/IfcFaceSurface.h>
#include <ifcpp/IFC4/include/IfcFacetedBrep.h>
#include <ifcpp/IFC4/include/IfcFacetedBrepWithVoids.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcLine.h>
#include <ifcpp/IFC4/include/IfcManifoldSolidBrep.h>
#include <ifcpp/IFC4/include/IfcOrientedEdge.h>
#include <ifcpp/IFC4/include/IfcPlane.h>
#include <ifcpp/IFC4/include/IfcPolyLoop.h>
#include <ifcpp/IFC4/include/IfcShellBasedSurfaceModel.h>
#include <ifcpp/IFC4/include/IfcSurfaceCurve.h>
#include <ifcpp/IFC4/include/IfcVertexLoop.h>
#include <ifcpp/IFC4/include/IfcVertexPoint.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>
#include <ifcpp/model/BuildingModel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "formats/ifc/ifc_arcs.h"
#include "formats/ifc/ifc_breps.h"
#include "formats/ifc/ifc_curved_surfaces.h"

namespace parvis::scene {
namespace {

using glm::dvec3;

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

/// Where along a line of points, by their number, it is nearest to a place.
double nearest_number(const Ring& line, dvec3 place) {
  double nearest = std::numeric_limits<double>::infinity(), found = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const dvec3 along = line[i + 1] - line[i];
    const double squared = glm::dot(along, along);
    const double t = squared > 0.0 ? std::clamp(glm::dot(place - line[i], along) / squared, 0.0, 1.0) : 0.0;
    if (const double d = glm::distance(place, line[i] + t * along); d < nearest)
      nearest = d, found = double(i) + t;
  }
  return found;
}

/// The points of a curved edge between its ends.
Ring between_ends(const IfcEdgeCurve& edge, dvec3 start, dvec3 end, RepresentationConverter& converter,
                  double unit_m) {
  std::shared_ptr<IfcCurve> curve = edge.m_EdgeGeometry;
  if (const auto* on_surfaces = dynamic_cast<const IfcSurfaceCurve*>(curve.get()))
    curve = on_surfaces->m_Curve3D;
  if (!curve || dynamic_cast<const IfcLine*>(curve.get())) return {};
  const bool is_forward = is_true(edge.m_SameSense);
  if (std::optional<Ring> arc = arc_between(*curve, {start, end}, is_forward, converter, unit_m))
    return *std::move(arc);
  std::vector<vec3> points, starts;
  converter.getCurveConverter()->convertIfcCurve(curve, points, starts);
  Ring ring;
  for (const vec3& point : points) ring.emplace_back(point.x, point.y, point.z);
  if (ring.size() < 3) return {};
  constexpr double same_m = 1e-6;
  const bool is_closed = glm::distance(ring.front(), ring.back()) < same_m;
  if (is_closed && !is_forward) std::ranges::reverse(ring);
  const double pieces = double(ring.size() - 1);
  double from = nearest_number(ring, start), to = nearest_number(ring, end);
  const bool runs_back = !is_closed && from > to;
  if (runs_back) std::swap(from, to);
  if (is_closed && glm::distance(start, end) < same_m) to = from + pieces;
  if (to < from) to += pieces;  // it begins anywhere on the curve
  Ring between;
  for (double i = std::floor(from) + 1.0; i < to; ++i) {
    const dvec3& point = ring[std::size_t(i < pieces ? i : i - pieces)];
    if (glm::distance(point, start) >= same_m && glm::distance(point, end) >= same_m)
      between.push_back(point);
  }
  return runs_back ? reversed(std::move(between)) : between;
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
    if (const auto* vertex = bound ? dynamic_cast<const IfcVertexLoop*>(bound->m_Bound.get()) : nullptr)
      if (const std::optional<dvec3> place = place_of(vertex->m_LoopVertex, unit_m)) ring.push_back(*place);
    if (ring.empty()) return {};
    if (!is_true(bound->m_Orientation)) std::ranges::reverse(ring);
    const bool is_outer = dynamic_cast<const IfcFaceOuterBound*>(bound.get()) != nullptr;
    rings.insert(is_outer ? rings.begin() : rings.end(), std::move(ring));
  }
  return rings;
}

struct Shell {
  std::shared_ptr<IfcConnectedFaceSet> faces;
  bool is_void = false;
};

/// The shells of a body, null ones left out; none where the entity is no body of faces.
std::vector<Shell> shells_of(const BuildingEntity* entity) {
  std::vector<Shell> shells;
  const auto add = [&](const auto& list, bool are_voids) {
    for (const auto& each : list)
      if (auto faces = std::dynamic_pointer_cast<IfcConnectedFaceSet>(each))
        shells.push_back({std::move(faces), are_voids});
  };
  if (const auto* brep = dynamic_cast<const IfcManifoldSolidBrep*>(entity))
    add(std::array{brep->m_Outer}, false);
  if (const auto* brep = dynamic_cast<const IfcFacetedBrepWithVoids*>(entity)) add(brep->m_Voids, true);
  if (const auto* brep = dynamic_cast<const IfcAdvancedBrepWithVoids*>(entity)) add(brep->m_Voids, true);
  if (const auto* model = dynamic_cast<const IfcShellBasedSurfaceModel*>(entity))
    add(model->m_SbsmBoundary, false);
  if (const auto* model = dynamic_cast<const IfcFaceBasedSurfaceModel*>(entity))
    add(model->m_FbsmFaces, false);
  return shells;
}

/// Is it one of which IFC++ makes nothing, or not all?
bool is_lost(const Shell& shell) {
  return shell.is_void || std::ranges::any_of(shell.faces->m_CfsFaces, [](const auto& face) {
           return face && std::ranges::any_of(face->m_Bounds, [](const auto& bound) {
                    return bound && !dynamic_cast<const IfcPolyLoop*>(bound->m_Bound.get());
                  });
         });
}

/// Appends the faces of a shell; the kinds of those that are left out.
void add_faces(const IfcConnectedFaceSet& shell, RepresentationConverter& converter, double unit_m,
               Faces& faces, std::set<std::string>& left_out) {
  for (const auto& face : shell.m_CfsFaces) {
    if (!face) continue;
    std::vector<Ring> rings = rings_of_face(*face, converter, unit_m);
    const auto* on_surface = dynamic_cast<const IfcFaceSurface*>(face.get());
    const IfcSurface* surface = on_surface ? on_surface->m_FaceSurface.get() : nullptr;
    if (rings.empty()) {
      left_out.insert("bounds of a kind that is not read");
    } else if (!surface || dynamic_cast<const IfcPlane*>(surface)) {
      std::erase_if(rings, [](const Ring& ring) { return ring.size() < 3; });
      if (!rings.empty()) faces.push_back(std::move(rings));
    } else {
      const std::size_t before = faces.size();
      if (auto curved = curved_surface(*surface, converter, unit_m))
        add_curved_face(rings, std::move(curved), is_true(on_surface->m_SameSense), faces);
      if (faces.size() == before) left_out.insert(dynamic_cast<const BuildingEntity*>(surface)->className());
    }
  }
}

/// Six times the volume of faces that enclose one.
double volume_of(std::span<const std::vector<Ring>> faces) {
  double volume = 0.0;
  for (const std::vector<Ring>& rings : faces)
    for (const Ring& ring : rings)
      for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        volume += glm::dot(ring[0], glm::cross(ring[i], ring[i + 1]));
  return volume;
}

/// The faces of a body, those of its voids seen from within; the kinds of those that are left out.
Faces faces_of(const std::vector<Shell>& shells, RepresentationConverter& converter, double unit_m,
               std::set<std::string>& left_out) {
  Faces faces;
  for (const Shell& shell : shells) {
    const std::size_t first = faces.size();
    add_faces(*shell.faces, converter, unit_m, faces, left_out);
    const auto added = std::span(faces).subspan(first);
    if (shell.is_void && volume_of(added) > 0.0)
      for (std::vector<Ring>& rings : added)
        for (Ring& ring : rings) std::ranges::reverse(ring);
  }
  return faces;
}

}  // namespace

void replace_edge_loops(BuildingModel& building, RepresentationConverter& converter,
                        const std::function<void(int, const std::string&)>& complain) {
  const double unit_m = building.getUnitConverter()->getLengthInMeterFactor();
  ReplacedBodies replaced;
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    const std::vector<Shell> shells = shells_of(entity.get());
    if (std::ranges::none_of(shells, is_lost)) continue;
    std::set<std::string> left_out;
    try {
      if (const Faces faces = faces_of(shells, converter, unit_m, left_out); !faces.empty())
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
