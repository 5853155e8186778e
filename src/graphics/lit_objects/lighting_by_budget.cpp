// What the rays of a moment's budget are spent on.
#include <algorithm>
#include <utility>

#include "graphics/lit_objects/lighting_process.h"

namespace parvis::lit_objects {
namespace {

/// A nominal rate, so that pictures do not depend on the machine: two busy cores traced as many among 800,000
/// triangles, without bounces.
constexpr double rays_per_ms = 6'000.0;
/// A ray to the sun for four to the sky.
constexpr double rays_per_sky_ray = 1.25;
constexpr int rays_per_round = 16;
/// Of the places from which the sky is looked at once, for objects that have no time for rays.
constexpr float places_spacing_m = 1.0f, places_margin_m = 3.0f;
/// Of a budget; the rest is for rays to the sun.
constexpr double places_share = 0.5, min_places = 64.0, max_places = 1000.0;

constexpr double rays_per_place = 64.0;  ///< VisibilityPlaces::directions
/// In whose time a vertex is lit by a new sky as far as it needs no rays, and what it then takes of that of a
/// ray to the sky for each which brings the sun alone.
constexpr double rays_per_follow = 8.0, sun_share = 0.6;
/// That a vertex has in the frame of a new sky: two to the sun, three that bring what surfaces give back.
constexpr int quick_rays = 8;
/// Vertices of an object that judge guesses, and the rays of each; no more of a budget than a share.
constexpr std::size_t min_judges = 32, max_judges = 512;
constexpr int rays_per_judge = 16;
constexpr double judges_share = 0.1;

/// Rays: so many that no cost matters.
constexpr double unlimited = 1e300;

double cost(const VertexBlock& block, int rays) {
  const int by_sun_alone = std::clamp(block.light.sky_rays() - block.light.rays(), 0, rays);
  return rays_per_sky_ray * (double(rays - by_sun_alone) + sun_share * double(by_sun_alone)) *
         double(block.shown.size());
}

InterpolatedSky interpolated_sky(const VertexBlock& block, const light::VisibilityPlaces& places,
                                 const light::SkyTable& sky) {
  const std::vector<light::LitVertex>& vertices = block.light.vertices();
  return {light::interpolated_irradiance(vertices, places, sky, light::Blocked::bounces),
          light::open_sky_irradiance(vertices, sky, light::Blocked::bounces), places.uncertainty()};
}

}  // namespace

double LightingProcess::budget() const {
  return is_settling_ || budget_ms_ <= 0.0 ? unlimited : budget_ms_ * rays_per_ms;
}

double LightingProcess::cost_of_other_sky(std::size_t vertices) {
  return double(vertices) * (rays_per_follow + rays_per_sky_ray * sun_share * double(quick_rays));
}

void LightingProcess::light(const Changes& changes) {
  rays_left_ = budget();
  light_under_other_sky(changes.under_other_sky);
  light_quickly(changes.moved);
  refine();
}

/// What rays have found of the sky stays.
void LightingProcess::light_under_other_sky(const std::vector<LitObject*>& objects) {
  for (LitObject* lit : objects) {
    lit->follow_sky(*sky_);
    const light::OwnFaces* const own = own_faces(*lit);
    for (VertexBlock& block : lit->blocks()) {
      block.light.refine(*rays_, *sky_, quick_rays, light::Blocked::bounces, own);
      rays_left_ -= cost_of_other_sky(block.shown.size());
      block.show_light();
    }
  }
}

/// Of an object whose rays know what they hit of itself: it is set apart. Null where they do not.
const light::OwnFaces* LightingProcess::own_faces(LitObject& lit) {
  return rays_->set_apart(lit.object()) ? lit.faces(*rays_, *sky_) : nullptr;
}

/// Objects that have changed show light of their new place in this very frame.
void LightingProcess::light_quickly(const std::vector<LitObject*>& moved) {
  std::size_t vertices = 0;
  Bounds bounds;
  for (const LitObject* lit : moved) vertices += lit->vertex_count(), bounds.add(lit->bounds());
  if (vertices == 0 || rays_left_ >= unlimited) return;
  const light::RelightingPlan plan = light::plan_relighting(vertices, budget_ms_, rays_per_ms, true);
  if (plan.method == light::Relighting::interpolated) {
    const light::VisibilityPlaces& places = places_around(bounds);
    for (LitObject* lit : moved) guess_light(*lit, places, plan.rays);
    return;
  }
  for (LitObject* lit : moved)
    for (VertexBlock& block : lit->blocks())
      if (plan.method == light::Relighting::traced) {
        block.light.refine(*rays_, *sky_, plan.rays, light::Blocked::bounces, own_faces(*lit));
        rays_left_ -= cost(block, plan.rays);
        if (block.known) block.guess = block.known->traced;
        if (block.guess)
          block.show_light();
        else
          block.show(block.light.irradiance());
      } else {
        block.guess.reset();
        block.show(light::open_irradiance(block.light.vertices(), *sky_, light::Blocked::bounces));
      }
}

/// What rays found where the object stood says how it shades and lights itself, what places around see says
/// what has changed since, and rays of a few vertices judge how much of that is so. Each frame starts from
/// what all rays found, so that no error grows.
void LightingProcess::guess_light(LitObject& lit, const light::VisibilityPlaces& places, int sun_rays) {
  std::vector<Clues> clues;
  clues.reserve(lit.blocks().size());
  for (const VertexBlock& block : lit.blocks()) {
    clues.push_back({interpolated_sky(block, places, *sky_),
                     light::traced_sun(block.light.vertices(), *rays_, *sky_, sun_rays)});
    rays_left_ -= double(block.shown.size()) * (light::rays_per_interpolation + double(sun_rays));
  }
  const GuessWeights weights = weights_of(lit, clues);
  for (std::size_t b = 0; b < clues.size(); ++b) {
    VertexBlock& block = lit.blocks()[b];
    if (block.known)
      block.guess = guessed_light(*block.known, clues[b], weights);
    else
      block.guess = {std::move(clues[b].interpolated.irradiance), std::move(clues[b].sun)};
    block.show_light();
  }
}

GuessWeights LightingProcess::weights_of(const LitObject& lit, const std::vector<Clues>& clues) {
  const double affordable = judges_share * budget_ms_ * rays_per_ms / rays_per_sky_ray / rays_per_judge;
  const std::size_t judges = std::clamp(std::size_t(affordable), min_judges, max_judges);
  struct Place {
    std::size_t block, vertex;
  };
  std::vector<Place> places;
  std::vector<light::LitVertex> vertices;
  // An odd step, so that corners of triangles and quadrangles take turns.
  const std::size_t step = (lit.vertex_count() + judges - 1) / judges | 1;
  std::size_t number = 0;
  for (std::size_t b = 0; b < lit.blocks().size(); ++b) {
    const VertexBlock& block = lit.blocks()[b];
    for (std::size_t v = 0; v < block.shown.size(); ++v, ++number) {
      if (number % step != 0 || !block.known) continue;
      places.push_back({b, v});
      vertices.push_back(block.light.vertices()[v]);
    }
  }
  light::VertexLight judge(std::move(vertices));
  judge.refine(*rays_, *sky_, rays_per_judge, light::Blocked::bounces);
  rays_left_ -= rays_per_sky_ray * double(rays_per_judge) * double(places.size());
  const std::vector<glm::vec3> sky = judge.sky_irradiance(), sun = judge.sun_irradiance();
  GuessJudge guesses;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& known = lit.blocks()[places[i].block].known;
    if (known) guesses.add(*known, clues[places[i].block], places[i].vertex, sky[i], sun[i]);
  }
  return guesses.weights();
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
  rays_left_ -= rays_per_place * double(places_->size());
  for (std::size_t i = 0; i < lit_.size(); ++i)
    casters_.objects[std::size_t(lit_[i].object())].is_visible = was_visible[i];
  rays_->update(casters_);
  return *places_;
}

