#include "bench/judged_method.h"

namespace parvis::bench {

Result<JudgedMethod> judged_method(stage::Stage& stage, std::string name,
                                   const scene::Reflection& reflection) {
  scene::Scene scene = stage.scene();  // models are shared
  scene.reflection = reflection;
  Result<std::unique_ptr<render::Reflections>> made = stage::make_reflections(scene, stage.renderer());
  if (!made) return made.errors();
  return JudgedMethod{std::move(name), *std::move(made)};
}

Status draw(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, int width, int height,
            render::Subjects subjects) {
  render::Renderer& renderer = stage.renderer();
  if (Status status = renderer.set_reflection(method.reflections.get()); !status) return status;
  renderer.begin_frame(stage.scene(), camera);
  renderer.prepare_main_view(camera, width, height, subjects);
  method.reflections->update(renderer, stage.scene(), camera);
  renderer.draw_main_view();
  return Done{};
}

}  // namespace parvis::bench
