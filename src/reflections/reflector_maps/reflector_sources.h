// Geometry of a scene from which reflectors are made: mirror-like parts of a model, and its bodies of glass.
#pragma once

#include "base/mesh.h"
#include "scene/data/scene.h"

namespace parvis::reflector_maps {

/// All inputs of a reflector, so that equal sources give equal reflectors (ReflectorCache).
struct ReflectorSource {
  std::string name;  ///< for warnings
  Mesh mesh;         ///< in the model's frame, at rest
  int side;          ///< texels per side of its maps
};

/// The mirror-like parts of an object; the scene's settings determine the resolution of its maps.
ReflectorSource mirror_source(const scene::Scene& scene, const scene::Object& object);

/// One body of solid glass of an object.
struct GlassSource {
  ReflectorSource outside;
  const scene::Material* material;
  std::vector<std::size_t> parts;  ///< parts of the model to which its triangles belong
  bool is_closed;
  float thickness;  ///< when treated as a pane, in the model's unit
};
/// True if the model has solid glass that shows more than the sky.
bool has_glass(const scene::Model& model);
/// True if an object of the scene that takes reflections has such glass.
bool has_glass(const scene::Scene& scene);
/// All bodies of glass of an object; of several, smaller ones get smaller maps.
std::vector<GlassSource> glass_sources(const scene::Object& object);

}  // namespace parvis::reflector_maps
