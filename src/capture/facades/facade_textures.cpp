#include "capture/facades/facade_textures.h"

#include <algorithm>

#include "base/checked.h"
#include "base/memory_budget.h"
#include "capture/facades/placed_facade.h"
#include "graphics/gl/context.h"
#include "graphics/render/bindings.h"

namespace parvis::facades {
namespace {

constexpr int list_width = 1024;  ///< of the textures that hold lists, texels
constexpr int page_side = 1024, slots_across = page_side / tile_side,
              slots_per_page = slots_across * slots_across;

struct Corner {
  glm::vec3 position, normal;
  glm::u8vec4 fallback;
};

gl::Buffer corners_of(const PackedFacade& facade) {
  const Mesh mesh = mesh_of(facade);
  std::vector<Corner> corners(facade.corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {mesh.positions[i], mesh.normals[i], glm::u8vec4(facade.fallback[i], 255)};
  return gl::immutable_buffer(std::span<const Corner>(corners));
}

gl::VertexArray vertices_of(const gl::Buffer& corners, const gl::Buffer& lists) {
  gl::VertexArray array = gl::VertexArray::create();
  const GLuint name = array.name();
  glVertexArrayVertexBuffer(name, 0, corners.name(), 0, sizeof(Corner));
  glVertexArrayVertexBuffer(name, 1, lists.name(), 0, sizeof(glm::uvec2));
  for (GLuint attribute = 0; attribute < 4; ++attribute) {
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribBinding(name, attribute, attribute == 3 ? 1 : 0);
  }
  glVertexArrayAttribFormat(name, 0, 3, GL_FLOAT, GL_FALSE, offsetof(Corner, position));
  glVertexArrayAttribFormat(name, 1, 3, GL_FLOAT, GL_FALSE, offsetof(Corner, normal));
  glVertexArrayAttribFormat(name, 2, 3, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Corner, fallback));
  glVertexArrayAttribIFormat(name, 3, 2, GL_UNSIGNED_INT, 0);
  return array;
}

int rows_of(std::size_t values) { return std::max(int((values + list_width - 1) / list_width), 1); }

gl::Texture empty_list_texture(std::size_t values, GLenum format) {
  gl::Texture texture = gl::texture_2d(format, list_width, rows_of(values));
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

/// A list in rows of list_width texels, read by texelFetch alone.
template <class T>
gl::Texture list_texture(const std::vector<T>& values, GLenum format, GLenum upload, GLenum type) {
  std::vector<T> padded = values;
  padded.resize(std::size_t(rows_of(values.size())) * list_width, T{});
  gl::Texture texture = empty_list_texture(values.size(), format);
  glTextureSubImage2D(texture.name(), 0, 0, 0, list_width, rows_of(values.size()), upload, type,
                      padded.data());
  return texture;
}

gl::Texture photo_texture(const PackedFacade& facade) {
  std::vector<PhotoRow> rows;
  const std::vector<std::size_t> depths = first_depths(facade);
  for (std::size_t i = 0; i < facade.photos.size(); ++i)
    rows.push_back(photo_row(facade.photos[i], depths[i]));
  if (rows.empty()) rows.emplace_back();
  gl::Texture texture = gl::texture_2d(GL_RGBA32F, int(rows[0].size()), int(rows.size()));
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureSubImage2D(texture.name(), 0, 0, 0, int(rows[0].size()), int(rows.size()), GL_RGBA, GL_FLOAT,
                      rows.data());
  return texture;
}

int pages_of(const PackedFacade& facade) {
  return std::max(int((facade.slot_count() + slots_per_page - 1) / slots_per_page), 1);
}

/// A renderer in software decodes each block again for each texel that it reads, which takes ten times as
/// long as all the rest: there blocks are decoded once.
bool is_decoded(HeldTexels held) {
  return held == HeldTexels::decoded || (held == HeldTexels::for_renderer && gl::is_software());
}

/// Level `level` of slot `slot`, at its place of `atlas`.
void upload_level(GLuint atlas, int slot, int level, const Bc7Block* blocks, bool decodes) {
  const int side = tile_side >> level;
  const int left = side * (slot % slots_across), top = side * (slot % slots_per_page / slots_across),
            page = slot / slots_per_page;
  if (decodes)
    glTextureSubImage3D(atlas, level, left, top, page, side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        picture_of(blocks, side, side).pixels.data());
  else
    glCompressedTextureSubImage3D(atlas, level, left, top, page, side, side, 1, GL_COMPRESSED_RGBA_BPTC_UNORM,
                                  GLsizei(side * side / 16 * int(bc7_block_bytes)), blocks);
}

gl::Texture atlas_texture(const PackedFacade& facade, bool decodes) {
  gl::Texture atlas = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  const GLuint name = atlas.name();
  glTextureStorage3D(name, tile_levels, decodes ? GL_RGBA8 : GL_COMPRESSED_RGBA_BPTC_UNORM, page_side,
                     page_side, pages_of(facade));
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  const Bc7Block* blocks = facade.blocks.data();
  for (int slot = 0; slot < int(facade.slot_count()); ++slot)
    for (int level = 0; level < tile_levels; ++level) {
      upload_level(name, slot, level, blocks, decodes);
      blocks += (tile_side >> level) * (tile_side >> level) / 16;
    }
  return atlas;
}

Status check_limits(const PackedFacade& facade, bool decodes) {
  GLint max_layers = 0, max_side = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max_layers);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max_side);
  const std::size_t longest = std::max({facade.depths.size(), facade.tiles.size(), facade.layers.size(),
                                        facade.candidates.size() + max_chosen * facade.triangle_count()});
  if (pages_of(facade) > max_layers || longest / list_width >= std::size_t(max_side) ||
      facade.photos.size() > std::size_t(max_side))
    return error(
        "the captured facade needs {} pages of textures and tables of {} entries; this graphics hardware "
        "holds {} and {}. Divide the place, or pack fewer photographs",
        pages_of(facade), longest, max_layers, std::size_t(max_side) * list_width);
  const std::uint64_t bytes_per_texel = decodes ? 4 : 1;
  return check_memory(checked_product({std::uint64_t(pages_of(facade)),
                                       std::uint64_t(page_side) * page_side * 21 / 16, bytes_per_texel}),
                      "the textures of a captured facade");
}

}  // namespace

