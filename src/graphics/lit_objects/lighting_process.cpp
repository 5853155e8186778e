// After the thesis's xpLitVirtualObject and pfGroupVirtualObjs (appendix A.2.2): transforms are compared with
// stored ones, and what moved is lit again. Departures: light is refined from frame to frame, neighbours of
// what moved and all objects under a new sky are lit again, too, and rays that hit a surface bring the light
// that it gives back, where the thesis's sum has visibility alone.
#include "graphics/lit_objects/lighting_process.h"

#include <algorithm>
#include <utility>

namespace parvis::lit_objects {
namespace {

bool can_follow_sky(const LitObject& lit) {
  return std::ranges::all_of(lit.blocks(), &VertexBlock::can_follow_sky);
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

/// Of those that are not lit yet.
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
  const Changes changes = changes_in(scene, is_new_place, is_new_sky);
  light(changes);
  auto& irradiance = scene.data<scene::VertexIrradiance>();
  for (LitObject& lit : lit_)
    if (lit.take_news()) irradiance.objects[std::size_t(lit.object())] = lit.light();
}

/// Restarts what has changed, hidden objects, too: they may come back.
LightingProcess::Changes LightingProcess::changes_in(const scene::Scene& scene, bool is_new_place,
                                                     bool is_new_sky) {
  struct Disturbance {
    const LitObject* cause;
    Bounds where;
  };
  Changes changes;
  std::vector<LitObject*> others;
  std::vector<Disturbance> disturbances;
  for (std::size_t i = 0; i < lit_.size(); ++i) {
    LitObject& lit = lit_[i];
    const bool is_visible = scene.objects[std::size_t(lit.object())].is_visible,
               was_visible = was_visible_[i];
    was_visible_[i] = is_visible;
    if (is_new_place) lit.restart();
    const Bounds before = lit.bounds();
    if (was_visible && !is_visible) disturbances.push_back({&lit, before});
    if (!is_visible) {
      if (is_new_sky) lit.restart();
      others.push_back(&lit);
      continue;
    }
    const bool has_moved = lit.follow(scene), appears = !was_visible;
    if (has_moved && was_visible) disturbances.push_back({&lit, before});
    if (has_moved || appears) disturbances.push_back({&lit, lit.bounds()});
    const bool is_unlit = !lit.has_light() || (appears && !lit.is_finished());
    (has_moved || is_new_place || is_unlit ? changes.moved : others).push_back(&lit);
  }
  for (LitObject* lit : others) {
    const bool is_visible = scene.objects[std::size_t(lit->object())].is_visible;
    const bool is_shaded = std::ranges::any_of(disturbances, [&](const Disturbance& disturbance) {
      return disturbance.cause != lit && is_near(disturbance.where, lit->bounds());
    });
    if (is_shaded) lit->restart();
    if (is_visible && is_new_sky)
      (is_shaded || !can_follow_sky(*lit) ? changes.moved : changes.under_other_sky).push_back(lit);
  }
  double follow_cost = 0.0;
  for (const LitObject* lit : changes.under_other_sky) follow_cost += cost_of_other_sky(lit->vertex_count());
  if (follow_cost > budget())
    changes.moved.insert(changes.moved.end(), changes.under_other_sky.begin(), changes.under_other_sky.end()),
        changes.under_other_sky.clear();
  if (is_new_sky)
    for (LitObject* lit : changes.moved) lit->restart();
  return changes;
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
