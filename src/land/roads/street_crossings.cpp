#include "land/roads/street_crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/data/model.h"
#include "scene/data/path.h"

namespace parvis::scene {
namespace {

constexpr float setback_m = 4.5f;                          // of a crossing's middle from the end of a lane
constexpr float paint_reach_m = 16.0f;                     // within which paint is sought along a lane
constexpr float paint_beside_m = 6.0f;                     // and across it
constexpr float lanes_apart_m = 9.0f;                      // between the lanes of one street
constexpr float same_street = 0.9f, mouth_level_m = 1.5f;  // cosine between directions; metres between lanes
constexpr int min_arms = 3;  // of a junction: where fewer streets meet, one turns round or continues
constexpr float unpainted_m = 2.0f, painted_m = 1.9f;  // half widths: people keep off the ends of stripes

/// Where a lane meets a junction.
struct Mouth {
  glm::vec3 middle;
  glm::vec2 along;
  float width_m;
  bool is_painted;
  int junction;  ///< Lane::crossing of its turns
};

/// Middles of the triangles that are painted as zebras.
std::vector<glm::vec3> zebra_paint(const Scene& scene) {
  std::vector<glm::vec3> places;
  for (const Object& object : scene.objects) {
    if (!object.model || object.is_dynamic || !object.is_visible) continue;
    const auto is_zebra = [](const Material& m) { return m.name.find("zebra") != std::string::npos; };
    if (std::ranges::none_of(object.model->materials, is_zebra)) continue;
    const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(*object.model) : object.pose;
    for (const Part& part : object.model->parts) {
      if (part.material < 0 || !is_zebra(object.model->materials[std::size_t(part.material)])) continue;
      const glm::mat4 world = object.world_from_model * pose[std::size_t(part.node)];
      const Mesh& mesh = part.mesh;
      for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 sum = mesh.positions[mesh.indices[i]] + mesh.positions[mesh.indices[i + 1]] +
                              mesh.positions[mesh.indices[i + 2]];
        places.emplace_back(world * glm::vec4(sum / 3.0f, 1.0f));
      }
    }
  }
  return places;
}

/// The distance along a lane, from its junction, at which its zebra lies.
std::optional<float> painted_at(const std::vector<glm::vec3>& paint, glm::vec3 end, glm::vec2 away) {
  float sum = 0.0f;
  int count = 0;
  for (const glm::vec3 p : paint) {
    const glm::vec2 to(p - end);
    const float along = glm::dot(to, away), beside = std::abs(to.x * away.y - to.y * away.x);
    if (along < 0.0f || along > paint_reach_m || beside > paint_beside_m ||
        std::abs(p.z - end.z) > mouth_level_m)
      continue;
    sum += along, ++count;
  }
  return count > 0 ? std::optional(sum / float(count)) : std::nullopt;
}

std::vector<Mouth> mouths_of(const RoadGraph& roads, const std::vector<glm::vec3>& paint) {
  std::vector<int> left_junction(roads.lanes.size(), -1);  // of each lane, the one that it comes from
  for (const Lane& lane : roads.lanes)
    for (const int next : lane.next)
      if (lane.crossing >= 0) left_junction[std::size_t(next)] = lane.crossing;
  std::vector<Mouth> mouths;
  for (std::size_t i = 0; i < roads.lanes.size(); ++i) {
    const Lane& lane = roads.lanes[i];
    if (lane.crossing >= 0 || lane.points.size() < 2) continue;
    const MeasuredPath path(lane.points);
    const auto add = [&](int junction, float end_m, float sign) {
      const glm::vec2 away = sign * glm::vec2(path.direction_at(end_m));
      const std::optional<float> zebra = painted_at(paint, path.at(end_m), away);
      const float back_m = std::min(zebra.value_or(setback_m), 0.5f * path.length());
      mouths.push_back({path.at(end_m + sign * back_m), away, lane.width_m, zebra.has_value(), junction});
    };
    const auto junction_of = [&](int next) { return roads.lanes[std::size_t(next)].crossing; };
    const auto turn = std::ranges::find_if(lane.next, [&](int next) { return junction_of(next) >= 0; });
    if (turn != lane.next.end()) add(junction_of(*turn), path.length(), -1.0f);
    if (left_junction[i] >= 0) add(left_junction[i], 0.0f, 1.0f);
  }
  return mouths;
}

}  // namespace

bool StreetCrossing::contains(glm::vec2 place, float more_m) const {
  const glm::vec2 across(b - a), to = place - glm::vec2(a);
  const float length = glm::length(across);
  if (!(length > 0.0f)) return false;
  const float at = glm::dot(to, across) / length,
              beside = std::abs(to.x * across.y - to.y * across.x) / length;
  return at >= -more_m && at <= length + more_m && beside <= half_width_m + more_m;
}

std::vector<StreetCrossing> street_crossings(const Scene& scene) {
  const std::vector<Mouth> mouths = mouths_of(scene.roads, zebra_paint(scene));
  std::vector<bool> is_used(mouths.size(), false);
  std::vector<StreetCrossing> crossings;
  std::vector<const Mouth*> made_at;  // of each crossing
  for (std::size_t i = 0; i < mouths.size(); ++i) {
    if (is_used[i]) continue;
    // The lanes of one street end side by side.
    const Mouth& first = mouths[i];
    const glm::vec2 across(-first.along.y, first.along.x);
    float from = 0.0f, to = 0.0f;
    for (std::size_t k = i; k < mouths.size(); ++k) {
      const Mouth& other = mouths[k];
      const glm::vec2 between(other.middle - first.middle);
      if (is_used[k] || glm::dot(other.along, first.along) < same_street ||
          std::abs(glm::dot(between, first.along)) > first.width_m ||
          std::abs(glm::dot(between, across)) > lanes_apart_m ||
          std::abs(other.middle.z - first.middle.z) > mouth_level_m)
        continue;
      is_used[k] = true;
      const float middle = glm::dot(between, across), half = 0.5f * other.width_m;
      from = std::min(from, middle - half), to = std::max(to, middle + half);
    }
    if (!(to - from > 0.5f)) continue;
    crossings.push_back({first.middle + glm::vec3(from * across, 0.0f),
                         first.middle + glm::vec3(to * across, 0.0f),
                         first.is_painted ? painted_m : unpainted_m, first.junction});
    made_at.push_back(&first);
  }
  std::vector<StreetCrossing> kept;
  for (std::size_t i = 0; i < crossings.size(); ++i)
    if (made_at[i]->is_painted ||
        std::ranges::count(made_at, made_at[i]->junction, &Mouth::junction) >= min_arms)
      kept.push_back(crossings[i]);
  return kept;
}

}  // namespace parvis::scene
