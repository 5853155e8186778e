#include "life/traffic/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace parvis::traffic {

namespace {

constexpr float spacing_m = 6.0f;               // between vehicles that are put on a street
constexpr float share_of_room = 0.5f;           // that vehicles may fill: beyond it streets jam for good
constexpr float early_request_m = 20.0f;        // before the stop line, beside the braking distance
constexpr float gentle_braking = 1.5f;          // m/s2: for bends, and for asking in time
constexpr float queue_braking = 4.0f;           // m/s2: what the last of a queue may do at the most
constexpr float other_way_after_s = 6.0f;       // of waiting, a driver thinks of another turn
constexpr float braking_before_people = 3.0f;   // m/s2
constexpr float crossing_looked_for_m = 12.0f;  // beside the braking distance
constexpr float before_stripes_m = 1.0f, beside_stripes_m = 0.3f;
constexpr float slow_ahead = 2.0f;  // m/s of the vehicle ahead: a crossing before it might be stood on
constexpr float bridge_m = 3.0f;
constexpr float over_line_m = 0.3f;    // who is farther past a stop line drives on
constexpr float before_line_m = 1.0f;  // of the place at which a driver aims
constexpr float tram_soon_s = 8.0f;    // within which nobody drives onto its track
constexpr float halted_m_s = 0.15f;    // a bus that is slower has halted
constexpr float touching_m = 0.2f;     // no vehicle comes nearer to another, whatever the model says

/// Index into the route of the first shared lane before the vehicle that it does not hold; the route's size
/// if none.
std::size_t stop_line(const Vehicle& vehicle, std::span<const DrivingLane> lanes) {
  std::size_t i = std::max(vehicle.held_until, vehicle.current + 1);
  while (i < vehicle.route.size() && !lanes[std::size_t(vehicle.route[i])].is_shared) ++i;
  return i;
}

float distance_to(const Vehicle& vehicle, std::size_t route_index, std::span<const DrivingLane> lanes) {
  float distance = -vehicle.front_m;
  for (std::size_t i = vehicle.current; i < route_index; ++i)
    distance += lanes[std::size_t(vehicle.route[i])].path.length();
  return distance;
}

}  // namespace

Simulation::Simulation(const scene::RoadGraph& roads, std::vector<VehicleShape> shapes, const Area& area)
    : area_(area),
      shapes_(std::move(shapes)),
      lanes_(driving_lanes(roads, shapes_, gentle_braking, area)),
      rights_(lanes_),
      occupancy_(lanes_.size()),
      promised_room_m_(lanes_.size(), 0.0f) {
  wanted_.reserve(longest_route);
}

