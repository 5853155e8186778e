#include "formats/drawings/drawing_facts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace parvis::formats {
namespace {

/// The groups of one entity, table entry or header variable.
using Groups = std::span<const Group>;

const Group* find(Groups groups, int code) {
  const auto found = std::ranges::find(groups, code, &Group::code);
  return found == groups.end() ? nullptr : &*found;
}

std::string text_of(Groups groups, int code) {
  const Group* const group = find(groups, code);
  return group ? std::string(group->value) : "";
}

double real_of(Groups groups, int code, double fallback = 0.0) {
  const Group* const group = find(groups, code);
  return group ? number_of(group->value, fallback) : fallback;
}

int whole_of(Groups groups, int code, int fallback = 0) {
  const Group* const group = find(groups, code);
  return group ? integer_of(group->value, fallback) : fallback;
}

/// Cuts the groups into runs that begin with a group of this code; what stands before the first is left out.
std::vector<Groups> runs(Groups groups, int code) {
  std::vector<Groups> result;
  std::size_t begin = groups.size();
  for (std::size_t i = 0; i <= groups.size(); ++i) {
    if (i < groups.size() && groups[i].code != code) continue;
    if (begin < i) result.push_back(groups.subspan(begin, i - begin));
    begin = i;
  }
  return result;
}

/// The groups between SECTION and ENDSEC, without both; empty where there is no such section.
Groups section(const GroupCodes& codes, std::string_view name) {
  const Groups all(codes.groups);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    if (all[i].code != 0 || all[i].value != "SECTION" || all[i + 1].value != name) continue;
    std::size_t end = i + 2;
    while (end < all.size() && !(all[end].code == 0 && all[end].value == "ENDSEC")) ++end;
    return all.subspan(i + 2, end - i - 2);
  }
  return {};
}

void read_header(Groups header, DrawingFacts& facts) {
  for (const Groups& variable : runs(header, 9)) {
    if (variable.front().value == "$ACADVER") facts.version = text_of(variable, 1);
    if (variable.front().value == "$INSUNITS" && metres_of_unit(whole_of(variable, 70)))
      facts.unit_code = whole_of(variable, 70);
  }
}

void read_layers(Groups tables, DrawingFacts& facts) {
  for (const Groups& entry : runs(tables, 0)) {
    if (entry.front().value != "LAYER") continue;
    const int colour = std::clamp(whole_of(entry, 62, 7), -255, 255);
    facts.layers.push_back(
        {text_of(entry, 2), colour >= 0, (whole_of(entry, 70) & 1) != 0, std::abs(colour)});
  }
}

/// The axes of an entity's own plane (the "arbitrary axis algorithm" of the DXF reference).
glm::dmat3 world_from_plane(glm::dvec3 normal) {
  if (!(glm::length(normal) > 1e-12)) normal = {0, 0, 1};
  normal = glm::normalize(normal);
  constexpr double near_z = 1.0 / 64.0;
  const bool is_near_z = std::abs(normal.x) < near_z && std::abs(normal.y) < near_z;
  const glm::dvec3 x =
      glm::normalize(glm::cross(is_near_z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), normal));
  return {x, glm::cross(normal, x), normal};
}

glm::dvec3 point_of(Groups groups, int first_code, glm::dvec3 fallback = glm::dvec3(0.0)) {
  return {real_of(groups, first_code, fallback.x), real_of(groups, first_code + 10, fallback.y),
          real_of(groups, first_code + 20, fallback.z)};
}

/// All copies of an INSERT; `attributes` are the groups of its ATTRIB entities.
void add_blocks(Groups insert, std::span<const Groups> attributes, DrawingFacts& facts) {
  const glm::dmat3 axes = world_from_plane(point_of(insert, 210, {0, 0, 1}));
  const double angle = real_of(insert, 50) * std::numbers::pi / 180.0;
  const glm::dvec3 along(std::cos(angle), std::sin(angle), 0.0), across(-along.y, along.x, 0.0);
  PlacedBlockEntity placed;
  placed.handle = text_of(insert, 5), placed.layer = text_of(insert, 8);
  PlacedBlock& block = placed.block;
  block.block = text_of(insert, 2);
  const glm::dvec3 scale(real_of(insert, 41, 1.0), real_of(insert, 42, 1.0), real_of(insert, 43, 1.0));
  block.scale = glm::abs(scale);
  const glm::dvec3 y_axis = axes * (across * (scale.y < 0.0 ? -1.0 : 1.0));
  const glm::dvec3 x_axis = axes * (along * (scale.x < 0.0 ? -1.0 : 1.0));
  block.heading_deg = std::fmod(std::atan2(y_axis.x, y_axis.y) * 180.0 / std::numbers::pi + 360.0, 360.0);
  block.is_mirrored = x_axis.x * y_axis.y - x_axis.y * y_axis.x < 0.0;
  for (const Groups& attribute : attributes) block.attributes[text_of(attribute, 2)] = text_of(attribute, 1);
  const int columns = std::max(whole_of(insert, 70, 1), 1), rows = std::max(whole_of(insert, 71, 1), 1);
  const int copies = int(std::min<long>(long(columns) * rows, max_block_copies));
  for (int i = 0; i < copies; ++i) {
    const double column_m = i % columns * real_of(insert, 44), row_m = i / columns * real_of(insert, 45);
    block.position = axes * (point_of(insert, 10) + along * column_m + across * row_m);
    facts.blocks.push_back(placed);
  }
}

