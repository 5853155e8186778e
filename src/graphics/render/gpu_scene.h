// The scene's models on the GPU: triangles, one texture per image, one uniform block per material; and its
// items: every part of every object, with bounds and transform, in flat arrays.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "graphics/gl/objects.h"
#include "graphics/render/drawable.h"
#include "graphics/render/gpu_geometry.h"
#include "graphics/render/gpu_vertex_light.h"
#include "graphics/render/view.h"
#include "graphics/shading/body_shade.h"
#include "scene/data/scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::render {

/// Index range of a part at a coarser level of detail.
struct LevelRange : MeshRange {
  float error_m;  ///< in the node's frame
};

/// A part of a model, or of one object whose mesh deforms.
struct PartRange : MeshRange {
  int material;  ///< of the GPU scene
  int node;
  Bounds bounds;  ///< in the node's frame
  bool casts_shadow;
  bool is_backdrop;              ///< scene::Part::is_backdrop
  int first_level, level_count;  ///< of the scene's `levels`, coarser and coarser
};

/// Features that the surface shader is compiled for, by material.
enum SurfaceFeature : std::uint16_t {
  surface_has_normal_map = 1,
  surface_has_surface_map = 2,
  surface_has_emission_map = 4,
  surface_has_coat = 8,
  surface_has_backs = 16,
  surface_has_holes = 32,
  surface_is_leaf = 64,  ///< cut out and translucent: small, many, in many layers
  surface_has_relief = 128,
  surface_is_glass = 256,          ///< solid: refracts light
  surface_has_vertex_light = 512,  ///< of single objects, not of the material: their diffuse light is given
  surface_has_own_mappings = 1024,
  surface_has_colours = 2048,  ///< at the vertices of a part of this material
  surface_has_occlusion_map = 4096
};

/// True if hardware anisotropic filtering is affordable: on Mesa's software renderer it takes 30 times as
/// long.
bool has_fast_anisotropy();

/// A texture of the picture and of its levels: scene::smaller_mip_levels.
gl::Texture mipmapped(const scene::Texture& source, const std::vector<Image8>& smaller);

/// A material as the GPU scene draws it; textures belong to the GPU scene.
struct GpuMaterial {
  GLuint base_colour, normal, surface, emission,
      occlusion;  ///< textures; plain ones where the material has none
  Pass pass;
  bool is_double_sided, is_mirror_like;
  std::uint16_t features;  ///< of SurfaceFeature
};

/// One part of one object. `record` is its per-instance vertex data.
struct Item {
  /// Data per instance of the vertex shader, as it lies in the buffer.
  struct Record {
    glm::vec4 rows[3];  ///< of world_from_mesh
    std::uint32_t object;
    glm::ivec2 vertex_data{0};  ///< of mirrored views: what VirtualVertices::add has given
    glm::ivec2 first_light{0};  ///< texels of the vertex light, less the mesh's base vertex: front, behind
  };
  Record record;
  Bounds bounds;  ///< in the world
  int part;
  int object;
  bool is_mirror;  ///< takes the scene's reflection method
  bool casts_shadow;
};

/// The scene on the GPU. Needs a current OpenGL context from creation to destruction.
class GpuScene {
 public:
  explicit GpuScene(const scene::Scene& scene);

  /// Copies transforms, poses and visibility from the scene, whose objects are those of the last call and new
  /// ones behind them.
  void update(const scene::Scene& scene);
  /// Static objects that appeared, vanished or moved in the last update.
  const FixedChange& fixed_change() const { return fixed_change_; }
  /// True if a static object appeared or was moved in the last update.
  bool is_newcomer(int object) const { return is_newcomer_[std::size_t(object)] != 0; }

  /// All parts: first those of the models, then those of paints, then those of deforming objects.
  const std::vector<PartRange>& parts() const { return parts_; }
  /// Coarser levels of detail of a part, coarser from one to the next; empty where it has none.
  std::span<const LevelRange> levels_of(const PartRange& part) const {
    return std::span(levels_).subspan(std::size_t(part.first_level), std::size_t(part.level_count));
  }
  /// All materials; PartRange::material is an index into them.
  const std::vector<GpuMaterial>& materials() const { return materials_; }
  /// The materials of all items that are mirrors.
  std::vector<GpuMaterial> mirror_materials() const;
  const std::vector<Item>& items() const { return items_; }  ///< ordered by object, then by part of its model
  /// Index of an object's first item; its other parts follow in the order of the model.
  std::uint32_t first_item(int object) const { return first_item_[std::size_t(object)]; }
  /// World bounds of each object, over all its parts.
  const std::vector<Bounds>& object_bounds() const { return object_bounds_; }
  /// Transform of an object as of the last update.
  const glm::mat4& world_from_model(int object) const { return world_from_model_[std::size_t(object)]; }
  /// World bounds of all static objects, hidden ones included, without backdrops and what surrounds the
  /// place.
  Bounds fixed_bounds() const;
  /// World bounds of every visible dynamic object.
  const std::vector<Bounds>& moving_bounds() const { return moving_bounds_; }
  /// Shapes of those objects that occlude the sky for surfaces near them.
  const std::vector<shading::Body>& bodies() const { return bodies_; }
  /// True if the object is dynamic.
  bool is_moving(int object) const { return is_moving_[std::size_t(object)] != 0; }
  /// True if the object was visible at the last update.
  bool is_visible(int object) const { return is_visible_[std::size_t(object)] != 0; }

