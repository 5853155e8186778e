// Files that are packed as towns publish them: town.city.json.gz is read as the town.city.json that it holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace parvis::formats {

/// How a file is packed, by its first bytes; by no name, since browsers unpack some files and keep their
/// names.
enum class Packing : unsigned char { none, gzip, bzip2 };
/// none, too, for fewer bytes than tell.
Packing packing_of(std::string_view front);

/// The extension in lower case, below that of a packing: ".json" of "town.city.JSON.GZ".
std::string model_extension(const std::filesystem::path& file);

/// The file's name without extension and packing: "town.city" of "town.city.json.gz".
std::string model_stem(const std::filesystem::path& file);

/// The bytes of a regular file, unpacked where gzip or bzip2 has packed it; several packed streams after each
/// other are one text. Errors, each with the file's name: those of `read_file`; packed bytes that are damaged
/// or end too early; what unpacks to more than `max_bytes`, to more than memory can hold, or to far more than
/// any model's text does.
Result<std::string> read_unpacked(const std::filesystem::path& file, std::uint64_t max_bytes);
/// The same with the limit of `read_file`.
Result<std::string> read_unpacked(const std::filesystem::path& file);

/// The first `count` bytes of the content, fewer where it is shorter. Errors: those of `read_unpacked`, but
/// for an end that comes too early.
Result<std::string> unpacked_front(const std::filesystem::path& file, std::size_t count);

/// How large the content is likely to be, in bytes: the file's size, or what that usually unpacks to. 0 where
/// there is no file.
std::uint64_t likely_content_bytes(const std::filesystem::path& file);

}  // namespace parvis::formats
