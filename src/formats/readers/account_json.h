// Accounts of files as JSON, for programs.
#pragma once

#include <span>
#include <string>

#include "scene/data/file_account.h"

namespace parvis::formats {

/// [{"file", "format", "lines": [{"kind", "fate": "used", "changed", "not needed" or "left out", "count",
/// "reason", "names"}]}]; the reason is absent where there is none.
std::string accounts_json(std::span<const scene::FileAccount* const> accounts);

}  // namespace parvis::formats
