// Collects the triangles of the square by group and material, in the frame of the wall that is being built.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "places/paper_city/street_plan.h"
#include "places/square/square_material.h"

namespace parvis::square {

using city::Frame;

/// Triangles under construction. Coordinates are those of the frame: x along the wall, y inward from it, z
/// up; what stands out from the wall has a negative y.
class ReliefMesh {
 public:
  /// Starts a group: triangles that follow belong to it, and stand in this frame.
  void begin_group(std::string name, const Frame& frame) { group_ = std::move(name), frame_ = frame; }
  void set_frame(const Frame& frame) { frame_ = frame; }  ///< within the group
  const Frame& frame() const { return frame_; }           ///< in which triangles stand
  /// The colour that follows (linear albedo of sheets that are grey).
  void set_colour(glm::vec3 albedo) { tint_ = albedo / sheet_albedo; }

  /// A quad, counter-clockwise seen from outside, flat; texture coordinates in metres on its plane.
  void quad(Surface surface, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);
  /// The same with the texture coordinates of its corners.
  void quad(Surface surface, const glm::vec3 (&corners)[4], const glm::vec2 (&uvs)[4]);
  /// A triangle in the same way as the first quad.
  void triangle(Surface surface, glm::vec3 a, glm::vec3 b, glm::vec3 c);
  /// An upright rectangle that looks out of the wall, at depth y.
  void face(Surface surface, float x0, float x1, float z0, float z1, float y = 0.0f);
  /// A rectangle with the corners `foot` and `top` of a sheet.
  void picture(Surface surface, float x0, float x1, float z0, float z1, float y, glm::vec2 foot,
               glm::vec2 top);
  /// A box that stands out from the wall: front, sides, lid and underside.
  void box(Surface surface, glm::vec3 low, glm::vec3 high);
  /// A moulding from x0 to x1: its profile (out of the wall, up) runs upward.
  void moulding(Surface surface, float x0, float x1, float z, std::span<const glm::vec2> profile);
  /// A mesh in the frame, in the present colour.
  void mesh(Surface surface, const Mesh& mesh);

  std::size_t triangle_count() const { return triangles_; }  ///< of all groups
  /// Moves all meshes into parts of `model`, named "group material", on node 0.
  void move_into(scene::Model& model);

 private:
  void corner(Mesh& mesh, glm::vec3 position, glm::vec3 normal, glm::vec2 uv);

  std::string group_;
  Frame frame_;
  glm::vec3 tint_{1.0f};
  std::map<std::pair<std::string, Surface>, Mesh> meshes_;
  std::size_t triangles_ = 0;
};

}  // namespace parvis::square
