#include "formats/ifc/ifc_sweeps.h"

#include <ifcpp/IFC4/include/IfcAxis2Placement3D.h>
#include <ifcpp/IFC4/include/IfcCompositeProfileDef.h>
#include <ifcpp/IFC4/include/IfcDirection.h>
#include <ifcpp/IFC4/include/IfcExtrudedAreaSolidTapered.h>
#include <ifcpp/IFC4/include/IfcFacetedBrep.h>
#include <ifcpp/IFC4/include/IfcFixedReferenceSweptAreaSolid.h>
#include <ifcpp/IFC4/include/IfcParameterValue.h>
#include <ifcpp/IFC4/include/IfcPlane.h>
#include <ifcpp/IFC4/include/IfcPolyline.h>
#include <ifcpp/IFC4/include/IfcPositiveLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcReal.h>
#include <ifcpp/IFC4/include/IfcRevolvedAreaSolidTapered.h>
#include <ifcpp/IFC4/include/IfcSectionedSpine.h>
#include <ifcpp/IFC4/include/IfcSurfaceCurveSweptAreaSolid.h>
#include <ifcpp/IFC4/include/IfcSweptDiskSolid.h>
#include <ifcpp/IFC4/include/IfcSweptDiskSolidPolygonal.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>
#include <ifcpp/model/BuildingModel.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "formats/ifc/ifc_breps.h"
#include "formats/ifc/ifc_profiles.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double same_m = 1e-6;  // points of a path that lie nearer are one
constexpr int disk_corners = 16;

/// Points of a path that are not the one before.
std::vector<dvec3> without_repeats(const std::vector<dvec3>& path) {
  std::vector<dvec3> points;
  for (const dvec3& point : path)
    if (points.empty() || glm::distance(points.back(), point) > same_m) points.push_back(point);
  return points;
}

/// A cross section swept along a path from its first point on: each ring lies in the plane between its two
/// pieces, so that the pieces have the same cross section; none is turned against the one before.
std::vector<Ring> swept(Ring ring, const std::vector<dvec3>& path) {
  std::vector<dvec3> along;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) along.push_back(glm::normalize(path[i + 1] - path[i]));
  std::vector<Ring> rings{ring};
  constexpr double sharpest = 0.15;  // cosine of half a turn: what turns back is cut off square
  for (std::size_t i = 1; i < path.size(); ++i) {
    const dvec3 in = along[i - 1], out = along[std::min(i, along.size() - 1)];
    dvec3 normal = glm::length(in + out) > same_m ? glm::normalize(in + out) : in;
    if (glm::dot(normal, in) < sharpest) normal = in;
    for (dvec3& corner : ring) corner += in * (glm::dot(path[i] - corner, normal) / glm::dot(in, normal));
    rings.push_back(ring);
  }
  return rings;
}

/// The rings of a tube along a path.
std::vector<Ring> tube(const std::vector<dvec3>& path, double radius) {
  const dvec3 first = glm::normalize(path[1] - path[0]);
  const dvec3 other = std::abs(first.z) < 0.9 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
  const dvec3 x = glm::normalize(glm::cross(other, first)), y = glm::cross(first, x);
  Ring ring;
  for (int i = 0; i < disk_corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / disk_corners;
    ring.push_back(path.front() + radius * (std::cos(angle) * x + std::sin(angle) * y));
  }
  return swept(std::move(ring), path);
}

Faces disk_faces(const std::vector<dvec3>& path, double radius, double inner_radius) {
  const std::vector<Ring> outer = tube(path, radius);
  Faces faces;
  for (std::size_t i = 0; i + 1 < outer.size(); ++i) add_side(outer[i], outer[i + 1], true, faces);
  if (!(inner_radius > 0.0)) {
    faces.push_back({reversed(outer.front())});
    faces.push_back({outer.back()});
    return faces;
  }
  const std::vector<Ring> inner = tube(path, inner_radius);
  for (std::size_t i = 0; i + 1 < inner.size(); ++i)
    add_side(reversed(inner[i]), reversed(inner[i + 1]), true, faces);
  add_side(inner.front(), outer.front(), true, faces);
  add_side(outer.back(), inner.back(), true, faces);
  return faces;
}

