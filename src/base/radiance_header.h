// What the header of a Radiance picture (.hdr) says beside its size: the OpenImageIO that reads it leaves all
// of it out.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace parvis {

/// How the pixels of a Radiance picture become radiance, and where they stand.
struct RadianceHeader {
  std::array<float, 3> scale{1.0f, 1.0f,
                             1.0f};  ///< of red, green, blue: 1 by all EXPOSURE and COLORCORR lines
  bool is_transposed = false;        ///< lines of the file are columns
  bool starts_right = false, starts_below = false;

  bool moves_pixels() const { return is_transposed || starts_right || starts_below; }
};

/// Reads the header at the front of a file; lines that are damaged count for nothing.
RadianceHeader radiance_header(std::span<const std::uint8_t> bytes);

}  // namespace parvis
