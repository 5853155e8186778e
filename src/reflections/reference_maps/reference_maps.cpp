#include "reflections/reference_maps/reference_maps.h"

#include <algorithm>
#include <array>

#include "base/progress.h"
#include "graphics/gl/context.h"
#include "reflections/reference_maps/map_levels.h"
#include "reflections/reference_maps/map_painter.h"

namespace parvis::reference_maps {
namespace {

constexpr int levels = 4;  // as far as the border reaches
constexpr GLenum compressed_colour = GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT;

gl::Texture layers_of(GLenum format, int level_count, glm::ivec2 size, std::size_t count) {
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  glTextureStorage3D(texture.name(), level_count, format, size.x, size.y, GLsizei(count));
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER,
                      level_count > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTextureParameteri(texture.name(), axis, GL_CLAMP_TO_EDGE);
  return texture;
}

gl::Texture texture_of(const std::vector<glm::vec3>& places) {
  gl::Texture texture = gl::texture_2d(GL_RGB32F, int(places.size()), 1);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureSubImage2D(texture.name(), 0, 0, 0, GLsizei(places.size()), 1, GL_RGB, GL_FLOAT, places.data());
  return texture;
}

/// A texture of the maps as its bytes are read and written.
struct Layer {
  GLuint texture;
  glm::ivec2 size;
  GLenum format, type;
  int texel_bytes;

  std::size_t bytes() const { return std::size_t(size.x) * std::size_t(size.y) * std::size_t(texel_bytes); }
};

std::array<Layer, 3> layers_in(const ReferenceMaps& maps) {
  const glm::ivec2 side(maps.resolution());
  return {{{maps.colours(), side, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, 4},
           {maps.glosses(), ReferenceMaps::gloss_size(), GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, 4},
           {maps.distances(), side, GL_RED, GL_HALF_FLOAT, 2}}};
}

std::vector<std::uint8_t> read_level(const Layer& layer, int level, std::size_t map) {
  const glm::ivec2 size = layer.size >> level;
  std::vector<std::uint8_t> bytes(std::size_t(size.x) * std::size_t(size.y) * std::size_t(layer.texel_bytes));
  glGetTextureSubImage(layer.texture, level, 0, 0, GLint(map), size.x, size.y, 1, layer.format, layer.type,
                       GLsizei(bytes.size()), bytes.data());
  return bytes;
}

void write_level(const Layer& layer, int level, std::size_t map, const std::vector<std::uint8_t>& bytes) {
  const glm::ivec2 size = layer.size >> level;
  glTextureSubImage3D(layer.texture, level, 0, 0, GLint(map), size.x, size.y, 1, layer.format, layer.type,
                      bytes.data());
}

std::size_t colour_bytes_per_map(int resolution, bool is_compressed) {
  std::size_t bytes = 0;
  for (int level = 0; level < levels; ++level) {
    const std::size_t side = std::size_t(std::max(resolution >> level, 1)), blocks = (side + 3) / 4;
    bytes += is_compressed ? 16 * blocks * blocks : 4 * side * side;
  }
  return bytes;
}

}  // namespace

glm::ivec2 ReferenceMaps::gloss_size() { return {int(gloss_tile_count * gloss_side), int(gloss_side)}; }

// A multiple of 16, so that the levels' borders end between texels.
int ReferenceMaps::layer_side(int face_resolution) {
  return std::max((17 * face_resolution / 8 + 8) / 16, 1) * 16;
}

ReferenceMaps::ReferenceMaps(std::vector<glm::vec3> places, int resolution, bool is_compressed)
    : places_(std::move(places)),
      resolution_(resolution),
      is_compressed_(is_compressed),
      colours_(layers_of(is_compressed ? compressed_colour : GL_R11F_G11F_B10F, levels,
                         glm::ivec2(resolution), places_.size())),
      glosses_(layers_of(GL_R11F_G11F_B10F, 1, gloss_size(), places_.size())),
      distances_(layers_of(GL_R16F, 1, glm::ivec2(resolution), places_.size())),
      place_texture_(texture_of(places_)) {}

std::size_t ReferenceMaps::bytes_per_map(int resolution, bool is_compressed) {
  const glm::ivec2 gloss = gloss_size();
  return colour_bytes_per_map(resolution, is_compressed) + 4 * std::size_t(gloss.x) * std::size_t(gloss.y) +
         2 * std::size_t(resolution) * std::size_t(resolution);
}

std::size_t ReferenceMaps::max_count() {
  GLint max_layers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max_layers);
  return std::size_t(max_layers);
}

