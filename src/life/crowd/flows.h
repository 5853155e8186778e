// Flows of people as counts give them: who comes where, goes where, and how many in an hour.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "base/result.h"

namespace parvis::crowd {

/// People who come at one place and leave at another.
struct Flow {
  glm::vec3 from{0.0f}, to{0.0f};  ///< frame of the crowd's node, metres
  float per_hour = 0.0f;
};

/// Reads a table with the columns from, to and per_hour, named in its first line: places are two or three
/// numbers with spaces between (metres), fields are divided by commas or semicolons, # begins a comment.
/// Errors, one for each bad line (20 at most), with the line: fields missing, numbers that are none or not
/// finite, counts below 0 or above 36,000; files of more than 1 MiB or 2,000 flows; no flow at all.
Result<std::vector<Flow>> read_flows(const std::filesystem::path& file);

}  // namespace parvis::crowd
