#include "graphics/light/bench/light_bench.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/random.h"
#include "base/test_data.h"
#include "bench/benches.h"
#include "bench/scratch_folder.h"
#include "graphics/gl/context.h"
#include "graphics/light/brute_force_sky.h"
#include "graphics/light/preetham.h"
#include "graphics/light/shadow_check.h"
#include "graphics/light/sky_gpu_check.h"
#include "graphics/light/sky_model.h"
#include "graphics/light/sun_hours.h"
#include "graphics/light/sun_tables.h"
#include "graphics/light/vertex_light.h"
#include "house/stage/stage.h"
#include "places/paper_city/paper_city.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

using light::SkyKind;

light::SolarPosition sun_at(double elevation_deg) {
  return {.azimuth_deg = 180.0, .zenith_deg = 90.0 - elevation_deg, .geometric_elevation_deg = elevation_deg};
}

void measure_sun(Report& report) {
  const auto file = shared_data("sun/spa_azimuth_zenith.csv", fs::current_path());
  if (!file) return report.skip("sun_max_error_deg", "the shared data is absent");
  const std::vector<light::SunRow> rows = light::read_sun_rows(*file);
  report.add("sun_max_error_deg", light::max_error_deg(rows));
  report.add("sun_max_error_deg_a_second_late", light::max_error_deg(rows, 1.0 / 3600.0));
  report.note(fmt::format("{} rows of NREL's own program; a second late must fail 0.0003", rows.size()));
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
  double most = 0.0, max_preetham = 0.0;
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
      most = std::max(most, std::abs(error)), max_preetham = std::max(max_preetham, std::abs(of_preetham));
      report.note(
          fmt::format("turbidity {}, sun at {:3.0f} deg: brute force {:8.1f} lx (+- {:.1f} %), tables "
                      "{:+.1f} %, preetham {:+.0f} %",
                      turbidity, elevation, light::lumens_per_watt * expected, 100.0 * truth.standard_error,
                      error, of_preetham));
    }
  report.add("sky_diffuse_illuminance_error_percent", most);
  report.add("sky_diffuse_illuminance_error_percent_preetham", max_preetham);
  return Done{};
}

