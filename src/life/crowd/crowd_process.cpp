#include "life/crowd/crowd_process.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/data/object_animation.h"

namespace parvis::crowd {
namespace {

constexpr int clock_steps = 6;  // of action::step_s, for one step of the crowd
constexpr float crowd_step_s = float(double(clock_steps) * action::step_s);
constexpr int destinations = 64;       // places that people walk between
constexpr int tries_per_person = 12;   // to find a place from which a way leads on
constexpr int tries_for_place = 1000;  // within the radius
constexpr int warm_up_steps = 200;     // all start at rest
constexpr int flow_warm_up_steps = 900;
constexpr float mean_speed = 1.34f, speed_deviation = 0.26f, min_speed = 0.6f,
                max_speed = 2.0f;  // Weidmann 1993
constexpr float longest_rest_s = 12.0f,
                resting = 0.35f;           // the fraction of arrivals after which somebody rests
constexpr float max_people_per_m2 = 1.0f;  // Weidmann: beyond it nobody walks as they like
// Within which a walker may come onto ground that a tram covers; who was pushed over its edge so far waits,
// too.
constexpr float carried_s = 1.0f, pushed_m = 0.3f;
constexpr float pushed_on_s = 0.6f;  // within which others may push somebody onto a crossing
constexpr float seen_from_m = 2.0f, step_ahead_m = 0.9f;  // of crossings, before their edge
constexpr float corners_reach = 1.12f;  // of half a vehicle's width, from half of that before its ends
constexpr float vehicle_height_m = 2.5f;
// People on pavements who walk in groups, and of these groups those of two: the others are of three (Moussaid
// et al. 2010 count 55 % to 70 % in groups, by place and day).
constexpr float in_groups = 0.55f, of_two = 0.75f, beside_leader_m = 0.8f;
constexpr float turn_rate = 5.0f;  // radians per second
constexpr float shoulders_m = 0.21f, shoulder_range_m = 0.03f;

/// A normal deviate by twelve uniform ones: bounded, and the same on every machine.
float normal(Random& random) {
  float sum = -6.0f;
  for (int i = 0; i < 12; ++i) sum += random.uniform();
  return sum;
}

/// The strips beside the lanes of a part of the place.
class Pavements {
 public:
  Pavements(const scene::RoadGraph& roads, glm::vec2 centre, float radius_m) {
    for (const scene::Lane& lane : roads.lanes)
      for (std::size_t i = 0; i + 1 < lane.points.size(); ++i) {
        // Long streets in pieces: a part of each may be within the radius.
        const glm::vec3 a = lane.points[i], b = lane.points[i + 1];
        const int pieces = std::clamp(int(glm::distance(a, b) / piece_m), 1, max_pieces);
        for (int k = 0; k < pieces; ++k) {
          const Piece piece{glm::mix(a, b, float(k) / float(pieces)),
                            glm::mix(a, b, float(k + 1) / float(pieces)), lane.width_m};
          if (glm::distance(0.5f * glm::vec2(piece.a + piece.b), centre) < radius_m &&
              glm::distance(piece.a, piece.b) > 0.1f)
            pieces_.push_back(piece);
        }
      }
  }

  bool empty() const { return pieces_.empty(); }
  /// Some place that may be on a pavement.
  glm::vec3 place(Random& random) const {
    const Piece& piece = pieces_[std::size_t(random.index(int(pieces_.size())))];
    const glm::vec3 along = glm::normalize(piece.b - piece.a), left(-along.y, along.x, 0.0f);
    const float away =
        (0.5f * piece.width_m + random.uniform(nearest_m, farthest_m)) * (random.chance(0.5f) ? 1.0f : -1.0f);
    return glm::mix(piece.a, piece.b, random.uniform()) + away * left;
  }
  bool is_on_lane(glm::vec3 p) const {
    return std::ranges::any_of(pieces_, [&](const Piece& piece) {
      return glm::distance(nearest_on_segment(glm::vec2(piece.a), glm::vec2(piece.b), glm::vec2(p)),
                           glm::vec2(p)) < 0.5f * piece.width_m + 0.15f;
    });
  }

