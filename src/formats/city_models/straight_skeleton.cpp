#include "formats/city_models/straight_skeleton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;
using Face = std::vector<int>;

// Points that are nearer are one. Where corners all but coincide, one of these distances separates them.
constexpr std::array<double, 3> touching_distances_m{0.005, 1e-4, 1e-6};
constexpr double shortest_edges = 4.0;                 // of an outline, in touching distances
constexpr double parallel = 1e-9;                      // sine of the angle
constexpr double soonest_m = 1e-10;                    // an event that is nearer has been handled
constexpr double beside_end_m = 0.05;                  // of an edge's end: events that may be none do no harm
constexpr double same_area = 1e-3, min_area_m2 = 1.0;  // of all faces and the outline

dvec2 left_of(dvec2 direction) { return {-direction.y, direction.x}; }

/// A moving edge, or the piece of one between two events.
struct Front {
  int edge;  ///< of the outline
  std::size_t previous = 0, next = 0;
  int begun_at = 0;  ///< the skeleton's point from which the path of the front's start comes
  dvec2 start{0.0}, velocity{0.0};
};

/// A front from one place of an event to another.
struct Piece {
  int edge;
  std::size_t from, to;  ///< places
  bool is_gone = false;
};

/// Where the starts of one or more fronts are.
struct Place {
  dvec2 at;
  std::vector<std::size_t> fronts;
  bool is_event = false;
  int point = 0;  ///< of the skeleton, from which the paths of its fronts come
};

class Wavefront {
 public:
  Wavefront(const std::vector<std::vector<dvec2>>& rings, double touching_m) : touching_m_(touching_m) {
    for (const std::vector<dvec2>& ring : rings) {
      const std::size_t first = fronts_.size(), count = ring.size();
      for (std::size_t i = 0; i < count; ++i) {
        const dvec2 along = ring[(i + 1) % count] - ring[i];
        if (!(glm::length(along) > shortest_edges * touching_m)) is_sound_ = false;
        directions_.push_back(glm::normalize(along));
        const int edge = int(fronts_.size()), after = int(first + (i + 1) % count);
        fronts_.push_back({edge, first + (i + count - 1) % count, std::size_t(after), edge, ring[i]});
        skeleton_.points.emplace_back(ring[i], 0.0);
        borders_.push_back({{edge, after}});
      }
    }
    is_sound_ = is_sound_ && fronts_.size() >= 3;
  }

  std::optional<StraightSkeleton> run() {
    if (!is_sound_) return std::nullopt;
    set_velocities();
    const std::size_t max_events = 20 * fronts_.size() + 100;
    for (std::size_t i = 0; is_sound_ && !fronts_.empty(); ++i) {
      const double step_m = to_next_event_m();
      if (i > max_events || !std::isfinite(step_m)) return std::nullopt;
      now_m_ += step_m;
      for (Front& front : fronts_) front.start += step_m * front.velocity;
      handle_event();
    }
    if (!is_sound_ || !trace_faces()) return std::nullopt;
    return std::move(skeleton_);
  }

 private:
  dvec2 direction(const Front& front) const { return directions_[std::size_t(front.edge)]; }

  /// A corner keeps its distance from the lines of both edges equal to the distance that they have moved.
  void set_velocities() {
    for (Front& front : fronts_) {
      const dvec2 in = direction(fronts_[front.previous]), out = direction(front);
      const double sine = cross_in_plan(in, out);
      if (std::abs(sine) > parallel)
        front.velocity = (out - in) / sine;
      else if (glm::dot(in, out) > 0.0)
        front.velocity = left_of(in);
      else
        is_sound_ = false;  // edges that lie on each other have been taken out
    }
  }

