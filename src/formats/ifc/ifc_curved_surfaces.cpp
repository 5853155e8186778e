#include "formats/ifc/ifc_curved_surfaces.h"

#include <ifcpp/IFC4/include/IfcArbitraryClosedProfileDef.h>
#include <ifcpp/IFC4/include/IfcArbitraryOpenProfileDef.h>
#include <ifcpp/IFC4/include/IfcAxis1Placement.h>
#include <ifcpp/IFC4/include/IfcAxis2Placement3D.h>
#include <ifcpp/IFC4/include/IfcBSplineSurface.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcCylindricalSurface.h>
#include <ifcpp/IFC4/include/IfcDirection.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcPositiveLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcReal.h>
#include <ifcpp/IFC4/include/IfcSphericalSurface.h>
#include <ifcpp/IFC4/include/IfcSurfaceOfLinearExtrusion.h>
#include <ifcpp/IFC4/include/IfcSurfaceOfRevolution.h>
#include <ifcpp/IFC4/include/IfcToroidalSurface.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "formats/ifc/ifc_splines.h"

namespace parvis::scene {
namespace {

using glm::dmat4x3, glm::dvec2, glm::dvec3;

constexpr double full_turn = 2.0 * std::numbers::pi, quarter_turn = 0.5 * std::numbers::pi;
constexpr double chord_angle = std::numbers::pi / 24.0, no_length_m = 1e-9;

dmat4x3 frame_of(const std::shared_ptr<IfcAxis2Placement3D>& placement, RepresentationConverter& converter) {
  dmat4x3 frame(dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(0.0));
  std::shared_ptr<TransformData> position;
  if (placement) converter.getPlacementConverter()->convertIfcAxis2Placement3D(placement, position);
  if (!position) return frame;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) frame[column][row] = position->m_matrix.m[column][row];
  return frame;
}

dvec3 in_frame(const dmat4x3& frame, dvec3 point) {
  const dvec3 from = point - frame[3];
  return {glm::dot(from, frame[0]), glm::dot(from, frame[1]), glm::dot(from, frame[2])};
}

/// A curve in a plane turned about the third axis of a frame: u is the angle. Points of the curve are
/// distances from the axis and heights along it, by v.
class Revolved : public CurvedSurface {
 public:
  using Curve = std::function<dvec2(double)>;
  using Place = std::function<double(dvec2)>;
  Revolved(const dmat4x3& frame, Curve curve, Place place)
      : frame_(frame), curve_(std::move(curve)), place_(std::move(place)) {
    along[0] = {full_turn, chord_angle, {}};
  }
  dvec3 point(dvec2 at) const override {
    const dvec2 place = curve_(at.y);
    return frame_ * glm::dvec4(place.x * std::cos(at.x), place.x * std::sin(at.x), place.y, 1.0);
  }
  dvec2 parameters(dvec3 point) const override {
    const dvec3 at = in_frame(frame_, point);
    return {std::atan2(at.y, at.x), place_({glm::length(dvec2(at)), at.z})};
  }

 private:
  dmat4x3 frame_;
  Curve curve_;
  Place place_;
};

/// Where along a line of points, by their number, it is nearest to a place; its first and last piece go on
/// where it is open.
template <class Point>
double nearest_on(const std::vector<Point>& line, const Point& place, bool is_closed) {
  double nearest = std::numeric_limits<double>::infinity(), found = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point along = line[i + 1] - line[i];
    const double squared = glm::dot(along, along);
    if (!(squared > 0.0)) continue;
    double t = glm::dot(place - line[i], along) / squared;
    if (is_closed || i > 0) t = std::max(t, 0.0);
    if (is_closed || i + 2 < line.size()) t = std::min(t, 1.0);
    const Point off = place - line[i] - t * along;
    if (glm::dot(off, off) < nearest) nearest = glm::dot(off, off), found = double(i) + t;
  }
  return found;
}

/// The point at a number of `nearest_on`, which a closed line takes beyond its ends, too: it comes round.
template <class Point>
Point on_line(const std::vector<Point>& line, double at, bool is_closed) {
  if (const double around = double(line.size() - 1); is_closed && (at < 0.0 || at > around))
    at -= around * std::floor(at / around);
  const double i = std::clamp(std::floor(at), 0.0, double(line.size()) - 2.0);
  return glm::mix(line[std::size_t(i)], line[std::size_t(i) + 1], at - i);
}

