// A tram's track: its smooth centre line, what is laid for it, and what stands beside it.
#pragma once

#include <memory>
#include <span>

#include "base/result.h"
#include "life/tram/timetable.h"
#include "scene/data/model.h"

namespace parvis::tram {

/// A platform beside the track.
struct Platform {
  float from_m = 0.0f, to_m = 0.0f;  ///< along the line
  bool is_on_left = false;
};

/// A platform's edge beside the tram, on its surface.
struct PlatformEdge {
  glm::vec3 from, to;  ///< ends
  glm::vec2 away;      ///< unit vector from the track onto the platform
  float breadth_m;
};

/// The edge of a platform of this line, whose points lie on the ground.
PlatformEdge platform_edge(const scene::MeasuredPath& line, const Platform& platform);

/// The centre line through the corners of a path, metres: arcs of `radius_m` in place of corners (smaller
/// where the path is too short for them), with no angle of more than 2 degrees.
scene::Path smooth_line(const scene::Path& corners, float radius_m);

/// The line as it can be driven. Fails where it is shorter than a tram and 20 m or longer than 20 km, where a
/// curve is tighter than `min_radius_m`, and where it climbs more than `max_gradient`; the errors say at
/// which place.
Result<scene::MeasuredPath> driveable(scene::Path line);

/// Rails in grooved paving, flush with it; the paving is 3 cm thick and lies on the line. Wire and masts
/// above it where `has_wire`; platforms 0.30 m high with a shelter each, ramps at
/// their ends and a step along their backs.
std::shared_ptr<const scene::Model> track_model(const scene::MeasuredPath& line, bool has_wire,
                                                std::span<const Platform> platforms);

}  // namespace parvis::tram
