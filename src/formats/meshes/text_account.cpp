#include "formats/meshes/text_account.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <string>

#include "base/files.h"

namespace parvis::scene {
namespace {

constexpr std::string_view blank_letters = " \t\r";

std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blank_letters), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blank_letters));
  line.remove_prefix(word.size());
  return word;
}

std::string_view next_line(std::string_view& bytes) {
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
  return line;
}

bool is_among(std::string_view word, std::initializer_list<std::string_view> known) {
  return std::ranges::find(known, word) != known.end();
}

void count_obj(std::string_view bytes, const std::filesystem::path& file, FileAccount& account) {
  while (!bytes.empty()) {
    std::string_view line = next_line(bytes);
    const std::string_view keyword = next_word(line);
    if (keyword.empty() || keyword.starts_with('#') ||
        is_among(keyword, {"v", "vt", "vn", "f", "o", "g", "s", "usemtl", "l", "p"}))
      continue;
    if (keyword != "mtllib") {
      account.left_out("statements", "they are not read", keyword);
      continue;
    }
    line.remove_prefix(std::min(line.find_first_not_of(blank_letters), line.size()));
    const std::string name(line.substr(0, line.find_last_not_of(blank_letters) + 1));
    std::error_code code;
    const Result<std::filesystem::path> library = Roots(file.parent_path()).find(name, {});
    if (!library || !std::filesystem::is_regular_file(*library, code))
      account.left_out("material libraries", "there is no such file beside the model", name);
  }
}

void count_ply(std::string_view bytes, FileAccount& account) {
  constexpr std::size_t max_header_bytes = 65536;
  bytes = bytes.substr(0, max_header_bytes);
  std::string_view element;
  std::size_t count = 0;
  while (!bytes.empty()) {
    std::string_view line = next_line(bytes);
    const std::string_view keyword = next_word(line);
    if (keyword == "end_header") return;
    if (keyword == "element") {
      element = next_word(line);
      const std::string_view number = next_word(line);
      count = 0;
      std::from_chars(number.data(), number.data() + number.size(), count);
      if (!is_among(element, {"vertex", "face", "tristrips"}))
        account.left_out("elements", "they are not read", element, count);
    }
    if (keyword != "property" || !is_among(element, {"vertex", "face"})) continue;
    std::string_view name;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) name = word;
    if (!is_among(name, {"x",
                         "y",
                         "z",
                         "nx",
                         "ny",
                         "nz",
                         "red",
                         "green",
                         "blue",
                         "alpha",
                         "diffuse_red",
                         "diffuse_green",
                         "diffuse_blue",
                         "r",
                         "g",
                         "b",
                         "u",
                         "v",
                         "s",
                         "t",
                         "texture_u",
                         "texture_v",
                         "vertex_index",
                         "vertex_indices",
                         "texcoord",
                         "texnumber"}))
      account.left_out("properties", "they are not read", name);
  }
}

}  // namespace

void count_what_assimp_drops(std::string_view bytes, const std::filesystem::path& file,
                             std::string_view extension, FileAccount& account) {
  if (extension == ".obj") count_obj(bytes, file, account);
  if (extension == ".ply") count_ply(bytes, account);
}

}  // namespace parvis::scene