template <class Point>
SurfaceParameter along_line(const std::vector<Point>& line, bool is_closed) {
  SurfaceParameter parameter{is_closed ? double(line.size() - 1) : 0.0, 0.0, {}};
  for (std::size_t i = 0; i < line.size() - (is_closed ? 1 : 0); ++i) parameter.lines.push_back(double(i));
  return parameter;
}

template <class Point>
bool is_ring(const std::vector<Point>& line) {
  return line.size() > 3 && glm::distance(line.front(), line.back()) < 1e-6;
}

/// The points of the curve that a surface sweeps, as they lie in the file; empty where there is none.
std::vector<dvec3> swept_curve(const IfcSweptSurface& surface, RepresentationConverter& converter) {
  std::shared_ptr<IfcCurve> curve;
  if (const auto* open = dynamic_cast<const IfcArbitraryOpenProfileDef*>(surface.m_SweptCurve.get()))
    curve = open->m_Curve;
  else if (const auto* ring = dynamic_cast<const IfcArbitraryClosedProfileDef*>(surface.m_SweptCurve.get()))
    curve = ring->m_OuterCurve;
  if (!curve) return {};
  std::vector<vec3> points, starts;
  converter.getCurveConverter()->convertIfcCurve(curve, points, starts);
  std::vector<dvec3> line;
  for (const vec3& point : points)
    if (const dvec3 at(point.x, point.y, point.z);
        line.empty() || glm::distance(line.back(), at) > no_length_m)
      line.push_back(at);
  if (dynamic_cast<const IfcConic*>(curve.get()) && line.size() > 2 && !is_ring(line))
    line.push_back(line.front());
  const dmat4x3 frame = frame_of(surface.m_Position, converter);
  for (dvec3& point : line) point = frame * glm::dvec4(point, 1.0);
  return line.size() < 2 ? std::vector<dvec3>() : line;
}

dvec3 direction_of(const std::shared_ptr<IfcDirection>& given) {
  dvec3 direction(0.0);
  for (std::size_t axis = 0; given && axis < std::min<std::size_t>(given->m_DirectionRatios.size(), 3);
       ++axis)
    if (given->m_DirectionRatios[axis]) direction[int(axis)] = given->m_DirectionRatios[axis]->m_value;
  const double length = glm::length(direction);
  return length > 0.0 && std::isfinite(length) ? direction / length : dvec3(0.0, 0.0, 1.0);
}

std::unique_ptr<CurvedSurface> revolved(const IfcSurfaceOfRevolution& surface,
                                        RepresentationConverter& converter, double unit_m) {
  const std::vector<dvec3> line = swept_curve(surface, converter);
  const std::shared_ptr<IfcAxis1Placement>& axis = surface.m_AxisPosition;
  if (line.empty() || !axis) return nullptr;
  dvec3 origin(0.0);
  if (axis->m_Location)
    for (std::size_t i = 0; i < std::min<std::size_t>(axis->m_Location->m_Coordinates.size(), 3); ++i)
      if (axis->m_Location->m_Coordinates[i])
        origin[int(i)] = axis->m_Location->m_Coordinates[i]->m_value * unit_m;
  const dmat4x3 position = frame_of(surface.m_Position, converter);
  const dvec3 z = glm::dmat3(position) * direction_of(axis->m_Axis);
  origin = position * glm::dvec4(origin, 1.0);
  const auto off_axis = [&](dvec3 point) { return point - origin - glm::dot(point - origin, z) * z; };
  const dvec3 farthest = off_axis(
      *std::ranges::max_element(line, {}, [&](dvec3 point) { return glm::length(off_axis(point)); }));
  if (!(glm::length(farthest) > no_length_m)) return nullptr;
  const dvec3 x = glm::normalize(farthest);
  std::vector<dvec2> curve;
  for (const dvec3& point : line)
    curve.emplace_back(glm::dot(point - origin, x), glm::dot(point - origin, z));
  const bool is_closed = is_ring(curve);
  auto made = std::make_unique<Revolved>(
      dmat4x3(x, glm::cross(z, x), z, origin),
      [curve, is_closed](double v) { return on_line(curve, v, is_closed); },
      [curve, is_closed](dvec2 place) { return nearest_on(curve, place, is_closed); });
  made->along[1] = along_line(curve, is_closed);
  constexpr double on_axis_m = 1e-6;
  if (std::abs(curve.front().x) < on_axis_m) made->poles[0] = 0.0;
  if (std::abs(curve.back().x) < on_axis_m) made->poles[1] = double(curve.size() - 1);
  return made;
}

