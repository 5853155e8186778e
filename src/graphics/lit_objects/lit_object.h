// One object that is lit at its vertices: where it stood when it was lit, and its vertices in blocks that are
// lit one after the other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "graphics/light/vertex_light.h"
#include "scene/data/scene.h"
#include "scene/data/vertex_irradiance.h"

namespace parvis::lit_objects {

/// Vertices of one part and one of its sides, which are lit together.
struct VertexBlock {
  std::size_t part, first;
  bool is_behind;
  light::VertexLight light;
  std::vector<glm::vec3> shown = {};  ///< what renderers are to have: as long as `light.vertices()`
  int rays_wanted = 256;              ///< in the end, per vertex
  int shown_at = -1;                  ///< LightingProcess::moment_ when it was last shown; below 0: never
  bool is_new = false;                ///< renderers do not have it yet

  /// True with all the rays that it is to have.
  bool is_finished() const { return light.rays() >= rays_wanted; }
  /// Shows what the rays have found.
  void show_light(int moment) {
    shown = light.irradiance();
    shown_at = moment, is_new = true;
  }
};

/// An object of a scene. It knows its index; the scene is handed to it.
class LitObject {
 public:
  /// `what_is_odd` gets a sentence for each part that faces inward or has vertices without normals.
  LitObject(const scene::Scene& scene, int object, std::vector<std::string>& what_is_odd);

  /// Texels that its vertices take in a renderer.
  static std::size_t texel_count(const scene::Object& object);

  /// Its index in the scene.
  int object() const { return object_; }
  /// World bounds of its vertices, as `follow` found them last.
  const Bounds& bounds() const { return bounds_; }
  /// Blocks of all its vertices, for lighting.
  std::vector<VertexBlock>& blocks() { return blocks_; }
  /// The same for reading.
  const std::vector<VertexBlock>& blocks() const { return blocks_; }
  /// Number of vertices of both sides.
  std::size_t vertex_count() const;

  /// Compares the stored transforms with those of the scene; where they differ, or the mesh deforms, its
  /// vertices are those of now, and nothing that was traced counts. True if so.
  bool follow(const scene::Scene& scene);
  /// Nothing that was traced counts any more.
  void restart();
  /// The sky is another one, and nothing has moved (light::VertexLight::follow).
  void follow_sky(const light::SkyTable& sky);

  /// True where `light` differs from what it was at the last call.
  bool take_news();
  /// The light that renderers are to show.
  std::shared_ptr<const scene::LitVertices> light() const;

 private:
  std::vector<light::LitVertex> vertices(const scene::Object& object, std::size_t part) const;

  int object_;
  std::vector<glm::mat4> world_from_mesh_;              ///< of each part
  std::vector<std::vector<glm::vec3>> filled_normals_;  ///< of parts whose file has none
  std::vector<VertexBlock> blocks_;
  Bounds bounds_;
};

}  // namespace parvis::lit_objects
