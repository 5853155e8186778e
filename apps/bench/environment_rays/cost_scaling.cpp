#include "bench/environment_rays/cost_scaling.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "bench/environment_rays/near_views.h"
#include "bench/environment_rays/timed_pictures.h"
#include "bench/flip_between.h"
#include "bench/reflection_cost.h"
#include "graphics/shading/tone_curve.h"
#include "life/traffic/demand.h"
#include "reflections/reference_maps/map_cache.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::bench {
namespace {

namespace maps = reference_maps;

constexpr int width = 1280, height = 720;
constexpr int control_width = 2 * width, control_height = 2 * height;  // of a picture that costs more
constexpr int cars_per_side = 10;
constexpr float ahead_m = 5.5f;
constexpr int samples_per_pixel = 16;
constexpr double max_ratio_100 = 1.5, max_ratio_city = 1.2, max_flip_ratio_city = 1.1;
constexpr float tile_m = 1000.0f;  // a side of the city
constexpr int tiles_east = 5, tiles_north = 2, middle_tile = tiles_east / 2;

/// The scene without its traffic: what drives is put into it where it is wanted.
scene::Scene without_traffic(const scene::Scene& city) {
  scene::Scene scene = city;  // models are shared
  scene.data<traffic::TrafficDemand>().vehicles = 0;
  return scene;
}

Result<Camera> street_camera(const scene::Scene& scene) {
  const scene::NamedCamera* named = scene.find_camera("street");
  if (!named) return error("the city has no camera \"street\"");
  return scene.camera_now(*named);
}

/// Adds cars across the view, seen from the side, `count` a side, which together cover what one does: the
/// same model, a `count`th as large.
void add_cars(scene::Scene& scene, const Camera& camera, int count) {
  const std::shared_ptr<const scene::Model> model = scene.data<traffic::TrafficDemand>().models.front();
  const Bounds box = scene::bounds(*model);
  const float scale = 1.0f / float(count);
  const glm::vec3 right(camera.world_from_camera[0]), up(camera.world_from_camera[1]),
      ahead = camera.forward_in_world();
  const glm::vec3 middle = camera.position_in_world() + ahead_m * ahead;
  const float half = 0.5f * float(count - 1);
  for (int i = 0; i < count * count; ++i) {
    const int row = i / count;
    const float across = (float(i % count) - half) * scale * box.size().x,
                above = (float(row) - half) * scale * box.size().z;
    scene::Object car;
    car.model = model;
    car.is_dynamic = car.takes_reflection = true;
    car.world_from_model =
        glm::mat4(glm::vec4(scale * right, 0.0f), glm::vec4(scale * ahead, 0.0f), glm::vec4(scale * up, 0.0f),
                  glm::vec4(middle + across * right + above * up, 1.0f)) *
        glm::translate(glm::mat4(1.0f), -box.centre());
    scene.objects.push_back(std::move(car));
  }
}

/// A stage with the methods that a cost takes: without reflections, and with them.
struct Timed {
  std::unique_ptr<house::Stage> stage;
  std::vector<JudgedMethod> methods;
  std::vector<double> ms;
};

Result<Timed> timed(const House& house, const scene::Scene& scene, const methods::Settings& reflection) {
  Result<std::unique_ptr<house::Stage>> stage = house::Stage::create(house::make_play(house, scene));
  if (!stage) return stage.errors();
  Result<std::vector<JudgedMethod>> methods =
      judged_methods(**stage, {{"none", methods::Settings{"none"}}, {"mem", reflection}});
  if (!methods) return methods.errors();
  return Timed{*std::move(stage), *std::move(methods), {}};
}

/// Adds a sample of a picture's reflections.
Status time_once(Timed& one, const Camera& camera, int w, int h, std::vector<double>& ms) {
  const Result<std::vector<ReflectionCost>> costs =
      reflection_costs(*one.stage, one.methods, camera, w, h, 1, Frames::left_out);
  if (!costs) return costs.errors();
  ms.push_back((*costs)[1].ms.front());
  return Done{};
}

/// Samples of both in turn.
Status time_in_turn(Timed& a, Timed& b, const Camera& camera, int repeats) {
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (Timed* one : {repeat % 2 == 0 ? &a : &b, repeat % 2 == 0 ? &b : &a})
      if (Status status = time_once(*one, camera, width, height, one->ms); !status) return status;
  return Done{};
}

double reflective_pixels(house::Stage& stage, const Camera& camera) {
  const reference::TracedPicture traced = stage.trace(camera, width, height, 1);
  return double(std::ranges::count_if(traced.mirror_mask.pixels, [](int share) { return share > 0; }));
}

/// The control of `cost_ratio_100_over_1`: maps that are rendered again for each body cost what there are
/// bodies, not what there are pixels, of which both pictures have about as many.
Status time_control(const House& house, const scene::Scene& with_one, const scene::Scene& with_many,
                    const Camera& camera, Report& report) {
  const methods::Settings rerendered{"rerendered_cube_map", 128, false};
  Result<Timed> one = timed(house, with_one, rerendered), many = timed(house, with_many, rerendered);
  if (!one) return one.errors();
  if (!many) return many.errors();
  if (Status status = time_in_turn(*one, *many, camera, 1); !status) return status;
  report.add_control("cost_ratio_100_over_1_of_rerendered", ratio_in_turn(many->ms, one->ms).value,
                     up_to(max_ratio_100));
  return Done{};
}

/// The city ten times over, beside itself, with maps at `places` of each.
scene::Scene ten_cities(const scene::Scene& city, const std::vector<glm::vec3>& places) {
  scene::Scene scene = city;
  for (int north = 0; north < tiles_north; ++north)
    for (int east = 0; east < tiles_east; ++east) {
      const glm::vec3 offset(float(east - middle_tile) * tile_m, float(north) * tile_m, 0.0f);
      for (const glm::vec3& place : places) reference_maps::map_plan(scene).places.push_back(place + offset);
      if (offset == glm::vec3(0.0f)) continue;
      for (const scene::Object& object : city.objects) {
        if (object.is_dynamic) continue;
        scene.objects.push_back(object);
        scene.objects.back().world_from_model =
            glm::translate(glm::mat4(1.0f), offset) * object.world_from_model;
      }
    }
  return scene;
}

/// Keeps for the ten what is kept for the one: each of them looks the same from within.
Status copy_maps(const maps::MapCache& of_one, std::size_t count, const scene::Scene& ten) {
  const maps::MapCache of_ten(ten);
  for (std::size_t i = 0; i < reference_maps::map_plan(ten).places.size(); ++i) {
    std::optional<maps::MapFile> map = of_one.read(i % count);
    if (!map) return error("{}: a map is missing", of_one.file(i % count).string());
    map->places = reference_maps::map_plan(ten).places;
    map->number = std::uint32_t(i);
    if (Status status = of_ten.write(*std::move(map)); !status) return status;
  }
  return Done{};
}

/// The views in which both cities are judged.
struct JudgedViews {
  int count, width, height;
};

/// FLIP of some of a stage's methods in a view, against its own ray-traced picture.
Result<std::vector<double>> flips_in(Timed& timed, const NearView& view, const JudgedViews& views,
                                     std::initializer_list<std::size_t> methods) {
  const reference::TracedPicture truth =
      timed.stage->trace(view.camera, views.width, views.height, samples_per_pixel, view.window);
  const Image8 expected = shading::tone_mapped_picture(truth.radiance, timed.stage->scene().exposure);
  std::vector<double> flips;
  for (const std::size_t method : methods) {
    const Result<double> flip = flip_between(
        picture_of(*timed.stage, timed.methods[method], view.camera, views.width, views.height, view.window),
        expected, truth.mirror_mask);
    if (!flip) return flip.errors();
    flips.push_back(*flip);
  }
  return flips;
}

/// `city_10km2_flip_over_1km2`, each city against its own ray-traced pictures; the control has no
/// reflections.
Status compare_cities(Timed& here, Timed& there, const JudgedViews& judged, Report& report) {
  NearViews views(*here.stage, judged.width, judged.height);
  double flip_here = 0.0, flip_there = 0.0, flip_none = 0.0;
  for (int i = 0; i < judged.count; ++i) {
    const Result<NearView> view = views.next();
    if (!view) return view.errors();
    const Result<std::vector<double>> of_one = flips_in(here, *view, judged, {1}),
                                      of_ten = flips_in(there, *view, judged, {1, 0});
    if (!of_one) return of_one.errors();
    if (!of_ten) return of_ten.errors();
    flip_here += of_one->front() / judged.count;
    flip_there += of_ten->front() / judged.count;
    flip_none += of_ten->back() / judged.count;
  }
  report.note(fmt::format("FLIP of mem in {} views of {} x {}: {:.4f} in 1 km2, {:.4f} in 10 km2",
                          judged.count, judged.width, judged.height, flip_here, flip_there));
  report.add("city_10km2_flip_over_1km2", flip_there / flip_here, up_to(max_flip_ratio_city));
  report.add_control("city_10km2_flip_over_1km2_without_reflections", flip_none / flip_here,
                     up_to(max_flip_ratio_city));
  return Done{};
}

}  // namespace

