// What of a scene's objects reflectors are made of: the parts of a model that mirror, and those of solid
// glass.
#pragma once

#include "base/mesh.h"
#include "scene/scene.h"

namespace parvis::curved_reflectors {

/// A reflector depends on nothing else.
struct ReflectorSource {
  std::string name;  ///< as warnings have it
  Mesh mesh;         ///< in the model's frame, at rest
  int side;          ///< of its maps, in texels
};

/// The mirror-like parts of an object; maps as wide as the scene's options ask for.
ReflectorSource mirror_source(const scene::Scene& scene, const scene::Object& object);

/// Is it solid glass that shows more than the sky?
bool is_glass(const scene::Material& material);
bool has_glass(const scene::Model& model);
bool has_glass(const scene::Scene& scene);
/// The parts of an object that are.
ReflectorSource glass_source(const scene::Object& object);

}  // namespace parvis::curved_reflectors