std::size_t Simulation::spread_vehicles(std::size_t wanted, std::uint64_t seed, std::size_t bicycles) {
  struct Place {
    int lane;
    float front_m;
  };
  float longest_m = 0.0f;
  for (const VehicleShape& shape : shapes_) {
    longest_m = std::max(longest_m, shape.length_m());
    longest_reach_m_ = std::max(longest_reach_m_, shape.length_m() + 2.0f * shape.half_width_m + 1.0f);
  }
  const float first_m = longest_m + 1.0f, pitch_m = longest_m + spacing_m;
  // On a street that leads out of the area a vehicle would leave it, to come back some crossings later.
  const auto is_within = [](const DrivingLane& lane) { return lane.is_usable && lane.outside_m == 0.0f; };
  const bool has_streets_within = std::ranges::any_of(lanes_, is_within);
  std::vector<Place> places;
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    if (!lanes_[lane].is_usable || lanes_[lane].is_shared) continue;
    if (has_streets_within && !is_within(lanes_[lane])) continue;
    const int count = int(std::ceil((lanes_[lane].path.length() - 3.0f - first_m) / pitch_m));
    for (int i = 0; i < count; ++i) {
      const float front_m = first_m + float(i) * pitch_m;
      if (area_.outside_m(glm::vec2(lanes_[lane].path.at(front_m))) == 0.0f)
        places.push_back({int(lane), front_m});
    }
  }

  Random random(seed);
  for (std::size_t i = places.size(); i > 1; --i)
    std::swap(places[i - 1], places[std::size_t(random.index(int(i)))]);
  const std::size_t room = std::size_t(std::ceil(share_of_room * float(places.size())));
  std::vector<const VehicleShape*> motored, ridden;
  for (const VehicleShape& shape : shapes_) (shape.rider ? ridden : motored).push_back(&shape);
  const std::size_t count = std::min(wanted + bicycles, room), motors = std::min(wanted, count);
  for (std::size_t i = 0; i < count; ++i) {
    Vehicle vehicle;
    const std::vector<const VehicleShape*>& kinds = i < motors ? motored : ridden;
    vehicle.shape = kinds[std::size_t(random.index(int(kinds.size())))];
    vehicle.random = Random(seed, i + 1);
    vehicle.route.reserve(longest_route);
    vehicle.route.push_back(places[i].lane);
    vehicle.front_m = places[i].front_m;
    vehicle.plan(lanes_);
    vehicles_.push_back(std::move(vehicle));
  }
  occupancy_.reserve(vehicles_.size() * longest_route);
  asking_.reserve(vehicles_.size());
  footprints_.resize(vehicles_.size());
  from_west_.resize(vehicles_.size());
  std::iota(from_west_.begin(), from_west_.end(), std::size_t(0));
  return count;
}

void Simulation::note_presences() {
  occupancy_.clear();
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    vehicles_[i].note_presence(int(i), lanes_, occupancy_);
    footprints_[i] = vehicles_[i].footprint(0.0f, lanes_);
  }
  std::ranges::sort(from_west_, {}, [&](std::size_t i) { return footprints_[i].centre.x; });
}

/// A vehicle asks when it comes near the stop line and nobody stands before it there.
bool Simulation::wants_right(std::size_t index) const {
  const Vehicle& vehicle = vehicles_[index];
  const std::size_t line = stop_line(vehicle, lanes_);
  if (line == vehicle.route.size() || vehicle.promised_lane >= 0) return false;
  if (const std::optional<Stop> stop = light_ahead(vehicle); stop && must_stop(vehicle, *stop)) return false;
  const float distance = distance_to(vehicle, line, lanes_);
  if (distance > early_request_m + vehicle.speed * vehicle.speed / (2.0f * gentle_braking)) return false;

  bool is_first = true;
  for (std::size_t i = vehicle.current; i < line; ++i)
    occupancy_.for_each_on(vehicle.route[i], [&](const Presence& other) {
      const bool is_before = i > vehicle.current || other.front_m > vehicle.front_m;
      if (other.holds_front && other.vehicle != int(index) && is_before) is_first = false;
    });
  return is_first;
}

/// Whether the vehicle will fit on `lane` behind those who are there or on their way to it.
bool Simulation::has_room(const Vehicle& vehicle, std::size_t index, int lane) const {
  float room_m = lanes_[std::size_t(lane)].path.length();
  occupancy_.for_each_on(lane, [&](const Presence& other) {
    const float stops_at_m = other.tail_m + other.speed * other.speed / (2.0f * queue_braking);
    if (other.vehicle != int(index)) room_m = std::min(room_m, stops_at_m);
  });
  return room_m - promised_room_m_[std::size_t(lane)] > vehicle.room_m();
}

