#include "planning/plan_drawing/qr_code.h"

#include <algorithm>

#include "planning/plan_drawing/qrencode_module.h"

namespace parvis::plan_drawing {
namespace {

constexpr std::size_t max_link = 300;  // beyond it modules in print become too small to be read

bool may_stand_in_an_address(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte > 0x20 && byte < 0x7f && c != '"' && c != '<' && c != '>';
}

}  // namespace

Result<QrCode> qr_code(const std::string& link) {
  if (!link.starts_with("https://") && !link.starts_with("http://"))
    return error("--link \"{}\": expected an address that begins with https:// or http://",
                 link.substr(0, 40));
  if (link.size() > max_link)
    return error("--link: the address has {} characters; at most {} can be read in print", link.size(),
                 max_link);
  if (!std::ranges::all_of(link, may_stand_in_an_address))
    return error(
        "--link: an address has no blanks, quotes, angle brackets or letters beyond ASCII; write "
        "them as %20 and so on");
  return qrencode.call(&QrencodeFunctions::qr_code, link);
}

std::string qr_svg(const QrCode& code) {
  const int side = code.side + 2 * QrCode::quiet_modules;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {0}\" shape-rendering=\"crispEdges\">\n"
      "<rect width=\"{0}\" height=\"{0}\" fill=\"#fff\"/>\n<path d=\"",
      side);
  for (int y = 0; y < code.side; ++y)
    for (int x = 0; x < code.side; ++x)
      if (code.dark(x, y))
        svg += fmt::format("M{} {}h1v1h-1z", x + QrCode::quiet_modules, y + QrCode::quiet_modules);
  return svg + "\"/>\n</svg>\n";
}

}  // namespace parvis::plan_drawing