/// A line that moves along a direction: u is where along the line, v metres.
class Extruded : public CurvedSurface {
 public:
  Extruded(std::vector<dvec3> line, dvec3 direction) : line_(std::move(line)), direction_(direction) {
    for (const dvec3& point : line_) flat_.push_back(flattened(point));
    along[0] = along_line(line_, is_ring(line_));
  }
  dvec3 point(dvec2 at) const override { return on_line(line_, at.x, is_closed()) + at.y * direction_; }
  dvec2 parameters(dvec3 point) const override {
    const double u = nearest_on(flat_, flattened(point), is_closed());
    return {u, glm::dot(point - on_line(line_, u, is_closed()), direction_)};
  }

 private:
  bool is_closed() const { return along[0].period > 0.0; }
  dvec3 flattened(dvec3 point) const { return point - glm::dot(point, direction_) * direction_; }

  std::vector<dvec3> line_, flat_;
  dvec3 direction_;
};

/// A B-spline whose parameters run from 0 to 1.
class Spline : public CurvedSurface {
 public:
  explicit Spline(SplineSurface surface) : surface_(std::move(surface)) {
    same = 1e-5;
    for (int axis = 0; axis < 2; ++axis) {
      const SplineBasis& basis = surface_.bases[std::size_t(axis)];
      first_[axis] = basis.first(), size_[axis] = basis.last() - basis.first();
      for (const double step : basis.steps())
        along[std::size_t(axis)].lines.push_back((step - first_[axis]) / size_[axis]);
    }
    for (const double u : along[0].lines)
      for (const double v : along[1].lines) samples_.push_back({{u, v}, point({u, v})});
    for (int axis = 0; axis < 2; ++axis)
      if (is_closed(axis)) along[std::size_t(axis)].period = 1.0, along[std::size_t(axis)].lines.pop_back();
    poles = poles_of(1);
  }
  dvec3 point(dvec2 at) const override {
    for (int axis = 0; axis < 2; ++axis)
      if (along[std::size_t(axis)].period > 0.0 && (at[axis] < 0.0 || at[axis] > 1.0))
        at[axis] -= std::floor(at[axis]);
    return surface_.point(first_ + size_ * at);  // which keeps to its ends
  }
  dvec2 parameters(dvec3 place) const override {
    constexpr int max_rounds = 30;
    dvec2 at = std::ranges::min_element(samples_, {}, [&](const Sample& sample) {
                 return glm::distance(sample.point, place);
               })->at;
    for (int i = 0; i < max_rounds; ++i) {  // Gauss and Newton
      const dvec3 off = place - point(at), by_u = derivative(at, {1, 0}), by_v = derivative(at, {0, 1});
      const double uu = glm::dot(by_u, by_u), uv = glm::dot(by_u, by_v), vv = glm::dot(by_v, by_v);
      const double u = glm::dot(by_u, off), v = glm::dot(by_v, off), area = uu * vv - uv * uv;
      if (!(area > 1e-12 * uu * vv)) break;  // at a pole
      const dvec2 step = dvec2(vv * u - uv * v, uu * v - uv * u) / area;
      if (!std::isfinite(step.x + step.y)) break;
      dvec2 next = at + step;
      for (int axis = 0; axis < 2; ++axis)
        next[axis] = along[std::size_t(axis)].period > 0.0 ? next[axis] - std::floor(next[axis])
                                                           : std::clamp(next[axis], 0.0, 1.0);
      const double moved = glm::distance(next, at);
      at = next;
      if (moved < 1e-12) break;
    }
    for (int axis = 0; axis < 2; ++axis)
      if (std::abs(at[axis] - std::round(at[axis])) < same) at[axis] = std::round(at[axis]);
    return at;
  }
  /// The lowest and highest values of a parameter, as far as the surface is one point there; else NaN.
  std::array<double, 2> poles_of(int axis) const {
    const auto pole = [&](double value) {
      const bool is_one = std::ranges::all_of(samples_, [&](const Sample& sample) {
        dvec2 here = sample.at, middle(0.5);
        here[axis] = middle[axis] = value;
        return glm::distance(point(here), point(middle)) < same_place_m;
      });
      return is_one ? value : std::numeric_limits<double>::quiet_NaN();
    };
    return {pole(0.0), pole(1.0)};
  }

