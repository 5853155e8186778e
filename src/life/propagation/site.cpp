#include "life/propagation/site.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <unordered_set>

namespace parvis::propagation {
namespace {

using glm::dvec2;

constexpr double touch_m = 0.01;  // what is nearer to an end of a line stands beside it, not in it

double cross(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }

dvec2 mirrored(dvec2 point, const Wall& wall) {
  const dvec2 along = wall.b - wall.a,
              foot = wall.a + along * (glm::dot(point - wall.a, along) / glm::dot(along, along));
  return 2.0 * foot - point;
}

double top_at(const Wall& wall, double fraction) { return glm::mix(wall.top_a, wall.top_b, fraction); }

/// Fractions of both lines at which they cross; nothing where they are parallel.
std::optional<dvec2> intersection(dvec2 from, dvec2 to, dvec2 a, dvec2 b) {
  const dvec2 along = to - from, wall = b - a;
  const double turn = cross(along, wall);
  if (std::abs(turn) <= 1e-9 * glm::length(along) * glm::length(wall)) return std::nullopt;
  return dvec2(cross(a - from, wall) / turn, cross(a - from, along) / turn);
}

/// The part of the convex hull of all points from `from` to `to` on one side (1: left, -1: right), ends
/// included; empty where it does not lead there within 12 corners (gift wrapping: Jarvis 1973).
std::vector<dvec2> hull_side(dvec2 from, dvec2 to, std::span<const dvec2> corners, double side) {
  constexpr std::size_t max_corners = 12;
  std::vector<dvec2> path{from};
  while (path.size() < max_corners + 2) {
    const dvec2 here = path.back();
    dvec2 next = to;
    for (const dvec2 corner : corners) {
      const double turn = side * cross(next - here, corner - here);
      const bool is_farther = glm::distance(corner, here) > glm::distance(next, here);
      if (glm::distance(corner, here) > touch_m &&
          (turn > 1e-9 || (turn > -1e-9 && is_farther && next != to)))
        next = corner;
    }
    path.push_back(next);
    if (next == to) return path;
  }
  return {};
}

}  // namespace

/// Where a line crosses a wall.
struct Site::Crossing {
  double distance_m;  ///< from the line's begin
  double fraction;    ///< of the wall, from a to b
  int wall;
};

/// The walls in plan as upright quadrilaterals of Embree between heights 0 and 1; positions about the middle
/// of all, so that single precision suffices to find them.
class Site::Rays {
 public:
  explicit Rays(const std::vector<Wall>& walls)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    if (!walls.empty()) {
      dvec2 low(std::numeric_limits<double>::max()), high(-low);
      for (const Wall& w : walls)
        low = glm::min(low, glm::min(w.a, w.b)), high = glm::max(high, glm::max(w.a, w.b));
      middle_ = 0.5 * (low + high);
      const RTCGeometry quads = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
      auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(
          quads, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * walls.size()));
      auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
          quads, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), walls.size()));
      for (const Wall& wall : walls) {
        const glm::vec2 a(wall.a - middle_), b(wall.b - middle_);
        for (const glm::vec3 corner : {glm::vec3(a, 0), glm::vec3(b, 0), glm::vec3(b, 1), glm::vec3(a, 1)})
          *corners++ = corner.x, *corners++ = corner.y, *corners++ = corner.z;
      }
      for (unsigned i = 0; i < 4 * walls.size(); ++i) indices[i] = i;
      rtcCommitGeometry(quads);
      rtcAttachGeometry(scene_, quads);
      rtcReleaseGeometry(quads);
    }
    rtcCommitScene(scene_);
  }
  ~Rays() { rtcReleaseScene(scene_), rtcReleaseDevice(device_); }
  Rays(const Rays&) = delete;
  Rays& operator=(const Rays&) = delete;

  /// Calls `each(wall)` for each wall near the line, in any order, perhaps more than once.
  template <class Each>
  void for_each_near(dvec2 from, dvec2 to, Each&& each) const {
    Query<Each> query{{}, each};
    rtcInitIntersectContext(&query.context);
    query.context.filter = [](const RTCFilterFunctionNArguments* arguments) {
      reinterpret_cast<Query<Each>*>(arguments->context)
          ->each(int(RTCHitN_primID(arguments->hit, arguments->N, 0)));
      arguments->valid[0] = 0;  // the ray goes on
    };
    RTCRay ray = ray_between(from, to);
    rtcOccluded1(scene_, &query.context, &ray);
  }

  /// The nearest wall along the line that `is_hit` accepts; -1 for none.
  template <class IsHit>
  int nearest(dvec2 from, dvec2 to, IsHit&& is_hit) const {
    Query<IsHit> query{{}, is_hit};
    rtcInitIntersectContext(&query.context);
    query.context.filter = [](const RTCFilterFunctionNArguments* arguments) {
      if (!reinterpret_cast<Query<IsHit>*>(arguments->context)
               ->each(int(RTCHitN_primID(arguments->hit, arguments->N, 0))))
        arguments->valid[0] = 0;
    };
    RTCRayHit ray{ray_between(from, to), {}};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &query.context, &ray);
    return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1 : int(ray.hit.primID);
  }

 private:
  template <class Each>
  struct Query {
    RTCIntersectContext context;
    Each& each;
  };

  RTCRay ray_between(dvec2 from, dvec2 to) const {
    RTCRay ray{};
    const glm::vec2 origin(from - middle_), along(to - from);
    ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = 0.5f;
    ray.dir_x = along.x, ray.dir_y = along.y;
    ray.tfar = 1.0f;
    ray.mask = ~0u;
    return ray;
  }

  RTCDevice device_;
  RTCScene scene_;
  dvec2 middle_{0.0};
};

