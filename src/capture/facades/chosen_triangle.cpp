#include "capture/facades/chosen_triangle.h"

#include <algorithm>
#include <cmath>

namespace parvis::facades {
namespace {

// Angle under which a triangle is seen, radians.
constexpr float largest_angle = 0.05f;     ///< above it weights do not change evenly
constexpr float one_choice_angle = 0.01f;  ///< below it the centre's choice holds at the corners, too
constexpr float largest_bend_px = 0.02f;   ///< of a straight line, looked up evenly between its ends

using Corners = std::span<const glm::vec3, 3>;

/// The drawn part of one layer: places in its box, pixels, and the tiles that hold them.
struct StoredCorners {
  std::array<glm::vec2, 3> at{};
  int first = 0, across = 0;  ///< see ChosenTriangle::tiles
};

/// Where a point appears in a layer's box; nothing behind the camera.
std::optional<glm::vec2> in_box(const PackedFacade& facade, const PackedLayer& layer, glm::vec3 position) {
  const View& view = facade.photos[layer.photo].view;
  const glm::dvec3 p = view.to_camera(glm::dvec3(position));
  if (!(p.z > 0.0)) return std::nullopt;
  return glm::vec2(view.to_pixel(p) - glm::dvec2(layer.box.x, layer.box.y));
}

/// Nothing where a corner lies beside the layer, or a tile is not stored, or has an artist's alpha.
std::optional<StoredCorners> stored_corners(const PackedFacade& facade, const PackedLayer& layer, Corners c) {
  StoredCorners stored;
  const glm::ivec2 tiles(layer.across(), layer.down());
  glm::ivec2 low(tiles), high(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::optional<glm::vec2> at = in_box(facade, layer, c[k]),
                                   bent = in_box(facade, layer, 0.5f * (c[k] + c[(k + 1) % 3]));
    if (!at || !bent || at->x < 0.0f || at->y < 0.0f) return std::nullopt;
    stored.at[k] = *at;
    const glm::ivec2 cell(*at / float(tile_inner));
    if (cell.x >= tiles.x || cell.y >= tiles.y) return std::nullopt;
    low = glm::min(low, cell), high = glm::max(high, cell);
    const std::optional<glm::vec2> next = in_box(facade, layer, c[(k + 1) % 3]);
    if (!next || glm::distance(0.5f * (*at + *next), *bent) > largest_bend_px) return std::nullopt;
  }
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const auto kind = TileKind(facade.tiles[layer.first_tile + std::size_t(y * tiles.x + x)] & 3u);
      if (kind != TileKind::seen && kind != TileKind::mixed) return std::nullopt;
    }
  stored.first = int(layer.first_tile), stored.across = tiles.x;
  if (low != high) return stored;
  stored.first += low.y * tiles.x + low.x, stored.across = 0;
  for (glm::vec2& at : stored.at) at += float(tile_border) - float(tile_inner) * glm::vec2(low);
  return stored;
}

/// Size of a photograph's pixel at a point before it, log2 of world units.
float pixel_size_log2(const View& view, glm::vec3 point) {
  return float(std::log2(std::max(view.to_camera(glm::dvec3(point)).z / view.fx, 1e-6)));
}

/// The drawn parts of the layers that are shown, one or two; nothing where stored_corners has nothing of one.
using Stored = std::array<StoredCorners, 2>;
std::optional<Stored> stored_in(const PackedFacade& facade, std::span<const std::uint32_t> shown, Corners c) {
  Stored stored;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::optional<StoredCorners> one = stored_corners(facade, facade.layers[shown[i]], c);
    if (!one) return std::nullopt;
    stored[i] = *one;
  }
  return stored;
}

/// Opinions of up to three layers about a point; those of layers that are not given are undefined.
using Opinions = std::array<FacadeLookup::Opinion, 3>;

Opinions opinions_at(FacadeLookup& lookup, const ChosenEye& eye, std::span<const std::uint32_t> layers,
                     glm::vec3 point) {
  Opinions opinions;
  const glm::vec3 off = eye.position - point;
  const float distance = std::max(glm::length(off), 1e-6f);
  for (std::size_t i = 0; i < 3; ++i)
    opinions[i] = i < layers.size()
                      ? lookup.opinion(layers[i], point, off / distance, eye.pixel_angle * distance)
                      : FacadeLookup::no_opinion_at_all();
  return opinions;
}

/// 0: seen, 1: filled, 2: nothing is said.
int kind_of(const FacadeLookup::Opinion& opinion) {
  if (opinion.key >= FacadeLookup::no_opinion) return 2;
  return opinion.key < 100.0f ? 0 : 1;
}

/// Whether the layers that are shown, the first so many, say of a corner as they say of the middle that they
/// have seen it, or were filled there.
bool are_of_one_kind(const Opinions& corner, const Opinions& middle, std::size_t shown) {
  for (std::size_t i = 0; i < shown; ++i)
    if (kind_of(corner[i]) != kind_of(middle[i])) return false;
  return true;
}

