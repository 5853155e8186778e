// B-splines of IFC (NURBS), curves and surfaces. A part of the module ifcplusplus.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

class BuildingModel;
class IfcBSplineCurve;
class IfcBSplineSurface;
class IfcInteger;
class IfcParameterValue;

namespace parvis::scene {

/// The basis functions of a B-spline in one parameter (Piegl and Tiller, The NURBS Book, algorithm A2.2).
class SplineBasis {
 public:
  /// Nothing where the knots are none of a curve of so many control points.
  static std::optional<SplineBasis> of(const std::shared_ptr<IfcInteger>& degree,
                                       const std::vector<std::shared_ptr<IfcInteger>>& multiplicities,
                                       const std::vector<std::shared_ptr<IfcParameterValue>>& knots,
                                       std::size_t controls);

  double first() const { return knots_[degree_]; }                     ///< parameter at which it begins
  double last() const { return knots_[knots_.size() - degree_ - 1]; }  ///< and ends
  /// The values of the basis functions that are not 0 at a parameter, and the control point of the first.
  std::size_t values_at(double parameter, std::vector<double>& values) const;
  /// Parameters from first to last whose chords follow the curve: all knots, and steps between them.
  std::vector<double> steps() const;

 private:
  std::size_t degree_ = 0;
  std::vector<double> knots_;
};

/// A curve, metres.
struct SplineCurve {
  SplineBasis basis;
  std::vector<glm::dvec4> controls;  ///< times their weight, which is the last component

  /// Nothing where knots, weights or points are wrong.
  static std::optional<SplineCurve> of(const IfcBSplineCurve& curve, double unit_m);
  /// The point at a parameter, which is clamped to its ends.
  glm::dvec3 point(double parameter) const;
};

/// A surface, metres.
struct SplineSurface {
  std::array<SplineBasis, 2> bases;
  std::vector<std::vector<glm::dvec4>> controls;  ///< by u, then v

  /// Nothing where knots, weights or points are wrong.
  static std::optional<SplineSurface> of(const IfcBSplineSurface& surface, double unit_m);
  /// The point at two parameters, which are clamped to its ends.
  glm::dvec3 point(glm::dvec2 parameters) const;
};

/// Makes each B-spline curve one of degree 1 through its own points, as many as IFC++ then takes of it: by
/// itself it counts knots once too often and shifts weights, so that its curves run elsewhere. Curves whose
/// knots are wrong stay as they are.
void straighten_splines(BuildingModel& building);

}  // namespace parvis::scene
