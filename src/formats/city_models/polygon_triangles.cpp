#include "formats/city_models/polygon_triangles.h"

#include <GL/glu.h>

#include <deque>

namespace parvis::scene {
namespace {

/// What the tessellator's callbacks fill.
struct Output {
  std::vector<glm::dvec3>& points;
  std::deque<std::uint32_t> indices{};  ///< what vertex data points to; places stay
  std::vector<std::uint32_t> triangles{};
};

void emit_corner(void* index, void* output) {
  static_cast<Output*>(output)->triangles.push_back(*static_cast<std::uint32_t*>(index));
}

void add_crossing(GLdouble place[3], void* [4], GLfloat[4], void** index, void* data) {
  Output& output = *static_cast<Output*>(data);
  output.indices.push_back(std::uint32_t(output.points.size()));
  output.points.emplace_back(place[0], place[1], place[2]);
  *index = &output.indices.back();
}

void ignore_edge_flag(GLboolean, void*) {}  // its presence makes the tessellator give plain triangles

template <class Function>
_GLUfuncptr callback(Function* function) {
  return reinterpret_cast<_GLUfuncptr>(function);
}

}  // namespace

glm::dvec3 newell_normal(const std::vector<glm::dvec3>& ring) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) sum += glm::cross(ring[i], ring[(i + 1) % ring.size()]);
  return sum;
}

std::vector<std::uint32_t> triangulated(const std::vector<std::vector<glm::dvec3>>& rings, glm::dvec3 normal,
                                        std::vector<glm::dvec3>& points, Inside inside) {
  points.clear();
  for (const auto& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
  if (rings.size() == 1 && points.size() == 3) return {0, 1, 2};

  Output output{points};
  GLUtesselator* tessellator = gluNewTess();
  gluTessCallback(tessellator, GLU_TESS_VERTEX_DATA, callback(emit_corner));
  gluTessCallback(tessellator, GLU_TESS_COMBINE_DATA, callback(add_crossing));
  gluTessCallback(tessellator, GLU_TESS_EDGE_FLAG_DATA, callback(ignore_edge_flag));
  gluTessProperty(tessellator, GLU_TESS_WINDING_RULE,
                  inside == Inside::odd ? GLU_TESS_WINDING_ODD : GLU_TESS_WINDING_POSITIVE);
  gluTessNormal(tessellator, normal.x, normal.y, normal.z);
  gluTessBeginPolygon(tessellator, &output);
  std::vector<glm::dvec3> corners = points;  // the tessellator keeps pointers while `points` may grow
  std::size_t next = 0;
  for (const auto& ring : rings) {
    gluTessBeginContour(tessellator);
    for (std::size_t i = 0; i < ring.size(); ++i, ++next) {
      output.indices.push_back(std::uint32_t(next));
      gluTessVertex(tessellator, &corners[next].x, &output.indices.back());
    }
    gluTessEndContour(tessellator);
  }
  gluTessEndPolygon(tessellator);
  gluDeleteTess(tessellator);
  return std::move(output.triangles);
}

}  // namespace parvis::scene
