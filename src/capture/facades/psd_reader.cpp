#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <ranges>
#include <span>

#include "base/files.h"
#include "base/memory_budget.h"
#include "capture/facades/psd.h"

namespace parvis::facades {
namespace {

constexpr std::size_t max_psd_file_bytes = std::size_t(2) << 30;  ///< the format's own limit

/// Big-endian numbers off a span. What lies beyond the end is zero, and noted.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::span<const std::uint8_t> take(std::size_t size) {
    if (size > bytes_.size()) has_ended_early_ = true, size = bytes_.size();
    const auto part = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return part;
  }
  unsigned u8() {
    const auto part = take(1);
    return part.empty() ? 0 : part[0];
  }
  unsigned u16() {
    const unsigned high = u8();
    return high << 8 | u8();
  }
  std::uint32_t u32() {
    const std::uint32_t high = u16();
    return high << 16 | u16();
  }
  int i16() { return std::int16_t(u16()); }
  int i32() { return std::int32_t(u32()); }
  std::string text(std::size_t size) {
    const auto part = take(size);
    return {part.begin(), part.end()};
  }
  Reader section(std::size_t size) { return Reader(take(size)); }
  bool has_ended_early() const { return has_ended_early_; }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  bool has_ended_early_ = false;
};

struct ChannelRecord {
  int id = 0;
  std::size_t size = 0;
};
struct LayerRecord {
  PsdLayer layer;
  PixelBox mask_box;
  std::uint8_t mask_outside = 0;
  bool has_mask = false;
  std::vector<ChannelRecord> channels;
  std::uint32_t section = 0;  ///< 0: a layer; 1, 2: a group, above its layers; 3: its end, below them
};

/// A rectangle (top, left, bottom, right), or nothing where it cannot be one.
bool read_box(Reader& reader, PixelBox& box) {
  const std::int64_t top = reader.i32(), left = reader.i32(), bottom = reader.i32(), right = reader.i32();
  const std::int64_t limit = 4 * std::int64_t(max_psd_side);
  if (std::max({std::abs(top), std::abs(left), std::abs(bottom), std::abs(right)}) > limit) return false;
  if (bottom < top || right < left || bottom - top > max_psd_side || right - left > max_psd_side)
    return false;
  box = {int(left), int(top), int(right - left), int(bottom - top)};
  return true;
}

void append_utf8(std::string& text, unsigned unit) {
  if (unit < 0x80)
    text.push_back(char(unit));
  else if (unit < 0x800)
    text.push_back(char(0xc0 | unit >> 6)), text.push_back(char(0x80 | (unit & 63)));
  else
    text.push_back(char(0xe0 | unit >> 12)), text.push_back(char(0x80 | (unit >> 6 & 63))),
        text.push_back(char(0x80 | (unit & 63)));
}

std::string unicode_name(Reader block) {
  std::string name;
  std::uint32_t count = block.u32();
  for (; count && block.left() >= 2; --count)
    if (const unsigned unit = block.u16()) append_utf8(name, unit);
  return name;
}

bool read_extra(Reader extra, LayerRecord& record) {
  Reader mask = extra.section(extra.u32());
  if (mask.left() >= 18) {
    if (!read_box(mask, record.mask_box)) return false;
    record.has_mask = true;
    record.mask_outside = std::uint8_t(mask.u8());
    record.layer.is_mask_enabled = !(mask.u8() & 2);
  }
  extra.take(extra.u32());  // blending ranges
  const std::size_t name_size = extra.u8();
  record.layer.name = extra.text(name_size);
  extra.take((4 - (name_size + 1) % 4) % 4);
  while (extra.left() >= 12) {
    extra.take(4);
    const std::string key = extra.text(4);
    Reader block = extra.section(extra.u32());
    if (key == "luni") record.layer.name = unicode_name(block);
    if (key == "lsct") record.section = block.u32();
  }
  return true;
}

