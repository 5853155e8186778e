#include "places/car_bodies/car_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "places/car_bodies/car_survey.h"
#include "places/car_bodies/material_lines.h"

namespace parvis::car_bodies {
namespace {

constexpr float rim_fraction = 0.68f;        // of the tyre's radius
constexpr float min_openings_m2 = 0.1f;      // of windows without panes
constexpr float min_written_aside = 0.005f;  // metres: less is 0 in the script

std::string fitted_wheels(const CarSurvey& found, const WheelFit& fit) {
  const float sign = found.frame.heading_deg == 180.0f ? -1.0f : 1.0f;
  // What does not fit into the file's own frame stands as a comment, in the car's.
  const char* const begin = found.copy_reason.empty() ? "  " : "  // ";
  return fmt::format(
      "  // In the middle of the arches.\n"
      "{}wheels(front_axle_x={:.2f}, rear_axle_x={:.2f}, axle_z={:.2f}, track={:.2f}, radius={:.2f}, "
      "width={:.2f},\n{}    rim_radius={:.2f})\n",
      begin, sign * fit.right_x, sign * fit.left_x, fit.axle_z, fit.track, fit.radius, fit.width, begin,
      rim_fraction * fit.radius);
}

std::string own_wheels(const std::vector<OwnWheel>& wheels) {
  std::string axles;
  for (std::size_t i = wheels.size(); i > 1; i -= 2)  // front to rear
    axles += fmt::format("{}x={:.2f} (radius {:.2f})", axles.empty() ? "" : ", ",
                         0.5f * (wheels[i - 1].centre.x + wheels[i - 2].centre.x), wheels[i - 2].radius);
  return fmt::format("  // It has wheels of its own: axles at {}, in metres forward.\n", axles);
}

std::string wheel_lines(const CarSurvey& found) {
  if (!found.wheels.empty()) return own_wheels(found.wheels);
  if (found.has_wheel_nodes) return "";
  if (found.fit) return fitted_wheels(found, *found.fit);
  return "  // No two arches were found: wheels(front_axle_x=..., rear_axle_x=..., axle_z=..., track=...).\n";
}

std::string attributes(const CarSurvey& found, const Bounds& bounds) {
  const CarFrame& frame = found.frame;
  const float raised_m = found.fit ? found.fit->radius - found.fit->axle_z : -bounds.min.z;
  const bool is_aside = std::abs(frame.aside_m) > min_written_aside;
  std::string text = fmt::format(", position=\"0 {} {:.2f}\"",
                                 is_aside ? fmt::format("{:.3f}", -frame.aside_m) : "0", raised_m);
  if (!frame.up.empty()) text += fmt::format(", up=\"{}\"", frame.up);
  if (frame.heading_deg != 0.0f) text += fmt::format(", heading_deg={}", frame.heading_deg);
  if (frame.scale != 1.0f) text += fmt::format(", scale={:.5g}", frame.scale);
  return text;
}

}  // namespace

Result<std::string> car_script(const scene::Model& model, const std::string& file,
                               const std::string& remark) {
  const Result<CarSurvey> found = survey(model, file);
  if (!found) return found.errors();
  const Body body(model, found->frame.car_from_model());
  const std::vector<SurfaceSample> samples = samples_of(body);
  const std::vector<BodySurface> surfaces = surfaces_of(body, samples, found->wheels);
  std::string text =
      "// Proposed by parvis car from the car's shape, materials and pictures; change it as you like. "
      "Include it in "
      "traffic.\n";
  text += remark + remarks(found->frame);
  if (!found->copy_reason.empty())
    text += fmt::format(
        "// Not all of it can be said of this file, for {}.\n// With -o SCRIPT.xp, parvis car "
        "writes a copy of the model beside the script, for which it can.\n",
        found->copy_reason);
  text += fmt::format("model(file={}{}, dynamic=1, reflective=1) {{\n", in_quotes(file),
                      attributes(*found, body.bounds()));
  text += material_lines(model, surfaces, samples);
  if (const float openings_m2 = SideView(body).openings_m2(); openings_m2 > min_openings_m2)
    text += fmt::format(
        "  // The sides have openings of {:.1f} m2 without panes in the file: no material can close them.\n",
        openings_m2);
  return text + wheel_lines(*found) + "}\n";
}

}  // namespace parvis::car_bodies
