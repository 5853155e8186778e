#include "curved_reflectors/gpu_reflector.h"

namespace parvis::curved_reflectors {
namespace {

gl::Texture upload(const ImageF& texels) {
  gl::Texture texture = gl::texture_2d(GL_RGBA32F, texels.width, texels.height);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureSubImage2D(texture.name(), 0, 0, 0, texels.width, texels.height, GL_RGBA, GL_FLOAT,
                      texels.pixels.data());
  return texture;
}

}  // namespace

GpuReflector::GpuReflector(const Reflector& reflector) : vertex_array_(gl::VertexArray::create()) {
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < reflector.maps.size(); ++i) {
    const ReflectorMap& map = reflector.maps[i];
    Patch patch{upload(map.texels),
                patch_bounds(reflector.mesh, reflector.patches[i]),
                map.window,
                map.is_convex,
                map.is_whole_body(),
                map.shows_once,
                {},
                {},
                GLsizei(indices.size()),
                0};
    for (std::size_t k = 0; k < start_count; ++k)
      std::tie(patch.start_positions[k], patch.start_normals[k]) = map.starts[k];
    for (const std::uint32_t t : reflector.patches[i].triangles)
      indices.insert(indices.end(), &reflector.mesh.mesh.indices[3 * t],
                     &reflector.mesh.mesh.indices[3 * t] + 3);
    patch.index_count = GLsizei(indices.size()) - patch.first_index;
    patches_.push_back(std::move(patch));
  }
  vertices_ = gl::immutable_buffer(std::span<const glm::vec3>(reflector.mesh.mesh.positions));
  indices_ = gl::immutable_buffer(std::span<const std::uint32_t>(indices));
  glVertexArrayVertexBuffer(vertex_array_.name(), 0, vertices_.name(), 0, sizeof(glm::vec3));
  glVertexArrayElementBuffer(vertex_array_.name(), indices_.name());
  glEnableVertexArrayAttrib(vertex_array_.name(), 0);
  glVertexArrayAttribFormat(vertex_array_.name(), 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(vertex_array_.name(), 0, 0);
}

void GpuReflector::bind(const gl::Program& program, const Patch& patch, GLuint unit) {
  glBindTextureUnit(unit, patch.texels.name());
  program.set("reflector_texels", int(unit));
  program.set("map_centre", patch.window.centre);
  program.set("map_size", glm::vec3(patch.window.extent, patch.window.side, patch.window.reach));
  program.set("map_axes", std::span<const glm::vec3>(&patch.window.axes[0], 3));
  program.set("patch_kind", glm::vec2(patch.is_convex ? 1.0f : 0.0f, patch.is_whole_body ? 1.0f : 0.0f));
  program.set("start_positions", std::span<const glm::vec3>(patch.start_positions));
  program.set("start_normals", std::span<const glm::vec3>(patch.start_normals));
}

void GpuReflector::draw(const Patch& patch) const {
  glBindVertexArray(vertex_array_.name());
  // OpenGL takes the place in the bound buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
  const void* first = reinterpret_cast<const void*>(sizeof(std::uint32_t) * std::size_t(patch.first_index));
  glDrawElements(GL_TRIANGLES, patch.index_count, GL_UNSIGNED_INT, first);
}

}  // namespace parvis::curved_reflectors