Result<FacadeTextures> FacadeTextures::create(const PackedFacade& facade, HeldTexels held) {
  const bool decodes = is_decoded(held);
  if (Status status = check_limits(facade, decodes); !status) return status.errors();
  std::vector<glm::uvec4> layers;
  for (const PackedLayer& layer : facade.layers) layers.push_back(layer_row(layer));
  FacadeTextures made;
  made.corners_ = corners_of(facade);
  made.photos_ = photo_texture(facade);
  made.layers_ = list_texture(layers, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT);
  made.candidates_ = facade.candidates;
  made.triangles_ = facade.triangle_count();
  made.tiles_ = list_texture(facade.tiles, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT);
  made.depths_ = list_texture(facade.depths, GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT);
  made.atlas_ = atlas_texture(facade, decodes);
  return made;
}

bool FacadeTextures::holds_blocks() const {
  GLint is_compressed = GL_FALSE;
  glGetTextureLevelParameteriv(atlas_.name(), 0, GL_TEXTURE_COMPRESSED, &is_compressed);
  return is_compressed == GL_TRUE;
}

ChosenLists FacadeTextures::chosen_lists() const {
  ChosenLists made;
  made.lists_ = gl::Buffer::create();
  glNamedBufferStorage(made.lists_.name(),
                       GLsizeiptr(std::max<std::size_t>(3 * triangles_, 1) * sizeof(glm::uvec2)), nullptr,
                       GL_DYNAMIC_STORAGE_BIT);
  made.vertices_ = vertices_of(corners_, made.lists_);
  // The facade's own list fills whole rows, so that what is chosen begins a new one.
  made.first_chosen_ = std::size_t(rows_of(candidates_.size())) * list_width;
  made.candidates_ = empty_list_texture(made.first_chosen_ + max_chosen * triangles_, GL_R32UI);
  std::vector<std::uint32_t> padded = candidates_;
  padded.resize(made.first_chosen_, 0);
  glTextureSubImage2D(made.candidates_.name(), 0, 0, 0, list_width, rows_of(candidates_.size()),
                      GL_RED_INTEGER, GL_UNSIGNED_INT, padded.data());
  made.own_candidates_ = candidates_.size();
  return made;
}

void ChosenLists::set(const ViewChoice& choice) {
  std::vector<glm::uvec2> corners;
  corners.reserve(3 * choice.lists.size());
  for (glm::uvec2 list : choice.lists) {
    if (list.x >= own_candidates_ && list.y > 0) list.x += std::uint32_t(first_chosen_ - own_candidates_);
    corners.insert(corners.end(), 3, list);
  }
  glNamedBufferSubData(lists_.name(), 0, GLsizeiptr(corners.size() * sizeof(glm::uvec2)), corners.data());
  if (choice.candidates.empty()) return;
  std::vector<std::uint32_t> padded = choice.candidates;
  padded.resize(std::size_t(rows_of(padded.size())) * list_width, 0);
  glTextureSubImage2D(candidates_.name(), 0, 0, int(first_chosen_ / list_width), list_width,
                      rows_of(choice.candidates.size()), GL_RED_INTEGER, GL_UNSIGNED_INT, padded.data());
}

void FacadeTextures::bind(const gl::Program& program, const ChosenLists& lists) const {
  GLuint unit = render::first_drawable_unit;
  const auto bind_one = [&](const char* sampler, const gl::Texture& texture) {
    glBindTextureUnit(unit, texture.name());
    program.set(sampler, int(unit++));
  };
  bind_one("facade_photos", photos_), bind_one("facade_layers", layers_);
  bind_one("facade_candidates", lists.candidates_), bind_one("facade_tiles", tiles_);
  bind_one("facade_depths", depths_), bind_one("facade_atlas", atlas_);
  glBindVertexArray(lists.vertices_.name());
}

void FacadeTextures::draw(std::size_t first_triangle, std::size_t triangles) const {
  glDrawArrays(GL_TRIANGLES, GLint(3 * first_triangle), GLsizei(3 * triangles));
}

}  // namespace parvis::facades
