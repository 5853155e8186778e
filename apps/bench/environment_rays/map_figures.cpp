#include "bench/environment_rays/map_figures.h"

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

/// The first maps of a list that show enough, by what the first n of them show; one more than there are where
/// all are too few.
std::size_t maps_enough(const std::vector<float>& shown) {
  return std::size_t(std::ranges::find_if(shown, [](float share) { return share >= wanted_share; }) -
                     shown.begin()) +
         1;
}

/// How many fewer maps than an even spread takes show enough.
struct Saving {
  std::size_t maps, even_maps;
  double share;  ///< of the points, that the maps show

  /// No number where the maps show too little: they save nothing.
  double percent() const {
    return share < double(wanted_share) ? std::nan("") : 100.0 * (1.0 - double(maps) / double(even_maps));
  }
};

/// Of the first of `places` that show enough to the points that judge, not to those that place.
Saving saving_of(const std::vector<glm::vec3>& places, const std::vector<glm::vec3>& even,
                 const HeightPyramid& heights, const std::vector<MirroredPoint>& points, float sharpness) {
  const std::vector<float> shown = coverage(heights, places, points, sharpness);
  const std::size_t maps = std::min(maps_enough(shown), places.size());
  return {maps, maps_enough(coverage(heights, even, points, sharpness)), double(shown[maps - 1])};
}

}  // namespace

void measure_placement(const scene::Scene& scene, Report& report) {
  const HeightPyramid heights(heights_of(scene));
  const std::vector<MirroredPoint> points = mirrored_points(scene, heights, judged_points, judging_seed);
  const std::vector<glm::vec3> even = spread_places(scene, heights, max_maps);
  std::vector<glm::vec3> by_chance = even;
  Random random(judging_seed);
  for (std::size_t i = by_chance.size(); i > 1; --i)
    std::swap(by_chance[i - 1], by_chance[std::size_t(random.index(int(i)))]);
  PlacementGoal visible;
  visible.max_maps = max_maps;
  visible.share_shown = 0.5f * (1.0f + wanted_share);

  const Saving plain =
      saving_of(place_by_coverage(scene, heights, visible).places, even, heights, points, any_sharpness);
  constexpr Target wanted{30.0, true};
  report.add("placement_maps", double(plain.maps));
  report.add("placement_valid_percent", 100.0 * plain.share, {100.0 * double(wanted_share), true});
  report.add("placement_saving_percent_of_visibility", plain.percent(), wanted);
  report.add_control("placement_saving_percent_of_visibility_by_chance",
                     saving_of(by_chance, even, heights, points, any_sharpness).percent(), wanted);

  const Saving shipped =
      saving_of(place_for_pictures(scene, heights, max_maps).places, even, heights, points, sharp);
  report.add("placement_maps_sharp", double(shipped.maps));
  report.add("placement_saving_percent", shipped.percent());
  report.add_control("placement_saving_percent_by_chance",
                     saving_of(by_chance, even, heights, points, sharp).percent(), {shipped.percent(), true});
  report.note(
      fmt::format("judged by {} points of another seed; an even spread takes {} maps, sharply {}; those that "
                  "are shipped show {:.2f} % sharply",
                  points.size(), plain.even_maps, shipped.even_maps, 100.0 * shipped.share));
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
