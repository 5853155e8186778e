#include "reflections/reference_maps/driving_area.h"

#include <algorithm>

#include "scene/data/path.h"

namespace parvis::reference_maps {
namespace {

constexpr float beyond_rim_m = 10.0f;  // a crossing at the area's rim reaches out of it
constexpr int open_squares = 64;       // of the ground a side, at most
constexpr float kerb_m = 1.0f;         // what is higher above the ground is no open ground

/// Vehicles start within the area, on streets that end there, and keep to such streets
/// (traffic/simulation.h); where there are none, they leave it.
std::vector<glm::vec3> street_places(const scene::Scene& scene, float apart_m) {
  const scene::DrivingArea& area = scene.data<scene::DrivingArea>();
  const auto is_within = [&](glm::vec3 at) { return area.contains(glm::vec2(at), beyond_rim_m); };
  const auto ends_within = [&](const scene::Lane& lane) { return is_within(lane.points.back()); };
  const bool keeps_within = std::ranges::any_of(scene.roads.lanes, ends_within);
  std::vector<glm::vec3> places;
  for (const scene::Lane& lane : scene.roads.lanes) {
    if (keeps_within ? !ends_within(lane) : std::ranges::none_of(lane.points, is_within)) continue;
    const scene::MeasuredPath path(lane.points);
    const int count = int(path.length() / apart_m) + 1;
    for (int i = 0; i < count; ++i)
      if (const glm::vec3 at = path.at(float(i) * apart_m); !keeps_within || is_within(at))
        places.push_back(at);
  }
  return places;
}

std::vector<glm::vec3> open_places(const HeightPyramid& heights) {
  if (heights.levels().empty()) return {glm::vec3(0.0f)};
  const ImageF& field = heights.levels().front();
  const int step = std::max(1, std::max(heights.cells().x, heights.cells().y) / open_squares);
  std::vector<float> all;
  for (int y = 0; y < heights.cells().y; y += step)
    for (int x = 0; x < heights.cells().x; x += step) all.push_back(*field.at(x, y));
  std::ranges::nth_element(all, all.begin() + std::ptrdiff_t(all.size() / 4));
  const float ground_m = all[all.size() / 4];
  std::vector<glm::vec3> places;
  for (int y = 0; y < heights.cells().y; y += step)
    for (int x = 0; x < heights.cells().x; x += step)
      if (*field.at(x, y) < ground_m + kerb_m)
        places.emplace_back(heights.origin() + heights.cell_m() * (glm::vec2(x, y) + 0.5f), *field.at(x, y));
  return places;
}

}  // namespace

std::vector<glm::vec3> driving_places(const scene::Scene& scene, const HeightPyramid& heights,
                                      float apart_m) {
  std::vector<glm::vec3> places = street_places(scene, apart_m);
  return places.empty() ? open_places(heights) : places;
}

}  // namespace parvis::reference_maps
