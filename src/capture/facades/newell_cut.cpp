#include "capture/facades/newell_cut.h"

#include <algorithm>
#include <array>
#include <set>

#include "capture/facades/item_buffer.h"

namespace parvis::facades {
namespace {

struct Plane {
  glm::dvec3 normal;
  double offset;
};

std::vector<std::size_t> triangles_of(const LayerModel& model, std::uint32_t face) {
  std::vector<std::size_t> found;
  for (std::size_t t = 0; t < model.triangles.size(); ++t)
    if (model.triangles[t].face == face) found.push_back(t);
  return found;
}

Plane plane_of(const std::array<glm::dvec3, 3>& c) {
  const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
  return {normal, glm::dot(normal, c[0])};
}

/// The part of a convex polygon where sign * (dot(normal, p) - offset) >= 0.
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& polygon, const Plane& plane, double sign) {
  std::vector<glm::dvec3> part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec3 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    const double da = glm::dot(plane.normal, a) - plane.offset, db = glm::dot(plane.normal, b) - plane.offset;
    if (sign * da >= 0.0) part.push_back(a);
    // Always from the negative side: both parts get the same corner.
    if ((da < 0.0) != (db < 0.0))
      part.push_back(da < 0.0 ? a + da / (da - db) * (b - a) : b + db / (db - da) * (a - b));
  }
  return part;
}

void add_fan(std::vector<LayerTriangle>& pieces, const LayerTriangle& of, std::uint32_t face,
             const std::vector<glm::dvec3>& polygon) {
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    LayerTriangle piece = of;
    piece.corners = {polygon[0], polygon[k - 1], polygon[k]};
    piece.face = face;
    if (glm::length(glm::cross(piece.corners[1] - piece.corners[0], piece.corners[2] - piece.corners[0])) >
        0.0)
      pieces.push_back(piece);
  }
}

/// How far off a plane a point lies for certain: beyond what counts as a tie in depth.
double tolerance_at(glm::dvec3 eye, const std::array<glm::dvec3, 3>& corners) {
  return 4.0 * depth_tie * glm::distance(eye, corners[0]);
}

/// Gives every triangle of a face a face of its own. False where it has only one.
bool divide(LayerModel& model, std::uint32_t face) {
  const std::vector<std::size_t> triangles = triangles_of(model, face);
  for (std::size_t k = 1; k < triangles.size(); ++k) model.triangles[triangles[k]].face = model.face_count++;
  return triangles.size() > 1;
}

bool cut_by_plane_of(LayerModel& model, std::uint32_t face, std::uint32_t by, glm::dvec3 eye) {
  const auto corners = model.triangles[triangles_of(model, by).front()].corners;
  const Plane plane = plane_of(corners);
  return cut_face(model, face, plane.normal, plane.offset, tolerance_at(eye, corners));
}

/// Cuts a face by the planes through the eye and the edges of `by`.
bool cut_by_outline_of(LayerModel& model, std::uint32_t face, std::uint32_t by, glm::dvec3 eye) {
  const auto corners = model.triangles[triangles_of(model, by).front()].corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 normal = glm::cross(corners[k] - eye, corners[(k + 1) % 3] - eye);
    if (glm::length(normal) == 0.0) continue;
    const glm::dvec3 unit = glm::normalize(normal);
    if (cut_face(model, face, unit, glm::dot(unit, eye), tolerance_at(eye, corners))) return true;
  }
  return false;
}

using Cut = bool (*)(LayerModel&, std::uint32_t, std::uint32_t, glm::dvec3);

/// The first of the pair that the other can cut.
bool cut_either(LayerModel& model, std::uint32_t a, std::uint32_t b, glm::dvec3 eye, Cut cut) {
  return cut(model, a, b, eye) || cut(model, b, a, eye);
}

}  // namespace

bool cut_face(LayerModel& model, std::uint32_t face, glm::dvec3 normal, double offset, double tolerance) {
  const std::vector<std::size_t> triangles = triangles_of(model, face);
  bool reaches_front = false, reaches_behind = false;
  for (const std::size_t t : triangles)
    for (const glm::dvec3& corner : model.triangles[t].corners) {
      const double distance = glm::dot(normal, corner) - offset;
      reaches_front |= distance > tolerance, reaches_behind |= distance < -tolerance;
    }
  if (!reaches_front || !reaches_behind) return false;
  const std::uint32_t behind = model.face_count++;
  std::vector<LayerTriangle> pieces;
  for (const std::size_t t : triangles) {
    const LayerTriangle& whole = model.triangles[t];
    const std::vector<glm::dvec3> polygon(whole.corners.begin(), whole.corners.end());
    add_fan(pieces, whole, face, clipped(polygon, {normal, offset}, 1.0));
    add_fan(pieces, whole, behind, clipped(polygon, {normal, offset}, -1.0));
  }
  for (std::size_t k = 0; k < triangles.size(); ++k) {  // the numbers of other triangles stay
    if (k < pieces.size()) model.triangles[triangles[k]] = pieces[k];
  }
  for (std::size_t k = triangles.size(); k < pieces.size(); ++k) model.triangles.push_back(pieces[k]);
  return true;
}

std::size_t cut_cycle(LayerModel& model, const std::vector<std::uint32_t>& faces,
                      const std::vector<std::vector<std::uint32_t>>& hides, glm::dvec3 eye) {
  std::size_t changes = 0;
  for (const std::uint32_t face : faces) changes += divide(model, face);
  if (changes) return changes;

  const auto hides_each_other = [&](std::uint32_t i, std::uint32_t k) {
    return std::ranges::find(hides[k], i) != hides[k].end();
  };
  std::set<std::uint32_t> touched;  // a face that is cut has other neighbours then
  for (const Cut cut : {Cut(cut_by_plane_of), Cut(cut_by_outline_of)}) {
    for (std::uint32_t i = 0; i < faces.size(); ++i)
      for (const std::uint32_t k : hides[i])
        if (i < k && hides_each_other(i, k) && !touched.contains(i) && !touched.contains(k) &&
            cut_either(model, faces[i], faces[k], eye, cut))
          touched.insert({i, k}), ++changes;
    if (changes) return changes;
    for (std::uint32_t i = 0; i < faces.size(); ++i)
      for (const std::uint32_t k : hides[i])
        if (i != k && cut_either(model, faces[i], faces[k], eye, cut)) return 1;
  }
  return 0;
}

}  // namespace parvis::facades