/// The part of a polyline between two parameters, which count its points.
std::vector<dvec3> trimmed(const std::vector<dvec3>& path, double from, double to) {
  const double last = double(path.size() - 1);
  from = std::clamp(from, 0.0, last), to = std::clamp(to, 0.0, last);
  if (!(from < to)) return path;
  const auto at = [&](double parameter) {
    const std::size_t i = std::min(std::size_t(parameter), path.size() - 2);
    return glm::mix(path[i], path[i + 1], parameter - double(i));
  };
  std::vector<dvec3> part{at(from)};
  for (std::size_t i = std::size_t(std::floor(from)) + 1; double(i) < to; ++i) part.push_back(path[i]);
  part.push_back(at(to));
  return part;
}

/// The points of a directrix; of a polyline the part between its two parameters. Empty where it has no
/// length.
std::vector<dvec3> path_of(const std::shared_ptr<IfcCurve>& directrix,
                           const std::shared_ptr<IfcParameterValue>& from,
                           const std::shared_ptr<IfcParameterValue>& to, RepresentationConverter& converter) {
  std::vector<vec3> points, starts;
  converter.getCurveConverter()->convertIfcCurve(directrix, points, starts);
  std::vector<dvec3> path;
  for (const vec3& point : points) path.emplace_back(point.x, point.y, point.z);
  if (dynamic_cast<const IfcPolyline*>(directrix.get()) && from && to && path.size() >= 2)
    path = trimmed(path, from->m_value, to->m_value);
  path = without_repeats(path);
  return path.size() < 2 ? std::vector<dvec3>() : path;
}

/// A polyline with arcs of a radius in place of its corners, as far as they fit between its points.
std::vector<dvec3> rounded(const std::vector<dvec3>& path, double radius) {
  constexpr int chords_per_right_angle = 6;
  std::vector<dvec3> points{path.front()};
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const dvec3 in = glm::normalize(path[i] - path[i - 1]), out = glm::normalize(path[i + 1] - path[i]);
    const double turn = std::acos(std::clamp(glm::dot(in, out), -1.0, 1.0));
    const double cut = radius * std::tan(0.5 * turn);
    const bool fits = turn > same_m && cut < glm::distance(path[i], path[i - 1]) &&
                      cut < glm::distance(path[i + 1], path[i]);
    if (!fits) {
      points.push_back(path[i]);
      continue;
    }
    const dvec3 across = glm::normalize(out - in * glm::dot(in, out));
    const dvec3 first = path[i] - cut * in, middle = first + radius * across;
    const int chords = std::max(1, int(std::ceil(turn / (0.5 * std::numbers::pi) * chords_per_right_angle)));
    for (int k = 0; k <= chords; ++k) {
      const double angle = turn * k / chords;
      points.push_back(middle + radius * (std::sin(angle) * in - std::cos(angle) * across));
    }
  }
  points.push_back(path.back());
  return without_repeats(points);
}

std::shared_ptr<IfcFacetedBrep> body_of(const IfcSweptDiskSolid& solid, RepresentationConverter& converter,
                                        double unit_m, std::string& problem) {
  std::vector<dvec3> path = path_of(solid.m_Directrix, solid.m_StartParam, solid.m_EndParam, converter);
  if (const auto* polygonal = dynamic_cast<const IfcSweptDiskSolidPolygonal*>(&solid))
    if (const double fillet = metres_of(polygonal->m_FilletRadius, unit_m); fillet > 0.0 && !path.empty())
      path = rounded(path, fillet);
  const double radius = metres_of(solid.m_Radius, unit_m), inner = metres_of(solid.m_InnerRadius, unit_m);
  if (path.empty() || !(radius > 0.0) || inner >= radius) {
    problem = "its path has no length, or its radii are no tube";
    return nullptr;
  }
  return brep_of(disk_faces(path, radius, inner), unit_m);
}