Octaves Transfer::long_term_db(double favourable_fraction) const {
  Octaves result;
  for (std::size_t i = 0; i < octaves; ++i)
    result[i] = level((1.0 - favourable_fraction) * energy(homogeneous_db[i]) +
                      favourable_fraction * energy(favourable_db[i]));
  return result;
}

Site::Site(const Terrain& terrain, std::vector<Wall> walls)
    : terrain_(terrain),
      walls_(std::move(walls)),
      neighbours_(walls_.size()),
      rays_(std::make_unique<Rays>(walls_)) {
  for (const Wall& wall : walls_) {
    ends_.emplace_back(wall.a, wall.top_a);
    ends_.emplace_back(wall.b, wall.top_b);
  }
  std::map<std::pair<long, long>, std::vector<std::pair<int, int>>> ends;  // by centimetre: wall, end
  const auto key = [](dvec2 p) { return std::pair{std::lround(100.0 * p.x), std::lround(100.0 * p.y)}; };
  for (std::size_t i = 0; i < walls_.size(); ++i)
    ends[key(walls_[i].a)].push_back({int(i), 0}), ends[key(walls_[i].b)].push_back({int(i), 1});
  for (const auto& [place, joined] : ends)
    for (const auto& [wall, end] : joined)
      for (const auto& [other, ignored] : joined)
        if (other != wall) neighbours_[std::size_t(wall)][std::size_t(end)].push_back(other);
}
Site::~Site() = default;
Site::Site(Site&&) noexcept = default;

std::vector<Site::Crossing> Site::crossings(dvec2 from, dvec2 to) const {
  std::vector<Crossing> found;
  const double length_m = glm::distance(from, to);
  rays_->for_each_near(from, to, [&](int index) {
    const Wall& wall = walls_[std::size_t(index)];
    const std::optional<dvec2> at = intersection(from, to, wall.a, wall.b);
    if (!at) return;
    const double distance_m = at->x * length_m;
    if (distance_m > touch_m && distance_m < length_m - touch_m)
      found.push_back({distance_m, glm::clamp(at->y, 0.0, 1.0), index});
  });
  std::ranges::sort(found, [](const Crossing& a, const Crossing& b) {
    return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.wall < b.wall;
  });
  const auto repeated = std::ranges::unique(found, {}, &Crossing::wall);
  found.erase(repeated.begin(), repeated.end());
  return found;
}

