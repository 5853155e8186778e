#include "bench/light/sky_bench.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/colour.h"
#include "base/test_data.h"
#include "bench/light/sky_samples.h"
#include "graphics/light/sky_model.h"
#include "graphics/light/test_brute_force_sky.h"
#include "graphics/light/test_drawn_sky_check.h"
#include "graphics/light/test_sky_gpu_check.h"
#include "graphics/light/test_sun_tables.h"
#include "graphics/light/test_worse.h"
#include "graphics/shading/sky.h"
#include "places/paper_city/paper_script.h"
#include "places/paper_city/sky_picture.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

using light::SkyKind, light::worse;

Status measure_sun(Report& report) {
  const auto file = shared_data("sun/spa_azimuth_zenith.csv", fs::current_path());
  if (!file) return report.skip("sun_max_error_deg", "the shared data is absent"), Done{};
  const std::vector<light::SunRow> rows = light::read_sun_rows(*file);
  constexpr std::size_t min_rows = 250;  // there are 256: what cannot be read is passed over
  if (rows.size() < min_rows) return error("{} has {} rows, not {}", file->string(), rows.size(), min_rows);
  report.add("sun_max_error_deg", light::max_error_deg(rows), up_to(0.0003));
  report.add_control("sun_max_error_deg_a_second_late", light::max_error_deg(rows, 1.0 / 3600.0),
                     up_to(0.0003));
  report.note(fmt::format("{} rows of NREL's own program", rows.size()));
  return Done{};
}

/// Luminance of the sky alone on level ground.
double diffuse(const light::SkyModel& sky) {
  return double(sky.irradiance_xyz({0, 0, 1}, 8192).y -
                std::max(sky.to_sun().z, 0.0f) * sky.sun_irradiance_xyz().y);
}

/// The same as scenes get it: from the sky's picture, by its harmonics up to `orders`, all of them 3.
double diffuse_of_scene(const light::SkyModel& sky, int orders = 3) {
  constexpr int picture_px = 512;  // as clear skies have
  shading::SkyLight light = shading::make_sky_light(light::sky_picture(sky, {}, picture_px), 1.0f, 0.0f);
  std::fill(light.irradiance_sh.begin() + orders * orders, light.irradiance_sh.end(), glm::vec3(0.0f));
  return double(luminance(shading::sky_irradiance(light.irradiance_sh.data(), {0, 0, 1})));
}

/// By so many paths, or by more if they say too little.
Result<light::BruteForceIrradiance> true_diffuse(const light::Air& air, double elevation_deg, int paths) {
  constexpr double max_standard_error = 0.01;
  for (const int more : {1, 2, 4, 8}) {
    const auto truth = light::brute_force_diffuse(air, elevation_deg, more * paths, 1);
    if (truth.standard_error <= max_standard_error) return truth;
  }
  return error("brute force under a sun at {} deg is not known to a percent after {} paths", elevation_deg,
               8 * paths);
}

/// The largest error of diffuse light over all elevations of the sun, percent: of both models, and of the
/// light of scenes that have the first of them, with all harmonics and with their mean alone.
struct DiffuseErrors {
  double atmosphere = 0.0, preetham = 0.0, of_scene = 0.0, of_scene_without_orders = 0.0;

  void add(const DiffuseErrors& other) {
    atmosphere = worse(atmosphere, other.atmosphere), preetham = worse(preetham, other.preetham);
    of_scene = worse(of_scene, other.of_scene);
    of_scene_without_orders = worse(of_scene_without_orders, other.of_scene_without_orders);
  }
};

