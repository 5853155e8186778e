#include "capture/photographs/lens.h"

#include <cassert>
#include <cmath>
#include <optional>
#include <span>

namespace parvis::photographs {
namespace {

constexpr LensModelInfo model_infos[lens_model_count] = {
    {LensModel::simple_pinhole, "SIMPLE_PINHOLE", "f, cx, cy", 3, 1},
    {LensModel::pinhole, "PINHOLE", "fx, fy, cx, cy", 4, 2},
    {LensModel::simple_radial, "SIMPLE_RADIAL", "f, cx, cy, k", 4, 1},
    {LensModel::radial, "RADIAL", "f, cx, cy, k1, k2", 5, 1},
    {LensModel::opencv, "OPENCV", "fx, fy, cx, cy, k1, k2, p1, p2", 8, 2},
    {LensModel::opencv_fisheye, "OPENCV_FISHEYE", "fx, fy, cx, cy, k1, k2, k3, k4", 8, 2},
    {LensModel::full_opencv, "FULL_OPENCV", "fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6", 12, 2},
    {LensModel::fov, "FOV", "fx, fy, cx, cy, omega", 5, 2},
    {LensModel::simple_radial_fisheye, "SIMPLE_RADIAL_FISHEYE", "f, cx, cy, k", 4, 1},
    {LensModel::radial_fisheye, "RADIAL_FISHEYE", "f, cx, cy, k1, k2", 5, 1},
    {LensModel::thin_prism_fisheye, "THIN_PRISM_FISHEYE", "fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, sx1, sy1",
     12, 2},
};

/// A lens works in two steps: the direction is flattened (to the plane at distance 1, or for fisheyes to a
/// plane whose radius is the angle), then moved there by the distortion, whose terms follow the principal
/// point.
bool flattens_by_angle(LensModel model) {
  return model == LensModel::opencv_fisheye || model == LensModel::simple_radial_fisheye ||
         model == LensModel::radial_fisheye || model == LensModel::thin_prism_fisheye;
}

const double* distortion_terms(const Lens& lens) {
  return lens.parameters.data() + info(lens.model).focal_count + 2;
}

/// Where tangential terms p1, p2 of the lens move a flattened point.
glm::dvec2 tangential(glm::dvec2 p, double r2, double p1, double p2) {
  return {2.0 * p1 * p.x * p.y + p2 * (r2 + 2.0 * p.x * p.x),
          2.0 * p2 * p.x * p.y + p1 * (r2 + 2.0 * p.y * p.y)};
}

/// The field-of-view model: atan(2 r tan(omega / 2)) / (r omega), by its series where that is 0 / 0.
double fov_factor(double r2, double omega) {
  constexpr double small = 1e-8;
  if (omega * omega < small) return omega * omega * (r2 / 3.0 * -1.0 + 1.0 / 12.0) + 1.0;
  const double tangent = 2.0 * std::tan(0.5 * omega);
  if (r2 < small) return tangent / omega * (1.0 - r2 * tangent * tangent / 3.0);
  const double r = std::sqrt(r2);
  return std::atan(r * tangent) / (r * omega);
}

/// The flattened point where it appears behind the lens, in focal lengths from the principal point.
glm::dvec2 distorted(const Lens& lens, glm::dvec2 p) {
  const double* k = distortion_terms(lens);
  const double r2 = glm::dot(p, p);
  switch (lens.model) {
    case LensModel::simple_pinhole:
    case LensModel::pinhole:
      return p;
    case LensModel::simple_radial:
    case LensModel::simple_radial_fisheye:
      return p * (1.0 + k[0] * r2);
    case LensModel::radial:
    case LensModel::radial_fisheye:
      return p * (1.0 + r2 * (k[0] + r2 * k[1]));
    case LensModel::opencv:
      return p * (1.0 + r2 * (k[0] + r2 * k[1])) + tangential(p, r2, k[2], k[3]);
    case LensModel::opencv_fisheye:
      return p * (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * (k[2] + r2 * k[3]))));
    case LensModel::full_opencv: {
      const double above = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
      const double below = 1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
      return p * (above / below) + tangential(p, r2, k[2], k[3]);
    }
    case LensModel::fov:
      return p * fov_factor(r2, k[0]);
    case LensModel::thin_prism_fisheye: {
      const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * (k[4] + r2 * k[5])));
      return p * radial + tangential(p, r2, k[2], k[3]) + r2 * glm::dvec2(k[6], k[7]);
    }
  }
  return p;
}

