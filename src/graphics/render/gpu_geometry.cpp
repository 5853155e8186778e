#include "graphics/render/gpu_geometry.h"

#include <cassert>

namespace parvis::render {

MeshRange GpuGeometry::append(const Mesh& mesh, std::span<const float> openness) {
  const MeshRange range{std::uint32_t(indices_.size()), std::uint32_t(mesh.indices.size()),
                        std::int32_t(vertices_.size())};
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    vertices_.push_back(
        {mesh.positions[i], mesh.normals[i], mesh.uvs[i], openness.empty() ? 1.0f : openness[i]});
  indices_.insert(indices_.end(), mesh.indices.begin(), mesh.indices.end());
  if (!mesh.colours.empty() || !mesh.second_uvs.empty() || !details_.empty()) {
    const auto first = std::size_t(range.base_vertex);
    details_.resize(vertices_.size());
    for (std::size_t i = 0; i < mesh.colours.size(); ++i) details_[first + i].colour = mesh.colours[i];
    for (std::size_t i = 0; i < mesh.second_uvs.size(); ++i)
      details_[first + i].second_uv = mesh.second_uvs[i];
  }
  return range;
}

MeshRange GpuGeometry::add_deforming(const Mesh& mesh) { return append(mesh, {}); }

MeshRange GpuGeometry::add(const Mesh& mesh, std::span<const float> openness) {
  assert(vertices_.size() == rigid_vertices_);
  const MeshRange range = append(mesh, openness);
  rigid_vertices_ = vertices_.size();
  return range;
}

MeshRange GpuGeometry::add_triangles(const MeshRange& mesh, const std::vector<std::uint32_t>& indices) {
  const MeshRange range{std::uint32_t(indices_.size()), std::uint32_t(indices.size()), mesh.base_vertex};
  indices_.insert(indices_.end(), indices.begin(), indices.end());
  return range;
}

void GpuGeometry::upload() {
  vertex_buffer_ = gl::immutable_buffer(std::span<const Vertex>(vertices_), GL_DYNAMIC_STORAGE_BIT);
  if (!details_.empty()) detail_buffer_ = gl::immutable_buffer(std::span<const Detail>(details_));
  details_ = {};
  index_buffer_ = gl::immutable_buffer(std::span<const std::uint32_t>(indices_));
  vertices_.erase(vertices_.begin(), vertices_.begin() + std::ptrdiff_t(rigid_vertices_));
  vertices_.shrink_to_fit();
  indices_ = {};
}

void GpuGeometry::deform(const MeshRange& range, const Mesh& mesh) {
  Vertex* vertex = vertices_.data() + (std::size_t(range.base_vertex) - rigid_vertices_);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i, ++vertex) {
    vertex->position = mesh.positions[i];
    vertex->normal = mesh.normals[i];
  }
}

void GpuGeometry::upload_deformed() {
  if (vertices_.empty()) return;
  glNamedBufferSubData(vertex_buffer_.name(), GLintptr(rigid_vertices_ * sizeof(Vertex)),
                       GLsizeiptr(vertices_.size() * sizeof(Vertex)), vertices_.data());
}

}  // namespace parvis::render
