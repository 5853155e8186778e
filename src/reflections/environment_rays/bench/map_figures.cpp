#include "reflections/environment_rays/bench/map_figures.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "reflections/reference_maps/placement.h"
#include "reflections/reference_maps/reference_maps.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::bench {
namespace {

using namespace reference_maps;

constexpr float wanted_share = 0.99f;
constexpr float sharp = 4.0f;  // times the footprint of a map at the vehicle
constexpr std::size_t judged_points = 50000;
constexpr std::uint64_t judging_seed = 97;
constexpr int max_maps = 400;

/// The first maps of a list that show enough; one more than there are where all are too few.
std::size_t maps_enough(const HeightPyramid& heights, const std::vector<glm::vec3>& places,
                        const std::vector<MirroredPoint>& points, float sharpness) {
  const std::vector<float> shown = coverage(heights, places, points, sharpness);
  return std::size_t(std::ranges::find_if(shown, [](float share) { return share >= wanted_share; }) -
                     shown.begin()) +
         1;
}

}  // namespace

void measure_placement(const scene::Scene& scene, Report& report) {
  const HeightPyramid heights(heights_of(scene));
  const std::vector<MirroredPoint> points = mirrored_points(scene, heights, judged_points, judging_seed);
  const std::vector<glm::vec3> even = spread_places(scene, heights, max_maps);
  const auto enough = [&](float sharpness) {  // as the points that judge have it, not those that place
    PlacementGoal goal;
    goal.max_maps = max_maps;
    goal.share_shown = 0.5f * (1.0f + wanted_share);
    goal.sharpness = {sharpness};
    std::vector<glm::vec3> places = place_by_coverage(scene, heights, goal).places;
    places.resize(std::min(places.size(), maps_enough(heights, places, points, sharpness)));
    return places;
  };
  const std::vector<glm::vec3> plain = enough(any_sharpness), sharply = enough(sharp);
  const std::size_t spread = maps_enough(heights, even, points, any_sharpness);
  report.add("placement_maps", double(plain.size()));
  const double valid_share = double(coverage(heights, plain, points).back());
  report.add("placement_valid_percent", 100.0 * valid_share, {100.0 * double(wanted_share), true});
  report.add("placement_maps_sharp", double(sharply.size()));
  // Maps that show too little save nothing.
  const auto saving_percent = [&](std::size_t maps) { return 100.0 * (1.0 - double(maps) / double(spread)); };
  constexpr Target saving{30.0, true};
  report.add("placement_saving_percent",
             valid_share < double(wanted_share) ? std::nan("") : saving_percent(plain.size()), saving);
  std::vector<glm::vec3> by_chance = even;
  Random random(judging_seed);
  for (std::size_t i = by_chance.size(); i > 1; --i)
    std::swap(by_chance[i - 1], by_chance[std::size_t(random.index(int(i)))]);
  report.add_control("placement_saving_percent_by_chance",
                     saving_percent(maps_enough(heights, by_chance, points, any_sharpness)), saving);
  report.note(
      fmt::format("judged by {} points of another seed; an even spread takes {} maps, sharply {}; sharply "
                  "placed ones show {:.2f} %",
                  points.size(), spread, maps_enough(heights, even, points, sharp),
                  100.0 * double(coverage(heights, sharply, points, sharp).back())));
}

void measure_memory(int face_resolution, Report& report) {
  const std::vector<glm::vec3> places(54, glm::vec3(0.0f));
  const int side = ReferenceMaps::layer_side(face_resolution);
  const Result<ReferenceMaps> plain = ReferenceMaps::create(places, side);
  const Result<ReferenceMaps> compressed = ReferenceMaps::create(places, side, true);
  if (!plain || !compressed) return report.note("maps_mb_54: not measured: no memory for 54 maps");
  report.add("maps_mb_54", 1e-6 * double(plain->bytes()));
  report.add("maps_mb_54_compressed", 1e-6 * double(compressed->bytes()));
  report.add("colour_mb_54_compressed", 1e-6 * double(compressed->colour_bytes()));
}

void measure_rays(const scene::Scene& scene, Report& report) {
  constexpr int rays = 200000;
  constexpr float reach_m = 1000.0f;
  for (const auto& [key, cell_m] : {std::pair{"ray_ns_1m", 1.0f}, {"ray_ns_025m", 0.25f}}) {
    scene::Scene with_cells = scene;  // models are shared
    reference_maps::map_plan(with_cells).cell_m = cell_m;
    const HeightPyramid heights(heights_of(with_cells));
    const std::vector<glm::vec3> starts = spread_places(scene, heights, 100);
    std::vector<double> samples(7);
    float distances_m = 0.0f;  // used below, so that no ray is left out
    for (double& sample : samples) {
      Random random(5);
      sample = milliseconds([&] {
        for (int i = 0; i < rays; ++i) {
          const float azimuth = random.uniform(0.0f, 6.2831853f), z = random.uniform(-0.2f, 0.7f);
          const glm::vec3 direction(std::sqrt(1.0f - z * z) * glm::vec2(std::cos(azimuth), std::sin(azimuth)),
                                    z);
          const glm::vec3& start = starts[std::size_t(i) % starts.size()];
          distances_m += heights.walk_by_levels(start, direction, reach_m).distance_m;
        }
      });
      sample *= 1e6 / rays;
    }
    report.add(key, median(samples));
    report.note(fmt::format("cells of {} m: mean way {:.0f} m", cell_m, distances_m / float(7 * rays)));
  }
}

}  // namespace parvis::bench
