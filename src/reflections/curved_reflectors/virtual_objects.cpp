#include "reflections/curved_reflectors/virtual_objects.h"

#include <algorithm>
#include <cmath>

#include "graphics/render/bindings.h"
#include "graphics/render/frustum.h"
#include "reflections/curved_reflectors/reflector_cache.h"

namespace parvis::curved_reflectors {
namespace {

constexpr std::size_t most_shown = 255;  // numbers of the stencil
constexpr float least_size_px = 120.0f;  // on the screen, of a mirror in which what is near is worth it
constexpr float large_radii = 3.0f;      // of a mirror: what is larger is in its surroundings

std::unique_ptr<GpuReflector> reflector_of(const ReflectorCache& cache, const scene::Scene& scene,
                                           const scene::Object& object) {
  const Result<Reflector> made = cache.reflector(mirror_source(scene, object));
  if (!made) {
    fmt::print(stderr, "warning: {}; it mirrors the sky alone\n", to_string(made.errors().front()));
    return nullptr;
  }
  for (const std::string& remark : made->remarks) fmt::print(stderr, "warning: {}\n", remark);
  return std::make_unique<GpuReflector>(*made);
}

ReflectorsByModel reflectors_of(const scene::Scene& scene) {
  const ReflectorCache cache(scene);
  ReflectorsByModel reflectors;
  for (const scene::Object& object : scene.objects)
    if (object.takes_reflection && !reflectors.contains(object.model.get()))
      reflectors[object.model.get()] = reflector_of(cache, scene, object);
  return reflectors;
}

bool are_plain(const ReflectorsByModel& reflectors) {
  return std::ranges::none_of(reflectors, [](const auto& made) {
    return made.second && std::ranges::any_of(made.second->patches(), [](const GpuReflector::Patch& patch) {
             return !patch.is_convex || !patch.shows_once || patch.window.extent == 0.0f;
           });
  });
}

/// For shaders with map_window.glsl.
gl::Defines map_defines(const ReflectorsByModel& reflectors) {
  return are_plain(reflectors) ? gl::Defines{{"ALL_PLAIN", ""}} : gl::Defines{};
}

/// For shaders with virtual_point.glsl.
gl::Defines search_defines(const ReflectorsByModel& reflectors, const scene::Reflection& reflection) {
  gl::Defines defines = map_defines(reflectors);
  if (reflection.search == scene::ReflectionSearch::midpoint)
    defines.emplace_back("MIDPOINT_ITERATIONS", std::to_string(reflection.iterations));
  return defines;
}

/// What the first mirror-like material gives back, seen from before it.
glm::vec3 mirror_colour(const scene::Model& model) {
  constexpr float coat = 0.04f;
  for (const scene::Material& material : model.materials)
    if (material.is_mirror_like) return glm::mix(glm::vec3(coat), material.base_colour, material.metallic);
  return glm::vec3(coat);
}

}  // namespace

Result<std::unique_ptr<VirtualObjects>> VirtualObjects::create(
    const scene::Scene& scene, render::Renderer& renderer,
    std::unique_ptr<render::Reflections> surroundings) {
  Result<gl::Program> patch_pixels = gl::Program::create("reflections/curved_reflectors/patch_pixels.vert",
                                                         "reflections/curved_reflectors/patch_pixels.frag");
  if (!patch_pixels) return patch_pixels.errors();
  Result<gl::Program> own_reflection =
      gl::Program::create("reflections/curved_reflectors/own_reflection.vert",
                          "reflections/curved_reflectors/own_reflection.frag");
  if (!own_reflection) return own_reflection.errors();
  render::assign_bindings(*own_reflection);
  std::unique_ptr<MirrorsInMirrors> in_mirrors;
  ReflectorsByModel reflectors = reflectors_of(scene);
  gl::Defines defines = search_defines(reflectors, scene.reflection);
  Result<VertexSearch> vertex_search = VertexSearch::create(scene, renderer.gpu(), defines);
  if (!vertex_search) return vertex_search.errors();
  defines.emplace_back("IS_MIRRORED", "");
  if (vertex_search->has_any()) defines.emplace_back("HAS_VERTEX_SEARCH", "");
  if (scene.reflection.method == scene::ReflectionMethod::virtual_objects && scene.reflection.bounces > 1) {
    Result<std::unique_ptr<MirrorsInMirrors>> made =
        MirrorsInMirrors::create(renderer, map_defines(reflectors));
    if (!made) return made.errors();
    in_mirrors = *std::move(made);
    defines.emplace_back("HAS_NEAR_PICTURE", "");
  }
  Result<render::SurfacePrograms> programs = render::SurfacePrograms::create(
      "reflections/curved_reflectors/virtual_surface.frag", renderer.gpu().materials(),
      "reflections/curved_reflectors/virtual_vertices.vert", defines);
  if (!programs) return programs.errors();
  Result<VirtualPicture> picture = VirtualPicture::create();
  if (!picture) return picture.errors();
  return std::unique_ptr<VirtualObjects>(
      new VirtualObjects(scene, std::move(reflectors), *std::move(programs), *std::move(patch_pixels),
                         *std::move(own_reflection), *std::move(picture), *std::move(vertex_search),
                         std::move(in_mirrors), std::move(surroundings)));
}

VirtualObjects::VirtualObjects(const scene::Scene& scene, ReflectorsByModel reflectors,
                               render::SurfacePrograms programs, gl::Program patch_pixels,
                               gl::Program own_reflection, VirtualPicture picture, VertexSearch vertex_search,
                               std::unique_ptr<MirrorsInMirrors> in_mirrors,
                               std::unique_ptr<render::Reflections> surroundings)
    : VirtualVertices(std::move(programs)),
      reflectors_(std::move(reflectors)),
      patch_pixels_(std::move(patch_pixels)),
      own_reflection_(std::move(own_reflection)),
      picture_(std::move(picture)),
      vertex_search_(std::move(vertex_search)),
      in_mirrors_(std::move(in_mirrors)),
      settings_(scene.reflection),
      surroundings_(std::move(surroundings)) {
  for (const scene::Object& object : scene.objects)
    model_of_object_.push_back(object.takes_reflection ? object.model.get() : nullptr);
}

/// All that may be seen in another.
void VirtualObjects::find_all_patches(const render::Renderer& renderer) {
  all_.clear();
  for (std::size_t o = 0; o < model_of_object_.size(); ++o) {
    const auto made = reflectors_.find(model_of_object_[o]);
    if (made == reflectors_.end() || !made->second || !renderer.gpu().is_visible(int(o))) continue;
    const glm::mat4& world_from_reflector = renderer.gpu().world_from_model(int(o));
    if (!is_scaled_evenly(world_from_reflector)) continue;
    for (const GpuReflector::Patch& patch : made->second->patches())
      all_.push_back({int(o), -1, made->second.get(), &patch, world_from_reflector, glm::vec3(0.0f)});
  }
}

void VirtualObjects::find_patches(const render::Renderer& renderer,
                                  const std::vector<render::Reflector>& reflectors) {
  shown_.clear();
  near_.begin_frame();
  const bool shows_all = settings_.method == scene::ReflectionMethod::virtual_objects;
  for (const render::Reflector& reflector : reflectors) {
    const auto& gpu = reflectors_.at(model_of_object_[std::size_t(reflector.object)]);
    const glm::mat4& world_from_reflector = renderer.gpu().world_from_model(reflector.object);
    if (!gpu || !is_scaled_evenly(world_from_reflector)) continue;
    const bool is_small = settings_.uses_level_of_detail && reflector.size_px < least_size_px;
    if (!shows_all && is_small) continue;
    const int near = shows_all ? -1 : near_.find(renderer, reflector.object, settings_.virtual_within_m);
    if (!shows_all && near < 0) continue;
    const glm::vec3 viewer = in_reflector(world_from_reflector, renderer.main_view().position_in_world);
    const render::Frustum frustum(renderer.main_view().clip_from_world * world_from_reflector);
    for (const GpuReflector::Patch& patch : gpu->patches())
      if (shown_.size() < most_shown && patch.bounds.may_be_seen(viewer) && frustum.may_see(patch.bounds.box))
        shown_.push_back({reflector.object, near, gpu.get(), &patch, world_from_reflector, viewer});
  }
}

/// A patch that may show a vertex several times is drawn layer by layer, over one another.
void VirtualObjects::draw_patch(render::Renderer& renderer, const ShownPatch& patch, render::View view) {
  current_ = &patch;
  view.excluded_object = patch.object;
  view.part = pixels_of(patch, view);
  view.shown_objects = near_.list(patch.near);
  const auto [first, end] = layers_of(*patch.patch);
  for (layer_ = first; layer_ < end; ++layer_) {
    renderer.draw_view(view);
    view.clears = false;
  }
  current_ = nullptr;
}

/// Over what hollows show: themselves, where their mirror rays meet them. The light of the mirrored views is
/// bound still.
void VirtualObjects::draw_own_reflections(const render::View& view) {
  if (settings_.method != scene::ReflectionMethod::virtual_objects) return;  // the method below shows them
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  own_reflection_.use();
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (shown_[i].patch->is_convex) continue;
    glStencilFunc(GL_EQUAL, GLint(i) + 1, 0xff);
    current_ = &shown_[i];
    bind(own_reflection_);
    own_reflection_.set("clip_from_reflector", view.clip_from_world * shown_[i].world_from_reflector);
    own_reflection_.set("viewer_in_reflector", shown_[i].viewer);
    own_reflection_.set("mirror_colour", mirror_colour(*model_of_object_[std::size_t(shown_[i].object)]));
    shown_[i].reflector->draw(*shown_[i].patch);
  }
  current_ = nullptr;
  glEnable(GL_DEPTH_TEST);
}

