#include "capture/facades/facade_textures.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

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
  glm::u8vec4 fallback;  ///< w: PackedFacade::lit_of_surface
};

gl::Buffer corners_of(const PackedFacade& facade) {
  const Mesh mesh = mesh_of(facade);
  std::vector<Corner> corners(facade.corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {mesh.positions[i], mesh.normals[i],
                  glm::u8vec4(facade.fallback[i], facade.lit_of_triangle(i / 3))};
  return gl::immutable_buffer(std::span<const Corner>(corners));
}

/// ChosenCorner as the vertex shader reads it.
struct ChosenVertex {
  glm::vec4 at;
  glm::u16vec4 of_first, of_second, rest;  ///< half floats; w: of the first two the photographs' pixel_sizes
  glm::ivec4 stored;                       ///< see facade_surface.glsl
};

glm::u16vec4 halves(glm::vec3 colour, float w) { return glm::packHalf(glm::vec4(colour, w)); }

gl::VertexArray vertices_of(const gl::Buffer& corners, const gl::Buffer& lists, const gl::Buffer& chosen,
                            const gl::Buffer& elements) {
  gl::VertexArray array = gl::VertexArray::create();
  const GLuint name = array.name();
  glVertexArrayVertexBuffer(name, 0, corners.name(), 0, sizeof(Corner));
  glVertexArrayVertexBuffer(name, 1, lists.name(), 0, sizeof(glm::uvec2));
  for (GLuint attribute = 0; attribute < 5; ++attribute) {
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribBinding(name, attribute, attribute == 3 ? 1 : 0);
  }
  glVertexArrayAttribFormat(name, 0, 3, GL_FLOAT, GL_FALSE, offsetof(Corner, position));
  glVertexArrayAttribFormat(name, 1, 3, GL_FLOAT, GL_FALSE, offsetof(Corner, normal));
  glVertexArrayAttribFormat(name, 2, 3, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Corner, fallback));
  glVertexArrayAttribFormat(name, 4, 1, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Corner, fallback) + 3);
  glVertexArrayAttribIFormat(name, 3, 2, GL_UNSIGNED_INT, 0);
  constexpr GLuint first_chosen = 5, end_chosen = 10, chosen_binding = 2;
  glVertexArrayVertexBuffer(name, chosen_binding, chosen.name(), 0, sizeof(ChosenVertex));
  glVertexArrayElementBuffer(name, elements.name());
  for (GLuint attribute = first_chosen; attribute < end_chosen; ++attribute) {
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribBinding(name, attribute, chosen_binding);
  }
  glVertexArrayAttribFormat(name, 5, 4, GL_FLOAT, GL_FALSE, offsetof(ChosenVertex, at));
  glVertexArrayAttribFormat(name, 6, 4, GL_HALF_FLOAT, GL_FALSE, offsetof(ChosenVertex, of_first));
  glVertexArrayAttribFormat(name, 7, 4, GL_HALF_FLOAT, GL_FALSE, offsetof(ChosenVertex, of_second));
  glVertexArrayAttribFormat(name, 8, 4, GL_HALF_FLOAT, GL_FALSE, offsetof(ChosenVertex, rest));
  glVertexArrayAttribIFormat(name, 9, 4, GL_INT, offsetof(ChosenVertex, stored));
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

/// The unit that is taken in and given up: a row of slots of a page.
constexpr int slots_per_strip = slots_across, strips_per_page = slots_per_page / slots_per_strip;

/// The slots of each photograph's tiles, ascending.
std::vector<std::vector<std::uint32_t>> slots_of_photos(const PackedFacade& facade) {
  std::vector<std::vector<std::uint32_t>> slots(facade.photos.size());
  for (const PackedLayer& layer : facade.layers)
    for (int i = 0; i < layer.across() * layer.down(); ++i)
      if (const std::uint32_t tile = facade.tiles[layer.first_tile + std::size_t(i)]; (tile & 3u) != 0)
        slots[layer.photo].push_back(tile >> 2);
  for (std::vector<std::uint32_t>& list : slots) {
    std::ranges::sort(list);
    const auto repeated = std::ranges::unique(list);
    list.erase(repeated.begin(), repeated.end());
  }
  return slots;
}

std::size_t strips_of(std::size_t slots) { return (slots + slots_per_strip - 1) / slots_per_strip; }

/// Bytes of a page with its mipmaps.
std::uint64_t page_bytes(bool decodes) {
  return std::uint64_t(page_side) * page_side * 21 / 16 * (decodes ? 4 : 1);
}

