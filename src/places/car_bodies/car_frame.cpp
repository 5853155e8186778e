#include "places/car_bodies/car_frame.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "places/car_bodies/sampling_limit.h"
#include "places/car_bodies/side_view.h"
#include "places/car_bodies/wheel_arches.h"

namespace parvis::car_bodies {
namespace {

constexpr int x_axis = 0, y_axis = 1, z_axis = 2;

/// Sizes of cars, vans and buses over everything, metres.
constexpr float min_length_m = 2.5f, max_length_m = 20.0f, usual_length_m = 4.4f;
constexpr float min_width_m = 1.0f, max_width_m = 3.3f;  // from microcars to buses with mirrors
constexpr float min_height_m = 0.8f, max_height_m = 4.6f;

constexpr float min_flatness = 0.05f;  // height or width over length: less is no car
constexpr float clear_margin = 0.1f;   // of likeness by which another axis must win over the usual one

struct Unit {
  const char* name;
  float metres;
};
constexpr Unit units[] = {
    {"millimetres", 0.001f}, {"centimetres", 0.01f}, {"inches", 0.0254f}, {"feet", 0.3048f}};

/// Cells of the body's box that its surface passes through.
class Cells {
 public:
  explicit Cells(const Body& body) {
    constexpr float along_longest = 48.0f, points_per_cell = 2.0f;
    const Bounds& bounds = body.bounds();
    const glm::vec3 box = bounds.size();
    const float cell = std::max({box.x, box.y, box.z}) / along_longest;
    size_ = glm::max(glm::ivec3(glm::ceil(box / cell)), glm::ivec3(1));
    is_taken_.assign(std::size_t(size_.x) * std::size_t(size_.y) * std::size_t(size_.z), false);
    for (std::size_t part = 0; part < body.model().parts.size(); ++part)
      for (std::size_t i = 0; i < body.model().parts[part].mesh.triangle_count(); ++i)
        visit_points(body.corners(part, i), cell / points_per_cell, [&](glm::vec3 at) {
          const glm::vec3 fraction = (at - bounds.min) / glm::max(box, glm::vec3(1e-20f));
          const glm::ivec3 here(fraction * glm::vec3(size_));
          is_taken_[index(glm::clamp(here, glm::ivec3(0), size_ - 1))] = true;
        });
  }

  /// Fraction of the cells that have one opposite, or next to it, across a plane about the middle of `axis`:
  /// the one of the largest fraction, for a mirror or an aerial on one side moves the middle of the box.
  float likeness(int axis) const {
    const int reach = size_[axis] / 6;
    float best = 0.0f;
    for (int shift = -reach; shift <= reach; ++shift) best = std::max(best, likeness(axis, shift));
    return best;
  }

  /// Number of columns along `along` that the upper and the lower quarter along `up` cover.
  glm::ivec2 columns_covered(int along, int up) const {
    std::vector<bool> high(std::size_t(size_[along]), false), low = high;
    visit([&](glm::ivec3 at) {
      if (4 * at[up] >= 3 * size_[up]) high[std::size_t(at[along])] = true;
      if (4 * at[up] < size_[up]) low[std::size_t(at[along])] = true;
    });
    return {int(std::ranges::count(high, true)), int(std::ranges::count(low, true))};
  }

 private:
  float likeness(int axis, int shift) const {
    std::size_t all = 0, alike = 0;
    visit([&](glm::ivec3 at) {
      ++all;
      const int opposite = size_[axis] - 1 - at[axis] + shift;
      const int first = std::max(opposite - 1, 0), last = std::min(opposite + 1, size_[axis] - 1);
      for (at[axis] = first; at[axis] <= last; ++at[axis]) {
        if (!is_taken_[index(at)]) continue;
        ++alike;
        break;
      }
    });
    return all > 0 ? float(alike) / float(all) : 0.0f;
  }

  std::size_t index(glm::ivec3 at) const {
    return (std::size_t(at.z) * std::size_t(size_.y) + std::size_t(at.y)) * std::size_t(size_.x) +
           std::size_t(at.x);
  }

  template <class Visit>
  void visit(const Visit& each) const {
    for (int k = 0; k < size_.z; ++k)
      for (int j = 0; j < size_.y; ++j)
        for (int i = 0; i < size_.x; ++i)
          if (is_taken_[index({i, j, k})]) each(glm::ivec3(i, j, k));
  }

