#include "graphics/render/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <glm/gtc/type_precision.hpp>
#include <utility>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "graphics/gl/context.h"
#include "graphics/render/bindings.h"
#include "graphics/render/foliage_levels.h"
#include "graphics/render/mesh_levels.h"
#include "graphics/shading/glsl.h"
#include "scene/data/leaf_openness.h"
#include "scene/data/mip_levels.h"
#include "scene/data/shadow_proxies.h"
#include "scene/data/surroundings.h"
#include "scene/data/vertex_irradiance.h"

namespace parvis::render {
namespace {

using uint = std::uint32_t;
#include "graphics/render/object_flags.glsl"

using glm::vec4;
#include "graphics/render/material_block.glsl"

Material block_of(const scene::Material& material) {
  const glm::mat3 rows = glm::transpose(material.texture_from_mesh_uv);
  Material block{};
  const float alpha_scale = material.alpha_mode == scene::Alpha::cutout ? 0.5f / material.alpha_cutoff : 1.0f;
  block.material_base_colour = vec4(material.base_colour, alpha_scale * material.alpha);
  block.material_emission = vec4(material.emission, material.normal_scale);
  block.material_layers = {material.metallic, material.roughness, material.clear_coat,
                           material.clear_coat_roughness};
  block.material_texture_u = vec4(rows[0], material.translucency);
  block.material_texture_v = vec4(rows[1], material.alpha_mode == scene::Alpha::cutout ? 1.0f : 0.0f);
  block.material_relief_m = material.relief_m;
  block.material_mirrors = material.is_mirror_like ? 1.0f : 0.0f;
  block.material_ior = material.ior;
  block.material_occlusion = material.occlusion_strength;
  if (!material.own_mappings) return block;
  const auto put = [](const scene::TextureMapping& mapping, vec4& u, vec4& v) {
    const glm::mat3 own_rows = glm::transpose(mapping.texture_from_uv);
    u = vec4(own_rows[0], mapping.takes_second_uvs ? 1.0f : 0.0f), v = vec4(own_rows[1], 0.0f);
  };
  put(material.own_mappings->normal, block.material_normal_u, block.material_normal_v);
  put(material.own_mappings->surface, block.material_surface_u, block.material_surface_v);
  put(material.own_mappings->emission, block.material_emission_u, block.material_emission_v);
  put(material.own_mappings->occlusion, block.material_occlusion_u, block.material_occlusion_v);
  return block;
}

Pass pass_of(scene::Alpha alpha) {
  switch (alpha) {
    case scene::Alpha::opaque:
      return Pass::opaque;
    case scene::Alpha::cutout:
      return Pass::cutout;
    case scene::Alpha::blend:
      return Pass::blend;
  }
  return Pass::opaque;
}

gl::Texture upload(const scene::Texture& source, const std::vector<Image8>& smaller) {
  gl::Texture texture = mipmapped(source, smaller);
  glTextureParameterf(texture.name(), GL_TEXTURE_MAX_ANISOTROPY, has_fast_anisotropy() ? 16.0f : 1.0f);
  constexpr GLint wraps[]{GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE};  // in the order of scene::Wrap
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, wraps[std::size_t(source.wrap_u)]);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, wraps[std::size_t(source.wrap_v)]);
  return texture;
}

std::uint16_t features_of(const scene::Material& material) {
  std::uint16_t features = 0;
  if (material.refracts()) features |= surface_is_glass;
  if (material.normal_texture != scene::no_index) {
    features |= surface_has_normal_map;
    if (material.relief_m > 0.0f) features |= surface_has_relief;
  }
  if (material.surface_texture != scene::no_index) features |= surface_has_surface_map;
  if (material.emission_texture != scene::no_index) features |= surface_has_emission_map;
  if (material.occlusion_texture != scene::no_index) features |= surface_has_occlusion_map;
  if (material.own_mappings) features |= surface_has_own_mappings;
  if (material.clear_coat > 0.0f) features |= surface_has_coat;
  if (material.is_double_sided) features |= surface_has_backs;
  if (material.alpha_mode == scene::Alpha::cutout) features |= surface_has_holes;
  if (scene::is_foliage(material)) features |= surface_is_leaf;
  return features;
}

}  // namespace