/// Pages that hold all photographs, or as many as a budget has room for; the largest photograph always.
int pages_of(const std::vector<std::size_t>& strips, bool decodes, std::uint64_t max_bytes) {
  std::size_t all = 0, largest = 1;
  for (const std::size_t count : strips) all += count, largest = std::max(largest, count);
  const auto pages = [](std::size_t count) {
    return std::uint64_t((count + strips_per_page - 1) / strips_per_page);
  };
  return int(
      std::clamp(pages(all), pages(largest), std::max(max_bytes / page_bytes(decodes), pages(largest))));
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

gl::Texture atlas_texture(int pages, bool decodes) {
  gl::Texture atlas = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  const GLuint name = atlas.name();
  glTextureStorage3D(name, tile_levels, decodes ? GL_RGBA8 : GL_COMPRESSED_RGBA_BPTC_UNORM, page_side,
                     page_side, pages);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return atlas;
}

Status check_limits(const PackedFacade& facade, int pages, bool decodes) {
  GLint max_layers = 0, max_side = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max_layers);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max_side);
  const std::size_t longest = std::max({facade.depths.size(), facade.tiles.size(), facade.layers.size(),
                                        facade.candidates.size() + max_chosen * facade.triangle_count()});
  if (pages > max_layers || longest / list_width >= std::size_t(max_side) ||
      facade.photos.size() > std::size_t(max_side))
    return error(
        "the captured facade needs {} pages of textures and tables of {} entries; this graphics hardware "
        "holds {} and {}. Divide the place, or pack fewer photographs",
        pages, longest, max_layers, std::size_t(max_side) * list_width);
  return check_memory(checked_product({std::uint64_t(pages), page_bytes(decodes)}),
                      "the textures of a captured facade");
}

}  // namespace

Result<FacadeTextures> FacadeTextures::create(const PackedFacade& facade, HeldTexels held,
                                              std::uint64_t max_texture_bytes) {
  const bool decodes = is_decoded(held);
  std::vector<std::vector<std::uint32_t>> slots = slots_of_photos(facade);
  std::vector<std::size_t> strips;
  std::vector<glm::vec3> centres;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    strips.push_back(strips_of(slots[i].size()));
    centres.emplace_back(facade.photos[i].view.centre);
  }
  const int pages = pages_of(strips, decodes, max_texture_bytes);
  if (Status status = check_limits(facade, pages, decodes); !status) return status.errors();
  std::vector<glm::uvec4> layers;
  for (const PackedLayer& layer : facade.layers) layers.push_back(layer_row(layer));
  const std::size_t all_strips = std::size_t(pages) * strips_per_page;
  FacadeTextures made(facade, decodes, PhotoResidency(std::move(centres), std::move(strips), all_strips));
  made.slots_of_photo_ = std::move(slots);
  made.strips_of_photo_.resize(facade.photos.size());
  for (std::size_t strip = all_strips; strip > 0; --strip)
    made.free_strips_.push_back(std::uint32_t(strip - 1));
  made.resident_tiles_.assign(facade.tiles.size(), 0);
  made.corners_ = corners_of(facade);
  made.photos_ = photo_texture(facade);
  made.layers_ = list_texture(layers, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT);
  made.candidates_ = facade.candidates;
  made.triangles_ = facade.triangle_count();
  made.tiles_ = list_texture(made.resident_tiles_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT);
  made.depths_ = list_texture(facade.depths, GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT);
  made.atlas_ = atlas_texture(pages, decodes);
  return made;
}

bool FacadeTextures::follow(std::span<const glm::vec3> eyes) {
  const ResidencyChange change = residency_.follow(eyes);
  for (const std::uint32_t photo : change.leaving) give_up(photo);
  for (const std::uint32_t photo : change.entering) take_in(photo);
  return !change.empty();
}

void FacadeTextures::take_in(std::uint32_t photo) {
  const std::vector<std::uint32_t>& slots = slots_of_photo_[photo];
  std::vector<std::uint32_t>& strips = strips_of_photo_[photo];
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (i % slots_per_strip == 0) strips.push_back(free_strips_.back()), free_strips_.pop_back();
    const int slot = int(strips.back()) * slots_per_strip + int(i % slots_per_strip);
    const Bc7Block* blocks = facade_->blocks.data() + std::size_t(slots[i]) * blocks_per_slot;
    for (int level = 0; level < tile_levels; ++level) {
      upload_level(atlas_.name(), slot, level, blocks, decodes_);
      blocks += (tile_side >> level) * (tile_side >> level) / 16;
    }
  }
  upload_tiles(photo);
}

void FacadeTextures::give_up(std::uint32_t photo) {
  free_strips_.insert(free_strips_.end(), strips_of_photo_[photo].begin(), strips_of_photo_[photo].end());
  strips_of_photo_[photo].clear();
  upload_tiles(photo);
}

