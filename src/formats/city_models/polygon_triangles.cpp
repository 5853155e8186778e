#include "formats/city_models/polygon_triangles.h"

#include <GL/glu.h>

#include <deque>

namespace parvis::scene {
namespace {

/// Output that the tessellator's callbacks fill.
struct Output {
  std::vector<glm::dvec3>& points;
  std::deque<std::uint32_t> indices{};   ///< what vertex data points to; places stay
  std::vector<std::uint32_t> corners{};  ///< of the triangles, or of the outlines
  std::vector<std::size_t> begins{};     ///< of each outline, in `corners`
};

void begin_output(GLenum, void* output) {
  Output& to = *static_cast<Output*>(output);
  to.begins.push_back(to.corners.size());
}

void emit_corner(void* index, void* output) {
  static_cast<Output*>(output)->corners.push_back(*static_cast<std::uint32_t*>(index));
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

GLdouble winding_rule(Inside inside) {
  if (inside == Inside::odd) return GLU_TESS_WINDING_ODD;
  return inside == Inside::positive ? GLU_TESS_WINDING_POSITIVE : GLU_TESS_WINDING_ABS_GEQ_TWO;
}

/// `points` are those of the rings; the tessellator adds those where edges cross.
Output tessellated(const std::vector<std::vector<glm::dvec3>>& rings, glm::dvec3 normal,
                   std::vector<glm::dvec3>& points, Inside inside, bool outlines_only) {
  Output output{points};
  GLUtesselator* tessellator = gluNewTess();
  gluTessCallback(tessellator, GLU_TESS_BEGIN_DATA, callback(begin_output));
  gluTessCallback(tessellator, GLU_TESS_VERTEX_DATA, callback(emit_corner));
  gluTessCallback(tessellator, GLU_TESS_COMBINE_DATA, callback(add_crossing));
  if (!outlines_only) gluTessCallback(tessellator, GLU_TESS_EDGE_FLAG_DATA, callback(ignore_edge_flag));
  gluTessProperty(tessellator, GLU_TESS_WINDING_RULE, winding_rule(inside));
  gluTessProperty(tessellator, GLU_TESS_BOUNDARY_ONLY, outlines_only ? GL_TRUE : GL_FALSE);
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
  return output;
}

std::vector<glm::dvec3> points_of(const std::vector<std::vector<glm::dvec3>>& rings) {
  std::vector<glm::dvec3> points;
  for (const auto& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
  return points;
}

}  // namespace

glm::dvec3 newell_normal(const std::vector<glm::dvec3>& ring) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) sum += glm::cross(ring[i], ring[(i + 1) % ring.size()]);
  return sum;
}

std::vector<std::uint32_t> triangulated(const std::vector<std::vector<glm::dvec3>>& rings, glm::dvec3 normal,
                                        std::vector<glm::dvec3>& points, Inside inside) {
  points = points_of(rings);
  if (rings.size() == 1 && points.size() == 3) return {0, 1, 2};
  return tessellated(rings, normal, points, inside, false).corners;
}

std::vector<std::vector<glm::dvec3>> outlines(const std::vector<std::vector<glm::dvec3>>& rings,
                                              glm::dvec3 normal, Inside inside) {
  std::vector<glm::dvec3> points = points_of(rings);
  const Output output = tessellated(rings, normal, points, inside, true);
  std::vector<std::vector<glm::dvec3>> found;
  found.reserve(output.begins.size());
  for (std::size_t ring = 0; ring < output.begins.size(); ++ring) {
    const std::size_t end = ring + 1 < output.begins.size() ? output.begins[ring + 1] : output.corners.size();
    std::vector<glm::dvec3>& corners = found.emplace_back();
    for (std::size_t i = output.begins[ring]; i < end; ++i) corners.push_back(points[output.corners[i]]);
  }
  return found;
}

}  // namespace parvis::scene
