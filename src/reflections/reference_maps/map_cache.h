// Baked reference maps beside their scene: folder NAME.baked, in it a folder for each state of the scene that
// was baked (as scenarios are), in that a file for each map.
#pragma once

#include <filesystem>
#include <optional>
#include <set>

#include "base/kept_parts.h"
#include "reflections/reference_maps/map_file.h"
#include "scene/data/scene.h"

namespace parvis::reference_maps {

class MapCache {
 public:
  /// The cache of the scene as it is now; a scene that was made in memory has none.
  explicit MapCache(const scene::Scene& scene);

  /// The folder of this state of the scene; empty for a scene that was made in memory.
  const std::filesystem::path& folder() const { return parts_.folder(); }
  std::filesystem::path file(std::size_t number) const;

  /// A map, if it is there, whole and of this state. Unfit ones are reported on standard error.
  std::optional<MapFile> read(std::size_t number) const;
  /// The places of all maps, as the first kept one that is fit has them; not all need be kept.
  std::optional<std::vector<glm::vec3>> places() const;
  /// Reports on standard error that there are maps of other states of the scene, but none of this one.
  void report_other_states() const;
  /// An error, too, where the folder is a link: nothing is kept there.
  Status write(const MapFile& map) const;

 private:
  KeptParts parts_;
  std::uint64_t key_ = 0;
  std::size_t max_places_ = 0;
};

/// Removes what is kept of states of the scene, except the folders `kept`.
void forget_other_states(const scene::Scene& scene, const std::set<std::filesystem::path>& kept);

}  // namespace parvis::reference_maps
