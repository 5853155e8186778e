#include "graphics/light/bench/sky_bench.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/test_data.h"
#include "graphics/light/bench/worse.h"
#include "graphics/light/brute_force_sky.h"
#include "graphics/light/drawn_sky_check.h"
#include "graphics/light/preetham.h"
#include "graphics/light/sky_gpu_check.h"
#include "graphics/light/sky_model.h"
#include "graphics/light/sun_tables.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

using light::SkyKind;

light::SolarPosition sun_at(double elevation_deg) {
  return {.azimuth_deg = 180.0, .zenith_deg = 90.0 - elevation_deg, .geometric_elevation_deg = elevation_deg};
}

Status measure_sun(Report& report) {
  const auto file = shared_data("sun/spa_azimuth_zenith.csv", fs::current_path());
  if (!file) return report.skip("sun_max_error_deg", "the shared data is absent"), Done{};
  const std::vector<light::SunRow> rows = light::read_sun_rows(*file);
  if (rows.empty()) return error("{} has no rows", file->string());
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

Status measure_brute_force(const BenchSetup& setup, Report& report) {
  std::vector<double> elevations{-4, -2, 0, 5, 15, 45, 90}, turbidities{3.0};
  if (!setup.is_quick)
    elevations = {-4, -3, -2, -1, 0, 1, 2, 5, 10, 15, 25, 35, 45, 60, 75, 90}, turbidities = {2.0, 3.0, 6.0};
  double maximum = 0.0, max_preetham = 0.0;
  for (const double turbidity : turbidities)
    for (const double elevation : elevations) {
      const light::Air air{turbidity};
      const light::BruteForceIrradiance truth =
          light::brute_force_diffuse(air, elevation, setup.is_quick ? 128'000 : 512'000, 1);
      const double expected = light::xyz(truth.share).y;
      const auto sky = light::make_sky(SkyKind::atmosphere, air, sun_at(elevation));
      const auto preetham = light::make_sky(SkyKind::preetham, air, sun_at(elevation));
      if (!sky) return sky.errors();
      if (!preetham) return preetham.errors();
      const double error = 100.0 * (diffuse(**sky) / expected - 1.0),
                   of_preetham = 100.0 * (diffuse(**preetham) / expected - 1.0);
      maximum = worse(maximum, std::abs(error)), max_preetham = worse(max_preetham, std::abs(of_preetham));
      report.note(
          fmt::format("turbidity {}, sun at {:3.0f} deg: brute force {:8.1f} lx (+- {:.1f} %), tables "
                      "{:+.1f} %, preetham {:+.0f} %",
                      turbidity, elevation, light::lumens_per_watt * expected, 100.0 * truth.standard_error,
                      error, of_preetham));
    }
  report.add("sky_diffuse_illuminance_error_percent", maximum, up_to(5.0));
  report.add_control("sky_diffuse_illuminance_error_percent_preetham", max_preetham, up_to(5.0));
  return Done{};
}

/// Samples of skies, and those of them that are no radiance.
struct SkySamples {
  long all = 0, bad = 0;
};

/// Both models on the CPU, for all that a scene may ask of them; and the same samples, each a little darker.
Status count_negatives(const BenchSetup& setup, SkySamples& samples, long& bad_darker) {
  constexpr float less = 1e-4f;  // W/m2/sr, 0.07 cd/m2: what the control takes away
  const auto is_bad = [](glm::vec3 seen) {
    return !(seen.x >= 0.0f && seen.y >= 0.0f && seen.z >= 0.0f && std::isfinite(seen.x + seen.y + seen.z));
  };
  const int directions = setup.is_quick ? 400 : 4000;
  const auto look = [&](SkyKind kind, const light::Air& air, double elevation) -> Status {
    const auto sky = light::make_sky(kind, air, sun_at(elevation));
    if (!sky) return sky.errors();
    const bool is_day = elevation > 0.0;
    for (int i = 0; i < directions; ++i) {
      const float z = 1.0f - 2.0f * (float(i) + 0.5f) / float(directions), turn = 2.39996323f * float(i);
      const float across = std::sqrt(1.0f - z * z);
      const glm::vec3 seen = (*sky)->sky_radiance_xyz({across * std::cos(turn), across * std::sin(turn), z});
      const bool is_black = is_day && seen.y == 0.0f;  // what was negative before a clamp
      ++samples.all, samples.bad += is_bad(seen) || is_black, bad_darker += is_bad(seen - less);
    }
    return Done{};
  };
  for (const double turbidity : {1.0, 1.1, 1.3, 1.5, 1.645, 1.8, 2.0, 3.0, 6.0, 11.5, 20.0, 64.0})
    for (const double albedo : {0.0, 0.2, 1.0})
      for (const double elevation : {-90.0, -18.0, -8.0, -4.0, -1.0, 0.0, 1.0, 5.0, 20.0, 60.0, 90.0})
        for (const SkyKind kind : {SkyKind::atmosphere, SkyKind::preetham})
          if (Status status = look(kind, {turbidity, albedo}, elevation); !status) return status;
  return Done{};
}

/// The sky of the GPU beside its C++ build; its samples are counted.
Status measure_gpu(const BenchSetup& setup, SkySamples& samples, Report& report) {
  constexpr double control_turbidity = 3.0, control_elevation_deg = 10.0;
  const Target equal = up_to(1e-3);
  double maximum = 0.0, off_model = 0.0, of_formulas = 0.0;
  const auto add = [&](long all, long bad) { samples.all += all, samples.bad += bad; };
  const std::vector<double> turbidities =
      setup.is_quick ? std::vector{3.0} : std::vector{1.0, 3.0, 10.0, 64.0};
  for (const double turbidity : turbidities)
    for (const double elevation :
         setup.is_quick ? std::vector{-3.0, 10.0} : std::vector{-4.0, -1.0, 0.0, 2.0, 10.0, 40.0, 90.0}) {
      for (const SkyKind kind : {SkyKind::atmosphere, SkyKind::preetham}) {
        const Result<light::DrawnSkyError> drawn = light::drawn_sky_error(kind, turbidity, elevation);
        if (!drawn) return drawn.errors();
        maximum = worse(maximum, drawn->of_build), off_model = worse(off_model, drawn->of_model);
        add(drawn->samples, drawn->bad_samples);
        report.note(fmt::format("{}, turbidity {}, sun at {} deg: {:.1e}, of the model {:.1e} in the mean",
                                light::sky_kind_names[std::size_t(kind)], turbidity, elevation,
                                drawn->of_build, drawn->of_model));
      }
      const Result<light::SkyGpuCheck> models = light::check_sky_on_gpu(light::Air{turbidity}, elevation);
      if (!models) return models.errors();
      of_formulas = worse(of_formulas, models->max_relative_error);
      add(models->samples, models->bad_samples);
    }
  const Result<light::DrawnSkyError> turned =
      light::drawn_sky_error(SkyKind::atmosphere, control_turbidity, control_elevation_deg, 1.0f);
  if (!turned) return turned.errors();
  report.add("sky_gpu_cpu_relative", maximum, equal);
  report.add_control("sky_gpu_cpu_relative_turned_by_a_degree", turned->of_build, equal);
  report.add("sky_drawn_to_model_mean_relative", off_model, equal);
  report.add_control("sky_drawn_to_model_mean_relative_turned_by_a_degree", turned->of_model, equal);
  // A table that is darker by more than the sky is bright: both figures of the formulas must see it.
  constexpr float table_error = -1.0f;
  const Result<light::SkyGpuCheck> darker =
      light::check_sky_on_gpu(light::Air{control_turbidity}, control_elevation_deg, table_error);
  if (!darker) return darker.errors();
  report.add("sky_model_gpu_cpu_relative", of_formulas, equal);
  report.add_control("sky_model_gpu_cpu_relative_of_a_darker_table", darker->max_relative_error, equal);
  report.add_control("sky_negative_samples_of_a_darker_table_of_the_gpu", double(darker->bad_samples),
                     up_to(0.0));
  report.note("the sky as the renderer draws it into six views; the formulas of both models by themselves");
  return Done{};
}

}  // namespace

Status measure_sky(const BenchSetup& setup, Report& report) {
  if (Status status = measure_sun(report); !status) return status;
  if (Status status = measure_brute_force(setup, report); !status) return status;
  SkySamples on_cpu, on_gpu;
  long bad_darker = 0;
  if (Status status = count_negatives(setup, on_cpu, bad_darker); !status) return status;
  if (Status status = measure_gpu(setup, on_gpu, report); !status) return status;
  report.add("sky_negative_samples", double(on_cpu.bad + on_gpu.bad), up_to(0.0));
  report.add_control("sky_negative_samples_0.07_cd_less", double(bad_darker), up_to(0.0));
  report.note(
      fmt::format("{} of {} samples of both models on the CPU, {} of {} channels on the GPU and of the C++ "
                  "build beside it; controls: the samples of the CPU, each a little darker; a table of the "
                  "GPU that is darker",
                  on_cpu.bad, on_cpu.all, on_gpu.bad, on_gpu.all));
  return Done{};
}

}  // namespace parvis::bench
