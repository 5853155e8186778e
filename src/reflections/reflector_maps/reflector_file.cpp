#include "reflections/reflector_maps/reflector_file.h"

#include <algorithm>

#include "base/sealed_file.h"

namespace parvis::reflector_maps {
namespace {

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
  ByteReader reader;

  template <class T>
  void value(T& v) {
    v = reader.take<T>();
  }
  template <class T>
  void values(std::vector<T>& v) {
    v = reader.take_values<T>();
  }
  template <class T, class Each>
  void list(std::vector<T>& items, Each each) {
    for (std::uint32_t left = reader.take<std::uint32_t>(); left > 0 && !reader.has_ended_early(); --left)
      each(*this, items.emplace_back());
  }
  void text(std::string& t) {
    const std::vector<char> characters = reader.take_values<char>();
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

bool is_right(const ReflectorPatch& patch, std::size_t triangles) {
  const auto is_one = [&](std::uint32_t triangle) { return triangle < triangles; };
  return std::ranges::all_of(patch.triangles, is_one) && std::ranges::all_of(patch.around, is_one);
}

bool is_right(const ReflectorMap& map) {
  constexpr int max_side = 8192;
  const ImageF& texels = map.texels;
  return texels.width >= 0 && texels.height >= 0 && texels.width <= max_side && texels.height <= max_side &&
         texels.channels == 4 &&
         texels.pixels.size() == 4 * std::size_t(texels.width) * std::size_t(texels.height);
}

/// Every index lies in the list that it points into.
bool is_right(const Reflector& reflector) {
  const ReflectorMesh& mesh = reflector.mesh;
  const std::size_t triangles = mesh.mesh.triangle_count(), vertices = mesh.mesh.positions.size();
  const auto is_vertex = [&](std::uint32_t index) { return index < vertices; };
  const auto is_neighbour = [&](std::uint32_t triangle) {
    return triangle == no_triangle || triangle < triangles;
  };
  return mesh.mesh.normals.size() == vertices && std::ranges::all_of(mesh.mesh.indices, is_vertex) &&
         mesh.neighbours.size() == triangles &&
         std::ranges::all_of(mesh.neighbours,
                             [&](const auto& edges) { return std::ranges::all_of(edges, is_neighbour); }) &&
         reflector.maps.size() <= reflector.patches.size() &&
         std::ranges::all_of(reflector.patches,
                             [&](const auto& patch) { return is_right(patch, triangles); }) &&
         std::ranges::all_of(reflector.maps, [](const auto& map) { return is_right(map); });
}

}  // namespace

std::string bytes_of(const Reflector& reflector) {
  Writer writer;
  pass(writer, reflector);
  return writer.bytes;
}

std::optional<Reflector> reflector_of(std::string_view bytes) {
  Reader reader{ByteReader(bytes)};
  Reflector reflector;
  pass(reader, reflector);
  if (!reader.reader.is_at_end() || !is_right(reflector)) return std::nullopt;
  return reflector;
}

}  // namespace parvis::reflector_maps
