#include "formats/drawings/drawing_bytes.h"

#include <algorithm>
#include <cmath>

#include "base/sealed_file.h"
#include "base/utf8.h"

namespace parvis::formats {
namespace {

/// Writes and reads have the same shape: `describe` names each member once.
class Writer {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void value(const T& value) { append_value(bytes_, value); }
  void value(const std::string& text) { value(std::uint64_t(text.size())), bytes_ += text; }
  template <class T, class Each>
  void list(const std::vector<T>& list, const Each& each) {
    value(std::uint64_t(list.size()));
    for (const T& item : list) each(item);
  }
  template <class Value, class Each>
  void map(const std::map<std::string, Value>& map, const Each& each) {
    value(std::uint64_t(map.size()));
    for (const auto& [key, item] : map) value(key), each(item);
  }
  std::string take() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : taker_(bytes) {}
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void value(T& value) { value = taker_.take<T>(); }
  void value(std::string& text) { text = taker_.take_bytes(taker_.take<std::uint64_t>()), repair_utf8(text); }
  template <class T, class Each>
  void list(std::vector<T>& list, const Each& each) {
    for (auto left = taker_.take<std::uint64_t>(); left > 0 && !taker_.has_ended_early(); --left)
      each(list.emplace_back());
  }
  template <class Value, class Each>
  void map(std::map<std::string, Value>& map, const Each& each) {
    for (auto left = taker_.take<std::uint64_t>(); left > 0 && !taker_.has_ended_early(); --left) {
      std::string key;
      value(key), each(map[key]);
    }
  }
  bool is_complete() const { return taker_.is_at_end(); }

 private:
  ByteReader taker_;
};

template <class Io, class AnyDrawing>
void describe(Io& io, AnyDrawing& drawing) {
  const auto value = [&](auto& item) { io.value(item); };
  io.value(drawing.version), io.value(drawing.metres_per_unit), io.value(drawing.min), io.value(drawing.max);
  io.list(drawing.layers, [&](auto& layer) {
    io.value(layer.name), io.value(layer.is_on), io.value(layer.is_frozen), io.value(layer.colour_index);
  });
  io.list(drawing.lines, [&](auto& line) {
    io.value(line.layer), io.value(line.colour), io.value(line.width_m), io.list(line.points, value);
  });
  io.list(drawing.areas, [&](auto& area) {
    io.value(area.layer), io.value(area.colour), io.value(area.is_solid);
    io.list(area.rings, [&](auto& ring) { io.list(ring, value); });
  });
  io.list(drawing.texts, [&](auto& text) {
    io.value(text.layer), io.value(text.colour), io.value(text.text), io.value(text.position);
    io.value(text.height_m), io.value(text.angle_deg), io.value(text.anchor);
  });
  io.list(drawing.points, [&](auto& point) { io.value(point.layer), io.value(point.position); });
  io.list(drawing.blocks, [&](auto& block) {
    io.value(block.layer), io.value(block.block), io.value(block.position), io.value(block.heading_deg);
    io.value(block.scale), io.value(block.is_mirrored), io.map(block.attributes, value);
    io.value(block.centre), io.value(block.size_m);
  });
  io.map(drawing.entity_counts, [&](auto& types) { io.map(types, value); });
  io.map(drawing.left_out, value);
  io.value(drawing.paper_entities), io.value(drawing.far_away);
}

bool is_sound(const Drawing& drawing) {
  const auto has_layer = [&](const auto& item) {
    return item.layer >= 0 && std::size_t(item.layer) < drawing.layers.size();
  };
  const auto are_finite = [](const std::vector<glm::dvec3>& points) {
    return std::ranges::all_of(points, [](const glm::dvec3& p) { return std::isfinite(p.x + p.y + p.z); });
  };
  return std::ranges::all_of(drawing.lines,
                             [&](const DrawingLine& line) {
                               return has_layer(line) && line.points.size() >= 2 && are_finite(line.points);
                             }) &&
         std::ranges::all_of(drawing.areas,
                             [&](const DrawingArea& area) {
                               return has_layer(area) && std::ranges::all_of(area.rings, are_finite);
                             }) &&
         std::ranges::all_of(drawing.texts, has_layer) && std::ranges::all_of(drawing.points, has_layer) &&
         std::ranges::all_of(drawing.blocks, has_layer);
}

}  // namespace

std::string bytes_of(const Drawing& drawing) {
  Writer writer;
  describe(writer, drawing);
  return std::move(writer).take();
}

Result<Drawing> drawing_of(std::string_view bytes, const std::string& subject) {
  Drawing drawing;
  Reader reader(bytes);
  describe(reader, drawing);
  if (!reader.is_complete() || !is_sound(drawing))
    return error("{}: its reader returned a drawing that is damaged", subject);
  return drawing;
}

}  // namespace parvis::formats