gl::Texture mipmapped(const scene::Texture& source, const std::vector<Image8>& smaller) {
  gl::Texture texture = gl::texture_2d(source.is_srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, source.image.width,
                                       source.image.height, 1 + int(smaller.size()));
  for (std::size_t level = 0; level <= smaller.size(); ++level) {
    const Image8& image = level == 0 ? source.image : smaller[level - 1];
    glTextureSubImage2D(texture.name(), GLint(level), 0, 0, image.width, image.height, GL_RGBA,
                        GL_UNSIGNED_BYTE, image.pixels.data());
  }
  return texture;
}

bool has_fast_anisotropy() {
  static const bool is_fast = !gl::is_software();
  return is_fast;
}

GpuScene::GpuScene(const scene::Scene& scene) {
  white_ = plain_texture({255, 255, 255, 255});
  flat_normal_ = plain_texture({128, 128, 255, 255});
  glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &block_stride_);
  block_stride_ = (GLint(sizeof(Material)) + block_stride_ - 1) / block_stride_ * block_stride_;

  add_objects(scene);
  std::ranges::transform(scene.objects, is_visible_.begin(), &scene::Object::is_visible);
}

/// Adds all objects of the scene that are not there yet; hidden until the next update.
void GpuScene::add_objects(const scene::Scene& scene) {
  const std::size_t first_object = first_part_.size(), known_materials = materials_.size();
  const std::vector<const scene::Model*> models = add_models(scene);
  add_surface_levels(scene);
  add_foliage_levels(scene, models);
  add_painted_parts(scene, first_object);
  add_deformed_parts(scene, first_object);
  add_lit_parts(scene, first_object);
  geometry_.upload();
  if (materials_.size() > known_materials)
    material_blocks_ = gl::immutable_buffer(std::span<const std::byte>(material_bytes_));
  make_items(scene, first_object);
}

GLuint GpuScene::plain_texture(glm::u8vec4 colour) {
  textures_.push_back(gl::texture_2d(GL_RGBA8, 1, 1));
  glTextureSubImage2D(textures_.back().name(), 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &colour);
  return textures_.back().name();
}

/// Returns those that are new.
std::vector<const scene::Model*> GpuScene::add_models(const scene::Scene& scene) {
  const auto& leaves = scene.data<scene::LeafOpenness>();
  std::vector<const scene::Model*> models;
  for (std::size_t o = first_part_.size(); o < scene.objects.size(); ++o) {
    const scene::Model& model = *scene.objects[o].model;
    const auto [first, is_new] = first_part_of_model_.try_emplace(&model, int(parts_.size()));
    first_part_.push_back(first->second);
    if (!is_new) continue;
    models.push_back(&model);
    upload_textures(model);
    const int first_material = add_materials(model, model.materials);
    for (std::size_t p = 0; p < model.parts.size(); ++p) {
      const scene::Part& part = model.parts[p];
      const bool lets_through = part.is_backdrop || model.materials[std::size_t(part.material)].refracts();
      parts_.push_back({geometry_.add(part.mesh, leaves.of(model, p)), first_material + part.material,
                        part.node, part.mesh.bounds(), part.casts_shadow && !lets_through, part.is_backdrop,
                        0, 0});
    }
  }
  return models;
}

