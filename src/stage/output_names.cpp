#include "stage/output_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/content_hash.h"

namespace parvis::stage {
namespace {
namespace fs = std::filesystem;

/// A name as it stands in the name of a file; letters beyond ASCII stay as they are.
std::string file_part(std::string name) {
  for (char& c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           static_cast<unsigned char>(c) >= 0x80;
    if (c == '/') c = '-';
    if (!is_letter && c != '-' && c != '.') c = '_';
  }
  return name;
}

/// `name` and `ending`, cut to what a file system takes.
std::string fitting(const std::string& name, std::string_view ending) {
  constexpr std::size_t max_name = 255;
  if (name.size() + ending.size() <= max_name) return name + std::string(ending);
  ContentHash hash;
  hash.add_text(name);
  const std::string cut = fmt::format("-{:016x}{}", hash.value(), ending);
  return name.substr(0, max_name - std::min(cut.size(), max_name)) + cut;
}

}  // namespace

std::vector<fs::path> series_files(const fs::path& output, char joint,
                                   const std::vector<std::string>& names) {
  std::set<std::string> taken;
  std::vector<std::string> parts(names.size());
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (file_part(names[i]) == names[i] && taken.insert(names[i]).second)
      parts[i] = names[i];
    else
      others.push_back(i);
  std::map<std::string, int> numbers;  // the last that a part has
  for (const std::size_t i : others) {
    const std::string part = parts[i] = file_part(names[i]);
    int& number = numbers.try_emplace(part, 1).first->second;
    while (!taken.insert(parts[i]).second) parts[i] = fmt::format("{}-{}", part, ++number);
  }
  std::vector<fs::path> files;
  files.reserve(parts.size());
  for (const std::string& part : parts) {
    const std::string name = output.stem().string() + joint + part;
    files.push_back(fs::path(output).replace_filename(fitting(name, output.extension().string())));
  }
  return files;
}

Status check_different(const std::vector<fs::path>& files) {
  std::set<fs::path> known;
  for (const fs::path& file : files)
    if (!known.insert(file.lexically_normal()).second)
      return error("{}: two files of this command would be this one; give each a name of its own",
                   file.string());
  return Ok{};
}

fs::path file_beside(const fs::path& file, std::string_view ending) {
  return fs::path(file).replace_filename(fitting(file.filename().string(), ending));
}

}  // namespace parvis::stage