void Simulation::ask_for_right(Vehicle& vehicle, std::size_t index) {
  const std::size_t line = stop_line(vehicle, lanes_);
  wanted_.clear();
  std::size_t rest = line;
  for (; !vehicle.can_rest_on(lanes_[std::size_t(vehicle.route[rest])]); ++rest) {
    if (lanes_[std::size_t(vehicle.route[rest])].is_shared) wanted_.push_back(vehicle.route[rest]);
    if (rest + 1 == vehicle.route.size()) break;  // nowhere to rest, as far as it can plan
  }

  const int resting_lane = vehicle.route[rest];
  const std::span<const int> held(vehicle.route.data(), vehicle.held_until);
  if (has_room(vehicle, index, resting_lane) && rights_.request(wanted_, held, vehicle.waited_s)) {
    vehicle.held_until = rest + (lanes_[std::size_t(resting_lane)].is_shared ? 1 : 0);
    vehicle.promised_lane = resting_lane;
    promised_room_m_[std::size_t(resting_lane)] += vehicle.room_m();
    vehicle.waited_s = 0.0f;
    return;
  }
  const float waited_before_s = vehicle.waited_s;
  vehicle.waited_s += step_s;
  if (std::floor(vehicle.waited_s / other_way_after_s) > std::floor(waited_before_s / other_way_after_s))
    vehicle.plan_anew(line, lanes_);
}

void Simulation::settle_rights() {
  asking_.clear();
  for (std::size_t i = 0; i < vehicles_.size(); ++i)
    if (wants_right(i)) asking_.push_back(i);
  std::ranges::sort(asking_, [&](std::size_t a, std::size_t b) {
    return vehicles_[a].waited_s != vehicles_[b].waited_s ? vehicles_[a].waited_s > vehicles_[b].waited_s
                                                          : a < b;
  });
  rights_.begin_round();
  for (const std::size_t i : asking_) ask_for_right(vehicles_[i], i);
}

Simulation::Obstacle Simulation::obstacle_ahead(std::size_t index) const {
  const Vehicle& vehicle = vehicles_[index];
  const std::size_t line = stop_line(vehicle, lanes_);
  Obstacle nearest{std::numeric_limits<float>::max(), 0.0f};
  float lane_start_m = -vehicle.front_m;  // from the front bumper
  for (std::size_t i = vehicle.current; i < vehicle.route.size() && lane_start_m < planned_ahead_m; ++i) {
    if (i == line) return lane_start_m < nearest.gap_m ? Obstacle{lane_start_m, 0.0f} : nearest;
    occupancy_.for_each_on(vehicle.route[i], [&](const Presence& other) {
      const bool is_behind = i == vehicle.current && other.holds_front && other.front_m <= vehicle.front_m;
      const float gap_m = lane_start_m + other.tail_m;
      if (other.vehicle != int(index) && !is_behind && gap_m < nearest.gap_m) nearest = {gap_m, other.speed};
    });
    if (nearest.gap_m < planned_ahead_m) return nearest;
    lane_start_m += lanes_[std::size_t(vehicle.route[i])].path.length();
  }
  return nearest;
}

void Simulation::share(scene::StreetTraffic& streets) {
  streets_ = &streets;
  streets.vehicles.resize(vehicles_.size());
  streets.taken.assign(streets.crossings.size(), 0);
  streets.lights.assign(streets.crossings.size(), scene::WalkLight::none);
  write_vehicles(), write_lights();
}

void Simulation::write_vehicles() {
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    const Footprint& place = footprints_[i];
    scene::StreetTraffic::Vehicle& vehicle = streets_->vehicles[i];
    const glm::vec2 half = place.half_length_m * place.forward;
    vehicle.rear = place.centre - half, vehicle.front = place.centre + half;
    vehicle.half_width_m = place.half_width_m, vehicle.velocity = vehicles_[i].speed * place.forward;
    vehicle.ground_m = vehicles_[i].point_behind(0.0f, lanes_).z;
  }
}

/// The next light before the vehicle.
std::optional<Simulation::Stop> Simulation::light_ahead(const Vehicle& vehicle) const {
  if (signals_.empty() || !heeds_signals) return std::nullopt;
  float ahead_m = lanes_[std::size_t(vehicle.lane())].path.length() - vehicle.front_m;
  for (std::size_t i = vehicle.current + 1; i < vehicle.route.size() && ahead_m < planned_ahead_m; ++i) {
    const Signals::Gate gate = signals_.gate(vehicle.route[i]);
    if (gate.is_lit) return Stop{i, ahead_m - gate.line_m, gate.light};
    ahead_m += lanes_[std::size_t(vehicle.route[i])].path.length();
  }
  return std::nullopt;
}

