#include "bench/readers/reading_bench.h"

#include "base/files.h"
#include "base/test_data.h"
#include "bench/scratch_folder.h"
#include "formats/city_models/city_json.h"
#include "house/stage/stage.h"

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

Status measure_scripts(const House& house, int repeats, Report& report) {
  const ScratchFolder folder;
  const fs::path file = folder.path / "long.xp";
  const std::string text = long_script(5'000);
  std::error_code code;
  fs::create_directories(folder.path, code);
  if (Status status = write_file(file, text); !status) return status;
  std::vector<double> mb_s;
  for (int i = 0; i < repeats; ++i) {
    Status checked = Done{};
    const double ms =
        milliseconds([&] { checked = scene::check_scene(file, house.get<scene::NodeRegistry>()); });
    if (!checked) return checked;
    mb_s.push_back(1e-3 * double(text.size()) / ms);
  }
  report.add("script_mb_s", median(mb_s));
  return Done{};
}

Status measure_cities(int repeats, Report& report) {
  std::vector<fs::path> files;
  double bytes = 0.0;
  for (const char* name : {"DenHaag_01", "delft_context", "zurich_subset_lod2"})
    if (const auto file = shared_data(fmt::format("cities/{}.city.json", name), fs::current_path())) {
      files.push_back(*file);
      bytes += double(fs::file_size(*file));
    }
  if (files.empty()) {
    report.skip("cityjson_mb_s", "the shared data is absent");
    return Done{};
  }
  std::vector<double> mb_s;
  for (int i = 0; i < repeats; ++i) {
    Status read = Done{};
    const double ms = milliseconds([&] {
      Errors warnings;
      for (const fs::path& file : files)
        if (const auto model = scene::read_city_model(file, warnings); !model) read = model.errors();
    });
    if (!read) return read;
    mb_s.push_back(1e-3 * bytes / ms);
  }
  report.add("cityjson_mb_s", median(mb_s));
  return Done{};
}

Status measure_delft(const House& house, int repeats, Report& report) {
  const auto data = shared_data("", fs::current_path());
  const fs::path script = fs::current_path() / "scenes/delft.xp";
  if (!data || !fs::exists(script)) {
    report.skip("load_ms_delft", "the shared data or scenes/delft.xp is absent");
    return Done{};
  }
  std::vector<double> samples;
  for (int i = 0; i < repeats; ++i) {
    Status loaded = Done{};
    samples.push_back(milliseconds([&] {
      if (const auto scene = scene::load_scene(script, house.get<scene::NodeRegistry>(), {&*data, 1}); !scene)
        loaded = scene.errors();
    }));
    if (!loaded) return loaded;
  }
  report.add("load_ms_delft", median(samples));
  return Done{};
}

}  // namespace

Status measure_readers(const BenchSetup& setup, Report& report) {
  const int repeats = setup.is_quick ? 5 : 11;
  if (Status status = measure_scripts(setup.house, repeats, report); !status) return status;
  if (Status status = measure_cities(repeats, report); !status) return status;
  return measure_delft(setup.house, setup.is_quick ? 3 : repeats, report);
}

}  // namespace parvis::bench
