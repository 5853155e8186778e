#include "reflections/reflector_maps/reflector_cache.h"

#include <unordered_set>

#include "base/content_hash.h"
#include "base/progress.h"
#include "reflections/reflector_maps/reflector_file.h"
#include "reflections/reflector_maps/settings.h"
#include "scene/data/baked_folder.h"

namespace parvis::reflector_maps {
namespace {
namespace fs = std::filesystem;

constexpr int version = 4;  // of how reflectors are made: raise it when old ones no longer serve
constexpr std::string_view extension = ".reflector";
constexpr std::size_t max_patches = 200;

std::uint64_t key_of(const ReflectorSource& source) {
  ContentHash hash;
  hash.add(version);
  hash.add(source.mesh.positions);
  hash.add(source.mesh.normals);
  hash.add(source.mesh.indices);
  hash.add_text(source.name);
  hash.add(source.side);
  hash.add(max_patches);
  return hash.value();
}

/// Makes and keeps it, unless it is kept. `without` describes the consequence if it cannot be made.
Status bake(const ReflectorCache& cache, const ReflectorSource& source, std::string_view without,
            BakedReflectors& baked) {
  if (!cache.has(source)) {
    const Result<Reflector> made = cache.reflector(source);
    if (!made) {
      fmt::print(stderr, "warning: {}; {}\n", to_string(made.errors().front()), without);
      return Done{};
    }
    if (Status status = cache.keep(source, *made); !status) return status;
  }
  baked.files.insert(cache.file(source));
  return Done{};
}

}  // namespace

ReflectorCache::ReflectorCache(const scene::Scene& scene) {
  folder_ = scene::baked_folder(scene, "reflectors");
}

fs::path ReflectorCache::file(const ReflectorSource& source) const {
  if (folder_.empty()) return {};
  return folder_ / fmt::format("{:016x}{}", key_of(source), extension);
}

Result<Reflector> ReflectorCache::reflector(const ReflectorSource& source) const {
  std::error_code code;
  const fs::path kept = file(source);
  if (!kept.empty() && fs::exists(kept, code)) {
    Result<Reflector> read = read_reflector_file(kept, key_of(source));
    if (read) return read;
    fmt::print(stderr, "warning: {}; the reflector is rebuilt\n", read.errors().front().message);
  }
  return make_reflector(source.mesh, source.name, source.side, max_patches);
}

bool ReflectorCache::has(const ReflectorSource& source) const {
  return !folder_.empty() && bool(read_reflector_file(file(source), key_of(source)));
}

Status ReflectorCache::keep(const ReflectorSource& source, const Reflector& reflector) const {
  std::error_code code;
  if (folder_.empty())
    return error("{}: its folder of reflectors is a link; nothing is kept there", source.name);
  fs::create_directories(folder_, code);
  return write_reflector_file(file(source), key_of(source), reflector);
}

Result<BakedReflectors> bake_reflectors(const scene::Scene& scene) {
  const ReflectorCache cache(scene);
  std::vector<const scene::Object*> objects;
  std::unordered_set<const scene::Model*> known;
  const bool wants_mirrors = shows_all_objects(scene) || shows_near_objects(scene);
  for (const scene::Object& object : scene.objects)
    if (object.takes_reflection && (wants_mirrors || has_glass(*object.model)) &&
        known.insert(object.model.get()).second)
      objects.push_back(&object);
  BakedReflectors baked{cache.folder(), {}};
  Progress progress("baking reflectors", objects.size());
  for (const scene::Object* object : objects) {
    if (wants_mirrors) {
      const ReflectorSource mirror = mirror_source(scene, *object);
      if (Status status = bake(cache, mirror, "it mirrors the sky alone", baked); !status)
        return status.errors();
    }
    for (const GlassSource& glass : glass_sources(*object)) {
      if (Status status =
              bake(cache, glass.outside, "as solid glass it shows the sky straight through", baked);
          !status)
        return status.errors();
    }
    progress.advance();
  }
  return baked;
}

void forget_other_reflectors(const BakedReflectors& kept) {
  scene::remove_other_files(kept.folder, extension, kept.files);
}

}  // namespace parvis::reflector_maps