  /// How far the edges move until two corners, or a corner and an edge, may touch.
  double to_next_event_m() const {
    double soonest = HUGE_VAL;
    for (const Front& front : fronts_) {
      const dvec2 along = direction(front), inward = left_of(along);
      const Front& end = fronts_[front.next];
      const double length = glm::dot(end.start - front.start, along),
                   growth = glm::dot(end.velocity - front.velocity, along);
      if (growth < 0.0 && length / -growth > soonest_m) soonest = std::min(soonest, length / -growth);
      for (const Front& corner : fronts_) {
        if (cross_in_plan(direction(fronts_[corner.previous]), direction(corner)) >= 0.0)
          continue;  // not reflex
        if (&corner == &front || &corner == &end) continue;
        const double closing = 1.0 - glm::dot(corner.velocity, inward);
        const double step_m = glm::dot(corner.start - front.start, inward) / closing;
        if (!(closing > 0.0) || !(step_m > soonest_m) || step_m >= soonest) continue;
        const double hit = glm::dot(corner.start + step_m * corner.velocity, along),
                     from = glm::dot(front.start + step_m * front.velocity, along),
                     to = glm::dot(end.start + step_m * end.velocity, along);
        if (hit > from - beside_end_m && hit < to + beside_end_m) soonest = step_m;
      }
    }
    return soonest;
  }

  void handle_event() {
    std::vector<std::size_t> place_of(fronts_.size());
    std::vector<Place> places = gather(place_of);
    std::vector<Piece> pieces = cut(places, place_of);
    if (std::ranges::none_of(places, &Place::is_event)) return;
    for (Place& place : places) {
      place.point = place.is_event ? int(skeleton_.points.size()) : fronts_[place.fronts.front()].begun_at;
      if (!place.is_event) continue;
      skeleton_.points.emplace_back(place.at, now_m_);
      for (const std::size_t i : place.fronts) {
        border(fronts_[fronts_[i].previous].edge, fronts_[i].begun_at, place.point);
        border(fronts_[i].edge, place.point, fronts_[i].begun_at);
      }
    }
    take_out_ridges(pieces, places);
    link(pieces, places);
    set_velocities();
  }

  /// Places of all corners; corners that touch share one.
  std::vector<Place> gather(std::vector<std::size_t>& place_of) const {
    std::vector<Place> places;
    for (std::size_t i = 0; i < fronts_.size(); ++i) {
      std::size_t found = 0;
      while (found < places.size() && glm::distance(places[found].at, fronts_[i].start) > touching_m_)
        ++found;
      if (found == places.size())
        places.push_back({fronts_[i].start, {}});
      else
        places[found].is_event = true;
      places[found].fronts.push_back(i);
      place_of[i] = found;
    }
    return places;
  }

