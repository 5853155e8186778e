#include "bench/environment_rays/other_places.h"

#include "base/test_data.h"
#include "bench/environment_rays/view_error.h"
#include "scene/script/scene_loader.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

/// A scene, and which of its cars is judged.
struct Place {
  const char* script;
  const char* car;  ///< in the name of its model
};
constexpr Place places[]{{"scenes/delft.xp", "sedan-sports"}, {"scenes/denhaag.xp", "p406"}};
constexpr double max_mean = 0.55, max_worst = 0.75;

/// FLIP of each view: of the shipped method, re-rendered maps, and simple blending, the control.
Result<std::vector<ViewFlips>> flips_in(const House& house, const Place& place, const fs::path& data,
                                        const methods::Settings& shipped, const fs::path& folder,
                                        bool is_quick, Report& report) {
  Result<scene::LoadedScene> loaded =
      scene::load_scene(place.script, house.get<scene::NodeRegistry>(), std::span(&data, 1));
  if (!loaded) return loaded.errors();
  loaded->scene.file = folder / fs::path(place.script).filename();  // maps are kept there, not in the sources
  if (Status kept = keep_maps(house, loaded->scene, shipped); !kept) return kept.errors();
  Result<std::unique_ptr<house::Stage>> stage = house::Stage::create(house::make_play(house, loaded->scene));
  if (!stage) return stage.errors();
  const Result<std::vector<JudgedMethod>> methods =
      judged_methods(**stage, {{"mem", shipped},
                               {"rerendered", {"rerendered_cube_map", 128, false}},
                               {"simple_blend", {"simple_blend", 128, false}}});
  if (!methods) return methods.errors();
  const NearViewWish wish{1, place.car, 0.03f};
  Result<std::vector<ViewFlips>> views = is_quick ? flips_of_methods(**stage, *methods, 6, 640, 360, wish)
                                                  : flips_of_methods(**stage, *methods, 6, 1280, 720, wish);
  if (!views) return views.errors();
  report.note(fmt::format("{}, cars \"{}\":", place.script, place.car));
  note_flips(*methods, *views, report);
  return views;
}

}  // namespace

Status measure_other_places(const House& house, const methods::Settings& shipped, const fs::path& folder,
                            bool is_quick, Report& report) {
  const std::optional<fs::path> cities = shared_data("cities", fs::current_path());
  if (!cities || !fs::exists(places[0].script)) {
    report.skip("other_places_flip_ratio", "needs the scenes of the checkout and the shared data");
    return Done{};
  }
  std::vector<ViewFlips> all;
  for (const Place& place : places) {
    const Result<std::vector<ViewFlips>> views =
        flips_in(house, place, cities->parent_path(), shipped, folder, is_quick, report);
    if (!views) return views.errors();
    all.insert(all.end(), views->begin(), views->end());
  }
  report.add("other_places_flip_ratio", mean_flip(all, 0) / mean_flip(all, 1), up_to(max_mean));
  report.add("other_places_flip_ratio_worst", worst_ratio(all, 0, 1), up_to(max_worst));
  // Simple blending of the same maps is the control of both.
  report.add_control("other_places_flip_ratio_of_simple_blend", mean_flip(all, 2) / mean_flip(all, 1),
                     up_to(max_mean));
  report.add_control("other_places_flip_ratio_of_simple_blend_worst", worst_ratio(all, 2, 1),
                     up_to(max_worst));
  return Done{};
}

}  // namespace parvis::bench