 private:
  static constexpr double same_place_m = 1e-6;
  struct Sample {
    dvec2 at;
    dvec3 point;
  };

  dvec3 derivative(dvec2 at, dvec2 axis) const {
    constexpr double step = 1e-6;
    dvec2 before = at - step * axis, after = at + step * axis;
    for (int i = 0; i < 2; ++i)
      if (!(along[std::size_t(i)].period > 0.0))
        before[i] = std::max(before[i], 0.0), after[i] = std::min(after[i], 1.0);
    return (point(after) - point(before)) / glm::dot(after - before, axis);
  }
  /// Does the surface begin where it ends?
  bool is_closed(int axis) const {
    return std::ranges::all_of(samples_, [&](const Sample& sample) {
      dvec2 low = sample.at, high = low;
      low[axis] = 0.0, high[axis] = 1.0;
      return glm::distance(point(low), point(high)) < same_place_m;
    });
  }

  SplineSurface surface_;
  dvec2 first_{0.0}, size_{1.0};
  std::vector<Sample> samples_;
};

/// The same surface with its parameters exchanged.
class Exchanged : public CurvedSurface {
 public:
  explicit Exchanged(std::unique_ptr<CurvedSurface> surface) : surface_(std::move(surface)) {
    along = {surface_->along[1], surface_->along[0]};
    same = surface_->same;
    is_seen_from_behind = !surface_->is_seen_from_behind;
  }
  dvec3 point(dvec2 at) const override { return surface_->point({at.y, at.x}); }
  dvec2 parameters(dvec3 point) const override {
    const dvec2 at = surface_->parameters(point);
    return {at.y, at.x};
  }

 private:
  std::unique_ptr<CurvedSurface> surface_;
};

/// A side of a face in the plane of parameters, from the lesser u to the greater one.
struct Side {
  dvec2 from, to;
  bool has_face_above = false;  ///< else below
};

/// The corners of a ring as it runs on the surface, over its seams; the last one is the first again. At a
/// pole the ring runs along the line that the pole is in the plane of parameters.
std::vector<dvec2> unrolled(const Ring& ring, const CurvedSurface& surface, bool has_face_to_the_left) {
  constexpr double at_pole_m = 1e-6, at_pole_of_reach = 2e-6;  // files give directions to six digits
  const auto pole_at = [&](double v) {                         // 1: highest, -1: lowest
    if (std::abs(v - surface.poles[1]) < surface.same) return 1;
    return std::abs(v - surface.poles[0]) < surface.same ? -1 : 0;
  };
  std::vector<dvec2> places;
  for (const dvec3& corner : ring) places.push_back(surface.parameters(corner));
  for (const double pole : surface.poles) {
    if (!std::isfinite(pole)) continue;
    const dvec3 place = surface.point({0.0, pole});
    double reach = 0.0;
    for (const dvec3& corner : ring) reach = std::max(reach, glm::distance(corner, place));
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (glm::distance(ring[i], place) < at_pole_m + at_pole_of_reach * reach) places[i].y = pole;
  }
  const auto start = std::ranges::find_if(places, [&](dvec2 at) { return pole_at(at.y) == 0; });
  if (start == places.end()) return {};
  std::ranges::rotate(places, start);
  places.push_back(places.front());
  std::vector<dvec2> line{places.front()};
  const double around = surface.along[0].period;
  for (std::size_t i = 1; i < places.size(); ++i) {
    dvec2 next = places[i];
    const dvec2 last = line.back();
    if (pole_at(next.y) != 0) {
      line.emplace_back(last.x, next.y);
      continue;
    }
    if (const int pole = pole_at(last.y); pole != 0 && around > 0.0) {
      // Along a pole the face lies on its inner side, which says in which direction the ring runs.
      const double sense = (pole > 0) == has_face_to_the_left ? -1.0 : 1.0;
      double turn = std::fmod(sense * (next.x - last.x), around);
      if (turn < -surface.same) turn += around;
      next.x = last.x + sense * turn;
    }
    for (int axis = 0; axis < 2; ++axis)
      if (const double period = surface.along[std::size_t(axis)].period;
          period > 0.0 && (axis == 1 || pole_at(last.y) == 0))
        next[axis] = last[axis] + std::remainder(next[axis] - last[axis], period);
    if (pole_at(last.y) != 0) line.emplace_back(next.x, last.y);
    line.push_back(next);
  }
  return line;
}

