#include "formats/ifc/ifc_arcs.h"

#include <ifcpp/IFC4/include/IfcAxis2Placement2D.h>
#include <ifcpp/IFC4/include/IfcAxis2Placement3D.h>
#include <ifcpp/IFC4/include/IfcBSplineCurve.h>
#include <ifcpp/IFC4/include/IfcBoolean.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcCircle.h>
#include <ifcpp/IFC4/include/IfcCompositeCurveSegment.h>
#include <ifcpp/IFC4/include/IfcDirection.h>
#include <ifcpp/IFC4/include/IfcEllipse.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcLine.h>
#include <ifcpp/IFC4/include/IfcParameterValue.h>
#include <ifcpp/IFC4/include/IfcPlaneAngleMeasure.h>
#include <ifcpp/IFC4/include/IfcPolyline.h>
#include <ifcpp/IFC4/include/IfcPositiveLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcReal.h>
#include <ifcpp/IFC4/include/IfcRevolvedAreaSolid.h>
#include <ifcpp/IFC4/include/IfcTrimmedCurve.h>
#include <ifcpp/IFC4/include/IfcVector.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>
#include <ifcpp/model/BuildingModel.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "formats/ifc/ifc_splines.h"

namespace parvis::scene {
namespace {

constexpr double whole_turn = 2.0 * std::numbers::pi, step_of_arc = std::numbers::pi / 24.0;

using Trims = std::vector<std::shared_ptr<IfcTrimmingSelect>>;

/// A circle or an ellipse in its own plane.
struct Conic {
  carve::math::Matrix world_from_conic = carve::math::Matrix::IDENT();
  glm::dvec2 radii{0.0};  // metres
};

std::optional<Conic> conic_of(const IfcCurve* curve, RepresentationConverter& converter, double unit_m) {
  Conic conic;
  if (const auto* circle = dynamic_cast<const IfcCircle*>(curve); circle && circle->m_Radius)
    conic.radii = glm::dvec2(circle->m_Radius->m_value * unit_m);
  else if (const auto* ellipse = dynamic_cast<const IfcEllipse*>(curve);
           ellipse && ellipse->m_SemiAxis1 && ellipse->m_SemiAxis2)
    conic.radii = unit_m * glm::dvec2(ellipse->m_SemiAxis1->m_value, ellipse->m_SemiAxis2->m_value);
  if (!(conic.radii.x > 0.0) || !(conic.radii.y > 0.0)) return std::nullopt;
  const std::shared_ptr<IfcAxis2Placement>& given = static_cast<const IfcConic*>(curve)->m_Position;
  std::shared_ptr<TransformData> placement;
  if (const auto plan = std::dynamic_pointer_cast<IfcAxis2Placement2D>(given))
    converter.getPlacementConverter()->convertIfcAxis2Placement2D(plan, placement);
  else if (const auto space = std::dynamic_pointer_cast<IfcAxis2Placement3D>(given))
    converter.getPlacementConverter()->convertIfcAxis2Placement3D(space, placement);
  if (placement) conic.world_from_conic = placement->m_matrix;
  return conic;
}

/// Where a place lies on a conic, radians.
double angle_of(glm::dvec3 place, const Conic& conic) {
  const carve::math::Matrix& m = conic.world_from_conic;
  place -= glm::dvec3(m.m[3][0], m.m[3][1], m.m[3][2]);
  const double x = glm::dot(place, glm::dvec3(m.m[0][0], m.m[0][1], m.m[0][2])),
               y = glm::dot(place, glm::dvec3(m.m[1][0], m.m[1][1], m.m[1][2]));
  return std::atan2(y / conic.radii.y, x / conic.radii.x);
}

glm::dvec3 place_at(double angle, const Conic& conic) {
  const vec3 at = conic.world_from_conic *
                  carve::geom::VECTOR(conic.radii.x * std::cos(angle), conic.radii.y * std::sin(angle), 0.0);
  return {at.x, at.y, at.z};
}

glm::dvec3 place_of(const IfcCartesianPoint& point, double unit_m) {
  glm::dvec3 place(0.0);
  for (std::size_t axis = 0; axis < std::min<std::size_t>(point.m_Coordinates.size(), 3); ++axis)
    if (point.m_Coordinates[axis]) place[int(axis)] = point.m_Coordinates[axis]->m_value * unit_m;
  return place;
}

/// Where a curve is trimmed: by a point, which says the same in any unit, else by a parameter.
struct Trim {
  std::optional<glm::dvec3> place;
  std::optional<double> parameter;
};

Trim trim_of(const Trims& given, double unit_m) {
  Trim trim;
  for (const auto& each : given) {
    if (const auto* point = dynamic_cast<const IfcCartesianPoint*>(each.get());
        point && point->m_Coordinates.size() >= 2)
      trim.place = place_of(*point, unit_m);
    if (const auto* parameter = dynamic_cast<const IfcParameterValue*>(each.get());
        parameter && std::isfinite(parameter->m_value))
      trim.parameter = parameter->m_value;
  }
  return trim;
}

/// Where a trim lies on a conic, radians.
std::optional<double> angle_of(const Trim& trim, const Conic& conic, double unit_rad) {
  if (trim.place) return angle_of(*trim.place, conic);
  return trim.parameter ? std::optional(*trim.parameter * unit_rad) : std::nullopt;
}

std::shared_ptr<IfcPolyline> polyline(const std::vector<vec3>& points, double unit_m) {
  auto line = std::make_shared<IfcPolyline>();
  for (const vec3& at : points) {
    auto point = std::make_shared<IfcCartesianPoint>();
    for (const double value : {at.x, at.y, at.z})
      point->m_Coordinates.push_back(std::make_shared<IfcLengthMeasure>(value / unit_m));
    line->m_Points.push_back(std::move(point));
  }
  return line;
}

/// The points of a trimmed conic, in the direction in which the curve runs; empty where it is none.
std::vector<vec3> arc_of(const IfcTrimmedCurve& curve, RepresentationConverter& converter, double unit_m,
                         double unit_rad) {
  const std::optional<Conic> conic = conic_of(curve.m_BasisCurve.get(), converter, unit_m);
  if (!conic) return {};
  const auto from = angle_of(trim_of(curve.m_Trim1, unit_m), *conic, unit_rad),
             to = angle_of(trim_of(curve.m_Trim2, unit_m), *conic, unit_rad);
  if (!from || !to || !std::isfinite(*from) || !std::isfinite(*to)) return {};
  const double sense = !curve.m_SenseAgreement || curve.m_SenseAgreement->m_value ? 1.0 : -1.0;
  double opening = std::fmod(sense * (*to - *from), whole_turn);
  if (opening <= 1e-9) opening += whole_turn;
  const int steps = std::max(2, int(std::ceil(opening / step_of_arc)));
  std::vector<vec3> points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = *from + sense * opening * i / steps;
    points.push_back(conic->world_from_conic * carve::geom::VECTOR(conic->radii.x * std::cos(angle),
                                                                   conic->radii.y * std::sin(angle), 0.0));
  }
  return points;
}

/// The two ends of a trimmed line; empty where `curve` trims none.
std::vector<vec3> piece_of_line(const IfcTrimmedCurve& curve, double unit_m) {
  const auto* line = dynamic_cast<const IfcLine*>(curve.m_BasisCurve.get());
  if (!line || !line->m_Pnt || !line->m_Dir || !line->m_Dir->m_Orientation || !line->m_Dir->m_Magnitude)
    return {};
  glm::dvec3 direction(0.0);
  const auto& ratios = line->m_Dir->m_Orientation->m_DirectionRatios;
  for (std::size_t axis = 0; axis < std::min<std::size_t>(ratios.size(), 3); ++axis)
    if (ratios[axis]) direction[int(axis)] = ratios[axis]->m_value;
  const double length = glm::length(direction);
  if (!(length > 0.0)) return {};
  direction *= line->m_Dir->m_Magnitude->m_value * unit_m / length;
  std::vector<vec3> ends;
  for (const Trims* given : {&curve.m_Trim1, &curve.m_Trim2}) {
    const Trim trim = trim_of(*given, unit_m);
    if (!trim.place && !trim.parameter) return {};
    const glm::dvec3 at =
        trim.place ? *trim.place : place_of(*line->m_Pnt, unit_m) + *trim.parameter * direction;
    ends.push_back(carve::geom::VECTOR(at.x, at.y, at.z));
  }
  return ends;
}

/// A curve as points with their parameters.
struct SampledCurve {
  std::vector<double> parameters;
  std::vector<glm::dvec3> points;

