#include "graphics/light/bench/light_bench.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/parallel.h"
#include "base/random.h"
#include "base/test_data.h"
#include "bench/benches.h"
#include "bench/scratch_folder.h"
#include "graphics/gl/context.h"
#include "graphics/light/bench/bounced_bench.h"
#include "graphics/light/bench/double_tracer.h"
#include "graphics/light/bench/lit_object_bench.h"
#include "graphics/light/bench/shadow_bench.h"
#include "graphics/light/brute_force_sky.h"
#include "graphics/light/day_light.h"
#include "graphics/light/drawn_sky_check.h"
#include "graphics/light/preetham.h"
#include "graphics/light/sky_gpu_check.h"
#include "graphics/light/sky_model.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/light/sun_hours.h"
#include "graphics/light/sun_study.h"
#include "graphics/light/sun_tables.h"
#include "graphics/light/vertex_light.h"
#include "graphics/reference/shading_point.h"
#include "house/stage/stage.h"
#include "places/paper_city/paper_city.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

using light::SkyKind;

light::SolarPosition sun_at(double elevation_deg) {
  return {.azimuth_deg = 180.0, .zenith_deg = 90.0 - elevation_deg, .geometric_elevation_deg = elevation_deg};
}

/// The larger; NaN where either is NaN, so that nothing that is no number passes.
double worse(double a, double b) { return a >= b ? a : (b > a ? b : a + b); }

Status measure_sun(const BenchSetup&, Report& report) {
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

Status count_negatives(const BenchSetup& setup, Report& report) {
  constexpr float less = 1e-4f;  // W/m2/sr, 0.07 cd/m2: what the control takes away
  long samples = 0, negative = 0, negative_less = 0;
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
      ++samples, negative += is_bad(seen) || is_black, negative_less += is_bad(seen - less);
    }
    return Done{};
  };
  for (const double turbidity : {1.0, 1.1, 1.3, 1.5, 1.645, 1.8, 2.0, 3.0, 6.0, 11.5, 20.0, 64.0})
    for (const double albedo : {0.0, 0.2, 1.0})
      for (const double elevation : {-90.0, -18.0, -8.0, -4.0, -1.0, 0.0, 1.0, 5.0, 20.0, 60.0, 90.0})
        for (const SkyKind kind : {SkyKind::atmosphere, SkyKind::preetham})
          if (Status status = look(kind, {turbidity, albedo}, elevation); !status) return status;
  report.add("sky_negative_samples", double(negative), up_to(0.0));
  report.add_control("sky_negative_samples_0.07_cd_less", double(negative_less), up_to(0.0));
  report.note(
      fmt::format("{} samples of both models; control: the same samples, each a little darker", samples));
  return Done{};
}

Status measure_gpu(const BenchSetup& setup, Report& report) {
  double maximum = 0.0, off_model = 0.0, of_formulas = 0.0;
  const std::vector<double> turbidities =
      setup.is_quick ? std::vector{3.0} : std::vector{1.0, 3.0, 10.0, 64.0};
  for (const double turbidity : turbidities)
    for (const double elevation :
         setup.is_quick ? std::vector{-3.0, 10.0} : std::vector{-4.0, -1.0, 0.0, 2.0, 10.0, 40.0, 90.0}) {
      for (const SkyKind kind : {SkyKind::atmosphere, SkyKind::preetham}) {
        const Result<light::DrawnSkyError> drawn = light::drawn_sky_error(kind, turbidity, elevation);
        if (!drawn) return drawn.errors();
        maximum = worse(maximum, drawn->of_build), off_model = worse(off_model, drawn->of_model);
        report.note(fmt::format("{}, turbidity {}, sun at {} deg: {:.1e}, of the model {:.1e} in the mean",
                                light::sky_kind_names[std::size_t(kind)], turbidity, elevation,
                                drawn->of_build, drawn->of_model));
      }
      const Result<light::SkyGpuCheck> models = light::check_sky_on_gpu(light::Air{turbidity}, elevation);
      if (!models) return models.errors();
      of_formulas = worse(of_formulas, models->max_relative_error);
    }
  const Result<light::DrawnSkyError> turned = light::drawn_sky_error(SkyKind::atmosphere, 3.0, 10.0, 1.0f);
  if (!turned) return turned.errors();
  report.add("sky_gpu_cpu_relative", maximum, up_to(1e-3));
  report.add_control("sky_gpu_cpu_relative_turned_by_a_degree", turned->of_build, up_to(1e-3));
  report.add("sky_drawn_to_model_mean_relative", off_model, up_to(1e-3));
  report.add_control("sky_drawn_to_model_mean_relative_turned_by_a_degree", turned->of_model, up_to(1e-3));
  report.add("sky_model_gpu_cpu_relative", of_formulas);
  report.note("the sky as the renderer draws it into six views; the formulas of both models by themselves");
  return Done{};
}