/// Weights of the first layer, of the second, and of the fallback. The second may be the better one at a
/// corner.
glm::vec3 shares_of(FacadeLookup& lookup, const Opinions& corner) {
  if (!(corner[1].key < corner[0].key)) return lookup.shares(corner[0], corner[1], corner[2].key);
  const glm::vec3 swapped = lookup.shares(corner[1], corner[0], corner[2].key);
  return {swapped.y, swapped.x, swapped.z};
}

/// Balance of a photograph's shown colours, by its opinion: its own at its own viewpoint.
struct ShownBalance {
  glm::vec3 scale, offset;
};
ShownBalance shown_balance(const PackedPhoto& photo, float own) {
  const auto& [scale, offset] = photo.balance;
  return {glm::mix(glm::vec3(scale[0], scale[1], scale[2]), glm::vec3(1.0f), own),
          glm::mix(glm::vec3(offset[0], offset[1], offset[2]), glm::vec3(0.0f), own)};
}

glm::vec3 fallback_of(const PackedFacade& facade, std::size_t corner) {
  return glm::vec3(facade.fallback[corner]) / 255.0f;
}

/// Weights of the layers that are shown at a corner, which is `corner` of all corners.
ChosenCorner weighed_corner(const PackedFacade& facade, FacadeLookup& lookup,
                            std::span<const std::uint32_t> shown, const Opinions& opinions,
                            std::size_t corner) {
  const glm::vec3 shares = shares_of(lookup, opinions);
  ChosenCorner chosen;
  chosen.rest = shares.z * fallback_of(facade, corner);
  glm::vec3* const factors[2]{&chosen.of_first, &chosen.of_second};
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const ShownBalance balance = shown_balance(facade.photos[facade.layers[shown[i]].photo], opinions[i].own);
    *factors[i] = shares[int(i)] * balance.scale, chosen.rest += shares[int(i)] * balance.offset;
  }
  return chosen;
}

/// The triangle in its fallback colours alone.
ChosenTriangle bare_triangle(const PackedFacade& facade, std::size_t triangle) {
  ChosenTriangle bare;
  for (std::size_t k = 0; k < 3; ++k) bare.corners[k].rest = fallback_of(facade, 3 * triangle + k);
  return bare;
}

/// The triangle with what is looked up of it; its corners weigh nothing yet.
ChosenTriangle stored_triangle(const PackedFacade& facade, std::span<const std::uint32_t> shown,
                               const Stored& stored, glm::vec3 centre) {
  ChosenTriangle chosen;
  for (std::size_t i = 0; i < shown.size(); ++i)
    chosen.pixel_sizes[int(i)] = pixel_size_log2(facade.photos[facade.layers[shown[i]].photo].view, centre);
  chosen.tiles = {stored[0].first, stored[0].across, shown.size() > 1 ? stored[1].first : -1,
                  stored[1].across};
  return chosen;
}

float angle_of(Corners corners, glm::vec3 centre, glm::vec3 eye) {
  float radius = 0.0f;
  for (const glm::vec3& corner : corners) radius = std::max(radius, glm::distance(corner, centre));
  return radius / std::max(glm::distance(centre, eye), 1e-6f);
}

}  // namespace

std::optional<ChosenTriangle> chosen_triangle(const PackedFacade& facade, FacadeLookup& lookup,
                                              std::size_t triangle, const ChosenEye& eye,
                                              std::span<const std::uint32_t> layers) {
  const Corners corners(facade.corners.data() + 3 * triangle, 3);
  const glm::vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0f;
  const float angle = angle_of(corners, centre, eye.position);
  if (angle > largest_angle) return std::nullopt;
  if (layers.empty()) return bare_triangle(facade, triangle);

  const std::span<const std::uint32_t> shown = layers.first(std::min<std::size_t>(layers.size(), 2));
  const std::optional<Stored> stored = stored_in(facade, shown, corners);
  if (!stored) return std::nullopt;
  ChosenTriangle chosen = stored_triangle(facade, shown, *stored, centre);
  const Opinions in_middle = opinions_at(lookup, eye, layers, centre);
  for (std::size_t k = 0; k < 3; ++k) {
    const Opinions here = opinions_at(lookup, eye, layers, corners[k]);
    if (!are_of_one_kind(here, in_middle, shown.size())) return std::nullopt;
    const bool third_is_better = here[2].key < std::max(here[0].key, here[1].key);
    if (angle > one_choice_angle && third_is_better) return std::nullopt;
    chosen.corners[k] = weighed_corner(facade, lookup, shown, here, 3 * triangle + k);
    chosen.corners[k].at = {(*stored)[0].at[k], (*stored)[1].at[k]};
  }
  return chosen;
}

}  // namespace parvis::facades