Result<ReferenceMaps> ReferenceMaps::create(std::vector<glm::vec3> places, int resolution,
                                            bool is_compressed) {
  const std::size_t count = places.size();
  if (count > max_count())
    return error(
        "{} reference maps of {} x {} texels: this method holds at most {} at once; ask for fewer "
        "(referenceMaps(maps=...)), or take a method that keeps those that are looked into",
        count, resolution, resolution, max_count());
  gl::refused();  // what is left from before is not about these maps
  ReferenceMaps maps(std::move(places), resolution, is_compressed);
  if (const std::string why = gl::refused(); !why.empty())
    return error("the graphics driver refuses {} reference maps of {} x {} texels, {:.0f} MB: {}", count,
                 resolution, resolution, 1e-6 * double(maps.bytes()), why);
  return maps;
}

Result<ReferenceMaps> ReferenceMaps::bake(render::Renderer& renderer, std::vector<glm::vec3> places,
                                          int face_resolution) {
  Result<MapPainter> painter = MapPainter::create(face_resolution);
  if (!painter) return painter.errors();
  Result<ReferenceMaps> maps = create(std::move(places), layer_side(face_resolution));
  if (!maps) return maps.errors();
  Progress progress("reference maps", maps->places_.size());
  for (std::size_t i = 0; i < maps->places_.size(); ++i) {
    painter->paint(renderer, *maps, i);
    progress.advance();
  }
  maps->update_levels();
  return maps;
}

void ReferenceMaps::update_levels() { glGenerateTextureMipmap(colours_.name()); }

std::vector<std::vector<std::uint8_t>> ReferenceMaps::read(std::size_t map) const {
  std::vector<std::vector<std::uint8_t>> textures;
  for (const Layer& layer : layers_in(*this)) textures.push_back(read_level(layer, 0, map));
  return textures;
}

bool ReferenceMaps::write(std::size_t map, const std::vector<std::vector<std::uint8_t>>& textures) {
  const std::array<Layer, 3> layers = layers_in(*this);
  if (!std::ranges::equal(
          textures, layers, {}, [](const auto& bytes) { return bytes.size(); }, &Layer::bytes))
    return false;
  for (std::size_t i = 0; i < layers.size(); ++i) write_level(layers[i], 0, map, textures[i]);
  return true;
}

void ReferenceMaps::move(std::size_t map, glm::vec3 place) {
  places_[map] = place;
  glTextureSubImage2D(place_texture_.name(), 0, GLint(map), 0, 1, 1, GL_RGB, GL_FLOAT, &place.x);
}

void ReferenceMaps::copy(std::size_t map, const ReferenceMaps& from, std::size_t map_there) {
  const std::array<Layer, 3> here = layers_in(*this), there = layers_in(from);
  for (std::size_t i = 0; i < here.size(); ++i)
    for (int level = 0; level < (i == 0 ? levels : 1); ++level) {
      const glm::ivec2 size = here[i].size >> level;
      if (i == 0 && is_compressed_)
        write_level(here[i], level, map, read_level(there[i], level, map_there));
      else
        glCopyImageSubData(there[i].texture, GL_TEXTURE_2D_ARRAY, level, 0, 0, GLint(map_there),
                           here[i].texture, GL_TEXTURE_2D_ARRAY, level, 0, 0, GLint(map), size.x, size.y, 1);
    }
}

std::size_t ReferenceMaps::colour_bytes() const {
  return colour_bytes_per_map(resolution_, is_compressed_) * places_.size();
}

std::size_t ReferenceMaps::bytes() const {
  return bytes_per_map(resolution_, is_compressed_) * places_.size();
}

}  // namespace parvis::reference_maps
