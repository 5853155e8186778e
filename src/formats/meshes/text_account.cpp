#include "formats/meshes/text_account.h"

#include <fmt/format.h>

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
    const auto continues = [](std::string_view text) {
      return text.ends_with('\\') || text.ends_with("\\\r");
    };
    for (std::string_view next = line; continues(next) && !bytes.empty();) next = next_line(bytes);
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
      if (element == "tristrips")
        account.left_out("elements", "assimp makes one triangle of each strip; export the model with faces",
                         element, count);
      else if (!is_among(element, {"vertex", "face"}))
        account.left_out("elements", "they are not read", element, count);
    }
    if (keyword != "property" || !is_among(element, {"vertex", "face"})) continue;
    std::string_view name;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) name = word;
    const bool is_read =
        element == "face"
            ? is_among(name, {"vertex_index", "vertex_indices", "texcoord", "texnumber"})
            : is_among(
                  name,
                  {"x",           "y",    "z",     "nx",        "ny",        "nz",          "red",
                   "green",       "blue", "alpha", "r",         "g",         "b",           "u",
                   "v",           "s",    "t",     "texture_u", "texture_v", "diffuse_red", "diffuse_green",
                   "diffuse_blue"});
    if (!is_read) account.left_out("properties", "they are not read", fmt::format("{} of {}", name, element));
  }
}

/// Faces of a text whose lines hold more numbers than corners: their colours.
void count_off(std::string_view bytes, FileAccount& account) {
  std::size_t vertices = 0, faces = 0;
  bool has_counts = false;
  while (!bytes.empty()) {
    const std::string_view line = next_line(bytes);
    std::string_view rest = line.substr(0, line.find('#'));
    std::string_view first = next_word(rest);
    if (!has_counts && first.ends_with("OFF")) first = next_word(rest);
    if (first.empty()) continue;
    std::size_t number = 0, words = 0;
    std::from_chars(first.data(), first.data() + first.size(), number);
    if (!has_counts) {
      const std::string_view second = next_word(rest);
      std::from_chars(second.data(), second.data() + second.size(), faces);
      vertices = number, has_counts = true;
      continue;
    }
    if (vertices > 0) {
      --vertices;
      continue;
    }
    if (faces-- == 0) return;
    while (!next_word(rest).empty()) ++words;
    account.left_out("colours of faces", "colours of vertices alone are read", "", words > number ? 1 : 0);
  }
}

/// Facets of a binary file of Magics, which marks own colours by a bit that others set for them.
void count_stl(std::string_view bytes, FileAccount& account) {
  constexpr std::size_t header = 84, facet = 50;
  if (bytes.size() < header || bytes.substr(0, 80).find("COLOR=") == std::string_view::npos) return;
  for (std::size_t at = header; at + facet <= bytes.size(); at += facet)
    if ((static_cast<unsigned char>(bytes[at + facet - 1]) & 0x80) == 0)
      account.left_out("colours of facets", "of this program that of the whole is read");
}

}  // namespace

std::string with_known_names(std::string_view bytes, std::string_view extension) {
  const std::size_t end = extension == ".ply" ? bytes.find("end_header") : std::string_view::npos;
  constexpr std::string_view prefix = " diffuse_";
  if (end == std::string_view::npos || bytes.substr(0, end).find(prefix) == std::string_view::npos) return "";
  std::string header(bytes.substr(0, end));
  for (std::size_t at = header.find(prefix); at != std::string::npos; at = header.find(prefix, at))
    header.replace(at, prefix.size(), " ");
  return header + std::string(bytes.substr(end));
}

void count_what_assimp_drops(std::string_view bytes, const std::filesystem::path& file,
                             std::string_view extension, FileAccount& account) {
  if (extension == ".obj") count_obj(bytes, file, account);
  if (extension == ".ply") count_ply(bytes, account);
  if (extension == ".off") count_off(bytes, account);
  if (extension == ".stl") count_stl(bytes, account);
}

}  // namespace parvis::scene