dvec3 vector_of(const std::shared_ptr<IfcDirection>& direction) {
  dvec3 vector(0.0);
  for (std::size_t axis = 0;
       direction && axis < std::min<std::size_t>(direction->m_DirectionRatios.size(), 3); ++axis)
    if (const auto& ratio = direction->m_DirectionRatios[axis]) vector[int(axis)] = ratio->m_value;
  return vector;
}

/// Where a swept solid puts points of its own frame.
class Placed {
 public:
  Placed(const IfcSweptAreaSolid& solid, RepresentationConverter& converter) {
    if (solid.m_Position)
      converter.getPlacementConverter()->convertIfcAxis2Placement3D(solid.m_Position, position_);
  }
  dvec3 operator()(dvec3 point) const {
    if (!position_) return point;
    const vec3 at = position_->m_matrix * carve::geom::VECTOR(point.x, point.y, point.z);
    return {at.x, at.y, at.z};
  }
  Ring operator()(const std::vector<dvec2>& ring, dvec3 offset) const {
    Ring placed;
    for (const dvec2& point : ring) placed.push_back((*this)(dvec3(point, 0.0) + offset));
    return placed;
  }

 private:
  std::shared_ptr<TransformData> position_;
};

/// The rings of one profile extruded to those of another, whose rings have as many corners.
void add_prism(const std::vector<std::vector<dvec2>>& from, const std::vector<std::vector<dvec2>>& to,
               dvec3 along, bool is_plane, const Placed& placed, Faces& faces) {
  std::vector<Ring> bottom, top;
  for (std::size_t i = 0; i < from.size(); ++i) {
    Ring below = placed(from[i], dvec3(0.0)), above = placed(to[i], along);
    if (along.z < 0.0) below = reversed(below), above = reversed(above);
    add_side(below, above, is_plane, faces);
    bottom.push_back(reversed(below)), top.push_back(above);
  }
  faces.push_back(std::move(bottom)), faces.push_back(std::move(top));
}

/// How far an extrusion goes, metres; zero where the file does not say.
dvec3 extrusion_of(const IfcExtrudedAreaSolid& solid, double unit_m) {
  const dvec3 along = vector_of(solid.m_ExtrudedDirection);
  return along * metres_of(solid.m_Depth, unit_m) / std::max(glm::length(along), 1e-12);
}

std::shared_ptr<IfcFacetedBrep> body_of(const IfcExtrudedAreaSolidTapered& solid,
                                        RepresentationConverter& converter, double unit_m,
                                        std::string& problem) {
  const auto from = rings_of(solid.m_SweptArea, converter), to = rings_of(solid.m_EndSweptArea, converter);
  const dvec3 along = extrusion_of(solid, unit_m);
  bool is_alike = from.size() == to.size() && !from.empty() && along != dvec3(0.0);
  for (std::size_t i = 0; is_alike && i < from.size(); ++i)
    is_alike = from[i].size() == to[i].size() && from[i].size() >= 3;
  if (!is_alike) {
    problem = "its two profiles are not of one kind; it is drawn without the taper";
    return nullptr;
  }
  Faces faces;
  add_prism(from, to, along, false, Placed(solid, converter), faces);
  return brep_of(faces, unit_m);
}

/// A body for each profile of several: IFC++ takes all but the first for holes.
std::shared_ptr<IfcFacetedBrep> body_of_several(const IfcExtrudedAreaSolid& solid,
                                                RepresentationConverter& converter, double unit_m) {
  const auto* several = dynamic_cast<const IfcCompositeProfileDef*>(solid.m_SweptArea.get());
  const dvec3 along = extrusion_of(solid, unit_m);
  if (!several || along == dvec3(0.0)) return nullptr;
  const Placed placed(solid, converter);
  Faces faces;
  for (const auto& profile : several->m_Profiles)
    if (const auto rings = rings_of(profile, converter); !rings.empty())
      add_prism(rings, rings, along, true, placed, faces);
  return faces.empty() ? nullptr : brep_of(faces, unit_m);
}