/// A point of a sun study, as it looks for the sun, and the hours that the study found there.
struct StudiedPoint {
  light::SunPoint point;
  float hours;
};

/// An even choice among the ground and the facades of a study.
std::vector<StudiedPoint> chosen_points(const light::SunStudy& study, std::size_t count) {
  std::vector<StudiedPoint> all;
  for (const light::GroundCell& cell : study.cells)
    if (cell.kind != light::GroundCell::Kind::nothing)
      all.push_back({light::lifted(cell.position, {0, 0, 1}), cell.hours});
  const std::size_t of_plan = all.size();
  for (std::size_t i = 0; i < study.surfaces.positions.size(); ++i)
    all.push_back(
        {light::lifted(study.surfaces.positions[i], study.surfaces.normals[i]), study.surface_hours[i]});
  std::vector<StudiedPoint> chosen;
  chosen.reserve(count);
  const auto choose = [&](std::size_t first, std::size_t last) {
    const std::size_t wanted = std::min(count / 2, last - first);
    for (std::size_t i = 0; i < wanted; ++i) chosen.push_back(all[first + i * (last - first) / wanted]);
  };
  choose(0, of_plan), choose(of_plan, all.size());
  return chosen;
}

/// Hours of direct sun on one day by the other tracer, a ray at each minute.
std::vector<double> hours_by_minutes(const DoubleTracer& tracer, const std::vector<StudiedPoint>& points,
                                     light::PlaceAndTime when) {
  std::vector<glm::dvec3> suns;
  for (int minute = 0; minute < 24 * 60; ++minute) {
    when.time_of_day_h = (double(minute) + 0.5) / 60.0;
    const light::SolarPosition sun = light::sun_of(when);
    if (sun.elevation_deg() > 0.0) suns.push_back(glm::dvec3(sun.direction()));
  }
  std::vector<double> hours(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    int lit = 0;
    for (const glm::dvec3& sun : suns)
      lit += glm::dot(sun, glm::dvec3(points[i].point.normal)) > 0.0 &&
             !tracer.is_blocked(glm::dvec3(points[i].point.position), sun, 1e-3, StoppedBy::both);
    hours[i] = double(lit) / 60.0;
  });
  return hours;
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

/// The irradiance of a vertex by random rays, apart from VertexLight: no pattern is shared, and what a ray
/// hits gives back light by the texels there in place of the mean of its textures.
glm::vec3 random_irradiance(const reference::RayScene& scene, const light::SkyTable& sky,
                            const light::LitVertex& vertex, int rays, reference::Passage& passage) {
  constexpr float pi = 3.14159265f, open_share = 0.5f;
  const glm::vec3 from = vertex.position + 1e-3f * vertex.normal;
  const auto sun_light = [&](glm::vec3 point, glm::vec3 normal) {
    const float facing = glm::dot(normal, sky.to_sun());
    const bool is_lit = facing > 0.0f && !scene.is_blocked({point, sky.to_sun(), 1e-4f, 1e30f}, passage);
    return is_lit ? facing * sky.sun_irradiance() : glm::vec3(0.0f);
  };
  glm::vec3 sum(0.0f);
  for (int i = 0; i < rays; ++i) {
    glm::vec3 direction;
    float square = 0.0f;
    do {
      for (int axis = 0; axis < 3; ++axis) direction[axis] = passage.random.uniform(-1.0f, 1.0f);
      square = glm::dot(direction, direction);
    } while (square > 1.0f || square < 1e-4f);
    direction /= std::sqrt(square);
    const float facing = glm::dot(direction, vertex.normal);
    if (facing <= 0.0f) continue;
    const std::optional<reference::Hit> hit = scene.nearest_hit({from, direction, 1e-4f, 1e30f}, passage);
    if (!hit) {
      sum += facing * sky.radiance(direction);
      continue;
    }
    const reference::ShadingPoint at = reference::shading_point(*hit, direction, 0.0f);
    const glm::vec3 normal = at.geometric_normal;
    const glm::vec3 irradiance =
        open_share * sky.irradiance(normal) + sun_light(at.position + 1e-3f * normal, normal);
    sum += facing * (1.0f - at.surface.metallic) * at.surface.base_colour / pi * irradiance;
  }
  return 4.0f * pi / float(rays) * sum + sun_light(from, vertex.normal);
}

