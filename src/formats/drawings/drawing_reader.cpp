#include "formats/drawings/drawing_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/files.h"
#include "base/isolated_process.h"
#include "base/sealed_file.h"
#include "formats/drawings/drawing_bytes.h"
#include "formats/drawings/drawing_facts.h"
#include "formats/drawings/drawing_geometry.h"
#include "formats/drawings/drawing_text.h"
#include "formats/readers/isolated_reader.h"

namespace parvis::formats {
namespace {

constexpr std::uint64_t max_drawing_bytes = std::uint64_t{512} << 20;

/// Where Lambert-93 and its zones (RGF93 CC42 to CC50) lie, if coordinates are metres.
bool is_french_map(const glm::dvec3& min, const glm::dvec3& max) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  const bool is_lambert_93 = within(min.x, 1e5, 1.3e6) && within(min.y, 6e6, 7.2e6);
  const bool is_zone = within(min.x, 1.1e6, 2.3e6) && within(min.y, 1e6, 9.5e6);
  return (is_lambert_93 || is_zone) && max.x - min.x < 2e5 && max.y - min.y < 2e5;
}

std::string in_units(const Drawing& drawing, double unit_m) {
  const glm::dvec3 size = drawing.max - drawing.min;
  return fmt::format("{:.4g} x {:.4g} m", size.x * unit_m, size.y * unit_m);
}

/// The error for a drawing in the file's own numbers of which nobody says the unit.
Error ask_for_unit(const Drawing& drawing, const std::string& file, std::string_view why) {
  return error_at({file, 0, 0},
                  "{}: drawn in metres it measures {}, in centimetres {}, in millimetres {}; say which: "
                  "unit=\"m\", \"cm\" or \"mm\"",
                  why, in_units(drawing, 1.0), in_units(drawing, 0.01), in_units(drawing, 0.001));
}

/// Middle and size of what each placed block draws, along its own axes. The copies of an array share a
/// handle, and which line is whose is not known: the extent of all less the way from the first copy to the
/// last is that of one.
void measure_blocks(const DrawingFacts& facts, const DrawingGeometry& geometry, Drawing& drawing) {
  std::unordered_map<std::string, std::vector<std::size_t>> copies_of;
  for (std::size_t b = 0; b < facts.blocks.size(); ++b) copies_of[facts.blocks[b].handle].push_back(b);
  for (std::size_t b = 0; b < drawing.blocks.size(); ++b) {
    const std::string& handle = facts.blocks[b].handle;
    const auto lines = geometry.lines_of.find(handle);
    const std::vector<std::size_t>& copies = copies_of[handle];
    if (handle.empty() || lines == geometry.lines_of.end() || copies.size() >= max_block_copies) continue;
    PlacedBlock& block = drawing.blocks[b];
    const double heading = block.heading_deg * std::numbers::pi / 180.0;
    const glm::dvec2 y(std::sin(heading), std::cos(heading)), x(y.y, -y.x);
    const auto along = [&](const glm::dvec3& point) {
      const glm::dvec2 from(point - block.position);
      return glm::dvec2(glm::dot(from, x), glm::dot(from, y));
    };
    glm::dvec2 min(std::numeric_limits<double>::max()), max(-min), first(0.0), last(0.0);
    for (const std::size_t line : lines->second)
      for (const glm::dvec3& point : drawing.lines[line].points)
        min = glm::min(min, along(point)), max = glm::max(max, along(point));
    if (min.x > max.x) continue;
    for (const std::size_t copy : copies) {
      const glm::dvec2 at = along(drawing.blocks[copy].position);
      first = glm::min(first, at), last = glm::max(last, at);
    }
    min -= first, max -= last;
    const glm::dvec2 middle = 0.5 * (min + max);
    block.centre = glm::dvec2(block.position) + middle.x * x + middle.y * y;
    block.size_m = max - min;
  }
}

/// The placed blocks in metres, on the layers of the drawing.
void add_blocks(const DrawingFacts& facts, Drawing& drawing) {
  std::map<std::string, int> index_of;
  for (std::size_t i = 0; i < drawing.layers.size(); ++i) index_of[drawing.layers[i].name] = int(i);
  for (const PlacedBlockEntity& placed : facts.blocks) {
    const auto [layer, is_new] = index_of.try_emplace(placed.layer, int(drawing.layers.size()));
    if (is_new) drawing.layers.push_back({.name = placed.layer});
    PlacedBlock& block = drawing.blocks.emplace_back(placed.block);
    block.layer = layer->second;
    block.position *= drawing.metres_per_unit;
  }
}

/// Counts the entities that drew nothing: those that GDAL does not know, and damaged ones. A block may be
/// empty, and so may a text.
void count_left_out(const DrawingFacts& facts, const DrawingGeometry& geometry, Drawing& drawing) {
  for (const DrawingEntity& entity : facts.entities) {
    const bool may_be_empty = entity.type == "INSERT" || entity.type == "TEXT" || entity.type == "MTEXT";
    if (may_be_empty || entity.handle.empty() || geometry.lines_of.contains(entity.handle)) continue;
    ++drawing.left_out[entity.type];
  }
  drawing.far_away = int(geometry.far_away);
}

/// The unit of a drawing of which nobody but the file has said it, once its extent is known.
Status check_unit(const DrawingFacts& facts, const Drawing& drawing, const std::string& file) {
  if (!facts.unit_code) return ask_for_unit(drawing, file, "this drawing names no unit ($INSUNITS)");
  constexpr int inches = 1;
  const glm::dvec3 min = drawing.min / drawing.metres_per_unit, max = drawing.max / drawing.metres_per_unit;
  if (*facts.unit_code != inches || !is_french_map(min, max)) return Ok{};
  Drawing in_file = drawing;
  in_file.min = min, in_file.max = max;
  return ask_for_unit(
      in_file, file,
      "this drawing says that it is in inches, as programs do that leave $INSUNITS as it was, "
      "but lies where French maps do in metres");
}

Status read_in_worker(std::string_view input, IsolatedOutput& output) {
  ByteReader reader(input);
  const bool is_given = reader.take<bool>();
  const double unit = reader.take<double>();
  const std::string file(reader.rest());
  const Result<std::string> bytes = read_file(file, max_drawing_bytes);
  if (!bytes) return bytes.errors();
  Errors warnings;
  const Result<Drawing> drawing =
      parse_drawing(*bytes, file, is_given ? std::optional(unit) : std::nullopt, warnings);
  if (!drawing) return drawing.errors();
  const std::string result = bytes_of_warnings(warnings) + bytes_of(*drawing);
  const std::span<std::byte> to = output.allocate(result.size());
  if (to.empty()) return error("{}: there is no memory for its {} bytes", file, result.size());
  std::memcpy(to.data(), result.data(), result.size());
  return Ok{};
}

}  // namespace

