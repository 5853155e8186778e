// Baked reflectors beside their scene: folder NAME.baked/reflectors, in it a file for each, named by what it
// depends on, so that baking can be interrupted between two of them and go on.
#pragma once

#include <set>
#include <string_view>

#include "base/kept_parts.h"
#include "machines/processes.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "reflections/reflector_maps/reflector_sources.h"

namespace parvis::reflector_maps {

class ReflectorCache {
 public:
  /// Nothing is kept of a scene that was made in memory.
  explicit ReflectorCache(const scene::Scene& scene);

  /// The kept reflector, or one made now. Reports on standard error a kept one that cannot be used. Errors as
  /// make_reflector's.
  Result<Reflector> reflector(const ReflectorSource& source) const;
  /// The stored reflector; none where it is absent, and, with a warning, where it is damaged.
  std::optional<Reflector> stored(const ReflectorSource& source) const;
  /// Stores a reflector's bytes (reflector_file.h).
  Status keep(const ReflectorSource& source, std::string_view bytes) const;

  /// The files of all reflectors of the scene; none of a scene that was made in memory.
  const KeptParts& parts() const { return parts_; }
  /// Where a reflector is kept; empty: nowhere.
  std::filesystem::path file(const ReflectorSource& source) const;

 private:
  KeptParts parts_;
};

/// The kept reflectors of a scene, or of several of its states.
struct BakedReflectors {
  KeptParts parts;
  std::set<std::filesystem::path> files;
};

/// Makes and keeps all reflectors that the scene's method looks up and that are not kept yet, with progress:
/// curved mirrors where virtual objects are wanted, solid glass by every method. What cannot be a reflector
/// is reported on standard error. `processes` make them together; the first one keeps them.
Result<BakedReflectors> bake_reflectors(const scene::Scene& scene, const machines::Processes& processes = {});
/// Removes what is kept of others.
void forget_other_reflectors(const BakedReflectors& kept);

}  // namespace parvis::reflector_maps
