#include "graphics/render/gpu_geometry.h"

#include <algorithm>

namespace parvis::render {
namespace {

/// Appends values to those that a buffer holds. The first ones have no room to spare: most scenes stay as
/// they are.
template <class T>
void append_to(gl::Buffer& buffer, std::size_t& room, std::size_t& count, const std::vector<T>& added) {
  constexpr std::size_t spare_share = 8;
  const std::size_t needed = count + added.size();
  if (!buffer || needed > room) {
    room = count == 0 ? std::max(needed, std::size_t{1}) : needed + needed / spare_share;
    gl::Buffer larger = gl::Buffer::create();
    glNamedBufferStorage(larger.name(), GLsizeiptr(room * sizeof(T)), nullptr, GL_DYNAMIC_STORAGE_BIT);
    if (count > 0)
      glCopyNamedBufferSubData(buffer.name(), larger.name(), 0, 0, GLsizeiptr(count * sizeof(T)));
    buffer = std::move(larger);
  }
  if (!added.empty())
    glNamedBufferSubData(buffer.name(), GLintptr(count * sizeof(T)), GLsizeiptr(added.size() * sizeof(T)),
                         added.data());
  count = needed;
}

}  // namespace

MeshRange GpuGeometry::append(const Mesh& mesh, std::span<const float> openness) {
  const MeshRange range{std::uint32_t(uploaded_indices_ + indices_.size()),
                        std::uint32_t(mesh.indices.size()), std::int32_t(end_vertex())};
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    vertices_.push_back(
        {mesh.positions[i], mesh.normals[i], mesh.uvs[i], openness.empty() ? 1.0f : openness[i]});
  indices_.insert(indices_.end(), mesh.indices.begin(), mesh.indices.end());
  if (!mesh.colours.empty() || !mesh.second_uvs.empty() || !details_.empty() || detail_buffer_) {
    const std::size_t first = vertices_.size() - mesh.positions.size();
    details_.resize(vertices_.size());
    for (std::size_t i = 0; i < mesh.colours.size(); ++i) details_[first + i].colour = mesh.colours[i];
    for (std::size_t i = 0; i < mesh.second_uvs.size(); ++i)
      details_[first + i].second_uv = mesh.second_uvs[i];
  }
  return range;
}

MeshRange GpuGeometry::add_deforming(const Mesh& mesh) {
  const std::size_t first = end_vertex(), count = mesh.positions.size();
  const MeshRange range = append(mesh, {});
  if (runs_.empty() || runs_.back().first_in_buffer + runs_.back().count != first)
    runs_.push_back({first, deforming_.size(), 0});
  runs_.back().count += count;
  deforming_.insert(deforming_.end(), vertices_.end() - std::ptrdiff_t(count), vertices_.end());
  return range;
}

MeshRange GpuGeometry::add(const Mesh& mesh, std::span<const float> openness) {
  return append(mesh, openness);
}

MeshRange GpuGeometry::add_triangles(const MeshRange& mesh, const std::vector<std::uint32_t>& indices) {
  const MeshRange range{std::uint32_t(uploaded_indices_ + indices_.size()), std::uint32_t(indices.size()),
                        mesh.base_vertex};
  indices_.insert(indices_.end(), indices.begin(), indices.end());
  return range;
}

void GpuGeometry::upload() {
  if (!details_.empty()) {
    if (!detail_buffer_)
      details_.insert(details_.begin(), uploaded_vertices_, Detail());  // of those before them
    append_to(detail_buffer_, detail_room_, uploaded_details_, details_);
    details_ = {};
  }
  append_to(vertex_buffer_, vertex_room_, uploaded_vertices_, vertices_);
  append_to(index_buffer_, index_room_, uploaded_indices_, indices_);
  vertices_ = {}, indices_ = {};
}

void GpuGeometry::deform(const MeshRange& range, const Mesh& mesh) {
  const auto run =
      std::prev(std::ranges::upper_bound(runs_, std::size_t(range.base_vertex), {}, &Run::first_in_buffer));
  Vertex* vertex = deforming_.data() + run->first + (std::size_t(range.base_vertex) - run->first_in_buffer);
  const auto first = std::size_t(range.base_vertex), at = std::size_t(vertex - deforming_.data());
  if (!changed_.empty() && changed_.back().first_in_buffer + changed_.back().count == first &&
      changed_.back().first + changed_.back().count == at)
    changed_.back().count += mesh.positions.size();
  else
    changed_.push_back({first, at, mesh.positions.size()});
  for (std::size_t i = 0; i < mesh.positions.size(); ++i, ++vertex) {
    vertex->position = mesh.positions[i];
    vertex->normal = mesh.normals[i];
  }
}

void GpuGeometry::upload_deformed() {
  for (const Run& run : changed_)
    glNamedBufferSubData(vertex_buffer_.name(), GLintptr(run.first_in_buffer * sizeof(Vertex)),
                         GLsizeiptr(run.count * sizeof(Vertex)), deforming_.data() + run.first);
  changed_.clear();
}

}  // namespace parvis::render
