// The beginning of one file within a zip archive.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace parvis::formats {

/// The first `count` bytes, fewer where it is shorter, of the first file within a zip archive (APPNOTE 6.3)
/// whose name ends so. Nothing where there is none, or it is damaged, encrypted, or packed otherwise than by
/// deflate.
std::optional<std::string> zip_member_front(std::string_view archive, std::string_view name_end,
                                            std::size_t count);

}  // namespace parvis::formats
