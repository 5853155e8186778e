#include "formats/ifc/ifc_splines.h"

#include <ifcpp/IFC4/include/IfcBSplineSurfaceWithKnots.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcInteger.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcParameterValue.h>
#include <ifcpp/IFC4/include/IfcRationalBSplineCurveWithKnots.h>
#include <ifcpp/IFC4/include/IfcRationalBSplineSurfaceWithKnots.h>
#include <ifcpp/IFC4/include/IfcReal.h>
#include <ifcpp/model/BuildingModel.h>
#include <ifcpp/model/UnitConverter.h>

#include <algorithm>
#include <cmath>

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3, glm::dvec4;

constexpr int max_degree = 30;

/// A control point times its weight; nothing where it has no two or three finite coordinates.
std::optional<dvec4> control_of(const std::shared_ptr<IfcCartesianPoint>& point, double weight,
                                double unit_m) {
  if (!point || point->m_Coordinates.size() < 2 || !(weight > 0.0) || !std::isfinite(weight))
    return std::nullopt;
  dvec3 place(0.0);
  for (std::size_t axis = 0; axis < std::min<std::size_t>(point->m_Coordinates.size(), 3); ++axis) {
    if (!point->m_Coordinates[axis] || !std::isfinite(point->m_Coordinates[axis]->m_value))
      return std::nullopt;
    place[int(axis)] = point->m_Coordinates[axis]->m_value * unit_m;
  }
  return dvec4(place * weight, weight);
}

/// The control points of a row; nothing where points or weights are missing.
std::optional<std::vector<dvec4>> controls_of(const std::vector<std::shared_ptr<IfcCartesianPoint>>& points,
                                              const std::vector<std::shared_ptr<IfcReal>>* weights,
                                              double unit_m) {
  if (weights && weights->size() != points.size()) return std::nullopt;
  std::vector<dvec4> controls;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (weights && !(*weights)[i]) return std::nullopt;
    const std::optional<dvec4> control =
        control_of(points[i], weights ? (*weights)[i]->m_value : 1.0, unit_m);
    if (!control) return std::nullopt;
    controls.push_back(*control);
  }
  return controls;
}

}  // namespace

std::optional<SplineBasis> SplineBasis::of(const std::shared_ptr<IfcInteger>& degree,
                                           const std::vector<std::shared_ptr<IfcInteger>>& multiplicities,
                                           const std::vector<std::shared_ptr<IfcParameterValue>>& knots,
                                           std::size_t controls) {
  if (!degree || degree->m_value < 1 || degree->m_value > max_degree || multiplicities.size() != knots.size())
    return std::nullopt;
  SplineBasis basis;
  basis.degree_ = std::size_t(degree->m_value);
  const std::size_t count = controls + basis.degree_ + 1;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!knots[i] || !multiplicities[i] || !std::isfinite(knots[i]->m_value)) return std::nullopt;
    const auto times = std::size_t(std::max(multiplicities[i]->m_value, 0));
    if (times > count - basis.knots_.size()) return std::nullopt;
    if (!basis.knots_.empty() && knots[i]->m_value < basis.knots_.back()) return std::nullopt;
    basis.knots_.insert(basis.knots_.end(), times, knots[i]->m_value);
  }
  if (controls <= basis.degree_ || basis.knots_.size() != count || !(basis.first() < basis.last()))
    return std::nullopt;
  return basis;
}

std::size_t SplineBasis::values_at(double parameter, std::vector<double>& values) const {
  const auto begin = knots_.begin() + std::ptrdiff_t(degree_), end = knots_.end() - std::ptrdiff_t(degree_);
  parameter = std::clamp(parameter, first(), last());
  auto above = std::upper_bound(begin, end, parameter);
  if (above == end) above = std::lower_bound(begin, end, last());  // its end belongs to the last piece
  const std::size_t span = std::size_t(above - knots_.begin()) - 1;
  values.assign(degree_ + 1, 0.0);
  values[0] = 1.0;
  for (std::size_t j = 1; j <= degree_; ++j) {
    double saved = 0.0;
    for (std::size_t r = 0; r < j; ++r) {
      const double low = knots_[span + 1 + r - j], high = knots_[span + 1 + r];
      const double part = values[r] / (high - low);
      values[r] = saved + (high - parameter) * part;
      saved = (parameter - low) * part;
    }
    values[j] = saved;
  }
  return span - degree_;
}

