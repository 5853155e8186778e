// Grown plants on the GPU: corners of leaves, points, tubes and lines of all shapes in flat buffers.
#pragma once

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

#include "graphics/gl/objects.h"
#include "life/vegetation/plant_shape.h"

namespace parvis::vegetation {

/// Where a shape begins in the buffers.
struct ShapeRange {
  std::uint32_t full = 0, simple = 0;      ///< corners of leaves, in the order of PlantShape::clustered
  std::uint32_t points = 0;                ///< in prefix order
  std::uint32_t clustered_points = 0;      ///< in the order of PlantShape::clustered
  std::uint32_t wood = 0, wood_index = 0;  ///< corners and indices of tubes
  std::uint32_t lines = 0;                 ///< two corners per twig
};

/// The four vertex arrays; binding 1 of each is for the records of plant_record.glsl.
class PlantBuffers {
 public:
  using Shapes = std::vector<std::shared_ptr<const PlantShape>>;

  PlantBuffers() = default;
  /// Uploads distinct shapes.
  explicit PlantBuffers(Shapes shapes);

  /// Where a shape begins; null if it was not uploaded.
  const ShapeRange* find(const PlantShape* shape) const {
    const auto found = ranges_.find(shape);
    return found == ranges_.end() ? nullptr : &found->second;
  }
  /// First index (of 16 bits) of the leaves of a cluster, full or simple: the same for all clusters.
  static std::uint32_t first_index(LeafForm form, bool is_full);

  const Shapes& shapes() const { return shapes_; }       ///< as uploaded
  GLuint leaves() const { return leaf_array_.name(); }   ///< indexed triangles
  GLuint points() const { return point_array_.name(); }  ///< one corner each
  GLuint wood() const { return wood_array_.name(); }     ///< indexed triangles, 32 bits
  GLuint lines() const { return line_array_.name(); }    ///< two corners each

 private:
  Shapes shapes_;
  std::unordered_map<const PlantShape*, ShapeRange> ranges_;
  gl::Buffer leaf_corners_, leaf_indices_, point_corners_, wood_corners_, wood_indices_, line_corners_;
  gl::VertexArray leaf_array_, point_array_, wood_array_, line_array_;
};

/// A draw command's data of its plant: an instance of plant_record.glsl.
struct PlantRecord {
  std::array<glm::vec4, 3> rows;  ///< of world_from_plant
  glm::vec4 shown;                ///< share shown, share of the fade, growth of lengths, scale
  glm::vec4 dark, light;
  glm::uvec4 thing;  ///< x
};

}  // namespace parvis::vegetation
