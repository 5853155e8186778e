// Files of a generated place, written side by side and all or none of them.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "base/result.h"

namespace parvis::synthesis {

/// Writes some files of its own into the folder.
using WritingJob = std::function<Status(const std::filesystem::path& folder)>;

/// Runs jobs that do not depend on each other (the longest first) in a folder within `folder`, which is made
/// where it is missing, and moves all that they wrote into it: the files appear together or, when one of them
/// cannot be written, not at all.
Status write_together(const std::vector<WritingJob>& jobs, const std::filesystem::path& folder);

}  // namespace parvis::synthesis
