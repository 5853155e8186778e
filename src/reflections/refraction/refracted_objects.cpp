#include "reflections/refraction/refracted_objects.h"

#include <algorithm>
#include <cmath>

#include "graphics/gl/sampled_textures.h"
#include "graphics/render/frustum.h"
#include "reflections/methods/cube_map.h"
#include "reflections/reflector_maps/bindings.h"
#include "reflections/reflector_maps/settings.h"

namespace parvis::refraction {
namespace {

#include "reflections/refraction/glass_light_part.glsl"

constexpr float max_angle_from_ray = 0.45f;  // radians: a body farther beside each traced ray is not shown
constexpr int pane_number = 255;             // of the stencil
constexpr std::size_t max_shown = 254;       // other numbers

/// A reflector's mesh as one patch, for drawing alone.
Reflector surface_of(const Reflector& reflector) {
  Reflector surface{reflector.mesh, {ReflectorPatch{}}, {ReflectorMap{}}, {}};
  for (std::uint32_t t = 0; t < reflector.mesh.neighbours.size(); ++t)
    surface.patches.front().triangles.push_back(t);
  surface.maps.front().texels = ImageF(1, 1, 4);
  return surface;
}

}  // namespace

Result<std::unique_ptr<RefractedObjects>> RefractedObjects::create(
    const scene::Scene& scene, const render::Renderer& renderer,
    std::unique_ptr<methods::Reflections> reflections) {
  Result<gl::Program> patch_pixels = gl::Program::create("reflections/reflector_maps/patch_pixels.vert",
                                                         "reflections/reflector_maps/patch_pixels.frag");
  if (!patch_pixels) return patch_pixels.errors();
  Result<gl::Program> glass_light =
      gl::Program::create("reflections/virtual_objects/own_reflection.vert",
                          "reflections/refraction/glass_light.frag", {{"ALL_PLAIN", ""}});
  if (!glass_light) return glass_light.errors();
  render::assign_bindings(*glass_light);
  Result<render::SurfacePrograms> programs =
      render::SurfacePrograms::create({.fragment = "reflections/refraction/refracted_surface.frag",
                                       .vertex = "reflections/refraction/refracted_vertices.vert",
                                       .defines = {{"IS_MIRRORED", ""}, {"ALL_PLAIN", ""}}},
                                      renderer.gpu().materials());
  if (!programs) return programs.errors();
  Result<VirtualPicture> picture = VirtualPicture::create();
  if (!picture) return picture.errors();
  return std::unique_ptr<RefractedObjects>(
      new RefractedObjects(scene, *std::move(programs), *std::move(patch_pixels), *std::move(glass_light),
                           *std::move(picture), std::move(reflections)));
}

RefractedObjects::RefractedObjects(const scene::Scene& scene, render::SurfacePrograms programs,
                                   gl::Program patch_pixels, gl::Program glass_light, VirtualPicture picture,
                                   std::unique_ptr<methods::Reflections> reflections)
    : Overlay(std::move(reflections)),
      VirtualVertices(std::move(programs)),
      patch_pixels_(std::move(patch_pixels)),
      glass_light_(std::move(glass_light)),
      picture_(std::move(picture)),
      shows_all_(shows_all_objects(scene)),
      within_m_(near_object_settings(scene).within_m) {
  const ReflectorCache cache(scene);
  for (const scene::Object& object : scene.objects) {
    const scene::Model* model = object.model.get();
    model_of_object_.push_back(model);
    if (!object.takes_reflection || !has_glass(*model)) continue;
    const auto [bodies, is_new] = glass_.try_emplace(model);
    if (!is_new) continue;
    for (const GlassSource& source : glass_sources(object))
      if (std::optional<Glass> glass = glass_of(cache, source)) bodies->second.push_back(*std::move(glass));
  }
}

std::optional<RefractedObjects::Glass> RefractedObjects::glass_of(const ReflectorCache& cache,
                                                                  const GlassSource& source) {
  const std::string& name = source.outside.name;
  const Result<Reflector> made = cache.reflector(source.outside);
  if (!made) {
    fmt::print(stderr, "warning: {}; as solid glass it shows the sky straight through\n",
               to_string(made.errors().front()));
    return std::nullopt;
  }
  const auto glass = [&](const Reflector& surface, std::optional<ReflectorMap> map) {
    return Glass{GpuReflector(surface), std::move(map),
                 source.material->ior,  source.material->absorption_per_m,
                 source.parts,          source.thickness};
  };
  const ReflectorMap& map = made->maps.front();
  if (source.is_closed && made->patches.size() == 1 && map.is_convex && map.is_whole_body())
    return glass(*made, map);
  const std::string_view why =
      source.is_closed ? "its glass is not one convex body" : "its glass is open; close its holes";
  fmt::print(stderr, "warning: {}: {}; it shows what is behind it straight through, as a pane\n", name, why);
  return glass(surface_of(*made), std::nullopt);
}

void RefractedObjects::find_glass(const render::Renderer& renderer,
                                  const std::vector<methods::VisibleReflector>& reflectors) {
  shown_.clear();
  through_.clear();
  panes_.clear();
  glass_of_panes_.clear();
  near_.begin_frame();
  for (const methods::VisibleReflector& reflector : reflectors)
    if (const auto bodies = glass_.find(model_of_object_[std::size_t(reflector.object)]);
        bodies != glass_.end())
      find_bodies(renderer, reflector.object, bodies->second);
}

/// Those of an object that the main view may see.
void RefractedObjects::find_bodies(const render::Renderer& renderer, int object,
                                   const std::vector<Glass>& bodies) {
  const glm::mat4& world_from_reflector = renderer.gpu().world_from_model(object);
  const bool is_even = is_scaled_evenly(world_from_reflector);
  const int near = shows_all_ ? -1 : near_.find(renderer, object, within_m_);
  const glm::vec3 viewer = in_reflector(world_from_reflector, renderer.main_view().position_in_world);
  const render::Frustum frustum(renderer.main_view().clip_from_world * world_from_reflector);
  for (const Glass& glass : bodies) {
    const GpuReflector::Patch& patch = glass.gpu.patches().front();
    if (!frustum.may_see(patch.bounds.box)) continue;
    if (!glass.map || !is_even || shown_.size() == max_shown) {
      panes_.push_back({object, -1, &glass.gpu, &patch, world_from_reflector, viewer});
      glass_of_panes_.push_back(&glass);
      continue;
    }
    const auto [nearest, normal] = glass.map->surface(viewer - glass.map->window.centre);
    if (glm::dot(viewer - nearest, normal) <= 0.0f) continue;  // within the glass nothing of it is drawn
    shown_.push_back({object, near, &glass.gpu, &patch, world_from_reflector, viewer});
    const auto surface = [&](glm::vec3 direction) { return glass.map->surface(direction); };
    const GlassBody body{surface, patch.window.centre, patch.window.reach, glass.ior};
    ViewThrough& through = through_.emplace_back();
    through.glass = &glass;
    through.shows_objects = shows_all_ || near >= 0;
    if (through.shows_objects) through.rays = refraction_rays(body, viewer);
  }
}

/// The pixels of one body: by virtual objects where they are wanted, before the cube map of its surroundings.
void RefractedObjects::draw_through(render::Renderer& renderer, std::size_t i, render::View view) {
  if (!through_[i].shows_objects) return draw_light(view, i, all_light);
  draw_light(view, i, behind_glass);
  current_ = i;
  own_items_.clear();
  for (const std::size_t part : through_[i].glass->parts)
    own_items_.push_back(renderer.gpu().first_item(shown_[i].object) + std::uint32_t(part));
  view.left_out_items = own_items_;
  view.part = pixels_of(shown_[i], view);
  view.shown_objects = near_.list(shown_[i].near);
  for (foci_ = 0; foci_ < refraction_layers; ++foci_) {
    renderer.draw_view(view);
    view.clears = false;
  }
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
  draw_light(view, i, let_through);
  glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
  draw_light(view, i, from_inside);
  glDisable(GL_BLEND);
}

/// The pixels of all bodies that light is not followed through: the scene as it is without glass, less what
/// those of them absorb that nothing hides.
void RefractedObjects::draw_panes(render::Renderer& renderer, render::View view) {
  glStencilFunc(GL_EQUAL, pane_number, 0xff);
  view.kind = render::ViewKind::cube_face;  // in it mirrors show the sky
  view.virtual_vertices = nullptr;
  view.shows_glass = false;
  glm::ivec2 low(view.width, view.height), high(0);
  for (const ShownPatch& pane : panes_) {
    const glm::ivec4 part = pixels_of(pane, view);
    low = glm::min(low, glm::ivec2(part)),
    high = glm::max(high, glm::ivec2(part) + glm::ivec2(part.z, part.w));
  }
  view.part = {low, high - low};
  renderer.draw_view(view);
  glDepthRange(1.0, 0.0);  // as the renderer has left it
  glDepthFunc(GL_GEQUAL);
  glDepthMask(GL_FALSE);
  glEnable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ZERO, GL_CONSTANT_COLOR, GL_ZERO, GL_ONE);
  patch_pixels_.use();
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    const Glass& glass = *glass_of_panes_[i];
    const float thickness_m = glass.thickness * glm::length(panes_[i].world_from_reflector[0]);
    const glm::vec3 left = glm::exp(-thickness_m * glass.absorption_per_m);
    glBlendColor(left.x, left.y, left.z, 1.0f);
    patch_pixels_.set("clip_from_reflector", view.clip_from_world * panes_[i].world_from_reflector);
    panes_[i].reflector->draw(*panes_[i].patch);
  }
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthRange(0.0, 1.0);
}