  /// The fronts, cut at corners that touch them; those without length are left out.
  std::vector<Piece> cut(std::vector<Place>& places, const std::vector<std::size_t>& place_of) const {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < fronts_.size(); ++i) {
      const std::size_t from = place_of[i], to = place_of[fronts_[i].next];
      if (from == to) continue;
      const dvec2 start = places[from].at, along = places[to].at - start;
      const double length = glm::length(along);
      std::vector<std::pair<double, std::size_t>> stops{{length, to}};
      for (std::size_t place = 0; place < places.size(); ++place) {
        const dvec2 offset = places[place].at - start;
        const double at = glm::dot(offset, along) / length;
        if (place == from || place == to || at <= 0.0 || at >= length) continue;
        if (std::abs(cross_in_plan(along, offset)) > touching_m_ * length) continue;
        stops.emplace_back(at, place);
        places[place].is_event = true;
      }
      std::ranges::sort(stops);
      std::size_t last = from;
      for (const auto& [at, place] : stops) pieces.push_back({fronts_[i].edge, last, place}), last = place;
    }
    return pieces;
  }

  /// Edges that have met along their length: a ridge between their faces.
  void take_out_ridges(std::vector<Piece>& pieces, const std::vector<Place>& places) {
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (std::size_t k = i + 1; k < pieces.size() && !pieces[i].is_gone; ++k) {
        if (pieces[k].is_gone || pieces[i].from != pieces[k].to || pieces[i].to != pieces[k].from) continue;
        const int from = places[pieces[i].from].point, to = places[pieces[i].to].point;
        border(pieces[i].edge, to, from), border(pieces[k].edge, from, to);
        pieces[i].is_gone = pieces[k].is_gone = true;
      }
    std::erase_if(pieces, [](const Piece& piece) { return piece.is_gone; });
  }

  /// Pieces become fronts. Each is followed by the one that bounds the same region: the first clockwise, seen
  /// from their common place.
  void link(const std::vector<Piece>& pieces, const std::vector<Place>& places) {
    std::vector<Front> fronts;
    fronts.reserve(pieces.size());
    for (const Piece& piece : pieces)
      fronts.push_back({piece.edge, pieces.size(), 0, places[piece.from].point, places[piece.from].at});
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const dvec2 back = -directions_[std::size_t(pieces[i].edge)];
      double least = 3.0 * std::numbers::pi;
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (pieces[k].from != pieces[i].to) continue;
        const dvec2 out = directions_[std::size_t(pieces[k].edge)];
        double clockwise = -std::atan2(cross_in_plan(back, out), glm::dot(back, out));
        if (clockwise < parallel) clockwise += 2.0 * std::numbers::pi;
        if (clockwise < least) least = clockwise, fronts[i].next = k;
      }
      if (least > 2.5 * std::numbers::pi || fronts[fronts[i].next].previous != pieces.size())
        is_sound_ = false;  // no successor, or two fronts with the same one: rings that cross
      else
        fronts[fronts[i].next].previous = i;
    }
    fronts_ = is_sound_ ? std::move(fronts) : std::vector<Front>();
  }

  void border(int edge, int from, int to) {
    if (from != to) borders_[std::size_t(edge)].emplace_back(from, to);
  }

  /// Joins the borders of each face to one ring. False where that cannot be, or where the faces do not cover
  /// the outline: the rings have crossed.
  bool trace_faces() {
    double outline_m2 = 0.0, faces_m2 = 0.0;
    for (const std::vector<std::pair<int, int>>& border : borders_) {
      std::map<int, int> after;
      for (const auto& [from, to] : border) {
        if (const auto back = after.find(to); back != after.end() && back->second == from)
          after.erase(back);
        else if (!after.emplace(from, to).second)
          return false;
      }
      Face face;
      for (int at = border.front().first; after.contains(at) && face.size() <= after.size();) {
        face.push_back(at);
        const auto step = after.find(at);
        at = step->second;
        if (at == border.front().first) break;
      }
      if (face.size() < 3 || face.size() != after.size() || after.at(face.back()) != face.front())
        return false;
      outline_m2 += doubled_area_m2({face[0], face[1]});
      const double face_m2 = doubled_area_m2(face);
      if (face_m2 < 0.0) return false;
      faces_m2 += face_m2;
      skeleton_.faces.push_back(std::move(face));
    }
    return std::abs(faces_m2 - outline_m2) <= same_area * std::max(outline_m2, min_area_m2);
  }

  /// Twice the area in plan of a ring of points; of an edge: its share of the outline's.
  double doubled_area_m2(const Face& ring) const {
    const dvec2 origin(skeleton_.points.front());
    const auto at = [&](std::size_t i) {
      return dvec2(skeleton_.points[std::size_t(ring[i % ring.size()])]) - origin;
    };
    if (ring.size() == 2) return cross_in_plan(at(0), at(1));
    double area = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) area += cross_in_plan(at(i), at(i + 1));
    return area;
  }

  std::vector<Front> fronts_;
  std::vector<dvec2> directions_;  ///< of the outline's edges
  std::vector<std::vector<std::pair<int, int>>>
      borders_;  ///< of each face: from point to point, its edge first
  StraightSkeleton skeleton_;
  double touching_m_;
  double now_m_ = 0.0;  ///< how far the edges have moved
  bool is_sound_ = true;
};

}  // namespace

double StraightSkeleton::highest_m() const {
  double highest = 0.0;
  for (const dvec3& point : points) highest = std::max(highest, point.z);
  return highest;
}

std::optional<StraightSkeleton> straight_skeleton(const std::vector<std::vector<dvec2>>& rings) {
  std::size_t corners = 0;
  for (const std::vector<dvec2>& ring : rings) {
    if (ring.size() < 3) return std::nullopt;
    corners += ring.size();
  }
  if (corners > max_skeleton_corners) return std::nullopt;
  for (const double touching_m : touching_distances_m)
    if (std::optional<StraightSkeleton> found = Wavefront(rings, touching_m).run()) return found;
  return std::nullopt;
}

}  // namespace parvis::scene
