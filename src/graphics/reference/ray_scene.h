// The scene for ray queries. Static meshes that are placed once are one Embree hierarchy of triangles in the
// world: of hundreds of parts whose boxes overlap a ray would have to enter each. Other meshes have a
// hierarchy each, instanced per object. Rays pass through the holes of cutout parts and the backs of
// single-sided ones, as the renderer draws them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/random.h"
#include "graphics/reference/fine_triangle.h"
#include "graphics/reference/mip_texture.h"
#include "scene/data/leaf_openness.h"
#include "scene/data/scene.h"
#include "scene/data/sun_shadows.h"

// What Embree's handles point to.
struct RTCDeviceTy;
struct RTCGeometryTy;
struct RTCSceneTy;

namespace parvis::reference {

/// A ray in the world: a hit counts between `min_m` and `max_m` along it.
struct Ray {
  glm::vec3 origin, direction;  ///< unit direction
  float min_m = 1e-4f, max_m = 1e30f;
};

/// A part of an object in the world, or a mesh that a room draws by itself.
struct PlacedPart {
  const Mesh* mesh;  ///< the part's, or the object's deformed one
  const scene::Material* material;
  const std::vector<MipTexture>* textures;  ///< of its model
  const scene::TracedSurface* surface;      ///< in place of material and textures; null: they hold
  std::span<const float> openness = {};     ///< of foliage, by vertex: scene::LeafOpenness
  glm::mat4 world_from_mesh;
  glm::mat3 world_from_normal;
  int part = 0;  ///< of the object's model
  int object;    ///< index in the scene; beyond them, of what rooms draw by themselves: for_each_traced_kind
  bool casts_shadow;               ///< in what the renderer draws: a wish of the scene, too
  bool is_painted_shadow = false;  ///< if it is blended: its part casts none by itself (see Passage)
  bool receives_shadow = true;
  bool is_recorded = false;  ///< TracedKind::is_recorded
  bool is_backdrop = false;  ///< scene::Part::is_backdrop
  bool is_mirror;            ///< takes reflections
  bool is_mirrored;          ///< the transform turns right into left, and with it the winding of triangles
  bool is_traced;            ///< else rays pass it: it is hidden, empty, or flattened by its transform
  bool is_joined = false;    ///< its triangles are in the hierarchy of static meshes, in the world
  bool is_filtered = false;  ///< Embree asks about each of its triangles that a ray hits, whatever the query
  Bounds bounds = {};        ///< in the world, as it was last placed or deformed
};

/// Nearest intersection of a ray. `place` belongs to the RayScene.
struct Hit {
  const PlacedPart* place;
  std::uint32_t triangle;
  float u, v;  ///< barycentric weights of the second and third corner
  float distance_m;
};

/// Nearest intersection of a FineRay.
struct FineHit {
  const PlacedPart* place = nullptr;  ///< null: the sky
  std::uint32_t triangle = 0;
  double distance_m = 0.0;
  float u = 0.0f, v = 0.0f;  ///< as Hit's
};

/// How light passes surfaces in a photograph, in contrast to the renderer: every part blocks it from both
/// sides; blended parts block it at random with a probability of their alpha. Contact shadows painted for the
/// renderer (blended parts that cast no shadow) are ignored.
struct Passage {
  Random random{0};
  bool sees_backs = true;  ///< else the backs of single-sided parts are passed, as the renderer draws them
  /// Backdrops are passed, as light always does: what they surround is lit by the sky, not by its picture.
  bool passes_backdrops = false;
};

/// The precision that decides whether a ray hits a triangle, and which it hits first. A scene answers rays of
/// its precision alone.
enum class Precision : unsigned char {
  coarse,  ///< Ray: Embree, in single precision, off by some 1e-7 of the scene's size
  fine     ///< FineRay: double precision, with the corners in the world as the float transforms place them
};

/// Ray queries against the scene. Queries are const and may run on many threads.
class RayScene {
 public:
  /// Rays that are answered together go about the same way, and at most so many.
  static constexpr std::size_t packet_size = 16;

  /// Takes the scene as it stands now, with what rooms draw by themselves (Scene::traced_kinds); it must
  /// outlive this. What a transform flattens or makes infinite is left out.
  explicit RayScene(const scene::Scene& scene, Precision precision = Precision::coarse);
  RayScene(const RayScene&) = delete;
  ~RayScene();

  /// Takes over where objects and traced things stand now, which of them are visible, and how meshes are
  /// deformed. The objects and their models must be those of the scene that this was made of, with new ones
  /// behind them. True where anything has changed.
  bool update(const scene::Scene& scene);
  /// Boxes about what moved, appeared, vanished or was deformed at the last update: of each object or traced
  /// part one before and one after it.
  std::span<const Bounds> moved() const { return moved_; }

  /// Parts of an object of the scene that can be hit, in the model's order.
  std::vector<const PlacedPart*> parts_of(int object) const;