  glm::ivec3 size_{0};
  std::vector<bool> is_taken_;
};

struct Axes {
  int length, width, height;
};

/// The width is the axis across which the body is alike on both sides; where that is not clear, z is up.
Axes axes_of(glm::vec3 size, const Cells& cells) {
  const int length = size.x >= size.y && size.x >= size.z ? x_axis : size.y >= size.z ? y_axis : z_axis;
  Axes usual{length, length == x_axis ? y_axis : x_axis, length == z_axis ? y_axis : z_axis};
  if (cells.likeness(usual.height) > cells.likeness(usual.width) + clear_margin)
    std::swap(usual.width, usual.height);
  return usual;
}

bool is_plausible(glm::vec3 length_width_height_m) {
  const glm::vec3 v = length_width_height_m;
  return v.x >= min_length_m && v.x <= max_length_m && v.y >= min_width_m && v.y <= max_width_m &&
         v.z >= min_height_m && v.z <= max_height_m;
}

/// The unit in which the body has the size of a car, as near as possible to the usual one.
std::optional<Unit> unit_of(glm::vec3 length_width_height) {
  std::optional<Unit> found;
  const auto off = [&](const Unit& unit) {
    return std::abs(std::log(unit.metres * length_width_height.x / usual_length_m));
  };
  for (const Unit& unit : units)
    if (is_plausible(unit.metres * length_width_height) && (!found || off(unit) < off(*found))) found = unit;
  return found;
}

void set_scale(CarFrame& frame, glm::vec3 length_width_height) {
  frame.units_long = length_width_height.x;
  if (is_plausible(length_width_height)) return;
  if (const std::optional<Unit> unit = unit_of(length_width_height)) {
    frame.scale = unit->metres, frame.unit = std::string(unit->name);
  } else if (length_width_height.x < min_length_m || length_width_height.x > max_length_m) {
    frame.scale = usual_length_m / length_width_height.x, frame.is_guess = true;
  }
}

/// Attribute `up` for a body whose height runs along the model's y. A file with z up that was read as one
/// with y up has its roof toward negative y, the other way round it is toward positive y.
std::string up_of(const Axes& axes, const Cells& cells) {
  if (axes.height != y_axis) return "";
  const glm::ivec2 covered = cells.columns_covered(axes.length, y_axis);
  return covered.x < covered.y ? "y" : "z";  // a roof is shorter than the body below
}

glm::mat4 rotation_of(const CarFrame& frame) {
  const float quarter = glm::radians(90.0f);
  const float roll = frame.up == "z" ? -quarter : frame.up == "y" ? quarter : 0.0f;
  return glm::rotate(glm::mat4(1.0f), -glm::radians(frame.heading_deg), glm::vec3(0, 0, 1)) *
         glm::rotate(glm::mat4(1.0f), roll, glm::vec3(1, 0, 0));
}

}  // namespace

glm::mat4 CarFrame::car_from_model() const {
  return glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, -aside_m, 0.0f)) *
         glm::scale(glm::mat4(1.0f), glm::vec3(scale)) * rotation_of(*this);
}

Result<CarFrame> find_frame(const scene::Model& model, const std::string& file) {
  const FileLocation where{file, 0, 0};
  const Result<Bounds> bounds = bounds_to_sample(model, file);
  if (!bounds) return bounds.errors();
  const glm::vec3 size = bounds->empty() ? glm::vec3(0.0f) : bounds->size();
  const float longest = std::max({size.x, size.y, size.z});
  if (!(std::min({size.x, size.y, size.z}) > min_flatness * longest))
    return error_at(
        where,
        "is no body of a car: its box is {:.3g} x {:.3g} x {:.3g}; expected a length, a width and a "
        "height",
        size.x, size.y, size.z);
  const Body as_read(model);
  const Cells cells(as_read);
  const Axes axes = axes_of(size, cells);
  if (axes.height == x_axis || (axes.length == z_axis && axes.height != y_axis))
    return error_at(
        where,
        "the body lies on its side: its height runs along x. Turn it in the program that made it, "
        "so that y or z is up");
  CarFrame frame;
  frame.up = up_of(axes, cells);
  set_scale(frame, {size[axes.length], size[axes.width], size[axes.height]});
  if (axes.length != x_axis) frame.heading_deg = 90.0f;
  if (faces_back(SideView(Body(model, frame.car_from_model())))) frame.heading_deg -= 180.0f;
  if (frame.heading_deg == -180.0f) frame.heading_deg = 180.0f;
  frame.aside_m = Body(model, frame.car_from_model()).middle_y();
  return frame;
}

}  // namespace parvis::car_bodies
