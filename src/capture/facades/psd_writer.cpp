#include <algorithm>
#include <filesystem>
#include <span>

#include "base/files.h"
#include "capture/facades/psd.h"

namespace parvis::facades {
namespace {

/// Big-endian numbers into bytes.
class Bytes {
 public:
  std::string text;

  void u8(unsigned v) { text.push_back(char(v)); }
  void u16(unsigned v) { u8(v >> 8 & 255), u8(v & 255); }
  void u32(std::uint32_t v) { u16(v >> 16), u16(v & 65535); }
  void raw(std::string_view bytes) { text.append(bytes); }
  /// A section behind its length, padded to a multiple of `multiple`.
  void section(Bytes content, std::size_t multiple = 1) {
    while (content.text.size() % multiple) content.u8(0);
    u32(std::uint32_t(content.text.size()));
    raw(content.text);
  }
};

/// PackBits: runs of equal bytes as (1 - length, byte), others as (length - 1, bytes).
std::string packed(std::span<const std::uint8_t> row) {
  std::string out;
  for (std::size_t i = 0; i < row.size();) {
    std::size_t run = 1;
    while (i + run < row.size() && run < 128 && row[i + run] == row[i]) ++run;
    if (run >= 2) {
      out.push_back(char(257 - run)), out.push_back(char(row[i]));
      i += run;
      continue;
    }
    const std::size_t start = i++;
    while (i < row.size() && i - start < 128 &&
           !(i + 2 < row.size() && row[i] == row[i + 1] && row[i] == row[i + 2]))
      ++i;
    out.push_back(char(i - start - 1));
    out.append(reinterpret_cast<const char*>(row.data() + start), i - start);
  }
  return out;
}

std::vector<std::uint8_t> row_of(const Image8& image, int channel, int y) {
  std::vector<std::uint8_t> row(std::size_t(image.width));
  for (int x = 0; x < image.width; ++x) row[std::size_t(x)] = image.at(x, y)[channel];
  return row;
}

/// A channel run-length encoded: the rows' lengths, then the rows.
void append_channel(Bytes& lengths, Bytes& rows, const Image8& image, int channel) {
  for (int y = 0; y < image.height; ++y) {
    const std::string row = packed(row_of(image, channel, y));
    lengths.u16(unsigned(row.size()));
    rows.raw(row);
  }
}

std::string encoded_channel(const Image8& image, int channel) {
  Bytes all, rows;
  all.u16(1);
  append_channel(all, rows, image, channel);
  return all.text + rows.text;
}

void rectangle(Bytes& bytes, const PixelBox& box) {
  for (const int v : {box.y, box.x, box.y + box.height, box.x + box.width}) bytes.u32(std::uint32_t(v));
}

/// UTF-16 of a text in UTF-8; bytes that are none, or need two units, become U+FFFD.
std::u16string utf16(std::string_view text) {
  std::u16string units;
  for (std::size_t i = 0; i < text.size();) {
    const unsigned first = static_cast<unsigned char>(text[i++]);
    const int more = first < 0x80 ? 0 : first < 0xc0 ? -1 : first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
    unsigned code = more <= 0 ? first : first & (0x3fu >> more);
    int left = more;
    for (; left > 0 && i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; --left)
      code = code << 6 | (static_cast<unsigned char>(text[i++]) & 0x3fu);
    units.push_back(left == 0 && code < 0x10000 ? char16_t(code) : u'\ufffd');
  }
  return units;
}

Bytes extra_data(const PsdLayer& layer) {
  Bytes extra, mask;
  if (!layer.mask.empty()) {
    rectangle(mask, layer.box);
    mask.u8(0);                              // outside of it
    mask.u8(layer.is_mask_enabled ? 0 : 2);  // bit 1: disabled
    mask.u16(0);
  }
  extra.section(mask);
  extra.u32(0);  // blending ranges: the default
  const std::string name = layer.name.substr(0, 255);
  Bytes pascal;
  pascal.u8(unsigned(name.size()));
  pascal.raw(name);
  while (pascal.text.size() % 4) pascal.u8(0);
  extra.raw(pascal.text);
  extra.raw("8BIMluni");  // the name once more as UTF-16, which editors prefer
  Bytes unicode;
  const std::u16string units = utf16(layer.name);
  unicode.u32(std::uint32_t(units.size()));
  for (const char16_t unit : units) unicode.u16(unit);
  extra.section(unicode, 4);
  return extra;
}

Bytes layer_section(const PsdPicture& picture) {
  Bytes records, data;
  records.u16(unsigned(picture.layers.size()));
  for (const PsdLayer& layer : picture.layers) {
    rectangle(records, layer.box);
    std::vector<std::pair<int, std::string>> channels;
    for (const auto& [id, channel] : {std::pair(-1, 3), std::pair(0, 0), std::pair(1, 1), std::pair(2, 2)})
      channels.emplace_back(id, encoded_channel(layer.pixels, channel));
    if (!layer.mask.empty()) channels.emplace_back(-2, encoded_channel(layer.mask, 0));
    records.u16(unsigned(channels.size()));
    for (const auto& [id, encoded] : channels) {
      records.u16(unsigned(id) & 65535u);
      records.u32(std::uint32_t(encoded.size()));
      data.raw(encoded);
    }
    records.raw("8BIMnorm");
    records.u8(layer.opacity);
    records.u8(0);                        // clipping: base
    records.u8(layer.is_hidden ? 2 : 0);  // flags
    records.u8(0);
    records.section(extra_data(layer));
  }
  Bytes info;
  info.section(Bytes{records.text + data.text}, 2);
  info.u32(0);  // no global mask
  return info;
}

Status check_sizes(const PsdPicture& picture, const std::string& name) {
  if (picture.width < 1 || picture.height < 1 || picture.width > max_psd_side ||
      picture.height > max_psd_side)
    return error("{}: a PSD is 1 to {} pixels wide and high, not {} x {}", name, max_psd_side, picture.width,
                 picture.height);
  if (picture.layers.size() > 8000)
    return error("{}: {} layers; image editors open at most 8000; merge objects of the model", name,
                 picture.layers.size());
  std::size_t bytes = 0;
  for (const PsdLayer& layer : picture.layers) bytes += layer.pixels.pixels.size() + layer.mask.pixels.size();
  if (bytes > std::size_t(2'000'000'000))
    return error("{}: the layers have {} million bytes, a PSD holds 2000; use a smaller photograph", name,
                 bytes / 1'000'000);
  return Ok{};
}

}  // namespace

Status write_psd(const std::filesystem::path& file, const PsdPicture& picture) {
  if (const Status sound = check_sizes(picture, file.string()); !sound) return sound;
  Bytes all;
  all.raw("8BPS");
  all.u16(1);
  for (int i = 0; i < 6; ++i) all.u8(0);
  all.u16(3);
  all.u32(std::uint32_t(picture.height)), all.u32(std::uint32_t(picture.width));
  all.u16(8), all.u16(3);  // bits, RGB
  all.u32(0), all.u32(0);  // colour table, resources
  all.section(layer_section(picture));
  Bytes lengths, rows;
  const Image8& flat = picture.flat;
  const Image8 black = flat.empty() ? Image8(picture.width, picture.height, 3) : Image8();
  all.u16(1);
  for (int channel = 0; channel < 3; ++channel)
    append_channel(lengths, rows, flat.empty() ? black : flat, channel);
  all.raw(lengths.text), all.raw(rows.text);
  return write_file(file, all.text);
}

}  // namespace parvis::facades
