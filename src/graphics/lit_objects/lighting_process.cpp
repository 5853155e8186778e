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
/// Fewer rays look spotted.
constexpr int rays_per_round = 16;
/// Cost of summing the open directions of a vertex under a new sky, in rays; and cost of a ray then, relative
/// to one that is asked for all that it finds.
constexpr double rays_per_follow = 8.0, cost_without_sky = 0.6;
/// Rays: so many that no cost matters.
constexpr double unlimited = 1e300;

double cost(const VertexBlock& block, int rays) {
  const int known = std::clamp(block.light.sky_rays() - block.light.rays(), 0, rays);
  return rays_per_sky_ray * (double(rays - known) + cost_without_sky * double(known)) *
         double(block.shown.size());
}

/// Lit nodes, in the order of the script.
void find_lit_nodes(const scene::Nodes& nodes, std::vector<const scene::Node*>& found) {
  for (const scene::Node& node : nodes)
    if (node.schema->type == lit_type)
      found.push_back(&node);
    else
      find_lit_nodes(node.children, found);
}

/// A flat thing shades what lies as far before it as it is wide.
bool is_near(const Bounds& bounds, const Bounds& other) {
  const glm::vec3 size = bounds.size();
  const float reach = std::max({size.x, size.y, size.z, 1.0f});
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

/// Nodes have come or gone, or objects.
void LightingProcess::follow_nodes(scene::Scene& scene) {
  if (edits_ == live_->edits() && object_count_ == scene.objects.size()) return;
  find_objects(scene);
  rays_.reset();
}

/// Finds the objects that are not lit yet.
void LightingProcess::find_objects(scene::Scene& scene) {
  const bool begins = std::exchange(edits_, live_->edits()) < 0;
  object_count_ = scene.objects.size();
  std::vector<const scene::Node*> nodes;
  find_lit_nodes(live_->nodes(), nodes);
  auto& irradiance = scene.data<scene::VertexIrradiance>();
  for (const scene::Node* node : nodes) {
    const std::vector<int> objects = live_->objects_of(*node);
    if (objects.empty() && begins)
      warn(error_at(node->where, "{} holds no object that could be lit", lit_type));
    for (const int object : objects) {
      if (irradiance.of(std::size_t(object))) continue;
      texels_ += LitObject::texel_count(scene.objects[std::size_t(object)]);
      if (texels_ > scene::max_lit_texels) {
        warn(error_at(node->where,
                      "\"{}\" and what follows it in {} are lit like other objects: light is kept for {} "
                      "vertices at most",
                      scene.objects[std::size_t(object)].name, lit_type, scene::max_lit_texels));
        break;
      }
      std::vector<std::string> odd;
      lit_.emplace_back(scene, object, odd);
      lit_nodes_.push_back(node);
      was_visible_.push_back(scene.objects[std::size_t(object)].is_visible);
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
}

/// True where static things have changed. Lit objects are put where they are.
bool LightingProcess::follow_casters(const scene::Scene& scene) {
  if (!rays_ || casters_.objects.size() != scene.objects.size()) return make_casters(scene), true;
  std::vector<Standing> standing = standing_in(scene);
  const bool is_other = standing != standing_;
  standing_ = std::move(standing);
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
  SkySource source{scene.sky.version, scene.sky.intensity, scene.sky.heading, scene::sun_light(scene)};
  if (sky_source_ == source) return false;
  sky_source_ = std::move(source);
  sky_ = std::make_unique<light::SkyTable>(scene);
  return true;
}

void LightingProcess::present(scene::Scene& scene, double /*ahead_s*/) {
  follow_nodes(scene);
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
  ++moment_;
  rays_left_ = is_settling_ || budget_ms_ <= 0.0 ? unlimited : budget_ms_ * rays_per_ms;
  follow_changes(scene, is_new_place, is_new_sky);
  refine();
  auto& irradiance = scene.data<scene::VertexIrradiance>();
  for (LitObject& lit : lit_)
    if (lit.take_news()) irradiance.objects[std::size_t(lit.object())] = lit.light();
}

/// Restarts what has moved or stands near something that has, hidden objects, too: they may come back. The
/// others follow the sky.
void LightingProcess::follow_changes(const scene::Scene& scene, bool is_new_place, bool is_new_sky) {
  struct Disturbance {
    const LitObject* cause;
    Bounds where;
  };
  std::vector<Disturbance> disturbances;
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    LitObject& lit = lit_[i];
    const bool is_visible = scene.objects[std::size_t(lit.object())].is_visible,
               was_visible = was_visible_[i];
    was_visible_[i] = is_visible;
    const Bounds before = lit.bounds();
    const bool has_moved = is_visible && lit.follow(scene);
    if (was_visible && (has_moved || !is_visible)) disturbances.push_back({&lit, before});
    if (is_visible && (has_moved || !was_visible)) disturbances.push_back({&lit, lit.bounds()});
  }
  for (LitObject& lit : lit_) {
    const bool is_shaded = std::ranges::any_of(disturbances, [&](const Disturbance& disturbance) {
      return disturbance.cause != &lit && is_near(disturbance.where, lit.bounds());
    });
    if (is_new_place || is_shaded) {
      lit.restart();
    } else if (is_new_sky) {
      lit.follow_sky(*sky_);
      rays_left_ -= rays_per_follow * double(lit.vertex_count());
    }
  }
}

/// Rounds of rays for the vertices that have had the fewest, among them for those whose light is the oldest:
/// while a large object is dragged, each of its blocks has its turn. At least one round, and one for
/// each that has never been lit, whatever the budget.
void LightingProcess::refine() {
  std::vector<VertexBlock*> blocks, lit;
  for (LitObject& object : lit_)
    if (casters_.objects[std::size_t(object.object())].is_visible)
      for (VertexBlock& block : object.blocks())
        if (!block.is_finished()) blocks.push_back(&block);
  while (!blocks.empty()) {
    const auto next = std::ranges::min_element(
        blocks, {}, [](const VertexBlock* block) { return std::pair(block->light.rays(), block->shown_at); });
    VertexBlock& block = **next;
    const bool is_black = block.shown_at < 0 && block.light.rays() == 0;
    if (rays_left_ <= 0.0 && !is_black && !lit.empty()) break;
    const int round = rays_left_ >= unlimited ? block.rays_wanted - block.light.rays() : rays_per_round;
    rays_left_ -= cost(block, round);
    block.light.refine(*rays_, *sky_, (round + 3) / 4 * 4, light::Blocked::bounces);
    if (std::ranges::find(lit, &block) == lit.end()) lit.push_back(&block);
    if (block.is_finished()) blocks.erase(next);
  }
  for (VertexBlock* block : lit) block->show_light(moment_);
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
