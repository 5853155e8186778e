#include "formats/meshes/far_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <functional>
#include <vector>

#include "formats/readers/local_origin.h"

namespace parvis::scene {
namespace {

constexpr std::string_view blanks = " \t\r";

/// The next word of a line from `at` on, which moves behind it; empty at the line's end.
std::string_view next_word(std::string_view line, std::size_t& at) {
  at = std::min(line.find_first_not_of(blanks, at), line.size());
  const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
  const std::string_view word = line.substr(at, end - at);
  at = end;
  return word;
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Where the three coordinates of a vertex stand in a line, as words; `keyword` comes before them.
struct LineForm {
  std::string_view keyword;                  ///< "v"; empty: the line has none
  std::array<std::size_t, 3> word{0, 1, 2};  ///< of x, y and z, behind the keyword
};

/// A vertex of a line with the places of its words; none where the line is none.
struct LineVertex {
  glm::dvec3 position{0.0};
  std::array<std::string_view, 3> words;
};

std::optional<LineVertex> vertex_of(std::string_view line, const LineForm& form) {
  std::size_t at = 0;
  if (!form.keyword.empty() && next_word(line, at) != form.keyword) return std::nullopt;
  LineVertex vertex;
  int found = 0;
  for (std::size_t i = 0; found < 3; ++i) {
    const std::string_view word = next_word(line, at);
    if (word.empty()) return std::nullopt;
    const auto place = std::ranges::find(form.word, i);
    if (place == form.word.end()) continue;
    const std::optional<double> value = number_of(word);
    if (!value) return std::nullopt;
    const auto axis = place - form.word.begin();
    vertex.position[int(axis)] = *value, vertex.words[std::size_t(axis)] = word;
    ++found;
  }
  return vertex;
}

/// The vertices of a file: lines of text, or numbers of `bytes` each in records.
struct Vertices {
  std::size_t first = 0;                ///< byte
  std::size_t count = ~std::size_t{0};  ///< of lines or records; or as many as there are
  LineForm form = {};
  std::size_t stride = 0;               ///< of records; 0: they are lines
  std::array<std::size_t, 3> offset{};  ///< of doubles in a record
  bool is_big_endian = false;
};

std::size_t size_of(std::string_view type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "float" || type == "int32" || type == "uint32" ||
      type == "float32")
    return 4;
  return type == "double" || type == "float64" ? 8 : 0;
}

/// Calls `line(text)` for each line from byte `at` on, until it returns false.
template <class Line>
void each_line(std::string_view bytes, std::size_t at, const Line& line) {
  while (at < bytes.size()) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    if (!line(bytes.substr(at, end - at), end + 1)) return;
    at = end + 1;
  }
}

/// Vertices of a PLY file whose first element is "vertex", with no lists in it.
std::optional<Vertices> ply_vertices(std::string_view bytes) {
  Vertices found;
  std::string_view format;
  std::size_t words = 0;
  bool is_vertex = false, has_ended = false, is_followed = true;
  std::array<std::string_view, 3> types;
  each_line(bytes, 0, [&](std::string_view line, std::size_t next) {
    std::size_t at = 0;
    const std::string_view keyword = next_word(line, at), first = next_word(line, at),
                           second = next_word(line, at);
    if (keyword == "format") format = first;
    if (keyword == "element") {
      is_vertex = first == "vertex";
      if (is_vertex) found.count = std::size_t(number_of(second).value_or(0.0));
      if (!is_vertex && words == 0) is_followed = false;  // another element stands before them
    }
    if (keyword == "property" && is_vertex) {
      const std::size_t size = size_of(first);
      if (size == 0) is_followed = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (second == std::string_view("xyz").substr(axis, 1))
          found.form.word[axis] = words, found.offset[axis] = found.stride, types[axis] = first;
      found.stride += size, ++words;
    }
    found.first = next;
    has_ended = keyword == "end_header";
    return is_followed && !has_ended && next < 65536;
  });
  if (!is_followed || !has_ended || words == 0) return std::nullopt;
  if (format == "ascii") {
    found.stride = 0;
    return found;
  }
  found.is_big_endian = format == "binary_big_endian";
  const bool is_whole =
      found.first <= bytes.size() && found.count <= (bytes.size() - found.first) / found.stride;
  const bool is_double = std::ranges::all_of(types, [](std::string_view type) { return size_of(type) == 8; });
  return is_whole && is_double ? std::optional(found) : std::nullopt;  // floats are as exact as assimp's
}

/// Vertices of an OFF file, behind the line of counts.
std::optional<Vertices> off_vertices(std::string_view bytes) {
  Vertices found;
  bool is_found = false;
  each_line(bytes, 0, [&](std::string_view line, std::size_t next) {
    std::size_t at = 0;
    const std::string_view word = next_word(line, at);
    const std::optional<double> count = number_of(word);
    if (word.empty() || word.starts_with('#') || !count) return next < 65536;
    found.first = next, found.count = std::size_t(std::max(*count, 0.0));
    is_found = true;
    return false;
  });
  return is_found ? std::optional(found) : std::nullopt;
}

std::optional<Vertices> vertices_of(std::string_view bytes, std::string_view extension) {
  if (extension == ".obj") return Vertices{.form = {"v"}};
  if (extension == ".stl" && bytes.substr(0, 512).find("facet") != std::string_view::npos)
    return Vertices{.form = {"vertex"}};
  if (extension == ".ply") return ply_vertices(bytes);
  if (extension == ".off") return off_vertices(bytes);
  return std::nullopt;
}

double double_at(const char* bytes, bool is_big_endian) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  return std::bit_cast<double>(is_big_endian ? __builtin_bswap64(bits) : bits);
}