Status read_record(Reader& reader, LayerRecord& record, const std::string& name, int number) {
  const bool has_box = read_box(reader, record.layer.box);
  const unsigned channels = reader.u16();
  if (!has_box || channels > 56)
    return error("{}: layer {} has an impossible rectangle or number of channels; the file is damaged", name,
                 number);
  for (unsigned c = 0; c < channels; ++c) {
    const int id = reader.i16();
    record.channels.push_back({id, reader.u32()});
  }
  reader.take(4);
  record.layer.blend = reader.text(4);
  record.layer.opacity = std::uint8_t(reader.u8());
  record.layer.is_clipped = reader.u8() != 0;
  record.layer.is_hidden = reader.u8() & 2;
  reader.take(1);
  if (!read_extra(reader.section(reader.u32()), record))
    return error("{}: layer {} has a mask with an impossible rectangle; the file is damaged", name, number);
  return Ok{};
}

/// `size` bytes of a PackBits row; false where it holds fewer or more.
bool unpack(std::span<const std::uint8_t> packed, std::uint8_t* out, std::size_t size) {
  std::size_t written = 0;
  for (std::size_t i = 0; i < packed.size();) {
    const int byte = packed[i++], count = byte < 128 ? byte : byte - 256;
    if (count == -128) continue;
    const std::size_t length = std::size_t(count < 0 ? 1 - count : 1 + count);
    if (written + length > size || i + (count < 0 ? 1 : length) > packed.size()) return false;
    if (count < 0)
      std::fill_n(out + written, length, packed[i]), ++i;
    else
      std::copy_n(packed.data() + i, length, out + written), i += length;
    written += length;
  }
  return written == size;
}

bool inflated(std::span<const std::uint8_t> data, std::vector<std::uint8_t>& out) {
  uLongf size = uLongf(out.size());
  return uncompress(out.data(), &size, data.data(), uLong(data.size())) == Z_OK && size == out.size();
}

/// Undoes zip's prediction: differences along each row, of bytes or of big-endian 16-bit values.
void add_up(std::vector<std::uint8_t>& samples, int width, int bytes_per_sample) {
  const std::size_t row = std::size_t(width) * std::size_t(bytes_per_sample);
  for (std::size_t start = 0; start < samples.size(); start += row)
    for (std::size_t x = 1; x < std::size_t(width); ++x) {
      std::uint8_t* at = samples.data() + start + x * std::size_t(bytes_per_sample);
      if (bytes_per_sample == 1) {
        at[0] = std::uint8_t(at[0] + at[-1]);
      } else {
        const unsigned sum = (unsigned(at[0]) << 8 | at[1]) + (unsigned(at[-2]) << 8 | at[-1]);
        at[0] = std::uint8_t(sum >> 8), at[1] = std::uint8_t(sum);
      }
    }
}

/// Decodes a channel into `channel` of `image`. False where its data are damaged.
bool read_channel(Reader data, int bits, Image8& image, int channel) {
  const std::size_t sample = std::size_t(bits / 8), row_bytes = std::size_t(image.width) * sample;
  std::vector<std::uint8_t> samples(row_bytes * std::size_t(image.height));
  const unsigned compression = data.u16();
  if (samples.empty()) return true;
  if (compression == 0) {
    const auto raw = data.take(samples.size());
    if (raw.size() != samples.size()) return false;
    std::ranges::copy(raw, samples.begin());
  } else if (compression == 1) {
    std::vector<std::size_t> lengths(std::size_t(image.height));
    for (std::size_t& length : lengths) length = data.u16();
    for (int y = 0; y < image.height; ++y)
      if (!unpack(data.take(lengths[std::size_t(y)]), samples.data() + std::size_t(y) * row_bytes, row_bytes))
        return false;
  } else if (compression == 2 || compression == 3) {
    if (!inflated(data.take(data.left()), samples)) return false;
    if (compression == 3) add_up(samples, image.width, int(sample));
  } else {
    return false;
  }
  for (std::size_t i = 0; i < samples.size() / sample; ++i) {
    const unsigned value = sample == 1 ? samples[i] : (unsigned(samples[2 * i]) << 8 | samples[2 * i + 1]);
    image.pixels[i * std::size_t(image.channels) + std::size_t(channel)] =
        std::uint8_t(sample == 1 ? value : (value + 128) / 257);
  }
  return !data.has_ended_early();
}

