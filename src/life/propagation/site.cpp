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

/// The corner that a line in clear sight passes most nearly.
struct Site::Grazed {
  double difference_m;  ///< by which the way by the corner is longer
  double from_begin_m;
};

/// An upright edge of a wall.
struct Site::End {
  dvec2 place{0.0};
  double top = 0.0, bottom = 0.0;
};

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
    ends_.push_back({wall.a, wall.top_a, wall.bottom});
    ends_.push_back({wall.b, wall.top_b, wall.bottom});
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

/// Walls that a straight line in space does not pass below.
std::vector<Site::Crossing> Site::crossings(const Place& begin, const Place& end) const {
  std::vector<Crossing> found;
  const dvec2 from(begin), to(end);
  const double length_m = glm::distance(from, to);
  rays_->for_each_near(from, to, [&](int index) {
    const Wall& wall = walls_[std::size_t(index)];
    const std::optional<dvec2> at = intersection(from, to, wall.a, wall.b);
    if (!at || glm::mix(begin.z, end.z, at->x) < wall.bottom) return;
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

void Site::add_leg(const Place& begin_of_leg, const Place& end_of_leg, double offset_m,
                   Profile& profile) const {
  const dvec2 from(begin_of_leg), to(end_of_leg);
  const double length_m = glm::distance(from, to);
  if (length_m < 1e-9) return;
  const dvec2 along = (to - from) / length_m;
  const std::vector<Crossing> crossed = crossings(begin_of_leg, end_of_leg);
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
    const double z = glm::mix(begin_of_leg.z, end_of_leg.z, 0.5 * (begin + end) / length_m);
    if (const std::optional<double> roof =
            is_between_walls && terrain_.is_built(middle, z) ? terrain_.roof_z(middle) : std::nullopt) {
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
  double offset_m = 0.0, length_m = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length_m += glm::distance(line[i], line[i + 1]);
  const auto in_space = [&](std::size_t i, double at_m) {
    return Place(line[i], glm::mix(source_z, receiver_z, at_m / std::max(length_m, 1e-9)));
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double next_m = offset_m + glm::distance(line[i], line[i + 1]);
    add_leg(in_space(i, offset_m), in_space(i + 1, next_m), offset_m, result);
    offset_m = next_m;
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
  const auto ray_z = [&](dvec2 place) {
    const double along_m = glm::clamp(glm::dot(place - from, direct) / direct_m, 0.0, direct_m);
    return glm::mix(source.z, receiver.z, along_m / direct_m) + rise_of_ray(along_m, direct_m, condition);
  };
  const auto height_over_ray = [&](dvec2 place, double top) { return top - ray_z(place); };
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
      if ((a < 0.0 && b < 0.0) || ray_z(wall.a) < wall.bottom || !reached.insert(index).second) continue;
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
      for (const Crossing& crossing :
           crossings(Place(path[i], ray_z(path[i])), Place(path[i + 1], ray_z(path[i + 1])))) {
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
      if (terrain_.is_built(middle, ray_z(middle)) &&
          height_over_ray(middle, *terrain_.roof_z(middle)) > 1e-3)
        return {};
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
    if (back_m > 1e-6 &&
        terrain_.is_built(line[i] + back * (std::min(0.05, 0.5 * back_m) / back_m), receiver.z))
      return {};
  }
  return line;
}

std::optional<Site::WallHit> Site::reflecting_wall(const Place& begin, const Place& end, int but) const {
  const dvec2 from(begin), to(end);
  const int hit = rays_->nearest(from, to, [&](int index) {
    const Wall& wall = walls_[std::size_t(index)];
    if (index == but || !wall.absorption) return false;
    const std::optional<dvec2> at = intersection(from, to, wall.a, wall.b);
    return !at || glm::mix(begin.z, end.z, at->x) >= wall.bottom;
  });
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

std::vector<WallSequence> Site::sequences_seen_from(const Place& receiver, const PathChoice& choice) const {
  std::set<WallSequence> found;
  for (int i = 0; i < choice.directions && choice.reflections > 0; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / choice.directions;
    dvec2 from(receiver), along(std::cos(angle), std::sin(angle));
    double left_m = choice.max_length_m;
    WallSequence sequence;
    for (int order = 0; order < choice.reflections; ++order) {
      const auto hit = reflecting_wall(Place(from, receiver.z), Place(from + along * left_m, receiver.z),
                                       sequence.empty() ? -1 : sequence.front());
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
                     const Octaves& air_db_per_m, Condition condition, bool softens_shadows) const {
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
  if (softens_shadows) {
    // Of the legs at both ends the one that passes another corner more nearly.
    const std::optional<Grazed> first = grazed(in_space(corners.front()), source),
                                last = grazed(in_space(corners.back()), receiver);
    if (const auto& near = !last || (first && first->difference_m < last->difference_m) ? first : last) {
      detour.with_grazed_m = detour.between_m + near->from_begin_m;
      const Octaves loss = edge_loss_db(-near->difference_m), full = edge_loss_db(0.0);
      for (std::size_t i = 0; i < octaves; ++i) detour.grazed[i] = loss[i] / full[i];
    }
  }
  return attenuation_around(profile(line, source.z, receiver.z), detour, air_db_per_m, condition);
}

std::optional<Octaves> Site::reflected(const Place& source, const Place& receiver, std::span<const int> walls,
                                       const Octaves& air_db_per_m, Condition condition) const {
  const auto path = reflected_path(source, receiver, walls, air_db_per_m, condition);
  return path ? std::optional(path->attenuation_db) : std::nullopt;
}

std::optional<SoundPath> Site::reflected_path(const Place& source, const Place& receiver,
                                              std::span<const int> walls, const Octaves& air_db_per_m,
                                              Condition condition) const {
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
    reflectors.push_back({distance_m, top, wall.bottom, wall.absorption.value_or(Octaves{})});
  }
  const std::optional<Octaves> loss = reflection_loss(unfolded, reflectors, condition);
  if (!loss) return std::nullopt;
  SoundPath result{attenuation_over(unfolded, air_db_per_m, condition), {}, unfolded.distance_m()};
  for (std::size_t i = 0; i < octaves; ++i) result.attenuation_db[i] += (*loss)[i];
  const double part = distance_m / std::max(unfolded.length_m(), 1e-9);
  result.comes_from = Place(line[line.size() - 2], glm::mix(source.z, receiver.z, part));
  return result;
}

std::optional<Site::Grazed> Site::grazed(const Place& from, const Place& to) const {
  const dvec2 begin(from), direct = dvec2(to) - begin;
  const double square = glm::dot(direct, direct), direct_m = glm::distance(from, to);
  constexpr double reach_m = 0.3;  // beyond this path difference the lowest octave loses nothing
  std::optional<Grazed> nearest;
  for (const End& end : ends_) {
    const double t = glm::dot(end.place - begin, direct) / square;
    const Place corner(end.place, glm::mix(from.z, to.z, t));
    if (t <= 0.0 || t >= 1.0 || end.top <= corner.z || corner.z < end.bottom ||
        glm::distance(corner, from) < touch_m)
      continue;
    const double difference_m = glm::distance(from, corner) + glm::distance(corner, to) - direct_m;
    if (difference_m < (nearest ? nearest->difference_m : reach_m))
      nearest = Grazed{difference_m, glm::distance(from, corner)};
  }
  return nearest;
}

/// The loss of clear sight past upright edges, dB by octave; 0 in the shadow.
Octaves Site::grazing_loss(const Place& source, const Place& receiver) const {
  const double length_m = glm::distance(dvec2(source), dvec2(receiver));
  if (length_m < 1.0) return {};
  for (const Crossing& crossing : crossings(source, receiver))
    if (top_at(walls_[std::size_t(crossing.wall)], crossing.fraction) >
        glm::mix(source.z, receiver.z, crossing.distance_m / length_m))
      return {};
  const std::optional<Grazed> nearest = grazed(source, receiver);
  return nearest ? edge_loss_db(-nearest->difference_m) : Octaves{};
}

std::vector<SoundPath> Site::paths(const Place& source, const Place& receiver,
                                   std::span<const WallSequence> sequences, const PathChoice& choice,
                                   const Octaves& air_db_per_m, Condition condition) const {
  const double direct_m = glm::distance(source, receiver);
  std::vector<SoundPath> result{{over(source, receiver, air_db_per_m, condition), source, direct_m, nullptr}};
  if (choice.softens_shadows) {
    const Octaves loss = grazing_loss(source, receiver);
    for (std::size_t i = 0; i < octaves; ++i) result[0].attenuation_db[i] += loss[i];
  }
  for (const bool is_left : {true, false}) {
    if (!choice.is_lateral) break;
    const auto corners = corners_around(source, receiver, condition, is_left, choice.max_length_m);
    if (corners.empty()) continue;
    const dvec2 last = corners.back();
    double length_m = glm::distance(dvec2(source), corners.front()) + glm::distance(last, dvec2(receiver));
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
      length_m += glm::distance(corners[i], corners[i + 1]);
    result.push_back(
        {around(source, receiver, corners, air_db_per_m, condition, choice.softens_shadows),
         Place(last, glm::mix(receiver.z, source.z, glm::distance(last, dvec2(receiver)) / length_m)),
         std::hypot(length_m, receiver.z - source.z), nullptr});
  }
  for (const WallSequence& walls : sequences)
    if (auto path = reflected_path(source, receiver, walls, air_db_per_m, condition)) {
      path->walls = &walls;
      result.push_back(*path);
    }
  return result;
}

Transfer Site::transfer(const Place& source, const Place& receiver, std::span<const WallSequence> sequences,
                        const PathChoice& choice, const Octaves& air_db_per_m) const {
  Transfer result;
  for (const Condition condition : {Condition::homogeneous, Condition::favourable}) {
    Octaves sum{};
    for (const SoundPath& path : paths(source, receiver, sequences, choice, air_db_per_m, condition))
      for (std::size_t i = 0; i < octaves; ++i) sum[i] += energy(-path.attenuation_db[i]);
    Octaves& levels = condition == Condition::homogeneous ? result.homogeneous_db : result.favourable_db;
    for (std::size_t i = 0; i < octaves; ++i) levels[i] = level(sum[i]);
  }
  return result;
}

}  // namespace parvis::propagation