/// Rounds of rays for the vertices that have had the fewest.
void LightingProcess::refine() {
  struct Unfinished {
    LitObject* object;
    VertexBlock* block;
  };
  std::vector<Unfinished> blocks;
  for (LitObject& lit : lit_)
    if (casters_.objects[std::size_t(lit.object())].is_visible)
      for (VertexBlock& block : lit.blocks())
        if (!block.is_finished()) blocks.push_back({&lit, &block});
  const auto fewest = [](const Unfinished& it) { return it.block->light.rays(); };
  std::vector<VertexBlock*> lit;
  while (rays_left_ > 0.0 && !blocks.empty()) {
    const auto next = std::ranges::min_element(blocks, {}, fewest);
    VertexBlock& block = *next->block;
    const int round = rays_left_ >= unlimited ? block.rays_wanted - block.light.rays() : rays_per_round;
    rays_left_ -= cost(block, round);
    block.light.refine(*rays_, *sky_, (round + 3) / 4 * 4, light::Blocked::bounces, own_faces(*next->object));
    if (std::ranges::find(lit, &block) == lit.end()) lit.push_back(&block);
    if (block.is_finished()) blocks.erase(next);
  }
  for (LitObject& object : lit_)
    for (VertexBlock& block : object.blocks()) {
      if (std::ranges::find(lit, &block) == lit.end()) continue;
      block.show_light();
      if (block.is_finished()) remember(block, object);
    }
}

/// For the guesses of where the object moves to.
void LightingProcess::remember(VertexBlock& block, const LitObject& object) {
  block.known = {{block.light.sky_irradiance(), block.light.sun_irradiance()}, {}};
  if (casters_.objects[std::size_t(object.object())].is_dynamic)
    block.known->interpolated = interpolated_sky(block, places_around(object.bounds()), *sky_);
}

}  // namespace parvis::lit_objects
