#include "planning/plan_drawing/placed_blocks.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "formats/drawings/group_codes.h"
#include "planning/plan_drawing/layer_choice.h"
#include "scene/data/name_pattern.h"

namespace parvis::plan_drawing {
namespace {

constexpr std::array name_attributes{"NUM", "NOM", "NAME", "ID"};
constexpr std::array height_attributes{"HAUTEUR", "HAUTEUR_M", "HEIGHT", "HEIGHT_M"};
constexpr double max_height_m = 1000.0;
constexpr double round_difference = 0.01;  // of width and depth of a crown

template <class Names>
std::string attribute_of(const formats::PlacedBlock& block, const Names& names) {
  for (const char* name : names)
    if (const auto found = block.attributes.find(name); found != block.attributes.end()) return found->second;
  return {};
}

/// The turn of the plan in the world, clockwise from above, degrees.
double turn_deg(const glm::mat4& world_from_plan) {
  const glm::vec4& y = world_from_plan[1];
  return std::atan2(double(y.x), double(y.y)) * 180.0 / std::numbers::pi;
}

}  // namespace

Result<std::vector<std::pair<std::string, std::string>>> block_kinds(const std::string& table) {
  std::vector<std::pair<std::string, std::string>> kinds;
  for (const std::string& entry : divided_at_commas(table)) {
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == entry.size())
      return error("\"{}\": expected NAME=KIND, as in \"ARBRE*=tree, BANC=bench\"", entry);
    kinds.emplace_back(trimmed(entry.substr(0, equals)), trimmed(entry.substr(equals + 1)));
  }
  return kinds;
}

std::vector<design::PlacedObject> placed_blocks(const PlacedDrawing& placed) {
  std::vector<design::PlacedObject> objects;
  std::map<std::string, int> numbers;
  const double scale = double(glm::length(glm::vec3(placed.world_from_plan[1])));
  const double turn = turn_deg(placed.world_from_plan);
  for (const formats::PlacedBlock& block : placed.drawing->blocks) {
    const auto kind = std::ranges::find_if(
        placed.block_kinds, [&](const auto& entry) { return scene::matches(entry.first, block.block); });
    if (kind == placed.block_kinds.end() || !placed.shows_layer[std::size_t(block.layer)]) continue;
    design::PlacedObject object;
    object.kind = kind->second, object.label = kind->second, object.design = placed.called;
    const std::string name = attribute_of(block, name_attributes);
    object.name = name.empty() ? fmt::format("{}_{}", object.kind, ++numbers[object.kind]) : name;
    const glm::dvec3 middle(block.centre.value_or(glm::dvec2(block.position)), block.position.z);
    const glm::vec3 at = placed.in_world(middle);
    object.position = {at.x, at.y, block.position.z - placed.origin.z};
    object.heading_deg = std::fmod(block.heading_deg + turn + 360.0, 360.0);
    const double height = formats::number_of(attribute_of(block, height_attributes));
    object.size_m = scale * glm::dvec3(block.size_m.value_or(glm::dvec2(1.0)), 0.0);
    if (height > 0.0 && height < max_height_m) object.size_m.z = height;
    object.is_round = object.kind.find("tree") != std::string::npos &&
                      std::abs(object.size_m.x - object.size_m.y) <= round_difference * object.size_m.x;
    const glm::dvec2 centre(object.position), size(object.size_m);
    object.outline = object.is_round ? design::ellipse_outline(centre, size, object.heading_deg)
                                     : design::rectangle_outline(centre, size, object.heading_deg);
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace parvis::plan_drawing