/// Whether a driver stops at a light: at red before the line, at yellow where braking suffices.
bool Simulation::must_stop(const Vehicle& vehicle, const Stop& stop) const {
  if (stop.light == DriveLight::green || stop.line_m < -over_line_m) return false;
  const float stopping_m = vehicle.speed * vehicle.speed / (2.0f * braking_before_people);
  return stop.light == DriveLight::red || stop.line_m > stopping_m;
}

/// A driver who stops at a light returns the lanes of the junction that were given: others may need them.
void Simulation::heed_signals(std::size_t index, Obstacle& nearest) {
  Vehicle& vehicle = vehicles_[index];
  const std::optional<Stop> stop = light_ahead(vehicle);
  if (!stop || !must_stop(vehicle, *stop)) return;
  const float gap_m = std::max(stop->line_m, 0.0f) + before_line_m;
  if (gap_m < nearest.gap_m) nearest = {gap_m, 0.0f};
  if (vehicle.held_until <= stop->turn) return;
  for (std::size_t i = stop->turn; i < vehicle.held_until; ++i)
    if (lanes_[std::size_t(vehicle.route[i])].is_shared) rights_.release(vehicle.route[i]);
  vehicle.held_until = stop->turn;
  if (vehicle.promised_lane >= 0) promised_room_m_[std::size_t(vehicle.promised_lane)] -= vehicle.room_m();
  vehicle.promised_lane = -1;
}

/// Where the middle of the vehicle's way lies on a crossing; nothing where that is farther ahead than
/// `seen_m`, or on another level.
std::optional<Simulation::Stretch> Simulation::stretch_on(std::size_t index,
                                                          const scene::StreetCrossing& crossing,
                                                          float seen_m) const {
  const Vehicle& vehicle = vehicles_[index];
  const float reach_m = 0.5f * glm::distance(crossing.a, crossing.b) + crossing.half_width_m;
  if (glm::distance(footprints_[index].centre, 0.5f * glm::vec2(crossing.a + crossing.b)) >
          reach_m + seen_m + 0.5f * vehicle.length_m() ||
      std::abs(crossing.a.z - vehicle.point_behind(0.0f, lanes_).z) > bridge_m)
    return std::nullopt;
  std::optional<Stretch> met;
  for (float at_m = -vehicle.length_m(); at_m < seen_m + reach_m; at_m += 0.5f) {
    if (!crossing.contains(glm::vec2(vehicle.point_behind(-at_m, lanes_)), beside_stripes_m)) {
      if (met) break;
      continue;
    }
    if (!met) met = {at_m, at_m};
    met->to_m = at_m;
  }
  return met && met->from_m <= seen_m ? met : std::nullopt;
}

/// A driver stops before a crossing that people walk over or wait at, and before one that would be stood on
/// behind what is ahead. Where there is no stopping any more, or the vehicle is on it, the crossing is taken.
void Simulation::heed_crossings(std::size_t index, Obstacle& nearest) {
  const Vehicle& vehicle = vehicles_[index];
  const float stopping_m = vehicle.speed * vehicle.speed / (2.0f * braking_before_people);
  for (std::size_t c = 0; c < streets_->crossings.size(); ++c) {
    const std::optional<Stretch> met =
        stretch_on(index, streets_->crossings[c], stopping_m + crossing_looked_for_m);
    if (!met) continue;
    const float stop_m = met->from_m - before_stripes_m;
    const bool can_stop = stop_m > 0.0f && stop_m >= stopping_m;
    const bool would_stand = keeps_crossings_free &&
                             nearest.gap_m < met->to_m + vehicle.length_m() + before_stripes_m &&
                             nearest.speed < slow_ahead;
    if (can_stop && (streets_->people[c] != 0 || would_stand)) {
      if (stop_m < nearest.gap_m) nearest = {stop_m, 0.0f};
    } else if (!can_stop) {
      streets_->taken[c] = 1;
    }
  }
}

