#include "scene/data/scene_key.h"

#include <unordered_map>

#include "base/content_hash.h"

namespace parvis::scene {
namespace {

void add_material(ContentHash& hash, const Material& m) {
  for (const glm::vec3 colour : {m.base_colour, m.emission, m.absorption_per_m}) hash.add(colour);
  for (const float value :
       {m.alpha, m.metallic, m.roughness, m.clear_coat, m.clear_coat_roughness, m.translucency,
        m.normal_scale, m.relief_m, m.ior, m.alpha_cutoff, m.occlusion_strength})
    hash.add(value);
  for (const int texture :
       {m.base_colour_texture, m.normal_texture, m.surface_texture, m.emission_texture, m.occlusion_texture})
    hash.add(texture);
  hash.add(m.texture_from_mesh_uv);
  if (m.own_mappings)
    for (const TextureMapping& mapping : {m.own_mappings->normal, m.own_mappings->surface,
                                          m.own_mappings->emission, m.own_mappings->occlusion})
      hash.add(mapping.texture_from_uv), hash.add(mapping.takes_second_uvs);
  hash.add(m.alpha_mode);
  for (const bool choice : {m.is_double_sided, m.is_mirror_like}) hash.add(choice);
}

std::uint64_t model_key(const Model& model) {
  ContentHash hash;
  for (const Texture& texture : model.textures) {
    hash.add(texture.image.width);
    hash.add(texture.image.pixels);
    hash.add(texture.is_srgb), hash.add(texture.wrap_u), hash.add(texture.wrap_v);
  }
  for (const Material& material : model.materials) add_material(hash, material);
  for (const glm::mat4& pose : rest_pose(model)) hash.add(pose);
  for (const Part& part : model.parts) {
    hash.add(part.mesh.positions);
    hash.add(part.mesh.normals);
    hash.add(part.mesh.uvs);
    hash.add(part.mesh.second_uvs);
    hash.add(part.mesh.colours);
    hash.add(part.mesh.indices);
    const int role = int(part.casts_shadow) + 2 * int(part.is_backdrop);
    for (const int index : {part.material, part.node, role}) hash.add(index);
  }
  return hash.value();
}

/// `counts`: the objects, `counts_data`: the roles of rooms' data, on which the key depends.
template <class Counts, class CountsData>
void add_things(ContentHash& hash, const Scene& scene, Counts&& counts, CountsData&& counts_data) {
  std::unordered_map<const Model*, std::uint64_t> models;
  for (const Object& object : scene.objects) {
    if (!counts(object)) continue;
    const auto [entry, is_new] = models.try_emplace(object.model.get(), 0);
    if (is_new) entry->second = model_key(*object.model);
    hash.add(entry->second);
    if (object.paint)
      for (const Material& material : *object.paint) add_material(hash, material);
    hash.add(object.world_from_model);
    hash.add(object.pose);
    for (const Mesh& mesh : object.deformed_meshes) {
      hash.add(mesh.positions);
      hash.add(mesh.normals);
    }
    for (const bool choice : {object.is_visible, object.takes_reflection}) hash.add(choice);
  }
  scene.room_data.hash(hash, counts_data);
}

void add_light(ContentHash& hash, const Scene& scene) {
  for (const glm::vec3 v : {scene.sun.direction_to_sun, scene.sun.irradiance}) hash.add(v);
  hash.add(scene.sky.picture.width);
  hash.add(scene.sky.picture.pixels);
  for (const float value : {scene.sky.intensity, scene.sky.heading, scene.haze_per_m}) hash.add(value);
}

void add_fixed_things(ContentHash& hash, const Scene& scene) {
  add_things(
      hash, scene, [](const Object& object) { return !object.is_dynamic && object.is_visible; },
      [](DataRole role) { return role == DataRole::static_content; });
}

}  // namespace

std::uint64_t scene_key(const Scene& scene) {
  ContentHash hash;
  add_things(
      hash, scene, [](const Object&) { return true; },
      [](DataRole role) { return role != DataRole::settings; });
  add_light(hash, scene);
  return hash.value();
}

std::uint64_t fixed_scene_key(const Scene& scene) {
  ContentHash hash;
  add_fixed_things(hash, scene);
  add_light(hash, scene);
  return hash.value();
}

std::uint64_t fixed_shape_key(const Scene& scene) {
  ContentHash hash;
  add_fixed_things(hash, scene);
  return hash.value();
}

}  // namespace parvis::scene
