// parvis bake: what takes long and stays the same is made once and kept beside the scene.
#include "base/image_io.h"
#include "commands.h"
#include "reflections/reference_maps/map_cache.h"
#include "reflections/reference_maps/placement.h"
#include "reflections/reference_maps/placement_plan.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reflector_maps/reflector_cache.h"
#include "reflections/reflector_maps/settings.h"
#include "scene_arguments.h"

namespace parvis {
namespace {

constexpr double megabyte = 1e6;
constexpr int plan_side_px = 1200;

struct Arguments : SceneArguments {
  std::filesystem::path plan;
};

/// Curved mirrors that show what is near them as virtual objects, and solid glass. Adds them to `all`.
Status bake_reflectors(const scene::Scene& scene, reflector_maps::BakedReflectors& all) {
  const Result<reflector_maps::BakedReflectors> baked = reflector_maps::bake_reflectors(scene);
  if (!baked) return baked.errors();
  if (!baked->files.empty()) fmt::print("{} reflectors: {}\n", baked->files.size(), baked->folder.string());
  all.folder = baked->folder;
  all.files.insert(baked->files.begin(), baked->files.end());
  return Done{};
}

/// Bakes one state of the scene, which `arguments` name.
Result<reference_maps::MapCache> bake_state(const Arguments& arguments,
                                            reflector_maps::BakedReflectors& reflectors) {
  const Result<house::Play> play = arguments.open_play();
  if (!play) return play.errors();
  const scene::Scene& scene = play->scene;
  if (Status status = bake_reflectors(scene, reflectors); !status) return status.errors();
  if (reflector_maps::shows_all_objects(scene)) return reference_maps::MapCache(scene);
  Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create(scene);
  if (!renderer) return renderer.errors();
  const reference_maps::HeightPyramid heights(reference_maps::heights_of(scene));
  const Result<reference_maps::ReferenceMaps> maps =
      reference_maps::bake_maps(scene, heights, **renderer, reference_maps::Keep::yes);
  if (!maps) return maps.errors();
  reference_maps::MapCache cache(scene);
  fmt::print("{} reference maps of {} x {} texels, {:.1f} MB of graphics memory: {}\n", maps->places().size(),
             maps->resolution(), maps->resolution(), double(maps->bytes()) / megabyte,
             cache.folder().string());
  if (!arguments.plan.empty()) {
    const std::vector<glm::vec3> even =
        reference_maps::spread_over_roads(scene, heights, int(maps->places().size()));
    if (Status status = write_image(
            arguments.plan,
            reference_maps::placement_plan(**renderer, scene, maps->places(), even, plan_side_px));
        !status)
      return status.errors();
  }
  return cache;
}

Status bake(const Arguments& arguments) {
  if (!arguments.plan.empty())
    if (Status status = arguments.expect_one_scenario(); !status) return status;
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  std::vector<reference_maps::MapCache> baked;
  reflector_maps::BakedReflectors reflectors;
  for (const std::string& scenario :
       arguments.scenarios.empty() ? std::vector<std::string>{"base"} : arguments.scenarios) {
    Arguments state = arguments;
    state.scenarios = {scenario};
    Result<reference_maps::MapCache> cache = bake_state(state, reflectors);
    if (!cache) return cache.errors();
    baked.push_back(*std::move(cache));
  }
  reference_maps::forget_other_states(baked);
  reflector_maps::forget_other_reflectors(reflectors);
  return Done{};
}

}  // namespace

void add_bake(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("bake",
                                         "Draws reference maps, and measures curved mirrors and solid glass, "
                                         "beforehand and keeps them beside the scene");
  const auto arguments = std::make_shared<Arguments>();
  arguments->add_scene(*command);
  arguments->add_state(*command);
  command->add_option("--plan", arguments->plan,
                      "Also write where the maps stand, seen from above (.png): discs; rings where as many "
                      "stand spread evenly over all roads");
  command->footer(
      "Example: parvis bake out/paper/paper.xp --plan places.png\n"
      "NAME.baked beside the script holds them; view and render read them. Interrupted work goes on when "
      "the same command is given again. States that are not given (--scenario) are forgotten.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return bake(*arguments); }; });
}

}  // namespace parvis
