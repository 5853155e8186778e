// Version 1 of meshoptimizer's vertex codec and its filter for colours (KHR_meshopt_compression), which
// gltfpack writes since 1.0 and the packaged library, 0.18, does not know.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace parvis::scene {

/// Whether the first byte says that this codec has written the rest.
bool is_vertex_codec_1(std::span<const std::uint8_t> packed);

/// Writes `count` vertices of `stride` bytes (a multiple of 4, up to 256) to the front of `plain`, which is
/// as long at least. False where the bytes are damaged, too few or too many.
bool decode_vertices_1(std::span<const std::uint8_t> packed, std::size_t count, std::size_t stride,
                       std::span<std::uint8_t> plain);

/// Undoes the filter COLOR, in place: luma, orange and green chroma and alpha of 8 or 16 bits become RGBA.
/// `stride` is 4 or 8.
void decode_colours(std::span<std::uint8_t> plain, std::size_t count, std::size_t stride);

}  // namespace parvis::scene