/// A driver stops before a track on which a tram comes, and before one that would be stood on.
void Simulation::heed_rails(std::size_t index, Obstacle& nearest) {
  const Vehicle& vehicle = vehicles_[index];
  const float stopping_m = vehicle.speed * vehicle.speed / (2.0f * braking_before_people);
  for (const scene::RailCrossing& rail : streets_->rail_crossings) {
    const std::optional<Stretch> met = stretch_on(index, rail.strip, stopping_m + crossing_looked_for_m);
    if (!met) continue;
    const float stop_m = met->from_m - before_stripes_m;
    const bool would_stand = keeps_crossings_free &&
                             nearest.gap_m < met->to_m + vehicle.length_m() + before_stripes_m &&
                             nearest.speed < slow_ahead;
    if (stop_m > 0.0f && stop_m >= stopping_m && (rail.tram_in_s < tram_soon_s || would_stand) &&
        stop_m < nearest.gap_m)
      nearest = {stop_m, 0.0f};
  }
}

void Simulation::set_bus_stops(std::vector<BusStop> stops,
                               std::shared_ptr<std::vector<scene::TransitStop>> shown) {
  bus_stops_ = std::move(stops), shown_stops_ = std::move(shown);
  bus_trips_.assign(vehicles_.size(), {});
  for (std::size_t i = 0; i < vehicles_.size(); ++i) bus_trips_[i].is_bus = is_bus(*vehicles_[i].shape);
}

/// Buses halt at the stops on their way, where doors open until nobody is on the way to them any more.
void Simulation::heed_bus_stops(std::size_t index, Obstacle& nearest) {
  const Vehicle& vehicle = vehicles_[index];
  BusTrip& trip = bus_trips_[index];
  if (!trip.is_bus) return;
  if (trip.served >= 0 && bus_stops_[std::size_t(trip.served)].lane != vehicle.lane()) trip.served = -1;
  float ahead_m = -vehicle.front_m;
  for (std::size_t i = vehicle.current; i < vehicle.route.size() && ahead_m < planned_ahead_m; ++i) {
    for (std::size_t s = 0; s < bus_stops_.size(); ++s) {
      const BusStop& stop = bus_stops_[s];
      const float to_stop_m = ahead_m + stop.front_m;
      if (stop.lane != vehicle.route[i] || int(s) == trip.served || to_stop_m < -bus_halts_within_m) continue;
      const float gap_m = std::max(to_stop_m, 0.0f) + driver_.standing_gap_m + touching_m;
      if (gap_m < nearest.gap_m) nearest = {gap_m, 0.0f};
      if (to_stop_m > bus_halts_within_m || vehicle.speed > halted_m_s) continue;
      scene::TransitStop& shown = (*shown_stops_)[s];
      trip.stop = int(s), trip.halts_s += step_s;
      const float open_until_s = bus_doors_s + stop.dwell_s;
      const bool waits = shown.boarding > 0 && trip.halts_s < open_until_s + bus_waits_s;
      shown.is_open = trip.halts_s > bus_doors_s && (trip.halts_s < open_until_s || waits);
      shown.open_s = std::max(open_until_s - trip.halts_s, 0.0f);
      if (trip.halts_s > open_until_s + bus_doors_s && !waits)
        trip.stop = -1, trip.served = int(s), trip.halts_s = 0.0f, shown.is_open = false;
    }
    ahead_m += lanes_[std::size_t(vehicle.route[i])].path.length();
  }
}

void Simulation::write_lights() {
  if (!signals_.empty()) streets_->lights = signals_.walk_lights();
}