/// Shifts lines by whole periods of v to where the one that reaches farthest begins: a hole may lie on the
/// other side of the seam.
void bring_together(std::vector<std::vector<dvec2>>& lines, double period) {
  const auto range_of = [](const std::vector<dvec2>& line) {
    const auto [low, high] = std::ranges::minmax(line, {}, &dvec2::y);
    return dvec2(low.y, high.y);
  };
  dvec2 farthest(0.0, -1.0);
  for (const std::vector<dvec2>& line : lines)
    if (const dvec2 range = range_of(line); range.y - range.x > farthest.y - farthest.x) farthest = range;
  for (std::vector<dvec2>& line : lines) {
    const dvec2 range = range_of(line);
    const double turn = period * std::ceil((farthest.x - 0.5 * (range.x + range.y)) / period);
    for (dvec2& place : line) place.y += turn;
  }
}

/// Heights at which a side crosses the beginning and the end of a strip; nothing where it does not.
std::optional<dvec2> crossing(const Side& side, dvec2 strip_ends, double period) {
  const double middle = 0.5 * (strip_ends.x + strip_ends.y);
  const double turn = period > 0.0 ? period * std::ceil((side.from.x - middle) / period) : 0.0;
  if (middle + turn < side.from.x || middle + turn > side.to.x) return std::nullopt;
  const auto at = [&](double u) {
    return glm::mix(side.from.y, side.to.y, (u + turn - side.from.x) / (side.to.x - side.from.x));
  };
  return dvec2(at(strip_ends.x), at(strip_ends.y));
}

struct Crossing {
  dvec2 heights;
  bool has_face_above = false;
};

/// The crossings of a strip in pairs, lower and upper; poles, and the seam of a ring, close open ones.
std::vector<Crossing> paired(std::vector<Crossing> crossings, const CurvedSurface& surface) {
  std::ranges::sort(crossings, {}, [](const Crossing& at) { return at.heights.x + at.heights.y; });
  const double around = surface.along[1].period;
  if (!crossings.empty() && !crossings.front().has_face_above) {
    if (around > 0.0) {
      std::ranges::rotate(crossings, crossings.begin() + 1);
      crossings.back().heights += around;
    } else if (std::isfinite(surface.poles[0])) {
      crossings.insert(crossings.begin(), {dvec2(surface.poles[0]), true});
    }
  }
  if (!crossings.empty() && crossings.back().has_face_above && std::isfinite(surface.poles[1]))
    crossings.push_back({dvec2(surface.poles[1]), false});
  return crossings;
}

/// Values strictly between two of a parameter at which a face is divided.
std::vector<double> divisions(const SurfaceParameter& parameter, double from, double to, double same) {
  std::vector<double> values;
  const auto add = [&](double value) {
    if (value > from + same && value < to - same) values.push_back(value);
  };
  if (parameter.lines.empty()) {
    for (double k = std::floor(from / parameter.step) + 1.0; k * parameter.step < to; ++k)
      add(k * parameter.step);
    return values;
  }
  const double period = parameter.period;
  double turn = period > 0.0 ? period * std::floor((from - parameter.lines.front()) / period) : 0.0;
  do {
    for (const double line : parameter.lines) add(line + turn);
    turn += period;
  } while (period > 0.0 && parameter.lines.front() + turn < to);
  return values;
}

