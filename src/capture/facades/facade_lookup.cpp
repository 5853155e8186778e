#include "capture/facades/facade_lookup.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "capture/facades/item_buffer.h"

namespace parvis::facades {
namespace {

/// Bytes of all levels of a slot, decompressed, and where each level begins.
constexpr std::size_t slot_bytes = 4 * (64 * 64 + 32 * 32 + 16 * 16);
constexpr std::array<std::size_t, tile_levels> level_begin{0, 4 * 64 * 64, 4 * (64 * 64 + 32 * 32)};

/// Weights of the second and third corner of a triangle at a point of its plane.
glm::vec2 barycentric_of(const PackedFacade& facade, std::size_t triangle, glm::dvec3 point) {
  const glm::vec3* c = facade.corners.data() + 3 * triangle;
  const glm::dvec3 u(c[1] - c[0]), v(c[2] - c[0]), p = point - glm::dvec3(c[0]);
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), pu = glm::dot(p, u),
               pv = glm::dot(p, v), area = uu * vv - uv * uv;
  if (!(area > 0.0)) return {0.0f, 0.0f};
  return {float((vv * pu - uv * pv) / area), float((uu * pv - uv * pu) / area)};
}

}  // namespace

FacadeTexels::FacadeTexels(const PackedFacade& facade)
    : texels_(facade.blocks.size() / blocks_per_slot * slot_bytes) {
  parallel_for(facade.blocks.size() / blocks_per_slot, [&](std::size_t slot) {
    const Bc7Block* blocks = facade.blocks.data() + slot * blocks_per_slot;
    for (int level = 0; level < tile_levels; ++level) {
      const int side = tile_side >> level;
      const Image8 picture = picture_of(blocks, side, side);
      std::ranges::copy(picture.pixels, texels_.begin() + std::ptrdiff_t(slot * slot_bytes +
                                                                         level_begin[std::size_t(level)]));
      blocks += side * side / 16;
    }
  });
}

glm::vec4 FacadeTexels::bilinear(int slot, glm::vec2 at, int level) const {
  const int side = tile_side >> level;
  const glm::vec2 p = at / float(1 << level) - 0.5f;
  const glm::vec2 low = glm::floor(p), f = p - low;
  const std::uint8_t* texels =
      texels_.data() + std::size_t(slot) * slot_bytes + level_begin[std::size_t(level)];
  const auto texel = [&](int x, int y) {
    const std::uint8_t* t = texels + 4 * (std::clamp(y, 0, side - 1) * side + std::clamp(x, 0, side - 1));
    return glm::vec4(t[0], t[1], t[2], t[3]) / 255.0f;
  };
  const int x = int(low.x), y = int(low.y);
  return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), f.x),
                  glm::mix(texel(x, y + 1), texel(x + 1, y + 1), f.x), f.y);
}

glm::vec4 FacadeTexels::at(int slot, glm::vec2 at, float level) const {
  const int fine = std::clamp(int(level), 0, tile_levels - 1);
  const float f = level - float(fine);
  const glm::vec4 colour = bilinear(slot, at, fine);
  return f <= 0.0f || fine + 1 >= tile_levels ? colour : glm::mix(colour, bilinear(slot, at, fine + 1), f);
}

TileAlphas::TileAlphas(const PackedFacade& facade) : of_slot_(facade.slot_count(), -1) {
  constexpr std::size_t texels = std::size_t(tile_side) * tile_side;
  std::vector<std::size_t> slots;
  for (const std::uint32_t tile : facade.tiles)
    if (std::int32_t& place = of_slot_[tile >> 2]; TileKind(tile & 3u) == TileKind::mixed && place < 0)
      place = std::int32_t(slots.size()), slots.push_back(tile >> 2);
  alphas_.resize(slots.size() * texels);
  parallel_for(slots.size(), [&](std::size_t i) {
    const Image8 picture =
        picture_of(facade.blocks.data() + slots[i] * blocks_per_slot, tile_side, tile_side);
    for (std::size_t t = 0; t < texels; ++t) alphas_[i * texels + t] = picture.pixels[4 * t + 3];
  });
}

float TileAlphas::at(int slot, glm::vec2 at) const {
  const std::int32_t place = of_slot_[std::size_t(slot)];
  if (place < 0) return 1.0f;
  const std::uint8_t* alphas = alphas_.data() + std::size_t(place) * tile_side * tile_side;
  const glm::vec2 p = at - 0.5f, low = glm::floor(p), f = p - low;
  const auto alpha = [&](int x, int y) {
    return float(alphas[std::clamp(y, 0, tile_side - 1) * tile_side + std::clamp(x, 0, tile_side - 1)]);
  };
  const int x = int(low.x), y = int(low.y);
  return glm::mix(glm::mix(alpha(x, y), alpha(x + 1, y), f.x),
                  glm::mix(alpha(x, y + 1), alpha(x + 1, y + 1), f.x), f.y) /
         255.0f;
}