void Site::add_leg(dvec2 from, dvec2 to, double offset_m, Profile& profile) const {
  const double length_m = glm::distance(from, to);
  if (length_m < 1e-9) return;
  const dvec2 along = (to - from) / length_m;
  const std::vector<Crossing> crossed = crossings(from, to);
  std::vector<double> cuts{0.0, length_m};
  terrain_.add_breaks(from, to, cuts);
  for (const Crossing& crossing : crossed) {
    cuts.push_back(crossing.distance_m);
    profile.walls.push_back(
        {offset_m + crossing.distance_m, top_at(walls_[std::size_t(crossing.wall)], crossing.fraction)});
  }
  std::erase_if(cuts, [&](double d) { return d < 0.0 || d > length_m; });
  std::ranges::sort(cuts);

  const auto add = [&](double distance_m, double z, double factor) {
    std::vector<GroundPoint>& ground = profile.ground;
    const double at = offset_m + distance_m;
    if (!ground.empty() && at - ground.back().distance_m < 1e-9 && std::abs(z - ground.back().z_m) < 1e-6)
      ground.back().factor = factor;
    else
      ground.push_back({at, z, factor});
  };
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double begin = cuts[i], end = cuts[i + 1], width = end - begin;
    if (width < 1e-6) continue;
    const dvec2 middle = from + along * (0.5 * (begin + end));
    // Roofs begin and end at walls.
    const bool is_between_walls = !crossed.empty() && begin >= crossed.front().distance_m - 1e-9 &&
                                  end <= crossed.back().distance_m + 1e-9;
    if (const std::optional<double> roof = is_between_walls ? terrain_.roof_z(middle) : std::nullopt) {
      constexpr double inside_m = 0.05;
      const double in = std::min(inside_m, 0.25 * width);
      add(begin, terrain_.roof_z(from + along * (begin + in)).value_or(*roof), 0.0);
      add(0.5 * (begin + end), *roof, 0.0);
      add(end, terrain_.roof_z(from + along * (end - in)).value_or(*roof), 0.0);
    } else {
      const double factor = terrain_.ground_factor(middle);
      add(begin, terrain_.ground_z(from + along * begin), factor);
      add(end, terrain_.ground_z(from + along * end), factor);
    }
  }
}

Profile Site::profile(std::span<const dvec2> line, double source_z, double receiver_z) const {
  Profile result;
  result.source_z_m = source_z, result.receiver_z_m = receiver_z;
  double offset_m = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    add_leg(line[i], line[i + 1], offset_m, result);
    offset_m += glm::distance(line[i], line[i + 1]);
  }
  // Source and receiver above each other: a profile needs two points.
  while (result.ground.size() < 2)
    result.ground.push_back({1e-3 * double(result.ground.size()), terrain_.ground_z(line.front()),
                             terrain_.ground_factor(line.front())});
  return result;
}

std::vector<dvec2> Site::corners_around(const Place& source, const Place& receiver, Condition condition,
                                        bool is_left, double max_length_m) const {
  const dvec2 from(source), to(receiver), direct = to - from;
  const double direct_m = glm::length(direct);
  if (direct_m < 1.0) return {};
  const auto height_over_ray = [&](dvec2 place, double top) {
    const double along_m = glm::clamp(glm::dot(place - from, direct) / direct_m, 0.0, direct_m);
    return top - glm::mix(source.z, receiver.z, along_m / direct_m) -
           rise_of_ray(along_m, direct_m, condition);
  };
  const double side = is_left ? 1.0 : -1.0;
  std::vector<dvec2> corners, path{from, to};
  std::unordered_set<int> reached;
  // Adds what of a wall and of those that are joined to it stands above the ray.
  const auto add_joined = [&](int first) {
    std::vector<int> open{first};
    while (!open.empty()) {
      const int index = open.back();
      open.pop_back();
      const Wall& wall = walls_[std::size_t(index)];
      const double a = height_over_ray(wall.a, wall.top_a), b = height_over_ray(wall.b, wall.top_b);
      if ((a < 0.0 && b < 0.0) || !reached.insert(index).second) continue;
      for (const dvec2 corner : {a >= 0.0 ? wall.a : glm::mix(wall.a, wall.b, a / (a - b)),
                                 b >= 0.0 ? wall.b : glm::mix(wall.a, wall.b, a / (a - b))})
        if (side * cross(direct, corner - from) > 1e-6 * direct_m) corners.push_back(corner);
      for (int end = 0; end < 2; ++end)
        if ((end == 0 ? a : b) >= 0.0)
          open.insert(open.end(), neighbours_[std::size_t(index)][std::size_t(end)].begin(),
                      neighbours_[std::size_t(index)][std::size_t(end)].end());
    }
  };
  constexpr int max_rounds = 16;
  for (int round = 0; round < max_rounds; ++round) {
    bool is_free = true;
    const std::size_t before = reached.size();
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      for (const Crossing& crossing : crossings(path[i], path[i + 1])) {
        const Wall& wall = walls_[std::size_t(crossing.wall)];
        const double wall_m = glm::distance(wall.a, wall.b), u_m = crossing.fraction * wall_m;
        if (round > 0 && (u_m < touch_m || u_m > wall_m - touch_m)) continue;  // the path touches a corner
        if (height_over_ray(glm::mix(wall.a, wall.b, crossing.fraction), top_at(wall, crossing.fraction)) <=
            1e-3)
          continue;
        is_free = false;
        add_joined(crossing.wall);
      }
    for (std::size_t i = 0; i + 1 < path.size() && round > 0;
         ++i) {                                 // from corner to corner inside a building
      const dvec2 leg = path[i + 1] - path[i];  // along a wall: its middle lies a touch outside
      const dvec2 middle = path[i] + 0.5 * leg + side * touch_m * glm::normalize(dvec2(-leg.y, leg.x));
      if (const auto roof = terrain_.roof_z(middle); roof && height_over_ray(middle, *roof) > 1e-3) return {};
    }
    if (is_free) return {path.begin() + 1, path.end() - 1};
    if (reached.size() == before) return {};
    path = hull_side(from, to, corners, side);
    if (path.empty()) return {};
    double length_m = 0.0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) length_m += glm::distance(path[i], path[i + 1]);
    if (length_m > max_length_m) return {};
  }
  return {};
}

