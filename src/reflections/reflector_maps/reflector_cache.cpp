#include "reflections/reflector_maps/reflector_cache.h"

#include <unordered_set>

#include "base/content_hash.h"
#include "base/progress.h"
#include "machines/divided_work.h"
#include "reflections/reflector_maps/reflector_file.h"
#include "reflections/reflector_maps/settings.h"
#include "scene/data/baked_folder.h"

namespace parvis::reflector_maps {
namespace {
namespace fs = std::filesystem;

constexpr int version = 4;  // of how reflectors are made: raise it when old ones no longer serve
constexpr SealedKind kind{"PARVISR3", "reflector"};
constexpr std::size_t max_cached_patches = 200;

std::uint64_t key_of(const ReflectorSource& source) {
  ContentHash hash;
  hash.add(version);
  hash.add(source.mesh.positions);
  hash.add(source.mesh.normals);
  hash.add(source.mesh.indices);
  hash.add_text(source.name);
  hash.add(source.side);
  hash.add(max_cached_patches);
  return hash.value();
}

/// Its file's, without the extension.
std::string name_of(const ReflectorSource& source) { return fmt::format("{:016x}", key_of(source)); }

/// A reflector that the scene looks up, and the consequence if it cannot be made.
struct WantedReflector {
  ReflectorSource source;
  std::string_view without;
};

/// All that the scene's method looks up, each once; in the same order in every process.
std::vector<WantedReflector> wanted_reflectors(const scene::Scene& scene) {
  std::vector<WantedReflector> wanted;
  std::unordered_set<const scene::Model*> known;
  const bool wants_mirrors = shows_all_objects(scene) || shows_near_objects(scene);
  for (const scene::Object& object : scene.objects) {
    if (!object.takes_reflection || !(wants_mirrors || has_glass(*object.model)) ||
        !known.insert(object.model.get()).second)
      continue;
    if (wants_mirrors) wanted.push_back({mirror_source(scene, object), "it mirrors the sky alone"});
    for (GlassSource& glass : glass_sources(object))
      wanted.push_back({std::move(glass.outside), "as solid glass it shows the sky straight through"});
  }
  return wanted;
}

}  // namespace

ReflectorCache::ReflectorCache(const scene::Scene& scene)
    : parts_(scene::baked_folder(scene, "reflectors"), kind, ".reflector", FolderOf::program) {}

fs::path ReflectorCache::file(const ReflectorSource& source) const { return parts_.file(name_of(source)); }

std::optional<Reflector> ReflectorCache::stored(const ReflectorSource& source) const {
  constexpr std::string_view consequence = "the reflector is rebuilt";
  const std::optional<std::string> bytes = parts_.find(name_of(source), key_of(source), consequence);
  if (!bytes) return std::nullopt;
  std::optional<Reflector> reflector = reflector_of(*bytes);
  if (!reflector) fmt::print(stderr, "warning: {}; {}\n", cut_short(file(source)).message, consequence);
  return reflector;
}

Result<Reflector> ReflectorCache::reflector(const ReflectorSource& source) const {
  if (std::optional<Reflector> reflector = stored(source)) return *std::move(reflector);
  return make_reflector(source.mesh, source.name, source.side, max_cached_patches);
}

Status ReflectorCache::keep(const ReflectorSource& source, std::string_view bytes) const {
  if (!parts_.keeps_parts())
    return error("{}: its folder of reflectors is a link; nothing is kept there", source.name);
  return parts_.keep(name_of(source), key_of(source), bytes);
}

Result<BakedReflectors> bake_reflectors(const scene::Scene& scene, const machines::Processes& processes) {
  const ReflectorCache cache(scene);
  const std::vector<WantedReflector> wanted = wanted_reflectors(scene);
  BakedReflectors baked{cache.parts(), {}};
  machines::Tasks to_do;
  for (std::uint32_t i = 0; i < wanted.size() && processes.is_first(); ++i)
    if (cache.stored(wanted[i].source))
      baked.files.insert(cache.file(wanted[i].source));
    else
      to_do.push_back(i);
  Progress progress("baking reflectors", to_do.size());
  machines::DividedWork work;
  work.uses_threads = false;  // each takes all cores
  work.run = [&](std::uint32_t i) -> Result<std::string> {
    const ReflectorSource& source = wanted[i].source;
    const Result<Reflector> made = make_reflector(source.mesh, source.name, source.side, max_cached_patches);
    if (made) return bytes_of(*made);
    fmt::print(stderr, "warning: {}; {}\n", to_string(made.errors().front()), wanted[i].without);
    return std::string();
  };
  work.keep = [&](std::uint32_t i, std::string_view content) -> Status {
    progress.advance();
    if (content.empty()) return Ok{};  // it cannot be a reflector
    baked.files.insert(cache.file(wanted[i].source));
    return cache.keep(wanted[i].source, content);
  };
  if (const Result<std::size_t> kept = machines::divide(processes, to_do, work); !kept) return kept.errors();
  return baked;
}

void forget_other_reflectors(const BakedReflectors& kept) { kept.parts.remove(kept.files); }

}  // namespace parvis::reflector_maps
