#include "places/square/layout.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/colour.h"
#include "synthesis/shop_texture.h"

namespace parvis::square {
namespace {

constexpr float depth_m = 14.0f, arcade_bay_m = 4.25f, street_bay_m = 3.2f;
constexpr float whole_within_m = 75.0f;  // of the square's middle; beyond it facades are plain

glm::vec3 colour(int srgb) { return linear_from_srgb8(srgb >> 16 & 255, srgb >> 8 & 255, srgb & 255); }

/// One architecture for the whole square; its owners repaint it at different times.
FacadeStyle square_style(Random& random) {
  FacadeStyle style;
  style.ground = GroundFloor::arcade;
  style.ground_m = 5.9f, style.floors_m = {4.1f, 3.7f, 3.2f}, style.cornice_out_m = 0.8f;
  constexpr std::array<int, 4> ochres{0xD2A470, 0xCC9A64, 0xD9B080, 0xC8945E};
  style.wall = colour(ochres[std::size_t(random.index(int(ochres.size())))]) * random.uniform(0.94f, 1.04f);
  style.trim = colour(0xE9DCC0) * 0.92f;
  style.shutter = colour(random.chance(0.5f) ? 0x5E7F6B : 0x557A6A);
  style.balconies = 0.36f, style.has_pediments = true;
  style.shop_strip = random.index(synthesis::shop_strips);
  return style;
}

FacadeStyle street_style(Random& random, bool is_near, int before) {
  struct Paint {
    int wall, trim, shutter;
  };
  constexpr std::array<Paint, 7> paints{{{0xD8A08C, 0xEADFC8, 0x6F8FA3},
                                         {0xEADFC8, 0xD8CDB4, 0x8A6B4F},
                                         {0xC98F52, 0xE6D9BC, 0x5E7F6B},
                                         {0xE6C089, 0xEFE4CC, 0x6F8FA3},
                                         {0xBF6A45, 0xE2D3B4, 0x7C8A80},
                                         {0xCBBFA8, 0xDDD2BC, 0x8A6B4F},
                                         {0xE0B48E, 0xEADFC8, 0x5E7F6B}}};
  const Paint& paint = paints[std::size_t(before + 1 + random.index(int(paints.size()) - 1)) % paints.size()];
  FacadeStyle style;
  style.detail = is_near ? FacadeDetail::whole : FacadeDetail::plain;
  style.ground_m = random.uniform(4.2f, 4.8f), style.cornice_out_m = random.uniform(0.4f, 0.6f);
  style.floors_m.assign(std::size_t(3 + random.index(3)), 3.3f);
  style.floors_m.front() = random.uniform(3.4f, 3.6f), style.floors_m.back() = random.uniform(2.9f, 3.1f);
  style.wall = colour(paint.wall) * random.uniform(0.92f, 1.03f);
  style.trim = colour(paint.trim) * 0.92f, style.shutter = colour(paint.shutter);
  style.balconies = random.chance(0.5f) ? 0.4f : 0.1f;
  style.shop_strip = random.index(synthesis::ground_floor_strips);
  return style;
}

class Planner {
 public:
  explicit Planner(std::uint64_t seed) : random_(seed, 41) {}

  /// A row of houses of the square from a corner along a direction.
  void square_row(glm::vec2 from, glm::vec2 along, float length, bool left_front, bool right_front) {
    const int bays = std::max(2, int(std::lround(length / arcade_bay_m)));
    const int parts = std::max(1, int(std::lround(float(bays) / 6.0f)));
    for (int part = 0; part < parts; ++part) {
      const int first = bays * part / parts, last = bays * (part + 1) / parts;
      const float bay_m = length / float(bays);
      Building& house = add(from + along * bay_m * float(first), along, bay_m * float(last - first));
      house.style = square_style(random_), house.bays = last - first;
      house.is_on_square = true;
      house.has_left_front = left_front && part == 0,
      house.has_right_front = right_front && part + 1 == parts;
      house.closes_left = !left_front && part == 0, house.closes_right = !right_front && part + 1 == parts;
    }
  }