/// Lets the extrusion go as far as its depth says: IFC++ multiplies it by the length of the direction.
void set_unit_direction(IfcExtrudedAreaSolid& solid) {
  const dvec3 along = vector_of(solid.m_ExtrudedDirection);
  const double length = glm::length(along);
  if (!(length > 0.0) || std::abs(length - 1.0) < 1e-9) return;
  const auto unit = std::make_shared<IfcDirection>(solid.m_ExtrudedDirection->m_entity_id);
  for (int axis = 0; axis < 3; ++axis)
    unit->m_DirectionRatios.push_back(std::make_shared<IfcReal>(along[axis] / length));
  solid.m_ExtrudedDirection = unit;
}

/// Twice the area of a plane ring, along its normal.
dvec3 facing(const Ring& ring) {
  dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return sum;
}

/// Cross sections at their places, with straight sides between. Null where they are not of one kind.
std::shared_ptr<IfcFacetedBrep> body_of(const IfcSectionedSpine& spine, RepresentationConverter& converter,
                                        double unit_m, std::string& problem) {
  std::vector<std::vector<Ring>> sections;
  for (std::size_t i = 0; i < std::min(spine.m_CrossSections.size(), spine.m_CrossSectionPositions.size());
       ++i) {
    std::shared_ptr<TransformData> position;
    if (spine.m_CrossSectionPositions[i])
      converter.getPlacementConverter()->convertIfcAxis2Placement3D(spine.m_CrossSectionPositions[i],
                                                                    position);
    std::vector<Ring>& section = sections.emplace_back();
    if (!spine.m_CrossSections[i]) continue;
    for (const Outline& ring : rings_of(spine.m_CrossSections[i], converter)) {
      Ring& placed = section.emplace_back();
      for (const dvec2& point : ring) {
        const vec3 at = carve::geom::VECTOR(point.x, point.y, 0.0);
        const vec3 there = position ? position->m_matrix * at : at;
        placed.emplace_back(there.x, there.y, there.z);
      }
    }
  }
  const auto is_like_first = [&](const std::vector<Ring>& section) {
    return std::ranges::equal(section, sections.front(), [](const Ring& a, const Ring& b) {
      return a.size() == b.size() && a.size() >= 3;
    });
  };
  if (sections.size() < 2 || sections.front().empty() || !std::ranges::all_of(sections, is_like_first)) {
    problem = "its cross sections are not of one kind";
    return nullptr;
  }
  const Ring& first = sections.front().front();
  if (glm::dot(sections[1].front().front() - first.front(), facing(first)) < 0.0)  // the spine runs down
    for (std::vector<Ring>& section : sections)
      for (Ring& ring : section) ring = reversed(ring);
  Faces faces;
  std::vector<Ring> bottom;
  for (std::size_t k = 0; k + 1 < sections.size(); ++k)
    for (std::size_t r = 0; r < sections[k].size(); ++r)
      add_side(sections[k][r], sections[k + 1][r], false, faces);
  for (const Ring& ring : sections.front()) bottom.push_back(reversed(ring));
  faces.push_back(std::move(bottom)), faces.push_back(sections.back());
  return brep_of(faces, unit_m);
}

