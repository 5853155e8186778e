// After the thesis's xpLitVirtualObject and pfGroupVirtualObjs (appendix A.2.2): transforms are compared with
// stored ones, and what moved is lit again. Departures: light is refined from frame to frame, neighbours of
// what moved and all objects under a new sky are lit again, too, and rays that hit a surface bring the light
// that it gives back, where the thesis's sum has visibility alone.
#include "graphics/lit_objects/lighting_process.h"

#include <algorithm>
#include <utility>

namespace parvis::lit_objects {
namespace {

/// A nominal rate, so that pictures do not depend on the machine: two busy cores traced as many among 800,000
/// triangles, without bounces.
constexpr double rays_per_ms = 6'000.0;
/// A ray to the sun for four to the sky.
constexpr double rays_per_sky_ray = 1.25;
/// Fewer new rays than these are not shown in place of many old ones.
constexpr int min_shown_rays = 64;
constexpr int rays_per_round = 16;
/// Of the places from which the sky is looked at once, for objects that have no time for rays.
constexpr float places_spacing_m = 1.0f, places_margin_m = 3.0f;
/// Of a budget; the rest is for rays to the sun.
constexpr double places_share = 0.5, min_places = 64.0, max_places = 1000.0;

constexpr double rays_per_place = 64.0;  ///< VisibilityPlaces::directions

/// Of the sky's light from one place to the next: where it is more there was next to none, which says
/// nothing.
constexpr float max_change = 10.0f;

double cost(const VertexBlock& block, int rays) {
  return rays_per_sky_ray * double(rays) * double(block.shown.size());
}

/// Lit nodes, in the order of the script.
void find_lit_nodes(const std::vector<scene::Node>& nodes, std::vector<const scene::Node*>& found) {
  for (const scene::Node& node : nodes)
    if (node.schema->type == lit_type)
      found.push_back(&node);
    else
      find_lit_nodes(node.children, found);
}

bool is_near(const Bounds& bounds, const Bounds& other) {
  const glm::vec3 reach = glm::max(bounds.size(), glm::vec3(1.0f));
  return glm::all(glm::lessThan(bounds.min - reach, other.max)) &&
         glm::all(glm::lessThan(other.min, bounds.max + reach));
}

}  // namespace

void LightingProcess::begin(scene::Scene& scene, action::SharedByProcesses& shared) {
  live_ = &shared.live;
  find_objects(scene);
  settle(scene);
}

void LightingProcess::settle(scene::Scene& scene) {
  is_settling_ = true;
  present(scene, 0.0);
  is_settling_ = false;
}

void LightingProcess::find_objects(scene::Scene& scene) {
  std::vector<const scene::Node*> nodes;
  find_lit_nodes(live_->nodes(), nodes);
  auto& irradiance = scene.data<scene::VertexIrradiance>();
  std::size_t texels = 0;
  for (const scene::Node* node : nodes) {
    const std::vector<int> objects = live_->objects_of(*node);
    if (objects.empty()) warn(error_at(node->where, "{} holds no object that could be lit", lit_type));
    for (const int object : objects) {
      texels += LitObject::texel_count(scene.objects[std::size_t(object)]);
      if (texels > scene::max_lit_texels) {
        warn(error_at(node->where,
                      "\"{}\" and what follows it in {} are lit like other objects: light is kept for {} "
                      "vertices at most",
                      scene.objects[std::size_t(object)].name, lit_type, scene::max_lit_texels));
        break;
      }
      std::vector<std::string> odd;
      lit_.emplace_back(scene, object, odd);
      lit_nodes_.push_back(node);
      for (const std::string& sentence : odd) warn(error_at(node->where, "{}", sentence));
      irradiance.objects.resize(scene.objects.size());
      irradiance.objects[std::size_t(object)] = lit_.back().light();
    }
  }
}

std::vector<LightingProcess::Standing> LightingProcess::standing_in(const scene::Scene& scene) const {
  std::vector<Standing> standing;
  standing.reserve(scene.objects.size());
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    if (!object.is_dynamic) standing.push_back({object.world_from_model, object.is_visible});
  }
  return standing;
}

void LightingProcess::make_casters(const scene::Scene& scene) {
  rays_.reset();
  casters_ = scene;
  casters_.sky.picture = {};
  is_lit_.assign(scene.objects.size(), false);
  for (const LitObject& lit : lit_) is_lit_[std::size_t(lit.object())] = true;
  for (std::size_t o = 0; o < casters_.objects.size(); ++o)
    if (casters_.objects[o].is_dynamic && !is_lit_[o]) casters_.objects[o].is_visible = false;
  rays_ = std::make_unique<reference::RayScene>(casters_);
  standing_ = standing_in(scene);
  places_.reset();
}

