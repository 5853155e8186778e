#include "bench/judged_method.h"

#include <algorithm>

#include "reflections/methods/frame.h"
#include "reflections/methods/registry.h"
#include "reflections/methods/settings.h"
#include "reflections/reference_maps/scene_maps.h"

namespace parvis::bench {
namespace {

Image8 cut_out(const Image8& picture, const reference::PixelWindow& window) {
  Image8 part(window.width, window.height, picture.channels);
  for (int y = 0; y < window.height; ++y)
    std::copy_n(picture.at(window.x, window.y + y), window.width * picture.channels, part.at(0, y));
  return part;
}

}  // namespace

Status keep_maps(const House& house, scene::Scene scene, const methods::Settings& reflection) {
  methods::settings(scene) = reflection;
  const Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, house.get<render::Drawables>(), house.get<render::Lights>().make);
  if (!renderer) return renderer.errors();
  const reference_maps::HeightPyramid heights(reference_maps::heights_of(scene));
  const Result<std::vector<glm::vec3>> places = reference_maps::keep_maps(scene, heights, **renderer);
  return places ? Status(Done{}) : Status(places.errors());
}

Result<JudgedMethod> judged_method(house::Stage& stage, std::string name,
                                   const methods::Settings& reflection) {
  scene::Scene scene = stage.scene();  // models are shared
  methods::settings(scene) = reflection;
  const auto& registry = stage.house().get<methods::Registry>();
  const Result<const methods::Method*> method = registry.method_of(scene);
  if (!method) return method.errors();
  Result<std::unique_ptr<methods::Reflections>> made = registry.make(scene, stage.renderer());
  if (!made) return made.errors();
  return JudgedMethod{std::move(name), *std::move(made), (*method)->needs_earlier_frames};
}

Result<std::vector<JudgedMethod>> judged_methods(
    house::Stage& stage, const std::vector<std::pair<std::string, methods::Settings>>& wanted) {
  std::vector<JudgedMethod> methods;
  methods.reserve(wanted.size());
  for (const auto& [name, reflection] : wanted) {
    Result<JudgedMethod> method = judged_method(stage, name, reflection);
    if (!method) return method.errors();
    methods.push_back(*std::move(method));
  }
  return methods;
}

Status pass_by(house::Stage& stage, const JudgedMethod& method, const Camera& camera, int width, int height) {
  if (Status status = stage.renderer().set_reflection(method.reflections.get()); !status) return status;
  render::Renderer& renderer = stage.renderer();
  renderer.begin_frame(stage.scene(), camera);
  renderer.prepare_main_view(camera, width, height);
  method.reflections->update(renderer, stage.scene(), camera);
  return Done{};
}

Status draw(house::Stage& stage, const JudgedMethod& method, const Camera& camera, int width, int height,
            render::Subjects subjects) {
  if (Status status = stage.renderer().set_reflection(method.reflections.get()); !status) return status;
  return draw_again(stage, method, camera, width, height, subjects);
}

Status draw_again(house::Stage& stage, const JudgedMethod& method, const Camera& camera, int width,
                  int height, render::Subjects subjects) {
  render::FrameSteps steps;
  steps.subjects = subjects;
  return methods::draw_frame(stage.renderer(), stage.scene(), method.reflections.get(),
                             {camera, width, height}, steps);
}

Result<Image8> picture_of(house::Stage& stage, const JudgedMethod& method, const Camera& camera, int width,
                          int height, const reference::PixelWindow& window) {
  if (Status status = draw(stage, method, camera, width, height); !status) return status.errors();
  return cut_out(stage.renderer().read_picture(stage.scene().exposure), window);
}

}  // namespace parvis::bench
