#include "curved_reflectors/reflector_sources.h"

#include <algorithm>

namespace parvis::curved_reflectors {
namespace {

constexpr int texels_a_face_texel =
    4;                           // a map's side, for the resolution that scripts give for a cube map's face
constexpr int glass_side = 512;  // texels: smooth bodies to a hundredth of a degree

std::string name_of(const scene::Object& object) {
  if (!object.name.empty()) return object.name;
  return object.model->name.empty() ? "reflector" : object.model->name;
}

/// The parts of a model at rest whose materials are `wanted`, in one piece.
Mesh mesh_of(const scene::Model& model, bool (*wanted)(const scene::Material&)) {
  Mesh mesh;
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const scene::Part& part : model.parts)
    if (wanted(model.materials[std::size_t(part.material)]))
      append(mesh, part.mesh, pose[std::size_t(part.node)]);
  return mesh;
}

}  // namespace

ReflectorSource mirror_source(const scene::Scene& scene, const scene::Object& object) {
  const auto mirrors = [](const scene::Material& material) { return material.is_mirror_like; };
  return {name_of(object), mesh_of(*object.model, mirrors),
          texels_a_face_texel * scene.reflection.resolution};
}

bool is_glass(const scene::Material& material) { return material.refracts() && material.is_mirror_like; }

bool has_glass(const scene::Model& model) { return std::ranges::any_of(model.materials, is_glass); }

bool has_glass(const scene::Scene& scene) {
  return std::ranges::any_of(scene.objects, [](const scene::Object& object) {
    return object.takes_reflection && has_glass(*object.model);
  });
}

ReflectorSource glass_source(const scene::Object& object) {
  return {name_of(object), mesh_of(*object.model, is_glass), glass_side};
}

}  // namespace parvis::curved_reflectors