FacadeLookup::FacadePhoto FacadeLookup::facade_photo(int photo) const {
  const PhotoRow row = photo_row(facade_.photos[std::size_t(photo)], first_depths_[std::size_t(photo)]);
  return {row[0], row[1], row[2], row[3], row[4], row[5], row[6]};
}
glm::uvec4 FacadeLookup::facade_layer(int layer) const {
  return layer_row(facade_.layers[std::size_t(layer)]);
}
int FacadeLookup::facade_candidate(int index) const { return int(facade_.candidates[std::size_t(index)]); }
glm::uvec4 FacadeLookup::facade_tile(int tile) const {
  const std::uint32_t entry = facade_.tiles[std::size_t(tile)];
  return {entry & 3u, entry >> 2, 0u, 0u};
}
glm::vec4 FacadeLookup::facade_texel(int slot, glm::vec2 at, float level) const {
  if (texels_) return texels_->at(slot, at, level);
  return {1.0f, 1.0f, 1.0f, alphas_ ? alphas_->at(slot, at) : 1.0f};
}

float FacadeLookup::facade_depth(int index) const {
  return float(facade_.depths[std::size_t(index)]) / 2048.0f - 16.0f;
}

glm::vec4 FacadeLookup::colour(std::uint32_t triangle, glm::vec3 position, glm::vec3 to_eye, float pixel_m,
                               glm::vec2 barycentric) {
  const glm::u8vec3* corner = facade_.fallback.data() + 3 * std::size_t(triangle);
  const glm::vec3 fallback = (glm::vec3(corner[0]) * (1.0f - barycentric.x - barycentric.y) +
                              glm::vec3(corner[1]) * barycentric.x + glm::vec3(corner[2]) * barycentric.y) /
                             255.0f;
  const glm::uvec2 list = facade_.lists[triangle];
  return facade_colour(position, to_eye, pixel_m, int(list.x), int(list.y), fallback);
}

glm::vec3 FacadeLookup::colour(const ChosenTriangle& chosen, float pixel_m, glm::vec2 barycentric) {
  const glm::vec2 levels = std::log2(std::max(pixel_m, 1e-6f)) - chosen.pixel_sizes;
  const auto& c = chosen.corners;
  const auto between = [&](auto member) {
    return c[0].*member * (1.0f - barycentric.x - barycentric.y) + c[1].*member * barycentric.x +
           c[2].*member * barycentric.y;
  };
  const auto stored = [&](glm::vec2 at, int tile, int across, float level) {
    if (tile < 0) return glm::vec3(0.0f);
    return facade_stored(at, across > 0 ? tile : int(facade_.tiles[std::size_t(tile)] >> 2), across, level);
  };
  const glm::vec4 at = between(&ChosenCorner::at);
  const glm::ivec4 tiles = chosen.tiles;
  return between(&ChosenCorner::of_first) * stored(glm::vec2(at.x, at.y), tiles.x, tiles.y, levels.x) +
         between(&ChosenCorner::of_second) * stored(glm::vec2(at.z, at.w), tiles.z, tiles.w, levels.y) +
         between(&ChosenCorner::rest);
}

LayerModel model_of(const PackedFacade& facade) {
  LayerModel model;
  for (const std::string& name : facade.surfaces)
    model.objects.push_back({name, false, name == backdrop_name, false});
  for (std::size_t t = 0; t < facade.triangle_count(); ++t) {
    LayerTriangle triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = glm::dvec3(facade.corners[3 * t + k]);
    triangle.object = facade.surface_of_triangle[t];
    triangle.face = triangle.source = std::uint32_t(t);
    model.triangles.push_back(triangle);
  }
  model.face_count = model.source_count = std::uint32_t(facade.triangle_count());
  return model;
}

ImageF view_of_facade(const PackedFacade& facade, const FacadeTexels& texels, const View& view) {
  return view_of_facade(facade, texels, view, item_buffer(model_of(facade), view));
}

ImageF view_of_facade(const PackedFacade& facade, const FacadeTexels& texels, const View& view,
                      const ItemBuffer& seen, std::span<const std::optional<ChosenTriangle>> chosen) {
  ImageF picture(view.width, view.height, 4);
  parallel_for(std::size_t(view.height), [&](std::size_t row) {
    FacadeLookup lookup(facade, &texels);
    const int y = int(row);
    for (int x = 0; x < view.width; ++x) {
      const std::uint32_t triangle = seen.triangles[seen.index(x, y)];
      if (triangle == no_triangle_seen) continue;
      const double depth = seen.depths[seen.index(x, y)];
      const glm::dvec3 point = view.to_world({x + 0.5, y + 0.5}, depth);
      if (!chosen.empty() && chosen[triangle]) {
        const glm::vec3 colour =
            lookup.colour(*chosen[triangle], float(depth / view.fx), barycentric_of(facade, triangle, point));
        for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = colour[c];
        picture.at(x, y)[3] = 1.0f;
        continue;
      }
      const glm::vec4 colour =
          lookup.colour(triangle, glm::vec3(point), glm::vec3(glm::normalize(view.centre - point)),
                        float(depth / view.fx), glm::vec2(1.0f / 3.0f));
      for (int c = 0; c < 4; ++c) picture.at(x, y)[c] = colour[c];
    }
  });
  return picture;
}

}  // namespace parvis::facades
