#include "formats/readers/readers.h"

#include <cassert>

namespace parvis::formats {

void Readers::add(std::initializer_list<const char*> extensions, ReadModel read) {
  for (const char* extension : extensions) {
    [[maybe_unused]] const bool is_new = by_extension_.emplace(extension, read).second;
    assert(is_new && "two rooms read files of this extension");
  }
}

Result<scene::Model> Readers::read(const std::filesystem::path& file, const ModelReading& reading,
                                   Errors& warnings) const {
  const std::string extension = file.extension().string();
  const auto reader = by_extension_.find(extension);
  if (reader != by_extension_.end()) return reader->second(file, reading, warnings);
  if (fallback_) return fallback_(file, reading, warnings);
  std::vector<std::string> known;
  for (const auto& [each, read] : by_extension_) known.push_back(each);
  return error_at({file.string(), 0, 0}, "no reader for files of the kind \"{}\"; models are read from {}",
                  extension, fmt::join(known, ", "));
}

}  // namespace parvis::formats
