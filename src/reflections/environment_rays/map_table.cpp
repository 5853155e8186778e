#include "reflections/environment_rays/map_table.h"

#include <limits>

namespace parvis::environment_rays {
namespace {

constexpr std::size_t maps_per_cell = reference_maps::MapChoice::maps_per_cell;

}  // namespace

MapTable::MapTable(reference_maps::MapChoice choice, std::vector<glm::vec3> places, std::size_t layers)
    : choice_(std::move(choice)),
      places_(std::move(places)),
      layer_of_(places_.size(), none),
      map_in_(layers, none),
      used_in_(layers, 0),
      texture_(gl::texture_2d(GL_RGBA16UI, choice_.cells().x, choice_.cells().y)) {
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  upload();
}

std::vector<std::size_t> MapTable::drawn_layers() const {
  std::vector<std::size_t> layers;
  for (std::size_t layer = 0; layer < map_in_.size(); ++layer)
    if (map_in_[layer] != none) layers.push_back(layer);
  return layers;
}

std::vector<std::size_t> MapTable::look_within(const Bounds& bounds) {
  const auto cell_of = [&](glm::vec3 point) {
    const glm::ivec2 cell((glm::vec2(point) - choice_.origin()) / choice_.cell_m());
    return glm::clamp(cell, glm::ivec2(0), choice_.cells() - 1);
  };
  const glm::ivec2 low = cell_of(bounds.min), high = cell_of(bounds.max);
  std::vector<std::size_t> missing;
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      for (std::size_t k = 0; k < maps_per_cell; ++k) {
        const std::size_t cell = std::size_t(y) * std::size_t(choice_.cells().x) + std::size_t(x);
        const std::size_t map = choice_.indices()[cell * maps_per_cell + k];
        if (const int layer = layer_of_[map]; layer != none)
          used_in_[std::size_t(layer)] = frame_;
        else if (std::ranges::find(missing, map) == missing.end())
          missing.push_back(map);
      }
  return missing;
}

std::optional<std::size_t> MapTable::give_layer(std::size_t map) {
  if (layer_of_[map] != none) return std::size_t(layer_of_[map]);
  std::size_t layer = std::size_t(std::ranges::find(map_in_, none) - map_in_.begin());
  if (layer == map_in_.size()) {
    layer = std::size_t(std::ranges::min_element(used_in_) - used_in_.begin());
    if (used_in_[layer] == frame_) return std::nullopt;
    layer_of_[std::size_t(map_in_[layer])] = none;
  }
  layer_of_[map] = int(layer);
  map_in_[layer] = int(map);
  used_in_[layer] = frame_;
  return layer;
}

void MapTable::forget() {
  std::ranges::fill(layer_of_, none);
  std::ranges::fill(map_in_, none);
}

/// The layer, for each map, of the nearest one that has a layer; 0 if none has.
std::vector<int> MapTable::stand_ins() const {
  std::vector<int> layers = layer_of_;
  for (std::size_t map = 0; map < layers.size(); ++map) {
    if (layers[map] != none) continue;
    layers[map] = 0;
    float nearest_m = std::numeric_limits<float>::max();
    for (std::size_t layer = 0; layer < map_in_.size(); ++layer) {
      if (map_in_[layer] == none) continue;
      const float off_m = glm::distance(places_[std::size_t(map_in_[layer])], places_[map]);
      if (off_m >= nearest_m) continue;
      layers[map] = int(layer);
      nearest_m = off_m;
    }
  }
  return layers;
}

/// Uploads the table; a map without a layer is replaced by the first of the cell's choice that has one, else
/// the nearest.
void MapTable::upload() {
  const std::vector<int> stand_in = stand_ins();
  std::vector<std::uint16_t> layers(choice_.indices().size());
  for (std::size_t cell = 0; cell < layers.size(); cell += maps_per_cell) {
    const std::uint16_t* maps = &choice_.indices()[cell];
    const std::uint16_t* held =
        std::find_if(maps, maps + maps_per_cell, [&](std::uint16_t map) { return layer_of_[map] != none; });
    for (std::size_t k = 0; k < maps_per_cell; ++k) {
      const bool is_held = layer_of_[maps[k]] != none || held == maps + maps_per_cell;
      layers[cell + k] = std::uint16_t(stand_in[is_held ? maps[k] : *held]);
    }
  }
  glTextureSubImage2D(texture_.name(), 0, 0, 0, choice_.cells().x, choice_.cells().y, GL_RGBA_INTEGER,
                      GL_UNSIGNED_SHORT, layers.data());
}

}  // namespace parvis::environment_rays
