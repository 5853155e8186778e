// One object that is lit at its vertices: where it stood when it was lit, and its vertices in blocks that are
// lit one after the other.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "graphics/light/own_faces.h"
#include "graphics/light/vertex_light.h"
#include "graphics/lit_objects/guessed_light.h"
#include "scene/data/scene.h"
#include "scene/data/vertex_irradiance.h"

namespace parvis::lit_objects {

/// Vertices of one part and one of its sides, which are lit together.
struct VertexBlock {
  std::size_t part, first;
  bool is_behind;
  light::VertexLight light;
  std::vector<glm::vec3> shown = {};     ///< what renderers are to have: as long as `light.vertices()`
  std::optional<KnownLight> known = {};  ///< none before it first had all its rays
  std::optional<SplitLight> guess = {};  ///< what it shows while it has not
  int rays_wanted = 256;                 ///< in the end, per vertex
  bool is_shown = false;                 ///< at least once
  bool is_new = false;                   ///< renderers do not have it yet

  /// True with all the rays that it is to have.
  bool is_finished() const { return light.rays() >= rays_wanted; }
  /// Replaces what is shown.
  void show(std::vector<glm::vec3> irradiance) {
    shown = std::move(irradiance);
    is_shown = is_new = true;
  }
  /// Shows what rays have found, mixed with the guess until all are there. Without a guess few rays would
  /// look spotted: nothing is done then.
  void show_light();
  /// Nothing that was traced counts any more; the best that is known now is the guess.
  void restart();
  /// True where rays have found enough of the sky for light::VertexLight::follow.
  bool can_follow_sky() const;
  /// The sky is another one, and nothing has moved.
  void follow_sky(const light::SkyTable& sky);
  /// True where what rays have found is shown without a guess.
  bool stands_alone() const;
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
  /// All of its vertices, for lighting.
  std::vector<VertexBlock>& blocks() { return blocks_; }
  /// The same for reading.
  const std::vector<VertexBlock>& blocks() const { return blocks_; }
  /// Of both sides.
  std::size_t vertex_count() const;

  /// Compares the stored transforms with those of the scene; where they differ, or the mesh deforms, its
  /// vertices are those of now, nothing that was traced counts, and there is no guess. True if so.
  bool follow(const scene::Scene& scene);
  /// VertexBlock::restart of all.
  void restart();
  /// VertexBlock::follow_sky of all.
  void follow_sky(const light::SkyTable& sky);
  /// Its own faces for light::VertexLight::refine, lit where it stands; `rays` has set it apart. Null where
  /// it deforms, so that its rays hit other faces in each moment, or where what they hit takes too much
  /// memory.
  const light::OwnFaces* faces(const reference::RayScene& rays, const light::SkyTable& sky);

  /// False while a part of it has never been lit.
  bool has_light() const;
  /// True where all its vertices have the rays that they are to have.
  bool is_finished() const;
  /// True where `light` differs from what it was at the last call.
  bool take_news();
  /// What renderers are to show.
  std::shared_ptr<const scene::LitVertices> light() const;

 private:
  std::vector<light::LitVertex> vertices(const scene::Object& object, std::size_t part) const;

  int object_;
  std::vector<glm::mat4> world_from_mesh_;              ///< of each part
  std::vector<std::vector<glm::vec3>> filled_normals_;  ///< of parts whose file has none
  std::vector<VertexBlock> blocks_;
  std::optional<light::OwnFaces> faces_;  ///< none until they are asked for
  bool is_deformed_ = false;
  Bounds bounds_;
};

}  // namespace parvis::lit_objects
