#include "environment_maps/scene_maps.h"

#include "environment_maps/placement.h"
#include "render/fixed_parts.h"

namespace parvis::environment_maps {

shading::Heightfield heights_of(const scene::Scene& scene) {
  Bounds bounds;
  const auto each_part = [&](auto&& visit) {
    render::for_each_fixed_opaque_part(
        scene, [&](const scene::Object& object, const scene::Part& part, const glm::mat4& world_from_mesh) {
          if (object.is_visible) visit(part.mesh, world_from_mesh);
        });
  };
  each_part([&](const Mesh& mesh, const glm::mat4& world_from_mesh) {
    bounds.add(transformed(world_from_mesh, mesh.bounds()));
  });
  shading::Heightfield heights(bounds);
  each_part([&](const Mesh& mesh, const glm::mat4& world_from_mesh) { heights.add(mesh, world_from_mesh); });
  return heights;
}

Result<ReferenceMaps> bake_maps(const scene::Scene& scene, const HeightPyramid& heights,
                                render::Renderer& renderer) {
  std::vector<glm::vec3> places = place_for_pictures(scene, heights, scene.reflection.most_maps).places;
  if (places.empty()) places.emplace_back(0.0f, 0.0f, 1.5f);
  scene::Scene still = scene;  // models are shared; what moves throws neither shadow nor shade into a map
  for (scene::Object& object : still.objects) object.is_visible = object.is_visible && !object.is_dynamic;
  renderer.begin_frame(still, Camera{});
  return ReferenceMaps::bake(renderer, std::move(places), scene.reflection.resolution);
}

}  // namespace parvis::environment_maps
