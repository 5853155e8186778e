#include "formats/readers/readers.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>

#include "base/file_front.h"
#include "base/utf8.h"
#include "formats/readers/packed_file.h"

namespace parvis::formats {
namespace {

constexpr std::size_t front_bytes = 4096;

/// The first bytes of packed files, as towns publish them, and the command that unpacks them.
struct Archive {
  std::string_view begins;
  const char* unpack;
};
constexpr std::array<Archive, 6> archives{{{"\x1f\x8b", "gunzip -k"},
                                           {"PK\x03\x04", "unzip"},
                                           {"BZh", "bunzip2 -k"},
                                           {"\xfd\x37zXZ", "unxz -k"},
                                           {"7z\xbc\xaf", "7z x"},
                                           {"\x28\xb5\x2f\xfd", "unzstd"}}};

/// Says how to get at the model, where the file is packed.
std::optional<Error> packed(std::string_view front, const std::filesystem::path& file) {
  const auto found =
      std::ranges::find_if(archives, [&](const Archive& each) { return front.starts_with(each.begins); });
  if (found == archives.end()) return std::nullopt;
  const FileLocation where{file.string(), 0, 0};
  return error_at(where, "is packed in a way that is not read: run {} \"{}\", and give what comes out",
                  found->unpack, file.filename().string());
}

/// Names may come from any bytes of the file; they go into messages, panels and exported JSON.
void repair_names(scene::Model& model) {
  repair_utf8(model.name);
  for (scene::Texture& texture : model.textures) repair_utf8(texture.name);
  for (scene::Material& material : model.materials) repair_utf8(material.name);
  for (scene::ModelNode& node : model.nodes) repair_utf8(node.name);
  for (scene::Part& part : model.parts) repair_utf8(part.object);
  for (scene::Animation& animation : model.animations) repair_utf8(animation.name);
  for (scene::Road& road : model.roads) repair_utf8(road.name);
}

}  // namespace

void Readers::add(std::initializer_list<const char*> extensions, const ReadModel& read,
                  LooksRight looks_right, TakesPacked takes_packed) {
  for (const char* extension : extensions) {
    [[maybe_unused]] const bool is_new =
        by_extension_.emplace(extension, Reader{read, looks_right, takes_packed}).second;
    assert(is_new && "two rooms read files of this extension");
  }
}

Result<scene::Model> Readers::read(const std::filesystem::path& file, const ModelReading& reading,
                                   Errors& warnings) const {
  const FileLocation where{file.string(), 0, 0};
  const std::string extension = model_extension(file);
  const auto reader = by_extension_.find(extension);
  const bool takes_packed = reader != by_extension_.end() && reader->second.takes_packed == TakesPacked::yes;
  const Result<std::string> front =
      takes_packed ? unpacked_front(file, front_bytes) : read_front(file, front_bytes);
  if (reader == by_extension_.end()) {
    if (front)
      if (std::optional<Error> error = packed(*front, file)) return *std::move(error);
    std::vector<std::string> known;
    known.reserve(by_extension_.size());
    for (const auto& [each, read] : by_extension_) known.push_back(each);
    return error_at(where, "no reader for files of the kind \"{}\"; models are read from {}", extension,
                    fmt::join(known, ", "));
  }
  if (!front) return front.errors();
  const bool is_packed = !takes_packed && packing_of(*front) != Packing::none;
  if (is_packed || !reader->second.looks_right(*front)) {
    if (std::optional<Error> error = packed(*front, file)) return *std::move(error);
    return error_at(where,
                    "is no {} file: its content is of another format; export it again, or give it the "
                    "extension of what it is",
                    extension);
  }
  Result<FileContent> content = reader->second.read(file, reading, warnings);
  if (content) {
    content->account.set_file(file.string());
    content->account.repair_names();
    for (Error& line : content->account.warnings()) warnings.push_back(std::move(line));
    repair_names(content->model);
    content->model.account = std::make_shared<const scene::FileAccount>(std::move(content->account));
  }
  for (Error& warning : warnings) repair_utf8(warning.message);
  if (!content) return content.errors();
  return std::move(content->model);
}

}  // namespace parvis::formats
