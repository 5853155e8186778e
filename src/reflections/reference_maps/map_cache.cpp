#include "reflections/reference_maps/map_cache.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/content_hash.h"
#include "reflections/reference_maps/settings.h"
#include "scene/data/baked_folder.h"
#include "scene/data/scene_key.h"

namespace parvis::reference_maps {
namespace {
namespace fs = std::filesystem;

constexpr int version = 5;  // of how maps are placed and drawn: raise it when old maps no longer serve
constexpr std::string_view extension = ".map";
constexpr SealedKind kind{"PARVISM1", "reference map"};
constexpr std::size_t name_length = 16;  // of a state's folder

/// All that the maps depend on.
std::uint64_t maps_key(const scene::Scene& scene) {
  ContentHash hash;
  hash.add(version);
  hash.add(scene::fixed_scene_key(scene));
  const ReferenceMapPlan& plan = map_plan(scene);
  hash.add(plan.places);
  hash.add(plan.cell_m);
  hash.add(max_maps(scene));
  hash.add(map_resolution(scene));
  for (const scene::Lane& lane : scene.roads.lanes) hash.add(lane.points);
  scene.data<scene::DrivingArea>().hash(hash);
  return hash.value();
}

std::string name_of(std::size_t number) { return fmt::format("{:04}", number); }

bool is_state(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name.size() == name_length && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

MapCache::MapCache(const scene::Scene& scene) {
  if (scene.file.empty()) return;
  key_ = maps_key(scene);
  parts_ =
      KeptParts(scene::baked_folder(scene, fmt::format("{:016x}", key_)), kind, extension, FolderOf::program);
  max_places_ = std::max(std::size_t(std::max(max_maps(scene), 1)), map_plan(scene).places.size());
}

fs::path MapCache::file(std::size_t number) const { return parts_.file(name_of(number)); }

std::optional<MapFile> MapCache::read(std::size_t number) const {
  constexpr std::string_view consequence = "the map is rendered again";
  const std::optional<std::string> bytes = parts_.find(name_of(number), key_, consequence);
  if (!bytes) return std::nullopt;
  std::optional<MapFile> map = map_of(*bytes);
  const auto is_finite = [](glm::vec3 place) {
    return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z);
  };
  if (map && map->number == number && number < map->places.size() && map->places.size() <= max_places_ &&
      std::ranges::all_of(map->places, is_finite))
    return map;
  fmt::print(stderr, "warning: {}; {}\n", cut_short(file(number)).message, consequence);
  return std::nullopt;
}

std::optional<std::vector<glm::vec3>> MapCache::places() const {
  std::error_code code;
  std::set<std::size_t> numbers;  // in order: the same map answers each time
  if (!parts_.keeps_parts()) return std::nullopt;
  // A bake may remove the folder meanwhile.
  for (fs::directory_iterator entry(folder(), code), last; !code && entry != last; entry.increment(code)) {
    const std::string name = entry->path().stem().string();
    std::size_t number = 0;
    const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (failure == std::errc() && end == name.data() + name.size() && entry->path() == file(number))
      numbers.insert(number);
  }
  for (const std::size_t number : numbers)
    if (std::optional<MapFile> map = read(number)) return std::move(map->places);
  return std::nullopt;
}

void MapCache::report_other_states() const {
  std::error_code code;
  if (!parts_.keeps_parts() || fs::exists(folder(), code) || !fs::exists(folder().parent_path(), code))
    return;
  fmt::print(
      stderr,
      "warning: {}: has maps of another state of the scene (models, light, roads or options are others "
      "now) or of another version of Parvis; they are rendered again, and `parvis bake` keeps them\n",
      folder().parent_path().string());
}

Status MapCache::write(const MapFile& map) const {
  if (!parts_.keeps_parts())
    return error("{}", "the folder NAME.baked of the scene is a link; nothing is kept there");
  return parts_.keep(name_of(map.number), key_, bytes_of(map));
}

void forget_other_states(const scene::Scene& scene, const std::set<fs::path>& kept) {
  if (scene.file.empty()) return;
  std::error_code code;
  std::vector<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(scene::baked_folder(scene), code))
    if (is_state(entry.path()) && !kept.contains(entry.path())) others.push_back(entry.path());
  for (const fs::path& other : others)
    if (fs::is_symlink(fs::symlink_status(other, code)))
      fs::remove(other, code);  // the link itself
    else
      KeptParts(other, kind, extension, FolderOf::program).remove();
}

}  // namespace parvis::reference_maps
