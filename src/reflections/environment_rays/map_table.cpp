#include "reflections/environment_rays/map_table.h"

#include <algorithm>
#include <limits>

namespace parvis::environment_rays {
namespace {

constexpr std::size_t maps_per_cell = reference_maps::MapChoice::maps_per_cell;

}  // namespace

MapTable::MapTable(reference_maps::MapChoice choice, std::vector<glm::vec3> places,
                   std::span<const std::size_t> missing)
    : choice_(std::move(choice)),
      places_(std::move(places)),
      is_drawn_(places_.size(), 1),
      missing_count_(missing.size()),
      texture_(gl::texture_2d(GL_RGBA16UI, choice_.cells().x, choice_.cells().y)) {
  for (const std::size_t map : missing) is_drawn_[map] = 0;
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  upload();
}

std::vector<std::size_t> MapTable::drawn() const {
  std::vector<std::size_t> maps;
  for (std::size_t map = 0; map < is_drawn_.size(); ++map)
    if (is_drawn_[map]) maps.push_back(map);
  return maps;
}

std::vector<std::size_t> MapTable::missing_within(const Bounds& bounds) const {
  const auto cell_of = [&](glm::vec3 point) {
    const glm::ivec2 cell((glm::vec2(point) - choice_.origin()) / choice_.cell_m());
    return glm::clamp(cell, glm::ivec2(0), choice_.cells() - 1);
  };
  const glm::ivec2 low = cell_of(bounds.min), high = cell_of(bounds.max);
  std::vector<std::size_t> maps;
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      for (std::size_t k = 0; k < maps_per_cell; ++k) {
        const std::size_t cell = std::size_t(y) * std::size_t(choice_.cells().x) + std::size_t(x);
        const std::size_t map = choice_.indices()[cell * maps_per_cell + k];
        if (!is_drawn_[map] && std::ranges::find(maps, map) == maps.end()) maps.push_back(map);
      }
  return maps;
}

void MapTable::add(std::size_t map) {
  if (is_drawn_[map]) return;
  is_drawn_[map] = 1;
  --missing_count_;
}

void MapTable::forget() {
  is_drawn_.assign(places_.size(), 0);
  missing_count_ = places_.size();
}

/// The first drawn map of the cell's choice, else the drawn map that is nearest to the missing one.
std::uint16_t MapTable::stand_in(std::size_t cell, std::uint16_t map) const {
  for (std::size_t k = 0; k < maps_per_cell; ++k)
    if (const std::uint16_t other = choice_.indices()[cell * maps_per_cell + k]; is_drawn_[other])
      return other;
  std::uint16_t nearest = map;
  float nearest_m = std::numeric_limits<float>::max();
  for (std::size_t other = 0; other < places_.size(); ++other)
    if (const float off_m = glm::distance(places_[other], places_[map]);
        is_drawn_[other] && off_m < nearest_m) {
      nearest = std::uint16_t(other);
      nearest_m = off_m;
    }
  return nearest;
}

void MapTable::upload() {
  std::vector<std::uint16_t> indices = choice_.indices();
  if (!is_complete())
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (!is_drawn_[indices[i]]) indices[i] = stand_in(i / maps_per_cell, indices[i]);
  glTextureSubImage2D(texture_.name(), 0, 0, 0, choice_.cells().x, choice_.cells().y, GL_RGBA_INTEGER,
                      GL_UNSIGNED_SHORT, indices.data());
}

}  // namespace parvis::environment_rays
