#include "reflections/reference_maps/place_search.h"

#include <algorithm>
#include <chrono>

#include "reflections/reference_maps/placement.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::reference_maps {
namespace {

constexpr int first_maps = 24;  // choosing among so few takes no time

/// All that placement reads beside the heights. Models and what rooms keep stay out: they are large.
scene::Scene streets_of(const scene::Scene& scene) {
  scene::Scene streets;
  streets.roads = scene.roads;
  streets.data<scene::DrivingArea>() = scene.data<scene::DrivingArea>();
  map_plan(streets) = map_plan(scene);
  map_plan(streets).max_maps = max_maps(scene);
  return streets;
}

}  // namespace

PlaceSearch::PlaceSearch(const scene::Scene& scene, std::shared_ptr<const HeightPyramid> heights)
    : found_(std::async(std::launch::async,
                        [streets = streets_of(scene), kept = std::move(heights)]() -> PlacedMaps {
                          std::vector<glm::vec3> places = map_places(streets, *kept);
                          MapChoice choice(places, *kept);
                          return {std::move(places), std::move(choice)};
                        })) {}

bool PlaceSearch::is_done() const {
  return found_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::vector<glm::vec3> first_places(const scene::Scene& scene, const HeightPyramid& heights) {
  std::vector<glm::vec3> places = spread_places(scene, heights, std::min(first_maps, max_maps(scene)));
  if (places.empty()) places.push_back(place_without_ground);
  return places;
}

}  // namespace parvis::reference_maps
