#include "graphics/render/fixed_parts.h"

namespace parvis::render {
namespace {

class FixedTracedParts final : public scene::TracedScene {
 public:
  FixedTracedParts(int first_thing, const std::function<void(const FixedPart&)>& visit)
      : first_thing_(first_thing), visit_(visit) {}

  void add(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const scene::TracedSurface> surface,
           const glm::mat4& world_from_mesh, const scene::TracedPlacing& placing) override {
    if (!placing.is_dynamic && !placing.is_backdrop && surface->alpha_mode() == scene::Alpha::opaque)
      visit_({*mesh, world_from_mesh, first_thing_ + placing.thing, placing.is_visible,
              surface->is_double_sided()});
  }

  void add(std::shared_ptr<const scene::Model> model, const glm::mat4& world_from_model,
           const scene::TracedPlacing& placing) override {
    if (placing.is_dynamic || placing.is_backdrop) return;
    const std::vector<glm::mat4> pose = scene::rest_pose(*model);
    for (const scene::Part& part : model->parts) {
      const scene::Material& material = model->materials[std::size_t(part.material)];
      if (material.alpha_mode == scene::Alpha::opaque && !material.refracts() && !part.is_backdrop)
        visit_({part.mesh, world_from_model * pose[std::size_t(part.node)], first_thing_ + placing.thing,
                placing.is_visible, material.is_double_sided});
    }
  }

 private:
  int first_thing_;
  const std::function<void(const FixedPart&)>& visit_;
};

}  // namespace

void for_each_fixed_traced_part(const scene::Scene& scene,
                                const std::function<void(const FixedPart&)>& visit) {
  scene::for_each_traced_kind(scene, [&](const scene::TracedKind& kind, int first_thing) {
    FixedTracedParts parts(first_thing, visit);
    kind.trace(scene, parts);
  });
}

Bounds bounds_of_fixed_parts(const scene::Scene& scene, bool with_hidden) {
  Bounds bounds;
  for_each_fixed_opaque_part(scene, [&](const FixedPart& part) {
    if (with_hidden || part.is_visible) bounds.add(transformed(part.world_from_mesh, part.mesh.bounds()));
  });
  return bounds;
}

void add_fixed_parts(const scene::Scene& scene, shading::Heightfield& heights) {
  for_each_fixed_opaque_part(scene, [&](const FixedPart& part) {
    if (part.is_visible) heights.add(part.mesh, part.world_from_mesh);
  });
}

}  // namespace parvis::render
