#include "reflections/virtual_objects/virtual_objects.h"

#include <algorithm>
#include <cmath>

#include "graphics/gl/sampled_textures.h"
#include "graphics/render/frustum.h"
#include "reflections/reflector_maps/bindings.h"
#include "reflections/reflector_maps/reflector_cache.h"
#include "reflections/reflector_maps/settings.h"
#include "reflections/virtual_objects/search_settings.h"

namespace parvis::virtual_objects {
namespace {

constexpr std::size_t max_shown = 255;  // numbers of the stencil
constexpr float min_size_px = 120.0f;   // on the screen, of a mirror in which what is near is worth it
constexpr float large_radii = 3.0f;     // of a mirror: what is larger is in its surroundings

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

/// Defines of shaders with map_window.glsl.
gl::Defines map_defines(const ReflectorsByModel& reflectors) {
  return are_plain(reflectors) ? gl::Defines{{"ALL_PLAIN", ""}} : gl::Defines{};
}

/// Defines of shaders with virtual_point.glsl.
gl::Defines search_defines(const ReflectorsByModel& reflectors, const SearchSettings& settings) {
  gl::Defines defines = map_defines(reflectors);
  if (settings.search == SearchMethod::midpoint)
    defines.emplace_back("MIDPOINT_ITERATIONS", std::to_string(settings.iterations));
  return defines;
}

void add_near_picture(render::SurfaceSource& surface) {
  surface.includes.emplace_back("reflections/virtual_objects/near_picture.glsl");
  surface.reflection = fmt::format("with_near_objects({}, roughness, surface_mirrors)", surface.reflection);
}

void bind_near_picture(const gl::Program& program, GLuint texture, float share) {
  if (!program.declares("near_picture")) return;  // a program of surfaces that mirror nothing
  gl::bind_textures(program, {{"near_picture", near_picture_unit, texture}});
  program.set("near_share", share);
}

/// Reflectance of the first mirror-like material, seen from before it.
glm::vec3 mirror_colour(const std::vector<scene::Material>& materials) {
  constexpr float coat = 0.04f;
  for (const scene::Material& material : materials)
    if (material.is_mirror_like) return glm::mix(glm::vec3(coat), material.base_colour, material.metallic);
  return glm::vec3(coat);
}

}  // namespace

Result<std::unique_ptr<VirtualObjects>> VirtualObjects::create(
    const scene::Scene& scene, render::Renderer& renderer,
    std::unique_ptr<methods::Reflections> surroundings) {
  Result<gl::Program> patch_pixels = gl::Program::create("reflections/reflector_maps/patch_pixels.vert",
                                                         "reflections/reflector_maps/patch_pixels.frag");
  if (!patch_pixels) return patch_pixels.errors();
  Result<gl::Program> own_reflection = gl::Program::create("reflections/virtual_objects/own_reflection.vert",
                                                           "reflections/virtual_objects/own_reflection.frag");
  if (!own_reflection) return own_reflection.errors();
  render::assign_bindings(*own_reflection);
  std::unique_ptr<MirrorsInMirrors> in_mirrors;
  ReflectorsByModel reflectors = reflectors_of(scene);
  gl::Defines defines = search_defines(reflectors, search_settings(scene));
  Result<VertexSearch> vertex_search = VertexSearch::create(scene, renderer.gpu(), defines);
  if (!vertex_search) return vertex_search.errors();
  defines.emplace_back("IS_MIRRORED", "");
  if (shows_all_objects(scene) && methods::settings(scene).bounces > 1) {
    Result<std::unique_ptr<MirrorsInMirrors>> made =
        MirrorsInMirrors::create(renderer, map_defines(reflectors));
    if (!made) return made.errors();
    in_mirrors = *std::move(made);
  }
  render::SurfaceSource surface{.fragment = "reflections/virtual_objects/virtual_surface.frag",
                                .vertex = "reflections/virtual_objects/virtual_vertices.vert",
                                .defines = std::move(defines)};
  if (vertex_search->has_any()) surface.mesh_defines.emplace_back("HAS_VERTEX_SEARCH", "");
  if (in_mirrors) add_near_picture(surface);
  Result<render::SurfacePrograms> programs =
      render::SurfacePrograms::create(surface, renderer.gpu().materials());
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
                               std::unique_ptr<methods::Reflections> surroundings)
    : Overlay(std::move(surroundings)),
      VirtualVertices(std::move(programs)),
      reflectors_(std::move(reflectors)),
      patch_pixels_(std::move(patch_pixels)),
      own_reflection_(std::move(own_reflection)),
      picture_(std::move(picture)),
      vertex_search_(std::move(vertex_search)),
      in_mirrors_(std::move(in_mirrors)),
      uses_level_of_detail_(methods::settings(scene).uses_level_of_detail),
      shows_all_(shows_all_objects(scene)),
      within_m_(near_object_settings(scene).within_m) {
  follow_objects(scene);
}

/// Reflectors among new objects are those of models that are known: for others a method is made
/// (stage).
void VirtualObjects::follow_objects(const scene::Scene& scene) {
  for (std::size_t o = model_of_object_.size(); o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    model_of_object_.push_back(object.takes_reflection ? object.model.get() : nullptr);
    colour_of_object_.push_back(mirror_colour(object.materials()));
  }
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
                                  const std::vector<methods::VisibleReflector>& reflectors) {
  shown_.clear();
  near_.begin_frame();
  for (const methods::VisibleReflector& reflector : reflectors) {
    const auto& gpu = reflectors_.at(model_of_object_[std::size_t(reflector.object)]);
    const glm::mat4& world_from_reflector = renderer.gpu().world_from_model(reflector.object);
    if (!gpu || !is_scaled_evenly(world_from_reflector)) continue;
    const bool is_small = uses_level_of_detail_ && reflector.size_px < min_size_px;
    if (!shows_all_ && is_small) continue;
    const int near = shows_all_ ? -1 : near_.find(renderer, reflector.object, within_m_);
    if (!shows_all_ && near < 0) continue;
    const glm::vec3 viewer = in_reflector(world_from_reflector, renderer.main_view().position_in_world);
    const render::Frustum frustum(renderer.main_view().clip_from_world * world_from_reflector);
    for (const GpuReflector::Patch& patch : gpu->patches())
      if (shown_.size() < max_shown && patch.bounds.may_be_seen(viewer) && frustum.may_see(patch.bounds.box))
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

/// Self-reflections of concave mirrors, drawn over what they show. The light of the mirrored views is
/// bound still.
void VirtualObjects::draw_own_reflections(const render::View& view) {
  if (!shows_all_) return;  // the method below shows them
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  own_reflection_.use();
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (shown_[i].patch->is_convex) continue;
    glStencilFunc(GL_EQUAL, GLint(i) + 1, 0xff);
    current_ = &shown_[i];
    bind(own_reflection_);
    patch_view_.bind(own_reflection_, shown_[i], view.clip_from_world,
                     colour_of_object_[std::size_t(shown_[i].object)]);
    shown_[i].reflector->draw(*shown_[i].patch);
  }
  current_ = nullptr;
  glEnable(GL_DEPTH_TEST);
}

/// Where all is drawn as virtual objects, surroundings fill what searches leave open: with what is large.
/// What is small would stand beside its own virtual image, for a map has one centre.
void VirtualObjects::leave_out_small(const render::Renderer& renderer) {
  const std::vector<Bounds>& bounds = renderer.gpu().object_bounds();
  if (large_.size() < below_reflectors_.size()) large_.resize(below_reflectors_.size());
  for (std::size_t r = 0; r < below_reflectors_.size(); ++r) {
    const float min_m = large_radii * bounds[std::size_t(below_reflectors_[r].object)].radius();
    large_[r].resize(bounds.size());
    for (std::size_t o = 0; o < bounds.size(); ++o) large_[r][o] = bounds[o].radius() > min_m ? 1 : 0;
    below_reflectors_[r].shown = &large_[r];
  }
}

/// Marks for the method below which reflectors have objects drawn over it.
void VirtualObjects::flag_near_objects() {
  for (methods::VisibleReflector& reflector : below_reflectors_) {
    const auto patch = std::ranges::find(shown_, reflector.object, &ShownPatch::object);
    if (patch != shown_.end()) reflector.overlaid = near_.list(patch->near);
  }
}

void VirtualObjects::update_maps(render::Renderer& renderer, const scene::Scene& scene,
                                 const std::vector<methods::VisibleReflector>& reflectors) {
  follow_objects(scene);
  find_patches(renderer, reflectors);
  below_reflectors_ = reflectors;
  if (shows_all_)
    leave_out_small(renderer);
  else
    flag_near_objects();
  update_below(renderer, scene, below_reflectors_);
  if (in_mirrors_) {
    find_all_patches(renderer);
    in_mirrors_->draw(renderer, patch_pixels_, shown_, all_);
  }
  const render::View view = picture_.begin(renderer, *this);
  pixels_per_radian_ =
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
  GpuReflector::bind(program, *current_->patch, current_->world_from_reflector, reflector_unit, layer_);
  vertex_search_.bind(program);
  if (!in_mirrors_) return;
  bind_near_picture(program, in_mirrors_->texture(), 1.0f);
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
      pixels_per_radian_ * current_->patch->bounds.image_width(
                               current_->viewer, in_reflector(world_from_reflector, item.bounds.centre()),
                               item.bounds.radius() / glm::length(world_from_reflector[0]),
                               current_->patch->is_convex);
  return vertex_search_.add(item, 0.7853982f * width_px * width_px);  // of a disc
}

void VirtualObjects::prepare() {
  vertex_search_.search([this](const gl::Program& program) {
    bind(program);
    patch_view_.bind(program, *current_, glm::mat4(1.0f));
  });
}

render::SurfaceSource VirtualObjects::source() const {
  render::SurfaceSource surface = Overlay::source();
  add_near_picture(surface);
  return surface;
}

void VirtualObjects::bind(const gl::Program& program, int object) {
  bind_near_picture(program, picture_.texture(), is_shown(shown_, object) ? 1.0f : 0.0f);
  Overlay::bind(program, object);
}

Result<std::unique_ptr<methods::Reflections>> make_virtual_objects(
    const scene::Scene& scene, render::Renderer& renderer,
    std::unique_ptr<methods::Reflections> surroundings) {
  Result<std::unique_ptr<VirtualObjects>> made =
      VirtualObjects::create(scene, renderer, std::move(surroundings));
  if (!made) return made.errors();
  return std::unique_ptr<methods::Reflections>(*std::move(made));
}

}  // namespace parvis::virtual_objects