std::vector<dvec2> Site::reflected_line(const Place& source, const Place& receiver,
                                        std::span<const int> walls) const {
  std::vector<dvec2> images{dvec2(source)};
  for (const int wall : walls) images.push_back(mirrored(images.back(), walls_[std::size_t(wall)]));
  std::vector<dvec2> line{dvec2(receiver)};
  for (std::size_t i = walls.size(); i-- > 0;) {
    const Wall& wall = walls_[std::size_t(walls[i])];
    const std::optional<dvec2> at = intersection(images[i + 1], line.back(), wall.a, wall.b);
    if (!at || at->x <= 0.0 || at->x >= 1.0 || at->y < 0.0 || at->y > 1.0) return {};
    line.push_back(glm::mix(wall.a, wall.b, at->y));
  }
  line.push_back(dvec2(source));
  std::ranges::reverse(line);
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {  // before each wall the path lies outdoors
    const dvec2 back = line[i - 1] - line[i];
    const double back_m = glm::length(back);
    if (back_m > 1e-6 && terrain_.roof_z(line[i] + back * (std::min(0.05, 0.5 * back_m) / back_m))) return {};
  }
  return line;
}

std::optional<Site::WallHit> Site::reflecting_wall(dvec2 from, dvec2 to, int but) const {
  const int hit = rays_->nearest(
      from, to, [&](int wall) { return wall != but && walls_[std::size_t(wall)].absorption.has_value(); });
  if (hit < 0) return std::nullopt;
  const Wall& wall = walls_[std::size_t(hit)];
  const std::optional<dvec2> at = intersection(from, to, wall.a, wall.b);
  if (!at || at->x < 0.0) return std::nullopt;
  return WallHit{hit, at->x * glm::distance(from, to), top_at(wall, at->y)};
}

dvec2 Site::turned_by(int wall, dvec2 direction) const {
  const Wall& mirror = walls_[std::size_t(wall)];
  const dvec2 normal = glm::normalize(dvec2(mirror.a.y - mirror.b.y, mirror.b.x - mirror.a.x));
  return direction - 2.0 * glm::dot(direction, normal) * normal;
}

std::vector<WallSequence> Site::sequences_seen_from(dvec2 receiver, const PathChoice& choice) const {
  std::set<WallSequence> found;
  for (int i = 0; i < choice.directions && choice.reflections > 0; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / choice.directions;
    dvec2 from = receiver, along(std::cos(angle), std::sin(angle));
    double left_m = choice.max_length_m;
    WallSequence sequence;
    for (int order = 0; order < choice.reflections; ++order) {
      const auto hit = reflecting_wall(from, from + along * left_m, sequence.empty() ? -1 : sequence.front());
      if (!hit) break;
      sequence.insert(sequence.begin(), hit->wall);  // from the source to the receiver
      found.insert(sequence);
      from += along * hit->distance_m;
      left_m -= hit->distance_m;
      along = turned_by(hit->wall, along);
    }
  }
  return {found.begin(), found.end()};
}

Octaves Site::over(const Place& source, const Place& receiver, const Octaves& air_db_per_m,
                   Condition condition) const {
  const dvec2 line[]{dvec2(source), dvec2(receiver)};
  return attenuation_over(profile(line, source.z, receiver.z), air_db_per_m, condition);
}

