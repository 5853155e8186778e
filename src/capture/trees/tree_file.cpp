#include "capture/trees/tree_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "base/checked.h"
#include "base/file_front.h"
#include "base/memory_budget.h"
#include "capture/trees/billboard_blocks.h"
#include "capture/trees/block_table.h"
#include "capture/trees/crossed_billboards.h"
#include "capture/trees/texture_blocks.h"
#include "formats/gltf/gltf_own_data.h"

namespace parvis::trees {
namespace {

// Coded: the textures' blocks are numbers into a table (block_table.h).
constexpr SealedKind plain_kind{"PVTREE_2", "captured tree"}, coded_kind{"PVTREE_3", "captured tree"};
constexpr SealedKind volume_kind{"PVTVOL_2", "tree volume"};
const std::string gltf_extension = "PARVIS_captured_tree";
const std::string gltf_view = "tree";
constexpr int max_billboard_side = 256;  // finer billboards than this are smaller than pixels
constexpr int max_texels_per_side = 64, max_views = 1024;

std::vector<TextureBlock> blocks_of(const BillboardTextures& view, int side) {
  std::vector<TextureBlock> blocks;
  blocks.reserve(view.texels.size() / std::tuple_size_v<BlockTexels>);
  for_each_block(view, side, [&](const BlockTexels& texels) { blocks.push_back(compressed_block(texels)); });
  return blocks;
}

/// The textures that blocks hold.
void put_blocks(BillboardTextures& view, const std::vector<TextureBlock>& blocks, int side) {
  view.texels.resize(blocks.size() * std::tuple_size_v<BlockTexels>);
  std::size_t next = 0;
  replace_blocks(view, side, [&] { return decompressed_block(blocks[next++]); });
}

/// One bit per cell: has the view a texture of it?
std::vector<std::uint8_t> bits_of(const std::vector<std::int32_t>& texture_of_cell) {
  std::vector<std::uint8_t> bits((texture_of_cell.size() + 7) / 8, 0);
  for (std::size_t i = 0; i < texture_of_cell.size(); ++i)
    if (texture_of_cell[i] >= 0) bits[i / 8] |= std::uint8_t(1u << (i % 8));
  return bits;
}

bool is_finite(const Pinhole& camera) {
  const auto finite = [](const auto& v) { return !glm::any(glm::isnan(v)) && !glm::any(glm::isinf(v)); };
  return finite(camera.focal) && finite(camera.principal_point) && finite(camera.position_in_world) &&
         finite(camera.world_from_camera[0]) && finite(camera.world_from_camera[1]) &&
         finite(camera.world_from_camera[2]);
}

bool is_light(const CapturedLight& light) {
  const float length = glm::length(light.to_sun);
  return std::abs(length - 1.0f) < 1e-3f && light.sun >= 0.0f && light.sky >= 0.0f &&
         std::isfinite(light.sun) && std::isfinite(light.sky);
}

/// Checks what the grid's constructor takes for granted.
std::string grid_problem(const Bounds& box, int branching, int side, int max_side,
                         const std::vector<glm::u16vec3>& cells) {
  const glm::vec3 size = box.size();
  if (!(size.x > 0.0f && size.y > 0.0f && size.z > 0.0f) || glm::any(glm::isinf(size)))
    return "its box has no extent";
  if (branching != 2 && branching != 3) return fmt::format("its branching is {}, expected 2 or 3", branching);
  int power = 1;
  while (power < side && power <= max_side) power *= branching;
  if (side < 1 || side > max_side || power != side)
    return fmt::format("its side of {} cells is no power of {} up to {}", side, branching, max_side);
  std::set<std::array<int, 3>> seen;
  for (const glm::u16vec3 c : cells) {
    if (c.x >= side || c.y >= side || c.z >= side) return "a cell lies outside of its grid";
    if (!seen.insert({c.x, c.y, c.z}).second) return "a cell occurs twice";
  }
  return "";
}

}  // namespace

namespace {

/// The content of a tree's file.
struct Content {
  SealedKind kind;
  std::string bytes;
};

/// The kind of a file that begins so.
SealedKind kind_of(std::string_view front) {
  return front.starts_with(coded_kind.magic) ? coded_kind : plain_kind;
}

/// A view's textures in the order of the cells that have one: then a bit per cell says which is whose.
BillboardTextures ordered(const BillboardTextures& view, int side) {
  const std::size_t bytes_per_texture = 4 * std::size_t(side) * std::size_t(side);
  BillboardTextures result{view.camera, {}, {}};
  result.texels.reserve(view.texels.size());
  for (const std::int32_t texture : view.texture_of_cell)
    if (texture >= 0) {
      const auto first = view.texels.begin() + std::ptrdiff_t(std::size_t(texture) * bytes_per_texture);
      result.texels.insert(result.texels.end(), first, first + std::ptrdiff_t(bytes_per_texture));
    }
  return result;
}

/// The content of a tree's file. `file`: as errors call it.
Result<Content> content_of(const std::filesystem::path& file, const BillboardTree& tree) {
  if (tree.texels_per_side % 4 != 0 || tree.texels_per_side > max_texels_per_side)
    return error(
        "{}: textures of {} texels along a side cannot be written, expected a multiple of 4 up to {}",
        file.string(), tree.texels_per_side, max_texels_per_side);
  std::vector<std::vector<TextureBlock>> blocks;
  blocks.reserve(tree.views.size());
  for (const BillboardTextures& view : tree.views)
    blocks.push_back(blocks_of(ordered(view, tree.texels_per_side), tree.texels_per_side));
  const std::optional<BlockTable> table = BlockTable::of(blocks);
  Content content{table ? coded_kind : plain_kind, {}};
  std::string& bytes = content.bytes;
  append_value(bytes, tree.grid.box()), append_value(bytes, std::int32_t(tree.grid.branching()));
  append_value(bytes, std::int32_t(tree.grid.side()));
  append_value(bytes, std::int32_t(tree.texels_per_side));
  append_values(bytes, tree.grid.cells()), append_values(bytes, tree.base);
  append_value(bytes, tree.light), append_value(bytes, std::uint32_t(tree.views.size()));
  if (table) append_values(bytes, table->blocks());
  for (std::size_t v = 0; v < tree.views.size(); ++v) {
    append_value(bytes, tree.views[v].camera), append_values(bytes, bits_of(tree.views[v].texture_of_cell));
    if (table)
      append_values(bytes, table->numbers_of(blocks[v]));
    else
      append_values(bytes, blocks[v]);
  }
  if (tree.trunk) append_trunk(bytes, *tree.trunk);
  return content;
}

/// Takes a view's blocks: numbers into the table, where there is one. Error: a number beyond it; memory, of
/// which the blocks of a few bytes take much.
Result<std::vector<TextureBlock>> take_blocks(ByteReader& reader, const std::optional<BlockTable>& table,
                                              const std::filesystem::path& file) {
  if (!table) return reader.take_values<TextureBlock>();
  const auto numbers = reader.take_values<std::uint16_t>();
  if (Status enough = check_memory(checked_product({numbers.size(), block_bytes}),
                                   file.string() + ": the blocks of a view");
      !enough)
    return enough.errors();
  std::optional<std::vector<TextureBlock>> blocks = table->blocks_of(numbers);
  if (!blocks)
    return error("{}: the captured tree is damaged: a block's number is beyond its table of {}",
                 file.string(), table->blocks().size());
  return *std::move(blocks);
}

Result<BillboardTree> tree_of(const std::filesystem::path& file, const SealedKind& kind,
                              const std::string& content) {
  const auto wrong = [&](const std::string& what) {
    return error("{}: the captured tree is damaged: {}", file.string(), what);
  };
  ByteReader reader(content);
  const auto box = reader.take<Bounds>();
  const auto branching = reader.take<std::int32_t>(), side = reader.take<std::int32_t>(),
             texels = reader.take<std::int32_t>();
  std::vector<glm::u16vec3> cells = reader.take_values<glm::u16vec3>();
  BillboardTree tree;
  tree.base = reader.take_values<glm::u8vec4>();
  tree.light = reader.take<CapturedLight>();
  const auto view_count = reader.take<std::uint32_t>();
  if (reader.has_ended_early()) return cut_short(file);
  if (const std::string problem = grid_problem(box, branching, side, max_billboard_side, cells);
      !problem.empty())
    return wrong(problem);
  if (tree.base.size() != cells.size()) return wrong("as many base colours as cells were expected");
  if (!is_light(tree.light)) return wrong("the light of its photographs is no light");
  if (texels < 4 || texels > max_texels_per_side || texels % 4 != 0)
    return wrong(fmt::format("textures of {} texels along a side", texels));
  if (view_count > max_views)
    return wrong(fmt::format("{} views, at most {} are possible", view_count, max_views));
  const std::size_t cell_count = cells.size(),
                    blocks_per_texture = std::size_t(texels / 4) * std::size_t(texels / 4);
  // Of a view the file has a bit per cell, and memory four bytes.
  if (Status enough =
          check_memory(checked_product({view_count, cell_count, sizeof(std::int32_t)}),
                       fmt::format("{}: its {} views of {} cells", file.string(), view_count, cell_count));
      !enough)
    return enough.errors();
  tree.grid = CellGrid(box, branching, side, std::move(cells)), tree.texels_per_side = texels;
  std::optional<BlockTable> table;
  if (kind.magic == coded_kind.magic) {
    std::vector<TextureBlock> blocks = reader.take_values<TextureBlock>();
    if (blocks.size() > BlockTable::max_blocks)
      return wrong(fmt::format("a table of {} blocks, at most {} are possible", blocks.size(),
                               BlockTable::max_blocks));
    table.emplace(std::move(blocks));
  }
  for (std::uint32_t v = 0; v < view_count; ++v) {
    BillboardTextures view;
    view.camera = reader.take<Pinhole>();
    const auto bits = reader.take_values<std::uint8_t>();
    const Result<std::vector<TextureBlock>> blocks = take_blocks(reader, table, file);
    if (!blocks) return blocks.errors();
    if (reader.has_ended_early()) return cut_short(file);
    if (!is_finite(view.camera) || view.camera.width < 1 || view.camera.height < 1)
      return wrong("a camera is no camera");
    if (bits.size() != (cell_count + 7) / 8) return wrong("a view's cells do not match the grid's");
    std::int32_t next = 0;
    for (std::size_t i = 0; i < cell_count; ++i)
      view.texture_of_cell.push_back(bits[i / 8] >> (i % 8) & 1 ? next++ : -1);
    if (blocks->size() != std::size_t(next) * blocks_per_texture)
      return wrong("a view's textures do not match its cells");
    if (Status enough = check_memory(checked_product({blocks->size(), std::tuple_size_v<BlockTexels>}),
                                     file.string() + ": the textures of a view");
        !enough)
      return enough.errors();
    put_blocks(view, *blocks, texels);
    tree.views.push_back(std::move(view));
  }
  if (!reader.is_at_end()) {  // trees of one kind end here, those with a trunk as geometry go on
    Result<TrunkShape> trunk = take_trunk(reader);
    if (!trunk) return wrong(trunk.errors().front().message);
    tree.trunk = *std::move(trunk);
  }
  if (!reader.is_at_end()) return wrong("bytes follow its end");
  return tree;
}

}  // namespace

Result<std::size_t> write_tree(const std::filesystem::path& file, const BillboardTree& tree) {
  const Result<Content> content = content_of(file, tree);
  if (!content) return content.errors();
  if (file.extension() == ".glb") {
    const scene::GltfOwnData own{
        gltf_extension, "{}", {{gltf_view, sealed_bytes(content->kind, content->bytes)}}};
    if (Status status = scene::write_gltf(file, crossed_model(tree), own); !status) return status.errors();
  } else if (Status status = write_sealed(file, content->kind, content->bytes); !status) {
    return status.errors();
  }
  return content->bytes.size() + content->kind.magic.size() + sizeof(std::uint64_t);
}

Result<BillboardTree> read_tree(const std::filesystem::path& file) {
  if (file.extension() != ".glb") {
    const Result<std::string> front = read_front(file, plain_kind.magic.size());
    const SealedKind kind = front ? kind_of(*front) : plain_kind;
    const Result<std::string> content = read_sealed(file, kind);
    return content ? tree_of(file, kind, *content) : content.errors();
  }
  const Result<scene::GltfOwnData> own = scene::read_gltf_own_data(file, gltf_extension);
  if (!own) return own.errors();
  if (own->views.size() != 1 || own->views.front().first != gltf_view)
    return error("{}: its extension {} does not hold one view \"{}\"", file.string(), gltf_extension,
                 gltf_view);
  const std::string_view bytes = own->views.front().second;
  const SealedKind kind = kind_of(bytes);
  const Result<std::string> content = opened_sealed(file, bytes, kind);
  return content ? tree_of(file, kind, *content) : content.errors();
}

void append_volume(std::string& content, const TreeVolume& volume) {
  append_value(content, volume.grid.box()), append_value(content, std::int32_t(volume.grid.branching()));
  append_value(content, std::int32_t(volume.grid.side()));
  append_values(content, volume.grid.cells()), append_values(content, volume.extinction_per_m);
  append_values(content, volume.colour);
}

Result<std::size_t> write_volume(const std::filesystem::path& file, const TreeVolume& volume) {
  std::string content;
  append_volume(content, volume);
  if (Status status = write_sealed(file, volume_kind, content); !status) return status.errors();
  return content.size() + volume_kind.magic.size() + sizeof(std::uint64_t);
}

Result<TreeVolume> read_volume(const std::filesystem::path& file) {
  const Result<std::string> content = read_sealed(file, volume_kind);
  if (!content) return content.errors();
  ByteReader reader(*content);
  Result<TreeVolume> volume = take_volume(reader, file);
  if (volume && !reader.is_at_end())
    return error("{}: the tree volume is damaged: bytes follow its end", file.string());
  return volume;
}

Result<TreeVolume> take_volume(ByteReader& reader, const std::filesystem::path& file) {
  const auto wrong = [&](const std::string& what) {
    return error("{}: the tree volume is damaged: {}", file.string(), what);
  };
  const auto box = reader.take<Bounds>();
  const auto branching = reader.take<std::int32_t>(), side = reader.take<std::int32_t>();
  std::vector<glm::u16vec3> cells = reader.take_values<glm::u16vec3>();
  TreeVolume volume;
  volume.extinction_per_m = reader.take_values<float>(), volume.colour = reader.take_values<glm::vec3>();
  if (reader.has_ended_early()) return cut_short(file);
  if (const std::string problem = grid_problem(box, branching, side, max_grid_side, cells); !problem.empty())
    return wrong(problem);
  if (volume.extinction_per_m.size() != cells.size() || volume.colour.size() != cells.size())
    return wrong("as many values as cells were expected");
  for (const float tau : volume.extinction_per_m)
    if (!(tau >= 0.0f) || std::isinf(tau)) return wrong("an extinction is no number from 0 on");
  volume.grid = CellGrid(box, branching, side, std::move(cells));
  return volume;
}

BillboardTree as_stored(BillboardTree tree) {
  for (BillboardTextures& view : tree.views)
    put_blocks(view, blocks_of(view, tree.texels_per_side), tree.texels_per_side);
  return tree;
}

Packing packed_disjoint_alphas(const BillboardTree& tree) {
  constexpr std::size_t window = 512;  // textures with room that each is compared with
  Packing packing;
  const std::size_t per_texture = std::size_t(tree.texels_per_side) * std::size_t(tree.texels_per_side);
  using Mask = std::vector<std::uint64_t>;
  for (const BillboardTextures& view : tree.views) {
    std::vector<Mask> open;  // with room for one more texture
    for (std::size_t i = 0; i < view.count(tree.texels_per_side); ++i) {
      Mask mask((per_texture + 63) / 64, 0);
      for (std::size_t k = 0; k < per_texture; ++k)
        if (view.texels[4 * (i * per_texture + k) + 3] > 0) mask[k / 64] |= std::uint64_t(1) << (k % 64);
      ++packing.textures;
      const auto fits = std::ranges::find_if(open, [&](const Mask& other) {
        for (std::size_t w = 0; w < mask.size(); ++w)
          if (mask[w] & other[w]) return false;
        return true;
      });
      if (fits != open.end()) {
        open.erase(fits);
        continue;
      }
      ++packing.packed;
      open.push_back(std::move(mask));
      if (open.size() > window) open.erase(open.begin());
    }
  }
  return packing;
}

}  // namespace parvis::trees
