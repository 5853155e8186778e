#include "reflections/local_maps/local_environment_maps.h"

#include <algorithm>

#include "base/parallel.h"
#include "graphics/gl/sampled_textures.h"
#include "graphics/render/frustum.h"
#include "reflections/local_maps/local_map_faces.h"
#include "reflections/local_maps/local_map_settings.h"
#include "reflections/methods/bindings.h"
#include "reflections/reference_maps/scene_maps.h"

namespace parvis::local_maps {
namespace {

constexpr float min_other_texels = 8.0f;  // a dynamic object that looks smaller in a map is left out of it

enum Unit : GLuint { local_unit = methods::first_method_unit, colours_unit };

/// Marks what else moves and looks large enough from a map's centre to be seen in it. Is there any?
bool mark_others(const render::GpuScene& gpu, int object, glm::vec3 centre, int tile,
                 std::vector<std::uint8_t>& others) {
  others.assign(gpu.object_bounds().size(), 0);
  for (int other = 0; other < int(others.size()); ++other) {
    if (other == object || !gpu.is_moving(other) || !gpu.is_visible(other)) continue;
    const Bounds& bounds = gpu.object_bounds()[std::size_t(other)];
    const float texels = shift_texels(2.0f * bounds.radius(), glm::distance(bounds.centre(), centre), tile);
    others[std::size_t(other)] = texels >= min_other_texels;
  }
  return std::ranges::find(others, 1) != others.end();
}

}  // namespace

Result<std::unique_ptr<LocalEnvironmentMaps>> LocalEnvironmentMaps::create(const scene::Scene& scene,
                                                                           render::Renderer& renderer) {
  HeightPyramid heights(heights_of(scene));
  Result<ReferenceMaps> maps = bake_maps(scene, heights, renderer);
  if (!maps) return maps.errors();
  Result<LocalMapPicture> picture = LocalMapPicture::create(
      tile_of(methods::settings(scene).resolution), methods::own_settings<LocalMapSettings>(scene).shown);
  if (!picture) return picture.errors();
  return std::unique_ptr<LocalEnvironmentMaps>(
      new LocalEnvironmentMaps(scene, std::move(heights), *std::move(maps), *std::move(picture)));
}

LocalEnvironmentMaps::LocalEnvironmentMaps(const scene::Scene& scene, HeightPyramid heights,
                                           ReferenceMaps maps, LocalMapPicture picture)
    : settings_(methods::settings(scene)),
      heights_(std::move(heights)),
      maps_(std::move(maps)),
      choice_(maps_.places(), heights_),
      picture_(std::move(picture)),
      budget_(double(settings_.budget_ms)) {}

LocalMapLevel LocalEnvironmentMaps::best_level_of(const methods::VisibleReflector& reflector,
                                                  float radius_m) const {
  if (!settings_.uses_level_of_detail) return full_level(settings_.resolution);
  const float moved_m =
      glm::distance(used_[std::size_t(reflector.object)].centre.value_or(reflector.centre), reflector.centre);
  const float speed_px = moved_m / std::max(2.0f * radius_m, 1e-3f) * reflector.size_px;
  return level_for(reflector.size_px, speed_px, settings_.resolution);
}

/// The best for each by its size and speed, or what of it the budget allows.
void LocalEnvironmentMaps::choose_levels(const render::Renderer& renderer,
                                         const std::vector<methods::VisibleReflector>& reflectors) {
  ladders_.clear();
  wishes_.clear();
  for (const methods::VisibleReflector& reflector : reflectors) {
    Used& used = used_[std::size_t(reflector.object)];
    used.level =
        best_level_of(reflector, renderer.gpu().object_bounds()[std::size_t(reflector.object)].radius());
    ladders_.push_back(ladder_below(used.level));
  }
  if (settings_.budget_ms <= 0.0f) return;
  for (std::size_t i = 0; i < reflectors.size(); ++i)
    wishes_.push_back({reflectors[i].size_px, std::span(ladders_[i].qualities).first(ladders_[i].rungs),
                       used_[std::size_t(reflectors[i].object)].rung});
  budget_.choose(wishes_);
  for (std::size_t i = 0; i < reflectors.size(); ++i) {
    Used& used = used_[std::size_t(reflectors[i].object)];
    used.rung = wishes_[i].level;
    used.level = ladders_[i].levels[std::size_t(used.rung)];
  }
}

/// One that is there already, one that is to be drawn, or none.
void LocalEnvironmentMaps::choose_map(const render::Renderer& renderer,
                                      const methods::VisibleReflector& reflector) {
  Used& used = used_[std::size_t(reflector.object)];
  const float radius_m = renderer.gpu().object_bounds()[std::size_t(reflector.object)].radius();
  const LocalMapLevel level = used.level;
  used.pair = pair_about(reflector.centre, maps_.places(), choice_);
  used.centre = reflector.centre;
  used.place.reset();
  if (level.tile == 0) return;
  const LocalMapWish wish{
      reflector.centre, radius_m, level.tile, level.smallest_texels,
      mark_others(renderer.gpu(), reflector.object, reflector.centre, level.tile, others_)};
  if (const std::optional<int> slot = slots_.find(wish)) {
    used.place = {*slot, level.tile};
  } else if (const std::optional<int> taken = slots_.take(wish)) {
    used.place = {*taken, level.tile};
    drawn_.push_back({*used.place, reflector.centre, reflector.object, wish.shows_others});
    for (int face = 0; face < 6; ++face)
      tasks_.push_back({reflector.centre,
                        face,
                        level.tile,
                        picture_.corner(*taken) + tile_corner(face, float(level.tile)),
                        used.pair.packed(),
                        {.smallest_texels = level.smallest_texels}});
  }
}

void LocalEnvironmentMaps::make_meshes() {
  if (meshes_.size() < tasks_.size()) meshes_.resize(tasks_.size());
  parallel_for(tasks_.size(), [&](std::size_t i) { make_face_mesh(heights_, tasks_[i], meshes_[i]); });
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    float nearest_m = sky_distance_m;
    for (std::size_t face = 0; face < 6; ++face)
      nearest_m = std::min(nearest_m, meshes_[6 * i + face].nearest_m);
    slots_.set_nearest(drawn_[i].place.slot, nearest_m);
  }
}