/// True where static things have changed. Lit objects are put where they are.
bool LightingProcess::follow_casters(const scene::Scene& scene) {
  if (!rays_ || casters_.objects.size() != scene.objects.size()) return make_casters(scene), true;
  std::vector<Standing> standing = standing_in(scene);
  const bool is_other = standing != standing_;
  standing_ = std::move(standing);
  if (is_other) places_.reset();
  bool has_moved = is_other;
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Object& from = scene.objects[o];
    if (from.is_dynamic && !is_lit_[o]) continue;
    scene::Object& to = casters_.objects[o];
    if (to.world_from_model == from.world_from_model && to.is_visible == from.is_visible &&
        to.pose == from.pose && from.deformed_meshes.empty())
      continue;
    to.world_from_model = from.world_from_model, to.pose = from.pose, to.is_visible = from.is_visible;
    for (std::size_t p = 0; p < from.deformed_meshes.size(); ++p)
      to.deformed_meshes[p].positions = from.deformed_meshes[p].positions;
    has_moved = true;
  }
  if (has_moved) rays_->update(casters_);
  return is_other;
}

bool LightingProcess::follow_sky(const scene::Scene& scene) {
  SkySource source{scene.sky.file, scene.sky.version, scene.sky.intensity, scene.sky.heading,
                   scene::sun_light(scene)};
  if (sky_source_ == source) return false;
  sky_source_ = std::move(source);
  sky_ = std::make_unique<light::SkyTable>(scene);
  return true;
}

void LightingProcess::present(scene::Scene& scene, double /*ahead_s*/) {
  if (lit_.empty()) return;
  std::vector<const scene::Node*> nodes;
  find_lit_nodes(live_->nodes(), nodes);
  budget_ms_ = 0.0;
  bool has_unhurried = false;
  for (const scene::Node* node : nodes) {
    budget_ms_ = std::max(budget_ms_, node->number("budget_ms"));
    has_unhurried = has_unhurried || node->number("budget_ms") <= 0.0;
  }
  if (has_unhurried) budget_ms_ = 0.0;  // a frame that waits for one waits for all
  for (std::size_t i = 0; i < lit_.size(); ++i)
    for (VertexBlock& block : lit_[i].blocks()) block.rays_wanted = int(lit_nodes_[i]->integer("rays"));
  const bool is_new_place = follow_casters(scene), is_new_sky = follow_sky(scene);
  std::vector<LitObject*> changed;
  for (LitObject& lit : lit_) {
    if (is_new_place || is_new_sky) lit.restart();  // hidden ones, too: they may come back
    if (!scene.objects[std::size_t(lit.object())].is_visible) continue;
    const bool has_moved = lit.follow(scene);
    if (has_moved || is_new_place || is_new_sky || !lit.has_light()) changed.push_back(&lit);
  }
  relight(scene, changed);
}

void LightingProcess::relight(scene::Scene& scene, const std::vector<LitObject*>& changed) {
  for (LitObject& lit : lit_) {
    const bool is_neighbour = std::ranges::any_of(
        changed, [&](const LitObject* other) { return is_near(other->bounds(), lit.bounds()); });
    if (is_neighbour && std::ranges::find(changed, &lit) == changed.end()) lit.restart();
  }
  const bool has_time = is_settling_ || budget_ms_ <= 0.0;
  double rays_left = has_time ? 1e300 : budget_ms_ * rays_per_ms;
  if (!has_time) light_quickly(changed, rays_left);
  refine(rays_left);
  auto& irradiance = scene.data<scene::VertexIrradiance>();
  for (LitObject& lit : lit_)
    if (lit.take_news()) irradiance.objects[std::size_t(lit.object())] = lit.light();
}

/// Objects that have changed show light of their new place in this very frame.
void LightingProcess::light_quickly(const std::vector<LitObject*>& changed, double& rays_left) {
  std::size_t vertices = 0;
  Bounds bounds;
  for (const LitObject* lit : changed) vertices += lit->vertex_count(), bounds.add(lit->bounds());
  if (vertices == 0) return;
  const light::RelightingPlan plan = light::plan_relighting(vertices, budget_ms_, rays_per_ms, true);
  const light::VisibilityPlaces* places =
      plan.method == light::Relighting::interpolated ? &places_around(bounds) : nullptr;
  if (places) rays_left -= rays_per_place * double(places->size());
  for (LitObject* lit : changed)
    for (VertexBlock& block : lit->blocks()) {
      switch (plan.method) {
        case light::Relighting::traced:
          block.light.refine(*rays_, *sky_, plan.rays, light::Blocked::bounces);
          block.show(block.light.irradiance());
          rays_left -= cost(block, plan.rays);
          break;
        case light::Relighting::interpolated:
          show_interpolated(block, *places);
          rays_left -= cost(block, 2);
          break;
        case light::Relighting::open:
          block.show(light::open_irradiance(block.light.vertices(), *sky_, light::Blocked::bounces));
          break;
      }
    }
}