Status count_negatives(const BenchSetup& setup, Report& report) {
  long samples = 0, negative = 0, unclamped = 0;
  const int directions = setup.is_quick ? 400 : 4000;
  for (const double turbidity : {1.0, 1.1, 2.0, 3.0, 6.0, 11.5, 20.0, 64.0})
    for (const double elevation : {-90.0, -18.0, -8.0, -4.0, -1.0, 0.0, 1.0, 5.0, 20.0, 60.0, 90.0}) {
      const double s = (90.0 - elevation) * 0.017453292519943,
                   chi = (4.0 / 9.0 - turbidity / 120.0) * (3.14159265358979 - 2.0 * s);
      unclamped += (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192 < 0.0 ? 1 : 0;
      for (const SkyKind kind : {SkyKind::atmosphere, SkyKind::preetham}) {
        const auto sky = light::make_sky(kind, light::Air{turbidity}, sun_at(elevation));
        if (!sky) return sky.errors();
        for (int i = 0; i < directions; ++i) {
          const float z = 1.0f - 2.0f * (float(i) + 0.5f) / float(directions), turn = 2.39996323f * float(i);
          const float across = std::sqrt(1.0f - z * z);
          const glm::vec3 seen =
              (*sky)->sky_radiance_xyz({across * std::cos(turn), across * std::sin(turn), z});
          ++samples;
          negative +=
              seen.x >= 0.0f && seen.y >= 0.0f && seen.z >= 0.0f && std::isfinite(seen.x + seen.y + seen.z)
                  ? 0
                  : 1;
        }
      }
    }
  report.add("sky_negative_samples", double(negative));
  report.add("sky_negative_samples_unclamped", double(unclamped));
  report.note(fmt::format(
      "{} samples of both models; unclamped: suns under which Preetham's published zenith is negative",
      samples));
  return Done{};
}

Status measure_gpu(const BenchSetup& setup, Report& report) {
  double most = 0.0, wrong_table = 1e9;
  for (const double elevation :
       setup.is_quick ? std::vector{-3.0, 10.0} : std::vector{-4.0, -1.0, 0.0, 2.0, 10.0, 40.0, 90.0}) {
    const Result<light::SkyGpuCheck> right = light::check_sky_on_gpu(light::Air{3.0}, elevation);
    if (!right) return right.errors();
    most = std::max(most, right->max_relative_error);
  }
  const Result<light::SkyGpuCheck> wrong = light::check_sky_on_gpu(light::Air{3.0}, 10.0, 0.1f);
  if (!wrong) return wrong.errors();
  wrong_table = wrong->max_relative_error;
  report.add("sky_gpu_cpu_relative", most);
  report.add("sky_gpu_cpu_relative_wrong_table", wrong_table);
  return Done{};
}

/// Points of the city's ground and facades about its main crossing, as a planner would ask for.
std::vector<light::SunPoint> city_points(const reference::RayScene& rays, int count) {
  std::vector<light::SunPoint> points;
  Random random(5);
  while (int(points.size()) < count) {
    const bool is_ground = points.size() % 2 == 0;
    const glm::vec3 from(random.uniform(-150.0f, 150.0f), random.uniform(-150.0f, 150.0f),
                         is_ground ? 90.0f : random.uniform(1.0f, 15.0f));
    const float turn = random.uniform(0.0f, 6.2831853f);
    const glm::vec3 direction =
        is_ground ? glm::vec3(0, 0, -1) : glm::vec3(std::cos(turn), std::sin(turn), 0.0f);
    const auto hit = rays.nearest_hit({from, direction, 1e-4f, 200.0f});
    if (!hit || hit->place->material->alpha_mode != scene::Alpha::opaque) continue;
    const glm::vec3 normal = is_ground ? glm::vec3(0, 0, 1) : -direction;
    points.push_back({from + hit->distance_m * direction + 0.03f * normal, normal});
  }
  return points;
}

/// A tree's worth of vertices: a cloud of points four metres across, six metres up in the street, that face
/// anywhere.
std::vector<light::LitVertex> tree_of(std::size_t count) {
  std::vector<light::LitVertex> vertices;
  Random random(9);
  const auto any = [&] {
    return glm::vec3(random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f));
  };
  while (vertices.size() < count)
    vertices.push_back({glm::vec3(6.0f, 20.0f, 6.0f) + 2.0f * any(), glm::normalize(any() + 1e-4f)});
  return vertices;
}

double rmse_percent(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& truth) {
  double off = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    off += double((a[i].y - truth[i].y) * (a[i].y - truth[i].y)), mean += double(truth[i].y);
  return 100.0 * std::sqrt(off * double(truth.size())) / mean;
}

