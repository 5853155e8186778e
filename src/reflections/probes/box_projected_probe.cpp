#include <algorithm>

#include "base/median.h"
#include "graphics/gl/sampled_textures.h"
#include "reflections/methods/bindings.h"
#include "reflections/methods/settings.h"
#include "reflections/probes/methods.h"
#include "reflections/probes/probe_blend.h"

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

}  // namespace

BoxProjectedProbe::BoxProjectedProbe(const scene::Scene& scene, methods::LobeFilter filter)
    : CubeMapReflections(std::move(filter)), resolution_(methods::settings(scene).resolution) {
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
  update_levels(*probe.map);
  faces_drawn_ += 6;

  std::array<float, 4> reach{};
  for (std::size_t side = 0; side < 4; ++side)
    reach[side] = distances[side].empty() ? open_half_size_m : median(distances[side]);
  const glm::vec2 shift{0.5f * (reach[0] - reach[2]), 0.5f * (reach[1] - reach[3])};
  probe.box_half_size = {0.5f * (reach[0] + reach[2]), 0.5f * (reach[1] + reach[3]), open_half_size_m};
  const glm::vec2 left{-probe.heading.y, probe.heading.x};
  // The street is the box's floor; its top lies so high that walls and sky are looked up as they stand.
  probe.box_centre =
      probe.position + glm::vec3(shift.x * probe.heading + shift.y * left, open_half_size_m - height_m);
}

/// A scene without roads has one probe, where the first reflector stands.
BoxProjectedProbe::ProbePair BoxProjectedProbe::probes_about(glm::vec3 place) {
  if (probes_.empty()) probes_.push_back({place, {1.0f, 0.0f}, {}});
  std::vector<std::pair<float, Probe*>> by_distance;
  by_distance.reserve(probes_.size());
  for (Probe& probe : probes_) by_distance.emplace_back(glm::distance(probe.position, place), &probe);
  const std::size_t near_count = std::min(by_distance.size(), std::size_t{3});
  std::ranges::partial_sort(by_distance, by_distance.begin() + std::ptrdiff_t(near_count), {},
                            &std::pair<float, Probe*>::first);
  Probe* nearest = by_distance.front().second;
  if (near_count < 2) return {nearest, nearest, 0.0f};
  const std::optional<float> third_m =
      near_count > 2 ? std::optional(by_distance[2].first) : std::optional<float>();
  return {nearest, by_distance[1].second,
          share_of_second(by_distance[0].first, by_distance[1].first, third_m)};
}

void BoxProjectedProbe::update_maps(render::Renderer& renderer, const scene::Scene&,
                                    const std::vector<methods::VisibleReflector>& reflectors) {
  for (Probe& probe : probes_) ++probe.idle_frames;
  probes_of_object_.clear();
  for (const methods::VisibleReflector& reflector : reflectors) {
    const ProbePair pair = probes_about(reflector.centre);
    for (Probe* probe : {pair.nearest, pair.second}) {
      if (!probe->map) bake(*probe, renderer);
      probe->idle_frames = 0;
    }
    probes_of_object_.emplace(reflector.object, pair);
  }
  for (Probe& probe : probes_)
    if (probe.idle_frames > forgotten_after) probe.map.reset();
}

void BoxProjectedProbe::forget_surroundings() {
  for (Probe& probe : probes_) probe.map.reset();
}

void BoxProjectedProbe::bind(const gl::Program& program, int object) {
  const ProbePair& pair = probes_of_object_.at(object);
  const Probe &nearest = *pair.nearest, &second = *pair.second;
  if (!nearest.map || !second.map) return;  // forgotten, and no frame has drawn them since
  bind_map(program, *nearest.map);
  gl::bind_textures(program, {{"second_map", methods::first_method_unit + 1, second.map->texture()}});
  const auto box_of = [](const Probe& probe) {
    return boxes_shared::ProbeBox{.map_centre = glm::vec4(probe.position, 1.0f),
                                  .box_centre = glm::vec4(probe.box_centre, 1.0f),
                                  .box_half_size = glm::vec4(probe.box_half_size, 0.0f),
                                  .box_heading = glm::vec4(probe.heading, 0.0f, 0.0f)};
  };
  boxes_.bind(program, {.boxes = {box_of(nearest), box_of(second)}, .second_share = pair.second_share});
}

}  // namespace parvis::probes