/// Adds levels for dynamic objects and for models placed many times: only they are far away as a whole.
void GpuScene::add_surface_levels(const scene::Scene& scene) {
  std::unordered_map<const scene::Model*, int> uses;
  for (const scene::Object& object : scene.objects) uses[object.model.get()] += object.is_dynamic ? 2 : 1;
  std::vector<std::pair<const Mesh*, PartRange*>> wanted;
  for (const auto& [model, first_part] : first_part_of_model_) {
    if (uses[model] <= 1 || !levelled_.insert(model).second) continue;
    for (std::size_t p = 0; p < model->parts.size(); ++p) {
      const scene::Part& part = model->parts[p];
      const bool is_opaque = model->materials[std::size_t(part.material)].alpha_mode == scene::Alpha::opaque;
      if (is_opaque && !part.deformation)
        wanted.emplace_back(&part.mesh, &parts_[std::size_t(first_part) + p]);
    }
  }
  std::vector<std::vector<MeshLevel>> levels(wanted.size());
  parallel_for(wanted.size(), [&](std::size_t i) { levels[i] = coarser_levels(*wanted[i].first); });
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    PartRange& part = *wanted[i].second;
    part.first_level = int(levels_.size());
    part.level_count = int(levels[i].size());
    for (const MeshLevel& level : levels[i])
      levels_.push_back({geometry_.add_triangles(part, level.indices), level.error_m});
  }
}

/// Adds levels for all foliage: one tree alone has more leaves than a picture shows from across a street.
void GpuScene::add_foliage_levels(const scene::Scene& scene, const std::vector<const scene::Model*>& models) {
  struct Foliage {
    const Mesh* mesh;
    std::span<const float> openness, max_seen;
    PartRange* part;
  };
  const auto& leaves = scene.data<scene::LeafOpenness>();
  std::vector<Foliage> foliage;
  for (const scene::Model* model : models)
    for (std::size_t p = 0; p < model->parts.size(); ++p) {
      PartRange& part = parts_[std::size_t(first_part_of_model_.at(model)) + p];
      const bool is_leaf = (materials_[std::size_t(part.material)].features & surface_is_leaf) != 0;
      if (is_leaf && !model->parts[p].deformation)
        foliage.push_back({&model->parts[p].mesh, leaves.of(*model, p), leaves.max_seen(*model, p), &part});
    }
  std::uint64_t bytes = 0;
  for (const Foliage& each : foliage) bytes += max_level_bytes(*each.mesh);
  if (bytes > memory_left()) return;  // the picture needs none of them
  std::vector<std::vector<FoliageLevel>> levels(foliage.size());
  parallel_for(foliage.size(),
               [&](std::size_t i) { levels[i] = foliage_levels(*foliage[i].mesh, foliage[i].max_seen); });
  for (std::size_t i = 0; i < foliage.size(); ++i) {
    PartRange& part = *foliage[i].part;
    part.first_level = int(levels_.size());
    part.level_count = int(levels[i].size());
    for (const FoliageLevel& level : levels[i]) {
      std::vector<float> openness;
      if (!foliage[i].openness.empty())
        for (const std::uint32_t vertex : level.vertices) openness.push_back(foliage[i].openness[vertex]);
      levels_.push_back({geometry_.add(level.mesh, openness), level.error_m});
    }
  }
}

/// Objects of one paint have parts and materials of their own, over the geometry and textures of their model.
void GpuScene::add_painted_parts(const scene::Scene& scene, std::size_t first_object) {
  for (std::size_t o = first_object; o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    if (!object.paint) continue;
    const auto [painted, is_new] =
        first_painted_part_.try_emplace({object.model.get(), object.paint.get()}, int(parts_.size()));
    const std::size_t first = std::size_t(std::exchange(first_part_[o], painted->second));
    if (!is_new) continue;
    assert(object.paint->size() == object.model->materials.size());
    const int first_material = add_materials(*object.model, *object.paint);
    for (std::size_t p = 0; p < object.model->parts.size(); ++p) {
      parts_.push_back(PartRange(parts_[first + p]));
      parts_.back().material = first_material + object.model->parts[p].material;
    }
  }
}

/// An object that deforms has parts of its own: those of its model, with other vertices where a mesh deforms.
void GpuScene::add_deformed_parts(const scene::Scene& scene, std::size_t first_object) {
  for (std::size_t o = first_object; o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    if (object.deformed_meshes.empty()) continue;
    const std::size_t first = std::size_t(std::exchange(first_part_[o], int(parts_.size())));
    for (std::size_t p = 0; p < object.model->parts.size(); ++p) {
      parts_.push_back(PartRange(parts_[first + p]));
      if (!object.model->parts[p].deformation) continue;
      static_cast<MeshRange&>(parts_.back()) = geometry_.add_deforming(object.mesh(p));
      parts_.back().level_count = 0;
    }
  }
}