 private:
  static constexpr float piece_m = 8.0f, nearest_m = 0.5f, farthest_m = 5.5f;
  static constexpr int max_pieces = 500;
  struct Piece {
    glm::vec3 a, b;
    float width_m;
  };
  std::vector<Piece> pieces_;
};

float wrapped(float angle) { return std::remainder(angle, 2.0f * std::numbers::pi_v<float>); }

}  // namespace

int CrowdProcess::new_destination(Random& random) { return random.index(destinations); }

void CrowdProcess::populate(const CrowdDemand& demand, const scene::RoadGraph& roads) {
  Random places(demand.seed);
  const Pavements pavements(roads, demand.centre, demand.radius_m);
  // Triangles of wide ground reach beyond the part that was asked for.
  const auto somewhere = [&] {
    glm::vec3 place(0.0f);
    for (int t = 0; t < tries_for_place && !pavements.empty(); ++t)
      if (const std::optional<glm::vec3> beside = crowd_->mesh().nearest(pavements.place(places), 0.6f);
          beside && !pavements.is_on_lane(*beside))
        return *beside;
    for (int t = 0; t < tries_for_place; ++t) {
      place = crowd_->mesh().place(places.uniform(), places.uniform(), places.uniform());
      if (glm::distance(glm::vec2(place), demand.centre) < demand.radius_m) break;
    }
    return place;
  };
  for (int d = 0; d < destinations; ++d) {
    const glm::vec3 place = somewhere();
    crowd_->add(Destination{place, place, 0.8f});
  }
  add_flows(demand);
  if (stops_ && demand.flows.empty()) passengers_.emplace(stops_, *crowd_, demand.centre, demand.radius_m);
  if (passengers_ && passengers_->empty()) passengers_.reset();
  int missing = 0, still_to_join = 0, leader = -1;
  Random groups(demand.seed, 0x67726f75u);
  for (int p = 0; p < demand.people; ++p) {
    Random random(demand.seed, std::uint64_t(p) + 1);
    float speed = std::clamp(mean_speed + speed_deviation * normal(random), min_speed, max_speed);
    if (generated_) speed = generated_->speed(std::size_t(p), speed);
    const float radius = shoulders_m + shoulder_range_m * random.uniform(-1.0f, 1.0f);
    std::optional<std::size_t> person;
    const bool joins = still_to_join > 0 && leader >= 0;
    if (joins) {
      const auto at = std::size_t(leader);
      const PersonOnTheWay& other = crowd_->people()[at];
      const glm::vec3 beside(crowd_->walkers().position[at] + glm::vec2(0.0f, beside_leader_m),
                             crowd_->walkers().height_m[at]);
      person = crowd_->add(beside, other.destination, other.own_speed, radius);
    }
    const bool is_beside = person.has_value();
    for (int t = 0; t < tries_per_person && !person; ++t)
      person = crowd_->add(somewhere(), new_destination(random), speed, radius);
    if (!person) {
      ++missing;
      continue;
    }
    Shown shown;
    if (!generated_) {
      shown.model = &models_[std::size_t(random.index(int(models_.size())))];
      shown.walked_m = random.uniform(0.0f, shown.model->cycle_m);
    }
    shown.heading = random.uniform(-3.0f, 3.0f);
    if (passengers_) passengers_->add(*crowd_, random);
    const bool is_here = !crowd_->people().back().is_away && demand.flows.empty();
    if (is_beside && is_here) {
      crowd_->accompany(*person, std::size_t(leader));
      leaders_.push_back(leader), leaders_[std::size_t(leader)] = leader;
      --still_to_join;
    } else {
      leaders_.push_back(-1);
      // Of a person who sets off alone, how likely it is that they lead a group.
      constexpr float mean_size = of_two * 2.0f + (1.0f - of_two) * 3.0f;
      constexpr float leading = in_groups / mean_size / (in_groups / mean_size + 1.0f - in_groups);
      still_to_join = is_here && groups.chance(leading) ? (groups.chance(of_two) ? 1 : 2) : 0;
      leader = int(*person);
    }
    if (!demand.flows.empty()) crowd_->set_away(shown_.size(), true);
    shown_.push_back(shown), randoms_.push_back(random);
  }
  if (missing > 0)
    warn(
        error("crowd: {} of {} people found no place from which a way leads on; a larger radius, or another "
              "centre, "
              "gives more",
              missing, demand.people));
}

void CrowdProcess::begin(scene::Scene& scene, action::SharedByProcesses&) {
  CrowdDemand demand = std::as_const(scene).data<CrowdDemand>();
  if (demand.people <= 0) return;
  const WalkingGround ground = ground_of(scene, demand.centre, demand.radius_m);
  Result<NavMesh> mesh = NavMesh::create(ground);
  if (!mesh) {
    for (const Error& reason : mesh.errors()) warn(error("crowd: {}", reason.message));
    return;
  }
  const float area_m2 =
      std::min(mesh->area_m2(), std::numbers::pi_v<float> * demand.radius_m * demand.radius_m);
  if (const int room = std::max(1, int(max_people_per_m2 * area_m2)); demand.people > room) {
    warn(error(
        "crowd: {} people on {:.0f} m2 of walkable ground: expected at most {}, who walk; a larger radius "
        "gives room to more",
        demand.people, area_m2, room));
    demand.people = room;
  }
  heights_ = GroundHeights(ground);
  streets_ = std::as_const(scene).data<scene::SharedStreets>().now;
  if (streets_) streets_->has_people = true;
  stops_ = std::as_const(scene).data<scene::SharedStops>().now;
  models_ = demand.models;
  crowd_.emplace(*std::move(mesh));
  is_visible_ = demand.is_visible;
  if (models_.empty()) generated_.emplace(std::size_t(demand.people), demand.seed);
  watch_.changes(scene);
  populate(demand, scene.roads);
  add_objects(scene, is_visible_);
  for (int i = 0; i < (flows_.empty() ? warm_up_steps : flow_warm_up_steps); ++i) walk();
  present(scene, 0.0);
}

void CrowdProcess::add_objects(scene::Scene& scene, bool is_visible) {
  if (generated_) {
    std::vector<std::string> names;
    for (std::size_t p = 0; p < generated_->size(); ++p) names.push_back(person_name(p));
    generated_->add_to(scene, names, is_visible);
    constexpr std::array<people::Activity, 8> at_rest{
        people::Activity::stand, people::Activity::phone, people::Activity::stand, people::Activity::wait,
        people::Activity::stand, people::Activity::phone, people::Activity::stand, people::Activity::stand};
    for (std::size_t p = 0; p < shown_.size(); ++p) {
      const glm::vec3 place(crowd_->walkers().position[p], crowd_->walkers().height_m[p]);
      bodies_.emplace_back(generated_->body(p), people::Lead{place, shown_[p].heading}, float(p) * 1.37f);
      bodies_.back().activity = at_rest[p % at_rest.size()];
    }
    return;
  }
  for (std::size_t p = 0; p < shown_.size(); ++p) {
    scene::Object object;
    object.name = person_name(p);
    object.model = shown_[p].model->model;
    object.is_visible = is_visible;
    scene::play(object, {shown_[p].model->animation, 0.0f, 0.0});
    shown_[p].object = scene.objects.size();
    scene.objects.push_back(std::move(object));
  }
}

/// People stop at the kerb of a crossing that a vehicle takes, and drivers see who walks there or waits.
void CrowdProcess::cross_streets() {
  if (!streets_) return;
  vehicles_.clear();
  for (const scene::StreetTraffic::Vehicle& vehicle : streets_->vehicles) {
    // A capsule in which all corners lie.
    const glm::vec2 half =
        glm::normalize(vehicle.front - vehicle.rear + glm::vec2(1e-6f)) * (0.5f * vehicle.half_width_m);
    vehicles_.push_back({vehicle.rear + half, vehicle.front - half, corners_reach * vehicle.half_width_m,
                         vehicle.velocity, vehicle.ground_m - vehicle_height_m,
                         vehicle.ground_m + vehicle_height_m});
  }
  std::ranges::fill(streets_->people, std::uint8_t(0));
  const Walkers& walkers = crowd_->walkers();
  for (std::size_t p = 0; p < crowd_->size(); ++p) {
    const glm::vec2 here = walkers.position[p];
    crowd_->hold(p, false);
    if (crowd_->people()[p].is_away) continue;
    for (std::size_t c = 0; c < streets_->crossings.size(); ++c) {
      const scene::StreetCrossing& crossing = streets_->crossings[c];
      if (!crossing.contains(here, seen_from_m)) continue;
      const bool is_on = crossing.contains(here);
      // Those who give way to others do not go where they want to.
      const bool steps_on = !is_on && (crossing.contains(here + step_ahead_m * crowd_->direction(p)) ||
                                       crossing.contains(here + pushed_on_s * walkers.velocity[p]));
      const bool is_red = heeds_lights && streets_->lights[c] == scene::WalkLight::wait;
      if (is_on || (steps_on && !is_red)) streets_->people[c] = 1;
      if (steps_on && (is_red || (heeds_vehicles && streets_->taken[c] != 0))) crowd_->hold(p, true);
    }
    if (!heeds_vehicles) continue;
    const glm::vec2 next = here + step_ahead_m * crowd_->direction(p);
    const glm::vec2 carried_to = here + carried_s * walkers.velocity[p];
    const auto is_entered = [&](const scene::StreetCrossing& strip) {
      return !strip.contains(here, -pushed_m) && (strip.contains(next) || strip.contains(carried_to));
    };
    if (std::ranges::any_of(streets_->kept_clear, is_entered)) crowd_->hold(p, true);
  }
}

/// Who waits at a kerb is not pushed over it.
void CrowdProcess::stay_at_kerbs(const std::vector<glm::vec2>& before) {
  if (!streets_) return;
  for (std::size_t c = 0; c < streets_->crossings.size(); ++c) {
    const bool is_red = heeds_lights && streets_->lights[c] == scene::WalkLight::wait;
    if (!is_red && (!heeds_vehicles || streets_->taken[c] == 0)) continue;
    for (std::size_t p = 0; p < crowd_->size(); ++p)
      if (streets_->crossings[c].contains(crowd_->walkers().position[p]) &&
          !streets_->crossings[c].contains(before[p]) && !crowd_->people()[p].is_away)
        crowd_->stand_back(p, before[p]);
  }
}

/// Who walks with others goes where these go.
void CrowdProcess::keep_company() {
  for (std::size_t p = 0; p < leaders_.size(); ++p) {
    if (leaders_[p] < 0 || leaders_[p] == int(p)) continue;
    const PersonOnTheWay &it = crowd_->people()[p], &other = crowd_->people()[std::size_t(leaders_[p])];
    if (it.destination != other.destination || (it.has_arrived && !other.has_arrived))
      crowd_->send(p, other.destination, other.waits_s);
  }
}

void CrowdProcess::walk() {
  for (std::size_t p = 0; p < shown_.size() && flows_.empty(); ++p) {
    const bool follows = leaders_[p] >= 0 && leaders_[p] != int(p);
    if (!crowd_->people()[p].has_arrived || follows) continue;
    Random& random = randoms_[p];
    const bool is_alone = leaders_[p] < 0;  // groups do not ride: who would wait for whom
    if (is_alone && passengers_ && passengers_->continues(p, *crowd_, random)) continue;
    crowd_->send(p, new_destination(random),
                 random.chance(resting) ? random.uniform(1.0f, longest_rest_s) : 0.0f);
  }
  keep_company();
  if (!flows_.empty()) come_and_go();
  if (passengers_)
    passengers_->step(crowd_step_s, *crowd_, randoms_,
                      [&](std::size_t p) { crowd_->send(p, new_destination(randoms_[p])); });
  follow_presence();
  cross_streets();
  const std::vector<glm::vec2> before = crowd_->walkers().position;
  crowd_->step(crowd_step_s,
               heeds_vehicles ? std::span<const MovingBody>(vehicles_) : std::span<const MovingBody>());
  stay_at_kerbs(before);
  const Walkers& walkers = crowd_->walkers();
  for (std::size_t p = 0; p < shown_.size(); ++p) {
    Shown& it = shown_[p];
    it.before = it.now;
    it.now = glm::vec3(walkers.position[p], walkers.height_m[p]);
    it.now.z = heights_.at(it.now);
    if (const auto between = passengers_ ? passengers_->between(p) : std::nullopt)
      it.now = *between;
    else if (it.is_gone)
      it.now = it.before;
    it.walked_before_m = it.walked_m, it.heading_before = it.heading;
    const glm::vec2 velocity = walkers.velocity[p];
    const float speed = glm::length(velocity);
    it.walked_m += double(speed * crowd_step_s);
    constexpr float min_turning_speed = 0.15f;  // who is pushed about does not turn round
    glm::vec2 towards = speed > min_turning_speed ? velocity : walkers.aim[p];
    if (const auto looks = passengers_ ? passengers_->looks_to(p) : std::nullopt) towards = *looks;
    if (towards == glm::vec2(0.0f)) continue;
    const float turn = wrapped(std::atan2(towards.y, towards.x) - it.heading),
                most = turn_rate * crowd_step_s;
    it.heading += std::clamp(turn, -most, most);
  }
  const auto ground = [this](glm::vec3 place) { return heights_.at(place); };
  for (std::size_t p = 0; p < bodies_.size(); ++p)
    if (!shown_[p].is_gone) bodies_[p].step({shown_[p].now, shown_[p].heading}, crowd_step_s, ground);
}

/// Flows between places of the mesh.
void CrowdProcess::add_flows(const CrowdDemand& demand) {
  constexpr float beside_mesh_m = 3.0f;
  for (const Flow& flow : demand.flows) {
    const auto from = crowd_->mesh().nearest(flow.from, beside_mesh_m),
               to = crowd_->mesh().nearest(flow.to, beside_mesh_m);
    const bool has_way = from && to && crowd_->mesh().way(*from, *to);
    if (!has_way) {
      const glm::vec3 bad = from ? flow.to : flow.from;
      warn(error("crowd: nobody can walk from {:.1f} {:.1f} to {:.1f} {:.1f}: {}", flow.from.x, flow.from.y,
                 flow.to.x, flow.to.y,
                 from && to ? std::string("no way leads there")
                            : fmt::format("nothing to walk on lies at {:.1f} {:.1f} within the radius", bad.x,
                                          bad.y)));
      continue;
    }
    if (flow.per_hour <= 0.0f) continue;
    RunningFlow running{*from, crowd_->add(Destination{*to, *to, 0.8f}), flow.per_hour};
    running.random = Random(demand.seed, 1'000'000u + flows_.size());
    running.next_s = double(running.random.uniform()) * 3600.0 / double(flow.per_hour);
    flows_.push_back(running);
  }
}

/// People of flows come (a Poisson process each) and leave.
void CrowdProcess::come_and_go() {
  constexpr float free_m = 0.6f;
  flow_time_s_ += double(crowd_step_s);
  for (std::size_t p = 0; p < shown_.size(); ++p)
    if (crowd_->people()[p].has_arrived) crowd_->set_away(p, true);
  const auto is_free = [&](glm::vec3 place) {
    const Walkers& walkers = crowd_->walkers();
    for (std::size_t p = 0; p < walkers.size(); ++p)
      if (!crowd_->people()[p].is_away && glm::distance(walkers.position[p], glm::vec2(place)) < free_m)
        return false;
    return true;
  };
  for (RunningFlow& flow : flows_) {
    if (flow.next_s > flow_time_s_ || !is_free(flow.from)) continue;
    const auto person = std::ranges::find(crowd_->people(), true, &PersonOnTheWay::is_away);
    if (person == crowd_->people().end()) {
      if (!std::exchange(is_short_of_people_, true))
        warn(error("crowd: the flows bring more than {} people at a time; more people= lets them all come",
                   shown_.size()));
      return;
    }
    const auto p = std::size_t(person - crowd_->people().begin());
    crowd_->put(p, flow.from);
    if (!crowd_->send(p, flow.destination)) crowd_->set_away(p, true);
    shown_[p].now = flow.from;
    const glm::vec2 ahead = crowd_->direction(p);
    if (ahead != glm::vec2(0.0f)) shown_[p].heading = std::atan2(ahead.y, ahead.x);
    flow.next_s -= std::log(1.0 - double(flow.random.uniform())) * 3600.0 / double(flow.per_hour);
  }
}

/// Shows who has come and hides who has gone; feet are set down again where they come.
void CrowdProcess::follow_presence() {
  for (std::size_t p = 0; p < shown_.size(); ++p) {
    Shown& it = shown_[p];
    const bool was_gone = std::exchange(it.is_gone, is_gone(p));
    if (!was_gone || it.is_gone) continue;
    if (passengers_) {
      it.now = passengers_->between(p).value_or(it.now);
      if (const auto looks = passengers_->looks_to(p)) it.heading = std::atan2(looks->y, looks->x);
    }
    if (!generated_) continue;
    const people::Activity activity = bodies_[p].activity;
    bodies_[p] = people::WalkingBody(generated_->body(p), {it.now, it.heading}, float(p) * 1.37f);
    bodies_[p].activity = activity;
  }
}

/// An edit of the place changes where people walk, within the next step.
void CrowdProcess::follow_ground(const scene::Scene& scene) {
  const Bounds changed = watch_.changes(scene);
  const auto& demand = scene.data<CrowdDemand>();
  const glm::vec2 reach(demand.radius_m);
  const glm::vec2 low = glm::max(glm::vec2(changed.min), demand.centre - reach),
                  high = glm::min(glm::vec2(changed.max), demand.centre + reach);
  if (changed.empty() || !(low.x < high.x && low.y < high.y)) return;
  const WalkingGround ground = ground_of(scene, demand.centre, demand.radius_m);
  crowd_->change_ground(ground, low, high);
  heights_ = GroundHeights(ground);
}

void CrowdProcess::step(const scene::Scene& scene) {
  if (!crowd_ || ++steps_ % clock_steps != 0) return;
  follow_ground(scene);
  walk();
}

/// Scenarios and messages show and hide people while the scene runs.
void CrowdProcess::follow_visibility(scene::Scene& scene) {
  const bool is_visible = std::as_const(scene).data<CrowdDemand>().is_visible;
  if (!crowd_ || std::exchange(is_visible_, is_visible) == is_visible) return;
  if (generated_) return generated_->set_visible(scene, is_visible);
  for (const Shown& it : shown_) scene.objects[it.object].is_visible = is_visible;
}

void CrowdProcess::present(scene::Scene& scene, double ahead_s) {
  follow_visibility(scene);
  const double since_s = double(steps_ % clock_steps) * action::step_s + ahead_s;
  const float part = std::min(float(since_s) / crowd_step_s, 1.0f);
  if (generated_) {
    for (std::size_t p = 0; p < bodies_.size(); ++p) {
      generated_->set_away(scene, p, shown_[p].is_gone);
      generated_->place(p, bodies_[p].lead_at(part),
                        people::picture_of(bodies_[p].cycle_at(part), bodies_[p].activity));
    }
    shown_part_ = part;
    generated_->show(scene, [&](std::size_t p) { return bodies_[p].posture_at(part); });
    return;
  }
  for (const Shown& it : shown_) {
    scene::Object& object = scene.objects[it.object];
    object.is_visible = is_visible_ && !it.is_gone;
    const glm::vec3 place = glm::mix(it.before, it.now, part);
    const float heading = it.heading_before + part * (it.heading - it.heading_before);
    object.world_from_model =
        glm::rotate(glm::translate(glm::mat4(1.0f), place), heading, glm::vec3(0, 0, 1));
    const double walked_m = it.walked_before_m + double(part) * (it.walked_m - it.walked_before_m);
    object.played.start_s = walked_m / double(it.model->cycle_m) * double(it.model->cycle_s);
  }
}

}  // namespace parvis::crowd
