// Layered pictures as Adobe Photoshop files (PSD), the format that image editors have in common: true layers
// with names, offsets and masks. Format: Adobe Photoshop File Formats Specification, November 2019.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "capture/facades/image_layers.h"

namespace parvis::facades {

struct PsdLayer {
  std::string name;
  PixelBox box;   ///< in the picture; may reach outside it
  Image8 pixels;  ///< RGBA of the box, sRGB, alpha not premultiplied
  Image8 mask;    ///< layer mask of the box, 1 channel; empty: none
  bool is_mask_enabled = false;
  bool is_hidden = false;      ///< itself, or a group that it is in
  std::uint8_t opacity = 255;  ///< with that of the groups that it is in
  std::string blend = "norm";  ///< key of its blend mode, or of a group's that is not normal
  bool is_clipped = false;     ///< to the layer below
  bool is_in_masked_group = false;
};

/// A layered picture as a PSD file holds it.
struct PsdPicture {
  int width = 0, height = 0;
  std::vector<PsdLayer> layers;  ///< bottom first
  int file_bits = 8;             ///< per channel in the file; 16 are rounded to 8 on reading
  Image8 flat;                   ///< what a program without layers shows, RGB; only written
};

/// Sides that a PSD may have.
inline constexpr int max_psd_side = 30000;
/// Bytes of decoded layers that are read at most: a hostile header must not make us allocate the machine's
/// memory.
inline constexpr std::size_t max_psd_bytes = std::size_t(4) << 30;

/// Writes 8 bits per channel, run-length encoded. The file appears whole or not at all. Fails where the
/// picture or a layer is too large for the format.
Status write_psd(const std::filesystem::path& file, const PsdPicture& picture);

/// Reads RGB files of 8 or 16 bits per channel, layers uncompressed, run-length or zip encoded. Groups become
/// what they do to the layers within. A mask without area has the value of its surroundings. Errors name the
/// file, what was found and what to do (another colour mode, PSB, cut short).
Result<PsdPicture> read_psd(const std::filesystem::path& file);
/// The same from memory; `name` stands in errors.
Result<PsdPicture> read_psd(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace parvis::facades
