// The kitchen of curved mirrors and of glass: where mirrors show what stands in it, their pictures beside
// cube maps that are rendered again, and what a frame takes.
#include "places/kitchen/kitchen.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

#include "base/random.h"
#include "bench/curved/map_search.h"
#include "bench/parts.h"
#include "bench/reflections/judged_method.h"
#include "graphics/gl/context.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/ray_scene.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/reflection_search/test_exact_reflection.h"
#include "reflections/reflector_maps/reflector_cache.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "reflections/reflector_maps/surface_rays.h"
#include "reflections/virtual_objects/search_settings.h"
#include "scene/data/scene.h"

namespace parvis::bench {
namespace {

constexpr int samples_per_pixel = 16;

/// FLIP to the ray tracer inside what mirrors or refracts, by the stage's own method over the baseline.
void measure_beside_rerendered(stage::Stage& stage, std::span<const char* const> cameras, glm::ivec2 size,
                               const std::string& key, Report& report) {
  const std::vector<JudgedMethod> methods =
      judged_methods(stage, {{"virtual objects", methods::settings(stage.scene())},
                             {"rerendered cube maps", rerendered_baseline(stage.scene())},
                             {"none", usual("none")}});
  std::array<double, 3> sums{};
  for (const char* name : cameras) {
    const Camera camera = must(stage.camera(name));
    const reference::TracedPicture truth = stage.trace(camera, size.x, size.y, samples_per_pixel);
    const Image8 expected = shading::tone_mapped_picture(truth.radiance, stage.scene().exposure);
    std::array<double, 3> flips{};
    for (std::size_t m = 0; m < methods.size(); ++m) {
      sums[m] += flips[m] =
          flip_between(picture_of(stage, methods[m], camera, size), expected, truth.mirror_mask);
    }
    report.note(fmt::format("{}: FLIP inside {:.4f}, cube maps {:.4f}, without reflections {:.4f}", name,
                            flips[0], flips[1], flips[2]));
  }
  report.add(key, sums[0] / sums[1]);
  report.add(key + "_without_reflections", sums[2] / sums[1]);
}

/// A point that is not shown where it is, or not at all, counts as so many pixels; so does a pixel whose
/// point is shown in another place, too, where the mirror does not show it.
inline constexpr double missed_px = 100.0;

/// How far from the truth a search shows what mirrors show.
struct ReflectedPointErrors {
  std::vector<double>
      px;  ///< of each pixel, and beside them missed_px of each whose point is shown once more
  std::size_t missed = 0, extra = 0;
};

/// A search over one map; `layer` is search_patch's.
using PatchSearch =
    std::function<MapSearch::PatchPoint(MapSearch& search, const MapSearch::ReflectionTask& task, int layer)>;

using namespace reflection_search;
using namespace reflector_maps;

constexpr std::size_t max_tries = 400;  // for each pixel that is wanted
constexpr float off_surface_m = 1e-4f;
constexpr double wrong_rad = 0.0175;  // a degree between bisector and normal: the mirror shows something else
constexpr float seen_share = 0.999f;  // of the way to a point that is seen

glm::vec2 pixel_of(const glm::mat4& pixel_from_world, glm::vec3 point) {
  const glm::vec4 p = pixel_from_world * glm::vec4(point, 1.0f);
  return glm::vec2(p) / p.w;
}
/// Compares, at sampled pixels of a view, what mirror rays hit with where the search shows it.
class ReflectedPoints {
 public:
  /// Makes the maps of all mirrors of a scene, as the renderer does; `scene` stays where it is.
  static ReflectedPoints make(const scene::Scene& scene) {
    ReflectedPoints made;
    made.scene_ = &scene;
    made.rays_ = std::make_unique<reference::RayScene>(scene);
    const ReflectorCache cache(scene);
    for (const scene::Object& object : scene.objects) {
      if (!object.takes_reflection || made.mirrors_.contains(object.model.get())) continue;
      Reflector reflector = must(cache.reflector(mirror_source(scene, object)));
      Mirror& mirror = made.mirrors_[object.model.get()];
      mirror.reflector = std::move(reflector);
      for (const ReflectorPatch& patch : mirror.reflector.patches)
        mirror.patches.push_back(std::make_unique<SurfaceRays>(mirror.reflector.mesh, patch.triangles));
    }
    return made;
  }