  /// The nearest surface that the renderer would draw along the ray; none: the sky.
  std::optional<Hit> nearest_hit(const Ray& ray) const;
  /// The nearest surface under the rules of a photograph; `passage` supplies the random numbers.
  std::optional<Hit> nearest_hit(const Ray& ray, Passage& passage) const;
  /// True if a shadow caster lies along the ray.
  bool is_blocked(const Ray& ray) const;
  /// The same, but for what photographs show (PlacedPart::is_recorded).
  bool is_blocked_by_inserted(const Ray& ray) const;
  /// True if a surface blocks the ray under the rules of a photograph.
  bool is_blocked(const Ray& ray, Passage& passage) const;
  /// The same, but for what photographs show.
  bool is_blocked_by_inserted(const Ray& ray, Passage& passage) const;
  /// is_blocked of each ray of a packet, each with its own `passages`, or without any as the renderer draws:
  /// bit i is that of ray i.
  std::uint32_t are_blocked(std::span<const Ray> rays, std::span<Passage> passages) const;
  /// nearest_hit of each ray of a packet, each with its own `passages`, or without any as the renderer draws,
  /// into `hits`.
  void nearest_hits(std::span<const Ray> rays, std::span<Passage> passages,
                    std::span<std::optional<Hit>> hits) const;
  /// nearest_hit of each ray of a packet, into `hits`.
  void nearest_hits(std::span<const FineRay> rays, std::span<FineHit> hits) const;
  /// is_blocked of each ray of a packet: bit i is that of ray i.
  std::uint32_t are_blocked(std::span<const FineRay> rays) const;
  /// Bounds of traced geometry without backdrops and dynamic objects of the scene that this was made of.
  Bounds fixed_bounds(const scene::Scene& scene) const;
  std::size_t triangle_count() const { return triangle_count_; }  ///< summed over all placements of a mesh

 private:
  class TracedThings;

  std::optional<Hit> nearest_hit(const Ray& ray, Passage* passage) const;
  bool is_blocked(const Ray& ray, Passage* passage, bool passes_recorded = false) const;
  void add_object(const scene::Object& object, int number);
  PlacedPart part_of(const scene::Model& model, const std::vector<scene::Material>& materials,
                     std::size_t part, const Mesh& mesh, const glm::mat4& world_from_mesh, int number);
  void place(const PlacedPart& part, bool is_visible, bool may_join = false);
  void commit();
  bool move(std::size_t place, const Mesh& mesh, const glm::mat4& world_from_mesh, bool is_visible);
  void add_objects(const scene::Scene& scene);
  void trace_things(const scene::Scene& scene);
  void trace_things_again(const scene::Scene& scene);
  std::vector<std::unique_ptr<PlacedPart>> forget_things();
  void forget_meshes_but_those_placed();
  void join(std::size_t place);
  void leave_joined(std::size_t place);
  RTCGeometryTy* triangles(const Mesh& mesh, const glm::mat4& transform, float margin,
                           bool is_filtered) const;
  static void set_corners(const Mesh& mesh, const glm::mat4& transform, float margin, glm::vec3* corners);
  float margin_in_mesh(const glm::mat4& world_from_mesh) const;
  const std::vector<MipTexture>& textures_of(const scene::Model& model);
  bool is_to_be_filtered(const PlacedPart& part) const;
  RTCSceneTy* mesh_scene(const Mesh& mesh, const glm::mat4& world_from_mesh, bool is_filtered);
  void deform(std::size_t place);

  scene::SunShadows shadows_;
  scene::LeafOpenness leaves_;
  RTCDeviceTy* device_;
  bool has_wide_packets_;  ///< the processor has instructions for packets of 16 rays (AVX-512)
  RTCSceneTy* top_;
  RTCSceneTy* joined_;  ///< triangles in the world, by place: the first instance of `top_`; places follow it
  bool has_other_joined_ = true;                     ///< since it was committed
  std::unordered_map<const Mesh*, int> placed_;      ///< how many parts of objects have the mesh
  std::vector<std::unique_ptr<PlacedPart>> places_;  ///< by instance: parts of objects, then traced things
  std::size_t object_places_ = 0;                    ///< how many of them are parts of objects
  std::size_t object_count_ = 0;                     ///< of the scene
  std::map<std::pair<const Mesh*, bool>, RTCSceneTy*> mesh_scenes_;  ///< with filters and without
  std::unordered_map<const scene::Model*, std::unique_ptr<std::vector<MipTexture>>> textures_;
  std::vector<std::shared_ptr<const void>> kept_;  ///< meshes, models and surfaces of traced things
  std::vector<Bounds> moved_;
  std::size_t triangle_count_ = 0;
  float margin_m_ = 0.0f;  ///< by which triangles are grown; 0: Precision::coarse
};

/// Normal of a triangle in the world, on the side of its front; of any length.
glm::vec3 facet_normal(const PlacedPart& place, std::uint32_t triangle);

/// Texture coordinates of a hit, transformed as the material says.
glm::vec2 texture_coordinates(const PlacedPart& place, std::uint32_t triangle, float u, float v);

}  // namespace parvis::reference