/// Ten thousand vertices of an object that has moved, in the street of the paper's city, as lit objects are
/// lit.
Status measure_relighting(const reference::RayScene& rays, Report& report) {
  const auto sky = light::make_sky(SkyKind::atmosphere, light::Air{3.0}, sun_at(40.0));
  if (!sky) return sky.errors();
  const light::SkyTable table(**sky);
  light::VertexLight light(tree_of(10'000));
  const auto time_of = [&](int count) {
    light.restart();
    return milliseconds([&] { light.refine(rays, table, count, light::Blocked::bounces); });
  };
  std::vector<double> few(11), many(3);
  for (double& sample : few) sample = time_of(64);
  for (double& sample : many) sample = time_of(1024);
  report.add("relight_10k_vertices_64_rays_ms", median(few).value, up_to(50.0));
  report.add("relight_10k_vertices_1024_rays_ms", median(many));

  const std::vector<light::LitVertex> vertices = tree_of(500);
  std::vector<glm::vec3> truth(vertices.size());
  parallel_for(vertices.size(), [&](std::size_t v) {
    reference::Passage passage{Random(v)};
    truth[v] = random_irradiance(rays, table, vertices[v], 65'536, passage);
  });
  const auto off_percent = [&](int count, light::Blocked blocked) {
    light::VertexLight traced(vertices);
    traced.refine(rays, table, count, blocked);
    return rmse_percent(traced.irradiance(), truth);
  };
  report.add_control("relight_16_rmse_percent", off_percent(16, light::Blocked::bounces), up_to(2.0));
  report.add("relight_256_rmse_percent", off_percent(256, light::Blocked::bounces), up_to(2.0));
  report.add("relight_16k_rmse_percent", off_percent(16'384, light::Blocked::bounces));
  report.add_control("relight_256_rmse_percent_without_bounces", off_percent(256, light::Blocked::dark),
                     up_to(2.0));
  report.note(
      "500 vertices of a tree in the street, against 65,536 random rays each that know the texels they hit; "
      "controls: 16 rays, and 256 without the light that surfaces give back");
  return Done{};
}

/// The study that `parvis sun` makes of the middle of the city, against the other tracer.
Status measure_sun_hours(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  const scene::Scene twin = opaque_twin(city);
  const DoubleTracer tracer(twin);
  double maximum = 0.0, max_hourly = 0.0;
  std::size_t count = 0;
  for (const int day : setup.is_quick ? std::vector{80} : std::vector{80, 172, 355}) {
    light::SunStudyOptions options;
    options.period = {.place = {.day_of_year = day}, .first_day = day, .last_day = day};
    options.area = glm::dvec4(-60.0, -60.0, 60.0, 60.0);
    const auto study = light::study_sun(twin, options);
    if (!study) return study.errors();
    const std::vector<StudiedPoint> chosen = chosen_points(*study, setup.is_quick ? 400 : 4000);
    options.period.step_h = 1.0, options.period.bisections = 0;
    const auto hourly = light::study_sun(twin, options);
    if (!hourly) return hourly.errors();
    const std::vector<double> truth = hours_by_minutes(tracer, chosen, options.period.place);
    const auto error_percent = [&](const std::vector<StudiedPoint>& points) {
      double off = 0.0, sum = 0.0;
      for (std::size_t i = 0; i < points.size(); ++i)
        off += std::abs(double(points[i].hours) - truth[i]), sum += truth[i];
      return 100.0 * off / sum;
    };
    count = chosen.size();
    maximum = worse(maximum, error_percent(chosen));
    max_hourly = worse(max_hourly, error_percent(chosen_points(*hourly, setup.is_quick ? 400 : 4000)));
  }
  report.add("sun_hours_error_percent", maximum, up_to(1.0));
  report.add_control("sun_hours_error_percent_hourly_rays", max_hourly, up_to(1.0));
  report.note(fmt::format(
      "mean difference over {} cells of the plan and vertices of ground and facades of a study of "
      "the paper's city, as a share of the mean hours, against another tracer's rays at each "
      "minute",
      count));
  return Done{};
}

Result<scene::LoadedScene> load_city(const BenchSetup& setup) {
  const ScratchFolder folder;
  if (Status written = city::write_paper_city(folder.path, 1); !written) return written.errors();
  return scene::load_scene(folder.path / "paper_day.xp", setup.house.get<scene::NodeRegistry>());
}

Status measure_city(const BenchSetup& setup, Report& report) {
  const Result<scene::LoadedScene> loaded = load_city(setup);
  if (!loaded) return loaded.errors();
  {
    const reference::RayScene rays(loaded->scene);
    if (Status status = measure_relighting(rays, report); !status) return status;
  }
  if (Status status = measure_lit_object(setup, report); !status) return status;
  for (const auto& measure : {measure_bounced_light, measure_sun_hours, measure_shadows})
    if (Status status = measure(setup, loaded->scene, report); !status) return status;
  return Done{};
}

Status measure(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  for (const auto& measure : {measure_sun, measure_brute_force, count_negatives, measure_gpu, measure_city})
    if (Status status = measure(setup, report); !status) return status.errors();
  return setup.house.get<Benches>().find("vegetation")->run(setup, report);
}

/// The keys shadow_* by themselves.
Status measure_shadows_alone(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  const Result<scene::LoadedScene> loaded = load_city(setup);
  if (!loaded) return loaded.errors();
  return measure_shadows(setup, loaded->scene, report);
}

/// The time of exact shadows by itself.
Status measure_shadow_times_alone(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  const Result<scene::LoadedScene> loaded = load_city(setup);
  if (!loaded) return loaded.errors();
  return measure_shadow_times(loaded->scene, report);
}

/// The keys of bounced light by themselves.
Status measure_bounced_light_alone(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  const Result<scene::LoadedScene> loaded = load_city(setup);
  if (!loaded) return loaded.errors();
  return measure_bounced_light(setup, loaded->scene, report);
}

/// The keys sun_* and sky_* by themselves.
Status measure_sun_and_sky_alone(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  for (const auto& measure : {measure_sun, measure_brute_force, count_negatives, measure_gpu})
    if (Status status = measure(setup, report); !status) return status;
  const Result<scene::LoadedScene> loaded = load_city(setup);
  if (!loaded) return loaded.errors();
  return measure_sun_hours(setup, loaded->scene, report);
}

/// The keys relight_* by themselves.
Status measure_relighting_alone(const BenchSetup& setup, Report& report) {
  const Result<scene::LoadedScene> loaded = load_city(setup);
  if (!loaded) return loaded.errors();
  if (Status status = measure_relighting(reference::RayScene(loaded->scene), report); !status) return status;
  return measure_lit_object(setup, report);
}

}  // namespace

void furnish_light(House& house) {
  house.get<Benches>().add({"shadows", "shadows of each method against exact ones", measure_shadows_alone});
  house.get<Benches>().add(
      {"relighting", "light at the vertices of moved objects", measure_relighting_alone});
  house.get<Benches>().add(
      {"shadow_times", "exact shadows of a picture beside its shadow maps", measure_shadow_times_alone});
  house.get<Benches>().add(
      {"bounced_light", "pictures with bounced light against photographs", measure_bounced_light_alone});
  house.get<Benches>().add(
      {"sun_and_sky", "sun, sky and hours of sun against their ground truths", measure_sun_and_sky_alone});
  house.get<Benches>().add(
      {"light", "sun, sky, shadows and hours of sun against their ground truths", measure});
}

}  // namespace parvis::bench