  /// Houses of a street, each of its own width, height and colour.
  void street_row(glm::vec2 from, glm::vec2 along, float length, bool left_front = false) {
    int before = random_.index(7);
    for (float at = 0.0f; at < length - 4.0f;) {
      float width = random_.uniform(9.0f, 16.0f);
      if (length - at - width < 8.0f) width = length - at;
      Building& house = add(from + along * at, along, width);
      const glm::vec2 middle = from + along * (at + 0.5f * width);
      house.style = street_style(random_, glm::length(middle) < whole_within_m, before);
      house.bays = std::max(2, int(std::lround(width / street_bay_m)));
      house.has_left_front = left_front && at == 0.0f;
      before = (before + 2) % 7;
      at += width;
    }
  }

  std::vector<Building> houses;

 private:
  Building& add(glm::vec2 corner, glm::vec2 along, float width) {
    Building& house = houses.emplace_back();
    house.frame = {glm::vec3(corner, kerb_m), glm::vec3(along, 0.0f), {-along.y, along.x, 0.0f}};
    house.width_m = width, house.depth_m = depth_m;
    return house;
  }

  Random random_;
};

}  // namespace

std::vector<Building> plan_houses(std::uint64_t seed) {
  Planner plan(seed);
  const glm::vec2 to_east(1, 0), to_west(-1, 0), to_north(0, 1), to_south(0, -1);
  const float tram_left = tram_x - tram_half_m, tram_right = tram_x + tram_half_m;
  // The northern side, the eastern one from its street southward, the southern and the western one.
  // Its gallery reaches the shops behind that of the western side.
  plan.square_row({west_m - gallery_m, north_m}, to_east, tram_left - west_m + gallery_m, false, true);
  plan.square_row({tram_right, north_m}, to_east, street_west_line_m - tram_right, true, true);
  plan.square_row({east_m, north_m + depth_m}, to_south, north_m + depth_m - avenue_north_line_m, false,
                  true);
  plan.square_row({east_m + depth_m, south_m}, to_west, east_m + depth_m - lane_x - lane_half_m, false, true);
  plan.square_row({lane_x - lane_half_m, south_m}, to_west, lane_x - lane_half_m - west_m + depth_m, true,
                  false);
  plan.square_row({west_m, avenue_north_line_m}, to_north, tram_y - tram_half_m - avenue_north_line_m, true,
                  true);
  plan.square_row({west_m, tram_y + tram_half_m}, to_north, north_m - tram_y - tram_half_m, true, false);
  plan.houses.back().closes_right = false;  // there the northern one begins
  const float out = reach_m - 12.0f;
  // The avenue, west and east.
  plan.street_row({-out, avenue_north_line_m}, to_east, out + west_m - depth_m);
  plan.street_row({east_m + depth_m, avenue_north_line_m}, to_east, out - east_m - depth_m);
  plan.street_row({west_m - depth_m, south_m}, to_west, out + west_m - depth_m);
  plan.street_row({out, south_m}, to_west, out - east_m - depth_m);
  // The street that leads north from the eastern side.
  plan.street_row({street_west_line_m, north_m + depth_m}, to_north, out - north_m - depth_m);
  plan.street_row({east_m, out}, to_south, out - north_m - depth_m);
  // The lane southward.
  plan.street_row({lane_x + lane_half_m, south_m - depth_m}, to_south, out + south_m - depth_m);
  plan.street_row({lane_x - lane_half_m, -out}, to_north, out + south_m - depth_m);
  // The tram's streets.
  plan.street_row({tram_left, north_m + depth_m}, to_north, out - north_m - depth_m - 30.0f);
  plan.street_row({tram_right, out - 8.0f}, to_south, out - 8.0f - north_m - depth_m);
  plan.street_row({-out, tram_y + tram_half_m}, to_east, out + west_m - depth_m);
  plan.street_row({west_m - depth_m, tram_y - tram_half_m}, to_west, out + west_m - depth_m);
  // What closes the streets.
  plan.street_row({-reach_m, -60.0f}, to_north, 110.0f);
  plan.street_row({reach_m, 10.0f}, to_south, 80.0f);
  plan.street_row({-30.0f, reach_m}, to_east, 110.0f);
  plan.street_row({20.0f, -reach_m}, to_west, 80.0f);
  return std::move(plan.houses);
}

}  // namespace parvis::square
