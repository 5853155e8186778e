#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/colour.h"
#include "base/files.h"
#include "formats/drawings/dxf_writer.h"
#include "planning/plan_drawing/plan_files.h"

namespace parvis::plan_drawing {
namespace {

constexpr int circle_corners = 96;  // a crown of 4 m is right to 1 mm

const std::string tree_block = "TREE";

glm::u8vec3 srgb8(glm::vec3 linear) {
  return glm::u8vec3(glm::round(255.0f * glm::clamp(srgb_from_linear(linear), 0.0f, 1.0f)));
}

std::vector<glm::dvec3> circle(double radius) {
  std::vector<glm::dvec3> points;
  for (int k = 0; k <= circle_corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k % circle_corners) / circle_corners;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
  return points;
}

/// A symbol of 1 x 1 m whose front looks to its y axis.
formats::DxfBlock symbol(const std::string& name, bool is_round) {
  const std::vector<glm::dvec3> square{
      {-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}, {-0.5, -0.5, 0}};
  const std::vector<glm::dvec3> front{{-0.1, 0.35, 0}, {0, 0.5, 0}, {0.1, 0.35, 0}};
  return {name, {is_round ? circle(0.5) : square, front}};
}

formats::DxfBlock tree_symbol() {
  return {tree_block, {circle(0.5), {{-0.1, 0, 0}, {0.1, 0, 0}}, {{0, -0.1, 0}, {0, 0.1, 0}}}};
}

const char* layer_name(PlanLayer layer) {
  switch (layer) {
    case PlanLayer::wall:
      return "WALLS";
    case PlanLayer::road:
      return "ROADS";
    case PlanLayer::thing:
      return "THINGS";
    default:
      return "PLANTS";
  }
}

glm::u8vec3 layer_colour(PlanLayer layer) {
  switch (layer) {
    case PlanLayer::wall:
      return {0, 0, 0};
    case PlanLayer::road:
      return {128, 128, 128};
    case PlanLayer::thing:
      return {0, 0, 255};
    default:
      return {0, 128, 0};
  }
}

/// A ground surface, or a plan that is no rectangle and no ellipse.
bool is_polygon(const design::PlacedObject& object) {
  return object.kind == "ground" || (!object.is_round && object.outline.size() != 4);
}

void add_placed(const ScenePlan& plan, formats::DxfPlan& dxf) {
  std::set<std::string> blocks;
  for (const design::PlacedObject& object : plan.placed) {
    const std::string layer = "DESIGN_" + object.design;
    if (is_polygon(object)) {
      formats::DxfLine outline{layer, srgb8(object.colour), {}};
      for (std::size_t i = 0; i <= object.outline.size() && !object.outline.empty(); ++i)
        outline.points.push_back(plan.origin +
                                 glm::dvec3(object.outline[i % object.outline.size()], object.position.z));
      dxf.lines.push_back(std::move(outline));
      continue;
    }
    if (blocks.insert(object.kind).second) dxf.blocks.push_back(symbol(object.kind, object.is_round));
    dxf.inserts.push_back({object.kind, layer, srgb8(object.colour), plan.origin + object.position,
                           object.size_m, std::fmod(360.0 - object.heading_deg, 360.0)});
  }
}

/// Lines and texts, of a layer for each design: MEASURES_ with its name.
void add_measured(const ScenePlan& plan, formats::DxfPlan& dxf) {
  constexpr double text_height_m = 0.25;
  for (const PlanMeasure& each : plan.measured) {
    const std::string layer = "MEASURES_" + each.measured.design;
    formats::DxfLine& line = dxf.lines.emplace_back(formats::DxfLine{layer, {200, 0, 120}, {}});
    for (const glm::dvec3& point : each.line) line.points.push_back(plan.origin + point);
    dxf.texts.push_back({layer, each.text, plan.origin + each.middle, text_height_m});
  }
}

/// A field of CSV (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

Status write_plan_dxf(const std::filesystem::path& file, const ScenePlan& plan) {
  formats::DxfPlan dxf;
  for (const PlanLine& line : plan.lines) {
    if (line.layer == PlanLayer::drawing) continue;  // it is a DXF already
    formats::DxfLine& written =
        dxf.lines.emplace_back(formats::DxfLine{layer_name(line.layer), layer_colour(line.layer), {}});
    for (const glm::dvec3& point : line.points) written.points.push_back(plan.origin + point);
  }
  if (!plan.trees.empty()) dxf.blocks.push_back(tree_symbol());
  for (const PlanTree& tree : plan.trees)
    dxf.inserts.push_back({tree_block,
                           "TREES",
                           layer_colour(PlanLayer::plant),
                           plan.origin + tree.position,
                           {2.0 * tree.crown_radius_m, 2.0 * tree.crown_radius_m, tree.height_m},
                           0.0});
  add_placed(plan, dxf);
  add_measured(plan, dxf);
  if (dxf.lines.empty() && dxf.inserts.empty())
    return error("{}: the scene has nothing that a plan shows", file.string());
  return formats::write_dxf(file, dxf);
}

Status write_plan_csv(const std::filesystem::path& file, const ScenePlan& plan) {
  std::string text = "kind,name,x,y,z,heading_deg,width_m,depth_m,height_m,design,value,unit\r\n";
  const auto add = [&](const std::string& kind, const std::string& name, const glm::dvec3& position,
                       double heading_deg, const glm::dvec3& size_m, const std::string& design) {
    const glm::dvec3 at = plan.origin + position;
    text +=
        fmt::format("{},{},{:.3f},{:.3f},{:.3f},{:.2f},{:.3f},{:.3f},{:.3f},{},,\r\n", field(kind),
                    field(name), at.x, at.y, at.z, heading_deg, size_m.x, size_m.y, size_m.z, field(design));
  };
  for (const design::PlacedObject& object : plan.placed)
    add(object.kind, object.name, object.position, object.heading_deg, object.size_m, object.design);
  for (const PlanTree& tree : plan.trees)
    add("tree", tree.name, tree.position, 0.0,
        {2.0 * tree.crown_radius_m, 2.0 * tree.crown_radius_m, tree.height_m}, "");
  for (const auto& [each, line, middle, shown] : plan.measured) {
    const glm::dvec3 at = plan.origin + each.points.front();
    text += fmt::format("{},{},{:.3f},{:.3f},{:.3f},,,,,{},{:.4f},{}\r\n",
                        design::quantity_names()[std::size_t(each.quantity)], field(each.name), at.x, at.y,
                        at.z, field(each.design), each.value(), each.unit());
  }
  return write_file(file, text);
}

}  // namespace parvis::plan_drawing