  /// Errors in `count` random pixels that show mirrors which show the scene: pixels between where the fine
  /// mesh, with interpolated normals, mirrors a point and where the search finds it mirrored.
  ReflectedPointErrors errors(const Camera& camera, glm::ivec2 size, std::size_t count,
                              const PatchSearch& search) const {
    const glm::mat4 clip_from_world =
        camera.clip_from_camera(float(size.x) / float(size.y)) * camera.camera_from_world();
    const glm::mat4 pixel_from_world =
        glm::scale(glm::mat4(1.0f), {0.5f * float(size.x), 0.5f * float(size.y), 1.0f}) * clip_from_world;
    Random random(3);
    ReflectedPointErrors errors;
    for (std::size_t i = 0; errors.px.size() < count + errors.extra && i < max_tries * count; ++i) {
      const glm::vec2 pixel(random.uniform(0.0f, float(size.x)), random.uniform(0.0f, float(size.y)));
      const reference::Ray ray = reference::camera_ray(camera, size.x, size.y, pixel);
      const auto hit = rays_->nearest_hit(ray);
      if (!hit || !hit->place->is_mirror) continue;
      const scene::Object& object = scene_->objects[std::size_t(hit->place->object)];
      judge(mirrors_.at(object.model.get()), object, camera, pixel_from_world, ray.direction, search, errors);
    }
    return errors;
  }

 private:
  /// A mirror's maps, and the fine mesh of each patch.
  struct Mirror {
    reflector_maps::Reflector reflector;
    std::vector<std::unique_ptr<reflector_maps::SurfaceRays>> patches;
  };
  /// Adds the errors of one pixel, where its mirror shows the scene.
  void judge(const Mirror& mirror, const scene::Object& object, const Camera& camera,
             const glm::mat4& pixel_from_world, glm::vec3 direction, const PatchSearch& search_patch,
             ReflectedPointErrors& errors) const {
    const glm::mat4 world_from_reflector = object.world_from_model,
                    reflector_from_world = glm::inverse(world_from_reflector);
    const glm::vec3 eye = reflector_from_world * glm::vec4(camera.position_in_world(), 1.0f),
                    along = glm::normalize(glm::vec3(reflector_from_world * glm::vec4(direction, 0.0f)));
    std::optional<MetSurface> at;
    std::size_t patch = 0;
    for (std::size_t i = 0; i < mirror.patches.size(); ++i)
      if (const auto met = mirror.patches[i]->along(eye, along);
          met && (!at || glm::distance(met->position, eye) < glm::distance(at->position, eye)))
        at = met, patch = i;
    if (!at || glm::dot(at->normal, along) >= 0.0f) return;
    const glm::vec3 mirrored = glm::mat3(world_from_reflector) * glm::reflect(along, at->normal);
    const glm::vec3 from = world_from_reflector * glm::vec4(at->position + off_surface_m * at->normal, 1.0f);
    const glm::vec3 unit = glm::normalize(mirrored);
    const auto hit = rays_->nearest_hit({from, unit});
    if (!hit || &scene_->objects[std::size_t(hit->place->object)] == &object) return;
    const auto add = [&](double px) {
      errors.px.push_back(px);
      errors.missed += px >= missed_px;
    };
    if (patch >= mirror.reflector.maps.size()) return add(missed_px);

    const ReflectorMap& map = mirror.reflector.maps[patch];
    MapSearch search{map};
    const glm::vec3 vertex = reflector_from_world * glm::vec4(from + hit->distance_m * unit, 1.0f);
    const MapSearch::ReflectionTask task{eye, vertex, map.window.centre};
    const auto on_screen = [&](glm::vec3 point) {
      return pixel_of(pixel_from_world, world_from_reflector * glm::vec4(point, 1.0f));
    };
    double nearest_px = missed_px;
    bool has_extra = false;
    const int first = map.shows_once ? -1 : 0, end = map.shows_once ? 0 : search.layer_count;
    for (int layer = first; layer < end; ++layer) {
      const MapSearch::PatchPoint found = search_patch(search, task, layer);
      if (!search.is_found(found)) continue;
      nearest_px = std::min(nearest_px,
                            double(glm::distance(on_screen(found.point.position), on_screen(at->position))));
      has_extra = has_extra || is_extra(mirror, patch, found.point, task);
    }
    add(nearest_px);
    if (!has_extra) return;
    errors.px.push_back(missed_px);
    ++errors.extra;
  }
  /// Is a point that a search has found shown by the patch, seen by the viewer, and wrong? The patch's own
  /// mesh says so; what the search finds beyond it belongs to another patch, and is not drawn.
  static bool is_extra(const Mirror& mirror, std::size_t patch, const MapSearch::ReflectionPoint& point,
                       const MapSearch::ReflectionTask& task);