Result<DiffuseErrors> diffuse_errors(double turbidity, const std::vector<double>& elevations, int paths,
                                     Report& report) {
  DiffuseErrors largest;
  for (const double elevation : elevations) {
    const light::Air air{turbidity};
    const Result<light::BruteForceIrradiance> truth = true_diffuse(air, elevation, paths);
    if (!truth) return truth.errors();
    const double expected = light::xyz(truth->share).y;
    const auto sky = light::make_sky(SkyKind::atmosphere, air, sun_at(elevation));
    const auto preetham = light::make_sky(SkyKind::preetham, air, sun_at(elevation));
    if (!sky) return sky.errors();
    if (!preetham) return preetham.errors();
    const auto off_percent = [&](double found) { return 100.0 * (found / expected - 1.0); };
    const double of_tables = off_percent(diffuse(**sky)), of_preetham = off_percent(diffuse(**preetham)),
                 of_scene = off_percent(diffuse_of_scene(**sky));
    largest.add({std::abs(of_tables), std::abs(of_preetham), std::abs(of_scene),
                 std::abs(off_percent(diffuse_of_scene(**sky, 1)))});
    report.note(
        fmt::format("turbidity {}, sun at {:3.0f} deg: brute force {:8.1f} lx (+- {:.1f} %), tables "
                    "{:+.1f} %, light of scenes {:+.1f} %, preetham {:+.0f} %",
                    turbidity, elevation, light::lumens_per_watt * expected, 100.0 * truth->standard_error,
                    of_tables, of_scene, of_preetham));
  }
  return largest;
}

Status measure_brute_force(const BenchSetup& setup, Report& report) {
  std::vector<double> elevations{-4, -2, 0, 5, 15, 45, 90}, turbidities{3.0};
  if (!setup.is_quick)
    elevations = {-4, -3, -2, -1, 0, 1, 2, 5, 10, 15, 25, 35, 45, 60, 75, 90}, turbidities = {2.0, 3.0, 6.0};
  const int paths = setup.is_quick ? 128'000 : 512'000;
  DiffuseErrors largest;
  for (const double turbidity : turbidities) {
    const Result<DiffuseErrors> errors = diffuse_errors(turbidity, elevations, paths, report);
    if (!errors) return errors.errors();
    largest.add(*errors);
  }
  report.add("sky_diffuse_illuminance_error_percent", largest.atmosphere, up_to(5.0));
  report.add_control("sky_diffuse_illuminance_error_percent_preetham", largest.preetham, up_to(5.0));
  report.add("sky_diffuse_illuminance_error_percent_of_scenes", largest.of_scene, up_to(5.0));
  report.add_control("sky_diffuse_illuminance_error_percent_of_scenes_by_the_mean_alone",
                     largest.of_scene_without_orders, up_to(5.0));
  report.note(
      "of_scenes: the light that the scene's surfaces have of the sky's picture, by its nine harmonics; "
      "control: by the first of them, the mean over all directions");
  return Done{};
}

/// Of directions above the horizon: the share whose colour lies outside of Rec. 709, percent. What is drawn
/// has its negative channels at zero.
double clamped_percent(const light::SkyModel& sky) {
  constexpr int directions = 4000;
  int clamped = 0, all = 0;
  for (int i = 0; i < directions; ++i) {
    const glm::vec3 direction = even_direction(i, directions);
    if (direction.z <= 0.0f) continue;
    const glm::vec3 colour = light::rec709_from_xyz(sky.sky_radiance_xyz(direction));
    ++all, clamped += std::min({colour.x, colour.y, colour.z}) < 0.0f;
  }
  return 100.0 * double(clamped) / double(all);
}

