// Diffuse light that was found at the vertices of single objects, in place of the light that a renderer
// evaluates per pixel. Renderer and ray tracer read it; photographs of the scene (reference/path_tracer.h)
// do not.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "base/content_hash.h"
#include "scene/data/room_data.h"

namespace parvis::scene {

/// Texels that a renderer has for them: one per vertex and side.
inline constexpr std::size_t max_lit_texels = 16'000'000;

/// Irradiance of sky and sun at each vertex of one object, W/m2, linear Rec. 709.
struct LitVertices {
  /// One part of the object's model.
  struct PartLight {
    std::vector<glm::vec3> front;   ///< by vertex of the part's mesh, on the side of the normal
    std::vector<glm::vec3> behind;  ///< on the other side; empty where the material shows no backs
  };
  std::vector<PartLight> parts;  ///< as many as the model has
};

/// The objects of a scene that are lit at their vertices. Which ones they are must be known before the scene
/// is rendered; their light may be another one in each frame.
struct VertexIrradiance {
  static constexpr std::string_view name = "data.vertex_irradiance";
  static constexpr DataRole role = DataRole::static_content;

  /// Light at the vertices of each object; null, and beyond the end: the object is lit like all others.
  std::vector<std::shared_ptr<const LitVertices>> objects;

  /// The light of an object; null if it has none of its own.
  const LitVertices* of(std::size_t object) const {
    return object < objects.size() ? objects[object].get() : nullptr;
  }
  /// Which objects are lit so. Their light follows from the rest of the scene.
  void hash(ContentHash& hash) const {
    for (const auto& object : objects) hash.add(object != nullptr);
  }
};

}  // namespace parvis::scene
