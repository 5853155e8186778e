// The places of a scene's reference maps, found on a thread of its own while a window shows its first frames.
#pragma once

#include <future>
#include <memory>
#include <vector>

#include "reflections/reference_maps/height_pyramid.h"
#include "reflections/reference_maps/map_choice.h"
#include "scene/data/scene.h"

namespace parvis::reference_maps {

/// Places of maps, and which of them each part of the ground looks into.
struct PlacedMaps {
  std::vector<glm::vec3> places;
  MapChoice choice;
};

/// A search for what `map_places` returns; its end waits for the thread, a few seconds in a city.
class PlaceSearch {
 public:
  /// Copies what it reads of the scene, which may change meanwhile.
  PlaceSearch(const scene::Scene& scene, std::shared_ptr<const HeightPyramid> heights);

  /// Whether `take` would not wait.
  bool is_done() const;
  /// Waits for the result and gives it away; to be called once.
  PlacedMaps take() { return found_.get(); }

 private:
  std::future<PlacedMaps> found_;
};

/// Places that are found at once, for the time of the search: a few, evenly along the streets.
std::vector<glm::vec3> first_places(const scene::Scene& scene, const HeightPyramid& heights);

}  // namespace parvis::reference_maps
