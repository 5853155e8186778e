// A web address as a QR code, for sheets on which a site is announced.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::plan_drawing {

/// The modules of a QR code (ISO/IEC 18004, error correction M), without the quiet zone.
struct QrCode {
  static constexpr int quiet_modules = 4;  ///< white on each side, which readers need

  std::string link;
  int side = 0;                       ///< modules per side; 0: no code
  std::vector<std::uint8_t> is_dark;  ///< side x side, row by row from the top left

  bool dark(int x, int y) const { return is_dark[std::size_t(y * side + x)] != 0; }
};

/// Errors: not an address that begins with http:// or https://, longer than 300 characters, characters that
/// an address cannot have, a library that cannot be loaded.
Result<QrCode> qr_code(const std::string& link);

/// The code as an SVG picture with its quiet zone, one module per unit.
std::string qr_svg(const QrCode& code);

}  // namespace parvis::plan_drawing
