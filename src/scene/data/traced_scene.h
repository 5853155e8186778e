// The ray tracer's view of things that a room renders itself: the ground truth of its drawable. Plain
// geometry and functions, independent of OpenGL and of the ray tracer, so that any room above can describe
// its things.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/bounds.h"
#include "base/mesh.h"
#include "scene/data/model.h"

namespace parvis::scene {

struct Scene;

/// A ray's intersection with a surface, in the world.
struct TracedHit {
  glm::vec3 position;
  glm::vec3 to_viewer;  ///< unit, toward where the ray comes from; of a shadow ray: toward the sun, for a
                        ///< shadow map is what the sun sees
  glm::vec3 normal;     ///< unit, interpolated over the triangle, on the viewer's side
  glm::vec2 uv;         ///< of the mesh, interpolated
  std::uint32_t triangle;
  glm::vec2 barycentric;  ///< weights of the second and third corner
  float width_m;          ///< of the surface that the ray stands for, across; 0 where it is not known
  bool is_back;           ///< the triangle is seen from behind: its corners are clockwise
};

/// Material at an intersection: the surface of graphics/shading/surface.glsl. Radiance recorded by a
/// photograph goes into `emission`, with a black metal below it (base colour 0, metallic 1) that adds none.
struct TracedPoint {
  glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< unit, on the viewer's side
  glm::vec3 base_colour{0.8f};         ///< linear
  float metallic = 0.0f;
  float roughness = 0.8f;
  float clear_coat = 0.0f;
  float clear_coat_roughness = 0.03f;
  float translucency = 0.0f;
  float occlusion = 1.0f;  ///< 1: open to the sky
  float openness = 1.0f;   ///< share of the sky, and of all that stands around, that other leaves leave open
  glm::vec3 emission{0.0f};  ///< radiance toward `TracedHit::to_viewer`
  /// Attenuation of the `emission` of a recorded kind where something that its photographs do not show casts
  /// a shadow on it. 1: it receives none.
  float kept_in_shadow = 1.0f;
};

/// A surface given by functions of the point and the viewing direction: view-dependent textures, procedural
/// alpha. Called from many threads at once.
class TracedSurface {
 public:
  virtual ~TracedSurface() = default;
  /// The material at an intersection.
  virtual TracedPoint point(const TracedHit& hit) const = 0;
  /// Opacity, 0..1. A cutout surface exists where it is at least 0.5; a blended one covers this fraction of
  /// what is behind it.
  virtual float alpha(const TracedHit&) const { return 1.0f; }
  /// How `alpha` is used; the same for the whole surface.
  virtual Alpha alpha_mode() const { return Alpha::opaque; }
  /// False: rays pass through its back, as with face culling.
  virtual bool is_double_sided() const { return true; }
};

/// Identity and visibility of a traced thing.
struct TracedPlacing {
  int thing = 0;            ///< of the drawable's things, from 0: what picking gives
  bool is_dynamic = false;  ///< as Object::is_dynamic: it has no part in what is baked of the surroundings
  bool is_visible = true;   ///< hidden static things count for the extent of the place, as hidden objects do
  bool casts_shadow = true;
  bool is_backdrop = false;  ///< as Part::is_backdrop
};

/// Receives the geometry of a drawable; ray hierarchies, the height field of sky visibility and occluders are
/// built from it.
class TracedScene {
 public:
  virtual ~TracedScene() = default;
  /// Adds triangles with a surface of their own. The mesh has normals and uvs.
  virtual void add(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const TracedSurface> surface,
                   const glm::mat4& world_from_mesh, const TracedPlacing& placing) = 0;
  /// Adds a model at rest, with its own materials and textures.
  virtual void add(std::shared_ptr<const Model> model, const glm::mat4& world_from_model,
                   const TracedPlacing& placing) = 0;
};

/// One kind of thing that a room renders itself, for the ray tracer.
struct TracedKind {
  std::string name;
  /// Number of pickable things of this kind in a scene; 0: the scene has none.
  std::function<int(const Scene&)> count;
  /// Adds all of them in their present state; `TracedPlacing::thing` is below `count`.
  std::function<void(const Scene&, TracedScene&)> trace;
  /// Its surfaces show photographs, which hold the shadows that things of such kinds cast on each other: they
  /// receive those of all other things alone.
  bool is_recorded = false;
};

/// Calls `visit(kind, first_thing)` for each kind of which the scene has any. Things are numbered behind the
/// scene's objects: thing 0 of a kind has the number `first_thing` wherever objects are numbered.
template <class SceneType, class Visit>
void for_each_traced_kind(const SceneType& scene, Visit&& visit) {
  int first_thing = int(scene.objects.size());
  for (const TracedKind& kind : scene.traced_kinds) {
    const int count = kind.count(scene);
    if (count > 0) visit(kind, first_thing);
    first_thing += count;
  }
}

}  // namespace parvis::scene