/// The second pass: cars and people, where a face sees any.
void LocalEnvironmentMaps::draw_others(render::Renderer& renderer, const Drawn& drawn) {
  const render::GpuScene& gpu = renderer.gpu();
  mark_others(gpu, drawn.object, drawn.centre, drawn.place.tile, others_);
  for (int face = 0; face < 6; ++face) {
    render::View view = picture_.face_view(drawn.place, face, drawn.centre);
    view.shown_objects = &others_;
    const render::Frustum frustum(view.clip_of_part() * view.clip_from_world);
    for (int other = 0; other < int(gpu.object_bounds().size()); ++other) {
      if (!view.shows(other) || !frustum.may_see(gpu.object_bounds()[std::size_t(other)])) continue;
      renderer.draw_view(view);
      break;
    }
  }
}

void LocalEnvironmentMaps::update_maps(render::Renderer& renderer, const scene::Scene&,
                                       const std::vector<methods::VisibleReflector>& reflectors) {
  used_.resize(renderer.gpu().object_bounds().size());
  drawn_.clear();
  tasks_.clear();
  const bool are_new = picture_.reserve(int(reflectors.size()));
  slots_.begin_frame(picture_.slots(), are_new);
  choose_levels(renderer, reflectors);
  for (const methods::VisibleReflector& reflector : reflectors) choose_map(renderer, reflector);

  make_meshes();
  picture_.draw(std::span(meshes_).first(tasks_.size()), maps_, heights_.cell_m());
  drawn_places_.clear();
  for (const Drawn& drawn : drawn_) {
    if (drawn.shows_others) draw_others(renderer, drawn);
    drawn_places_.push_back(drawn.place);
  }
  picture_.update_levels(drawn_places_);
  faces_drawn_ = int(tasks_.size());
}

void LocalEnvironmentMaps::bind(const gl::Program& program, int object) {
  const Used& used = used_[std::size_t(object)];
  gl::bind_textures(program, {{"local_maps", local_unit, picture_.texture()},
                              {"map_colours", colours_unit, maps_.colours()}});
  blended_.bind(program, maps_, used.pair);
  const glm::vec4 local_map =
      used.place ? glm::vec4(picture_.corner(used.place->slot), float(used.place->tile), 0.0f)
                 : glm::vec4(0.0f);
  local_.bind(program, {.local_map = local_map,
                        .picture_size = glm::vec2(picture_.size()),
                        .local_border = float(local_map_border)});
}

Result<std::unique_ptr<methods::Reflections>> make_local_environment_maps(
    const scene::Scene& scene, render::Renderer& renderer, std::unique_ptr<methods::Reflections>) {
  Result<std::unique_ptr<LocalEnvironmentMaps>> made = LocalEnvironmentMaps::create(scene, renderer);
  if (!made) return made.errors();
  return std::unique_ptr<methods::Reflections>(*std::move(made));
}

}  // namespace parvis::local_maps
