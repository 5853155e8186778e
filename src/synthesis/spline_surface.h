// A bicubic uniform B-spline surface over half a body that is symmetric about the plane y = 0: curvature is
// continuous everywhere, across the plane of symmetry too.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace parvis::synthesis {

/// Columns run round the left side (y >= 0) from the middle of the front to the middle of the back; rows run
/// from the body's lower edge, which is free, up to the middle of its top. Middle points have y = 0.
class SplineSurface {
 public:
  SplineSurface(int columns, int rows, std::vector<glm::vec3> control_points);  ///< column by column

  float end_u() const { return float(columns_ - 1); }
  float end_v() const { return float(rows_ - 1); }

  /// u in 0 .. end_u(), v in 0 .. end_v().
  glm::vec3 position(float u, float v) const;
  /// Unit, outward.
  glm::vec3 normal(float u, float v) const;

 private:
  glm::vec3 control_point(int column, int row) const;
  glm::vec3 blend(float u, float v, bool along_u, bool along_v) const;

  int columns_, rows_;
  std::vector<glm::vec3> points_;
};

}  // namespace parvis::synthesis
