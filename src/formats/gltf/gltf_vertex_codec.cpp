// The format is that of the appendix "Bitstream" of KHR_meshopt_compression: blocks of up to 256 vertices; of
// each of their bytes a column, packed in groups of 16; four columns make a channel, whose values are
// differences from those of the vertex before.
#include "formats/gltf/gltf_vertex_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

namespace parvis::scene {
namespace {

using ByteView = std::span<const std::uint8_t>;

constexpr std::uint8_t header = 0xa1;
constexpr std::size_t group_size = 16, max_block_bytes = 8192, max_block = 256, min_tail = 24;

/// Takes bytes from the front; beyond the end there are zeros, and `has_failed` is set.
class Input {
 public:
  explicit Input(ByteView bytes) : bytes_(bytes) {}

  bool has_failed() const { return has_failed_; }
  std::size_t left() const { return bytes_.size(); }
  ByteView take(std::size_t count) {
    if (count > bytes_.size()) {
      has_failed_ = true;
      return {};
    }
    const ByteView taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  std::uint8_t take() {
    const ByteView one = take(1);
    return one.empty() ? std::uint8_t(0) : one.front();
  }

 private:
  ByteView bytes_;
  bool has_failed_ = false;
};

/// Sixteen values of `bits` each; the greatest value stands for a byte behind them. Of single bits the lowest
/// comes first, of others the highest.
void take_group(Input& input, int bits, std::uint8_t* to) {
  if (bits == 0) return std::fill_n(to, group_size, std::uint8_t(0)), void();
  const ByteView packed = input.take(group_size * std::size_t(bits) / 8);
  if (packed.empty()) return;
  if (bits == 8) return std::ranges::copy(packed, to), void();
  const unsigned escape = (1u << bits) - 1u, per_byte = 8u / unsigned(bits);
  for (unsigned i = 0; i < group_size; ++i) {
    const unsigned place = i % per_byte, byte = packed[i / per_byte];
    const unsigned shift = bits == 1 ? place : 8u - unsigned(bits) * (place + 1u);
    const unsigned value = (byte >> shift) & escape;
    to[i] = value == escape ? input.take() : std::uint8_t(value);
  }
}

/// A column of a block: `mode` 0 and 1 choose the widths of groups, 2 is all zero, 3 plain bytes.
void take_column(Input& input, unsigned mode, std::size_t count, std::uint8_t* to) {
  constexpr std::array<int, 5> widths{0, 1, 2, 4, 8};
  if (mode == 2) return std::fill_n(to, count, std::uint8_t(0)), void();
  if (mode == 3) return std::ranges::copy(input.take(count), to), void();
  const std::size_t groups = (count + group_size - 1) / group_size;
  const ByteView headers = input.take((groups + 3) / 4);
  for (std::size_t g = 0; g < groups && !input.has_failed(); ++g)
    take_group(input, widths[mode + ((headers[g / 4] >> (g % 4 * 2)) & 3u)], to + g * group_size);
}

/// Adds up the differences of a channel's values of `T`, whose bytes are columns `max_block` apart, into
/// vertices.
template <class T, class Undo>
void add_up(const std::uint8_t* columns, std::size_t count, std::size_t stride, const std::uint8_t* last,
            std::uint8_t* to, const Undo& undo) {
  for (std::size_t part = 0; part < 4; part += sizeof(T)) {
    T before = 0;
    std::memcpy(&before, last + part, sizeof(T));
    for (std::size_t i = 0; i < count; ++i) {
      T value = 0;
      for (std::size_t b = 0; b < sizeof(T); ++b)
        value = T(value | T(T(columns[(part + b) * max_block + i]) << (8 * b)));
      before = undo(value, before);
      std::memcpy(to + i * stride + part, &before, sizeof(T));
    }
  }
}

template <class T>
T plus_zigzag(T value, T before) {
  return T(T(T(value >> 1) ^ T(-T(value & 1))) + before);
}

/// A block of up to `max_block` vertices; `last` is the vertex before it, then its own last one. False where
/// a channel is of no known kind.
bool take_block(Input& input, std::size_t count, std::size_t stride, ByteView channels, std::uint8_t* last,
                std::uint8_t* to) {
  const ByteView modes = input.take(stride / 4);
  std::array<std::uint8_t, 4 * max_block> columns{};
  for (std::size_t k = 0; k < stride && !input.has_failed(); k += 4) {
    for (unsigned j = 0; j < 4 && !input.has_failed(); ++j)
      take_column(input, (modes[k / 4] >> (2 * j)) & 3u, count, columns.data() + j * max_block);
    const unsigned channel = channels[k / 4];
    const int turn = int(channel >> 4);
    if ((channel & 3u) == 0)
      add_up<std::uint8_t>(columns.data(), count, stride, last + k, to + k, plus_zigzag<std::uint8_t>);
    else if ((channel & 3u) == 1)
      add_up<std::uint16_t>(columns.data(), count, stride, last + k, to + k, plus_zigzag<std::uint16_t>);
    else if ((channel & 3u) == 2)
      add_up<std::uint32_t>(
          columns.data(), count, stride, last + k, to + k,
          [turn](std::uint32_t value, std::uint32_t before) { return std::rotr(value, turn) ^ before; });
    else
      return false;
  }
  std::copy_n(to + (count - 1) * stride, stride, last);
  return !input.has_failed();
}

template <class T>
void undo_colours(std::span<std::uint8_t> plain, std::size_t count) {
  using Signed = std::make_signed_t<T>;
  constexpr float max = float(T(~T(0)));
  for (std::size_t i = 0; i < count; ++i) {
    std::array<T, 4> c{};
    std::memcpy(c.data(), plain.data() + i * sizeof c, sizeof c);
    int scale = c[3];  // all bits below the highest of alpha
    for (const int shift : {1, 2, 4, 8}) scale |= scale >> shift;
    const int y = c[0], orange = Signed(c[1]), green = Signed(c[2]);
    const std::array<int, 4> rgba{y + orange - green, y + green, y - orange - green,
                                  ((int(c[3]) << 1) & scale) | (c[3] & 1)};
    for (std::size_t k = 0; k < 4; ++k)
      c[k] = T(std::clamp(float(rgba[k]) * max / float(std::max(scale, 1)) + 0.5f, 0.0f, max));
    std::memcpy(plain.data() + i * sizeof c, c.data(), sizeof c);
  }
}

}  // namespace

bool is_vertex_codec_1(ByteView packed) { return !packed.empty() && packed.front() == header; }

bool decode_vertices_1(ByteView packed, std::size_t count, std::size_t stride,
                       std::span<std::uint8_t> plain) {
  const std::size_t tail = stride + stride / 4, padded_tail = std::max(tail, min_tail);
  if (packed.size() < 1 + padded_tail) return false;
  std::vector<std::uint8_t> last(packed.end() - std::ptrdiff_t(tail), packed.end());
  const ByteView channels = ByteView(packed).last(stride / 4);
  Input input(packed.subspan(1, packed.size() - 1 - padded_tail));
  const std::size_t block = std::min(max_block_bytes / stride / group_size * group_size, max_block);
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t size = std::min(block, count - first);
    if (!take_block(input, size, stride, channels, last.data(), plain.data() + first * stride)) return false;
  }
  return input.left() == 0;
}

void decode_colours(std::span<std::uint8_t> plain, std::size_t count, std::size_t stride) {
  if (stride == 4)
    undo_colours<std::uint8_t>(plain, count);
  else
    undo_colours<std::uint16_t>(plain, count);
}

}  // namespace parvis::scene
