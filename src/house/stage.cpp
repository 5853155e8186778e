#include "house/stage.h"

#include "graphics/render/frame_views.h"
#include "places/paper_city/city_nodes.h"
#include "reflections/curved_reflectors/long_edges.h"
#include "reflections/curved_reflectors/refracted_objects.h"
#include "reflections/curved_reflectors/virtual_objects.h"
#include "reflections/environment_maps/local_environment_maps.h"
#include "reflections/environment_maps/multiple_environment_maps.h"
#include "reflections/environment_maps/reference_map_node.h"
#include "reflections/environment_maps/simple_blend.h"
#include "reflections/probes/reflections.h"
#include "scene/action/action_nodes.h"
#include "scene/object_animation.h"

namespace parvis::house {

const scene::NodeRegistry& node_registry() {
  static const scene::NodeRegistry registry = [] {
    scene::NodeRegistry all = scene::core_nodes();
    city::add_city_nodes(all);
    action::add_action_nodes(all);
    environment_maps::add_reference_map_node(all);
    return all;
  }();
  return registry;
}

Errors Play::advance(double seconds, const std::optional<glm::vec3>& visitor) {
  if (!traffic_is_paused) traffic.step(float(seconds));
  traffic.place(scene);
  actions.advance(scene, seconds, visitor);
  time_s += seconds;
  scene::animate(scene, time_s);
  Errors warnings = actions.take_warnings();
  for (const Error& warning : warnings) fmt::print(stderr, "warning: {}\n", to_string(warning));
  return warnings;
}

Result<Camera> Play::camera(const std::string& name) const {
  if (name.empty())
    if (const std::optional<Camera> camera = actions.camera(scene)) return *camera;
  return scene_camera(scene, name);
}

Play make_play(scene::Scene scene) {
  traffic::Traffic traffic(scene);
  Play play{std::move(scene), std::move(traffic), {}, false, 0.0};
  for (const std::string& warning : play.traffic.warnings()) fmt::print(stderr, "warning: {}\n", warning);
  play.traffic.add_vehicles(play.scene);
  scene::animate(play.scene, 0.0);
  return play;
}

Result<Play> open_play(const std::filesystem::path& script,
                       std::span<const std::filesystem::path> data_folders) {
  Result<scene::LoadedScene> loaded = scene::load_scene(script, node_registry(), data_folders);
  if (!loaded) return loaded.errors();
  for (const Error& warning : loaded->warnings) fmt::print(stderr, "warning: {}\n", to_string(warning));
  scene::LiveScene live(std::move(loaded->script));
  if (Status status = live.prepare_scenarios(loaded->scene); !status) return status.errors();
  Play play = make_play(std::move(loaded->scene));
  play.actions = action::Actions(std::move(live), play.scene);
  return play;
}

namespace {

Result<std::unique_ptr<render::Reflections>> make_method_below(const scene::Scene& scene,
                                                               render::Renderer& renderer) {
  switch (scene.reflection.method) {
    case scene::ReflectionMethod::multiple_environment_maps:
      return environment_maps::make_reflections(scene, renderer);
    case scene::ReflectionMethod::local_environment_maps:
      return environment_maps::make_local_environment_maps(scene, renderer);
    case scene::ReflectionMethod::simple_blend:
      return environment_maps::make_simple_blend(scene, renderer);
    case scene::ReflectionMethod::virtual_objects:
      return curved_reflectors::make_virtual_objects(scene, renderer, probes::make_surroundings(scene));
    default:
      return probes::make_reflections(scene);
  }
}

/// With virtual objects over it, where they are wanted.
Result<std::unique_ptr<render::Reflections>> make_method(const scene::Scene& scene,
                                                         render::Renderer& renderer) {
  Result<std::unique_ptr<render::Reflections>> method = make_method_below(scene, renderer);
  if (!method || !scene.reflection.has_virtual_objects() ||
      scene.reflection.method == scene::ReflectionMethod::virtual_objects)
    return method;
  return curved_reflectors::make_virtual_objects(scene, renderer, *std::move(method));
}

}  // namespace

Result<std::unique_ptr<render::Reflections>> make_reflections(const scene::Scene& scene,
                                                              render::Renderer& renderer) {
  Result<std::unique_ptr<render::Reflections>> method = make_method(scene, renderer);
  if (method && curved_reflectors::has_glass(scene))
    method = curved_reflectors::make_refracted_objects(scene, renderer, *std::move(method));
  if (!method) return method;
  if (Status status = renderer.set_reflection(method->get()); !status) return status.errors();
  return method;
}

Stage::Stage(Play play, std::unique_ptr<render::Renderer> renderer)
    : play_(std::move(play)), renderer_(std::move(renderer)) {}

Result<std::unique_ptr<Stage>> Stage::create(Play play) {
  if (play.scene.reflection.method == scene::ReflectionMethod::virtual_objects)
    curved_reflectors::divide_long_edges(play.scene);
  Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create(play.scene);
  if (!renderer) return renderer.errors();
  std::unique_ptr<Stage> stage(new Stage(std::move(play), *std::move(renderer)));
  if (Status status = stage->set_reflection(stage->scene().reflection); !status) return status.errors();
  return stage;
}

Status Stage::set_reflection(const scene::Reflection& reflection) {
  play_.scene.reflection = shown_reflection_ = reflection;
  Result<std::unique_ptr<render::Reflections>> made = make_reflections(play_.scene, *renderer_);
  if (!made) return made.errors();
  reflections_ = *std::move(made);
  return Done{};
}

void Stage::follow_clock() {
  double update_ms = 0.0, rest_ms = 0.0;
  for (const gl::PassTime& pass : pass_times_.latest())
    (pass.name == "reflections" ? update_ms : rest_ms) += 1e3 * pass.seconds;
  if (pass_times_.latest().empty()) return;
  reflections_->frame_took(update_ms, rest_ms);
  scale_.frame_took(update_ms + rest_ms, double(play_.scene.reflection.budget_ms));
}

void Stage::draw(const Camera& camera, int width, int height) {
  if (play_.scene.reflection != shown_reflection_)
    if (const Status status = set_reflection(play_.scene.reflection); !status)
      fmt::print(stderr, "{}", to_string(status.errors()));
  width_ = width, height_ = height;
  pass_times_.begin_frame();
  const glm::ivec2 drawn = scale_.drawn_size(width, height);
  render::FrameSteps steps;
  steps.reflect = [&](const Camera& eye) { reflections_->update(*renderer_, play_.scene, eye); };
  steps.end_pass = [&](const char* pass) { pass_times_.end_pass(pass); };
  const Status status =
      render::draw_frame(*renderer_, play_.scene, render::EyeView{camera, drawn.x, drawn.y}, steps);
  assert(status.ok() && "one eye has its target");
}

reference::TracedPicture Stage::trace(const Camera& camera, int width, int height, int samples_a_pixel,
                                      const reference::PixelWindow& window) {
  renderer_->begin_frame(play_.scene, camera);
  const shading::DrawnLight light = renderer_->drawn_light();
  reference::TraceOptions options;
  options.samples_a_pixel = samples_a_pixel;
  options.window = window;
  options.drawn_light = &light;
  const reference::RayScene rays(play_.scene);
  return reference::trace_picture(rays, play_.scene, renderer_->sky(), camera, width, height, options);
}

}  // namespace parvis::house
