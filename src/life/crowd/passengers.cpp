#include "life/crowd/passengers.h"

#include <algorithm>
#include <cmath>

namespace parvis::crowd {
namespace {

constexpr float rides = 0.25f;            // the fraction of arrivals after which somebody takes the tram
constexpr float aboard_at_first = 0.12f;  // of the people
constexpr int waiting_places = 14, max_alighting = 7;
constexpr float between_people_s = 1.3f;             // through one door
constexpr float through_door = 0.8f;                 // m/s
constexpr float inside_m = 0.9f, outside_m = 0.55f;  // of the platform's edge
constexpr float behind_edge_m = 0.35f, door_reach_m = 0.85f, waiting_reach_m = 0.75f, on_mesh_m = 0.8f;
constexpr float longest_reaction_s = 1.5f, slow_walk = 0.8f;  // m/s

}  // namespace

Passengers::Passengers(std::shared_ptr<std::vector<scene::TransitStop>> stops, Crowd& crowd, glm::vec2 centre,
                       float radius_m)
    : stops_(std::move(stops)) {
  for (std::size_t s = 0; s < stops_->size(); ++s) {
    const scene::TransitStop& stop = (*stops_)[s];
    if (glm::distance(glm::vec2(0.5f * (stop.from + stop.to)), centre) > radius_m) continue;
    Places places;
    places.stop = int(s);
    const auto add = [&](glm::vec3 wanted, float reach_m, std::vector<int>& to) {
      if (const auto place = crowd.mesh().nearest(wanted, on_mesh_m))
        to.push_back(crowd.add(Destination{*place, *place, reach_m}));
    };
    for (int i = 0; i < waiting_places; ++i) {
      const float along = (float(i) + 0.5f) / float(waiting_places),
                  behind = 0.8f + 0.3f * float((5 * i) % 3) * std::min(1.0f, 0.4f * stop.breadth_m);
      add(glm::mix(stop.from, stop.to, along) + glm::vec3(behind * stop.away, 0.0f), waiting_reach_m,
          places.waiting);
    }
    for (const glm::vec3 door : stop.doors)
      add(door + glm::vec3(behind_edge_m * stop.away, 0.0f), door_reach_m, places.doors);
    if (!places.waiting.empty() && places.doors.size() == stop.doors.size() && !stop.doors.empty())
      places_.push_back(std::move(places));
  }
}

void Passengers::add(Crowd& crowd, Random& random) {
  people_.emplace_back();
  if (empty() || !random.chance(aboard_at_first)) return;
  people_.back().trip = Trip::rides;
  crowd.set_away(people_.size() - 1, true);
}

bool Passengers::to_stop(std::size_t person, Crowd& crowd, Random& random) {
  const Places& places = places_[std::size_t(random.index(int(places_.size())))];
  const int place = places.waiting[std::size_t(random.index(int(places.waiting.size())))];
  if (!crowd.send(person, place)) return false;
  people_[person].trip = Trip::walks_to_stop, people_[person].stop = places.stop;
  return true;
}

bool Passengers::continues(std::size_t person, Crowd& crowd, Random& random) {
  Passenger& it = people_[person];
  if (it.trip == Trip::none) return !empty() && random.chance(rides) && to_stop(person, crowd, random);
  if (it.trip == Trip::walks_to_stop) it.trip = Trip::waits;
  if (it.trip == Trip::walks_to_door) {
    const scene::TransitStop& stop = (*stops_)[std::size_t(it.stop)];
    const glm::vec3 door = stop.doors[std::size_t(it.door)];
    it.from = glm::vec3(crowd.walkers().position[person], door.z);
    it.to = door - glm::vec3(inside_m * stop.away, 0.0f);
    it.trip = Trip::enters, it.passed_s = 0.0f, it.delay_s = 0.0f;
    crowd.set_away(person, true);
  }
  return true;
}

/// People alight where doors have opened, one after the other through each.
void Passengers::let_out(Places& places, std::span<Random> randoms) {
  const scene::TransitStop& stop = (*stops_)[std::size_t(places.stop)];
  int count = 0;
  for (std::size_t p = 0; p < people_.size() && count < max_alighting; ++p) {
    Passenger& it = people_[p];
    if (it.trip != Trip::rides || randoms[p].chance(0.3f)) continue;
    it.trip = Trip::leaves, it.stop = places.stop, it.passed_s = 0.0f;
    it.door = count % int(stop.doors.size());
    it.delay_s = between_people_s * float(count / int(stop.doors.size()));
    const glm::vec3 door = stop.doors[std::size_t(it.door)];
    it.from = door - glm::vec3(inside_m * stop.away, 0.0f);
    it.to = door + glm::vec3(outside_m * stop.away, 0.0f);
    ++count;
  }
}

int Passengers::pending(int stop, Trip trip) const {
  return int(std::ranges::count_if(people_,
                                   [&](const Passenger& it) { return it.stop == stop && it.trip == trip; }));
}

void Passengers::board(const Places& places, Crowd& crowd, std::span<Random> randoms) {
  const scene::TransitStop& stop = (*stops_)[std::size_t(places.stop)];
  for (std::size_t p = 0; p < people_.size(); ++p) {
    Passenger& it = people_[p];
    if (it.stop != places.stop || it.trip != Trip::waits) continue;
    const glm::vec2 here = crowd.walkers().position[p];
    const auto away_m = [&](int destination) {
      return glm::distance(here, glm::vec2(crowd.destinations()[std::size_t(destination)].a));
    };
    const auto nearest = std::ranges::min_element(places.doors, {}, away_m);
    it.door = int(nearest - places.doors.begin());
    if (away_m(*nearest) / slow_walk > stop.open_s) continue;  // too late
    if (crowd.send(p, places.doors[std::size_t(it.door)], randoms[p].uniform(0.0f, longest_reaction_s)))
      it.trip = Trip::walks_to_door;
  }
}

void Passengers::step(float step_s, Crowd& crowd, std::span<Random> randoms,
                      const std::function<void(std::size_t)>& send) {
  for (Places& places : places_) {
    scene::TransitStop& stop = (*stops_)[std::size_t(places.stop)];
    if (stop.is_open && !places.was_open) let_out(places, randoms);
    if (stop.is_open && pending(places.stop, Trip::leaves) == 0) board(places, crowd, randoms);
    if (!stop.is_open)  // too late
      for (std::size_t p = 0; p < people_.size(); ++p)
        if (people_[p].stop == places.stop && people_[p].trip == Trip::walks_to_door) {
          const auto place = std::size_t(randoms[p].index(int(places.waiting.size())));
          if (crowd.send(p, places.waiting[place])) people_[p].trip = Trip::walks_to_stop;
        }
    places.was_open = stop.is_open;
  }
  for (std::size_t p = 0; p < people_.size(); ++p) {
    Passenger& it = people_[p];
    if (it.trip != Trip::enters && it.trip != Trip::leaves) continue;
    it.delay_s -= step_s;
    if (it.delay_s > 0.0f) continue;
    it.passed_s += step_s;
    if (it.passed_s * through_door < glm::distance(it.from, it.to)) continue;
    scene::TransitStop& stop = (*stops_)[std::size_t(it.stop)];
    if (it.trip == Trip::enters) {
      it.trip = Trip::rides, ++stop.boarded;
      continue;
    }
    it.trip = Trip::none, ++stop.alighted;
    crowd.put(p, it.to);
    send(p);
  }
  for (const Places& places : places_)
    (*stops_)[std::size_t(places.stop)].boarding = pending(places.stop, Trip::walks_to_door) +
                                                   pending(places.stop, Trip::enters) +
                                                   pending(places.stop, Trip::leaves);
}

std::optional<glm::vec3> Passengers::between(std::size_t person) const {
  const Passenger& it = people_[person];
  if (it.trip != Trip::enters && it.trip != Trip::leaves) return std::nullopt;
  const float way_m = std::max(glm::distance(it.from, it.to), 0.01f);
  return glm::mix(it.from, it.to, std::clamp(it.passed_s * through_door / way_m, 0.0f, 1.0f));
}

std::optional<glm::vec2> Passengers::looks_to(std::size_t person) const {
  const Passenger& it = people_[person];
  if (it.trip == Trip::waits) return -(*stops_)[std::size_t(it.stop)].away;
  if (it.trip == Trip::enters || it.trip == Trip::leaves) return glm::normalize(glm::vec2(it.to - it.from));
  return std::nullopt;
}

}  // namespace parvis::crowd