Status read_pixels(Reader& reader, LayerRecord& record, int bits, std::size_t& budget,
                   const std::string& name) {
  PsdLayer& layer = record.layer;
  const auto claim = [&](const PixelBox& box, std::size_t channels) -> Status {
    const std::size_t bytes =
        std::size_t(box.width) * std::size_t(box.height) * (channels + std::size_t(bits) / 8);
    if (bytes > budget)
      return error("{}: layer \"{}\" is too large: the layers have more than {} million bytes", name,
                   layer.name, max_psd_bytes / 1'000'000);
    budget -= bytes;
    return check_memory(
        bytes, fmt::format("{}: layer \"{}\" of {} x {} pixels", name, layer.name, box.width, box.height));
  };
  // Packed data grow 64 times at most, zipped ones about 1000 times: a box that its bytes cannot fill is
  // never allocated.
  std::size_t bytes = 0;
  for (const ChannelRecord& channel : record.channels) bytes += channel.size;
  const std::size_t samples = std::size_t(layer.box.width) * std::size_t(layer.box.height);
  if (bytes > reader.left() || samples > 1100 * bytes)
    return error("{}: layer \"{}\" is cut short or too large; the file is damaged", name, layer.name);
  if (Status status = claim(layer.box, 4); !status) return status;
  layer.pixels = Image8(layer.box.width, layer.box.height, 4, 255);
  for (const ChannelRecord& channel : record.channels) {
    Reader data = reader.section(channel.size);
    bool is_sound = true;
    if (channel.id >= -1 && channel.id <= 2) {
      is_sound = read_channel(data, bits, layer.pixels, channel.id < 0 ? 3 : channel.id);
    } else if (channel.id == -2 && !record.mask_box.empty()) {
      if (std::size_t(record.mask_box.width) * std::size_t(record.mask_box.height) > 1100 * channel.size)
        return error("{}: the mask of layer \"{}\" is too large; the file is damaged", name, layer.name);
      if (Status status = claim(record.mask_box, 1); !status) return status;
      if (Status status = claim(layer.box, 1); !status) return status;  // the mask of the whole layer
      Image8 mask(record.mask_box.width, record.mask_box.height, 1);
      is_sound = read_channel(data, bits, mask, 0);
      layer.mask = Image8(layer.box.width, layer.box.height, 1, record.mask_outside);
      for (int y = 0; y < layer.box.height; ++y)
        for (int x = 0; x < layer.box.width; ++x)
          if (record.mask_box.contains(x + layer.box.x, y + layer.box.y))
            *layer.mask.at(x, y) =
                *mask.at(x + layer.box.x - record.mask_box.x, y + layer.box.y - record.mask_box.y);
    }
    if (!is_sound) return error("{}: a channel of layer \"{}\" is cut short or damaged", name, layer.name);
  }
  if (record.has_mask && record.mask_box.empty()) {  // it hides all, or nothing
    if (Status status = claim(layer.box, 1); !status) return status;
    layer.mask = Image8(layer.box.width, layer.box.height, 1, record.mask_outside);
  }
  return Ok{};
}

/// Applies to each layer the groups around it. `records`: bottom first, a group's end below its layers.
void apply_groups(std::vector<LayerRecord>& records) {
  std::vector<PsdLayer> around{PsdLayer{}};
  for (LayerRecord& record : std::views::reverse(records)) {
    if (record.section == 3) {
      if (around.size() > 1) around.pop_back();
      continue;
    }
    PsdLayer& layer = record.layer;
    const PsdLayer& group = around.back();
    layer.is_hidden = layer.is_hidden || group.is_hidden;
    layer.opacity = std::uint8_t((layer.opacity * group.opacity + 127) / 255);
    layer.is_in_masked_group = group.is_in_masked_group;
    if (layer.blend == "norm" || layer.blend == "pass") layer.blend = group.blend;
    if (record.section == 0) continue;
    around.push_back(layer);
    around.back().is_in_masked_group |= record.has_mask && layer.is_mask_enabled;
  }
}