/// The width that all of a polyline has; 0 where it changes. `vertices`: of an old POLYLINE.
double polyline_width(Groups entity, std::span<const Groups> vertices) {
  if (const Group* const constant = find(entity, 43)) return std::max(number_of(constant->value), 0.0);
  std::optional<double> width;
  const auto note = [&](Groups groups) {
    for (const Group& group : groups)
      if (group.code == 40 || group.code == 41) {
        const double value = number_of(group.value);
        if (width && *width != value) return false;
        width = value;
      }
    return true;
  };
  if (!note(entity)) return 0.0;
  for (const Groups& vertex : vertices)
    if (!note(vertex)) return 0.0;
  return std::max(width.value_or(0.0), 0.0);
}

void read_entities(Groups section, DrawingFacts& facts) {
  const std::vector<Groups> entities = runs(section, 0);
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const Groups& entity = entities[i];
    const std::string type(entity.front().value);
    std::size_t end = i + 1;  // of the vertices or attributes that follow
    if (type == "POLYLINE" || type == "INSERT")
      while (end < entities.size() &&
             (entities[end].front().value == "VERTEX" || entities[end].front().value == "ATTRIB"))
        ++end;
    const std::span<const Groups> parts = std::span(entities).subspan(i + 1, end - i - 1);
    const bool is_end = end < entities.size() && end > i + 1 && entities[end].front().value == "SEQEND";
    i = end - 1 + (is_end ? 1 : 0);
    if (whole_of(entity, 67) == 1) {
      ++facts.paper_entities;
      continue;
    }
    const std::string layer = text_of(entity, 8);
    ++facts.counts[layer][type];
    const bool is_polyline = type == "POLYLINE" || type == "LWPOLYLINE";
    facts.entities.push_back(
        {type, layer, text_of(entity, 5), is_polyline ? polyline_width(entity, parts) : 0.0});
    if (type != "INSERT") continue;
    for (const Groups& attribute : parts) ++facts.counts[text_of(attribute, 8)]["ATTRIB"];
    add_blocks(entity, parts, facts);
  }
}

}  // namespace

DrawingFacts drawing_facts(const GroupCodes& codes) {
  DrawingFacts facts;
  facts.code_page = code_page_of(codes);
  read_header(section(codes, "HEADER"), facts);
  read_layers(section(codes, "TABLES"), facts);
  read_entities(section(codes, "ENTITIES"), facts);
  return facts;
}

std::string code_page_of(const GroupCodes& codes) {
  for (const Groups& variable : runs(section(codes, "HEADER"), 9))
    if (variable.front().value == "$DWGCODEPAGE") return text_of(variable, 3);
  return {};
}

std::optional<double> metres_of_unit(int insunits) {
  constexpr double inch_m = 0.0254, us_survey_foot_m = 1200.0 / 3937.0;
  switch (insunits) {
    case 1:
      return inch_m;
    case 2:
      return 12.0 * inch_m;
    case 3:
      return 63360.0 * inch_m;  // mile
    case 4:
      return 0.001;
    case 5:
      return 0.01;
    case 6:
      return 1.0;
    case 7:
      return 1000.0;
    case 8:
      return 1e-6 * inch_m;
    case 9:
      return 1e-3 * inch_m;
    case 10:
      return 36.0 * inch_m;  // yard
    case 13:
      return 1e-6;
    case 14:
      return 0.1;
    case 15:
      return 10.0;
    case 16:
      return 100.0;
    case 21:
      return us_survey_foot_m;
    case 22:
      return us_survey_foot_m / 12.0;
    case 23:
      return us_survey_foot_m * 3.0;
    case 24:
      return us_survey_foot_m * 5280.0;
    default:
      return std::nullopt;
  }
}

std::optional<double> metres_of_unit(std::string_view name) {
  static constexpr std::pair<std::string_view, int> units[]{{"m", 6},   {"cm", 5}, {"mm", 4}, {"km", 7},
                                                            {"dm", 14}, {"in", 1}, {"ft", 2}};
  for (const auto& [known, code] : units)
    if (known == name) return metres_of_unit(code);
  return std::nullopt;
}

}  // namespace parvis::formats