  const scene::Scene* scene_ = nullptr;
  std::unique_ptr<reference::RayScene> rays_;
  std::unordered_map<const scene::Model*, Mirror> mirrors_;
};

bool ReflectedPoints::is_extra(const Mirror& mirror, std::size_t patch,
                               const MapSearch::ReflectionPoint& point,
                               const MapSearch::ReflectionTask& task) {
  const std::optional<MetSurface> met = mirror.patches[patch]->along(task.centre, point.direction);
  if (!met || glm::dot(task.viewer - met->position, met->normal) <= 0.0f ||
      glm::dot(task.vertex - met->position, met->normal) <= 0.0f ||
      bisector_angle(met->position, met->normal, task.viewer, task.vertex) < wrong_rad)
    return false;
  const float away = seen_share * glm::distance(met->position, task.viewer);
  return std::ranges::none_of(mirror.patches, [&](const auto& before) {
    const std::optional<MetSurface> first = before->along(task.viewer, met->position - task.viewer);
    return first && glm::distance(first->position, task.viewer) < away;
  });
}
/// The second also shows the bowl's concave side and its rim: each is drawn in 17 layers.
constexpr std::array timed_cameras{"bowl in the kettle", "at the kettle"};
constexpr glm::ivec2 timed_size{480, 300};
constexpr int turns = 2;  // each frame takes seconds in software

std::vector<std::pair<std::string, methods::Settings>> ways_to_reflect(const scene::Scene& scene) {
  const methods::Settings& by_area = methods::settings(scene);
  methods::Settings every = by_area;
  every.uses_level_of_detail = false;
  std::vector<std::pair<std::string, methods::Settings>> variants{{"every vertex", every}};
  for (const float share : {0.143f, 0.096f, 0.055f, 0.041f}) {
    methods::Settings grid = every;
    grid.own.get<virtual_objects::SearchSettings>().grid_share = share;
    variants.emplace_back(fmt::format("a grid of {:.1f} %", 100.0f * share), grid);
  }
  variants.emplace_back("grids by area", by_area);
  variants.emplace_back("re-rendered cube maps", rerendered_baseline(scene));
  return variants;
}

void measure_view(stage::Stage& stage, const std::vector<JudgedMethod>& methods, const char* name,
                  Report& report) {
  const Camera camera = must(stage.camera(name));
  std::vector<std::vector<double>> frame_s(methods.size()), processor_s(methods.size());
  for (int turn = -1; turn < turns; ++turn)  // the first makes what is made once
    for (std::size_t m = 0; m < methods.size(); ++m) {
      must(stage.renderer().set_reflection(methods[m].reflections.get()));
      glFinish();
      const std::clock_t begun = std::clock();
      const double ms = finished_ms([&] { draw_again(stage, methods[m], camera, timed_size); });
      if (turn < 0) continue;
      frame_s[m].push_back(1e-3 * ms);
      processor_s[m].push_back(double(std::clock() - begun) / CLOCKS_PER_SEC);
    }
  for (std::size_t m = 0; m < methods.size(); ++m)
    report.note(fmt::format("{}, 480 x 300, {}: {:.2f} s per frame, {:.2f} s of processors", name,
                            methods[m].name, median(frame_s[m]).value, median(processor_s[m]).value));
}

/// Notes the time of a frame of the kitchen with every vertex searched for, with its grids, and with cube
/// maps.
void note_frames(stage::Stage& stage, Report& report) {
  const std::vector<JudgedMethod> methods = judged_methods(stage, ways_to_reflect(stage.scene()));
  for (const char* name : timed_cameras) measure_view(stage, methods, name, report);
}

constexpr std::array cameras{"at the kettle", "into the bowl", "figure 6", "at the pans", "at the spoons"};
// Of convex mirrors, and of a concave one, which is drawn in many layers, each as slow as a picture.
constexpr std::size_t quick_cameras = 2;
constexpr std::size_t views_that_may_miss = 1;
constexpr glm::ivec2 mirrors_size{960, 600};
constexpr std::size_t points = 4000, quick_points = 400;  // of each camera

MapSearch::PatchPoint by_shipped_search(MapSearch& search, const MapSearch::ReflectionTask& task, int layer) {
  return search.search_patch(task, search.patch_kind(), layer);
}

/// The control: the paper's search finds one point, whatever the layer.
MapSearch::PatchPoint by_paper_search(MapSearch& search, const MapSearch::ReflectionTask& task, int) {
  return by_midpoint(search, task);
}

/// The bound that all views reach but those that may miss it.
double reached_px(std::vector<double> p99_of_views) {
  std::ranges::sort(p99_of_views);
  return p99_of_views[p99_of_views.size() - 1 - views_that_may_miss];
}

/// `kitchen_p99_px`: the 99th percentile of a view's pixels, extra and missed points among them, that four of
/// the five views reach.
void measure_points(const stage::Stage& stage, const BenchSetup& setup, Report& report) {
  const ReflectedPoints reflected = ReflectedPoints::make(stage.scene());
  std::vector<double> p99_of_views, p99_of_control;
  for (const char* name : cameras) {
    const Camera camera = must(stage.camera(name));
    const std::size_t count = setup.is_quick ? quick_points : points;
    const ReflectedPointErrors errors = reflected.errors(camera, mirrors_size, count, by_shipped_search),
                               of_paper = reflected.errors(camera, mirrors_size, count, by_paper_search);
    if (errors.px.empty()) fail("the camera \"{}\" shows no mirror", name);
    p99_of_views.push_back(percentile(errors.px, 0.99));
    p99_of_control.push_back(percentile(of_paper.px, 0.99));
  }
  report.add("kitchen_p99_px", reached_px(std::move(p99_of_views)));
  report.add("kitchen_p99_px_of_nine_midpoint_steps", reached_px(std::move(p99_of_control)));
}

std::unique_ptr<stage::Stage> open_kitchen(const BenchSetup& setup, const char* script) {
  must(kitchen::write_kitchen(setup.folder / "kitchen", 1));
  stage::Simulation simulation = setup.simulation(setup.folder / "kitchen" / script);
  // Once for all: the points, the stage and the method that is judged each need them.
  must(reflector_maps::bake_reflectors(simulation.scene));
  return stage_of(std::move(simulation));
}

}  // namespace

void measure_kitchen(const BenchSetup& setup, Report& report) {
  const auto stage = open_kitchen(setup, "kitchen.xp");
  measure_points(*stage, setup, report);
  measure_beside_rerendered(*stage, std::span(cameras).first(setup.is_quick ? quick_cameras : cameras.size()),
                            setup.is_quick ? mirrors_size / 2 : mirrors_size, "kitchen_flip_over_rerendered",
                            report);
  if (!setup.is_quick) note_frames(*stage, report);  // minutes
}

void measure_refraction(const BenchSetup& setup, Report& report) {
  constexpr std::array glass_cameras{"ball", "egg", "both"};
  measure_beside_rerendered(
      *open_kitchen(setup, "glass.xp"),
      std::span(glass_cameras).first(setup.is_quick ? quick_cameras : glass_cameras.size()),
      setup.is_quick ? mirrors_size / 3 : mirrors_size, "refraction_flip_over_rerendered", report);
}

}  // namespace parvis::bench