/// Haze, where the tables are less exact: beyond what the issue asks for.
Status measure_haze(const BenchSetup& setup, Report& report) {
  constexpr double turbidity = 10.0;
  std::vector<double> elevations{-4, 0, 15, 90};
  if (!setup.is_quick) elevations = {-4, -2, 0, 2, 5, 10, 15, 25, 45, 60, 75, 90};
  const Result<DiffuseErrors> errors =
      diffuse_errors(turbidity, elevations, setup.is_quick ? 64'000 : 512'000, report);
  if (!errors) return errors.errors();
  report.add("sky_diffuse_illuminance_error_percent_turbidity_10", errors->atmosphere);
  double clamped_atmosphere = 0.0, clamped_preetham = 0.0;
  for (const double elevation : elevations)
    for (const auto& [kind, clamped] : {std::pair{SkyKind::atmosphere, &clamped_atmosphere},
                                        std::pair{SkyKind::preetham, &clamped_preetham}}) {
      const auto sky = light::make_sky(kind, light::Air{turbidity}, sun_at(elevation));
      if (!sky) return sky.errors();
      *clamped = std::max(*clamped, clamped_percent(**sky));
    }
  report.note(fmt::format(
      "turbidity {}: at worst {:.1f} % of the directions of the tables and {:.1f} % of preetham's are more "
      "colourful than Rec. 709 and drawn with a channel at zero. preetham stays at its own turbidities up to "
      "15, the luminance of its zenith up to 11; turbidities below {} and above {} are refused",
      turbidity, clamped_atmosphere, clamped_preetham, light::min_turbidity, light::max_turbidity));
  report.note("the model of Hosek and Wilkie is absent: no Debian package brings its coefficients");
  return Done{};
}

/// What the GPU has of the sky.
struct GpuSamples {
  SkySamples of_formulas;      ///< of the models' own formulas, and of the C++ build beside them: channels
  SkySamples drawn, darkened;  ///< of the renderer's pictures, and of those of a model that is below zero
};

/// The sky of the GPU beside its C++ build; its samples are counted.
Status measure_gpu(const BenchSetup& setup, GpuSamples& samples, Report& report) {
  constexpr double control_turbidity = 3.0, control_elevation_deg = 10.0;
  const Target equal = up_to(1e-3);
  double maximum = 0.0, to_value = 0.0, off_model = 0.0, off_model_99 = 0.0;
  double of_formulas = 0.0, of_formulas_to_value = 0.0;
  Result<DrawnSky> drawn_sky = DrawnSky::create();
  if (!drawn_sky) return drawn_sky.errors();
  const auto dome = std::make_shared<const ImageF>(city::sky_picture(512, city::to_sun(), 1));
  const std::vector<double> turbidities =
      setup.is_quick ? std::vector{3.0} : std::vector{1.0, 3.0, 10.0, 64.0};
  for (const double turbidity : turbidities)
    for (const double elevation :
         setup.is_quick ? std::vector{-3.0, 10.0} : std::vector{-4.0, -1.0, 0.0, 2.0, 10.0, 40.0, 90.0}) {
      for (const SkyKind kind : {SkyKind::atmosphere, SkyKind::preetham}) {
        const Result<light::DrawnSkyError> drawn = light::drawn_sky_error(kind, turbidity, elevation);
        if (!drawn) return drawn.errors();
        maximum = worse(maximum, drawn->of_build), off_model = worse(off_model, drawn->of_model);
        to_value = worse(to_value, drawn->of_build_to_value);
        off_model_99 = worse(off_model_99, drawn->of_model_percentile_99);
        const auto sky = light::make_sky(kind, light::Air{turbidity}, sun_at(elevation));
        if (!sky) return sky.errors();
        light::DayLight clouded;
        clouded.air = light::Air{turbidity}, clouded.dome = dome;
        for (const light::DayLight& day : {light::DayLight(), clouded}) {
          const Result<SkySamples> pixels = drawn_sky->samples(**sky, day);
          if (!pixels) return pixels.errors();
          samples.drawn.all += pixels->all, samples.drawn.bad += pixels->bad;
        }
        report.note(fmt::format("{}, turbidity {}, sun at {} deg: {:.1e}, of the model {:.1e} in the mean",
                                light::sky_kind_names[std::size_t(kind)], turbidity, elevation,
                                drawn->of_build, drawn->of_model));
      }
      const Result<light::SkyGpuCheck> models = light::check_sky_on_gpu(light::Air{turbidity}, elevation);
      if (!models) return models.errors();
      of_formulas = worse(of_formulas, models->max_relative_error);
      of_formulas_to_value = worse(of_formulas_to_value, models->max_error_of_value);
      samples.of_formulas.all += models->samples, samples.of_formulas.bad += models->bad_samples;
    }
  const Result<light::DrawnSkyError> turned =
      light::drawn_sky_error(SkyKind::atmosphere, control_turbidity, control_elevation_deg, 1.0f);
  if (!turned) return turned.errors();
  report.add("sky_gpu_cpu_relative", maximum, equal);
  report.add_control("sky_gpu_cpu_relative_turned_by_a_degree", turned->of_build, equal);
  report.add("sky_gpu_cpu_relative_to_each_value", to_value);
  report.add("sky_drawn_to_model_mean_relative", off_model, equal);
  report.add_control("sky_drawn_to_model_mean_relative_turned_by_a_degree", turned->of_model, equal);
  report.add("sky_drawn_to_model_percentile_99", off_model_99);
  // Tables and models that are darker by more than the sky is bright: the figures must see it.
  constexpr float table_error = -1.0f, less_than_nothing = 1e4f;
  const Result<light::SkyGpuCheck> darker =
      light::check_sky_on_gpu(light::Air{control_turbidity}, control_elevation_deg, table_error);
  if (!darker) return darker.errors();
  report.add("sky_model_gpu_cpu_relative", of_formulas, equal);
  report.add("sky_model_gpu_cpu_relative_to_each_value", of_formulas_to_value);
  report.add_control("sky_model_gpu_cpu_relative_of_a_darker_table", darker->max_relative_error, equal);
  report.add_control("sky_negative_samples_of_a_darker_table_of_the_gpu", double(darker->bad_samples),
                     up_to(0.0));
  const auto control_sky =
      light::make_sky(SkyKind::atmosphere, light::Air{control_turbidity}, sun_at(control_elevation_deg));
  if (!control_sky) return control_sky.errors();
  const Result<SkySamples> darkened = drawn_sky->samples(DarkerSky(*control_sky, less_than_nothing));
  if (!darkened) return darkened.errors();
  samples.darkened = *darkened;
  report.note(
      "the sky as the renderer draws it into six views; the formulas of both models by themselves. Relative "
      "to a value or the mean luminance, whichever is larger; to_each_value: to the value or a hundredth of "
      "the mean; percentile_99: of pixels, in the same way");
  return Done{};
}

}  // namespace