void RefractedObjects::draw_light(const render::View& view, std::size_t i, int part) const {
  const ShownPatch& shown = shown_[i];
  const Glass& glass = *through_[i].glass;
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glass_light_.use();
  GpuReflector::bind(glass_light_, *shown.patch, shown.world_from_reflector, reflector_unit);
  const methods::CubeMap* surroundings = surroundings_of(shown.object);
  gl::bind_textures(glass_light_, {{"surroundings", methods::first_method_unit,
                                    surroundings ? surroundings->texture() : 0}});
  patch_view_.bind(glass_light_, shown, view.clip_from_world);
  const glm::vec3 absorption = glm::length(shown.world_from_reflector[0]) * glass.absorption_per_m;
  light_.bind(glass_light_,
              {.glass_absorption = glm::vec4(absorption, glass.ior),
               .surroundings_levels = surroundings ? std::log2(float(surroundings->resolution())) : -1.0f,
               .shown_part = part});
  shown.reflector->draw(*shown.patch);
  glEnable(GL_DEPTH_TEST);
}

void RefractedObjects::update_maps(render::Renderer& renderer, const scene::Scene& scene,
                                   const std::vector<methods::VisibleReflector>& reflectors) {
  for (std::size_t o = model_of_object_.size(); o < scene.objects.size(); ++o)
    model_of_object_.push_back(scene.objects[o].model.get());
  update_below(renderer, scene, reflectors);
  find_glass(renderer, reflectors);
  const render::View view = picture_.begin(renderer, *this);
  glEnable(GL_STENCIL_TEST);
  mark_patches(patch_pixels_, view, shown_);
  mark_patches(patch_pixels_, view, panes_, pane_number);
  if (!panes_.empty()) draw_panes(renderer, view);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    glStencilFunc(GL_EQUAL, GLint(i) + 1, 0xff);
    draw_through(renderer, i, view);
  }
  glDisable(GL_STENCIL_TEST);
  picture_.resolve(renderer);
}

