#include "reflections/virtual_objects/vertex_search.h"

#include <algorithm>

#include "base/parallel.h"
#include "graphics/gl/sampled_textures.h"
#include "reflections/reflector_maps/bindings.h"
#include "reflections/virtual_objects/search_settings.h"
#include "reflections/virtual_objects/virtual_grid.h"

namespace parvis::virtual_objects {
using namespace reflector_maps;
namespace {

constexpr std::size_t min_vertices = 200;  // of a mesh: its coarsest grid has the corners of a cell
#include "reflections/virtual_objects/grid_sizes.glsl"
constexpr int min_result_rows = 256, max_result_rows = 16384;
constexpr std::size_t max_in_table = std::size_t(table_width) * 4096;  // meshes beyond have no grid
constexpr float stray_px = 0.3f;                                       // what of interpolation nobody sees

int rows_of(std::size_t corners) { return int((corners + results_width - 1) / results_width); }

/// The share that is asked for, and coarser ones.
std::vector<float> shares_up_to(float maximum, bool follows_area) {
  std::vector<float> shares;
  if (maximum < 1.0f) shares.push_back(maximum);
  if (follows_area)
    std::ranges::copy_if(grid_shares, std::back_inserter(shares), [&](float s) { return s < maximum; });
  return shares;
}

/// The largest number of texels in the table.
std::size_t texels_of(std::span<const VirtualGrid> grids) {
  std::size_t texels = 0;
  for (const VirtualGrid& grid : grids)
    texels += std::size_t(grid_header_texels) + grid.corners().size() +
              grid.numbers_in_box().size() / std::size_t(numbers_per_texel) + 1;
  return texels;
}

/// Appends a grid as grid_table.glsl has it; returns where the grid begins.
int append(const VirtualGrid& grid, std::vector<glm::vec4>& table) {
  const int first = int(table.size());
  const GridLayout& layout = grid.layout();
  table.emplace_back(layout.origin, float(grid.corners().size()));
  table.emplace_back(1.0f / layout.cell, 0.0f);
  table.emplace_back(glm::vec3(layout.count), 0.0f);
  for (const glm::vec3& corner : grid.corners()) table.emplace_back(corner, 0.0f);
  const std::vector<std::uint32_t>& numbers = grid.numbers_in_box();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const int in_texel = int(i) % numbers_per_texel;
    if (in_texel == 0) table.emplace_back(-1.0f);
    if (numbers[i] != VirtualGrid::no_corner) table.back()[in_texel] = float(numbers[i]);
  }
  return first;
}

/// A grid whose corners are the mesh's own vertices, in no cells; returns where it begins.
int append(std::span<const glm::vec3> vertices, std::vector<glm::vec4>& table) {
  const int first = int(table.size());
  table.emplace_back(0.0f, 0.0f, 0.0f, float(vertices.size()));
  table.resize(table.size() + std::size_t(grid_header_texels - 1));
  for (const glm::vec3& vertex : vertices) table.emplace_back(vertex, 0.0f);
  return first;
}

/// The mesh of each of the GPU scene's parts that a grid is worth making for; null: none.
std::vector<const Mesh*> meshes_of_parts(const scene::Scene& scene, const render::GpuScene& gpu) {
  std::vector<const Mesh*> meshes(gpu.parts().size(), nullptr);
  std::size_t item = 0;
  for (const scene::Object& object : scene.objects)
    for (const scene::Part& part : object.model->parts) {
      const Mesh*& mesh = meshes[std::size_t(gpu.items()[item++].part)];
      const bool is_rigid = object.deformed_meshes.empty() || !part.deformation;
      if (is_rigid && part.mesh.positions.size() >= min_vertices) mesh = &part.mesh;
    }
  return meshes;
}

}  // namespace

Result<VertexSearch> VertexSearch::create(const scene::Scene& scene, const render::GpuScene& gpu,
                                          const gl::Defines& defines) {
  Result<gl::Program> program =
      gl::Program::create("reflections/virtual_objects/vertex_search.vert",
                          "reflections/virtual_objects/vertex_search.frag", defines);
  if (!program) return program.errors();
  const bool follows_area = methods::settings(scene).uses_level_of_detail;
  const float grid_share = search_settings(scene).grid_share;
  const std::vector<float> shares = shares_up_to(grid_share, follows_area);
  const std::vector<const Mesh*> meshes = meshes_of_parts(scene, gpu);
  std::vector<std::vector<VirtualGrid>> grids(meshes.size());
  parallel_for(meshes.size(), [&](std::size_t p) {
    if (meshes[p])
      for (const float share : shares) grids[p].emplace_back(meshes[p]->positions, share);
  });

  std::vector<MeshGrids> of_part(meshes.size());
  std::vector<glm::vec4> table(1);  // 0 stands for no grid
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    if (!meshes[p]) continue;
    const std::vector<glm::vec3>& vertices = meshes[p]->positions;
    if (table.size() + texels_of(grids[p]) + std::size_t(grid_header_texels) + vertices.size() > max_in_table)
      continue;
    of_part[p].vertex_count = vertices.size();
    of_part[p].first_vertex = gpu.parts()[p].base_vertex;
    of_part[p].vertices_in_table = append(vertices, table);
    for (const VirtualGrid& grid : grids[p]) {
      of_part[p].corner_counts.push_back(std::uint32_t(grid.corners().size()));
      of_part[p].in_table.push_back(append(grid, table));
    }
  }
  return VertexSearch(*std::move(program), follows_area, grid_share, std::move(of_part), table);
}