  /// Binds the light of objects that are lit at their vertices (`vertex_light_unit`), if there are any.
  void bind_vertex_light() const { vertex_light_.bind(); }
  /// Binds a material's textures (units 0 to 3) and uniform block (binding 1).
  void bind_material(int material) const;
  /// Enables or disables back-face culling in OpenGL.
  static void cull_faces(bool culls);
  /// Buffer of GpuGeometry::Vertex, for vertex arrays of drawables.
  GLuint vertex_buffer() const { return geometry_.vertex_buffer(); }
  GLuint detail_buffer() const { return geometry_.detail_buffer(); }  ///< GpuGeometry::Detail; may be 0
  GLuint index_buffer() const { return geometry_.index_buffer(); }    ///< 32-bit indices

 private:
  void add_objects(const scene::Scene& scene);
  std::vector<const scene::Model*> add_models(const scene::Scene& scene);
  void add_surface_levels(const scene::Scene& scene);
  void add_foliage_levels(const scene::Scene& scene, const std::vector<const scene::Model*>& models);
  void add_painted_parts(const scene::Scene& scene, std::size_t first_object);
  void add_deformed_parts(const scene::Scene& scene, std::size_t first_object);
  void add_lit_parts(const scene::Scene& scene, std::size_t first_object);
  void deform(const scene::Object& object, std::size_t o);
  void upload_textures(const scene::Model& model);
  int add_materials(const scene::Model& model, const std::vector<scene::Material>& materials);
  void make_items(const scene::Scene& scene, std::size_t first_object);
  void follow_shadow_wishes(const scene::Scene& scene);
  void place(const scene::Scene& scene, std::size_t object);
  void find_body_shapes(const scene::Scene& scene, std::size_t first_object);
  void add_body(const scene::Object& object, std::size_t o);
  bool hides_sky(const PartRange& part) const;
  GLuint plain_texture(glm::u8vec4 colour);

  std::unordered_map<const scene::Model*, int> first_part_of_model_;
  std::unordered_map<const scene::Model*, std::size_t> first_texture_of_model_;
  std::unordered_set<const scene::Model*> levelled_;  ///< whose surfaces have their levels
  std::map<std::pair<const scene::Model*, const void*>, int> first_painted_part_;  ///< of a model in a paint
  std::unordered_map<int, int>
      lit_material_;             ///< the same material for objects that are lit at their vertices
  scene::SunShadows shadows_;    ///< as the items have it
  std::vector<int> first_part_;  ///< of each object, in parts_: its model's, its paint's, or its own
  GpuGeometry geometry_;
  GpuVertexLight vertex_light_;
  std::vector<PartRange> parts_;
  std::vector<LevelRange> levels_;
  std::vector<GpuMaterial> materials_;
  std::vector<gl::Texture> textures_;
  gl::Buffer material_blocks_;
  std::vector<std::byte> material_bytes_;
  GLint block_stride_ = 256;
  GLuint white_ = 0, flat_normal_ = 0;

  std::vector<Item> items_;
  std::vector<std::uint32_t> first_item_;  ///< of each object, and the end
  std::vector<Bounds> object_bounds_;
  std::vector<Bounds> near_bounds_;  ///< the same without backdrops
  std::vector<std::uint8_t> is_moving_, is_visible_, is_newcomer_;
  std::vector<std::uint8_t>
      surrounds_;  ///< of each object: it surrounds the place (scene/data/surroundings.h)
  std::vector<glm::mat4> world_from_model_;  ///< of each object, as it was placed last
  std::vector<Bounds> moving_bounds_;
  std::unordered_map<const scene::Model*, shading::BodyShape> body_shapes_;  ///< of dynamic objects
  std::vector<shading::Body> bodies_;
  FixedChange fixed_change_;
  std::vector<std::vector<glm::mat4>> rest_poses_;  ///< of each object's model
};

}  // namespace parvis::render
