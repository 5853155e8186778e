#include "places/kerbside/kerb_places.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "synthesis/place_seed.h"

namespace parvis::kerbside {
namespace {

using glm::vec2, glm::vec3;

constexpr float before_crossing_m = 7.0f;
constexpr float fastest_m_s = 22.5f;  // 81 km/h: along motorways and their like nothing stands, nor parks
constexpr float wide_lane_m = 4.8f;   // a car stands beside the kerb and another passes it
constexpr float from_kerb_m = 1.05f;  // of the middle of a car on such a lane

float length_of(const scene::Lane& lane) {
  float sum = 0.0f;
  for (std::size_t i = 0; i + 1 < lane.points.size(); ++i)
    sum += glm::distance(vec2(lane.points[i]), vec2(lane.points[i + 1]));
  return sum;
}

/// Calls `each` with points at equal distances along a lane, and the lane's direction there.
template <class Each>
void each_along(const scene::Lane& lane, float first_m, float last_m, float spacing_m, Each&& each) {
  float begins_m = 0.0f, next_m = first_m;
  for (std::size_t i = 0; i + 1 < lane.points.size(); ++i) {
    const vec3 a = lane.points[i], b = lane.points[i + 1];
    const float length_m = glm::distance(vec2(a), vec2(b));
    for (; length_m > 0.0f && next_m <= std::min(begins_m + length_m, last_m); next_m += spacing_m)
      each(glm::mix(a, b, (next_m - begins_m) / length_m), (vec2(b) - vec2(a)) / length_m);
    begins_m += length_m;
  }
}

/// Calls `at` with points at most `radius` apart along the length of a thing, until one gives false.
template <class At>
bool all_along(vec2 middle, vec2 along, const KerbSeries& series, At&& at) {
  const int steps = int(std::ceil(2.0f * series.half_length_m / series.radius_m));
  for (int i = 0; i <= steps; ++i) {
    const float place = steps == 0 ? 0.0f : 2.0f * float(i) / float(steps) - 1.0f;
    if (!at(middle + place * series.half_length_m * along)) return false;
  }
  return true;
}

}  // namespace

std::vector<KerbPlace> take_kerb_places(const scene::RoadGraph& roads, const KerbSeries& series,
                                        FreeGround& ground) {
  std::vector<KerbPlace> places;
  Random random(synthesis::place_seed, 301);
  for (const scene::Lane& lane : roads.lanes) {
    if (lane.crossing >= 0 || lane.speed_limit > fastest_m_s) continue;
    const bool is_on_lane = series.stands_on_wide_lanes && lane.width_m >= wide_lane_m;
    const float beside_m = 0.5f * lane.width_m + (is_on_lane ? -from_kerb_m : series.beside_m);
    const float end_m = before_crossing_m + series.half_length_m;
    each_along(lane, end_m, length_of(lane) - end_m, series.spacing_m, [&](vec3 middle, vec2 along) {
      for (const bool is_left : {false, true}) {
        const vec2 right(along.y, -along.x), foot = vec2(middle) + (is_left ? -beside_m : beside_m) * right;
        const auto is_free = [&](vec2 p) {
          return ground.is_free(p, series.radius_m, is_on_lane ? 0.0f : series.from_lanes_m,
                                series.from_decks_m);
        };
        // Chance decides about places outside the circle, too: a wider one changes none of those inside.
        const bool is_taken = random.chance(series.share);
        if (!is_taken || (series.circle && !series.circle->contains(foot)) ||
            !all_along(foot, along, series, is_free))
          continue;
        const float half_m = series.half_length_m;
        const auto height = [&](float ahead_m) { return ground.height(foot + ahead_m * along, middle.z); };
        const float rise = half_m > 0.0f ? (height(half_m) - height(-half_m)) / (2.0f * half_m) : 0.0f;
        places.push_back({vec3(foot, height(0.0f)), along, is_left, rise});
        all_along(foot, along, series, [&](vec2 p) { return ground.take(p, series.radius_m), true; });
      }
    });
  }
  return places;
}

}  // namespace parvis::kerbside