light::InterpolatedLight LightingProcess::interpolated(const VertexBlock& block,
                                                       const light::VisibilityPlaces& places) const {
  return light::interpolated_irradiance(block.light.vertices(), places, *rays_, *sky_,
                                        light::Blocked::bounces);
}

/// What rays have found beside the sun stays, and with it how the object shades and lights itself: it grows
/// and falls as the sky does that is interpolated. Each frame starts from what was traced, so that no error
/// grows.
void LightingProcess::show_interpolated(VertexBlock& block, const light::VisibilityPlaces& places) const {
  light::InterpolatedLight now = interpolated(block, places);
  std::vector<glm::vec3> shown = std::move(now.sun);
  for (std::size_t v = 0; v < shown.size(); ++v) {
    glm::vec3 sky = now.sky[v];
    if (block.reference) {
      const glm::vec3 change = sky / glm::max(block.reference->interpolated[v], 1e-6f);
      if (glm::all(glm::lessThan(change, glm::vec3(max_change)))) sky = change * block.reference->traced[v];
    }
    shown[v] += sky;
  }
  block.show(std::move(shown));
}

/// What static things leave of the sky about dynamic objects: lit ones are taken out of the way meanwhile.
const light::VisibilityPlaces& LightingProcess::places_around(const Bounds& bounds) {
  const glm::vec3 enough =
      2.0f * (bounds.size() + 2.0f * places_margin_m);  // in a larger region they lie apart
  const bool fits = places_ && glm::all(glm::lessThanEqual(places_region_.min, bounds.min)) &&
                    glm::all(glm::greaterThanEqual(places_region_.max, bounds.max)) &&
                    glm::all(glm::lessThanEqual(places_region_.size(), enough));
  if (fits) return *places_;
  std::vector<bool> was_visible;
  was_visible.reserve(lit_.size());
  for (const LitObject& lit : lit_)
    was_visible.push_back(std::exchange(casters_.objects[std::size_t(lit.object())].is_visible, false));
  rays_->update(casters_);
  places_region_ = {bounds.min - places_margin_m, bounds.max + places_margin_m};
  const double affordable =
      budget_ms_ > 0.0 ? places_share * budget_ms_ * rays_per_ms / rays_per_place : max_places;
  places_.emplace(*rays_, places_region_, places_spacing_m,
                  std::size_t(std::clamp(affordable, min_places, max_places)));
  for (std::size_t i = 0; i < lit_.size(); ++i)
    casters_.objects[std::size_t(lit_[i].object())].is_visible = was_visible[i];
  rays_->update(casters_);
  return *places_;
}

/// Rounds of rays for the vertices that have had the fewest.
void LightingProcess::refine(double rays_left) {
  std::vector<VertexBlock*> blocks;
  for (LitObject& lit : lit_)
    if (casters_.objects[std::size_t(lit.object())].is_visible)
      for (VertexBlock& block : lit.blocks())
        if (block.light.rays() < block.rays_wanted) blocks.push_back(&block);
  const auto fewest = [](const VertexBlock* block) { return block->light.rays(); };
  std::vector<VertexBlock*> lit;
  while (rays_left > 0.0 && !blocks.empty()) {
    const auto next = std::ranges::min_element(blocks, {}, fewest);
    VertexBlock& block = **next;
    const int round = rays_left > 1e200 ? block.rays_wanted - block.light.rays() : rays_per_round;
    block.light.refine(*rays_, *sky_, (round + 3) / 4 * 4, light::Blocked::bounces);
    rays_left -= cost(block, round);
    if (std::ranges::find(lit, &block) == lit.end()) lit.push_back(&block);
    if (block.light.rays() >= block.rays_wanted) blocks.erase(next);
  }
  for (LitObject& object : lit_)
    for (VertexBlock& block : object.blocks()) {
      if (std::ranges::find(lit, &block) == lit.end()) continue;
      if (block.light.rays() < std::min(min_shown_rays, block.rays_wanted)) continue;
      block.show(block.light.irradiance());
      if (block.light.rays() >= block.rays_wanted)
        block.reference = {block.light.sky_irradiance(),
                           interpolated(block, places_around(object.bounds())).sky};
    }
}

int LightingProcess::rays() const {
  int rays = 0;
  bool is_any = false;
  for (const LitObject& lit : lit_)
    for (const VertexBlock& block : lit.blocks())
      rays = is_any ? std::min(rays, block.light.rays()) : block.light.rays(), is_any = true;
  return rays;
}

}  // namespace parvis::lit_objects
