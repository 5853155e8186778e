// Multiple environment maps: their error and their cost beside the baselines, as tables; what their maps
// take.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/test_data.h"
#include "bench/parts.h"
#include "bench/reflections/comparison.h"
#include "reflections/environment_rays/multiple_environment_maps.h"
#include "reflections/reference_maps/placement.h"
#include "reflections/reference_maps/reference_maps.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;
using namespace reference_maps;

constexpr MethodRow quality_rows[]{
    {"flip_mem", Measure::flip, "mem"},
    {"flip_ratio_mem_over_rerendered", Measure::flip, "mem", "rerendered"},
    {"flip_ratio_mem_over_rerendered_worst", Measure::worst_flip, "mem", "rerendered"},
    {"flip_ratio_simple_blend_over_rerendered", Measure::flip, "simple_blend", "rerendered"},
    {"flip_ratio_simple_blend_over_rerendered_worst", Measure::worst_flip, "simple_blend", "rerendered"},
    {"flip_ratio_mem_over_box_probes", Measure::flip, "mem", "box"},
    {"flip_ratio_simple_blend_over_box_probes", Measure::flip, "simple_blend", "box"}};
constexpr MethodRow traced_rows[]{{"traced_flip", Measure::flip, "traced"},
                                  {"traced_flip_without_reflections", Measure::flip, "none"},
                                  {"traced_cost_over_mem", Measure::cost, "traced", "mem"}};
constexpr MethodRow near_rows[]{
    {"near_cost_ratio_rerendered_over_mem", Measure::cost, "best", "mem"},
    {"near_cost_ratio_rerendered_over_local", Measure::cost, "best", "local"},
    {"near_flip_ratio_mem_over_rerendered", Measure::flip, "mem", "best"},
    {"near_flip_ratio_none_over_rerendered", Measure::flip, "none", "best"},
    {"traced_cost_over_mem_ten_seen", Measure::cost, "traced", "mem"},
    {"traced_cost_over_mem_ten_re_rendered_in_its_place", Measure::cost, "best", "mem"}};
constexpr MethodRow other_rows[]{
    {"other_places_flip_ratio", Measure::flip, "mem", "rerendered"},
    {"other_places_flip_ratio_worst", Measure::worst_flip, "mem", "rerendered"},
    {"other_places_flip_ratio_of_simple_blend", Measure::flip, "simple_blend", "rerendered"},
    {"other_places_flip_ratio_of_simple_blend_worst", Measure::worst_flip, "simple_blend", "rerendered"}};

/// The paper's city, whose maps are kept beside its file.
scene::Scene city_with_maps(const BenchSetup& setup) {
  scene::Scene city = setup.scene(setup.city() / "paper.xp");
  keep_maps(city, shipped_maps());
  return city;
}

/// The city with traffic on all of its roads, where its script keeps it to the streets about a crossing.
scene::Scene driven_everywhere(scene::Scene city) {
  city.data<scene::DrivingArea>() = {};
  return city;
}

/// The first maps of a list that show enough, by what the first n of them show; one more than there are where
/// all are too few.
std::size_t maps_enough(const std::vector<float>& shown, float wanted) {
  return std::size_t(std::ranges::find_if(shown, [&](float part) { return part >= wanted; }) -
                     shown.begin()) +
         1;
}

/// The percentage by which the first of `places` that show enough are fewer than an even spread takes, judged
/// by other points than those that place; no number where they show too little.
struct Placements {
  const HeightPyramid& heights;
  const std::vector<MirroredPoint>& points;
  const std::vector<glm::vec3>& even;
  float sharpness;

  static constexpr float wanted = 0.99f;
  double saving_percent(const std::vector<glm::vec3>& places) const {
    const std::vector<float> shown = coverage(heights, places, points, sharpness);
    if (shown.empty() || shown.back() < wanted) return std::nan("");
    const std::size_t of_even = maps_enough(coverage(heights, even, points, sharpness), wanted);
    return 100.0 * (1.0 - double(maps_enough(shown, wanted)) / double(of_even));
  }
};

}  // namespace

