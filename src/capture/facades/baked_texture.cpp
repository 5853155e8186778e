#include "capture/facades/baked_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "capture/facades/facade_lookup.h"

namespace parvis::facades {
namespace {

constexpr int min_square = 8, max_square = 1024;
// Texels about a triangle that repeat what lies beyond its edge, so that filters find no other triangle; a
// square holds two, with as much between them.
constexpr int border = 1;
constexpr float coarser = 0.85f;  ///< from one try to the next

/// A triangle by the corner that becomes the square's, which is the one with the widest angle.
struct Half {
  std::array<int, 3> corner{0, 1, 2};
  float leg_m = 0.0f;   ///< the longer of the two edges there
  float texels = 0.0f;  ///< that it should have
  glm::vec3 to_eye{0.0f};
};

/// Pixels per metre of the photograph that is finest there, and the direction from which photographs look.
std::pair<float, glm::vec3> finest(const PackedFacade& facade, std::size_t triangle, glm::vec3 centre) {
  float pixels_per_m = 0.0f;
  glm::vec3 toward(0.0f);
  const glm::uvec2 list = facade.lists[triangle];
  for (std::uint32_t i = 0; i < list.y; ++i) {
    const View& view = facade.photos[facade.layers[facade.candidates[list.x + i]].photo].view;
    const glm::vec3 off = glm::vec3(view.centre) - centre;
    const float distance = std::max(glm::length(off), 1e-6f);
    pixels_per_m = std::max(pixels_per_m, float(view.fx) / distance);
    toward += off / distance;
  }
  return {pixels_per_m, toward};
}

Half half_of(const PackedFacade& facade, std::size_t triangle) {
  const glm::vec3* c = facade.corners.data() + 3 * triangle;
  const auto edge = [&](int k) { return glm::distance(c[(k + 1) % 3], c[(k + 2) % 3]); };  // opposite to k
  Half half;
  const int widest = edge(0) >= edge(1) && edge(0) >= edge(2) ? 0 : edge(1) >= edge(2) ? 1 : 2;
  half.corner = {widest, (widest + 1) % 3, (widest + 2) % 3};
  half.leg_m = std::max({edge(half.corner[1]), edge(half.corner[2]), 1e-9f});
  const auto [pixels_per_m, toward] = finest(facade, triangle, (c[0] + c[1] + c[2]) / 3.0f);
  half.texels = half.leg_m * pixels_per_m;
  const glm::vec3 across = glm::cross(c[1] - c[0], c[2] - c[0]);
  const float length = glm::length(across);
  const glm::vec3 normal = length > 0.0f ? across / length : glm::vec3(0, 0, 1);
  half.to_eye = glm::dot(normal, toward) < 0.0f ? -normal : normal;
  return half;
}

int square_of(const Half& half, float scale) {
  int side = min_square;
  while (side < max_square && float(side - 4 * border) < scale * half.texels) side *= 2;
  return side;
}

/// The place of the `index`-th square of min_square texels along Morton's curve: squares in descending order
/// lie along it without gaps.
glm::ivec2 place_of(std::uint64_t index) {
  glm::ivec2 place(0);
  for (int bit = 0; bit < 16; ++bit) {
    place.x |= int(index >> (2 * bit) & 1u) << bit;
    place.y |= int(index >> (2 * bit + 1) & 1u) << bit;
  }
  return place * min_square;
}

/// Two triangles, or one, in a square.
struct Square {
  std::array<std::uint32_t, 2> triangles{};
  int count = 0, side = 0;
  glm::ivec2 place{0};
};

/// Squares in descending order of their sides, two triangles each; `area` is theirs in texels.
std::vector<Square> squares_of(const std::vector<Half>& halves, float scale, std::uint64_t& area) {
  std::vector<std::uint32_t> order(halves.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<int> sides;
  for (const Half& half : halves) sides.push_back(square_of(half, scale));
  std::ranges::stable_sort(order, std::greater<>(), [&](std::uint32_t t) { return sides[t]; });
  std::vector<Square> squares;
  area = 0;
  for (const std::uint32_t t : order) {
    if (squares.empty() || squares.back().count == 2 || squares.back().side != sides[t]) {
      squares.push_back({{t, 0}, 0, sides[t], place_of(area / (min_square * min_square))});
      area += std::uint64_t(sides[t]) * std::uint64_t(sides[t]);
    }
    Square& square = squares.back();
    square.triangles[std::size_t(square.count++)] = t;
  }
  return squares;
}

/// Place of a square's point, in texels, along the two legs of the square's half `which`, 0 to 1.
glm::vec2 along_legs(const Square& square, int which, glm::vec2 at) {
  const float leg = float(square.side - 4 * border);
  return ((which == 0 ? at : float(square.side) - at) - float(border)) / leg;
}

void bake(const PackedFacade& facade, FacadeLookup& lookup, const std::vector<Half>& halves,
          const Square& square, Image8& picture) {
  for (int y = 0; y < square.side; ++y)
    for (int x = 0; x < square.side; ++x) {
      const int which = square.count == 2 && x + y >= square.side ? 1 : 0;
      const std::uint32_t t = square.triangles[std::size_t(which)];
      const Half& half = halves[t];
      const glm::vec2 legs = along_legs(square, which, glm::vec2(float(x) + 0.5f, float(y) + 0.5f));
      const auto corner = [&](std::size_t k) {
        return facade.corners[3 * std::size_t(t) + std::size_t(half.corner[k])];
      };
      const glm::vec3 point = corner(0) + legs.x * (corner(1) - corner(0)) + legs.y * (corner(2) - corner(0));
      glm::vec3 weights(0.0f);  // of the corners in the triangle's own order
      const glm::vec2 inside = glm::clamp(legs, glm::vec2(0.0f), glm::vec2(1.0f));
      const float excess = std::max(inside.x + inside.y, 1.0f);
      weights[half.corner[1]] = inside.x / excess, weights[half.corner[2]] = inside.y / excess;
      weights[half.corner[0]] = 1.0f - (inside.x + inside.y) / excess;
      const glm::vec4 colour =
          lookup.colour(t, point, half.to_eye, half.leg_m / float(square.side - 4 * border),
                        glm::vec2(weights.y, weights.z));
      std::uint8_t* p = picture.at(square.place.x + x, square.place.y + y);
      for (int c = 0; c < 4; ++c)
        p[c] = std::uint8_t(std::lround(255.0f * std::clamp(colour[c], 0.0f, 1.0f)));
    }
}

}  // namespace

BakedTexture baked_texture(const PackedFacade& facade, int max_side) {
  std::vector<Half> halves(facade.triangle_count());
  parallel_for(
      halves.size(), [&](std::size_t t) { halves[t] = half_of(facade, t); }, 256);
  std::uint64_t area = 0;
  const std::uint64_t max_area = std::uint64_t(max_side) * std::uint64_t(max_side);
  float scale = 1.0f;
  std::vector<Square> squares = squares_of(halves, scale, area);
  while (area > max_area && std::ranges::any_of(squares, [](const Square& s) { return s.side > min_square; }))
    squares = squares_of(halves, scale *= coarser, area);
  int side = 64;
  while (std::uint64_t(side) * std::uint64_t(side) < area) side *= 2;
  const bool is_half = 2 * area <= std::uint64_t(side) * std::uint64_t(side) && side > 64;

  BakedTexture baked{Image8(side, is_half ? side / 2 : side, 4, 255),
                     std::vector<glm::vec2>(facade.corners.size())};
  const glm::vec2 size(float(baked.picture.width), float(baked.picture.height));
  for (const Square& square : squares)
    for (int which = 0; which < square.count; ++which) {
      const std::uint32_t t = square.triangles[std::size_t(which)];
      const float near_corner = float(border), far_corner = float(square.side - 3 * border);
      const std::array<glm::vec2, 3> places{glm::vec2(near_corner), glm::vec2(far_corner, near_corner),
                                            glm::vec2(near_corner, far_corner)};
      for (std::size_t k = 0; k < 3; ++k)
        baked.uvs[3 * std::size_t(t) + std::size_t(halves[t].corner[k])] =
            (glm::vec2(square.place) + (which == 0 ? places[k] : float(square.side) - places[k])) / size;
    }
  const FacadeTexels texels(facade);
  constexpr std::size_t per_task = 32;
  parallel_for((squares.size() + per_task - 1) / per_task, [&](std::size_t task) {
    FacadeLookup lookup(facade, &texels);
    for (std::size_t i = task * per_task; i < std::min((task + 1) * per_task, squares.size()); ++i)
      bake(facade, lookup, halves, squares[i], baked.picture);
  });
  return baked;
}

}  // namespace parvis::facades