/// An object that is lit at its vertices has parts and materials of its own, over the geometry of its model.
void GpuScene::add_lit_parts(const scene::Scene& scene, std::size_t first_object) {
  const auto& lit = scene.data<scene::VertexIrradiance>();
  for (std::size_t o = first_object; o < scene.objects.size(); ++o) {
    if (!lit.of(o)) continue;
    const bool has_own = !scene.objects[o].deformed_meshes.empty();
    const std::size_t first = std::size_t(first_part_[o]);
    if (!has_own) first_part_[o] = int(parts_.size());
    for (std::size_t p = 0; p < scene.objects[o].model->parts.size(); ++p) {
      if (!has_own) parts_.push_back(PartRange(parts_[first + p]));
      PartRange& part = parts_[std::size_t(first_part_[o]) + p];
      for (const LevelRange& level : levels_of(part))
        if (level.base_vertex != part.base_vertex) part.level_count = 0;  // light is given for its vertices
      const auto [material, is_new] = lit_material_.try_emplace(part.material, int(materials_.size()));
      if (is_new) {
        materials_.push_back(GpuMaterial(materials_[std::size_t(part.material)]));
        materials_.back().features |= surface_has_vertex_light;
        const std::size_t stride = std::size_t(block_stride_), offset = material_bytes_.size();
        material_bytes_.resize(offset + stride);
        std::memcpy(material_bytes_.data() + offset,
                    material_bytes_.data() + std::size_t(part.material) * stride, stride);
      }
      part.material = material->second;
    }
  }
  vertex_light_.reserve(scene);
}

void GpuScene::deform(const scene::Object& object, std::size_t o) {
  for (std::size_t p = 0; p < object.deformed_meshes.size(); ++p) {
    if (!object.model->parts[p].deformation) continue;
    PartRange& part = parts_[std::size_t(first_part_[o]) + p];
    part.bounds = object.mesh(p).bounds();
    geometry_.deform(part, object.mesh(p));
  }
}

void GpuScene::upload_textures(const scene::Model& model) {
  first_texture_of_model_[&model] = textures_.size();
  const std::vector<int> visible = scene::visible_alphas(model);
  constexpr std::size_t at_once = 8;  // whose levels wait in memory
  for (std::size_t first = 0; first < model.textures.size(); first += at_once) {
    std::array<std::vector<Image8>, at_once> levels;
    const std::size_t count = std::min(at_once, model.textures.size() - first);
    parallel_for(count, [&](std::size_t i) {
      levels[i] = scene::smaller_mip_levels(model.textures[first + i], visible[first + i]);
    });
    for (std::size_t i = 0; i < count; ++i) textures_.push_back(upload(model.textures[first + i], levels[i]));
  }
}

/// Adds materials of a model whose textures are there. Returns the index of the first.
int GpuScene::add_materials(const scene::Model& model, const std::vector<scene::Material>& materials) {
  const std::size_t first_texture = first_texture_of_model_.at(&model);
  const int first = int(materials_.size());
  std::vector<bool> has_colours(materials.size(), false);
  const auto texture_or = [&](int index, GLuint plain) {
    return index == scene::no_index ? plain : textures_[first_texture + std::size_t(index)].name();
  };
  for (const scene::Part& part : model.parts)
    if (!part.mesh.colours.empty()) has_colours[std::size_t(part.material)] = true;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const scene::Material& material = materials[m];
    materials_.push_back(
        {texture_or(material.base_colour_texture, white_), texture_or(material.normal_texture, flat_normal_),
         texture_or(material.surface_texture, white_), texture_or(material.emission_texture, white_),
         texture_or(material.occlusion_texture, white_), pass_of(material.alpha_mode),
         material.is_double_sided, material.is_mirror_like, features_of(material)});
    if (has_colours[m]) materials_.back().features |= surface_has_colours;
    const Material block = block_of(material);
    const std::size_t offset = material_bytes_.size();
    material_bytes_.resize(offset + std::size_t(block_stride_));
    std::memcpy(material_bytes_.data() + offset, &block, sizeof(block));
  }
  return first;
}

