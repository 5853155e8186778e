#include "curved_reflectors/reflector_cache.h"

#include <unordered_set>

#include "base/content_hash.h"
#include "base/progress.h"
#include "curved_reflectors/reflector_file.h"

namespace parvis::curved_reflectors {
namespace {
namespace fs = std::filesystem;

constexpr int version = 4;  // of how reflectors are made: raise it when old ones no longer serve
constexpr std::string_view extension = ".reflector";
constexpr int texels_a_face_texel =
    4;  // a map's side, for the resolution that scripts give for a cube map's face
constexpr std::size_t most_patches = 200;

std::string name_of(const scene::Object& object) {
  if (!object.name.empty()) return object.name;
  return object.model->name.empty() ? "reflector" : object.model->name;
}

/// All that a reflector depends on.
std::uint64_t reflector_key(const Mesh& mesh, const std::string& name, int side) {
  ContentHash hash;
  hash.add(version);
  hash.add(mesh.positions);
  hash.add(mesh.normals);
  hash.add(mesh.indices);
  hash.add_text(name);
  hash.add(side);
  hash.add(most_patches);
  return hash.value();
}

}  // namespace

Mesh mesh_of(const scene::Model& model, bool (*wanted)(const scene::Material&)) {
  Mesh mesh;
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const scene::Part& part : model.parts)
    if (wanted(model.materials[std::size_t(part.material)]))
      append(mesh, part.mesh, pose[std::size_t(part.node)]);
  return mesh;
}

Mesh mirror_mesh(const scene::Model& model) {
  return mesh_of(model, [](const scene::Material& material) { return material.is_mirror_like; });
}

ReflectorCache::ReflectorCache(const scene::Scene& scene)
    : side_(texels_a_face_texel * scene.reflection.resolution) {
  if (!scene.file.empty()) folder_ = fs::path(scene.file).replace_extension(".baked") / "reflectors";
}

fs::path ReflectorCache::file(const scene::Object& object) const {
  if (folder_.empty()) return {};
  const std::uint64_t key = reflector_key(mirror_mesh(*object.model), name_of(object), side_);
  return folder_ / fmt::format("{:016x}{}", key, extension);
}

Result<Reflector> ReflectorCache::reflector(const scene::Object& object) const {
  std::error_code code;
  const fs::path kept = file(object);
  if (!kept.empty() && fs::exists(kept, code)) {
    Result<Reflector> read = read_reflector_file(kept);
    if (read) return read;
    fmt::print(stderr, "warning: {}; the reflector is made anew\n", read.errors().front().message);
  }
  return make_reflector(mirror_mesh(*object.model), name_of(object), side_, most_patches);
}

bool ReflectorCache::has(const scene::Object& object) const {
  return bool(read_reflector_file(file(object)));
}

Status ReflectorCache::keep(const scene::Object& object, const Reflector& reflector) const {
  std::error_code code;
  fs::create_directories(folder_, code);
  return write_reflector_file(file(object), reflector);
}

Result<std::size_t> bake_reflectors(const scene::Scene& scene) {
  const ReflectorCache cache(scene);
  std::vector<const scene::Object*> reflectors;
  std::unordered_set<const scene::Model*> known;
  for (const scene::Object& object : scene.objects)
    if (object.takes_reflection && known.insert(object.model.get()).second) reflectors.push_back(&object);
  std::unordered_set<std::string> files;
  Progress progress("baking reflectors", reflectors.size());
  for (const scene::Object* object : reflectors) {
    const fs::path file = cache.file(*object);
    if (!cache.has(*object)) {
      const Result<Reflector> made = cache.reflector(*object);
      if (!made) {
        fmt::print(stderr, "warning: {}; it mirrors the sky alone\n", to_string(made.errors().front()));
      } else if (Status status = cache.keep(*object, *made); !status) {
        return status.errors();
      }
    }
    files.insert(file.filename().string());
    progress.advance();
  }
  std::error_code code;
  std::vector<fs::path> others;
  if (!reflectors.empty())
    for (const fs::directory_entry& entry :
         fs::directory_iterator(cache.file(*reflectors.front()).parent_path(), code))
      if (entry.path().extension() == extension && !files.contains(entry.path().filename().string()))
        others.push_back(entry.path());
  for (const fs::path& other : others) fs::remove(other, code);
  return reflectors.size();
}

}  // namespace parvis::curved_reflectors