VertexSearch::VertexSearch(gl::Program program, bool follows_area, float grid_share,
                           std::vector<MeshGrids> of_part, std::span<const glm::vec4> table)
    : program_(std::move(program)),
      follows_area_(follows_area),
      is_asked_for_(grid_share < 1.0f),
      max_stray_px_(follows_area_ ? stray_px : std::numeric_limits<float>::max()),
      of_part_(std::move(of_part)),
      has_any_(table.size() > 1),
      vertex_array_(gl::VertexArray::create()) {
  upload_table(table);
  make_results(min_result_rows);
  const GLuint array = vertex_array_.name();
  for (GLuint row = 0; row < 3; ++row) {
    glEnableVertexArrayAttrib(array, row);
    glVertexArrayAttribFormat(array, row, 4, GL_FLOAT, GL_FALSE, GLuint(sizeof(glm::vec4)) * row);
    glVertexArrayAttribBinding(array, row, 0);
  }
  glEnableVertexArrayAttrib(array, 3);
  glVertexArrayAttribIFormat(array, 3, 2, GL_INT, offsetof(Instance, grid));
  glVertexArrayAttribBinding(array, 3, 0);
  glVertexArrayBindingDivisor(array, 0, 1);
}

void VertexSearch::upload_table(std::span<const glm::vec4> table) {
  const int whole_rows = int(table.size()) / table_width, rest = int(table.size()) % table_width;
  table_ = gl::texture_2d(GL_RGBA32F, table_width, whole_rows + 1);
  glTextureParameteri(table_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(table_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  if (whole_rows > 0)
    glTextureSubImage2D(table_.name(), 0, 0, 0, table_width, whole_rows, GL_RGBA, GL_FLOAT, table.data());
  if (rest > 0)
    glTextureSubImage2D(table_.name(), 0, 0, whole_rows, rest, 1, GL_RGBA, GL_FLOAT,
                        table.data() + std::ptrdiff_t(whole_rows) * table_width);
}

void VertexSearch::make_results(int rows) {
  rows_ = rows;
  program_.set("results_size", glm::vec2(results_width, rows_));
  results_ = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  glTextureStorage3D(results_.name(), 1, GL_RGBA32F, results_width, rows_, result_layers);
  glTextureParameteri(results_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(results_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  target_ = gl::Framebuffer::create();
  GLenum attachments[result_layers];
  for (int layer = 0; layer < result_layers; ++layer) {
    attachments[layer] = GLenum(GL_COLOR_ATTACHMENT0 + layer);
    glNamedFramebufferTextureLayer(target_.name(), attachments[layer], results_.name(), 0, layer);
  }
  glNamedFramebufferDrawBuffers(target_.name(), result_layers, attachments);
}

glm::ivec2 VertexSearch::add(const render::Item& item, float area_px) {
  if (std::size_t(item.part) >= of_part_.size()) return {};
  const MeshGrids& grids = of_part_[std::size_t(item.part)];
  auto level = follows_area_ ? grid_level(grids.corner_counts, grids.vertex_count, area_px) : std::nullopt;
  if (!level && is_asked_for_ && !grids.corner_counts.empty()) level = 0;
  const int in_table = level ? grids.in_table[*level] : grids.vertices_in_table;
  const int rows = rows_of(level ? grids.corner_counts[*level] : grids.vertex_count);
  if (in_table == 0 || rows_taken_ + rows > max_result_rows) return {};
  instances_.push_back(
      {{item.record.rows[0], item.record.rows[1], item.record.rows[2]}, {in_table, rows_taken_}});
  rows_taken_ += rows;
  return {level ? in_table : -1 - grids.first_vertex, instances_.back().grid.y};
}

void VertexSearch::search(const std::function<void(const gl::Program&)>& bind_patch) {
  if (instances_.empty()) return;
  if (rows_taken_ > rows_) make_results(std::min(2 * rows_taken_, max_result_rows));
  const GLintptr first = instance_store_.append(std::span<const Instance>(instances_), 16);
  glVertexArrayVertexBuffer(vertex_array_.name(), 0, instance_store_.name(), first, sizeof(Instance));
  glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
  glViewport(0, 0, results_width, rows_);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(vertex_array_.name());
  program_.use();
  bind_patch(program_);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(instances_.size()));
  instances_.clear();
  rows_taken_ = 0;
}

void VertexSearch::bind(const gl::Program& program) const {
  if (program.declares("grid_table"))
    gl::bind_textures(program, {{"grid_table", grid_table_unit, table_.name()}});
  if (!program.declares("grid_results")) return;
  gl::bind_textures(program, {{"grid_results", grid_results_unit, results_.name()}});
  program.set("max_stray_px", max_stray_px_);
}

}  // namespace parvis::virtual_objects