void RefractedObjects::bind(const gl::Program& program) {
  const ShownPatch& shown = shown_[current_];
  GpuReflector::bind(program, *shown.patch, shown.world_from_reflector, reflector_unit);
  refraction_shared::Refraction values{
      .refraction_rays = {}, .glass_ior = through_[current_].glass->ior, .passed_by_light = foci_};
  std::ranges::copy(through_[current_].rays, values.refraction_rays);
  refraction_.bind(program, values);
}

/// Does a ray that leaves the glass come near, having passed as many foci as those of this layer?
bool RefractedObjects::may_show(const Bounds& bounds) const {
  if (bounds.empty()) return false;
  const glm::mat4& world_from_reflector = shown_[current_].world_from_reflector;
  const glm::vec3 centre = in_reflector(world_from_reflector, bounds.centre());
  const float radius = bounds.radius() / glm::length(world_from_reflector[0]);
  return std::ranges::any_of(through_[current_].rays, [&](const glm::mat4& ray) {
    const glm::vec3 to_centre = centre - glm::vec3(ray[1]);
    const float distance = glm::length(to_centre);
    const auto foci_at = [&](float far) { return int(far > ray[0].w) + int(far > ray[1].w); };
    // Foci lie nearer, and farther, between the rays that were traced.
    if (foci_ < foci_at(0.8f * (distance - radius)) || foci_ > foci_at(1.25f * (distance + radius)))
      return false;
    if (distance <= radius) return true;
    const float angle = std::acos(std::clamp(glm::dot(to_centre, glm::vec3(ray[2])) / distance, -1.0f, 1.0f));
    return angle < std::asin(radius / distance) + max_angle_from_ray;
  });
}

render::SurfaceSource RefractedObjects::source() const {
  render::SurfaceSource surface = Overlay::source();
  surface.includes.emplace_back("reflections/refraction/glass_picture.glsl");
  surface.transmission = fmt::format("seen_through_glass({})", surface.transmission);
  return surface;
}

void RefractedObjects::bind(const gl::Program& program, int object) {
  gl::bind_textures(program, {{"glass_picture", glass_picture_unit, picture_.texture()}});
  program.set("glass_share", is_shown(shown_, object) || is_shown(panes_, object) ? 1.0f : 0.0f);
  Overlay::bind(program, object);
}

Result<std::unique_ptr<methods::Reflections>> make_refracted_objects(
    const scene::Scene& scene, render::Renderer& renderer,
    std::unique_ptr<methods::Reflections> reflections) {
  Result<std::unique_ptr<RefractedObjects>> made =
      RefractedObjects::create(scene, renderer, std::move(reflections));
  if (!made) return made.errors();
  return std::unique_ptr<methods::Reflections>(*std::move(made));
}

}  // namespace parvis::refraction
