// Reading scripts and city models, here and in child processes; switching scenarios; path-traced photographs.
#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "base/files.h"
#include "base/image_io.h"
#include "base/isolated_process.h"
#include "base/test_data.h"
#include "bench/parts.h"
#include "formats/city_models/city_json.h"
#include "formats/meshes/assimp_reader.h"
#include "formats/readers/readers.h"
#include "graphics/reference/photograph.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

/// A script as people write them, `groups` times four nodes.
std::string long_script(int groups) {
  std::string text = "sun(azimuth_deg=232, elevation_deg=42, irradiance=\"6.2 5.6 4.7\")\n";
  for (int i = 0; i < groups; ++i)
    text += fmt::format(
        "// Corner {0}, as the plan of the quarter numbers it.\n"
        "group(name=\"corner {0}\", position=\"{0}.25 -70.5 0\", heading_deg=137.5, visible=1) {{\n"
        "  road(name=\"road {0}\", path=\"-236.0 -500.0 0, -236.0 500.0 0\", lanes=1, lane_width=3.9)\n"
        "  camera(name=\"eye {0}\", position=\"-66.3 56.6 1.6\", target=\"-77 117 1.6\", fov_deg=65)\n"
        "  timer(period_s=2.5, onTime=\"0, eye {0}, look, 0.5\")\n"
        "}}\n",
        i);
  return text;
}

/// The street's trees give way to a tramway; others are planted in the park and at the corner.
constexpr const char* project = R"(
include(file="paper.xp")
scenario(name="tramway") {
  override(of="tree 1", visible=0)
  override(of="tree 2", visible=0)
  override(of="tree 3", visible=0)
  override(of="tree 4", visible=0)
  model(name="oak 1", file="park_tree.glb", position="-40 28 0.15", heading_deg=10)
  model(name="oak 2", file="park_tree.glb", position="-38 40 0.15", heading_deg=120)
  model(name="oak 3", file="street_tree.glb", position="-69.3 96 0", heading_deg=200)
  model(name="oak 4", file="street_tree.glb", position="-78.7 160 0", heading_deg=300)
}
)";

/// Time and memory of reading a file in a child beyond those of reading it here.
struct Overhead {
  Median ms;
  double min_ms = 0.0;  ///< between the shortest readings, in a child and here
  bool is_read = true;
  std::uint64_t workers_isolated = 0, workers_here = 0;  ///< that one reading began
};

Overhead overhead(const std::function<bool()>& isolated, const std::function<bool()>& here, int repeats) {
  Overhead measured;
  const auto read_ms = [&](const std::function<bool()>& read, std::uint64_t& workers) {
    const std::uint64_t before = begun_workers();
    const double ms = milliseconds([&] { measured.is_read = read() && measured.is_read; });
    workers = begun_workers() - before;
    return ms;
  };
  std::vector<double> samples;
  double min_there_ms = std::numeric_limits<double>::max(), min_here_ms = min_there_ms;
  for (int i = 0; i < repeats; ++i) {
    const double there_ms = read_ms(isolated, measured.workers_isolated);
    const WithoutIsolation baseline;  // of the pictures of models, too
    const double here_ms = read_ms(here, measured.workers_here);
    min_there_ms = std::min(min_there_ms, there_ms), min_here_ms = std::min(min_here_ms, here_ms);
    samples.push_back(there_ms - here_ms);
  }
  measured.ms = median(samples);
  measured.min_ms = min_there_ms - min_here_ms;
  return measured;
}

/// The median of megabytes per second.
Median mb_per_s(double bytes, int repeats, const std::function<void()>& read) {
  std::vector<double> samples(std::size_t(repeats), 0.0);
  for (double& sample : samples) sample = 1e-3 * bytes / milliseconds(read);
  return median(samples);
}

}  // namespace

