#include "capture/facades/packed_facade.h"

#include <algorithm>
#include <cmath>

#include "base/sealed_file.h"

namespace parvis::facades {
namespace {

constexpr SealedKind packed_kind{"PVFACE_3", "packed facade"};
constexpr int max_box_side = 65535;  // boxes are kept in 16 bits

/// Whether the shader's floats hold its numbers.
bool is_finite(const PackedPhoto& photo) {
  const View& view = photo.view;
  float sum = 0.0f;
  for (const glm::vec4& values : photo_row(photo, 0)) sum += values.x + values.y + values.z + values.w;
  return std::isfinite(sum) && view.fx > 0.0 && view.fy > 0.0 && view.width > 0 && view.height > 0 &&
         view.width <= max_box_side && view.height <= max_box_side;
}

/// Says what does not fit together; empty: all does.
std::string problem_of(const PackedFacade& facade) {
  const std::size_t triangles = facade.triangle_count();
  if (facade.corners.size() != 3 * triangles || facade.fallback.size() != 3 * triangles ||
      facade.surface_of_triangle.size() != triangles || facade.lists.size() != triangles)
    return "its lists of triangles differ in length";
  for (const glm::vec3& corner : facade.corners)
    if (!std::isfinite(corner.x + corner.y + corner.z)) return "a corner is no number";
  if (!std::ranges::all_of(facade.surface_of_triangle,
                           [&](std::uint32_t s) { return s < facade.surfaces.size(); }))
    return "a triangle has no surface";
  for (const glm::uvec2& list : facade.lists)
    if (std::uint64_t(list.x) + list.y > facade.candidates.size()) return "a list of layers is cut off";
  if (std::ranges::any_of(facade.lists,
                          [&](const glm::uvec2& list) { return list.y > facade.photos.size(); }))
    return "a triangle has more layers than there are photographs";
  if (!std::ranges::all_of(facade.candidates, [&](std::uint32_t l) { return l < facade.layers.size(); }))
    return "a triangle has a layer that is not there";
  for (const PackedLayer& layer : facade.layers) {
    if (layer.photo >= facade.photos.size()) return "a layer has no photograph";
    const View& view = facade.photos[layer.photo].view;
    if (layer.box.empty() || layer.box.x < 0 || layer.box.y < 0 || layer.box.width > view.width ||
        layer.box.height > view.height || layer.box.x > view.width - layer.box.width ||
        layer.box.y > view.height - layer.box.height)
      return "a layer lies outside of its photograph";
    if (std::uint64_t(layer.first_tile) + std::uint64_t(layer.across()) * std::uint64_t(layer.down()) >
        facade.tiles.size())
      return "a layer's tiles are not all there";
  }
  if (facade.blocks.size() % blocks_per_slot != 0) return "its textures are cut off";
  for (const std::uint32_t tile : facade.tiles)
    if ((tile & 3u) != 0 && (tile >> 2) >= facade.slot_count()) return "a tile has no texture";
  if (!std::ranges::all_of(facade.photos, is_finite)) return "a photograph's camera is none";
  std::size_t cells = 0;
  for (const PackedPhoto& photo : facade.photos)
    cells += std::size_t(depth_cells(photo.view).x) * std::size_t(depth_cells(photo.view).y);
  if (facade.depths.size() != cells) return "its depths are not all there";
  return "";
}

}  // namespace

std::size_t PackedFacade::texture_bytes() const {
  return blocks.size() * bc7_block_bytes + tiles.size() * sizeof(std::uint32_t) +
         depths.size() * sizeof(std::uint16_t) + layers.size() * sizeof(glm::uvec4) +
         photos.size() * sizeof(PhotoRow) + candidates.size() * sizeof(std::uint32_t);
}

std::size_t PackedFacade::photograph_bytes() const {
  std::size_t bytes = 0;
  for (const PackedPhoto& photo : photos)
    bytes += 4 * std::size_t(photo.view.width) * std::size_t(photo.view.height);
  return bytes;
}

Bounds PackedFacade::bounds() const {
  Bounds bounds;
  for (const glm::vec3& corner : corners) bounds.add(corner);
  return bounds;
}

Status write_facade(const std::filesystem::path& file, const PackedFacade& facade) {
  std::string bytes;
  append_value(bytes, std::uint32_t(facade.surfaces.size()));
  for (const std::string& name : facade.surfaces) append_text(bytes, name);
  append_values(bytes, facade.corners), append_values(bytes, facade.surface_of_triangle);
  append_values(bytes, facade.fallback), append_values(bytes, facade.lists);
  append_values(bytes, facade.candidates);
  append_value(bytes, std::uint32_t(facade.photos.size()));
  for (const PackedPhoto& photo : facade.photos)
    append_text(bytes, photo.name), append_value(bytes, photo.view), append_value(bytes, photo.balance);
  append_values(bytes, facade.layers), append_values(bytes, facade.tiles);
  append_values(bytes, facade.blocks), append_values(bytes, facade.depths);
  return write_sealed(file, packed_kind, bytes);
}

Result<PackedFacade> read_facade(const std::filesystem::path& file) {
  const Result<std::string> content = read_sealed(file, packed_kind);
  if (!content) return content.errors();
  return facade_of(*content, file);
}

Result<PackedFacade> facade_of(std::string_view content, const std::filesystem::path& file) {
  ByteReader reader(content);
  PackedFacade facade;
  const std::uint32_t surfaces = reader.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < surfaces && !reader.has_ended_early(); ++i)
    facade.surfaces.push_back(reader.take_text());
  facade.corners = reader.take_values<glm::vec3>();
  facade.surface_of_triangle = reader.take_values<std::uint32_t>();
  facade.fallback = reader.take_values<glm::u8vec3>();
  facade.lists = reader.take_values<glm::uvec2>();
  facade.candidates = reader.take_values<std::uint32_t>();
  const std::uint32_t photos = reader.take<std::uint32_t>();
  if (photos > max_facade_photos)
    return error("{}: it names {} photographs; at most {} are read", file.string(), photos,
                 max_facade_photos);
  for (std::uint32_t i = 0; i < photos && !reader.has_ended_early(); ++i) {
    PackedPhoto photo;
    photo.name = reader.take_text();
    photo.view = reader.take<View>(), photo.balance = reader.take<Balance>();
    facade.photos.push_back(std::move(photo));
  }
  facade.layers = reader.take_values<PackedLayer>();
  facade.tiles = reader.take_values<std::uint32_t>();
  facade.blocks = reader.take_values<Bc7Block>();
  facade.depths = reader.take_values<std::uint16_t>();
  if (!reader.is_at_end()) return cut_short(file);
  if (Status status = check_facade(facade, file); !status) return status.errors();
  return facade;
}