/// A profile swept along a curve, its x axis towards `reference`, in the solid's frame.
std::shared_ptr<IfcFacetedBrep> body_along(const IfcSweptAreaSolid& solid, const std::vector<dvec3>& path,
                                           dvec3 reference, RepresentationConverter& converter, double unit_m,
                                           std::string& problem) {
  const auto rings = rings_of(solid.m_SweptArea, converter);
  const dvec3 first = path.empty() ? dvec3(0.0) : glm::normalize(path[1] - path[0]);
  const dvec3 across = reference - glm::dot(reference, first) * first;
  if (rings.empty() || path.empty() || glm::length(across) < 1e-6 * glm::length(reference)) {
    problem = "its path has no length, or runs along its reference";
    return nullptr;
  }
  const dvec3 x = glm::normalize(across), y = glm::cross(first, x);
  const Placed placed(solid, converter);
  Faces faces;
  std::vector<Ring> bottom, top;
  for (const std::vector<dvec2>& ring : rings) {
    Ring section;
    for (const dvec2& point : ring) section.push_back(path.front() + point.x * x + point.y * y);
    std::vector<Ring> along = swept(std::move(section), path);
    for (Ring& each : along)
      for (dvec3& corner : each) corner = placed(corner);
    for (std::size_t i = 0; i + 1 < along.size(); ++i) add_side(along[i], along[i + 1], true, faces);
    bottom.push_back(reversed(along.front())), top.push_back(along.back());
  }
  faces.push_back(std::move(bottom)), faces.push_back(std::move(top));
  return brep_of(faces, unit_m);
}

std::shared_ptr<IfcFacetedBrep> body_of(const IfcFixedReferenceSweptAreaSolid& solid,
                                        RepresentationConverter& converter, double unit_m,
                                        std::string& problem) {
  const auto path = path_of(solid.m_Directrix, solid.m_StartParam, solid.m_EndParam, converter);
  return body_along(solid, path, vector_of(solid.m_FixedReference), converter, unit_m, problem);
}

/// The profile's x axis is the normal of the plane that it is swept along.
std::shared_ptr<IfcFacetedBrep> body_of(const IfcSurfaceCurveSweptAreaSolid& solid,
                                        RepresentationConverter& converter, double unit_m,
                                        std::string& problem) {
  const auto* plane = dynamic_cast<const IfcPlane*>(solid.m_ReferenceSurface.get());
  if (!plane) {
    problem = "it is swept along a surface that is no plane";
    return nullptr;
  }
  const dvec3 given = plane->m_Position ? vector_of(plane->m_Position->m_Axis) : dvec3(0.0);
  const auto path = path_of(solid.m_Directrix, solid.m_StartParam, solid.m_EndParam, converter);
  return body_along(solid, path, given == dvec3(0.0) ? dvec3(0, 0, 1) : given, converter, unit_m, problem);
}

}  // namespace

void replace_sweeps(BuildingModel& building, RepresentationConverter& converter,
                    const std::function<void(int, const std::string&)>& complain) {
  const double unit_m = building.getUnitConverter()->getLengthInMeterFactor();
  ReplacedBodies replaced;
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    std::string problem;
    std::shared_ptr<IfcFacetedBrep> body;
    try {
      if (const auto* disk = dynamic_cast<const IfcSweptDiskSolid*>(entity.get()))
        body = body_of(*disk, converter, unit_m, problem);
      else if (const auto* tapered = dynamic_cast<const IfcExtrudedAreaSolidTapered*>(entity.get()))
        body = body_of(*tapered, converter, unit_m, problem);
      else if (auto* extruded = dynamic_cast<IfcExtrudedAreaSolid*>(entity.get()))
        set_unit_direction(*extruded), body = body_of_several(*extruded, converter, unit_m);
      else if (const auto* spine = dynamic_cast<const IfcSectionedSpine*>(entity.get()))
        body = body_of(*spine, converter, unit_m, problem);
      else if (const auto* fixed = dynamic_cast<const IfcFixedReferenceSweptAreaSolid*>(entity.get()))
        body = body_of(*fixed, converter, unit_m, problem);
      else if (const auto* on_surface = dynamic_cast<const IfcSurfaceCurveSweptAreaSolid*>(entity.get()))
        body = body_of(*on_surface, converter, unit_m, problem);
      else if (dynamic_cast<const IfcRevolvedAreaSolidTapered*>(entity.get()))
        problem = "its end has another profile, which is left out";
    } catch (const std::exception& failure) {  // of IFC++: a curve that it cannot follow
      problem = failure.what();
    }
    if (!problem.empty()) complain(id, problem);
    if (body) replaced.add(*entity, body);
  }
  replaced.put_into(building);
}

}  // namespace parvis::scene