void GpuScene::make_items(const scene::Scene& scene, std::size_t first_object) {
  follow_shadow_wishes(scene);
  const auto& proxies = scene.data<scene::ShadowProxies>();
  if (!first_item_.empty()) first_item_.pop_back();
  for (std::size_t o = first_object; o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    first_item_.push_back(std::uint32_t(items_.size()));
    is_moving_.push_back(object.is_dynamic);
    surrounds_.push_back(scene::surrounds_place(scene, object));
    is_visible_.push_back(false);
    is_newcomer_.push_back(false);
    rest_poses_.push_back(scene::rest_pose(*object.model));
    const int first = first_part_[o];
    for (std::size_t p = 0; p < object.model->parts.size(); ++p) {
      const int part = first + int(p);
      const GpuMaterial& material = materials_[std::size_t(parts_[std::size_t(part)].material)];
      const std::uint32_t flags = shadows_.receives(o) ? 0 : no_shadow_received;
      const glm::ivec2 light = vertex_light_.first_texels(o, p) - parts_[std::size_t(part)].base_vertex;
      items_.push_back({{{}, std::uint32_t(o) | flags, {}, light},
                        {},
                        part,
                        int(o),
                        object.takes_reflection && material.is_mirror_like,
                        shadows_.casts(o) && !proxies.of(o) && parts_[std::size_t(part)].casts_shadow});
    }
  }
  first_item_.push_back(std::uint32_t(items_.size()));
  object_bounds_.resize(scene.objects.size()), near_bounds_.resize(scene.objects.size());
  world_from_model_.resize(scene.objects.size());
  for (std::size_t o = first_object; o < scene.objects.size(); ++o) {
    deform(scene.objects[o], o);
    place(scene, o);
  }
  find_body_shapes(scene, first_object);
}

/// Which objects cast and receive shadows may change with the groups that a scene names.
void GpuScene::follow_shadow_wishes(const scene::Scene& scene) {
  const auto& shadows = scene.data<scene::SunShadows>();
  if (shadows_.casts_none == shadows.casts_none && shadows_.receives_none == shadows.receives_none) return;
  const auto& proxies = scene.data<scene::ShadowProxies>();
  for (Item& item : items_) {
    const std::size_t o = std::size_t(item.object);
    const bool casts = shadows.casts(o) && !proxies.of(o) && parts_[std::size_t(item.part)].casts_shadow;
    if (casts != item.casts_shadow) fixed_change_.come.push_back(item.bounds);
    item.casts_shadow = casts;
    item.record.object = std::uint32_t(o) | (shadows.receives(o) ? 0 : no_shadow_received);
  }
  shadows_ = shadows;
}

void GpuScene::place(const scene::Scene& scene, std::size_t o) {
  const scene::Object& object = scene.objects[o];
  const std::vector<glm::mat4>& pose = object.pose.empty() ? rest_poses_[o] : object.pose;
  Bounds bounds, near_bounds;
  for (std::uint32_t i = first_item_[o]; i < first_item_[o + 1]; ++i) {
    Item& item = items_[i];
    const PartRange& part = parts_[std::size_t(item.part)];
    const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
    const glm::mat4 rows = glm::transpose(world_from_mesh);
    for (int r = 0; r < 3; ++r) item.record.rows[r] = rows[r];
    item.bounds = transformed(world_from_mesh, part.bounds);
    bounds.add(item.bounds);
    if (!part.is_backdrop) near_bounds.add(item.bounds);
  }
  object_bounds_[o] = bounds, near_bounds_[o] = near_bounds;
  world_from_model_[o] = object.world_from_model;
}

/// A part that light passes (leaves, glass) hides no sky.
bool GpuScene::hides_sky(const PartRange& part) const {
  return part.casts_shadow && materials_[std::size_t(part.material)].pass == Pass::opaque;
}

