#include "bench/facades/drawing_bench.h"

#include <algorithm>
#include <ctime>

#include "bench/facades/plain_texture.h"
#include "capture/facades/facade_drawable.h"
#include "capture/facades/placed_facade.h"
#include "graphics/gl/context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/renderer.h"

namespace parvis::bench {
namespace {

using facades::PackedFacade;

/// What a drawing takes, milliseconds: by the wall clock, and of all processors together. The latter does not
/// change with what else a machine does; it counts a renderer in software alone.
struct Time {
  double wall_ms = 0.0, processor_ms = 0.0;
};

/// Time of a main view of `scene`, and its picture.
class TimedScene {
 public:
  static Result<TimedScene> create(scene::Scene scene, const render::Drawables& drawables) {
    auto held = std::make_unique<scene::Scene>(std::move(scene));
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(*held, drawables, light::sun_and_sky);
    if (!renderer) return renderer.errors();
    return TimedScene(std::move(held), *std::move(renderer));
  }
  Time draw(const Camera& camera) {
    constexpr int width = 640, height = 480;
    renderer_->begin_frame(*scene_, camera);
    renderer_->prepare_main_view(camera, width, height);
    glFinish();
    const std::clock_t before = std::clock();
    const double wall_ms = milliseconds([&] {
      renderer_->draw_main_view();
      glFinish();
    });
    return {wall_ms, 1000.0 * double(std::clock() - before) / CLOCKS_PER_SEC};
  }
  /// Of what was drawn last.
  ImageF picture() { return renderer_->read_radiance(); }

 private:
  TimedScene(std::unique_ptr<scene::Scene> scene, std::unique_ptr<render::Renderer> renderer)
      : scene_(std::move(scene)), renderer_(std::move(renderer)) {}
  std::unique_ptr<scene::Scene> scene_;
  std::unique_ptr<render::Renderer> renderer_;
};

/// The facade's surfaces with one texture on all: an ordinary material, which is lit, too.
scene::Scene lit_scene(const PackedFacade& facade) {
  auto model = std::make_shared<scene::Model>();
  model->textures.push_back({"plain", plain_texture()});
  scene::Material material;
  material.base_colour = glm::vec3(0.0f), material.metallic = 1.0f, material.roughness = 1.0f;
  material.emission = glm::vec3(1.0f), material.emission_texture = 0, material.is_double_sided = true;
  model->materials.push_back(material);
  scene::Part part;
  part.mesh = facades::mesh_of(facade);
  part.mesh.uvs = plain_uvs(facade);
  model->parts.push_back(std::move(part));
  scene::Scene scene;
  scene::Object object;
  object.name = "plain", object.model = model;
  scene.objects.push_back(std::move(object));
  return scene;
}

Result<TimedScene> unlit_scene(std::shared_ptr<const PackedFacade> facade) {
  render::Drawables drawables;
  drawables.add(plain_texture_kind(std::move(facade)));
  scene::Scene scene;
  drawables.furnish(scene);
  return TimedScene::create(std::move(scene), drawables);
}

Result<TimedScene> facade_scene(const facades::PlacedFacade& placed, facades::Compared compared) {
  render::Drawables drawables;
  drawables.add(facades::facades_kind(compared));
  scene::Scene scene;
  scene.data<scene::ItemsOf<facades::PlacedFacade>>().add(placed, 0);
  drawables.furnish(scene);
  return TimedScene::create(std::move(scene), drawables);
}

/// Times over those of the plain texture, drawn just before.
struct Ratios {
  std::vector<double> wall, processor;
  void add(const Time& time, const Time& plain) {
    wall.push_back(time.wall_ms / plain.wall_ms);
    if (plain.processor_ms > 0.0) processor.push_back(time.processor_ms / plain.processor_ms);
  }
  void tell(const std::string& key, Report& report) const {
    report.add(key, median(wall));
    tell_processor(key, report);
  }
  void tell_processor(const std::string& key, Report& report) const {
    if (gl::is_software()) report.add(key + "_by_processor", median(processor));
  }
};

/// Pixels in which a picture shows something else than that of nothing, percent.
double shown_percent(const ImageF& picture, const ImageF& nothing) {
  std::size_t shown = 0;
  const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      shown += !std::equal(picture.at(x, y), picture.at(x, y) + 3, nothing.at(x, y));
  return 100.0 * double(shown) / double(pixels);
}

}  // namespace

Status measure_drawing(std::shared_ptr<const PackedFacade> facade, const Camera& camera, bool is_quick,
                       Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  facades::PlacedFacade placed;
  placed.facade = facade;
  facades::PlacedFacade hidden = placed, without_photographs = placed;
  hidden.is_visible = false;
  auto bare = std::make_shared<PackedFacade>(*facade);
  for (glm::uvec2& list : bare->lists) list.y = 0;
  without_photographs.facade = bare;

  Result<TimedScene> ours = facade_scene(placed, facades::Compared::chosen),
                     all = facade_scene(placed, facades::Compared::all),
                     nothing = facade_scene(hidden, facades::Compared::chosen),
                     bare_colours = facade_scene(without_photographs, facades::Compared::all),
                     lit = TimedScene::create(lit_scene(*facade), {}), unlit = unlit_scene(facade);
  for (const auto* scene : {&ours, &all, &nothing, &bare_colours, &lit, &unlit})
    if (!*scene) return scene->errors();
  Ratios ours_over, all_over, nothing_over, bare_over, lit_over;
  std::vector<double> plain_ms;
  for (int i = 0; i < (is_quick ? 9 : 31); ++i) {
    const Time plain = unlit->draw(camera);
    plain_ms.push_back(plain.wall_ms);
    ours_over.add(ours->draw(camera), plain), all_over.add(all->draw(camera), plain);
    nothing_over.add(nothing->draw(camera), plain), lit_over.add(lit->draw(camera), plain);
    bare_over.add(bare_colours->draw(camera), plain);
  }
  const std::string key = "draw_over_plain_texture_time";
  const Target drawing = up_to(1.5);
  const Median ours_median = median(ours_over.wall);
  report.note(fmt::format("{}: 95 % interval {:.2f} to {:.2f}", key, ours_median.low, ours_median.high));
  report.add(key, ours_median.value, drawing);
  ours_over.tell_processor(key, report);
  report.add_control(key + "_all_photographs", median(all_over.wall).value, drawing);
  all_over.tell_processor(key + "_all_photographs", report);
  nothing_over.tell(key + "_nothing", report), lit_over.tell(key + "_lit_texture", report);
  bare_over.tell(key + "_no_photographs", report);
  report.add("draw_plain_texture_ms", median(plain_ms));
  // A place that is not drawn would be fast: what is timed has to cover what the plain texture covers.
  const ImageF empty = nothing->picture();
  const double plain_percent = shown_percent(unlit->picture(), empty);
  const Target shown{plain_percent, true};
  report.add("draw_shown_percent", shown_percent(ours->picture(), empty), shown);
  report.add_control("draw_shown_percent_control_hidden", shown_percent(nothing->picture(), empty), shown);
  report.add("draw_shown_percent_plain_texture", plain_percent);
  // Proposed colours alone would be fast, too: what is timed has to show photographs.
  const ImageF bare_picture = bare_colours->picture();
  const Target photographs{0.9 * plain_percent, true};
  report.add("draw_photographs_percent", shown_percent(ours->picture(), bare_picture), photographs);
  report.add_control("draw_photographs_percent_control_none", shown_percent(bare_picture, bare_picture),
                     photographs);
  return Done{};
}

}  // namespace parvis::bench