/// Appends what lies between two lines of corners, each rising, the second to the right of the first.
void add_between(const std::vector<double>& left_heights, const std::vector<double>& right_heights,
                 dvec2 ends, const CurvedSurface& surface, bool is_front, Faces& faces) {
  const auto add = [&](dvec3 a, dvec3 b, dvec3 c) {
    if (glm::distance(a, b) < no_length_m || glm::distance(b, c) < no_length_m ||
        glm::distance(c, a) < no_length_m)
      return;
    faces.push_back({is_front ? Ring{a, b, c} : Ring{c, b, a}});
  };
  const auto line_of = [&](const std::vector<double>& heights, double u) {
    Ring line;
    for (const double v : heights) line.push_back(surface.point({u, v}));
    return line;
  };
  const Ring left = line_of(left_heights, ends.x), right = line_of(right_heights, ends.y);
  for (std::size_t i = 0, k = 0; i + 1 < left.size() || k + 1 < right.size();) {
    const bool goes_left =
        k + 1 == right.size() || (i + 1 < left.size() && left_heights[i + 1] < right_heights[k + 1]);
    add(left[i], right[k], goes_left ? left[i + 1] : right[k + 1]);
    goes_left ? ++i : ++k;
  }
}

/// The part of a strip between two crossings.
void add_strip(dvec2 ends, const Crossing& low, const Crossing& high, const CurvedSurface& surface,
               bool is_front, Faces& faces) {
  std::vector<double> columns{ends.x};
  if (surface.along[0].lines.empty()) {
    const int pieces = std::max(1, int(std::ceil((ends.y - ends.x) / surface.along[0].step - 1e-6)));
    for (int i = 1; i < pieces; ++i) columns.push_back(glm::mix(ends.x, ends.y, double(i) / pieces));
  } else {
    const std::vector<double> lines = divisions(surface.along[0], ends.x, ends.y, surface.same);
    columns.insert(columns.end(), lines.begin(), lines.end());
  }
  columns.push_back(ends.y);
  const auto heights_at = [&](double u) {
    const double t = (u - ends.x) / (ends.y - ends.x);
    const double from = glm::mix(low.heights.x, low.heights.y, t),
                 to = glm::mix(high.heights.x, high.heights.y, t);
    std::vector<double> heights = divisions(surface.along[1], from, to, surface.same);
    heights.insert(heights.begin(), from);
    heights.push_back(to);
    return heights;
  };
  std::vector<double> left = heights_at(columns.front());
  for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
    std::vector<double> right = heights_at(columns[i + 1]);
    add_between(left, right, {columns[i], columns[i + 1]}, surface, is_front, faces);
    left = std::move(right);
  }
}

}  // namespace

std::unique_ptr<CurvedSurface> curved_surface(const IfcSurface& surface, RepresentationConverter& converter,
                                              double unit_m) {
  if (const auto* cylinder = dynamic_cast<const IfcCylindricalSurface*>(&surface)) {
    const double radius = metres_of(cylinder->m_Radius, unit_m);
    if (!(radius > 0.0)) return nullptr;
    return std::make_unique<Revolved>(
        frame_of(cylinder->m_Position, converter), [radius](double v) { return dvec2(radius, v); },
        [](dvec2 place) { return place.y; });
  }
  if (const auto* sphere = dynamic_cast<const IfcSphericalSurface*>(&surface)) {
    const double radius = metres_of(sphere->m_Radius, unit_m);
    if (!(radius > 0.0)) return nullptr;
    auto made = std::make_unique<Revolved>(
        frame_of(sphere->m_Position, converter),
        [radius](double v) { return radius * dvec2(std::cos(v), std::sin(v)); },
        [](dvec2 place) { return std::atan2(place.y, place.x); });
    made->along[1].step = chord_angle;
    made->poles = {-quarter_turn, quarter_turn};
    return made;
  }
  if (const auto* torus = dynamic_cast<const IfcToroidalSurface*>(&surface)) {
    const double major = metres_of(torus->m_MajorRadius, unit_m),
                 minor = metres_of(torus->m_MinorRadius, unit_m);
    if (!(minor > 0.0) || !(major >= minor)) return nullptr;
    auto made = std::make_unique<Revolved>(
        frame_of(torus->m_Position, converter),
        [=](double v) { return dvec2(major + minor * std::cos(v), minor * std::sin(v)); },
        [=](dvec2 place) { return std::atan2(place.y, place.x - major); });
    made->along[1] = {full_turn, chord_angle, {}};
    return made;
  }
  if (const auto* turned = dynamic_cast<const IfcSurfaceOfRevolution*>(&surface))
    return revolved(*turned, converter, unit_m);
  if (const auto* extruded = dynamic_cast<const IfcSurfaceOfLinearExtrusion*>(&surface)) {
    std::vector<dvec3> line = swept_curve(*extruded, converter);
    if (line.empty()) return nullptr;
    const dmat4x3 position = frame_of(extruded->m_Position, converter);
    return std::make_unique<Extruded>(std::move(line),
                                      glm::dmat3(position) * direction_of(extruded->m_ExtrudedDirection));
  }
  const auto* spline = dynamic_cast<const IfcBSplineSurface*>(&surface);
  std::optional<SplineSurface> given = spline ? SplineSurface::of(*spline, unit_m) : std::nullopt;
  if (!given) return nullptr;
  auto made = std::make_unique<Spline>(*std::move(given));
  const auto has_pole = [](const std::array<double, 2>& poles) {
    return std::isfinite(poles[0]) || std::isfinite(poles[1]);
  };
  const std::array<double, 2> poles_in_u = made->poles_of(0);
  if (has_pole(made->poles) || !has_pole(poles_in_u)) return made;
  auto exchanged = std::make_unique<Exchanged>(std::move(made));
  exchanged->poles = poles_in_u;
  return exchanged;
}