Status measure_body_count(const House& house, const scene::Scene& city, const methods::Settings& reflection,
                          int repeats, Report& report) {
  const Result<Camera> camera = street_camera(city);
  if (!camera) return camera.errors();
  scene::Scene with_one = without_traffic(city), with_many = with_one;
  if (city.data<traffic::TrafficDemand>().models.empty()) return error("the city's traffic has no car");
  add_cars(with_one, *camera, 1);
  add_cars(with_many, *camera, cars_per_side);
  methods::Settings same_detail = reflection;  // for near cars and far ones
  same_detail.uses_level_of_detail = false;
  Result<Timed> one = timed(house, with_one, same_detail), many = timed(house, with_many, same_detail);
  if (!one) return one.errors();
  if (!many) return many.errors();
  if (Status status = time_in_turn(*one, *many, *camera, repeats); !status) return status;
  const auto ns_per_pixel = [&](const Timed& timed) {
    const double pixels = reflective_pixels(*timed.stage, *camera);
    std::vector<double> samples;
    samples.reserve(timed.ms.size());
    for (const double ms : timed.ms) samples.push_back(1e6 * ms / pixels);
    const Median ns = median(samples);
    report.note(fmt::format("{} reflective pixels: {:.1f} ns each ({:.1f} to {:.1f})", pixels, ns.value,
                            ns.low, ns.high));
    return samples;
  };
  const std::vector<double> of_one = ns_per_pixel(*one), of_many = ns_per_pixel(*many);
  report.note(
      "the hundred: the same car a tenth as large, ten by ten on a board across the view; all detail");
  report.add("cost_ratio_100_over_1", ratio_in_turn(of_many, of_one).value, up_to(max_ratio_100));
  report.add("pixel_ns", median(of_one));
  const Result<JudgedMethod> rays = judged_method(*many->stage, "traced", methods::Settings{"traced"});
  if (!rays) return rays.errors();
  const Result<FlipOverNone> flip = flip_over_none(*many->stage, {many->methods[1], many->methods[0], *rays},
                                                   *camera, width, height, {0, 0, width, height});
  if (!flip) return flip.errors();
  report_shown(*flip, "cost_100_flip_mem_over_none", report);
  return time_control(house, with_one, with_many, *camera, report);
}