Result<Drawing> parse_drawing(std::string_view bytes, const std::string& file,
                              std::optional<double> metres_per_unit, Errors& warnings) {
  Result<GroupCodes> codes = group_codes(bytes, file);
  if (!codes) return codes.errors();
  decode_texts(*codes, code_page_of(*codes), file, warnings);
  const DrawingFacts facts = drawing_facts(*codes);
  Drawing drawing;
  drawing.version = facts.version, drawing.layers = facts.layers;
  drawing.metres_per_unit = metres_per_unit   ? *metres_per_unit
                            : facts.unit_code ? *metres_of_unit(*facts.unit_code)
                                              : 1.0;
  const Result<DrawingGeometry> geometry = add_geometry(as_text(*codes), facts, file, drawing);
  if (!geometry) return geometry.errors();
  if (!metres_per_unit)
    if (Status status = check_unit(facts, drawing, file); !status) return status.errors();
  add_blocks(facts, drawing);
  measure_blocks(facts, *geometry, drawing);
  drawing.entity_counts = facts.counts, drawing.paper_entities = facts.paper_entities;
  count_left_out(facts, *geometry, drawing);
  if (drawing.lines.empty() && drawing.areas.empty() && drawing.texts.empty() && drawing.points.empty()) {
    std::string reason;
    for (const auto& [type, count] : drawing.left_out)
      reason += fmt::format("{}{} {}", reason.empty() ? "; not read: " : ", ", count, type);
    if (facts.paper_entities > 0)
      reason += "; its layouts (paper space) are not read: copy what they show into model space";
    return error_at({file, 0, 0}, "nothing is drawn in model space{}", reason);
  }
  return drawing;
}

Result<Drawing> read_drawing(const std::filesystem::path& file, std::optional<double> metres_per_unit,
                             Errors& warnings) {
  std::string input;
  append_value(input, metres_per_unit.has_value());
  append_value(input, metres_per_unit.value_or(0.0));
  input += std::filesystem::absolute(file).string();
  const Result<IsolatedBytes> made = run_isolated(&read_in_worker, input, file.string(), limits_for(file));
  if (!made) return made.errors();
  ByteReader reader({reinterpret_cast<const char*>(made->bytes().data()), made->bytes().size()});
  take_warnings(reader, warnings);
  return drawing_of(reader.rest(), file.string());
}

}  // namespace parvis::formats
