#include "formats/ifc/ifc_profiles.h"

#include <ifcpp/IFC4/include/IfcArbitraryClosedProfileDef.h>
#include <ifcpp/IFC4/include/IfcArbitraryProfileDefWithVoids.h>
#include <ifcpp/IFC4/include/IfcAsymmetricIShapeProfileDef.h>
#include <ifcpp/IFC4/include/IfcAxis2Placement2D.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcCenterLineProfileDef.h>
#include <ifcpp/IFC4/include/IfcCompositeProfileDef.h>
#include <ifcpp/IFC4/include/IfcDerivedProfileDef.h>
#include <ifcpp/IFC4/include/IfcExtrudedAreaSolidTapered.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcMirroredProfileDef.h>
#include <ifcpp/IFC4/include/IfcPolyline.h>
#include <ifcpp/IFC4/include/IfcPositiveLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcProfileTypeEnum.h>
#include <ifcpp/IFC4/include/IfcSectionedSpine.h>
#include <ifcpp/IFC4/include/IfcSweptAreaSolid.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>
#include <ifcpp/model/BuildingModel.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

#include "formats/ifc/ifc_breps.h"

namespace parvis::scene {
namespace {

using glm::dvec2;

std::shared_ptr<IfcPolyline> closed_polyline(const Outline& outline, double unit_m) {
  auto line = std::make_shared<IfcPolyline>();
  for (const dvec2& corner : outline) {
    const auto point = std::make_shared<IfcCartesianPoint>();
    for (int axis = 0; axis < 2; ++axis)
      point->m_Coordinates.push_back(std::make_shared<IfcLengthMeasure>(corner[axis] / unit_m));
    line->m_Points.push_back(point);
  }
  line->m_Points.push_back(line->m_Points.front());
  return line;
}

std::shared_ptr<IfcArbitraryClosedProfileDef> area(std::shared_ptr<IfcArbitraryClosedProfileDef> profile,
                                                   const Outline& outline, double unit_m) {
  profile->m_ProfileType = std::make_shared<IfcProfileTypeEnum>(IfcProfileTypeEnum::ENUM_AREA);
  profile->m_OuterCurve = closed_polyline(outline, unit_m);
  return profile;
}

/// Two flanges and the web between them, about the middle of their box. Null where a measure is missing.
std::shared_ptr<IfcProfileDef> plain(const IfcAsymmetricIShapeProfileDef& shape,
                                     RepresentationConverter& converter, double unit_m) {
  const double below = 0.5 * metres_of(shape.m_BottomFlangeWidth, unit_m),
               above = 0.5 * metres_of(shape.m_TopFlangeWidth, unit_m),
               web = 0.5 * metres_of(shape.m_WebThickness, unit_m),
               half = 0.5 * metres_of(shape.m_OverallDepth, unit_m),
               below_m = metres_of(shape.m_BottomFlangeThickness, unit_m),
               above_m = shape.m_TopFlangeThickness ? metres_of(shape.m_TopFlangeThickness, unit_m) : below_m;
  if (!(below > 0.0 && above > 0.0 && web > 0.0 && half > 0.0 && below_m > 0.0 && above_m > 0.0))
    return nullptr;
  Outline outline{{-below, -half},        {below, -half},         {below, below_m - half},
                  {web, below_m - half},  {web, half - above_m},  {above, half - above_m},
                  {above, half},          {-above, half},         {-above, half - above_m},
                  {-web, half - above_m}, {-web, below_m - half}, {-below, below_m - half}};
  std::shared_ptr<TransformData> position;
  if (shape.m_Position)
    converter.getPlacementConverter()->convertIfcAxis2Placement2D(shape.m_Position, position);
  for (dvec2& corner : outline) {
    if (!position) break;
    const vec3 at = position->m_matrix * carve::geom::VECTOR(corner.x, corner.y, 0.0);
    corner = {at.x, at.y};
  }
  return area(std::make_shared<IfcArbitraryClosedProfileDef>(), outline, unit_m);
}

/// A line beside a path, to its left where `distance` is positive, with mitred corners.
Outline beside(const Outline& path, bool is_closed, double distance) {
  constexpr double sharpest = 0.15;  // cosine of half a turn: longer mitres are cut off
  const std::size_t count = path.size();
  const auto left_of = [&](std::size_t i) {
    const dvec2 along = glm::normalize(path[(i + 1) % count] - path[i % count]);
    return dvec2(-along.y, along.x);
  };
  Outline line;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_end = !is_closed && (i == 0 || i + 1 == count);
    const dvec2 before = is_end && i == 0 ? left_of(0) : left_of(i + count - 1);
    const dvec2 after = is_end && i > 0 ? before : left_of(i);
    const dvec2 middle = before + after;
    const double cosine = 0.5 * glm::length(middle);
    line.push_back(cosine < sharpest ? path[i] + distance * before
                                     : path[i] + distance / (cosine * cosine) * 0.5 * middle);
  }
  return line;
}

/// A strip along a path; a ring where the path is closed. Null where it has no length.
std::shared_ptr<IfcProfileDef> plain(const IfcCenterLineProfileDef& shape, RepresentationConverter& converter,
                                     double unit_m) {
  constexpr double same_m = 1e-6;
  const double half = 0.5 * metres_of(shape.m_Thickness, unit_m);
  std::vector<vec3> points, starts;
  std::shared_ptr<IfcCurve> curve = shape.m_Curve;
  converter.getCurveConverter()->convertIfcCurve(curve, points, starts);
  Outline path;
  for (const vec3& point : points)
    if (path.empty() || glm::distance(path.back(), dvec2(point.x, point.y)) > same_m)
      path.emplace_back(point.x, point.y);
  const bool is_closed = path.size() > 3 && glm::distance(path.front(), path.back()) <= same_m;
  if (is_closed) path.pop_back();
  if (path.size() < 2 || !(half > 0.0)) return nullptr;
  Outline right = beside(path, is_closed, -half), left = beside(path, is_closed, half);
  if (!is_closed) {
    right.insert(right.end(), left.rbegin(), left.rend());
    return area(std::make_shared<IfcArbitraryClosedProfileDef>(), right, unit_m);
  }
  double turned = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const dvec2 a = path[i], b = path[(i + 1) % path.size()];
    turned += a.x * b.y - a.y * b.x;
  }
  if (turned < 0.0) std::swap(left, right);  // the right one lies outside of a path that turns left
  const auto ring = std::make_shared<IfcArbitraryProfileDefWithVoids>();
  ring->m_InnerCurves.push_back(closed_polyline(left, unit_m));
  return area(ring, right, unit_m);
}

