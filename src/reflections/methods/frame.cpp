#include "reflections/methods/frame.h"

#include "reflections/methods/settings.h"

namespace parvis::methods {

Status draw_frame(render::Renderer& renderer, const scene::Scene& scene, Reflections* reflections,
                  std::span<const render::EyeView> eyes, render::FrameSteps steps) {
  steps.reflect = [&](const Camera& camera) {
    if (reflections) reflections->update(renderer, scene, camera);
  };
  Status status = render::draw_frame(renderer, scene, eyes, steps);
  while (status && reflections && reflections->supply(renderer, scene))
    status = render::draw_frame(renderer, scene, eyes, steps);
  return status;
}

reference::TracedPicture trace_frame(render::Renderer& renderer, const scene::Scene& scene,
                                     const render::EyeView& eye, reference::TraceOptions options) {
  renderer.begin_frame(scene, eye.camera);
  const shading::DrawnLight light = renderer.drawn_light();
  options.drawn_light = &light;
  options.mirror_bounces = settings(scene).bounces;
  const reference::RayScene rays(scene);
  return reference::trace_picture(rays, scene, renderer.sky(), eye.camera, eye.width, eye.height, options);
}

}  // namespace parvis::methods
