#include "reflections/virtual_objects/mirrors_in_mirrors.h"

#include <algorithm>

#include "reflections/reflector_maps/bindings.h"

namespace parvis::virtual_objects {
namespace {

// Radians, radius over distance: a mirror that is worth showing, and one of which, or in which, many layers
// are drawn.
constexpr float min_angle = 0.05f, min_concave_angle = 0.3f;
constexpr GLuint first_bits = 0x0f, second_bits = 0xf0;

Bounds bounds_in_world(const ShownPatch& patch) {
  return transformed(patch.world_from_reflector, patch.patch->bounds.box);
}

}  // namespace

Result<std::unique_ptr<MirrorsInMirrors>> MirrorsInMirrors::create(const render::Renderer& renderer,
                                                                   gl::Defines map_defines) {
  Result<gl::Program> mirrored_patch =
      gl::Program::create("reflections/virtual_objects/mirrored_patch.vert",
                          "reflections/virtual_objects/mirrored_patch.frag", map_defines);
  if (!mirrored_patch) return mirrored_patch.errors();
  Result<VirtualPicture> picture = VirtualPicture::create();
  if (!picture) return picture.errors();
  map_defines.insert(map_defines.end(), {{"IS_MIRRORED", ""}, {"MIRRORS", "2"}});
  Result<render::SurfacePrograms> programs =
      render::SurfacePrograms::create({.fragment = "reflections/virtual_objects/twice_virtual_surface.frag",
                                       .vertex = "reflections/virtual_objects/twice_virtual_vertices.vert",
                                       .defines = std::move(map_defines)},
                                      renderer.gpu().materials());
  if (!programs) return programs.errors();
  return std::unique_ptr<MirrorsInMirrors>(
      new MirrorsInMirrors(*std::move(programs), *std::move(mirrored_patch), *std::move(picture)));
}

MirrorsInMirrors::MirrorsInMirrors(render::SurfacePrograms programs, gl::Program mirrored_patch,
                                   VirtualPicture picture)
    : VirtualVertices(std::move(programs)),
      mirrored_patch_(std::move(mirrored_patch)),
      picture_(std::move(picture)) {
  for (gl::Query& query : is_seen_) query = gl::Query::create(GLenum(GL_ANY_SAMPLES_PASSED));
}

/// Those that stand largest before the first.
void MirrorsInMirrors::find_seconds(const ShownPatch& first, std::span<const ShownPatch> second) {
  const Bounds before = bounds_in_world(first);
  candidates_.clear();
  for (const ShownPatch& patch : second) {
    const Bounds bounds = bounds_in_world(patch);
    const float distance = std::max(glm::distance(bounds.centre(), before.centre()) - before.radius(), 1e-3f);
    const float angle = bounds.radius() / distance;
    const bool is_concave = !patch.patch->shows_once, in_concave = !first.patch->shows_once;
    if (patch.object != first.object && !(is_concave && in_concave) &&
        angle > (is_concave || in_concave ? min_concave_angle : min_angle))
      candidates_.emplace_back(angle, &patch);
  }
  std::ranges::sort(candidates_, [](const auto& a, const auto& b) { return a.first > b.first; });
  seconds_.clear();
  for (std::size_t i = 0; i < std::min(candidates_.size(), maximum); ++i)
    seconds_.push_back(*candidates_[i].second);
}

/// Each pixel of the first gets the number of the nearest second that it shows.
void MirrorsInMirrors::mark_seconds(const render::View& view, int first_number) {
  begin_marks(view);
  glDisable(GL_CULL_FACE);  // a mirror image may be turned over
  glStencilMask(second_bits);
  mirrored_patch_.use();
  const Layers first_layers = layers_of(*first_->patch);
  for (std::size_t i = 0; i < seconds_.size(); ++i) {
    glStencilFunc(GL_EQUAL, GLint((i + 1) << 4) | first_number, first_bits);
    second_mirror_.bind(mirrored_patch_, {.clip_of_view = view.clip_from_world,
                                          .world_from_second = seconds_[i].world_from_reflector,
                                          .viewer_in_world = glm::vec4(view.position_in_world, 1.0f),
                                          .second_middle = glm::vec4(0.0f)});
    glBeginQuery(GL_ANY_SAMPLES_PASSED, is_seen_[i].name());
    for (int layer = first_layers.first; layer < first_layers.end; ++layer) {
      GpuReflector::bind(mirrored_patch_, *first_->patch, first_->world_from_reflector, reflector_unit,
                         layer);
      seconds_[i].reflector->draw(*seconds_[i].patch);
    }
    glEndQuery(GL_ANY_SAMPLES_PASSED);
  }
  glStencilMask(~0u);
  end_marks();
}

/// All layer pairs of a first and a second patch; at most one of the two has several layers.
void MirrorsInMirrors::draw_layers(render::Renderer& renderer, render::View view) {
  const Layers first = layers_of(*first_->patch), second = layers_of(*second_->patch);
  for (first_layer_ = first.first; first_layer_ < first.end; ++first_layer_)
    for (second_layer_ = second.first; second_layer_ < second.end; ++second_layer_) {
      renderer.draw_view(view);
      view.clears = false;
    }
}

void MirrorsInMirrors::draw(render::Renderer& renderer, const gl::Program& patch_pixels,
                            std::span<const ShownPatch> first, std::span<const ShownPatch> second) {
  firsts_.clear();
  for (const ShownPatch& patch : first)
    if (firsts_.size() < maximum) firsts_.push_back(patch);
  render::View view = picture_.begin(renderer, *this);
  glEnable(GL_STENCIL_TEST);
  mark_patches(patch_pixels, view, firsts_);
  picture_.clear_colour();  // but for where they show mirrors
  for (std::size_t f = 0; f < firsts_.size(); ++f) {
    first_ = &firsts_[f];
    find_seconds(*first_, second);
    picture_.clear_depth();
    view.part = pixels_of(*first_, view);
    mark_seconds(view, int(f) + 1);
    for (std::size_t s = 0; s < seconds_.size(); ++s) {
      second_ = &seconds_[s];
      view.excluded_object = second_->object;
      glStencilFunc(GL_EQUAL, GLint((s + 1) << 4) | (int(f) + 1), 0xff);
      glBeginConditionalRender(is_seen_[s].name(), GL_QUERY_WAIT);
      draw_layers(renderer, view);
      glEndConditionalRender();
    }
  }
  glDisable(GL_STENCIL_TEST);
  picture_.resolve(renderer);
}

void MirrorsInMirrors::bind(const gl::Program& program) {
  GpuReflector::bind(program, *first_->patch, first_->world_from_reflector, reflector_unit, first_layer_);
  GpuReflector::bind(program, *second_->patch, second_->world_from_reflector, second_reflector_unit,
                     second_layer_, 1);
  second_mirror_.bind(program, {.clip_of_view = glm::mat4(1.0f),
                                .world_from_second = second_->world_from_reflector,
                                .viewer_in_world = glm::vec4(0.0f),
                                .second_middle = glm::vec4(bounds_in_world(*second_).centre(), 1.0f)});
}

}  // namespace parvis::virtual_objects
