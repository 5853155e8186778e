// What the cost of reflections follows: their pixels, not the number of bodies nor the size of the city.
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "bench/parts.h"
#include "bench/reflections/judged_method.h"
#include "bench/reflections/views.h"
#include "graphics/shading/tone_curve.h"
#include "life/traffic/demand.h"
#include "reflections/reference_maps/map_cache.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::bench {
namespace {

namespace maps = reference_maps;

constexpr int cars_per_side = 10;
constexpr float ahead_m = 5.5f;
constexpr int samples_per_pixel = 16;
constexpr float tile_m = 1000.0f;  // a side of the city
constexpr int tiles_east = 5, tiles_north = 2, middle_tile = tiles_east / 2;

/// The scene without its traffic: what drives is put into it where it is wanted.
scene::Scene without_traffic(scene::Scene scene) {
  scene.data<traffic::TrafficDemand>().vehicles = 0;
  return scene;
}

/// Adds cars across the view, seen from the side, `count` a side, which together cover what one does: the
/// same model, a `count`th as large.
void add_cars(scene::Scene& scene, const Camera& camera, int count) {
  const std::shared_ptr<const scene::Model> model = scene.data<traffic::TrafficDemand>().models.front();
  const Bounds box = scene::bounds(*model);
  const float scale = 1.0f / float(count), half = 0.5f * float(count - 1);
  const glm::vec3 right(camera.world_from_camera[0]), up(camera.world_from_camera[1]),
      ahead = camera.forward_in_world(), middle = camera.position_in_world() + ahead_m * ahead;
  for (int i = 0; i < count * count; ++i) {
    const float across = (float(i % count) - half) * scale * box.size().x,
                above = (float(i / count) - half) * scale * box.size().z;
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
  std::unique_ptr<stage::Stage> stage;
  std::vector<JudgedMethod> methods;
  std::vector<double> ms = {};

  Timed(const scene::Scene& scene, const methods::Settings& reflection)
      : stage(stage_of(scene)),
        methods(judged_methods(*stage, {{"none", usual("none")}, {"it", reflection}})) {}

  /// A sample of a picture's reflections.
  double sample(const Camera& camera, glm::ivec2 size) {
    return reflection_costs(*stage, methods, camera, size, {.step_s = 0.0})[1].ms.front();
  }
};

/// Samples of both in turn.
void time_in_turn(Timed& a, Timed& b, const Camera& camera, int repeats) {
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (Timed* one : {repeat % 2 == 0 ? &a : &b, repeat % 2 == 0 ? &b : &a})
      one->ms.push_back(one->sample(camera, full_picture));
}

double reflective_pixels(stage::Stage& stage, const Camera& camera) {
  const reference::TracedPicture traced = stage.trace(camera, full_picture.x, full_picture.y, 1);
  return double(std::ranges::count_if(traced.mirror_mask.pixels, [](int weight) { return weight > 0; }));
}

/// The city ten times over, beside itself, with maps at `places` of each.
scene::Scene ten_cities(const scene::Scene& city, const std::vector<glm::vec3>& places) {
  scene::Scene scene = city;
  for (int north = 0; north < tiles_north; ++north)
    for (int east = 0; east < tiles_east; ++east) {
      const glm::vec3 offset(float(east - middle_tile) * tile_m, float(north) * tile_m, 0.0f);
      for (const glm::vec3& place : places) maps::map_plan(scene).places.push_back(place + offset);
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
void copy_maps(const maps::MapCache& of_one, std::size_t count, const scene::Scene& ten) {
  const maps::MapCache of_ten(ten);
  for (std::size_t i = 0; i < maps::map_plan(ten).places.size(); ++i) {
    std::optional<maps::MapFile> map = of_one.read(i % count);
    if (!map) fail("{}: a map is missing", of_one.file(i % count).string());
    map->places = maps::map_plan(ten).places;
    map->number = std::uint32_t(i);
    must(of_ten.write(*std::move(map)));
  }
}

/// FLIP of some of a stage's methods in a view, against its own ray-traced picture.
std::vector<double> flips_in(Timed& timed, const NearView& view, glm::ivec2 size,
                             std::initializer_list<std::size_t> methods) {
  const reference::TracedPicture truth =
      timed.stage->trace(view.camera, size.x, size.y, samples_per_pixel, view.window);
  const Image8 expected = shading::tone_mapped_picture(truth.radiance, timed.stage->scene().exposure);
  std::vector<double> flips;
  for (const std::size_t method : methods)
    flips.push_back(
        flip_between(picture_of(*timed.stage, timed.methods[method], view.camera, size, view.window),
                     expected, truth.mirror_mask));
  return flips;
}

/// Each city against its own ray-traced pictures; the control has no reflections.
void compare_cities(Timed& here, Timed& there, int count, glm::ivec2 size, Report& report) {
  NearViews views(*here.stage, size);
  double flip_here = 0.0, flip_there = 0.0, flip_none = 0.0;
  for (int i = 0; i < count; ++i) {
    const NearView view = views.next();
    const std::vector<double> of_one = flips_in(here, view, size, {1}),
                              of_ten = flips_in(there, view, size, {1, 0});
    flip_here += of_one[0], flip_there += of_ten[0], flip_none += of_ten[1];
  }
  report.note(fmt::format("FLIP of mem in {} views of {} x {}: {:.4f} in 1 km2, {:.4f} in 10 km2", count,
                          size.x, size.y, flip_here / count, flip_there / count));
  report.add("city_10km2_flip_over_1km2", flip_there / flip_here);
  report.add("city_10km2_flip_over_1km2_without_reflections", flip_none / flip_here);
}

}  // namespace

void measure_body_count(const scene::Scene& city, const BenchSetup& setup, Report& report) {
  const scene::NamedCamera* named = city.find_camera("street");
  if (!named) fail("the city has no camera \"street\"");
  if (city.data<traffic::TrafficDemand>().models.empty()) fail("the city's traffic has no car");
  const Camera camera = must(city.camera_now(*named));
  scene::Scene with_one = without_traffic(city), with_many = with_one;
  add_cars(with_one, camera, 1);
  add_cars(with_many, camera, cars_per_side);
  methods::Settings same_detail = shipped_maps();  // for near cars and far ones
  same_detail.uses_level_of_detail = false;
  Timed one(with_one, same_detail), many(with_many, same_detail);
  time_in_turn(one, many, camera, setup.is_quick ? 7 : 30);
  const auto ns_per_pixel = [&](Timed& timed) {
    const double pixels = reflective_pixels(*timed.stage, camera);
    for (double& ms : timed.ms) ms *= 1e6 / pixels;
    return timed.ms;
  };
  const std::vector<double> of_one = ns_per_pixel(one), of_many = ns_per_pixel(many);
  report.add("cost_ratio_100_over_1", ratio_in_turn(of_many, of_one).value);
  report.add("pixel_ns", median(of_one));
  report.add("pixel_ns_of_100", median(of_many));
  report_shown(*many.stage, many.methods[1], camera, full_picture, "cost_100_flip_mem_over_none", report);
  // Maps that are rendered again for each body cost what there are bodies, not what there are pixels.
  Timed one_again(with_one, usual("rerendered_cube_map")),
      many_again(with_many, usual("rerendered_cube_map"));
  time_in_turn(one_again, many_again, camera, 1);
  report.add("cost_ratio_100_over_1_of_rerendered", ratio_in_turn(many_again.ms, one_again.ms).value);
}

void measure_city_size(const scene::Scene& city, const BenchSetup& setup, Report& report) {
  scene::Scene small =
      without_traffic(stage::make_simulation(rooms::all_registries(), city).scene);  // cars stand
  methods::settings(small) = shipped_maps();
  const maps::MapCache kept(small);
  const std::optional<maps::MapFile> first = kept.read(0);
  if (!first) fail("{}: no maps of the city are kept", kept.folder().string());
  const scene::Scene large = ten_cities(small, first->places);
  copy_maps(kept, first->places.size(), large);
  Timed here(small, shipped_maps()), there(large, shipped_maps());
  const Camera camera = NearViews(*here.stage, full_picture).next().camera;
  time_in_turn(here, there, camera, setup.is_quick ? 7 : 30);
  report.note(fmt::format("{} maps: {} reflective pixels, {:.2f} ms; {} maps: {}, {:.2f} ms",
                          first->places.size(), reflective_pixels(*here.stage, camera), median(here.ms).value,
                          maps::map_plan(large).places.size(), reflective_pixels(*there.stage, camera),
                          median(there.ms).value));
  report.add("city_10km2_cost_over_1km2", ratio_in_turn(there.ms, here.ms).value);
  std::vector<double> larger_ms;  // of four times the pixels: the clock notices what costs more
  for (std::size_t i = 0; i < there.ms.size(); ++i)
    larger_ms.push_back(there.sample(camera, 2 * full_picture));
  report.add("city_10km2_cost_over_1km2_of_four_times_the_pixels", ratio_in_turn(larger_ms, here.ms).value);
  compare_cities(here, there, setup.is_quick ? 3 : 6, setup.is_quick ? full_picture / 2 : full_picture,
                 report);
}

}  // namespace parvis::bench