Status read_layers(Reader reader, PsdPicture& picture, const std::string& name) {
  const int count = std::abs(reader.i16());
  std::vector<LayerRecord> records;
  for (int i = 0; i < count; ++i) {
    records.emplace_back();
    if (const Status read = read_record(reader, records.back(), name, i + 1); !read) return read;
    if (reader.has_ended_early()) return error("{}: cut short after {} of {} layers", name, i, count);
  }
  apply_groups(records);
  std::size_t budget = max_psd_bytes;
  for (LayerRecord& record : records) {
    if (const Status read = read_pixels(reader, record, picture.file_bits, budget, name); !read) return read;
    if (record.section == 0) picture.layers.push_back(std::move(record.layer));
  }
  return Ok{};
}

/// The layers of a 16-bit file lie in a block behind the empty ordinary section.
Reader layers_of(Reader section) {
  Reader layers = section.section(section.u32());
  if (layers.left() >= 2) return layers;
  section.take(section.u32());  // global mask
  while (section.left() >= 12) {
    section.take(4);
    const std::string key = section.text(4);
    const std::size_t size = section.u32();
    Reader block = section.section(size);
    section.take((4 - size % 4) % 4);
    if (key == "Lr16") return block;
  }
  return layers;
}

}  // namespace

Result<PsdPicture> read_psd(std::span<const std::uint8_t> bytes, const std::string& name) {
  Reader reader(bytes);
  if (reader.text(4) != "8BPS")
    return error("{}: not a PSD file; save the picture as Photoshop image (.psd)", name);
  if (const unsigned version = reader.u16(); version != 1)
    return error("{}: a PSB file (version {}); save it as PSD, which holds pictures up to {} pixels wide",
                 name, version, max_psd_side);
  reader.take(6 + 2);
  PsdPicture picture;
  const std::uint32_t height = reader.u32(), width = reader.u32();
  picture.file_bits = int(reader.u16());
  const unsigned mode = reader.u16();
  if (reader.has_ended_early()) return error("{}: cut short in its header", name);
  if (width < 1 || height < 1 || width > unsigned(max_psd_side) || height > unsigned(max_psd_side))
    return error("{}: {} x {} pixels; expected 1 to {}", name, width, height, max_psd_side);
  picture.width = int(width), picture.height = int(height);
  if (picture.file_bits != 8 && picture.file_bits != 16)
    return error("{}: {} bits per channel; expected 8 or 16; convert it in the image editor", name,
                 picture.file_bits);
  if (mode != 3) return error("{}: colour mode {}; expected RGB; convert it in the image editor", name, mode);
  reader.take(reader.u32());  // colour table
  reader.take(reader.u32());  // resources
  const std::size_t size = reader.u32();
  if (reader.has_ended_early() || size > reader.left())
    return error("{}: cut short before the end of its layers", name);
  const Reader layers = layers_of(reader.section(size));
  if (layers.left() < 2) return error("{}: has no layers; was it flattened? Save it with its layers", name);
  if (const Status read = read_layers(layers, picture, name); !read) return read.errors();
  return picture;
}

Result<PsdPicture> read_psd(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) return error("{}: no such file", file.string());
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  if (size > max_psd_file_bytes)
    return error("{}: {} million bytes; a PSD has at most {} million", file.string(), size / 1'000'000,
                 max_psd_file_bytes / 1'000'000);
  if (Status status = check_memory(size, file.string()); !status) return status.errors();
  const Result<std::string> text = read_file(file, max_psd_file_bytes);
  if (!text) return text.errors();
  return read_psd({reinterpret_cast<const std::uint8_t*>(text->data()), text->size()}, file.string());
}

}  // namespace parvis::facades
