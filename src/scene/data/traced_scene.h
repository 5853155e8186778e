// What a room draws by itself, as rays see it: the ground truth of its drawable. Plain geometry and
// functions, without OpenGL and without a ray tracer, so that any room above can describe what it shows.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/bounds.h"
#include "base/mesh.h"
#include "scene/data/model.h"

namespace parvis::scene {

struct Scene;

/// A point of a surface, as a ray finds it. All in the world.
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

/// What light finds there: the surface of graphics/shading/surface.glsl. Light that a photograph has recorded
/// goes into `emission`, with a black metal below it (base colour 0, metallic 1) that adds none.
struct TracedPoint {
  glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< unit, on the viewer's side
  glm::vec3 base_colour{0.8f};         ///< linear
  float metallic = 0.0f;
  float roughness = 0.8f;
  float clear_coat = 0.0f;
  float clear_coat_roughness = 0.03f;
  float translucency = 0.0f;
  float occlusion = 1.0f;    ///< 1: open to the sky
  glm::vec3 emission{0.0f};  ///< radiance toward `TracedHit::to_viewer`
};

/// A surface given by functions of the point and of the direction from which it is seen: textures that depend
/// on the view, alpha that no texture holds. Asked from many threads at a time.
class TracedSurface {
 public:
  virtual ~TracedSurface() = default;
  virtual TracedPoint point(const TracedHit& hit) const = 0;
  /// 0..1. A cutout surface is there where it is at least 0.5; one that blends covers that share of what lies
  /// behind it.
  virtual float alpha(const TracedHit&) const { return 1.0f; }
  virtual Alpha alpha_mode() const { return Alpha::opaque; }
  /// Else its back is passed through, as face culling does.
  virtual bool is_double_sided() const { return true; }
};

/// How something that is traced stands in the scene.
struct TracedPlacing {
  int thing = 0;            ///< of the drawable's things, from 0: what picking gives
  bool is_dynamic = false;  ///< as Object::is_dynamic: it has no part in what is baked of the surroundings
  bool is_visible = true;   ///< hidden static things count for the extent of the place, as hidden objects do
  bool casts_shadow = true;
};

/// Receives what a drawable shows. Rays, heights for the visibility of the sky and occluders are made of it.
class TracedScene {
 public:
  virtual ~TracedScene() = default;
  /// Triangles with a surface of their own. The mesh has normals and uvs.
  virtual void add(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const TracedSurface> surface,
                   const glm::mat4& world_from_mesh, const TracedPlacing& placing) = 0;
  /// A model at rest, with its own materials and textures.
  virtual void add(std::shared_ptr<const Model> model, const glm::mat4& world_from_model,
                   const TracedPlacing& placing) = 0;
};

/// One kind of thing that a room draws by itself, as rays see it.
struct TracedKind {
  std::string name;
  /// Of things in a scene that can be picked; 0: the scene has nothing of this kind.
  std::function<int(const Scene&)> count;
  /// Adds all of them as they stand now; `TracedPlacing::thing` is below `count`.
  std::function<void(const Scene&, TracedScene&)> trace;
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
