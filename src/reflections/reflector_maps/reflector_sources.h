// What of a scene's objects reflectors are made of: the parts of a model that mirror, and its bodies of
// glass.
#pragma once

#include "base/mesh.h"
#include "scene/data/scene.h"

namespace parvis::reflector_maps {

/// A reflector depends on nothing else.
struct ReflectorSource {
  std::string name;  ///< as warnings have it
  Mesh mesh;         ///< in the model's frame, at rest
  int side;          ///< of its maps, in texels
};

/// The mirror-like parts of an object; maps as wide as the scene's options ask for.
ReflectorSource mirror_source(const scene::Scene& scene, const scene::Object& object);

/// A body of solid glass, one of those that an object has.
struct GlassSource {
  ReflectorSource outside;
  const scene::Material* material;
  std::vector<std::size_t> parts;  ///< of the model, those that have any of it
  bool is_closed;
  float thickness;  ///< as a pane, in the model's unit
};
/// Has it solid glass that shows more than the sky?
bool has_glass(const scene::Model& model);
bool has_glass(const scene::Scene& scene);
/// Of all bodies of glass of an object; of several, the smaller have smaller maps.
std::vector<GlassSource> glass_sources(const scene::Object& object);

}  // namespace parvis::reflector_maps