/// The other side of the profile's y axis. Null where the parent is none.
std::shared_ptr<IfcProfileDef> mirrored(const std::shared_ptr<IfcProfileDef>& parent,
                                        RepresentationConverter& converter, double unit_m) {
  std::vector<Outline> rings = parent ? rings_of(parent, converter) : std::vector<Outline>();
  const auto is_line = [](const Outline& ring) { return ring.size() < 3; };
  if (rings.empty() || std::ranges::any_of(rings, is_line)) return nullptr;
  for (Outline& ring : rings) {
    for (dvec2& corner : ring) corner.x = -corner.x;
    std::ranges::reverse(ring);
  }
  if (rings.size() == 1) return area(std::make_shared<IfcArbitraryClosedProfileDef>(), rings.front(), unit_m);
  const auto profile = std::make_shared<IfcArbitraryProfileDefWithVoids>();
  for (std::size_t i = 1; i < rings.size(); ++i)
    profile->m_InnerCurves.push_back(closed_polyline(rings[i], unit_m));
  return area(profile, rings.front(), unit_m);
}

}  // namespace

std::vector<Outline> rings_of(std::shared_ptr<IfcProfileDef> profile, RepresentationConverter& converter) {
  constexpr double same_m = 1e-6;
  std::vector<Outline> rings;
  const auto converted = converter.getProfileCache()->getProfileConverter(profile);
  if (!converted) return rings;
  for (const std::vector<vec2>& path : converted->getCoordinates()) {
    Outline& ring = rings.emplace_back();
    for (const vec2& point : path) ring.emplace_back(point.x, point.y);
    while (ring.size() > 1 && glm::distance(ring.front(), ring.back()) < same_m) ring.pop_back();
    double doubled_area = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      doubled_area += a.x * b.y - a.y * b.x;
    }
    if ((doubled_area > 0.0) != (rings.size() == 1)) std::ranges::reverse(ring);
  }
  return rings;
}

void replace_profiles(BuildingModel& building, RepresentationConverter& converter) {
  const double unit_m = building.getUnitConverter()->getLengthInMeterFactor();
  std::unordered_map<const BuildingEntity*, std::shared_ptr<IfcProfileDef>> plain_profiles;
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    std::shared_ptr<IfcProfileDef> profile;
    try {
      if (const auto* asymmetric = dynamic_cast<const IfcAsymmetricIShapeProfileDef*>(entity.get()))
        profile = plain(*asymmetric, converter, unit_m);
      else if (const auto* line = dynamic_cast<const IfcCenterLineProfileDef*>(entity.get()))
        profile = plain(*line, converter, unit_m);
    } catch (const std::exception&) {  // of IFC++: a curve that it cannot follow, which its own pass names
    }
    if (!profile) continue;
    profile->m_entity_id = id;
    plain_profiles.emplace(entity.get(), profile);
  }
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    const auto* mirror = dynamic_cast<const IfcMirroredProfileDef*>(entity.get());
    if (!mirror) continue;
    const auto plain_parent = plain_profiles.find(mirror->m_ParentProfile.get());
    try {
      const std::shared_ptr<IfcProfileDef> profile =
          mirrored(plain_parent == plain_profiles.end() ? mirror->m_ParentProfile : plain_parent->second,
                   converter, unit_m);
      if (!profile) continue;
      profile->m_entity_id = id;
      plain_profiles.emplace(entity.get(), profile);
    } catch (const std::exception&) {  // of IFC++, as above
    }
  }
  if (plain_profiles.empty()) return;
  const auto put_in = [&](std::shared_ptr<IfcProfileDef>& place) {
    if (const auto found = plain_profiles.find(place.get()); found != plain_profiles.end())
      place = found->second;
  };
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    if (auto* solid = dynamic_cast<IfcSweptAreaSolid*>(entity.get())) put_in(solid->m_SweptArea);
    if (auto* tapered = dynamic_cast<IfcExtrudedAreaSolidTapered*>(entity.get()))
      put_in(tapered->m_EndSweptArea);
    if (auto* derived = dynamic_cast<IfcDerivedProfileDef*>(entity.get())) put_in(derived->m_ParentProfile);
    if (auto* several = dynamic_cast<IfcCompositeProfileDef*>(entity.get()))
      std::ranges::for_each(several->m_Profiles, put_in);
    if (auto* spine = dynamic_cast<IfcSectionedSpine*>(entity.get()))
      std::ranges::for_each(spine->m_CrossSections, put_in);
  }
}

}  // namespace parvis::scene
