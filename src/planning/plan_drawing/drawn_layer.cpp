#include "planning/plan_drawing/drawn_layer.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/colour.h"
#include "formats/city_models/polygon_triangles.h"
#include "planning/plan_drawing/text_outlines.h"

namespace parvis::plan_drawing {
namespace {

// Lines over areas, layers over each other, below the 2 cm that plans lie above the ground.
constexpr float line_rise_m = 0.008f, layer_rise_m = 0.0005f;
constexpr int distinct_layers = 16;
/// Curved mirrors place vertices and connect them by straight edges.
constexpr double max_edge_m = 4.0;
/// Hatches that are patterns are shown as a tint of their colour, and so are large areas: what stands on them
/// remains readable. Arrow heads keep theirs.
constexpr float pattern_tint = 0.75f, large_tint = 0.5f;
constexpr double large_m2 = 2.0;
constexpr double point_size_m = 0.25;  // of the cross of a survey point

/// The parts of a model, one for each colour.
class LayerSheet {
 public:
  LayerSheet(scene::Model& model, const std::string& layer, const glm::dvec3& origin)
      : model_(model), layer_(layer), origin_(origin) {}

  void add_strip(const std::vector<glm::dvec3>& points, double width_m, glm::vec3 colour, float z) {
    Mesh& mesh = mesh_of(colour);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const glm::dvec2 from(points[i]), to(points[i + 1]);
      const double length = glm::distance(from, to);
      if (!(length > 1e-6)) continue;
      const glm::dvec2 along = (to - from) / length, half = 0.5 * width_m * along, side(-half.y, half.x);
      const int pieces = std::max(1, int(std::ceil(length / max_edge_m)));
      // Longer by half the width at both ends, so that corners are whole.
      const glm::dvec2 first = from - half, step = (to - from + 2.0 * half) / double(pieces);
      for (int k = 0; k < pieces; ++k)
        add_quad(mesh, first + double(k) * step, first + double(k + 1) * step, side, z);
    }
  }

  void add_area(const std::vector<std::vector<glm::dvec3>>& rings, glm::vec3 colour, float z,
                scene::Inside inside) {
    std::vector<std::vector<glm::dvec3>> flat = rings;
    std::vector<glm::dvec3> points;
    for (std::vector<glm::dvec3>& ring : flat)
      for (glm::dvec3& point : ring) point = {glm::dvec2(point - origin_), 0.0}, points.push_back(point);
    const std::vector<std::uint32_t> triangles = scene::triangulated(flat, {0.0, 0.0, 1.0}, points, inside);
    Mesh& mesh = mesh_of(colour);
    const auto first = std::uint32_t(mesh.positions.size());
    for (const glm::dvec3& point : points) add_vertex(mesh, {point.x, point.y, z});
    for (const std::uint32_t corner : triangles) mesh.indices.push_back(first + corner);
  }

 private:
  Mesh& mesh_of(glm::vec3 colour) {
    const auto [found, is_new] = part_of_.try_emplace({colour.x, colour.y, colour.z}, model_.parts.size());
    if (is_new) {
      scene::Material material;
      material.name = layer_, material.base_colour = colour, material.roughness = 1.0f;
      scene::Part part;
      part.object = layer_, part.material = int(model_.materials.size());
      part.casts_shadow = false, part.is_backdrop = true;
      model_.materials.push_back(material), model_.parts.push_back(std::move(part));
    }
    return model_.parts[found->second].mesh;
  }

  static void add_vertex(Mesh& mesh, glm::vec3 position) {
    mesh.positions.push_back(position), mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
    mesh.uvs.emplace_back(position.x, -position.y);
  }

  void add_quad(Mesh& mesh, glm::dvec2 from, glm::dvec2 to, glm::dvec2 side, float z) {
    const auto first = std::uint32_t(mesh.positions.size());
    const glm::dvec2 about(origin_);
    for (const glm::dvec2 corner : {from - side, to - side, to + side, from + side})
      add_vertex(mesh, {glm::vec2(corner - about), z});
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
  }

  scene::Model& model_;
  std::string layer_;
  glm::dvec3 origin_;
  std::map<std::array<float, 3>, std::size_t> part_of_;
};

glm::vec3 linear(glm::u8vec3 colour) { return linear_from_srgb8(colour.x, colour.y, colour.z); }

std::vector<glm::dvec3> bar(const glm::dvec3& middle, const glm::dvec3& half) {
  return {middle - half, middle + half};
}

}  // namespace

scene::Model layer_model(const formats::Drawing& drawing, int layer, const glm::dvec3& origin,
                         double line_width_m) {
  scene::Model model;
  model.name = drawing.layers[std::size_t(layer)].name;
  model.nodes.front().name = model.name;
  model.origin = origin;
  LayerSheet sheet(model, model.name, origin);
  const float z = layer_rise_m * float(layer % distinct_layers);
  for (const formats::DrawingArea& area : drawing.areas)
    if (area.layer == layer) {
      const bool is_large = glm::length(scene::newell_normal(area.rings.front())) > 2.0 * large_m2;
      const float tint = !area.is_solid ? pattern_tint : is_large ? large_tint : 0.0f;
      sheet.add_area(area.rings, glm::mix(linear(area.colour), glm::vec3(1.0f), tint), z, scene::Inside::odd);
    }
  for (const formats::DrawingLine& line : drawing.lines)
    if (line.layer == layer)
      sheet.add_strip(line.points, line.width_m > 0.0 ? line.width_m : line_width_m, linear(line.colour),
                      z + line_rise_m);
  for (const formats::DrawingPoint& point : drawing.points)
    if (point.layer == layer)
      for (const glm::dvec3 half : {glm::dvec3(point_size_m, 0, 0), glm::dvec3(0, point_size_m, 0)})
        sheet.add_strip(bar(point.position, 0.5 * half), line_width_m, glm::vec3(0.0f), z + line_rise_m);
  for (const formats::DrawingText& text : drawing.texts)
    if (text.layer == layer)
      for (const auto& glyph : text_outlines(text))
        sheet.add_area(glyph, linear(text.colour), z + line_rise_m, scene::Inside::odd);
  std::erase_if(model.parts, [](const scene::Part& part) { return part.mesh.indices.empty(); });
  return model;
}

}  // namespace parvis::plan_drawing
