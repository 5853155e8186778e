// parvis noise: the map of noise of a scene's roads.
#include <fmt/format.h>

#include "commands.h"
#include "planning/noise/noise_map.h"
#include "scene_arguments.h"

namespace parvis {
namespace {

struct NoiseArguments {
  SceneArguments scene;
  std::filesystem::path output;
  std::string against;
  double traffic_factor = 1.0;
  std::vector<double> area;
  noise::NoiseOptions options;
};

/// Prints the meaning of the figures, and the gaps of the map.
void print_noise(const NoiseArguments& arguments, const noise::NoiseMap& map) {
  const noise::RoadSources& sources = map.sources;
  if (sources.is_driven)
    fmt::print(
        "the vehicles of traffic count, as if they drove at all hours: Lday is the level of such an hour "
        "(Leq)\n");
  if (sources.lanes_without_figures > 0)
    fmt::print(
        stderr,
        "warning: {} lanes have no traffic figures and are silent; a trafficCount whose road= names them "
        "gives them some\n",
        sources.lanes_without_figures);
  if (sources.has_trams)
    fmt::print(
        "trams count, the same at all hours; with them levels are indicative: no standard has plain trams\n");
  const char* const mark = sources.has_trams ? " (indicative)" : "";
  double loudest = 0.0;
  std::size_t facades = 0;
  for (std::size_t i = 0; i < map.receivers.size(); ++i)
    loudest = std::max(loudest, map.levels[i].lden), facades += map.receivers[i].wall >= 0 ? 1 : 0;
  fmt::print("{} receivers, {} of them at facades, {} pieces of road; the loudest Lden is {:.1f} dB(A){}\n",
             map.receivers.size(), facades, sources.patches.size(), loudest, mark);
  const std::string prefix = arguments.output.string();
  fmt::print("{}.png, .csv, .tif, .glb with _Lden.png{}\n", prefix, facades > 0 ? ", _facades.csv" : "");
}

Result<noise::NoiseMap> noise_of(const NoiseArguments& arguments, const scene::Scene& scene) {
  Result<noise::NoiseMap> map = noise::compute_noise(scene, arguments.options);
  if (!map || arguments.traffic_factor == 1.0) return map;
  map->levels = noise::sum_levels(map->transfers, noise::multiplied(map->sources, arguments.traffic_factor));
  return map;
}

Status run_noise(NoiseArguments arguments) {
  if (Status status = arguments.scene.expect_one_scenario(); !status) return status;
  if (!arguments.area.empty())
    arguments.options.area =
        glm::dvec4(arguments.area[0], arguments.area[1], arguments.area[2], arguments.area[3]);
  const Result<stage::Simulation> simulation = arguments.scene.open_simulation();
  if (!simulation) return simulation.errors();
  const Result<noise::NoiseMap> map = noise_of(arguments, simulation->scene);
  if (!map) return map.errors();
  if (Status status =
          noise::write_noise(arguments.output, *map, simulation->scene, arguments.options.height_m);
      !status)
    return status;
  print_noise(arguments, *map);
  if (arguments.against.empty()) return Ok{};

  NoiseArguments before = arguments;
  before.scene.scenarios = {arguments.against};
  const Result<stage::Simulation> other = before.scene.open_simulation();
  if (!other) return other.errors();
  const Result<noise::NoiseMap> other_map = noise_of(before, other->scene);
  if (!other_map) return other_map.errors();
  if (Status status = noise::write_difference(arguments.output, *map, *other_map); !status) return status;
  fmt::print("{}_difference.png, .csv: less the levels of scenario \"{}\"\n", arguments.output.string(),
             arguments.against);
  return Ok{};
}

}  // namespace

void add_noise(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand(
      "noise",
      "Noise of road traffic by CNOSSOS-EU: Lday, Levening, Lnight and Lden over the ground and at facades");
  const auto arguments = std::make_shared<NoiseArguments>();
  noise::NoiseOptions& options = arguments->options;
  arguments->scene.add_scene(*command);
  arguments->scene.add_state(*command);
  command->add_option("-o,--output", arguments->output, "Prefix of the files to write")->required();
  command->add_option("--against", arguments->against,
                      "A scenario (base: none) whose levels are taken off: PREFIX_difference.png, .csv");
  command
      ->add_option("--area", arguments->area, "x and y of two corners in metres (default: the whole scene)")
      ->expected(4);
  command->add_option("--cell", options.cell_m, "Size of a cell in metres")
      ->check(CLI::Range(0.5, 1000.0))
      ->capture_default_str();
  command->add_option("--height", options.height_m, "Of the map over the ground, in metres")
      ->check(CLI::Range(0.5, 100.0))
      ->capture_default_str();
  command->add_option("--reflections", options.paths.reflections, "Highest order of reflections at facades")
      ->check(CLI::Range(0, 3))
      ->capture_default_str();
  command->add_option("--reach", options.reach_m, "Roads farther away are left out, in metres")
      ->check(CLI::Range(10.0, 2000.0))
      ->capture_default_str();
  command
      ->add_option("--favourable", options.favourable_fraction,
                   "Fraction of the time in which wind or warm air above carry sound farther")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--traffic-factor", arguments->traffic_factor, "Multiplies all flows of vehicles")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command->add_flag("!--ground-only", options.has_facades, "No receivers at facades");
  command->footer(
      "Example: parvis noise scenes/denhaag.xp --data ../shared/data -o out/noise\n"
      "Example: parvis noise place.xp --scenario \"with trams\" --against base -o out/quieter");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run_noise(*arguments); }; });
}

}  // namespace parvis