/// Where all is drawn as virtual objects, surroundings fill what searches leave open: with what is large.
/// What is small would stand beside its own virtual image, for a map has one centre.
void VirtualObjects::draw_surroundings(render::Renderer& renderer, const scene::Scene& scene,
                                       const std::vector<render::Reflector>& reflectors) {
  const std::vector<Bounds>& bounds = renderer.gpu().object_bounds();
  with_large_ = reflectors;
  if (large_.size() < reflectors.size()) large_.resize(reflectors.size());
  for (std::size_t r = 0; r < reflectors.size(); ++r) {
    if (settings_.method != scene::ReflectionMethod::virtual_objects) break;
    const float least_m = large_radii * bounds[std::size_t(reflectors[r].object)].radius();
    large_[r].resize(bounds.size());
    for (std::size_t o = 0; o < bounds.size(); ++o) large_[r][o] = bounds[o].radius() > least_m ? 1 : 0;
    with_large_[r].shown = &large_[r];
  }
  surroundings_->update_for(renderer, scene, with_large_);
  faces_drawn_ = surroundings_->faces_drawn();
}

void VirtualObjects::update_maps(render::Renderer& renderer, const scene::Scene& scene,
                                 const std::vector<render::Reflector>& reflectors) {
  if (surroundings_) draw_surroundings(renderer, scene, reflectors);
  find_patches(renderer, reflectors);
  if (in_mirrors_) {
    find_all_patches(renderer);
    in_mirrors_->draw(renderer, patch_pixels_, shown_, all_);
  }
  const render::View view = picture_.begin(renderer, *this);
  pixels_a_radian_ =
      0.5f * float(view.height) * glm::length(glm::vec3(glm::transpose(view.clip_from_world)[1]));
  glEnable(GL_STENCIL_TEST);
  mark_patches(patch_pixels_, view, shown_);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    glStencilFunc(GL_EQUAL, GLint(i) + 1, 0xff);
    draw_patch(renderer, shown_[i], view);
  }
  draw_own_reflections(view);
  glDisable(GL_STENCIL_TEST);
  picture_.resolve(renderer);
}

