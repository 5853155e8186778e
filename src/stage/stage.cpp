#include "stage/stage.h"

#include "base/checked.h"
#include "base/memory_budget.h"
#include "graphics/gl/context.h"
#include "graphics/shading/realism.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/frame.h"
#include "reflections/methods/registry.h"
#include "reflections/methods/settings.h"
#include "scene/data/realism.h"
#include "stage/place_check.h"
#include "stage/refinement.h"
#include "stage/stillness.h"

namespace parvis::stage {
namespace {

Errors reported(Errors warnings) {
  for (const Error& warning : warnings) fmt::print(stderr, "warning: {}\n", to_string(warning));
  return warnings;
}

}  // namespace

Errors Simulation::advance(double seconds, const std::optional<glm::vec3>& visitor) {
  clock.advance(scene, seconds, {visitor});
  return reported(clock.take_warnings());
}

void Simulation::settle() {
  clock.settle(scene);
  reported(clock.take_warnings());
}

Result<Camera> Simulation::camera(const std::string& name) const {
  if (name.empty())
    if (const std::optional<Camera> camera = actions().camera(scene)) return *camera;
  return scene_camera(scene, name);
}

Simulation make_simulation(const Registries& registries, scene::Scene scene, scene::LiveScene live) {
  registries.get<render::Drawables>().attach(scene);
  action::SceneClock clock(registries.get<action::Processes>(), std::move(live), scene);
  reported(clock.take_warnings());
  return {&registries, std::move(scene), std::move(clock)};
}

Simulation make_simulation(const Registries& registries, scene::Scene scene) {
  return make_simulation(registries, std::move(scene),
                         scene::LiveScene(registries.get<scene::NodeRegistry>()));
}

namespace {

/// Drawing and tracing take memory of their own for each triangle of a model: buffers, and a hierarchy.
Status charge_triangles(const scene::Scene& scene, const std::filesystem::path& script) {
  constexpr std::uint64_t bytes_per_triangle = 100;
  std::set<const scene::Model*> models;
  std::uint64_t triangles = 0;
  for (const scene::Object& object : scene.objects)
    if (models.insert(object.model.get()).second) triangles += object.model->triangle_count();
  return check_memory(checked_product({triangles, bytes_per_triangle}),
                      fmt::format("{}: showing {} triangles", script.string(), triangles));
}

}  // namespace

Result<Simulation> open_simulation(const Registries& registries, const std::filesystem::path& script,
                                   std::span<const std::filesystem::path> data_folders) {
  Result<scene::LoadedScene> loaded =
      scene::load_scene(script, registries.get<scene::NodeRegistry>(), data_folders);
  if (!loaded) return loaded.errors();
  reported(loaded->warnings);
  if (Status status = charge_triangles(loaded->scene, script); !status) return status.errors();
  reported(check_place(loaded->scene));
  scene::LiveScene live(std::move(loaded->script));
  if (Status status = live.prepare_scenarios(loaded->scene); !status) return status.errors();
  return make_simulation(registries, std::move(loaded->scene), std::move(live));
}

Stage::Stage(Simulation simulation, std::unique_ptr<render::Renderer> renderer,
             std::unique_ptr<realism::EdgeLines> lines, ShownRadiance refined)
    : simulation_(std::move(simulation)),
      renderer_(std::move(renderer)),
      lines_(std::move(lines)),
      refined_(std::move(refined)),
      kept_rays_(std::make_unique<KeptRays>()) {
  renderer_->add(lines_.get());
}

Stage::~Stage() = default;

Result<std::unique_ptr<Stage>> Stage::create(Simulation simulation) {
  if (Status status = simulation.registries->get<methods::Registry>().prepare(simulation.scene); !status)
    return status.errors();
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(simulation.scene, simulation.registries->get<render::Drawables>(),
                               simulation.registries->get<render::Lights>().make);
  if (!renderer) return renderer.errors();
  Result<ShownRadiance> refined = ShownRadiance::create();
  if (!refined) return refined.errors();
  Result<std::unique_ptr<realism::EdgeLines>> lines = realism::EdgeLines::create((*renderer)->gpu());
  if (!lines) return lines.errors();
  std::unique_ptr<Stage> stage(
      new Stage(std::move(simulation), *std::move(renderer), *std::move(lines), *std::move(refined)));
  if (Status status = stage->set_reflection(methods::settings(stage->scene())); !status)
    return status.errors();
  return stage;
}

void Stage::end_refinement() {
  refinement_.reset();
  refined_samples_ = 0;
}

Status Stage::set_reflection(const methods::Settings& reflection) {
  end_refinement();  // methods begin frames when they are made
  methods::settings(simulation_.scene) = shown_reflection_ = reflection;
  renderer_->set_budget(double(reflection.budget_ms));
  if (simulation_.scene.objects.size() > renderer_->gpu().object_bounds().size())
    if (const Result<Camera> camera = simulation_.camera(""))
      renderer_->begin_frame(simulation_.scene, *camera);
  Result<std::unique_ptr<methods::Reflections>> made =
      registries().get<methods::Registry>().make(simulation_.scene, *renderer_);
  if (!made) return made.errors();
  if (const std::string why = gl::refused(); !why.empty())
    return error(
        "the graphics driver refuses what the scene asks for: {}; smaller textures, fewer or smaller "
        "reference maps (referenceMaps(memory=...)) and a smaller picture need less",
        why);
  if (Status status = renderer_->set_reflection(made->get()); !status) return status;
  reflections_ = *std::move(made);
  has_new_mirrors();  // all are known now
  return Ok{};
}

/// Methods know mirrors by their models: for one that has come with a model of its own another method is
/// made.
bool Stage::has_new_mirrors() {
  bool is_any = false;
  for (; known_objects_ < simulation_.scene.objects.size(); ++known_objects_) {
    const scene::Object& object = simulation_.scene.objects[known_objects_];
    if (object.takes_reflection) is_any |= mirrors_.insert(object.model.get()).second;
  }
  return is_any;
}

void Stage::follow_clock(double frame_ms) {
  reflections_->prefer_rate();
  double update_ms = 0.0, rest_ms = 0.0;
  for (const gl::PassTime& pass : pass_times_.latest())
    (pass.name == "reflections" ? update_ms : rest_ms) += 1e3 * pass.seconds;
  if (pass_times_.latest().empty()) return;
  const bool goes_by_frames = holds_rate_by_pixels();
  if (!goes_by_frames) reflections_->frame_took(update_ms, rest_ms);
  constexpr double held_share = 0.93;  // of a held frame's time: frames differ, and all of them count
  const double own_ms = double(methods::settings(simulation_.scene).budget_ms),
               held_ms = held_share * held_ms_;
  const double budget_ms =
      own_ms > 0.0 && held_ms > 0.0 ? std::min(own_ms, held_ms) : std::max(own_ms, held_ms);
  scale_.frame_took(goes_by_frames ? frame_ms : update_ms + rest_ms, budget_ms);
  shared_.frame_took(frame_ms, held_ms > 0.0 ? budget_ms : 0.0, scale_.is_smallest());
  constexpr double reflections_share = 0.3;  // of a held frame with as few pixels as there can be
  reflections_->hold(held_ms > 0.0 && scale_.is_smallest()
                         ? reflections_share * shared_.share(Lowered::reflections) * budget_ms
                         : own_ms);
  simulation_.clock.set_detail(float(shared_.share(Lowered::people)));
}

/// Then pictures in motion have one sample per pixel: a GPU has several for little.
bool Stage::holds_rate_by_pixels() const { return held_ms_ > 0.0 && gl::is_software(); }

double Stage::drawn_share() const {
  return double(renderer_->width()) * double(renderer_->height()) / (double(width_) * double(height_));
}

void Stage::adapt_to(std::span<const glm::vec3> eyes) { simulation_.clock.adapt(simulation_.scene, eyes); }

void Stage::draw_held(const Camera& camera, int width, int height, const std::vector<std::uint8_t>& shown,
                      const scene::Scene& held) {
  const glm::ivec2 size(width, height);
  ContentHash hash;
  hash.add(state_of(simulation_.scene, camera, width, height, &shown));
  const bool is_below_known = std::exchange(below_held_, hash.value()) == hash.value();
  if (!is_below_known) {
    is_held_frame_kept_ = false;
    draw(camera, size, scale_.drawn_size(width, height), &shown, holds_rate_by_pixels());
  } else if (!is_held_frame_kept_) {
    draw(camera, size, size, &shown);
    renderer_->keep_main_view();
    is_held_frame_kept_ = true;
  } else {
    pass_times_.begin_frame();
  }
  below_held_ = hash.value();
  renderer_->relight_main_view(simulation_.scene, camera);
  if (const Status status = renderer_->draw_over(held, is_held_frame_kept_); !status)
    fmt::print(stderr, "{}", to_string(status.errors()));
  pass_times_.end_pass("held things");
}

/// Ends what was shown before and takes over what has changed since.
void Stage::begin_drawing(std::span<const render::EyeView> eyes) {
  end_refinement();
  below_held_ = 0;
  if (has_new_mirrors() || methods::settings(simulation_.scene) != shown_reflection_)
    if (const Status status = set_reflection(methods::settings(simulation_.scene)); !status)
      fmt::print(stderr, "{}", to_string(status.errors()));
  drawn_from_ = eyes.front().camera;
  std::vector<glm::vec3> places;
  for (const render::EyeView& eye : eyes) places.push_back(eye.camera.position_in_world());
  adapt_to(places);
  pass_times_.begin_frame();
}

void Stage::draw(const Camera& camera, glm::ivec2 size, glm::ivec2 drawn,
                 const std::vector<std::uint8_t>* shown, bool has_one_sample) {
  const render::EyeView eye{camera, drawn.x, drawn.y};
  begin_drawing(std::span(&eye, 1));
  renderer_->set_one_sample(has_one_sample);
  width_ = size.x, height_ = size.y;
  render::FrameSteps steps;
  steps.shown_objects = shown;
  steps.end_pass = [&](const char* pass) { pass_times_.end_pass(pass); };
  const Status status = methods::draw_frame(*renderer_, simulation_.scene, reflections_.get(), eye, steps);
  assert(status.ok() && "one eye has its target");
}

Status Stage::draw(std::span<const render::EyeView> eyes) {
  begin_drawing(eyes);
  renderer_->set_one_sample(false);
  width_ = eyes.front().width, height_ = eyes.front().height;
  return methods::draw_frame(*renderer_, simulation_.scene, reflections_.get(), eyes);
}

void Stage::refine(const Camera& camera, int width, int height) {
  const bool has_lines = shading::ink_at(scene().data<scene::Realism>().level) > 0.0f;
  if (!refinement_) {
    const glm::ivec2 size(width, height);
    reflections_->hold(double(methods::settings(simulation_.scene).budget_ms));
    simulation_.clock.set_detail(1.0f);
    if (renderer_->has_one_sample() || size != glm::ivec2(renderer_->width(), renderer_->height()))
      return draw(camera, size, size);
    if (has_lines) return;
    renderer_->relight_main_view(simulation_.scene, camera);
    refinement_ = std::make_unique<Refinement>(*kept_rays_, simulation_.scene, renderer_->sky(),
                                               renderer_->drawn_light(), camera, width, height,
                                               methods::settings(simulation_.scene).bounces);
  }
  if (refinement_->samples() < render::samples_per_pixel) return;
  if (std::optional<ImageF> radiance = refinement_->take()) {
    refined_.put(*std::move(radiance));
    refined_samples_ = refinement_->samples();
  }
}

void Stage::display(GLuint framebuffer) const {
  if (refined_samples_ > 0)
    refined_.display(framebuffer, simulation_.scene.exposure);
  else
    renderer_->display(framebuffer, {width_, height_}, simulation_.scene.exposure);
}

Image8 Stage::picture() {
  if (refined_samples_ > 0)
    return shading::tone_mapped_picture(refined_.radiance(), simulation_.scene.exposure);
  return renderer_->read_picture(simulation_.scene.exposure);
}

Image8 Stage::whole_picture() {
  const glm::ivec2 size(width_, height_);
  if (refined_samples_ == 0 && size != glm::ivec2(renderer_->width(), renderer_->height())) {
    reflections_->hold(double(methods::settings(simulation_.scene).budget_ms));
    simulation_.clock.set_detail(1.0f);
    draw(Camera(drawn_from_), size, size);
  }
  return picture();
}

reference::TracedPicture Stage::trace(const Camera& camera, int width, int height, int samples_per_pixel,
                                      const machines::Processes& processes) {
  end_refinement();  // tracing begins a frame
  const glm::vec3 eye = camera.position_in_world();
  adapt_to(std::span(&eye, 1));
  reference::TraceOptions options;
  options.samples_per_pixel = samples_per_pixel;
  options.processes = &processes;
  return methods::trace_frame(*renderer_, simulation_.scene, {camera, width, height}, options);
}

reference::TracedPicture Stage::trace(const Camera& camera, int width, int height, int samples_per_pixel,
                                      const reference::PixelWindow& window) {
  end_refinement();
  const glm::vec3 eye = camera.position_in_world();
  adapt_to(std::span(&eye, 1));
  reference::TraceOptions options;
  options.samples_per_pixel = samples_per_pixel;
  options.window = window;
  return methods::trace_frame(*renderer_, simulation_.scene, {camera, width, height}, options);
}

}  // namespace parvis::stage
