// One frame of a scene with its reflection method: rendered, and its ground truth by the ray tracer.
#pragma once

#include <span>
#include <utility>

#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "reflections/methods/reflections.h"

namespace parvis::methods {

/// Renders a frame for any number of eyes. `reflections`: the method that is set in the renderer, which makes
/// its maps for each of them; null: none is set. `steps.reflect` is ignored. A map that is drawn behind the
/// frame leaves the light of its own place: see Renderer::relight_main_view. Errors as render::draw_frame's.
Status draw_frame(render::Renderer& renderer, const scene::Scene& scene, Reflections* reflections,
                  std::span<const render::EyeView> eyes, render::FrameSteps steps = {});

/// The same for one eye.
inline Status draw_frame(render::Renderer& renderer, const scene::Scene& scene, Reflections* reflections,
                         const render::EyeView& eye, render::FrameSteps steps = {}) {
  return draw_frame(renderer, scene, reflections, std::span(&eye, 1), std::move(steps));
}

/// The same picture by the ray tracer, lit through the renderer's own shadow maps and sky visibility, so that
/// the two differ by reflections alone. `options.drawn_light` and `mirror_bounces` are set here. Begins a
/// frame of the renderer.
reference::TracedPicture trace_frame(render::Renderer& renderer, const scene::Scene& scene,
                                     const render::EyeView& eye, reference::TraceOptions options = {});

}  // namespace parvis::methods