  /// Where it is nearest to a place.
  double nearest(glm::dvec3 place) const {
    double distance = std::numeric_limits<double>::infinity(), found = parameters.front();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const glm::dvec3 along = points[i + 1] - points[i];
      const double squared = glm::dot(along, along);
      const double t =
          squared > 0.0 ? std::clamp(glm::dot(place - points[i], along) / squared, 0.0, 1.0) : 0.0;
      if (const double d = glm::distance(place, points[i] + t * along); d < distance)
        distance = d, found = glm::mix(parameters[i], parameters[i + 1], t);
    }
    return found;
  }
  glm::dvec3 point(double parameter) const {
    const auto above = std::upper_bound(parameters.begin() + 1, parameters.end() - 1, parameter);
    const std::size_t i = std::size_t(above - parameters.begin()) - 1;
    const double t = (parameter - parameters[i]) / (parameters[i + 1] - parameters[i]);
    return glm::mix(points[i], points[i + 1], std::clamp(t, 0.0, 1.0));
  }
};

std::optional<SampledCurve> sampled(const IfcCurve* curve, double unit_m) {
  SampledCurve samples;
  if (const auto* spline = dynamic_cast<const IfcBSplineCurve*>(curve)) {
    const std::optional<SplineCurve> given = SplineCurve::of(*spline, unit_m);
    if (!given) return std::nullopt;
    samples.parameters = given->basis.steps();
    for (const double step : samples.parameters) samples.points.push_back(given->point(step));
  } else if (const auto* line = dynamic_cast<const IfcPolyline*>(curve)) {
    for (const auto& point : line->m_Points) {
      if (!point) return std::nullopt;
      samples.parameters.push_back(double(samples.points.size()));
      samples.points.push_back(place_of(*point, unit_m));
    }
  }
  return samples.points.size() < 2 ? std::nullopt : std::optional(samples);
}