Octaves Site::around(const Place& source, const Place& receiver, std::span<const dvec2> corners,
                     const Octaves& air_db_per_m, Condition condition) const {
  // Corners lie in the plane through source and receiver that is level across the line between them.
  const dvec2 direct = dvec2(receiver) - dvec2(source);
  std::vector<dvec2> line{dvec2(source)};
  line.insert(line.end(), corners.begin(), corners.end());
  line.emplace_back(receiver);
  Detour detour;
  detour.direct_m = glm::distance(source, receiver);
  const auto in_space = [&](dvec2 p) {
    return Place(
        p, glm::mix(source.z, receiver.z, glm::dot(p - dvec2(source), direct) / glm::dot(direct, direct)));
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double leg_m = glm::distance(in_space(line[i]), in_space(line[i + 1]));
    detour.path_m += leg_m;
    if (i > 0 && i + 2 < line.size()) detour.between_m += leg_m;
  }
  return attenuation_around(profile(line, source.z, receiver.z), detour, air_db_per_m, condition);
}

std::optional<Octaves> Site::reflected(const Place& source, const Place& receiver, std::span<const int> walls,
                                       const Octaves& air_db_per_m, Condition condition) const {
  const std::vector<dvec2> line = reflected_line(source, receiver, walls);
  if (line.empty()) return std::nullopt;
  const Profile unfolded = profile(line, source.z, receiver.z);
  std::vector<Reflector> reflectors;
  double distance_m = 0.0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Wall& wall = walls_[std::size_t(walls[i])];
    const dvec2 place = line[i + 1];
    distance_m += glm::distance(line[i], place);
    const double top =
        top_at(wall, glm::distance(wall.a, place) / std::max(glm::distance(wall.a, wall.b), 1e-9));
    reflectors.push_back({distance_m, top, wall.absorption.value_or(Octaves{})});
  }
  const std::optional<Octaves> loss = reflection_loss(unfolded, reflectors, condition);
  if (!loss) return std::nullopt;
  Octaves result = attenuation_over(unfolded, air_db_per_m, condition);
  for (std::size_t i = 0; i < octaves; ++i) result[i] += (*loss)[i];
  return result;
}

Octaves Site::grazing_loss(const Place& source, const Place& receiver) const {
  const dvec2 from(source), direct = dvec2(receiver) - from;
  const double square = glm::dot(direct, direct), direct_m = glm::distance(source, receiver);
  if (square < 1.0) return {};
  for (const Crossing& crossing : crossings(from, dvec2(receiver))) {
    const Wall& wall = walls_[std::size_t(crossing.wall)];
    const double ray = glm::mix(source.z, receiver.z, crossing.distance_m / std::sqrt(square));
    if (top_at(wall, crossing.fraction) > ray) return {};
  }
  constexpr double reach_m = 0.3;  // beyond this path difference the lowest octave loses nothing
  double nearest_m = reach_m;
  for (const Place& end : ends_) {
    const double t = glm::dot(dvec2(end) - from, direct) / square;
    if (t <= 0.0 || t >= 1.0) continue;
    const Place corner(dvec2(end), glm::mix(source.z, receiver.z, t));
    if (end.z > corner.z)
      nearest_m =
          std::min(nearest_m, glm::distance(source, corner) + glm::distance(corner, receiver) - direct_m);
  }
  return nearest_m < reach_m ? edge_loss_db(-nearest_m) : Octaves{};
}

Transfer Site::transfer(const Place& source, const Place& receiver, std::span<const WallSequence> sequences,
                        const PathChoice& choice, const Octaves& air_db_per_m) const {
  Transfer result;
  for (const Condition condition : {Condition::homogeneous, Condition::favourable}) {
    Octaves sum{};
    const auto add = [&](const Octaves& attenuation_db) {
      for (std::size_t i = 0; i < octaves; ++i) sum[i] += energy(-attenuation_db[i]);
    };
    add(over(source, receiver, air_db_per_m, condition));
    if (choice.is_lateral)
      for (const bool is_left : {true, false})
        if (const auto corners = corners_around(source, receiver, condition, is_left, choice.max_length_m);
            !corners.empty())
          add(around(source, receiver, corners, air_db_per_m, condition));
    for (const WallSequence& walls : sequences)
      if (const auto attenuation = reflected(source, receiver, walls, air_db_per_m, condition))
        add(*attenuation);
    Octaves& levels = condition == Condition::homogeneous ? result.homogeneous_db : result.favourable_db;
    for (std::size_t i = 0; i < octaves; ++i) levels[i] = level(sum[i]);
  }
  return result;
}

}  // namespace parvis::propagation