void put_double(char* bytes, double value, bool is_big_endian) {
  auto bits = std::bit_cast<std::uint64_t>(value);
  if (is_big_endian) bits = __builtin_bswap64(bits);
  std::memcpy(bytes, &bits, sizeof bits);
}

/// Calls `take(vertex)` for each vertex until it returns false.
void each_vertex(std::string_view bytes, const Vertices& in,
                 const std::function<bool(const LineVertex&)>& take) {
  if (in.stride > 0) {
    for (std::size_t i = 0; i < in.count; ++i) {
      LineVertex vertex;
      for (std::size_t axis = 0; axis < 3; ++axis)
        vertex.position[int(axis)] =
            double_at(bytes.data() + in.first + i * in.stride + in.offset[axis], in.is_big_endian);
      if (!take(vertex)) return;
    }
    return;
  }
  std::size_t left = in.count;
  each_line(bytes, in.first, [&](std::string_view line, std::size_t) {
    const std::optional<LineVertex> vertex = vertex_of(line, in.form);
    return (!vertex || (take(*vertex) && --left > 0)) && left > 0;
  });
}

}  // namespace

std::optional<VertexBox> far_vertices(std::string_view bytes, std::string_view extension) {
  const std::optional<Vertices> vertices = vertices_of(bytes, extension);
  if (!vertices) return std::nullopt;
  std::optional<VertexBox> box;
  each_vertex(bytes, *vertices, [&](const LineVertex& vertex) {
    const glm::dvec3 p = vertex.position, size = glm::abs(p);
    if (!box && std::max({size.x, size.y, size.z}) <= formats::max_local_m) return false;
    if (!box) box = VertexBox{p, p};
    box->low = glm::min(box->low, p), box->high = glm::max(box->high, p);
    return true;
  });
  return box;
}

std::string moved_vertices(std::string_view bytes, std::string_view extension, glm::dvec3 origin) {
  const std::optional<Vertices> vertices = vertices_of(bytes, extension);
  if (!vertices) return std::string(bytes);
  if (vertices->stride > 0) {
    std::string moved(bytes);
    for (std::size_t i = 0; i < vertices->count; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        char* at = moved.data() + vertices->first + i * vertices->stride + vertices->offset[axis];
        put_double(at, double_at(at, vertices->is_big_endian) - origin[int(axis)], vertices->is_big_endian);
      }
    return moved;
  }
  std::string moved;
  moved.reserve(bytes.size());
  const char* done = bytes.data();
  each_vertex(bytes, *vertices, [&](const LineVertex& vertex) {
    std::array<int, 3> order{0, 1, 2};
    std::ranges::sort(order, {}, [&](int axis) { return vertex.words[std::size_t(axis)].data(); });
    for (const int axis : order) {
      const std::string_view word = vertex.words[std::size_t(axis)];
      moved.append(done, word.data());
      moved += fmt::format("{:.9g}", vertex.position[axis] - origin[axis]);
      done = word.data() + word.size();
    }
    return true;
  });
  moved.append(done, bytes.data() + bytes.size());
  return moved;
}

}  // namespace parvis::scene
