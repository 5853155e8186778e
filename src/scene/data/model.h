// The content of a model file: parts (a mesh and a material each) under a tree of nodes, with textures and
// animations. Plain data in flat arrays, read by the GPU scene and the ray tracer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/mesh.h"
#include "scene/data/animation.h"
#include "scene/data/deformation.h"
#include "scene/data/file_account.h"
#include "scene/data/road.h"

namespace parvis::scene {

inline constexpr int no_index = -1;

/// The way in which a texture continues beyond its edges, along one of its axes.
enum class Wrap : std::uint8_t { repeat, mirror, clamp };

/// A texture coordinate where it lies within the texture, 0 to 1.
float wrapped(float coordinate, Wrap wrap);

/// An RGBA image with its sampling state; filtering is always trilinear and anisotropic.
struct Texture {
  std::string name;     ///< as errors name it
  Image8 image;         ///< 4 channels
  bool is_srgb = true;  ///< colour, as against data (normals, roughness)
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;

  /// Both axes at once: whether it repeats, or is clamped.
  void set_repeats(bool repeats) { wrap_u = wrap_v = repeats ? Wrap::repeat : Wrap::clamp; }
};

/// How a material uses its alpha.
enum class Alpha : std::uint8_t {
  opaque,
  cutout,  ///< leaves, railings: visible from Material::alpha_cutoff on; alpha to coverage on the GPU
  blend    ///< contact shadows, panes: drawn after the opaque parts, back to front
};

/// How a texture lies on a mesh.
struct TextureMapping {
  glm::mat3 texture_from_uv{1.0f};
  bool takes_second_uvs = false;  ///< Mesh::second_uvs
};

/// How the textures of a material lie that do not all lie as its base colour does.
struct OwnMappings {
  TextureMapping normal, surface, emission, occlusion;
};

/// The metallic-roughness surface of glTF 2.0, with a clear coat and translucent leaves. The index of a
/// texture is into Model::textures, or `no_index`.
struct Material {
  std::string name;
  glm::vec3 base_colour{0.8f};  ///< linear; multiplies the texture
  float alpha = 1.0f;           ///< multiplies the texture's alpha
  float metallic = 0.0f;
  float roughness = 0.8f;
  float clear_coat = 0.0f;  ///< 0..1: a layer with F0 0.04 over the base
  float clear_coat_roughness = 0.03f;
  float translucency = 0.0f;  ///< 0..1: diffuse light that comes through from the other side (leaves)
  glm::vec3 emission{0.0f};   ///< radiance, multiplies the emission texture
  int base_colour_texture = no_index;
  int normal_texture = no_index;   ///< tangent space, +y toward -v (OpenGL convention of glTF); alpha: relief
  int surface_texture = no_index;  ///< glTF's: G roughness, B metallic; R ambient occlusion (1 = open)
  int emission_texture = no_index;
  int occlusion_texture = no_index;  ///< its R stands for that of the surface texture
  float occlusion_strength = 1.0f;   ///< 0: neither R counts
  float normal_scale = 1.0f;
  /// Refractive index. Above 1 the surface bounds a closed body of solid glass, which refracts light and has
  /// no colour of its own.
  float ior = 1.0f;
  glm::vec3 absorption_per_m{0.0f};  ///< of the glass body
  float thickness_m = 0.005f;        ///< of the glass where its surface is not closed: a pane
  float relief_m = 0.0f;  ///< depth below the surface where the normal texture's alpha is 0; 0: it is flat
  glm::mat3 texture_from_mesh_uv{1.0f};  ///< KHR_texture_transform
  std::optional<OwnMappings> own_mappings = std::nullopt;
  Alpha alpha_mode = Alpha::opaque;
  float alpha_cutoff = 0.5f;  ///< of cutouts; above 0
  bool is_double_sided = false;
  bool is_mirror_like =
      false;  ///< paint, glass, chrome of movable things: takes the scene's reflection method

  /// True if the material is solid glass.
  bool refracts() const { return ior > 1.0f; }
};

/// Triangles of one material that are attached to one node.
struct Part {
  std::string object;  ///< name of the object or group in the file: what material(target=...) matches
  Mesh mesh;           ///< in the node's frame, at rest
  int material = 0;
  int node = 0;
  bool casts_shadow = true;
  bool is_backdrop = false;  ///< stands for all that is far away around a place: it is seen, light passes it
  std::shared_ptr<const Deformation> deformation = nullptr;  ///< null: the mesh is rigid
};

/// A node of the transform tree, at rest.
struct ModelNode {
  std::string name;
  int parent = no_index;  ///< always less than the node's own index
  // In double precision: large translations of a node and its parent cancel to the millimetre.
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z
  glm::dvec3 scale{1.0};
};

/// A model in metres, z up. Node 0, the root, always exists.
struct Model {
  std::string name;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<ModelNode> nodes{ModelNode{}};
  std::vector<Part> parts;
  std::vector<Animation> animations;
  std::vector<Road> roads;  ///< centre lines of roads that the file contains, in the model's frame
  glm::dvec3 origin{0.0};   ///< georeferenced coordinates of the local origin, zero where there are none
  std::string map =
      {};  ///< whose coordinates these are, as formats/terrain/map_projection.h reads it; empty: unknown
  double true_north_deg = 0.0;                           ///< at the origin, clockwise from the y axis
  std::shared_ptr<const FileAccount> account = nullptr;  ///< of its file; null where it was made up

  /// Number of triangles in all parts.
  std::size_t triangle_count() const;
};

/// model_from_node of every node at rest.
std::vector<glm::mat4> rest_pose(const Model& model);
/// The same as it is computed, before it is rounded.
std::vector<glm::dmat4> exact_rest_pose(const Model& model);
/// model_from_node of every node at `time_s` of an animation.
std::vector<glm::mat4> pose_at(const Model& model, const Animation& animation, float time_s);

/// Bounds of all parts at rest, in the model's frame.
Bounds bounds(const Model& model);

}  // namespace parvis::scene
