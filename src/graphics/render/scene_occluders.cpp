#include "graphics/render/scene_occluders.h"

#include "graphics/render/fixed_parts.h"
#include "graphics/render/frustum.h"

namespace parvis::render {

SceneOccluders::SceneOccluders(const scene::Scene& scene, const GpuScene& gpu) {
  find_fixed(scene);
  keep_moving_shapes(scene, gpu);
}

void SceneOccluders::find_fixed(const scene::Scene& scene) {
  culler_.clear();
  for_each_fixed_opaque_part(scene, [this](const FixedPart& part) {
    if (part.is_visible) culler_.add_occluder(part.mesh, part.world_from_mesh, part.has_backs);
  });
}

void SceneOccluders::keep_moving_shapes(const scene::Scene& scene, const GpuScene& gpu) {
  const std::size_t known = shape_of_part_.size();
  shape_of_part_.resize(gpu.parts().size(), -1);
  std::size_t item = 0;
  for (const scene::Object& object : scene.objects)
    for (const scene::Part& part : object.model->parts) {
      const std::size_t number = std::size_t(gpu.items()[item++].part);
      int& shape = shape_of_part_[number];
      const scene::Material& material = object.model->materials[std::size_t(part.material)];
      const bool is_rigid = object.deformed_meshes.empty() || !part.deformation;
      if (object.is_dynamic && is_rigid && !part.is_backdrop && material.alpha_mode == scene::Alpha::opaque &&
          number >= known && shape < 0)
        shape = culler_.add_shape(part.mesh, material.is_double_sided);
    }
}

void SceneOccluders::draw(const View& view, const GpuScene& gpu) {
  constexpr float farthest_radii = 40.0f;
  const Frustum frustum(view.clip_of_part() * view.clip_from_world);
  // What a view leaves out hides nothing in it.
  const bool shows_moving = view.subjects == Subjects::all || view.subjects == Subjects::moving;
  placed_shapes_.clear();
  for (const Item& item : gpu.items()) {
    const int shape = shape_of_part_[std::size_t(item.part)];
    if (shape < 0 || !gpu.is_moving(item.object) || !gpu.is_visible(item.object)) continue;
    if (!shows_moving || item.object == view.excluded_object || !view.shows(item.object)) continue;
    const Bounds& bounds = gpu.object_bounds()[std::size_t(item.object)];
    const float distance_m = glm::distance(bounds.centre(), view.position_in_world);
    if (distance_m > farthest_radii * bounds.radius() || !frustum.may_see(item.bounds)) continue;
    const glm::mat4 rows(item.record.rows[0], item.record.rows[1], item.record.rows[2],
                         glm::vec4(0, 0, 0, 1));
    placed_shapes_.push_back({shape, glm::transpose(rows)});
  }
  culler_.draw(view.clip_from_world, placed_shapes_);
}

}  // namespace parvis::render
