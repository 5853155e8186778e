#include "reflections/reflector_maps/gpu_reflector.h"

#include <algorithm>

namespace parvis::reflector_maps {
namespace {

#include "reflections/reflector_maps/start_rows.glsl"

/// A map's texels, and below them in rows its starts, four texels each: position, normal, axis, curvature.
gl::Texture upload(const ReflectorMap& map) {
  const ImageF& texels = map.texels;
  std::vector<glm::vec4> starts;
  for (std::size_t i = 0; i < start_count; ++i) {
    const MapStart start = map.starts[i];
    for (const glm::vec3& value : {start.position, start.normal, start.u, start.curvature})
      starts.emplace_back(value, 0.0f);
  }
  constexpr int width = 4 * starts_in_row, rows = int(start_count) / starts_in_row;
  static_assert(start_count % std::size_t(starts_in_row) == 0);
  gl::Texture texture = gl::texture_2d(GL_RGBA32F, std::max(texels.width, width), texels.height + rows);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureSubImage2D(texture.name(), 0, 0, 0, texels.width, texels.height, GL_RGBA, GL_FLOAT,
                      texels.pixels.data());
  glTextureSubImage2D(texture.name(), 0, 0, texels.height, width, rows, GL_RGBA, GL_FLOAT, starts.data());
  return texture;
}

}  // namespace

GpuReflector::GpuReflector(const Reflector& reflector) : vertex_array_(gl::VertexArray::create()) {
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < reflector.maps.size(); ++i) {
    const ReflectorMap& map = reflector.maps[i];
    Patch patch{upload(map),
                patch_bounds(reflector.mesh, reflector.patches[i]),
                map.window,
                map.is_convex,
                map.is_whole_body(),
                map.shows_once,
                {},
                {},
                {},
                {},
                GLsizei(indices.size()),
                0};
    for (std::size_t k = 0; k < layer_start_count; ++k) {
      const MapStart start = map.starts[k];
      patch.start_positions[k] = start.position, patch.start_normals[k] = start.normal;
      patch.start_axes[k] = start.u, patch.start_curvatures[k] = start.curvature;
    }
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

void GpuReflector::bind(const gl::Program& program, const Patch& patch, const glm::mat4& world_from_reflector,
                        GLuint unit, int layer, int mirror) {
  // By mirror: each begins in the arrays of uniforms where the one before it ends.
  struct Names {
    const char *texels, *from_world, *to_world, *centre, *size, *band, *axes, *kind, *layer, *positions,
        *normals, *start_axes, *start_curvatures;
  };
  constexpr std::array<Names, 2> names{
      {{"reflector_texels", "reflectors_from_world[0]", "world_from_reflectors[0]", "map_centres[0]",
        "map_sizes[0]", "map_bands[0]", "map_axes[0]", "patch_kinds[0]", "patch_layers[0]",
        "start_positions[0]", "start_normals[0]", "start_axes[0]", "start_curvatures[0]"},
       {"second_reflector_texels", "reflectors_from_world[1]", "world_from_reflectors[1]", "map_centres[1]",
        "map_sizes[1]", "map_bands[1]", "map_axes[3]", "patch_kinds[1]", "patch_layers[1]",
        "start_positions[16]", "start_normals[16]", "start_axes[16]", "start_curvatures[16]"}}};
  static_assert(layer_start_count == 16);
  const Names& name = names[std::size_t(mirror)];
  glBindTextureUnit(unit, patch.texels.name());
  program.set(name.texels, int(unit));
  program.set(name.to_world, world_from_reflector);
  program.set(name.from_world, glm::inverse(world_from_reflector));
  program.set(name.centre, patch.window.centre);
  program.set(name.size, glm::vec3(patch.window.extent, patch.window.side, patch.window.reach));
  program.set(name.band, patch.window.band);
  program.set(name.axes, std::span<const glm::vec3>(&patch.window.axes[0], 3));
  program.set(name.kind, glm::vec2(patch.is_convex ? 1.0f : 0.0f, patch.is_whole_body ? 1.0f : 0.0f));
  program.set(name.layer, layer);
  program.set(name.positions, std::span<const glm::vec3>(patch.start_positions));
  program.set(name.normals, std::span<const glm::vec3>(patch.start_normals));
  program.set(name.start_axes, std::span<const glm::vec3>(patch.start_axes));
  program.set(name.start_curvatures, std::span<const glm::vec3>(patch.start_curvatures));
}

void GpuReflector::draw(const Patch& patch) const {
  glBindVertexArray(vertex_array_.name());
  // OpenGL takes the place in the bound buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
  const void* first = reinterpret_cast<const void*>(sizeof(std::uint32_t) * std::size_t(patch.first_index));
  glDrawElements(GL_TRIANGLES, patch.index_count, GL_UNSIGNED_INT, first);
}

}  // namespace parvis::reflector_maps
