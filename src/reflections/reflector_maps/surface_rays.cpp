#include "reflections/reflector_maps/surface_rays.h"

namespace parvis::reflector_maps {

SurfaceRays::SurfaceRays(const ReflectorMesh& mesh, std::span<const std::uint32_t> triangles) {
  auto model = std::make_shared<scene::Model>();
  model->materials.emplace_back().is_double_sided = true;
  Mesh part;
  part.positions = mesh.mesh.positions;
  part.normals = mesh.mesh.normals;
  part.uvs = mesh.mesh.uvs;
  for (const std::uint32_t t : triangles)
    part.indices.insert(part.indices.end(), &mesh.mesh.indices[3 * t], &mesh.mesh.indices[3 * t] + 3);
  model->parts.push_back({"patch", std::move(part), 0, 0, true});
  scene_.objects.emplace_back().model = std::move(model);
  rays_ = std::make_unique<reference::RayScene>(scene_);
}

std::optional<MetSurface> SurfaceRays::along(glm::vec3 origin, glm::vec3 direction) const {
  const glm::vec3 unit = glm::normalize(direction);
  const std::optional<reference::Hit> hit = rays_->nearest_hit({origin, unit, 0.0f});
  if (!hit) return std::nullopt;
  const Mesh& mesh = *hit->place->mesh;
  const std::uint32_t* corner = mesh.indices.data() + 3 * std::size_t(hit->triangle);
  const glm::vec3 normal = (1.0f - hit->u - hit->v) * mesh.normals[corner[0]] +
                           hit->u * mesh.normals[corner[1]] + hit->v * mesh.normals[corner[2]];
  return MetSurface{origin + hit->distance_m * unit, glm::normalize(normal)};
}

}  // namespace parvis::reflector_maps