void measure_maps_memory(const BenchSetup& /*setup*/, Report& report) {
  const std::vector<glm::vec3> places(54, glm::vec3(0.0f));
  const int side = ReferenceMaps::layer_side(shipped_maps().resolution);
  report.add("maps_mb_54", 1e-6 * double(must(ReferenceMaps::create(places, side)).bytes()));
  report.add("maps_mb_54_compressed", 1e-6 * double(must(ReferenceMaps::create(places, side, true)).bytes()));
}

void measure_placement(const BenchSetup& setup, Report& report) {
  constexpr float sharp = 4.0f;  // times the footprint of a map at the vehicle
  constexpr std::size_t judged_points = 50'000;
  constexpr std::uint64_t judging_seed = 97;
  constexpr int max_maps = 400;
  const scene::Scene city = setup.scene(setup.city() / "paper.xp");
  const HeightPyramid heights(heights_of(city));
  const std::vector<MirroredPoint> points = mirrored_points(city, heights, judged_points, judging_seed);
  const std::vector<glm::vec3> even = spread_places(city, heights, max_maps);
  std::vector<glm::vec3> shuffled = even;
  Random random(judging_seed);
  for (std::size_t i = shuffled.size(); i > 1; --i)
    std::swap(shuffled[i - 1], shuffled[std::size_t(random.index(int(i)))]);
  PlacementGoal visible;
  visible.max_maps = max_maps;
  visible.share_shown = 0.5f * (1.0f + Placements::wanted);
  const Placements plain{heights, points, even, any_sharpness}, sharply{heights, points, even, sharp};
  const std::vector<glm::vec3> by_coverage = place_by_coverage(city, heights, visible).places,
                               shipped = place_for_pictures(city, heights, max_maps).places;
  report.add("placement_saving_percent_of_visibility", plain.saving_percent(by_coverage));
  report.add("placement_saving_percent_of_visibility_by_chance", plain.saving_percent(shuffled));
  const double saving = sharply.saving_percent(shipped);
  report.add("placement_saving_percent", saving, minimum(saving),
             {{"placement_saving_percent_by_chance", sharply.saving_percent(shuffled)}});
}

void measure_maps_cost(const BenchSetup& setup, Report& report) {
  constexpr int cars_seen = 30;
  const auto stage = stage_with(city_with_maps(setup), 120);
  const Camera camera = view_of_cars(*stage, cars_seen, cars_seen, full_picture, report);
  // What costs least differs least from none, and needs most samples.
  const auto cheap = judged_methods(*stage, {{"none", usual("none")}, {"mem", shipped_maps()}});
  const auto cheap_costs =
      reflection_costs(*stage, cheap, camera, full_picture, {.repeats = setup.is_quick ? 20 : 60});
  const auto others = judged_methods(*stage, {{"none", usual("none")},
                                              {"rerendered", usual("rerendered_cube_map")},
                                              {"rerendered_lod", usual("rerendered_cube_map", true)},
                                              {"local", usual("local_environment_maps")}});
  const auto costs =
      reflection_costs(*stage, others, camera, full_picture, {.repeats = setup.is_quick ? 5 : 30});
  const Median full = median(costs[1].ms), lod = median(costs[2].ms), mem = median(cheap_costs[1].ms);
  const Median& rerendered = lod.value < full.value ? lod : full;  // the baseline at its best
  report.note(fmt::format("mem {:.2f} ms, re-rendered {:.2f} ms, with levels of detail {:.2f} ms", mem.value,
                          full.value, lod.value));
  report.add("cost_ratio_rerendered_over_mem_30", ratio(rerendered, mem));
  // Local maps are drawn for each car, as re-rendered ones are: the control.
  report.add("local_cost_ratio_30", ratio(rerendered, median(costs[3].ms)).value);
  report_shown(*stage, cheap[1], camera, full_picture, "cost_30_flip_mem_over_none", report);
}