Status measure_sky(const BenchSetup& setup, Report& report) {
  if (Status status = measure_sun(report); !status) return status;
  if (Status status = measure_brute_force(setup, report); !status) return status;
  if (Status status = measure_haze(setup, report); !status) return status;
  const Result<ModelSamples> on_cpu = model_samples(setup.is_quick ? 400 : 4000);
  if (!on_cpu) return on_cpu.errors();
  GpuSamples on_gpu;
  if (Status status = measure_gpu(setup, on_gpu, report); !status) return status;
  const SkySamples &of_models = on_cpu->shipped, &of_formulas = on_gpu.of_formulas, &drawn = on_gpu.drawn;
  const Target none = up_to(0.0);
  report.add("sky_negative_samples", double(of_models.bad + of_formulas.bad + drawn.bad), none);
  report.add_control("sky_negative_samples_0.07_cd_less", double(on_cpu->darker.bad), none);
  report.add_control("sky_negative_samples_drawn_of_a_model_below_zero", double(on_gpu.darkened.bad), none);
  report.note(fmt::format(
      "{} of {} samples of both models on the CPU, {} of {} channels of their formulas on the GPU "
      "and of the C++ build beside it, {} of {} pixels as the renderer draws them, without clouds and with "
      "those of a photographed dome; black counts by day, and above the horizon down to -4 degrees, for what "
      "is below zero is drawn as zero. Controls: the samples of the CPU, each a little "
      "darker; a table of the GPU that is darker; a drawn model that is below zero everywhere",
      of_models.bad, of_models.all, of_formulas.bad, of_formulas.all, drawn.bad, drawn.all));
  return Done{};
}

}  // namespace parvis::bench