/// The points of a trimmed B-spline or polyline, in the direction in which the curve runs; empty where it is
/// none.
std::vector<vec3> piece_of_samples(const IfcTrimmedCurve& curve, double unit_m) {
  const std::optional<SampledCurve> samples = sampled(curve.m_BasisCurve.get(), unit_m);
  if (!samples) return {};
  std::array<double, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Trim trim = trim_of(i == 0 ? curve.m_Trim1 : curve.m_Trim2, unit_m);
    if (!trim.place && !trim.parameter) return {};
    ends[i] = trim.parameter.value_or(0.0);
    if (trim.place) ends[i] = samples->nearest(*trim.place);
    ends[i] = std::clamp(ends[i], samples->parameters.front(), samples->parameters.back());
  }
  const bool is_forward = !curve.m_SenseAgreement || curve.m_SenseAgreement->m_value;
  if (!is_forward) std::swap(ends[0], ends[1]);
  std::vector<glm::dvec3> piece;
  const auto add = [&](double from, double to) {
    piece.push_back(samples->point(from));
    for (std::size_t i = 0; i < samples->points.size(); ++i)
      if (samples->parameters[i] > from && samples->parameters[i] < to) piece.push_back(samples->points[i]);
    piece.push_back(samples->point(to));
  };
  constexpr double same_m = 1e-6;
  if (ends[0] < ends[1]) {
    add(ends[0], ends[1]);
  } else if (glm::distance(samples->points.front(), samples->points.back()) < same_m) {  // over its seam
    add(ends[0], samples->parameters.back());
    piece.pop_back();
    add(samples->parameters.front(), ends[1]);
  } else {
    add(ends[1], ends[0]);
    std::ranges::reverse(piece);
  }
  if (!is_forward) std::ranges::reverse(piece);
  std::vector<vec3> points;
  for (const glm::dvec3& at : piece) points.push_back(carve::geom::VECTOR(at.x, at.y, at.z));
  return points;
}

}  // namespace

