#include "life/crowd/scene_ground.h"

#include <algorithm>

#include "base/bounds.h"
#include "scene/data/model.h"
#include "scene/data/model_parts.h"
#include "scene/data/surroundings.h"

namespace parvis::crowd {
namespace {

constexpr float max_strip_m = 4.0f;  // of a lane whose points lie farther apart: heights change in between

void add_triangles(const scene::Object& object, glm::vec2 centre, float radius_m, WalkingGround& ground) {
  const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
  for (std::size_t p = 0; p < object.model->parts.size(); ++p) {
    const scene::Part& part = object.model->parts[p];
    const Mesh& mesh = object.mesh(p);
    const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      std::array<glm::vec3, 3> corners;
      glm::vec2 low(1e9f), high(-1e9f);
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] = glm::vec3(world_from_mesh * glm::vec4(mesh.positions[mesh.indices[i + c]], 1.0f));
        low = glm::min(low, glm::vec2(corners[c])), high = glm::max(high, glm::vec2(corners[c]));
      }
      const glm::vec2 nearest = glm::clamp(centre, low, high);
      if (!(glm::distance(nearest, centre) < radius_m)) continue;
      ground.corners.insert(ground.corners.end(), corners.begin(), corners.end());
      ground.kinds.push_back(GroundKind::floor);
    }
  }
}

void add_lane(const scene::Lane& lane, glm::vec2 centre, float radius_m, WalkingGround& ground) {
  for (std::size_t i = 0; i + 1 < lane.points.size(); ++i) {
    const glm::vec3 a = lane.points[i], b = lane.points[i + 1];
    const int pieces = std::max(1, int(std::ceil(glm::distance(a, b) / max_strip_m)));
    for (int k = 0; k < pieces; ++k) {
      const RoadStrip strip{glm::mix(a, b, float(k) / float(pieces)),
                            glm::mix(a, b, float(k + 1) / float(pieces)), lane.width_m};
      if (glm::distance(glm::vec2(strip.a), centre) < radius_m) ground.roads.push_back(strip);
    }
  }
}

}  // namespace

WalkingGround ground_of(const scene::Scene& scene, glm::vec2 centre, float radius_m) {
  WalkingGround ground;
  for (const scene::Object& object : scene.objects)
    if (!object.is_dynamic && object.is_visible && object.model && !scene::surrounds_place(scene, object))
      add_triangles(object, centre, radius_m, ground);
  for (const scene::Lane& lane : scene.roads.lanes) add_lane(lane, centre, radius_m, ground);
  return ground;
}

}  // namespace parvis::crowd
