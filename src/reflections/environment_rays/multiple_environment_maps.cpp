#include "reflections/environment_rays/multiple_environment_maps.h"

#include <algorithm>
#include <utility>

#include "graphics/gl/sampled_textures.h"
#include "reflections/methods/bindings.h"
#include "reflections/methods/settings.h"
#include "reflections/reference_maps/scene_maps.h"

namespace parvis::environment_rays {
namespace {

enum Unit : GLuint {
  heights_unit = methods::first_method_unit,
  colours_unit,
  glosses_unit,
  distances_unit,
  choice_unit,
  places_unit,
  fields_unit
};

// The declared costs, and what each level of detail is worth.
constexpr double shown_share = 0.25;  // of the square about a body
constexpr std::array<double, 3> pixel_ms{0.4e-3, 0.7e-3, 1.5e-3};
constexpr std::array<double, 3> worths{0.5, 0.8, 1.0};

gl::Texture nearest_texture(GLenum format, int width, int height, int levels = 1) {
  gl::Texture texture = gl::texture_2d(format, width, height, levels);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER,
                      levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

gl::Texture upload(const HeightPyramid& heights) {
  const std::vector<ImageF>& levels = heights.levels();
  if (levels.empty()) return nearest_texture(GL_R32F, 1, 1);
  gl::Texture texture =
      nearest_texture(GL_R32F, levels.front().width, levels.front().height, int(levels.size()));
  for (std::size_t level = 0; level < levels.size(); ++level)
    glTextureSubImage2D(texture.name(), GLint(level), 0, 0, levels[level].width, levels[level].height, GL_RED,
                        GL_FLOAT, levels[level].pixels.data());
  return texture;
}

/// Room for as many of the scene's maps as its memory and the driver hold.
Result<ReferenceMaps> working_set(const scene::Scene& scene, std::vector<glm::vec3> places) {
  const ReferenceMapPlan& plan = map_plan(scene);
  const int side = ReferenceMaps::layer_side(map_resolution(scene));
  const double fitting =
      1e6 * double(plan.memory_mb) / double(ReferenceMaps::bytes_per_map(side, plan.is_compressed));
  places.resize(std::min({places.size(), ReferenceMaps::max_count(), std::size_t(std::max(fitting, 1.0))}));
  return ReferenceMaps::create(std::move(places), side, plan.is_compressed);
}

}  // namespace

Result<std::unique_ptr<MultipleEnvironmentMaps>> MultipleEnvironmentMaps::create(const scene::Scene& scene,
                                                                                 render::Renderer& renderer) {
  const auto heights = std::make_shared<const HeightPyramid>(heights_of(scene));
  MapCache baked(scene);
  std::unique_ptr<PlaceSearch> search;
  std::vector<glm::vec3> places;
  if (scene.data<methods::Pace>().begins_at_once && map_plan(scene).places.empty() && !baked.places()) {
    search = std::make_unique<PlaceSearch>(scene, heights);
    places = first_places(scene, *heights);
  } else {
    places = places_of(scene, *heights, baked);
  }
  Result<ReferenceMaps> maps = working_set(scene, places);
  if (!maps) return maps.errors();
  Result<MapRenewal> renewal = MapRenewal::create(map_resolution(scene));
  if (!renewal) return renewal.errors();
  Result<methods::MirrorPicture> picture =
      methods::MirrorPicture::create(renderer, methods::RayCount::and_edges);
  if (!picture) return picture.errors();
  Programs programs;
  for (std::size_t detail = 0; detail < programs.size(); ++detail) {
    Result<gl::Program> program = gl::Program::create(
        "graphics/render/whole_screen.vert", "reflections/environment_rays/multiple_environment_maps.frag",
        {{"DETAIL", std::to_string(detail)}});
    if (!program) return program.errors();
    render::assign_bindings(*program);
    programs[detail] = *std::move(program);
  }
  return std::unique_ptr<MultipleEnvironmentMaps>(new MultipleEnvironmentMaps(
      scene, *heights, std::move(baked), std::move(places), std::move(search), *std::move(maps),
      *std::move(renewal), *std::move(picture), std::move(programs)));
}

MultipleEnvironmentMaps::MultipleEnvironmentMaps(const scene::Scene& scene, const HeightPyramid& heights,
                                                 MapCache baked, std::vector<glm::vec3> places,
                                                 std::unique_ptr<PlaceSearch> search, ReferenceMaps maps,
                                                 MapRenewal renewal, methods::MirrorPicture picture,
                                                 Programs programs)
    : uses_level_of_detail_(methods::settings(scene).uses_level_of_detail),
      details_(scene.objects.size(), all_detail),
      budget_(double(methods::settings(scene).budget_ms)),
      picture_(std::move(picture)),
      programs_(std::move(programs)),
      search_(std::move(search)),
      baked_(std::move(baked)),
      maps_(std::move(maps)),
      renewal_(std::move(renewal)),
      bodies_(scene),
      origin_(heights.origin()),
      cell_m_(heights.cell_m()),
      cells_(heights.cells()),
      top_level_(int(heights.levels().size()) - 1),
      table_(MapChoice(places, heights), places, maps_.places().size()),
      heights_(upload(heights)) {
  renewal_.ask(maps_.places().size(), {});  // nothing is drawn yet
}

int MultipleEnvironmentMaps::best_detail_for(const methods::VisibleReflector& reflector) const {
  constexpr float traced_from_px = 40.0f, all_from_px = 120.0f;
  if (!uses_level_of_detail_ || reflector.size_px >= all_from_px) return all_detail;
  return reflector.size_px < traced_from_px ? nearest_map : one_map;
}

/// The best for each by its size, or what of it the budget allows: the largest come first.
void MultipleEnvironmentMaps::choose_details(const render::Renderer& renderer,
                                             const std::vector<methods::VisibleReflector>& reflectors) {
  if (budget_.budget_ms() <= 0.0) {
    for (const methods::VisibleReflector& reflector : reflectors)
      details_[std::size_t(reflector.object)] = best_detail_for(reflector);
    return;
  }
  const double max_pixels = double(renderer.width()) * double(renderer.height());
  qualities_.resize(reflectors.size());
  wishes_.clear();
  for (std::size_t i = 0; i < reflectors.size(); ++i) {
    const double size_px = double(reflectors[i].size_px);
    const double pixels = std::min(shown_share * size_px * size_px, max_pixels);
    for (std::size_t detail = 0; detail < detail_count; ++detail)
      qualities_[i][detail] = {pixels * pixel_ms[detail], worths[detail]};
    const int best = best_detail_for(reflectors[i]);
    wishes_.push_back({float(pixels * size_px), std::span(qualities_[i]).first(std::size_t(best) + 1),
                       std::min(details_[std::size_t(reflectors[i].object)], best)});
  }
  budget_.choose(wishes_);
  for (std::size_t i = 0; i < reflectors.size(); ++i)
    details_[std::size_t(reflectors[i].object)] = int(wishes_[i].level);
}

/// A window renews its maps a few faces per frame; a picture shows none that is out of date.
void MultipleEnvironmentMaps::forget_surroundings() {
  baked_.reset();
  if (prefers_rate_)
    renewal_.ask(maps_.places().size(), table_.drawn_layers());
  else
    table_.forget();
}

/// Forgets all maps, after a jump of the light: a few maps in the new light stand in for all until the others
/// are drawn.
void MultipleEnvironmentMaps::forget_light() {
  renewal_.ask(maps_.places().size(), {});
  table_.forget();
}

void MultipleEnvironmentMaps::begin_frame() {
  wanted_.clear();
  table_.begin_frame();
  renews_one_ = true;
}

/// The largest reflectors come first.
void MultipleEnvironmentMaps::find_missing_maps(const render::Renderer& renderer,
                                                const std::vector<methods::VisibleReflector>& reflectors) {
  if (table_.is_complete()) return;
  for (const methods::VisibleReflector& reflector : reflectors)
    for (const std::size_t map :
         table_.look_within(renderer.gpu().object_bounds()[std::size_t(reflector.object)]))
      if (std::ranges::find(wanted_, map) == wanted_.end()) wanted_.push_back(map);
}

/// Takes over what is baked of the maps that the frame lacks, before it looks into them.
void MultipleEnvironmentMaps::copy_baked() {
  if (wanted_.empty() || !baked_ || search_) return;
  const auto copied = std::erase_if(wanted_, [&](std::size_t map) {
    if (!table_.has_room() || unbaked_.contains(map)) return false;
    const auto kept = baked_map(*baked_, map, table_.places(), maps_.resolution());
    const std::optional<std::size_t> layer = kept ? table_.give_layer(map) : std::nullopt;
    if (!kept) unbaked_.insert(map);
    if (!layer) return false;
    maps_.move(*layer, table_.places()[map]);
    maps_.copy(*layer, *kept, 0);
    return true;
  });
  if (copied > 0) table_.upload();
}

/// Takes over the maps whose places were searched, as soon as these are found. True: it has.
bool MultipleEnvironmentMaps::take_places(const scene::Scene& scene) {
  if (!search_ || !search_->is_done()) return false;
  PlacedMaps placed = std::exchange(search_, nullptr)->take();
  Result<ReferenceMaps> maps = working_set(scene, placed.places);
  if (!maps) {
    fmt::print(stderr, "warning: {}; a few reference maps, evenly spread, stay\n",
               maps.errors().front().message);
    baked_.reset();
    return false;
  }
  maps_ = *std::move(maps);
  table_ = MapTable(std::move(placed.choice), std::move(placed.places), maps_.places().size());
  renewal_.ask(maps_.places().size(), {});
  wanted_.clear(), unbaked_.clear();
  return true;
}

/// Has the map that was drawn last written beside the scene.
void MultipleEnvironmentMaps::keep(const scene::Scene& scene, std::size_t map) {
  if (!prefers_rate_ || search_ || !baked_ || baked_->folder().empty()) return;
  if (!keeper_) {
    // The scene may have changed before its first frame, which notes changes from there on.
    if (MapCache(scene).folder() != baked_->folder()) {
      baked_.reset();
      return;
    }
    keeper_ = std::make_unique<MapKeeper>(*baked_);
  }
  unbaked_.erase(map);
  const ReferenceMaps& drawn = renewal_.drawn_last();
  keeper_->keep({table_.places(), std::uint32_t(map), std::uint32_t(drawn.resolution()), drawn.read(0)});
}

bool MultipleEnvironmentMaps::supply(render::Renderer& renderer, const scene::Scene& scene) {
  if (take_places(scene)) return true;
  const bool is_first = table_.drawn_layers().empty();
  std::size_t drawn = 0;
  for (const std::size_t map : wanted_) {
    const std::optional<std::size_t> layer = table_.give_layer(map);
    if (!layer) break;  // the frame looks into more maps than are held: others stand in
    maps_.move(*layer, table_.places()[map]);
    renderer.begin_still_frame(scene, camera_at(table_.places()[map]));
    renewal_.renew(renderer, maps_, *layer);
    keep(scene, map);
    ++drawn;
    if (prefers_rate_) break;
  }
  wanted_.clear();
  if (drawn == 0) return false;
  table_.upload();
  return is_first || !prefers_rate_;
}

/// Second rays smooth outlines: of what is small in the picture nobody sees it, and a frame that has to hold
/// a budget goes without them first. The largest reflectors come first.
std::span<const methods::VisibleReflector> MultipleEnvironmentMaps::with_smooth_outlines(
    const std::vector<methods::VisibleReflector>& reflectors) const {
  constexpr float min_size_px = 80.0f;
  if (budget_.budget_ms() > 0.0) return {};
  const auto small = std::ranges::find_if(
      reflectors, [](const methods::VisibleReflector& reflector) { return reflector.size_px < min_size_px; });
  return {reflectors.begin(), small};
}

void MultipleEnvironmentMaps::update_maps(render::Renderer& renderer, const scene::Scene& scene,
                                          const std::vector<methods::VisibleReflector>& reflectors) {
  prepared_.clear();
  if (light_jump_.has_come(renderer, scene)) forget_light();
  details_.resize(scene.objects.size(), all_detail);
  bodies_.follow_objects(scene);
  if (!reflectors.empty()) bodies_.update(scene, reflectors);
  find_missing_maps(renderer, reflectors);
  copy_baked();
  if (std::exchange(renews_one_, false))
    faces_drawn_ += renewal_.renew_faces(
        renderer, maps_, reflectors.empty() ? glm::vec3(0.0f) : reflectors.front().centre, faces_per_frame_);
  choose_details(renderer, reflectors);
  if (reflectors.empty()) return;
  picture_.draw_rays(renderer, with_smooth_outlines(reflectors));
  const gl::Program* current = nullptr;
  picture_.draw_light(renderer, reflectors,
                      [&](const methods::VisibleReflector& reflector) -> const gl::Program& {
                        const gl::Program& program = programs_[std::size_t(detail_of(reflector.object))];
                        if (current != &program) {
                          program.use();
                          prepare(program);
                          current = &program;
                        }
                        program.set("reflecting_object", reflector.object);
                        program.set("reflecting_body", bodies_.body_of(reflector.object));
                        return program;
                      });
}

void MultipleEnvironmentMaps::prepare(const gl::Program& program) const {
  bodies_.prepare(program, fields_unit);
  gl::bind_textures(program, {{"heights", heights_unit, heights_.name()},
                              {"map_colours", colours_unit, maps_.colours()},
                              {"map_glosses", glosses_unit, maps_.glosses()},
                              {"map_distances", distances_unit, maps_.distances()},
                              {"map_choice", choice_unit, table_.texture()},
                              {"map_places", places_unit, maps_.place_texture()}});
  layout_.bind(program, {.height_grid = glm::vec4(origin_, cell_m_, float(top_level_)),
                         .choice_grid = glm::vec4(table_.grid(), 0.0f),
                         .height_cells = glm::vec2(cells_),
                         .layer_size = glm::vec2(float(maps_.resolution()), float(ReferenceMaps::border))});
}

void MultipleEnvironmentMaps::bind(const gl::Program& program, int) {
  if (std::ranges::find(prepared_, program.name()) != prepared_.end()) return;
  picture_.bind(program, methods::first_method_unit);
  prepared_.push_back(program.name());
}

Result<std::unique_ptr<methods::Reflections>> make_multiple_environment_maps(
    const scene::Scene& scene, render::Renderer& renderer, std::unique_ptr<methods::Reflections>) {
  Result<std::unique_ptr<MultipleEnvironmentMaps>> made = MultipleEnvironmentMaps::create(scene, renderer);
  if (!made) return made.errors();
  return std::unique_ptr<methods::Reflections>(*std::move(made));
}

}  // namespace parvis::environment_rays