void GpuScene::find_body_shapes(const scene::Scene& scene, std::size_t first_object) {
  for (std::size_t o = first_object; o < scene.objects.size(); ++o) {
    const scene::Model& model = *scene.objects[o].model;
    if (!is_moving_[o] || body_shapes_.contains(&model)) continue;
    std::vector<shading::BodyMesh> meshes;
    for (std::size_t p = 0; p < model.parts.size(); ++p)
      if (hides_sky(parts_[std::size_t(first_part_[o]) + p]))
        meshes.push_back({&model.parts[p].mesh, rest_poses_[o][std::size_t(model.parts[p].node)]});
    body_shapes_[&model] = shading::body_shape(meshes);
  }
}

void GpuScene::add_body(const scene::Object& object, std::size_t o) {
  const std::vector<glm::mat4>& pose = object.pose.empty() ? rest_poses_[o] : object.pose;
  Bounds in_model;
  for (std::uint32_t i = first_item_[o]; i < first_item_[o + 1]; ++i) {
    const PartRange& part = parts_[std::size_t(items_[i].part)];
    if (hides_sky(part)) in_model.add(transformed(pose[std::size_t(part.node)], part.bounds));
  }
  const shading::BodyShape& shape = body_shapes_.at(object.model.get());
  if (const auto body = shading::body_of(in_model, shape, object.world_from_model, int(o)))
    bodies_.push_back(*body);
}

void GpuScene::update(const scene::Scene& scene) {
  assert(scene.objects.size() >= object_bounds_.size());
  moving_bounds_.clear();
  bodies_.clear();
  fixed_change_ = {};
  if (scene.objects.size() > object_bounds_.size()) add_objects(scene);
  follow_shadow_wishes(scene);
  is_newcomer_.assign(scene.objects.size(), 0);
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    const bool was_visible = std::exchange(is_visible_[o], object.is_visible) != 0;
    if (is_moving_[o]) {
      if (object.is_visible) deform(object, o);
      place(scene, o);
      if (!object.is_visible) continue;
      if (!object_bounds_[o].empty()) moving_bounds_.push_back(object_bounds_[o]);
      add_body(object, o);
    } else if (was_visible != object.is_visible || world_from_model_[o] != object.world_from_model) {
      if (was_visible) fixed_change_.gone.push_back(object_bounds_[o]);
      place(scene, o);
      if (object.is_visible) fixed_change_.come.push_back(object_bounds_[o]);
      is_newcomer_[o] = object.is_visible;
    }
  }
  geometry_.upload_deformed();
  vertex_light_.update(scene);
}

std::vector<GpuMaterial> GpuScene::mirror_materials() const {
  std::vector<GpuMaterial> mirrors;
  for (const Item& item : items_)
    if (item.is_mirror) mirrors.push_back(materials_[std::size_t(parts_[std::size_t(item.part)].material)]);
  return mirrors;
}

Bounds GpuScene::fixed_bounds() const {
  Bounds bounds;
  for (std::size_t o = 0; o < near_bounds_.size(); ++o)
    if (!is_moving_[o] && !surrounds_[o]) bounds.add(near_bounds_[o]);
  return bounds;
}

void GpuScene::bind_material(int index) const {
  const GpuMaterial& material = materials_[std::size_t(index)];
  const GLuint textures[]{material.base_colour, material.normal, material.surface, material.emission};
  glBindTextures(0, 4, textures);
  if (material.features & surface_has_occlusion_map) glBindTextureUnit(occlusion_unit, material.occlusion);
  glBindBufferRange(GL_UNIFORM_BUFFER, material_block, material_blocks_.name(),
                    GLintptr(index) * block_stride_, GLsizeiptr(sizeof(Material)));
  cull_faces(!material.is_double_sided);
}

void GpuScene::cull_faces(bool culls) {
  if (culls)
    glEnable(GL_CULL_FACE);
  else
    glDisable(GL_CULL_FACE);
}

}  // namespace parvis::render
