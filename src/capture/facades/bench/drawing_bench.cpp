#include "capture/facades/bench/drawing_bench.h"

#include <algorithm>

#include "base/test_data.h"
#include "capture/facades/bench/bench_places.h"
#include "capture/facades/bench/plain_texture.h"
#include "capture/facades/facade_drawable.h"
#include "capture/facades/placed_facade.h"
#include "graphics/gl/context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/renderer.h"

namespace parvis::bench {
namespace {

using facades::PackedFacade;

/// Time of a main view of `scene`, milliseconds, and its picture.
class TimedScene {
 public:
  static Result<TimedScene> create(scene::Scene scene, const render::Drawables& drawables) {
    auto held = std::make_unique<scene::Scene>(std::move(scene));
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(*held, drawables, light::sun_and_sky);
    if (!renderer) return renderer.errors();
    return TimedScene(std::move(held), *std::move(renderer));
  }
  double draw(const Camera& camera) {
    constexpr int width = 640, height = 480;
    renderer_->begin_frame(*scene_, camera);
    renderer_->prepare_main_view(camera, width, height);
    glFinish();
    return milliseconds([&] {
      renderer_->draw_main_view();
      glFinish();
    });
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
  model->textures.push_back({"plain", plain_texture(), true, true});
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

/// Pixels in which a picture shows something else than that of nothing, percent.
double shown_percent(const ImageF& picture, const ImageF& nothing) {
  std::size_t shown = 0;
  const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      shown += !std::equal(picture.at(x, y), picture.at(x, y) + 3, nothing.at(x, y));
  return 100.0 * double(shown) / double(pixels);
}

Result<facades::PlacedFacade> facade_of_few_triangles(const BenchPlace& place) {
  const facades::PlaceSettings settings{false, false, false};
  const Result<facades::PlaceLayers> layers =
      facades::place_layers(place.photographs, place.meshes, settings);
  if (!layers) return layers.errors();
  facades::PlacedFacade placed;
  placed.facade = std::make_shared<const PackedFacade>(facades::packed_facade(*layers));
  return placed;
}

}  // namespace

Status measure_drawing(bool is_quick, Report& report) {
  const auto folder = shared_data("photos_sceaux", std::filesystem::current_path());
  if (!folder) {
    report.skip("draw_over_plain_texture_time", "the shared photographs are absent");
    return Done{};
  }
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  const Result<BenchPlace> place = sceaux_of_few_triangles(*folder);
  if (!place) return place.errors();
  const Result<facades::PlacedFacade> placed = facade_of_few_triangles(*place);
  if (!placed) return placed.errors();
  facades::PlacedFacade hidden = *placed;
  hidden.is_visible = false;

  Result<TimedScene> ours = facade_scene(*placed, facades::Compared::chosen),
                     all = facade_scene(*placed, facades::Compared::all),
                     nothing = facade_scene(hidden, facades::Compared::chosen),
                     lit = TimedScene::create(lit_scene(*placed->facade), {}),
                     unlit = unlit_scene(placed->facade);
  for (const auto* scene : {&ours, &all, &nothing, &lit, &unlit})
    if (!*scene) return scene->errors();
  const Camera camera = photographs::camera_of(place->photographs[place->photographs.size() / 2]);
  std::vector<double> over_unlit, over_lit, all_over_unlit, of_nothing, milliseconds_unlit;
  for (int i = 0; i < (is_quick ? 9 : 31); ++i) {
    const double unlit_ms = unlit->draw(camera), ours_ms = ours->draw(camera);
    over_unlit.push_back(ours_ms / unlit_ms), over_lit.push_back(ours_ms / lit->draw(camera));
    all_over_unlit.push_back(all->draw(camera) / unlit_ms);
    of_nothing.push_back(nothing->draw(camera) / unlit_ms), milliseconds_unlit.push_back(unlit_ms);
  }
  report.add("draw_over_plain_texture_time", median(over_unlit));
  report.add("draw_over_plain_texture_time_all_photographs", median(all_over_unlit));
  report.add("draw_over_plain_texture_time_nothing", median(of_nothing));
  report.add("draw_over_lit_texture_time", median(over_lit));
  report.add("draw_plain_texture_ms", median(milliseconds_unlit));
  // A place that is not drawn would be fast: what is timed has to cover what the plain texture covers.
  const ImageF empty = nothing->picture();
  report.add("draw_shown_percent", shown_percent(ours->picture(), empty));
  report.add("draw_shown_percent_plain_texture", shown_percent(unlit->picture(), empty));
  return Done{};
}

}  // namespace parvis::bench