void VirtualObjects::bind(const gl::Program& program) {
  GpuReflector::bind(program, *current_->patch, current_->world_from_reflector, render::virtual_vertex_unit,
                     layer_);
  vertex_search_.bind(program);
  if (!in_mirrors_) return;
  glBindTextureUnit(render::near_picture_unit, in_mirrors_->texture());
  program.set("near_share", 1.0f);
}

bool VirtualObjects::may_show(const Bounds& bounds) const {
  if (bounds.empty()) return false;
  const glm::mat4& world_from_reflector = current_->world_from_reflector;
  return current_->patch->bounds.may_show(current_->viewer,
                                          in_reflector(world_from_reflector, bounds.centre()),
                                          bounds.radius() / glm::length(world_from_reflector[0]));
}

glm::ivec2 VirtualObjects::add(const render::Item& item) {
  const glm::mat4& world_from_reflector = current_->world_from_reflector;
  const float width_px =
      pixels_a_radian_ * current_->patch->bounds.image_width(
                             current_->viewer, in_reflector(world_from_reflector, item.bounds.centre()),
                             item.bounds.radius() / glm::length(world_from_reflector[0]),
                             current_->patch->is_convex);
  return vertex_search_.add(item, 0.7853982f * width_px * width_px);  // of a disc
}

void VirtualObjects::prepare() {
  vertex_search_.search([this](const gl::Program& program) {
    bind(program);
    program.set("viewer_in_reflector", current_->viewer);
  });
}

std::string VirtualObjects::fragment_shader() const {
  return surroundings_ ? surroundings_->fragment_shader() : "graphics/render/surface.frag";
}

gl::Defines VirtualObjects::defines() const {
  gl::Defines defines = surroundings_ ? surroundings_->defines() : gl::Defines();
  defines.emplace_back("HAS_NEAR_PICTURE", "");
  return defines;
}

void VirtualObjects::bind(const gl::Program& program, int object) {
  glBindTextureUnit(render::near_picture_unit, picture_.texture());
  program.set("near_share", is_shown(shown_, object) ? 1.0f : 0.0f);
  if (surroundings_) surroundings_->bind(program, object);
}

Result<std::unique_ptr<render::Reflections>> make_virtual_objects(
    const scene::Scene& scene, render::Renderer& renderer,
    std::unique_ptr<render::Reflections> surroundings) {
  Result<std::unique_ptr<VirtualObjects>> made =
      VirtualObjects::create(scene, renderer, std::move(surroundings));
  if (!made) return made.errors();
  return std::unique_ptr<render::Reflections>(*std::move(made));
}

}  // namespace parvis::curved_reflectors
