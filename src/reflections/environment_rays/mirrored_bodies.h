// Dynamic objects as mirror rays hit them: cars reflect one another, the people beside them, and themselves.
// Each model's surface, in each of its paints, is a field of distances (body_field.h), each body a box in
// which its field lies.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "graphics/gl/objects.h"
#include "graphics/gl/program.h"
#include "graphics/shading/glsl.h"
#include "reflections/environment_rays/body_field.h"
#include "reflections/methods/reflections.h"
#include "scene/data/scene.h"

namespace parvis::environment_rays {

namespace mirrored_bodies_shared {
using namespace parvis::shading;
#include "reflections/environment_rays/mirrored_bodies_block.glsl"
}  // namespace mirrored_bodies_shared

/// The bodies of a scene that mirror rays may hit.
class MirroredBodies {
 public:
  /// Makes the fields of all models that move in the scene, which takes tenths of a second each.
  explicit MirroredBodies(const scene::Scene& scene);

  /// Makes the fields of dynamic models that have come.
  void follow_objects(const scene::Scene& scene);
  /// Takes over where bodies are: those nearest to the first reflector where there are more than can be
  /// mirrored; `reflectors` holds one at least. What overlays draw in a reflector is left out of what it
  /// mirrors.
  void update(const scene::Scene& scene, const std::vector<methods::VisibleReflector>& reflectors);
  /// Binds what mirrored_bodies.glsl needs; `reflecting_body` is the caller's to set.
  void prepare(const gl::Program& program, GLuint unit) const;
  /// The body of an object; below 0: none.
  int body_of(int object) const { return body_of_object_[std::size_t(object)]; }

  static constexpr int max_bodies = mirrored_bodies_shared::max_mirrored_bodies, max_nearby = 16;
  static constexpr float reach_m = 25.0f;  ///< between bodies that mirror one another

 private:
  using Body = mirrored_bodies_shared::MirroredBody;
  using Look = std::pair<const scene::Model*, const void*>;  ///< model and paint
  Look look_of(const scene::Object& object);
  void add_objects(const scene::Scene& scene);
  void find_neighbours(const std::vector<methods::VisibleReflector>& reflectors);

  std::map<std::uint64_t, const scene::Model*>
      first_of_bones_;  ///< of skinned bodies, by the hash of their bones
  std::map<Look, int> field_of_look_;
  std::vector<int> field_of_object_;  ///< below 0: none
  std::vector<Bounds> boxes_;         ///< of each field, in its model's frame
  std::vector<int> body_of_object_;   ///< below 0: none now
  std::vector<std::pair<float, int>> by_distance_;
  std::vector<int> objects_;                                         ///< of each body
  std::vector<const methods::VisibleReflector*> reflector_of_body_;  ///< null: it is not seen
  std::vector<glm::vec3> middles_;
  std::vector<Body> bodies_;
  gl::Texture fields_;
  gl::Buffer block_;
};

}  // namespace parvis::environment_rays