void measure_reading(const BenchSetup& setup, Report& report) {
  const int repeats = setup.is_quick ? 5 : 11;
  const fs::path script = setup.folder / "long.xp";
  const std::string text = long_script(5'000);
  must(write_file(script, text));
  report.add("script_mb_s", mb_per_s(double(text.size()), repeats,
                                     [&] { must(scene::check_scene(script, rooms::node_registry())); }));
  const auto data = shared_data("", fs::current_path());
  if (!data) return report.skip("cityjson_mb_s", "the shared data is absent");
  std::vector<fs::path> cities;
  double bytes = 0.0;
  for (const char* name : {"DenHaag_01", "delft_context", "zurich_subset_lod2"}) {
    cities.push_back(*data / fmt::format("cities/{}.city.json", name));
    bytes += double(fs::file_size(cities.back()));
  }
  Errors warnings;
  report.add("cityjson_mb_s", mb_per_s(bytes, repeats, [&] {
               for (const fs::path& city : cities) must(scene::read_city_model(city, warnings));
             }));
  const fs::path delft = fs::current_path() / "scenes/delft.xp";
  if (!fs::exists(delft)) return report.skip("load_ms_delft", "scenes/delft.xp is absent");
  std::vector<double> samples(std::size_t(setup.is_quick ? 3 : repeats), 0.0);
  for (double& sample : samples) sample = milliseconds([&] { setup.scene(delft, {&*data, 1}); });
  report.add("load_ms_delft", median(samples));
}

void measure_scenarios(const BenchSetup& setup, Report& report) {
  must(write_file(setup.city() / "project.xp", project));
  stage::Simulation simulation = setup.simulation(setup.city() / "project.xp");
  simulation.advance(8.0);
  const auto stage = stage_of(std::move(simulation));
  const Camera camera = must(stage->camera("street"));
  const auto frame_ms = [&] {
    return milliseconds([&] {
      stage->draw(camera, 1280, 720);
      glFinish();
    });
  };
  for (int i = 0; i < 3; ++i) frame_ms();  // makes what is made once
  std::vector<double> samples;
  for (int i = 0; i < (setup.is_quick ? 8 : 24); ++i) {
    const double choice_ms = milliseconds([&] { must(stage->choose_scenario(i % 2 == 0 ? "tramway" : "")); });
    const double first_ms = frame_ms(), ordinary_ms = median({frame_ms(), frame_ms(), frame_ms()}).value;
    samples.push_back(choice_ms + first_ms - ordinary_ms);
  }
  report.add("scenario_replaces_trees_ms", median(samples));
}

void measure_photographs(const BenchSetup& setup, Report& report) {
  constexpr int width = 1280, height = 960, samples = 64, quick_samples = 4;
  stage::Simulation simulation = setup.simulation(setup.city() / "paper.xp");
  simulation.advance(8.0);  // so that cars have reached the crossing
  const Camera camera = must(simulation.camera("crossing"));
  const scene::Scene& scene = simulation.scene;
  const reference::RayScene rays(scene);
  reference::PhotographOptions options;
  options.samples_per_pixel = setup.is_quick ? quick_samples : samples;
  const reference::Photograph photograph = must(reference::take_photograph(
      rays, scene, shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading), camera,
      width, height, options));
  report.add("path_traced_mrays_s", 1e-6 * double(photograph.rays) / photograph.seconds);
  report.add("photo_s_1280x960_64spp", photograph.seconds * samples / options.samples_per_pixel);
}

void measure_isolation(const BenchSetup& setup, Report& report) {
  const auto hague = shared_data("cities/DenHaag_01.city.json", fs::current_path()),
             car = shared_data("cars/p406/p406.obj", fs::current_path());
  if (!hague || !car) return report.skip("isolated_reader_overhead_ms", "the shared data is absent");
  const fs::path picture = setup.folder / "picture.jpg";
  Image8 image(4096, 2160, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = std::uint8_t(i * 2654435761u >> 24);
  must(write_image(picture, image));
  const formats::Readers& readers = rooms::all_registries().get<formats::Readers>();
  Errors warnings;
  const auto isolated = [&](const fs::path& file) {
    return [&, file] { return readers.read(file, {}, warnings).ok(); };
  };
  const int repeats = setup.is_quick ? 5 : 21;
  std::vector<double> medians;
  for (const auto& [name, in_child, here] :
       {std::tuple<const char*, std::function<bool()>, std::function<bool()>>{
            "The Hague", isolated(*hague), [&] { return scene::read_city_model(*hague, warnings).ok(); }},
        {"the p406", isolated(*car),
         [&] { return scene::read_with_assimp(*car, formats::UpAxis::file, warnings).ok(); }},
        {"a JPEG of 4096 x 2160 pixels", [&] { return read_image8(picture).ok(); },
         [&] { return read_image8(picture).ok(); }}}) {
    const Overhead of = overhead(in_child, here, repeats);
    if (!of.is_read) fail("{}: a file of the overhead of child processes cannot be read", name);
    if (of.workers_isolated <= of.workers_here)
      fail("{}: the overhead of child processes is measured without any", name);
    medians.push_back(of.ms.value);
    report.note(fmt::format("{}: {:.1f} ms, shortest readings {:.1f} ms longer in a child", name, of.ms.value,
                            of.min_ms));
  }
  report.add("isolated_reader_overhead_ms", median(medians).value);  // the one in the middle
}

}  // namespace parvis::bench