std::vector<double> SplineBasis::steps() const {
  constexpr std::size_t pieces_of_all = 96, max_pieces = 12, min_pieces = 2;
  std::vector<double> knots(knots_.begin() + std::ptrdiff_t(degree_), knots_.end() - std::ptrdiff_t(degree_));
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  const std::size_t pieces =
      degree_ == 1 ? 1 : std::clamp(pieces_of_all / (knots.size() - 1), min_pieces, max_pieces);
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i)
    for (std::size_t k = 0; k < pieces; ++k)
      steps.push_back(knots[i] + (knots[i + 1] - knots[i]) * double(k) / double(pieces));
  steps.push_back(knots.back());
  return steps;
}

std::optional<SplineCurve> SplineCurve::of(const IfcBSplineCurve& curve, double unit_m) {
  const auto* knots = dynamic_cast<const IfcBSplineCurveWithKnots*>(&curve);
  const auto* rational = dynamic_cast<const IfcRationalBSplineCurveWithKnots*>(&curve);
  auto controls =
      controls_of(curve.m_ControlPointsList, rational ? &rational->m_WeightsData : nullptr, unit_m);
  if (!knots || !controls) return std::nullopt;
  const auto basis =
      SplineBasis::of(curve.m_Degree, knots->m_KnotMultiplicities, knots->m_Knots, controls->size());
  if (!basis) return std::nullopt;
  return SplineCurve{*basis, *std::move(controls)};
}

dvec3 SplineCurve::point(double parameter) const {
  std::vector<double> values;
  const std::size_t first = basis.values_at(parameter, values);
  dvec4 sum(0.0);
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * controls[first + i];
  return dvec3(sum) / sum.w;
}

std::optional<SplineSurface> SplineSurface::of(const IfcBSplineSurface& surface, double unit_m) {
  const auto* knots = dynamic_cast<const IfcBSplineSurfaceWithKnots*>(&surface);
  const auto* rational = dynamic_cast<const IfcRationalBSplineSurfaceWithKnots*>(&surface);
  const auto& rows = surface.m_ControlPointsList;
  if (!knots || rows.empty() || (rational && rational->m_WeightsData.size() != rows.size()))
    return std::nullopt;
  std::vector<std::vector<dvec4>> controls;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto row = controls_of(rows[i], rational ? &rational->m_WeightsData[i] : nullptr, unit_m);
    if (!row || row->size() != rows.front().size()) return std::nullopt;
    controls.push_back(*std::move(row));
  }
  const auto u = SplineBasis::of(surface.m_UDegree, knots->m_UMultiplicities, knots->m_UKnots, rows.size()),
             v = SplineBasis::of(surface.m_VDegree, knots->m_VMultiplicities, knots->m_VKnots,
                                 rows.front().size());
  if (!u || !v) return std::nullopt;
  return SplineSurface{{*u, *v}, std::move(controls)};
}

dvec3 SplineSurface::point(dvec2 parameters) const {
  std::vector<double> along_u, along_v;
  const std::size_t u = bases[0].values_at(parameters.x, along_u),
                    v = bases[1].values_at(parameters.y, along_v);
  dvec4 sum(0.0);
  for (std::size_t i = 0; i < along_u.size(); ++i)
    for (std::size_t k = 0; k < along_v.size(); ++k) sum += along_u[i] * along_v[k] * controls[u + i][v + k];
  return dvec3(sum) / sum.w;
}

void straighten_splines(BuildingModel& building) {
  const double unit_m = building.getUnitConverter()->getLengthInMeterFactor();
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    auto* curve = dynamic_cast<IfcBSplineCurveWithKnots*>(entity.get());
    const std::optional<SplineCurve> spline = curve ? SplineCurve::of(*curve, unit_m) : std::nullopt;
    if (!spline) continue;
    curve->m_Degree = std::make_shared<IfcInteger>(1);
    curve->m_KnotMultiplicities.clear(), curve->m_Knots.clear();
    curve->m_ControlPointsList.clear();
    for (const double step : spline->basis.steps()) {
      const dvec3 at = spline->point(step) / unit_m;
      auto point = std::make_shared<IfcCartesianPoint>();
      for (int axis = 0; axis < 3; ++axis)
        point->m_Coordinates.push_back(std::make_shared<IfcLengthMeasure>(at[axis]));
      curve->m_ControlPointsList.push_back(std::move(point));
    }
    if (auto* rational = dynamic_cast<IfcRationalBSplineCurveWithKnots*>(curve))  // it takes those from 1 on
      rational->m_WeightsData.assign(curve->m_ControlPointsList.size() + 1, std::make_shared<IfcReal>(1.0));
  }
}

}  // namespace parvis::scene