/// Derivative of `distorted`, by central differences: columns are d/dx and d/dy.
glm::dmat2 distortion_derivative(const Lens& lens, glm::dvec2 p) {
  constexpr double step = 1e-6;
  const auto along = [&](glm::dvec2 h) {
    return (distorted(lens, p + h) - distorted(lens, p - h)) / (2.0 * step);
  };
  return {along({step, 0.0}), along({0.0, step})};
}

/// Whether the distortion still grows outward at every quarter of the way from the middle to `p`: polynomials
/// fold back beyond some radius, and what lies there appears in no real photograph.
bool before_the_fold(const Lens& lens, glm::dvec2 p) {
  for (const double part : {0.25, 0.5, 0.75, 1.0})
    if (!(glm::determinant(distortion_derivative(lens, part * p)) > 0.0)) return false;
  return true;
}

std::optional<glm::dvec2> undistorted_point(const Lens& lens, glm::dvec2 target) {
  constexpr int max_steps = 40;
  constexpr double tolerance = 1e-9;
  glm::dvec2 p = target;
  for (int i = 0; i < max_steps; ++i) {
    const glm::dvec2 rest = target - distorted(lens, p);
    if (glm::dot(rest, rest) < tolerance * tolerance)
      return before_the_fold(lens, p) ? std::optional(p) : std::nullopt;
    const glm::dmat2 derivative = distortion_derivative(lens, p);
    if (!(std::abs(glm::determinant(derivative)) > 1e-12)) return std::nullopt;
    const glm::dvec2 step = glm::inverse(derivative) * rest;
    const double length = glm::length(step), max_length = 0.25 + 0.5 * glm::length(p);
    p += length > max_length ? step * (max_length / length) : step;
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::span<const LensModelInfo> lens_models() { return model_infos; }

const LensModelInfo& info(LensModel model) { return model_infos[int(model)]; }

std::optional<LensModel> lens_model_of_name(std::string_view name) {
  for (const LensModelInfo& model : model_infos)
    if (model.name == name) return model.model;
  return std::nullopt;
}

Lens pinhole_lens(int width, int height, double fx, double fy, double cx, double cy) {
  return {LensModel::pinhole, width, height, {fx, fy, cx, cy}};
}

Lens centred_lens(int width, int height, double vertical_fov) {
  const double focal = 0.5 * height / std::tan(0.5 * vertical_fov);
  return pinhole_lens(width, height, focal, focal, 0.5 * width, 0.5 * height);
}

glm::dvec2 focal_px(const Lens& lens) {
  return {lens.parameters[0], lens.parameters[std::size_t(info(lens.model).focal_count) - 1]};
}

glm::dvec2 principal_point_px(const Lens& lens) {
  const std::size_t first = std::size_t(info(lens.model).focal_count);
  return {lens.parameters[first], lens.parameters[first + 1]};
}

bool is_pinhole(const Lens& lens) {
  if (flattens_by_angle(lens.model)) return false;
  const LensModelInfo& model = info(lens.model);
  for (int i = model.focal_count + 2; i < model.parameter_count; ++i)
    if (lens.parameters[std::size_t(i)] != 0.0) return false;
  return true;
}

std::optional<glm::dvec2> pixel_of(const Lens& lens, glm::dvec3 position_in_camera) {
  const glm::dvec3 p(position_in_camera.x, -position_in_camera.y,
                     -position_in_camera.z);  // y downward, z forward
  glm::dvec2 flat;
  if (flattens_by_angle(lens.model)) {
    const double off_axis = std::hypot(p.x, p.y);
    const double angle = std::atan2(off_axis, p.z);
    flat = off_axis > 0.0 ? glm::dvec2(p) * (angle / off_axis) : glm::dvec2(0.0);
    if (off_axis == 0.0 && !(p.z > 0.0)) return std::nullopt;
  } else {
    if (!(p.z > 0.0)) return std::nullopt;
    flat = glm::dvec2(p) / p.z;
  }
  if (!is_pinhole(lens) && !before_the_fold(lens, flat)) return std::nullopt;
  const glm::dvec2 pixel = focal_px(lens) * distorted(lens, flat) + principal_point_px(lens);
  return std::isfinite(pixel.x) && std::isfinite(pixel.y) ? std::optional(pixel) : std::nullopt;
}

std::optional<glm::dvec3> direction_of(const Lens& lens, glm::dvec2 pixel) {
  glm::dvec2 flat = (pixel - principal_point_px(lens)) / focal_px(lens);
  if (!is_pinhole(lens)) {
    const std::optional<glm::dvec2> found = undistorted_point(lens, flat);
    if (!found) return std::nullopt;
    flat = *found;
  }
  constexpr double edge_on = 1e8;  // focal lengths: further out nothing is left of the direction's precision
  if (!(std::abs(flat.x) < edge_on) || !(std::abs(flat.y) < edge_on)) return std::nullopt;
  if (!flattens_by_angle(lens.model)) return glm::normalize(glm::dvec3(flat.x, -flat.y, -1.0));
  const double angle = glm::length(flat);
  if (angle > glm::radians(180.0)) return std::nullopt;
  const glm::dvec2 sideways = angle > 0.0 ? flat * (std::sin(angle) / angle) : glm::dvec2(0.0);
  return glm::dvec3(sideways.x, -sideways.y, -std::cos(angle));
}

bool is_inside(const Lens& lens, glm::dvec2 pixel) {
  return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < lens.width && pixel.y < lens.height;
}

Lens resized(const Lens& lens, int width, int height) {
  const glm::dvec2 scale = glm::dvec2(width, height) / glm::dvec2(lens.width, lens.height);
  Lens result = lens;
  result.width = width;
  result.height = height;
  const std::size_t focal_count = std::size_t(info(lens.model).focal_count);
  result.parameters[0] *= focal_count == 1 ? 0.5 * (scale.x + scale.y) : scale.x;
  if (focal_count == 2) result.parameters[1] *= scale.y;
  result.parameters[focal_count] *= scale.x;
  result.parameters[focal_count + 1] *= scale.y;
  return result;
}

Lens undistorted(const Lens& lens) {
  const glm::dvec2 focal = focal_px(lens), middle = principal_point_px(lens);
  return pinhole_lens(lens.width, lens.height, focal.x, focal.y, middle.x, middle.y);
}

double vertical_fov(const Lens& lens) {
  const double fy = focal_px(lens).y, cy = principal_point_px(lens).y;
  return std::atan(cy / fy) + std::atan((lens.height - cy) / fy);
}

glm::dmat4 clip_from_camera(const Lens& undistorted_lens, double near_m, double far_m) {
  assert(is_pinhole(undistorted_lens));
  const glm::dvec2 size(undistorted_lens.width, undistorted_lens.height);
  const glm::dvec2 focal = 2.0 * focal_px(undistorted_lens) / size;
  const glm::dvec2 middle = 2.0 * principal_point_px(undistorted_lens) / size;
  glm::dmat4 clip(0.0);
  clip[0][0] = focal.x;
  clip[1][1] = focal.y;
  clip[2] = {1.0 - middle.x, middle.y - 1.0, (far_m + near_m) / (near_m - far_m), -1.0};
  clip[3][2] = 2.0 * far_m * near_m / (near_m - far_m);
  return clip;
}

}  // namespace parvis::photographs
