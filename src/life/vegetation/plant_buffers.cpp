#include "life/vegetation/plant_buffers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/gtc/packing.hpp>

namespace parvis::vegetation {
namespace {

using Halves = std::array<std::uint32_t, 2>;  // four numbers

Halves packed_halves(float x, float y, float z, float w) {
  return std::bit_cast<Halves>(glm::packHalf4x16(glm::vec4(x, y, z, w)));
}

/// A corner of a leaf as leaf_vertex.glsl reads it.
struct LeafCorner {
  glm::vec3 foot;
  Halves offset_and_openness;
  std::uint32_t normal_and_tint;  ///< 4 signed bytes
  Halves place_and_rank;
};

/// A point as leaf_vertex.glsl reads it.
struct LeafPoint {
  glm::vec3 middle;
  Halves size_openness_rank;
  std::uint32_t normal_and_tint;
};

/// A corner of a tube, or the end of a line, as wood_vertex.glsl reads it.
struct WoodCorner {
  glm::vec3 position;
  std::uint32_t normal_and_openness;
  glm::vec2 uv;
};

std::uint32_t packed_normal(glm::vec3 normal, float w) { return glm::packSnorm4x8(glm::vec4(normal, w)); }

glm::mat3 plant_from_leaf(const Leaf& leaf) {
  return {glm::cross(leaf.along, leaf.normal), leaf.along, leaf.normal};
}

float rank_of(const PlantShape& shape, std::uint32_t leaf) {
  return (float(leaf) + 0.5f) / float(shape.leaves.size());
}

void add_corners(const PlantShape& shape, const LeafTemplate& form, std::vector<LeafCorner>& out) {
  for (const std::uint32_t index : shape.clustered) {
    const Leaf& leaf = shape.leaves[index];
    const glm::mat3 frame = plant_from_leaf(leaf);
    for (std::size_t i = 0; i < form.points.size(); ++i) {
      const glm::vec3 offset = leaf.length_m * (frame * form.points[i]);
      out.push_back({leaf.foot, packed_halves(offset.x, offset.y, offset.z, leaf.openness),
                     packed_normal(frame * form.normals[i], 2.0f * leaf.tint - 1.0f),
                     packed_halves(form.points[i].x, form.points[i].y, rank_of(shape, index), 0.0f)});
    }
  }
}

LeafPoint point_of(const PlantShape& shape, std::uint32_t index) {
  const Leaf& leaf = shape.leaves[index];
  const float side_m = leaf.length_m * std::sqrt(full_leaf(shape.kind().leaf).area());
  return {leaf.foot + 0.5f * leaf.length_m * leaf.along,
          packed_halves(side_m, leaf.openness, rank_of(shape, index), 0.0f),
          packed_normal(leaf.normal, 2.0f * leaf.tint - 1.0f)};
}

void add_twig(const Twig& twig, std::vector<WoodCorner>& out) {
  const std::uint32_t along = packed_normal(glm::normalize(twig.to - twig.from), twig.openness);
  out.push_back({twig.from, along, glm::vec2(0.25f)});
  out.push_back({twig.to, along, glm::vec2(0.25f)});
}

/// The indices of a cluster's leaves, one after the other.
void add_pattern(const LeafTemplate& form, std::vector<std::uint16_t>& out) {
  for (std::uint32_t leaf = 0; leaf < max_cluster_leaves; ++leaf)
    for (const std::uint16_t corner : form.indices)
      out.push_back(std::uint16_t(leaf * std::uint32_t(form.points.size()) + corner));
}

std::vector<std::uint16_t> all_patterns() {
  std::vector<std::uint16_t> patterns;
  for (int form = 0; form < leaf_form_count; ++form)
    add_pattern(full_leaf(LeafForm(form)), patterns), add_pattern(simple_leaf(LeafForm(form)), patterns);
  return patterns;
}

void attribute(GLuint array, GLuint index, GLint size, GLenum type, bool is_normalised, std::size_t offset) {
  glEnableVertexArrayAttrib(array, index);
  glVertexArrayAttribFormat(array, index, size, type, is_normalised ? GL_TRUE : GL_FALSE, GLuint(offset));
  glVertexArrayAttribBinding(array, index, 0);
}

/// A vertex array with its corners at binding 0 and the attributes of the records at binding 1.
gl::VertexArray array_over(const gl::Buffer& corners, std::size_t stride) {
  gl::VertexArray made = gl::VertexArray::create();
  const GLuint array = made.name();
  glVertexArrayVertexBuffer(array, 0, corners.name(), 0, GLsizei(stride));
  for (GLuint i = 0; i < 6; ++i) {
    glEnableVertexArrayAttrib(array, 4 + i);
    glVertexArrayAttribFormat(array, 4 + i, 4, GL_FLOAT, GL_FALSE, GLuint(i * sizeof(glm::vec4)));
    glVertexArrayAttribBinding(array, 4 + i, 1);
  }
  glEnableVertexArrayAttrib(array, 10);
  glVertexArrayAttribIFormat(array, 10, 1, GL_UNSIGNED_INT, GLuint(offsetof(PlantRecord, thing)));
  glVertexArrayAttribBinding(array, 10, 1);
  glVertexArrayBindingDivisor(array, 1, 1);
  return made;
}

gl::VertexArray array_of_wood(const gl::Buffer& corners) {
  gl::VertexArray array = array_over(corners, sizeof(WoodCorner));
  attribute(array.name(), 0, 3, GL_FLOAT, false, offsetof(WoodCorner, position));
  attribute(array.name(), 1, 4, GL_BYTE, true, offsetof(WoodCorner, normal_and_openness));
  attribute(array.name(), 2, 2, GL_FLOAT, false, offsetof(WoodCorner, uv));
  return array;
}

}  // namespace

std::uint32_t PlantBuffers::first_index(LeafForm form, bool is_full) {
  std::uint32_t first = 0;
  for (int before = 0; before < int(form); ++before)
    first += max_cluster_leaves * std::uint32_t(full_leaf(LeafForm(before)).indices.size() +
                                                simple_leaf(LeafForm(before)).indices.size());
  return is_full ? first : first + max_cluster_leaves * std::uint32_t(full_leaf(form).indices.size());
}

PlantBuffers::PlantBuffers(Shapes shapes) : shapes_(std::move(shapes)) {
  std::vector<LeafCorner> corners;
  std::vector<LeafPoint> points;
  std::vector<WoodCorner> wood, lines;
  std::vector<std::uint32_t> wood_indices;
  for (const auto& shared : shapes_) {
    const PlantShape& shape = *shared;
    ShapeRange& range = ranges_[&shape];
    range.full = std::uint32_t(corners.size());
    add_corners(shape, full_leaf(shape.kind().leaf), corners);
    range.simple = std::uint32_t(corners.size());
    add_corners(shape, simple_leaf(shape.kind().leaf), corners);
    range.points = std::uint32_t(points.size());
    for (std::uint32_t i = 0; i < shape.leaves.size(); ++i) points.push_back(point_of(shape, i));
    range.clustered_points = std::uint32_t(points.size());
    for (const std::uint32_t i : shape.clustered) points.push_back(point_of(shape, i));
    range.wood = std::uint32_t(wood.size()), range.wood_index = std::uint32_t(wood_indices.size());
    for (std::size_t i = 0; i < shape.wood.positions.size(); ++i)
      wood.push_back({shape.wood.positions[i], packed_normal(shape.wood.normals[i], shape.wood_openness[i]),
                      shape.wood.uvs[i]});
    wood_indices.insert(wood_indices.end(), shape.wood.indices.begin(), shape.wood.indices.end());
    range.lines = std::uint32_t(lines.size());
    for (const Twig& twig : shape.twigs) add_twig(twig, lines);
  }
  const std::vector<std::uint16_t> patterns = all_patterns();
  leaf_corners_ = gl::immutable_buffer(std::span<const LeafCorner>(corners));
  leaf_indices_ = gl::immutable_buffer(std::span<const std::uint16_t>(patterns));
  point_corners_ = gl::immutable_buffer(std::span<const LeafPoint>(points));
  wood_corners_ = gl::immutable_buffer(std::span<const WoodCorner>(wood));
  wood_indices_ = gl::immutable_buffer(std::span<const std::uint32_t>(wood_indices));
  line_corners_ = gl::immutable_buffer(std::span<const WoodCorner>(lines));

  leaf_array_ = array_over(leaf_corners_, sizeof(LeafCorner));
  attribute(leaves(), 0, 3, GL_FLOAT, false, offsetof(LeafCorner, foot));
  attribute(leaves(), 1, 4, GL_HALF_FLOAT, false, offsetof(LeafCorner, offset_and_openness));
  attribute(leaves(), 2, 4, GL_BYTE, true, offsetof(LeafCorner, normal_and_tint));
  attribute(leaves(), 3, 4, GL_HALF_FLOAT, false, offsetof(LeafCorner, place_and_rank));
  glVertexArrayElementBuffer(leaves(), leaf_indices_.name());
  point_array_ = array_over(point_corners_, sizeof(LeafPoint));
  attribute(this->points(), 0, 3, GL_FLOAT, false, offsetof(LeafPoint, middle));
  attribute(this->points(), 1, 4, GL_HALF_FLOAT, false, offsetof(LeafPoint, size_openness_rank));
  attribute(this->points(), 2, 4, GL_BYTE, true, offsetof(LeafPoint, normal_and_tint));
  wood_array_ = array_of_wood(wood_corners_);
  glVertexArrayElementBuffer(wood_array_.name(), wood_indices_.name());
  line_array_ = array_of_wood(line_corners_);
}

}  // namespace parvis::vegetation