void measure_maps_near_cost(const BenchSetup& setup, Report& report) {
  const auto stage = stage_of(city_with_maps(setup));
  compared(*stage, {.methods = {{"none", usual("none")},
                                {"mem", shipped_maps()},
                                {"traced", usual("traced")},
                                {"local", usual("local_environment_maps")},
                                {"rerendered", usual("rerendered_cube_map")},
                                {"rerendered_lod", usual("rerendered_cube_map", true)}},
                    .wish = {.min_seen = 10, .max_others_fraction = 1.0f},
                    .views = setup.is_quick ? 3 : 8,
                    .size = setup.is_quick ? full_picture / 2 : full_picture,
                    .repeats = setup.is_quick ? 3 : 10})
      .report(near_rows, report);
}

void measure_maps_bodies(const BenchSetup& setup, Report& report) {
  measure_body_count(city_with_maps(setup), setup, report);
}
void measure_maps_city_size(const BenchSetup& setup, Report& report) {
  measure_city_size(city_with_maps(setup), setup, report);
}
void measure_maps_motion(const BenchSetup& setup, Report& report) {
  measure_motion(*stage_of(city_with_maps(setup)), setup, report);
}
void measure_maps_budget(const BenchSetup& setup, Report& report) {
  measure_budget(*stage_of(city_with_maps(setup)), setup, report);
}

void measure_maps_quality(const BenchSetup& setup, Report& report) {
  const scene::Scene city = driven_everywhere(setup.scene(setup.city() / "paper.xp"));
  keep_maps(city, shipped_maps());
  const auto stage = stage_of(city);
  const auto note_memory = [&, is_noted = false](const NearView&,
                                                 const std::vector<JudgedMethod>& methods) mutable {
    const auto* mem =
        dynamic_cast<const environment_rays::MultipleEnvironmentMaps*>(methods[0].reflections.get());
    if (!mem || std::exchange(is_noted, true)) return;
    report.add("maps_mb", 1e-6 * double(mem->maps().bytes()));
  };
  const Compared result = compared(*stage, {.methods = {{"mem", shipped_maps()},
                                                        {"rerendered", usual("rerendered_cube_map")},
                                                        {"box", usual("box_projected_probe")},
                                                        {"simple_blend", usual("simple_blend")}},
                                            .views = setup.is_quick ? 8 : 20,
                                            .size = setup.is_quick ? full_picture / 2 : full_picture,
                                            .also = note_memory});
  result.report(quality_rows, report);
}

void measure_maps_traced(const BenchSetup& setup, Report& report) {
  const auto stage = stage_of(city_with_maps(setup));
  const std::size_t larger_views = setup.is_quick ? 2 : 20;
  std::vector<double> larger_ms;  // of four times the pixels: the control of the clock
  const auto time_larger = [&](const NearView& view, const std::vector<JudgedMethod>& methods) {
    if (larger_ms.size() < larger_views)
      larger_ms.push_back(
          reflection_costs(*stage, {methods[0], methods[2]}, view.camera, 2 * full_picture, {})[1]
              .ms.front());
  };
  const Compared result = compared(
      *stage, {.methods = {{"none", usual("none")}, {"mem", shipped_maps()}, {"traced", usual("traced")}},
               .views = setup.is_quick ? 4 : 20,
               .samples_per_pixel = 64,
               .repeats = setup.is_quick ? 3 : 10,
               .also = time_larger});
  result.report(traced_rows, report);
  const std::vector<double>& mem_ms = result.method("mem").ms;
  report.add(
      "traced_cost_over_mem_of_four_times_the_pixels",
      ratio_in_turn(larger_ms, {mem_ms.begin(), mem_ms.begin() + std::ptrdiff_t(larger_ms.size())}).value);
}

