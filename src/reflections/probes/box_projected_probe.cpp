#include <algorithm>
#include <limits>

#include "reflections/methods/settings.h"
#include "reflections/probes/methods.h"

namespace parvis::probes {
namespace {

constexpr float spacing_m = 30.0f;
constexpr float height_m = 1.5f;            // of a probe over the street, as engines' users place them
constexpr float merge_distance_m = 15.0f;   // opposite lanes share probes
constexpr int forgotten_after = 600;        // frames: then the map's memory is given back
constexpr float open_half_size_m = 500.0f;  // where nothing bounds the street

/// Walks a lane and calls `place` every `spacing_m` with a position and the direction of travel.
template <class Place>
void walk(const scene::Lane& lane, const Place& place) {
  float until_next = 0.0f;
  for (std::size_t i = 0; i + 1 < lane.points.size(); ++i) {
    const glm::vec3 step = lane.points[i + 1] - lane.points[i];
    const float length = glm::length(step);
    if (length <= 0.0f) continue;
    while (until_next < length) {
      place(lane.points[i] + until_next / length * step, step / length);
      until_next += spacing_m;
    }
    until_next -= length;
  }
}

float median(std::vector<float>& values, float otherwise) {
  if (values.empty()) return otherwise;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

BoxProjectedProbe::BoxProjectedProbe(const scene::Scene& scene)
    : resolution_(methods::settings(scene).resolution) {
  for (const scene::Lane& lane : scene.roads.lanes)
    walk(lane, [&](glm::vec3 position, glm::vec3 direction) {
      const glm::vec3 at = position + glm::vec3(0, 0, height_m);
      const bool is_near_another = std::any_of(probes_.begin(), probes_.end(), [&](const Probe& probe) {
        return glm::distance(probe.position, at) < merge_distance_m;
      });
      const glm::vec2 heading = glm::vec2(direction) / std::max(glm::length(glm::vec2(direction)), 1e-6f);
      if (!is_near_another) probes_.push_back({at, heading, {}});
    });
}

/// Draws the map and fits the box to the middle of what each side of the street shows.
void BoxProjectedProbe::bake(Probe& probe, render::Renderer& renderer) {
  probe.map.emplace(resolution_);
  std::array<std::vector<float>, 4> distances;  // ahead, left, behind, right
  std::vector<glm::vec3> points;
  for (int face = 0; face < 6; ++face) {
    probe.map->draw_face(renderer, face, probe.position, -1, render::Subjects::fixed);
    probe.map->read_points(face, probe.position, points);
    for (const glm::vec3& point : points) {
      const glm::vec3 offset = point - probe.position;
      if (offset.z < 0.0f) continue;  // the street itself bounds no side
      const float ahead = probe.heading.x * offset.x + probe.heading.y * offset.y;
      const float left = probe.heading.x * offset.y - probe.heading.y * offset.x;
      const bool is_along = std::abs(ahead) > std::abs(left);
      const std::size_t side = is_along ? (ahead > 0.0f ? 0 : 2) : (left > 0.0f ? 1 : 3);
      distances[side].push_back(is_along ? std::abs(ahead) : std::abs(left));
    }
  }
  probe.map->update_levels();
  faces_drawn_ += 6;

  std::array<float, 4> reach{};
  for (std::size_t side = 0; side < 4; ++side) reach[side] = median(distances[side], open_half_size_m);
  const glm::vec2 shift{0.5f * (reach[0] - reach[2]), 0.5f * (reach[1] - reach[3])};
  probe.box_half_size = {0.5f * (reach[0] + reach[2]), 0.5f * (reach[1] + reach[3]), open_half_size_m};
  const glm::vec2 left{-probe.heading.y, probe.heading.x};
  // The street is the box's floor; its top lies so high that walls and sky are looked up as they stand.
  probe.box_centre =
      probe.position + glm::vec3(shift.x * probe.heading + shift.y * left, open_half_size_m - height_m);
}

void BoxProjectedProbe::update_maps(render::Renderer& renderer, const scene::Scene&,
                                    const std::vector<methods::VisibleReflector>& reflectors) {
  for (Probe& probe : probes_) ++probe.idle_frames;
  probe_of_object_.clear();
  for (const methods::VisibleReflector& reflector : reflectors) {
    Probe* nearest = nullptr;
    float minimum = std::numeric_limits<float>::max();
    for (Probe& probe : probes_)
      if (const float distance = glm::distance(probe.position, reflector.centre); distance < minimum)
        nearest = &probe, minimum = distance;
    if (!nearest) {  // a scene without roads: one probe where the first reflector stands
      probes_.push_back({reflector.centre, {1.0f, 0.0f}, {}});
      nearest = &probes_.back();
    }
    if (!nearest->map) bake(*nearest, renderer);
    nearest->idle_frames = 0;
    probe_of_object_[reflector.object] = nearest;
  }
  for (Probe& probe : probes_)
    if (probe.idle_frames > forgotten_after) probe.map.reset();
}

void BoxProjectedProbe::forget_surroundings() {
  for (Probe& probe : probes_) probe.map.reset();
}

void BoxProjectedProbe::bind(const gl::Program& program, int object) {
  const Probe& probe = *probe_of_object_.at(object);
  if (probe.map) bind_map(program, *probe.map);
  program.set("box_is_used", 1.0f);
  program.set("map_centre", probe.position);
  program.set("box_centre", probe.box_centre);
  program.set("box_half_size", probe.box_half_size);
  program.set("box_heading", probe.heading);
}

}  // namespace parvis::probes
