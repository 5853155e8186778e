#include "places/car_bodies/car_script.h"

#include <fmt/format.h>

#include <algorithm>

#include "places/car_bodies/picture_masks.h"
#include "places/car_bodies/wheel_arches.h"

namespace parvis::car_bodies {
namespace {

constexpr float min_length_m = 2.0f, max_length_m = 20.0f;

bool has_wheels(const scene::Model& model) {
  const auto is_wheel = [](std::string name) {
    std::ranges::transform(name, name.begin(), [](unsigned char letter) { return std::tolower(letter); });
    return name.find("wheel") != std::string::npos || name.find("tyre") != std::string::npos ||
           name.find("tire") != std::string::npos;
  };
  return std::ranges::any_of(model.nodes, is_wheel, &scene::ModelNode::name);
}

Errors lies_along_y(glm::vec3 size, const FileLocation& where) {
  return {error_at(
      where,
      "the body lies along y ({:.2f} m), not along x ({:.2f} m): export it with x forward. A car with "
      "wheels and materials of its own needs no script: traffic() {{ model(file=\"{}\", heading_deg=-90) "
      "}} turns it",
      size.y, size.x, where.file)};
}

Status check_size(const Bounds& bounds, const std::string& file) {
  const glm::vec3 size = bounds.size();
  const FileLocation where{file, 0, 0};
  if (bounds.empty() || size.x < min_length_m || size.x > max_length_m || size.z <= 0.0f || size.y <= 0.0f) {
    if (!bounds.empty() && size.y >= min_length_m && size.y > size.x) return lies_along_y(size, where);
    return error_at(
        where,
        "the body is {:.2f} m long; a car is {} to {} m long, in metres with x forward: scale or turn "
        "the file",
        bounds.empty() ? 0.0f : size.x, min_length_m, max_length_m);
  }
  if (size.y > size.x) return lies_along_y(size, where);
  return Done{};
}

std::string material_lines(const PictureMasks& masks) {
  std::string text = "  material(preset=\"paint\")\n";
  const auto add = [&](const char* preset, const std::vector<std::string>& of) {
    if (of.empty()) return;
    text += fmt::format("  material(preset=\"{}\"", preset);
    for (const std::string& mask : of) text += fmt::format(",\n      mask=\"{}\"", mask);
    text += ")\n";
  };
  if (masks.glass.empty())
    text +=
        "  // No grey panes were found in the picture: material(preset=\"glass\", target=... or mask=...).\n";
  add("glass", masks.glass);
  add("lamp", masks.lamps);
  return text;
}

std::string wheel_lines(const WheelFit& fit, bool is_turned) {
  return fmt::format(
      "  // In the middle of the arches.\n"
      "  wheels(front_axle_x={:.2f}, rear_axle_x={:.2f}, axle_z={:.2f}, track={:.2f}, radius={:.2f}, "
      "width={:.2f},\n      rim_radius={:.2f})\n",
      is_turned ? fit.left_x : fit.right_x, is_turned ? fit.right_x : fit.left_x, fit.axle_z, fit.track,
      fit.radius, fit.width, 0.68f * fit.radius);
}

}  // namespace

Result<std::string> car_script(const scene::Model& model, const std::string& file) {
  const Bounds bounds = scene::bounds(model);
  if (Status status = check_size(bounds, file); !status) return status.errors();
  const SideView side(model);
  const bool is_turned = faces_back(side);
  float raised_m = -bounds.min.z;
  std::string wheels;
  if (!has_wheels(model)) {
    if (const std::optional<WheelFit> fit = fit_wheels(side)) {
      raised_m = fit->radius - fit->axle_z;
      wheels = wheel_lines(*fit, is_turned);
    } else {
      wheels =
          "  // No two arches were found: wheels(front_axle_x=..., rear_axle_x=..., axle_z=..., "
          "track=...).\n";
    }
  }
  std::string text = fmt::format(
      "// Proposed by parvis car from the body's shape and picture; change it as you like. Include it in "
      "traffic.\nmodel(file=\"{}\", position=\"0 0 {:.2f}\"{}, dynamic=1, reflective=1) {{\n",
      file, raised_m, is_turned ? ", heading_deg=180" : "");
  text += material_lines(find_masks(model, bounds, is_turned)) + wheels;
  return text + "}\n";
}

}  // namespace parvis::car_bodies
