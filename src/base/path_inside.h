// Paths inside a folder that a person has named and that may hold links of strangers.
#pragma once

#include <filesystem>

#include "base/result.h"

namespace parvis {

/// Whether a path leads to `folder` or into it; both are canonical.
bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder);

/// The path of `name` inside `folder`; what it names may be absent. Error: a link on the way, or "..", leads
/// out of `folder`.
Result<std::filesystem::path> path_inside(const std::filesystem::path& folder,
                                          const std::filesystem::path& name);

}  // namespace parvis