Status check_facade(const PackedFacade& facade, const std::filesystem::path& file) {
  if (const std::string problem = problem_of(facade); !problem.empty())
    return error("{}: {}; pack the facade again (parvis facade pack)", file.string(), problem);
  return Ok{};
}

std::uint16_t encoded_depth(double depth) {
  if (!(depth > 0.0)) return 0;
  return std::uint16_t(std::lround(std::clamp(2048.0 * (std::log2(depth) + 16.0), 0.0, 65535.0)));
}

std::vector<std::size_t> first_depths(const PackedFacade& facade) {
  std::vector<std::size_t> firsts;
  std::size_t next = 0;
  for (const PackedPhoto& photo : facade.photos) {
    firsts.push_back(next);
    next += std::size_t(depth_cells(photo.view).x) * std::size_t(depth_cells(photo.view).y);
  }
  return firsts;
}

PhotoRow photo_row(const PackedPhoto& photo, std::size_t first_depth) {
  const View& view = photo.view;
  const glm::dmat3 rotation_rows = glm::transpose(view.camera_from_world);  // columns are its rows
  const glm::dvec3 rows[3]{view.fx * rotation_rows[0] + view.cx * rotation_rows[2],
                           view.fy * rotation_rows[1] + view.cy * rotation_rows[2], rotation_rows[2]};
  PhotoRow row{};
  for (std::size_t i = 0; i < 3; ++i)
    row[i] = glm::vec4(glm::dvec4(rows[i], -glm::dot(rows[i], view.centre)));
  row[3] = glm::vec4(glm::dvec4(view.centre, view.fx));
  // In rows, so that the number is exact in 32 bits however many photographs there are.
  row[4] = glm::vec4(view.width, view.height, float(first_depth >> 12), float(first_depth & 4095));
  const auto& b = photo.balance;
  row[5] = glm::vec4(b.scale[0], b.scale[1], b.scale[2], 0.0f);
  row[6] = glm::vec4(b.offset[0], b.offset[1], b.offset[2], 0.0f);
  return row;
}

glm::uvec4 layer_row(const PackedLayer& layer) {
  return {std::uint32_t(layer.box.x) | std::uint32_t(layer.box.y) << 16,
          std::uint32_t(layer.across()) | std::uint32_t(layer.down()) << 16, layer.first_tile, layer.photo};
}

}  // namespace parvis::facades