void add_curved_face(const std::vector<Ring>& rings, std::unique_ptr<CurvedSurface> surface,
                     bool has_its_front, Faces& faces) {
  const auto lines_on = [&](const CurvedSurface& on) {
    std::vector<std::vector<dvec2>> lines;
    for (const Ring& ring : rings)
      if (auto line = unrolled(ring, on, has_its_front != on.is_seen_from_behind); line.size() > 1)
        lines.push_back(std::move(line));
    return lines;
  };
  std::vector<std::vector<dvec2>> lines = lines_on(*surface);
  const auto winds = [&](int axis) {
    return std::ranges::any_of(lines, [&](const std::vector<dvec2>& line) {
      return std::abs(line.back()[axis] - line.front()[axis]) > surface->same;
    });
  };
  if (winds(1) && !winds(0)) {
    surface = std::make_unique<Exchanged>(std::move(surface));
    lines = lines_on(*surface);
  }
  if (const double period = surface->along[1].period; period > 0.0) bring_together(lines, period);
  const bool is_front = has_its_front != surface->is_seen_from_behind;
  const double around = surface->along[0].period, same = surface->same;
  std::vector<Side> sides;
  std::vector<double> ends;
  for (const std::vector<dvec2>& line : lines)
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const dvec2 a = line[i], b = line[i + 1];
      if (std::abs(b.x - a.x) < same) continue;  // between two strips
      sides.push_back(a.x < b.x ? Side{a, b, is_front} : Side{b, a, !is_front});
      for (const double u : {a.x, b.x})
        ends.push_back(around > 0.0 ? u - around * std::floor(u / around) : u);
    }
  const bool has_both_poles = std::isfinite(surface->poles[0]) && std::isfinite(surface->poles[1]);
  if (sides.empty()) {
    if (has_both_poles)
      add_strip({0.0, around > 0.0 ? around : 1.0}, {dvec2(surface->poles[0]), true},
                {dvec2(surface->poles[1]), false}, *surface, is_front, faces);
    return;
  }
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end(), [&](double a, double b) { return b - a < same; }),
             ends.end());
  if (around > 0.0) ends.push_back(ends.front() + around);
  std::vector<std::pair<dvec2, std::vector<Crossing>>> strips;
  bool has_lowest_pole = false;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const dvec2 between(ends[i], ends[i + 1]);
    if (between.y - between.x < same) continue;
    std::vector<Crossing> crossings;
    for (const Side& side : sides)
      if (const std::optional<dvec2> heights = crossing(side, between, around))
        crossings.push_back({*heights, side.has_face_above});
    crossings = paired(std::move(crossings), *surface);
    has_lowest_pole |= !crossings.empty() && crossings.front().heights == dvec2(surface->poles[0]);
    strips.emplace_back(between, std::move(crossings));
  }
  for (auto& [between, crossings] : strips) {
    if (crossings.empty() && has_lowest_pole && has_both_poles)
      crossings = {{dvec2(surface->poles[0]), true}, {dvec2(surface->poles[1]), false}};
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      add_strip(between, crossings[k], crossings[k + 1], *surface, is_front, faces);
  }
}

}  // namespace parvis::scene