/// The speed from which gentle braking reaches every slower place ahead in time.
float Simulation::wanted_speed(const Vehicle& vehicle) const {
  float wanted = std::min(lanes_[std::size_t(vehicle.lane())].safe_speed_at(vehicle.front_m),
                          vehicle.shape->max_speed_m_s);
  float ahead_m = lanes_[std::size_t(vehicle.lane())].path.length() - vehicle.front_m;
  for (std::size_t i = vehicle.current + 1; i < vehicle.route.size() && ahead_m < planned_ahead_m; ++i) {
    const DrivingLane& lane = lanes_[std::size_t(vehicle.route[i])];
    const float entry = lane.safe_speed_at(0.0f);
    wanted = std::min(wanted, std::sqrt(entry * entry + 2.0f * gentle_braking * ahead_m));
    ahead_m += lane.path.length();
  }
  return wanted;
}

/// Whether the vehicle would run into another, moved so far. The rules above foresee what happens in
/// crossings that are as they should be; where streets lie across one another without order, drivers must
/// still look where they go.
bool Simulation::would_touch(std::size_t index, float distance_m) const {
  const Footprint now = footprints_[index], then = vehicles_[index].footprint(-distance_m, lanes_);
  const auto x_of = [&](std::size_t i) { return footprints_[i].centre.x; };
  const float west = now.centre.x - longest_reach_m_, east = now.centre.x + longest_reach_m_;
  for (auto i = std::ranges::lower_bound(from_west_, west, {}, x_of);
       i != from_west_.end() && x_of(*i) < east; ++i) {
    const Footprint& other = footprints_[*i];
    const bool is_near = std::abs(other.centre.y - now.centre.y) < longest_reach_m_;
    if (*i != index && is_near && overlap(then, other) && !overlap(now, other)) return true;
  }
  return false;
}

void Simulation::move(std::size_t index) {
  Vehicle& vehicle = vehicles_[index];
  const float old_speed = vehicle.speed;
  vehicle.speed = std::max(0.0f, old_speed + vehicle.acceleration * step_s);
  float distance_m = 0.5f * (old_speed + vehicle.speed) * step_s;
  if (distance_m > 0.0f && would_touch(index, distance_m)) vehicle.speed = distance_m = 0.0f;
  vehicle.advance(distance_m, lanes_, rights_);
  footprints_[index] = vehicle.footprint(0.0f, lanes_);
  vehicle.plan(lanes_);
  if (vehicle.lane() == vehicle.promised_lane) {
    promised_room_m_[std::size_t(vehicle.promised_lane)] -= vehicle.room_m();
    vehicle.promised_lane = -1;
  }
}

void Simulation::step() {
  note_presences();
  if (!signals_.empty())
    signals_.step(step_s, streets_ ? std::span<const scene::RailCrossing>(streets_->rail_crossings)
                                   : std::span<const scene::RailCrossing>());
  settle_rights();
  if (streets_) std::ranges::fill(streets_->taken, std::uint8_t(0));
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    Vehicle& vehicle = vehicles_[i];
    Obstacle obstacle = obstacle_ahead(i);
    heed_signals(i, obstacle);
    if (!bus_stops_.empty()) heed_bus_stops(i, obstacle);
    if (streets_) heed_rails(i, obstacle);
    if (streets_ && heeds_crossings && (streets_->has_people || !signals_.empty()))
      heed_crossings(i, obstacle);
    const float wish = free_acceleration(driver_, vehicle.speed, wanted_speed(vehicle)) -
                       interaction(driver_, vehicle.speed, obstacle.gap_m - touching_m, obstacle.speed);
    vehicle.acceleration = std::max(wish, -hardest_braking);
  }
  for (std::size_t i = 0; i < vehicles_.size(); ++i) move(i);
  if (streets_) write_vehicles(), write_lights();
}

}  // namespace parvis::traffic
