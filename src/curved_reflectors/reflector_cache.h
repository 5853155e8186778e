// Baked reflectors beside their scene: folder NAME.baked/reflectors, in it a file for each, named by what it
// depends on, so that baking can be interrupted between two of them and go on.
#pragma once

#include "curved_reflectors/reflector_map.h"
#include "scene/scene.h"

namespace parvis::curved_reflectors {

/// The parts of a model at rest whose materials are `wanted`, in one piece.
Mesh mesh_of(const scene::Model& model, bool (*wanted)(const scene::Material&));
/// Those that are mirror-like.
Mesh mirror_mesh(const scene::Model& model);

class ReflectorCache {
 public:
  /// For the maps that a scene's options ask for. Nothing is kept of a scene that was made in memory.
  explicit ReflectorCache(const scene::Scene& scene);

  /// The reflector that an object is: as it was kept, or made now. Tells on standard error what cannot be
  /// used of what was kept. Errors as make_reflector's.
  Result<Reflector> reflector(const scene::Object& object) const;
  /// Is it kept, and fit?
  bool has(const scene::Object& object) const;
  Status keep(const scene::Object& object, const Reflector& reflector) const;

  /// Empty for a scene that was made in memory.
  const std::filesystem::path& folder() const { return folder_; }
  /// Where an object's reflector is kept; empty: nowhere.
  std::filesystem::path file(const scene::Object& object) const;

 private:
  std::filesystem::path folder_;
  int side_;
};

/// Makes and keeps all reflectors of a scene that are not kept yet, with progress, and forgets what belongs
/// to none of them. What cannot be a reflector is told on standard error. Returns how many there are.
Result<std::size_t> bake_reflectors(const scene::Scene& scene);

}  // namespace parvis::curved_reflectors
