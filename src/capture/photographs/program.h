// Programs that do part of a job, such as COLMAP: run with their output in a log file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::photographs {

/// Runs `arguments[0]`, found on the PATH, and waits for it; `poll` is called five times a second meanwhile.
/// What it prints replaces `log`. It ends with us. Errors: the program is not there, or it failed; then with
/// the end of its log.
Status run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                   const std::function<void()>& poll);

}  // namespace parvis::photographs
