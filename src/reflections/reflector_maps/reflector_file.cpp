#include "reflections/reflector_maps/reflector_file.h"

#include "base/sealed_file.h"

namespace parvis::reflector_maps {
namespace {

constexpr SealedKind kind{"PARVISR2", "reflector"};

// What is written and what is read, in one order: `Archive` does the one or the other.

struct Writer {
  std::string bytes;

  template <class T>
  void value(const T& v) {
    append_value(bytes, v);
  }
  template <class T>
  void values(const std::vector<T>& v) {
    append_values(bytes, v);
  }
  template <class T, class Each>
  void list(const std::vector<T>& items, Each each) {
    append_value(bytes, std::uint32_t(items.size()));
    for (const T& item : items) each(*this, item);
  }
  void text(const std::string& t) { values(std::vector<char>(t.begin(), t.end())); }
};

struct Reader {
  Taker taker;

  template <class T>
  void value(T& v) {
    v = taker.take<T>();
  }
  template <class T>
  void values(std::vector<T>& v) {
    v = taker.take_values<T>();
  }
  template <class T, class Each>
  void list(std::vector<T>& items, Each each) {
    for (std::uint32_t left = taker.take<std::uint32_t>(); left > 0 && !taker.has_ended_early(); --left)
      each(*this, items.emplace_back());
  }
  void text(std::string& t) {
    const std::vector<char> characters = taker.take_values<char>();
    t.assign(characters.begin(), characters.end());
  }
};

template <class Archive, class Patch>
void pass_patch(Archive& archive, Patch& patch) {
  archive.values(patch.triangles);
  archive.values(patch.around);
  archive.value(patch.is_convex);
  archive.value(patch.shows_once);
  archive.value(patch.centre);
}

template <class Archive, class Map>
void pass_map(Archive& archive, Map& map) {
  archive.value(map.window);
  archive.value(map.is_convex);
  archive.value(map.shows_once);
  archive.value(map.starts);
  archive.value(map.texels.width);
  archive.value(map.texels.height);
  archive.value(map.texels.channels);
  archive.values(map.texels.pixels);
}

template <class Archive, class AnyReflector>
void pass(Archive& archive, AnyReflector& reflector) {
  auto& mesh = reflector.mesh;
  archive.values(mesh.mesh.positions);
  archive.values(mesh.mesh.normals);
  archive.values(mesh.mesh.uvs);
  archive.values(mesh.mesh.indices);
  archive.values(mesh.neighbours);
  archive.value(mesh.dropped_triangles);
  archive.value(mesh.turned_triangles);
  archive.value(mesh.open_edges);
  archive.list(reflector.patches, [](auto& a, auto& patch) { pass_patch(a, patch); });
  archive.list(reflector.maps, [](auto& a, auto& map) { pass_map(a, map); });
  archive.list(reflector.remarks, [](auto& a, auto& remark) { a.text(remark); });
}

}  // namespace

Status write_reflector_file(const std::filesystem::path& file, const Reflector& reflector) {
  Writer writer;
  pass(writer, reflector);
  return write_sealed(file, kind, writer.bytes);
}

Result<Reflector> read_reflector_file(const std::filesystem::path& file) {
  const Result<std::string> content = read_sealed(file, kind);
  if (!content) return content.errors();
  Reader reader{Taker(*content)};
  Reflector reflector;
  pass(reader, reflector);
  if (!reader.taker.is_at_end()) return cut_short(file);
  return reflector;
}

}  // namespace parvis::reflector_maps
