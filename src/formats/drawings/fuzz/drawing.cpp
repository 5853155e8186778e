// Any bytes as the group codes of a DXF file, and what is read of them without GDAL.
#include <cstdint>

#include "formats/drawings/drawing_facts.h"
#include "formats/drawings/drawing_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  parvis::Result<parvis::formats::GroupCodes> codes = parvis::formats::group_codes(bytes, "input.dxf");
  if (!codes) return 0;
  parvis::Errors warnings;
  parvis::formats::decode_texts(*codes, parvis::formats::code_page_of(*codes), "input.dxf", warnings);
  (void)parvis::formats::drawing_facts(*codes);
  (void)parvis::formats::as_text(*codes);
  return 0;
}