/// Ten thousand vertices of an object that has moved, in the street of the paper's city.
Status measure_relighting(const reference::RayScene& rays, Report& report) {
  const auto sky = light::make_sky(SkyKind::atmosphere, light::Air{3.0}, sun_at(40.0));
  if (!sky) return sky.errors();
  const light::SkyTable table(**sky);
  light::VertexLight light(tree_of(10'000));
  std::vector<double> few(11), many(3);
  for (double& sample : few) light.restart(), sample = milliseconds([&] { light.refine(rays, table, 64); });
  for (double& sample : many)
    light.restart(), sample = milliseconds([&] { light.refine(rays, table, 1024); });
  report.add("relight_10k_vertices_64_rays_ms", median(few));
  report.add("relight_10k_vertices_1024_rays_ms", median(many));
  light::VertexLight truth(tree_of(500)), quick(tree_of(500));
  truth.refine(rays, table, 16384);
  quick.refine(rays, table, 16);
  report.add("relight_16_rmse_percent", rmse_percent(quick.irradiance(), truth.irradiance()));
  quick.refine(rays, table, 240);
  report.add("relight_256_rmse_percent", rmse_percent(quick.irradiance(), truth.irradiance()));
  return Done{};
}

/// Views from eye height about the city's own cameras, under suns from 11 to 69 degrees high.
void measure_shadows(const scene::Scene& scene, const reference::RayScene& rays, const BenchSetup& setup,
                     Report& report) {
  constexpr int resolution = 4096;
  Bounds casters;
  for (const scene::Object& object : scene.objects)
    for (const scene::Part& part : object.model->parts)
      casters.add(transformed(object.world_from_model, part.mesh.bounds()));
  Random random(4);
  light::ShadowErrors all, coarse;
  const int cameras = setup.is_quick ? 12 : 200, suns = setup.is_quick ? 6 : 24;
  for (int c = 0; c < cameras; ++c) {
    Camera camera = scene.cameras[std::size_t(c) % std::min<std::size_t>(scene.cameras.size(), 5)].camera;
    const float turn = random.uniform(0.0f, 6.2831853f);
    const glm::vec3 eye = camera.position_in_world() +
                          glm::vec3(random.uniform(-2.0f, 2.0f), random.uniform(-2.0f, 2.0f), 0.0f);
    camera.world_from_camera = look_at(eye, eye + glm::vec3(std::cos(turn), std::sin(turn), -0.05f));
    for (int s = 0; s < suns; ++s) {
      const float e = random.uniform(0.2f, 1.2f), a = random.uniform(0.0f, 6.2831853f);
      const glm::vec3 to_sun(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      all.add(light::check_shadows(rays, casters, camera, 128, 72, to_sun, resolution));
      if (c % 4 == 0)
        coarse.add(light::check_shadows(rays, casters, camera, 128, 72, to_sun, resolution / 8));
    }
  }
  double best = 100.0, best_coarse = 100.0;
  for (std::size_t m = 0; m < light::shadow_method_names.size(); ++m) {
    const double percent = all.percent(light::ShadowMethod(m));
    report.note(
        fmt::format("{}: {:.3f} % of {} pixels wrong", light::shadow_method_names[m], percent, all.pixels));
    best = std::min(best, percent),
    best_coarse = std::min(best_coarse, coarse.percent(light::ShadowMethod(m)));
  }
  report.add("shadow_wrong_px_percent_best_raster", best);
  report.add("shadow_wrong_px_percent_best_raster_64th_of_memory", best_coarse);
  report.add("shadow_perspective_over_best_raster",
             all.percent(light::ShadowMethod::perspective) / std::max(best, 1e-9));
}

Status measure_sun_hours(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  if (Status written = city::write_paper_city(folder.path, 1); !written) return written;
  const Result<scene::LoadedScene> loaded =
      scene::load_scene(folder.path / "paper_day.xp", setup.house.get<scene::NodeRegistry>());
  if (!loaded) return loaded.errors();
  const reference::RayScene rays(loaded->scene);
  if (Status status = measure_relighting(rays, report); !status) return status;
  measure_shadows(loaded->scene, rays, setup, report);
  const std::vector<light::SunPoint> points = city_points(rays, setup.is_quick ? 1000 : 10000);
  double most = 0.0, max_hourly = 0.0;
  for (const int day : setup.is_quick ? std::vector{80} : std::vector{80, 172, 355}) {
    const light::SunPeriod period{.place = {.day_of_year = day}, .first_day = day, .last_day = day};
    light::SunPeriod hourly = period;
    hourly.step_h = 1.0, hourly.bisections = 0;
    const std::vector<float> truth = light::sun_hours_by_minutes(rays, points, period);
    const auto error_percent = [&](const std::vector<float>& hours) {
      double off = 0.0, sum = 0.0;
      for (std::size_t i = 0; i < hours.size(); ++i)
        off += std::abs(double(hours[i] - truth[i])), sum += double(truth[i]);
      return 100.0 * off / sum;
    };
    most = std::max(most, error_percent(light::sun_hours(rays, points, period)));
    max_hourly = std::max(max_hourly, error_percent(light::sun_hours(rays, points, hourly)));
  }
  report.add("sun_hours_error_percent", most);
  report.add("sun_hours_error_percent_hourly_rays", max_hourly);
  report.note(
      fmt::format("mean difference over {} points of ground and facades of the paper's city, as a share of "
                  "the mean hours",
                  points.size()));
  return Done{};
}

Status measure(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  measure_sun(report);
  for (const auto& measure : {measure_brute_force, count_negatives, measure_gpu, measure_sun_hours})
    if (Status status = measure(setup, report); !status) return status.errors();
  return Done{};
}

}  // namespace

void furnish_light(House& house) {
  house.get<Benches>().add(
      {"light", "sun, sky, shadows and hours of sun against their ground truths", measure});
}

}  // namespace parvis::bench
