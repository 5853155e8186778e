#include "planning/plan_drawing/qrencode_module.h"

#include <qrencode.h>

#include <memory>

namespace parvis::plan_drawing {
namespace {

Result<QrCode> encoded(const std::string& link) {
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> made(
      QRcode_encodeString8bit(link.c_str(), 0, QR_ECLEVEL_M), &QRcode_free);
  if (!made) return error("the address cannot be drawn as a QR code");
  QrCode code{link, made->width, {}};
  for (int i = 0; i < code.side * code.side; ++i)
    code.is_dark.push_back(made->data[i] & 1u);  // the other bits say what a module is for
  return code;
}

}  // namespace
}  // namespace parvis::plan_drawing

PARVIS_MODULE(parvis::plan_drawing::QrencodeFunctions){parvis::plan_drawing::encoded};
