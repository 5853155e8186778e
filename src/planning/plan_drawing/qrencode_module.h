// The module `qrencode`: what of this room knows libqrencode.
#pragma once

#include "base/module.h"
#include "planning/plan_drawing/qr_code.h"

namespace parvis::plan_drawing {

/// The function of libqrencode that this room needs.
struct QrencodeFunctions {
  Result<QrCode> (*qr_code)(const std::string& link);
};

/// Loaded where a sheet or a site has an address.
inline constexpr Module<QrencodeFunctions> qrencode("qrencode");

}  // namespace parvis::plan_drawing
