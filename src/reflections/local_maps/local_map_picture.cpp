#include "reflections/local_maps/local_map_picture.h"

#include <algorithm>

#include "graphics/gl/sampled_textures.h"
#include "reflections/local_maps/local_map_settings.h"
#include "reflections/methods/bindings.h"
#include "reflections/methods/cube_map.h"

namespace parvis::local_maps {
namespace {

constexpr int max_picture_texels = 8192;  // a side; what OpenGL 4.5 grants is 16384, what phones have is this

enum PictureUnit : GLuint {
  picture_colours_unit = methods::first_method_unit,
  distances_unit,
  places_unit,
  finer_unit
};

gl::VertexArray mesh_array() {
  gl::VertexArray array = gl::VertexArray::create();
  const GLuint name = array.name();
  for (GLuint index = 0; index < 3; ++index) {
    glEnableVertexArrayAttrib(name, index);
    glVertexArrayAttribBinding(name, index, 0);
  }
  glVertexArrayAttribFormat(name, 0, 4, GL_FLOAT, GL_FALSE, offsetof(LocalMapVertex, texel));
  glVertexArrayAttribFormat(name, 1, 3, GL_FLOAT, GL_FALSE, offsetof(LocalMapVertex, met));
  glVertexArrayAttribIFormat(name, 2, 1, GL_UNSIGNED_INT, offsetof(LocalMapVertex, map_pair));
  return array;
}

gl::VertexArray tile_array() {
  gl::VertexArray array = gl::VertexArray::create();
  glEnableVertexArrayAttrib(array.name(), 0);
  glVertexArrayAttribFormat(array.name(), 0, 4, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array.name(), 0, 0);
  glVertexArrayBindingDivisor(array.name(), 0, 1);
  return array;
}

}  // namespace

Result<LocalMapPicture> LocalMapPicture::create(int max_texels, LocalMapView shown) {
  constexpr const char* mesh_vertex = "reflections/local_maps/local_map.vert";
  constexpr const char* mesh_fragment = "reflections/local_maps/local_map.frag";
  Programs programs;
  const auto link = [](gl::Program& program, Result<gl::Program> linked) -> Status {
    if (!linked) return linked.errors();
    program = *std::move(linked);
    return Ok{};
  };
  if (Status status = link(programs.radiance, gl::Program::create(mesh_vertex, mesh_fragment)); !status)
    return status.errors();
  if (shown != LocalMapView::radiance) {
    const char* define = shown == LocalMapView::mesh ? "SHOWS_MESH" : "SHOWS_WEIGHTS";
    Status status = link(programs.marks, gl::Program::create(mesh_vertex, mesh_fragment, {{define, ""}}));
    if (!status) return status.errors();
  }
  Status status = link(programs.level, gl::Program::create("reflections/local_maps/local_map_tile.vert",
                                                           "reflections/local_maps/local_map_level.frag"));
  if (!status) return status.errors();
  return LocalMapPicture(max_texels, shown, std::move(programs));
}

LocalMapPicture::LocalMapPicture(int max_texels, LocalMapView shown, Programs programs)
    : max_texels_(max_texels),
      shown_(shown),
      programs_(std::move(programs)),
      framebuffer_(gl::Framebuffer::create()),
      mesh_array_(mesh_array()),
      tile_array_(tile_array()) {
  reserve(1);
}

bool LocalMapPicture::reserve(int slots) {
  const int max_columns = std::max(max_picture_texels / (3 * max_texels_), 1);
  const int max_rows = std::max(max_picture_texels / (2 * max_texels_), 1);
  slots = std::min(slots, max_columns * max_rows);
  if (slots <= slots_) return false;
  columns_ = std::min(slots, max_columns);
  const int rows = (slots + columns_ - 1) / columns_;
  slots_ = columns_ * rows;
  size_ = max_texels_ * glm::ivec2(3 * columns_, 2 * rows);
  colours_ = gl::texture_2d(GL_R11F_G11F_B10F, size_.x, size_.y, local_map_levels);
  glTextureParameteri(colours_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  depth_ = gl::texture_2d(GL_DEPTH_COMPONENT32F, size_.x, size_.y);
  return true;
}

glm::vec2 LocalMapPicture::corner(int slot) const {
  return glm::vec2(max_texels_ * glm::ivec2(3 * (slot % columns_), 2 * (slot / columns_)));
}

void LocalMapPicture::upload(std::span<const FaceMesh> meshes) {
  vertices_.clear();
  indices_.clear();
  for (const FaceMesh& mesh : meshes) {
    const std::uint32_t first = std::uint32_t(vertices_.size());
    vertices_.insert(vertices_.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const std::uint32_t index : mesh.indices) indices_.push_back(first + index);
  }
  const GLintptr first_vertex = vertex_store_.append(std::span<const LocalMapVertex>(vertices_), 32);
  glVertexArrayVertexBuffer(mesh_array_.name(), 0, vertex_store_.name(), first_vertex,
                            sizeof(LocalMapVertex));
}

void LocalMapPicture::bind_layout(const gl::Program& program, float layer_side, float cell_m) const {
  layout_.bind(program, {.layer_size = {layer_side, float(ReferenceMaps::border)},
                         .picture_size = glm::vec2(size_),
                         .near_far = {methods::cube_near_m, methods::cube_far_m},
                         .cell_m = cell_m});
}

void LocalMapPicture::draw(std::span<const FaceMesh> meshes, const ReferenceMaps& maps, float cell_m) {
  if (meshes.empty()) return;
  upload(meshes);
  const GLintptr first_index = index_store_.append(std::span<const std::uint32_t>(indices_), 4);
  glVertexArrayElementBuffer(mesh_array_.name(), index_store_.name());
  glBindVertexArray(mesh_array_.name());
  glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, colours_.name(), 0);
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, size_.x, size_.y);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  const auto draw_with = [&](const gl::Program& program) {
    program.use();
    gl::bind_textures(program, {{"map_colours", picture_colours_unit, maps.colours()},
                                {"map_distances", distances_unit, maps.distances()},
                                {"map_places", places_unit, maps.place_texture()}});
    bind_layout(program, float(maps.resolution()), cell_m);
    // OpenGL takes the place in the bound buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const void* indices = reinterpret_cast<const void*>(first_index);
    glDrawElements(GL_TRIANGLES, GLsizei(indices_.size()), GL_UNSIGNED_INT, indices);
  };
  if (shown_ != LocalMapView::weights) draw_with(programs_.radiance);
  if (shown_ == LocalMapView::mesh) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  if (shown_ != LocalMapView::radiance) draw_with(programs_.marks);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDisable(GL_DEPTH_TEST);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

render::View LocalMapPicture::face_view(LocalMapPlace place, int face, glm::vec3 centre) const {
  render::View view = methods::face_view(face, centre, place.tile, framebuffer_.name());
  const glm::ivec2 tile_at = glm::ivec2(corner(place.slot)) + place.tile * glm::ivec2(face % 3, face / 3);
  view.width = size_.x;
  view.height = size_.y;
  view.part = glm::ivec4(tile_at, place.tile, place.tile);
  view.clears = false;
  view.subjects = render::Subjects::moving;
  const glm::vec2 middle = glm::vec2(tile_at) + 0.5f * float(place.tile);
  const glm::vec2 shrink = float(place.tile - 2 * local_map_border) / glm::vec2(size_);
  glm::mat4 picture_from_face(1.0f);
  picture_from_face[0][0] = shrink.x, picture_from_face[1][1] = shrink.y;
  picture_from_face[3] = glm::vec4(2.0f * middle / glm::vec2(size_) - 1.0f, 0.0f, 1.0f);
  view.clip_from_world = picture_from_face * view.clip_from_world;
  return view;
}

void LocalMapPicture::update_levels(std::span<const LocalMapPlace> places) {
  if (places.empty()) return;
  rectangles_.clear();
  for (const LocalMapPlace& place : places)
    rectangles_.emplace_back(corner(place.slot), float(place.tile) * glm::vec2(3.0f, 2.0f));
  const GLintptr first = tile_store_.append(std::span<const glm::vec4>(rectangles_), 16);
  glVertexArrayVertexBuffer(tile_array_.name(), 0, tile_store_.name(), first, sizeof(glm::vec4));
  glBindVertexArray(tile_array_.name());
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, 0, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  programs_.level.use();
  bind_layout(programs_.level, 0.0f, 0.0f);
  gl::bind_textures(programs_.level, {{"finer", finer_unit, colours_.name()}});
  for (int level = 1; level < local_map_levels; ++level) {
    // What is read and what is drawn are never one level.
    glTextureParameteri(colours_.name(), GL_TEXTURE_BASE_LEVEL, level - 1);
    glTextureParameteri(colours_.name(), GL_TEXTURE_MAX_LEVEL, level - 1);
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, colours_.name(), level);
    glViewport(0, 0, size_.x >> level, size_.y >> level);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(rectangles_.size()));
  }
  glTextureParameteri(colours_.name(), GL_TEXTURE_BASE_LEVEL, 0);
  glTextureParameteri(colours_.name(), GL_TEXTURE_MAX_LEVEL, local_map_levels - 1);
}

}  // namespace parvis::local_maps
