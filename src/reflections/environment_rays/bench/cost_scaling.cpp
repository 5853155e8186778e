#include "reflections/environment_rays/bench/cost_scaling.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "bench/reflection_cost.h"
#include "life/traffic/demand.h"
#include "places/paper_city/mirror_bodies.h"
#include "reflections/environment_rays/bench/near_views.h"
#include "reflections/reference_maps/map_cache.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::bench {
namespace {

namespace maps = reference_maps;

constexpr int width = 1280, height = 720;
constexpr int balls_per_side = 10, rings_of_one = 160;
constexpr float ahead_m = 5.5f, ball_radius_m = 1.4f;
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

/// Adds mirror balls across the view, `count` a side, together as large and as finely made as one.
void add_balls(scene::Scene& scene, const Camera& camera, int count) {
  const auto model = std::make_shared<const scene::Model>(city::make_ball(rings_of_one / count));
  const float radius_m = ball_radius_m / float(count);
  const glm::vec3 right(camera.world_from_camera[0]), up(camera.world_from_camera[1]);
  const glm::vec3 middle = camera.position_in_world() + ahead_m * camera.forward_in_world();
  const float half = 0.5f * float(count - 1);
  for (int i = 0; i < count * count; ++i) {
    const int column = i % count, row = i / count;
    const float across = float(column) - half, above = float(row) - half;
    scene::Object ball;
    ball.model = model;
    ball.is_dynamic = ball.takes_reflection = true;
    ball.world_from_model =
        glm::scale(glm::translate(glm::mat4(1.0f), middle + 2.0f * radius_m * (across * right + above * up)),
                   glm::vec3(radius_m));
    scene.objects.push_back(std::move(ball));
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
  Timed timed{*std::move(stage), {}, {}};
  methods::Settings none;
  none.method = "none";
  for (const auto& [name, wanted] : {std::pair{"none", none}, {"mem", reflection}}) {
    Result<JudgedMethod> method = judged_method(*timed.stage, name, wanted);
    if (!method) return method.errors();
    timed.methods.push_back(*std::move(method));
  }
  return timed;
}

/// Samples of both in turn.
Status time_in_turn(Timed& a, Timed& b, const Camera& camera, int repeats) {
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (Timed* one : {repeat % 2 == 0 ? &a : &b, repeat % 2 == 0 ? &b : &a}) {
      const Result<std::vector<ReflectionCost>> costs =
          reflection_costs(*one->stage, one->methods, camera, width, height, 1, Frames::left_out);
      if (!costs) return costs.errors();
      one->ms.push_back((*costs)[1].ms.front());
    }
  return Done{};
}

double reflective_pixels(house::Stage& stage, const Camera& camera) {
  const reference::TracedPicture traced = stage.trace(camera, width, height, 1);
  return double(std::ranges::count_if(traced.mirror_mask.pixels, [](int share) { return share > 0; }));
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

}  // namespace

Status measure_body_count(const House& house, const scene::Scene& city, const methods::Settings& reflection,
                          int repeats, Report& report) {
  const Result<Camera> camera = street_camera(city);
  if (!camera) return camera.errors();
  scene::Scene with_one = without_traffic(city), with_many = with_one;
  add_balls(with_one, *camera, 1);
  add_balls(with_many, *camera, balls_per_side);
  Result<Timed> one = timed(house, with_one, reflection), many = timed(house, with_many, reflection);
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
  report.add("cost_ratio_100_over_1", ratio_in_turn(of_many, of_one));
  report.add("pixel_ns", median(of_one));
  return Done{};
}

Status measure_city_size(const House& house, const scene::Scene& city, const methods::Settings& reflection,
                         int repeats, Report& report) {
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
  report.add("city_10km2_cost_over_1km2", ratio_in_turn(there->ms, here->ms));
  return Done{};
}

}  // namespace parvis::bench
