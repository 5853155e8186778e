#include "formats/drawings/dxf_writer.h"

#include <cctype>

#include "base/files.h"
#include "formats/drawings/dxf_module.h"

namespace parvis::formats {

std::string dxf_name(const std::string& name) {
  // Accents of western Europe, by their letters: readers disagree on the encoding of names.
  static constexpr std::pair<std::string_view, std::string_view> letters[]{
      {"àâäáãå", "a"}, {"ÀÂÄÁÃÅ", "A"}, {"éèêë", "e"}, {"ÉÈÊË", "E"}, {"îïíì", "i"}, {"ÎÏÍÌ", "I"},
      {"ôöóòõ", "o"},  {"ÔÖÓÒÕ", "O"},  {"ùûüú", "u"}, {"ÙÛÜÚ", "U"}, {"ç", "c"},    {"Ç", "C"},
      {"ñ", "n"},      {"Ñ", "N"},      {"œ", "oe"},   {"Œ", "OE"},   {"ß", "ss"}};
  std::string plain;
  for (std::size_t i = 0; i < name.size();) {
    const bool is_two = (static_cast<unsigned char>(name[i]) & 0xe0) == 0xc0 && i + 1 < name.size();
    const std::string_view one(name.data() + i, is_two ? 2 : 1);
    i += one.size();
    std::string_view letter = one;
    if (is_two) {
      letter = "_";
      for (const auto& [accented, without] : letters)
        if (accented.find(one) != std::string_view::npos) letter = without;
    } else if (!std::isalnum(static_cast<unsigned char>(one[0])) && one[0] != '-') {
      letter = "_";
    }
    plain += letter;
  }
  return plain.empty() ? "0" : plain;
}

Status write_dxf(const std::filesystem::path& file, const DxfPlan& plan) {
  const Result<std::string> bytes = dxf.call(&DxfFunctions::write, plan);
  // A full disk is noticed by this, and not by GDAL.
  return bytes ? write_file(file, *bytes) : Status(bytes.errors());
}

}  // namespace parvis::formats
