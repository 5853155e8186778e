#include "places/car_bodies/car_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "places/car_bodies/names.h"

namespace parvis::car_bodies {
namespace {

constexpr float max_aside_m = 0.02f;  // of the middle plane, that wheels may stand askew

std::string reason_for_copy(const scene::Model& model, const std::string& file, const CarSurvey& found) {
  const std::string name = lower_case(file);
  const CarFrame& frame = found.frame;
  if (!frame.up.empty() && (name.ends_with(".glb") || name.ends_with(".gltf")))
    return "the car does not stand upright, and glTF is always read with y up";
  const bool is_along_x = frame.heading_deg == 0.0f || frame.heading_deg == 180.0f;
  if (found.fit && (!is_along_x || frame.scale != 1.0f || std::abs(frame.aside_m) > max_aside_m))
    return "wheels() takes metres along x of the file, and the same on both sides";
  const auto turns = [&](const OwnWheel& wheel) { return turns_in_traffic(model, wheel); };
  if (!std::ranges::all_of(found.wheels, turns))
    return "wheels turn only on nodes of their own whose names hold \"wheel\"";
  if (file.starts_with("../")) return "a script reads nothing outside of its own folder";
  return "";
}

}  // namespace

Result<CarSurvey> survey(const scene::Model& model, const std::string& file) {
  const Result<CarFrame> frame = find_frame(model, file);
  if (!frame) return frame.errors();
  CarSurvey found;
  found.frame = *frame;
  const Body body(model, frame->car_from_model());
  found.wheels = find_own_wheels(body);
  found.has_wheel_nodes = std::ranges::any_of(model.nodes, names_a_wheel, &scene::ModelNode::name);
  if (!found.has_wheels()) found.fit = fit_wheels(SideView(body));
  found.copy_reason = reason_for_copy(model, file, found);
  return found;
}

std::string remarks(const CarFrame& frame) {
  std::string text;
  if (!frame.up.empty()) text += fmt::format("// In the file {} is up.\n", frame.up);
  if (frame.heading_deg == 90.0f || frame.heading_deg == -90.0f)
    text += "// In the file its length lies across x: it is turned to look along x.\n";
  if (frame.scale == 1.0f) return text;
  const float length_m = frame.units_long * frame.scale;
  text +=
      frame.is_guess
          ? fmt::format("// The file is {:.4g} long, in no unit that makes it a car: {:.2f} m is a guess.\n",
                        frame.units_long, length_m)
          : fmt::format("// The file is {:.4g} long: taken as {}, for a length of {:.2f} m.\n",
                        frame.units_long, frame.unit, length_m);
  text += fmt::format("// If the length is not right, multiply scale (else 1) by the right one / {:.2f}.\n",
                      length_m);
  return text;
}

}  // namespace parvis::car_bodies