Status measure_city_size(const House& house, const scene::Scene& city, const methods::Settings& reflection,
                         bool is_quick, int repeats, Report& report) {
  scene::Scene small = without_traffic(house::make_play(house, city).scene);  // cars stand where it begins
  methods::settings(small) = reflection;
  const maps::MapCache kept(small);
  const std::optional<maps::MapFile> first = kept.read(0);
  if (!first) return error("{}: no maps of the city are kept", kept.folder().string());
  const scene::Scene large = ten_cities(small, first->places);
  if (Status status = copy_maps(kept, first->places.size(), large); !status) return status;
  Result<Timed> here = timed(house, small, reflection), there = timed(house, large, reflection);
  if (!here) return here.errors();
  if (!there) return there.errors();
  const Result<NearView> view = NearViews(*here->stage, width, height).next();
  if (!view) return view.errors();
  const Camera& camera = view->camera;
  if (Status status = time_in_turn(*here, *there, camera, repeats); !status) return status;
  const auto cost = [&](const char* where, std::size_t map_count, const Timed& timed) {
    const Median ms = median(timed.ms);
    report.note(fmt::format("{}, {} maps: {} reflective pixels, {:.2f} ms ({:.2f} to {:.2f})", where,
                            map_count, reflective_pixels(*timed.stage, camera), ms.value, ms.low, ms.high));
  };
  cost("1 km2", first->places.size(), *here);
  cost("10 km2", reference_maps::map_plan(large).places.size(), *there);
  report.add("city_10km2_cost_over_1km2", ratio_in_turn(there->ms, here->ms).value, up_to(max_ratio_city));
  std::vector<double> larger_ms;  // of four times the pixels: the clock notices what costs more
  for (std::size_t i = 0; i < there->ms.size(); ++i)
    if (Status status = time_once(*there, camera, control_width, control_height, larger_ms); !status)
      return status;
  report.add_control("city_10km2_cost_over_1km2_of_four_times_the_pixels",
                     ratio_in_turn(larger_ms, here->ms).value, up_to(max_ratio_city));
  return compare_cities(*here, *there,
                        is_quick ? JudgedViews{3, width / 2, height / 2} : JudgedViews{6, width, height},
                        report);
}

}  // namespace parvis::bench