/// Local maps of 128 pixels out of 54 reference maps spread evenly over all 8 km of road, in a city whose
/// traffic drives everywhere, while it drives.
void measure_maps_paper(const BenchSetup& setup, Report& report) {
  constexpr int map_count = 54, map_pixels = 128;
  constexpr double step_s = 0.1;  // between frames that are timed: every car has moved
  scene::Scene city = driven_everywhere(setup.scene(setup.city() / "paper.xp"));
  map_plan(city).places = spread_places(city, HeightPyramid(heights_of(city)), map_count);
  map_plan(city).resolution = map_pixels;
  const WantedMethods methods{{"none", usual("none")},
                              {"paper", {"local_environment_maps", map_pixels, true}},
                              {"rerendered", usual("rerendered_cube_map")},
                              {"rerendered_lod", usual("rerendered_cube_map", true)}};
  keep_maps(city, methods[1].second);
  const Compared near =
      compared(*stage_with(city, 30), {.methods = methods,
                                       .views = setup.is_quick ? 6 : 20,
                                       .size = setup.is_quick ? full_picture / 2 : full_picture,
                                       .repeats = 2,
                                       .step_s = step_s});
  near.report({}, report);
  report.add("paper_cost_ratio_near", near.value({"", Measure::cost, "best", "paper"}));
  const double flip = near.value({"", Measure::flip, "paper", "best"});
  report.add("paper_flip_ratio", flip, maximum(flip),
             {{"paper_flip_ratio_without_reflections", near.value({"", Measure::flip, "none", "best"})}});
  // Eight to twelve cars from above, as in the paper's table 1.
  const auto crowded = stage_with(city, 120);
  const Camera camera = view_of_cars(*crowded, 8, 12, full_picture, report);
  const auto timed = judged_methods(*crowded, methods);
  const auto costs = reflection_costs(*crowded, timed, camera, full_picture,
                                      {.repeats = setup.is_quick ? 5 : 20, .step_s = step_s});
  const auto& best_ms = costs[median(costs[3].ms).value < median(costs[2].ms).value ? 3 : 2].ms;
  const double cost_ratio = ratio_in_turn(best_ms, costs[1].ms).value;
  // By how much re-rendered maps differ from themselves, one sample from the one before: the control.
  const double of_itself =
      ratio_in_turn({best_ms.begin() + 1, best_ms.end()}, {best_ms.begin(), best_ms.end() - 1}).value;
  report.add("paper_cost_ratio", cost_ratio, minimum(cost_ratio),
             {{"paper_cost_ratio_of_rerendered_over_itself", of_itself}});
  report_shown(*crowded, timed[1], camera, full_picture, "paper_cost_flip_over_none", report);
}

/// Places and cars that the method was not made with.
void measure_maps_other_places(const BenchSetup& setup, Report& report) {
  const std::optional<fs::path> data = shared_data("", fs::current_path());
  if (!data || !fs::exists(*data / "cities") || !fs::exists("scenes/delft.xp"))
    return report.skip("other_places_flip_ratio", "needs the scenes of the checkout and the shared data");
  Compared all;
  for (const auto& [script, car] :
       {std::pair{"scenes/delft.xp", "sedan-sports"}, {"scenes/denhaag.xp", "p406"}}) {
    scene::Scene scene = setup.scene(script, {&*data, 1});
    scene.file = setup.folder / fs::path(script).filename();  // maps are kept there, not in the sources
    keep_maps(scene, shipped_maps());
    const Compared of_place =
        compared(*stage_of(scene), {.methods = {{"mem", shipped_maps()},
                                                {"rerendered", usual("rerendered_cube_map")},
                                                {"simple_blend", usual("simple_blend")}},
                                    .wish = {.model = car},
                                    .views = 6,
                                    .size = setup.is_quick ? full_picture / 2 : full_picture});
    report.note(fmt::format("{}, cars \"{}\":", script, car));
    of_place.report({}, report);
    if (all.methods.empty())
      all = of_place;
    else
      for (std::size_t m = 0; m < all.methods.size(); ++m)
        all.methods[m].flip.insert(all.methods[m].flip.end(), of_place.methods[m].flip.begin(),
                                   of_place.methods[m].flip.end());
  }
  for (const MethodRow& row : other_rows) report.add(row.key, all.value(row));
}

}  // namespace parvis::bench
