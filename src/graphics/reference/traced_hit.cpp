#include "graphics/reference/traced_hit.h"

namespace parvis::reference {

scene::TracedHit traced_hit(const PlacedPart& place, std::uint32_t triangle, glm::vec2 barycentric,
                            glm::vec3 to_viewer, float width_m) {
  const Mesh& mesh = *place.mesh;
  const std::uint32_t* corner = mesh.indices.data() + 3 * std::size_t(triangle);
  const auto interpolated = [&](const auto& values) {
    return (1.0f - barycentric.x - barycentric.y) * values[corner[0]] + barycentric.x * values[corner[1]] +
           barycentric.y * values[corner[2]];
  };
  const glm::vec3 edge_1 = mesh.positions[corner[1]] - mesh.positions[corner[0]];
  const glm::vec3 edge_2 = mesh.positions[corner[2]] - mesh.positions[corner[0]];
  const glm::vec3 facet = place.world_from_normal * glm::cross(edge_1, edge_2);

  scene::TracedHit hit{};
  hit.position = glm::vec3(place.world_from_mesh * glm::vec4(interpolated(mesh.positions), 1.0f));
  hit.to_viewer = to_viewer;
  hit.is_back = glm::dot(facet, to_viewer) < 0.0f;
  hit.normal = glm::normalize(place.world_from_normal * interpolated(mesh.normals));
  if (hit.is_back) hit.normal = -hit.normal;
  hit.uv = interpolated(mesh.uvs);
  hit.triangle = triangle;
  hit.barycentric = barycentric;
  hit.width_m = width_m;
  return hit;
}

}  // namespace parvis::reference