/// Says where each tile of a photograph is; nowhere, while the photograph is not resident.
void FacadeTextures::upload_tiles(std::uint32_t photo) {
  const std::vector<std::uint32_t>&slots = slots_of_photo_[photo], &strips = strips_of_photo_[photo];
  std::size_t low = resident_tiles_.size(), high = 0;
  for (const PackedLayer& layer : facade_->layers) {
    if (layer.photo != photo) continue;
    const std::size_t first = layer.first_tile, last = first + std::size_t(layer.across() * layer.down());
    low = std::min(low, first), high = std::max(high, last);
    for (std::size_t t = first; t < last; ++t) {
      const std::uint32_t tile = facade_->tiles[t];
      resident_tiles_[t] = 0;
      if (strips.empty() || (tile & 3u) == 0) continue;
      const auto i = std::size_t(std::ranges::lower_bound(slots, tile >> 2) - slots.begin());
      resident_tiles_[t] =
          (tile & 3u) |
          (strips[i / slots_per_strip] * std::uint32_t(slots_per_strip) + std::uint32_t(i % slots_per_strip))
              << 2;
    }
  }
  for (std::size_t row = low / list_width; row * list_width < high; ++row) {
    const std::size_t begin = row * list_width,
                      count = std::min<std::size_t>(list_width, resident_tiles_.size() - begin);
    glTextureSubImage2D(tiles_.name(), 0, 0, int(row), int(count), 1, GL_RED_INTEGER, GL_UNSIGNED_INT,
                        resident_tiles_.data() + begin);
  }
}

std::uint64_t FacadeTextures::texture_bytes() const {
  GLint pages = 0;
  glGetTextureLevelParameteriv(atlas_.name(), 0, GL_TEXTURE_DEPTH, &pages);
  return std::uint64_t(pages) * page_bytes(!holds_blocks());
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
  made.corners_ = gl::Buffer::create(), made.elements_ = gl::Buffer::create();
  made.vertices_ = vertices_of(corners_, made.lists_, made.corners_, made.elements_);
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

void ChosenLists::set(const ViewChoice& choice, std::span<const std::uint32_t> tiles) {
  set_triangles(choice, tiles);
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

void ChosenLists::set_triangles(const ViewChoice& choice, std::span<const std::uint32_t> tiles) {
  chosen_ = compared_ = {};
  if (choice.triangles.empty()) return;
  std::vector<ChosenVertex> vertices(3 * choice.triangles.size());
  // A tile's place, or a layer's tiles, of which the shader asks.
  const auto stored = [&](int tile, int across) {
    return tile < 0 || across > 0 ? tile : int(tiles[std::size_t(tile)] >> 2);
  };
  for (std::size_t t = 0; t < choice.triangles.size(); ++t) {
    const std::optional<ChosenTriangle>& one = choice.triangles[t];
    (one ? chosen_ : compared_).triangles.push_back(std::uint32_t(t));
    if (!one) continue;
    const glm::ivec4 places{stored(one->tiles.x, one->tiles.y), one->tiles.y,
                            stored(one->tiles.z, one->tiles.w), one->tiles.w};
    for (std::size_t k = 0; k < 3; ++k) {
      const ChosenCorner& corner = one->corners[k];
      vertices[3 * t + k] = {corner.at, halves(corner.of_first, one->pixel_sizes.x),
                             halves(corner.of_second, one->pixel_sizes.y), halves(corner.rest, 0.0f), places};
    }
  }
  compared_.first_element = 3 * chosen_.triangles.size();
  std::vector<std::uint32_t> elements;
  for (const Part* part : {&chosen_, &compared_})
    for (const std::uint32_t triangle : part->triangles)
      for (std::uint32_t k = 0; k < 3; ++k) elements.push_back(3 * triangle + k);
  glNamedBufferData(corners_.name(), GLsizeiptr(vertices.size() * sizeof(ChosenVertex)), vertices.data(),
                    GL_DYNAMIC_DRAW);
  glNamedBufferData(elements_.name(), GLsizeiptr(elements.size() * sizeof(std::uint32_t)), elements.data(),
                    GL_DYNAMIC_DRAW);
}

void ChosenLists::draw(std::size_t first_triangle, std::size_t triangles, bool are_chosen) const {
  const std::vector<std::uint32_t>& own = part(are_chosen).triangles;
  const auto first = std::ranges::lower_bound(own, first_triangle),
             last = std::ranges::lower_bound(own, first_triangle + triangles);
  const std::size_t begin = part(are_chosen).first_element + 3 * std::size_t(first - own.begin());
  if (first != last)
    glDrawElements(GL_TRIANGLES, GLsizei(3 * (last - first)), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(begin * sizeof(std::uint32_t)));
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