std::optional<std::vector<glm::dvec3>> arc_between(const IfcCurve& curve,
                                                   const std::array<glm::dvec3, 2>& ends, bool is_forward,
                                                   RepresentationConverter& converter, double unit_m) {
  const std::optional<Conic> conic = conic_of(&curve, converter, unit_m);
  if (!conic) return std::nullopt;
  const double from = angle_of(ends[0], *conic), sense = is_forward ? 1.0 : -1.0;
  double opening = std::fmod(sense * (angle_of(ends[1], *conic) - from), whole_turn);
  if (opening <= 1e-9) opening += whole_turn;
  const int steps = std::max(1, int(std::ceil(opening / step_of_arc - 1e-6)));
  std::vector<glm::dvec3> points;
  for (int i = 1; i < steps; ++i) points.push_back(place_at(from + sense * opening * i / steps, *conic));
  return points;
}

void settle_unit_of_angles(BuildingModel& building) {
  UnitConverter& units = *building.getUnitConverter();
  if (units.getAngularUnit() != UnitConverter::UNDEFINED) return;
  constexpr double rounding = 1e-3;
  const bool has_degrees = std::ranges::any_of(building.getMapIfcEntities(), [&](const auto& each) {
    const auto* solid = dynamic_cast<const IfcRevolvedAreaSolid*>(each.second.get());
    return solid && solid->m_Angle && std::abs(solid->m_Angle->m_value) > whole_turn + rounding;
  });
  units.setAngleUnit(has_degrees ? UnitConverter::DEGREE : UnitConverter::RADIANT);
}

void replace_trimmed_curves(BuildingModel& building, RepresentationConverter& converter) {
  UnitConverter& units = *building.getUnitConverter();
  const double unit_m = units.getLengthInMeterFactor();
  const double unit_rad = units.getAngleInRadiantFactor();
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    auto* trimmed = dynamic_cast<IfcTrimmedCurve*>(entity.get());
    if (!trimmed) continue;
    std::vector<vec3> points;
    try {
      points = arc_of(*trimmed, converter, unit_m, unit_rad);
      if (points.empty()) points = piece_of_line(*trimmed, unit_m);
      if (points.empty()) points = piece_of_samples(*trimmed, unit_m);
    } catch (const std::exception&) {  // of IFC++: a placement that it cannot follow
    }
    if (points.empty()) continue;
    trimmed->m_BasisCurve = polyline(points, unit_m);
    trimmed->m_Trim1.clear(), trimmed->m_Trim2.clear();
    trimmed->m_SenseAgreement = std::make_shared<IfcBoolean>(true);
  }
  straighten_splines(building);
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    auto* segment = dynamic_cast<IfcCompositeCurveSegment*>(entity.get());
    if (!segment || !segment->m_ParentCurve || !segment->m_SameSense || segment->m_SameSense->m_value)
      continue;
    std::vector<vec3> points, starts;
    try {
      converter.getCurveConverter()->convertIfcCurve(segment->m_ParentCurve, points, starts);
    } catch (const std::exception&) {  // a curve that IFC++ cannot follow, which its own pass names
      continue;
    }
    std::ranges::reverse(points);
    segment->m_ParentCurve = polyline(points, unit_m);
    segment->m_SameSense = std::make_shared<IfcBoolean>(true);
  }
}

}  // namespace parvis::scene
