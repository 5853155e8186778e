// Models as flat bytes: how they come back from the child process that reads a file.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::formats {

/// How many bytes `bytes_of` gives.
std::uint64_t byte_count(const scene::Model& model);

/// All of `model`; numbers as they lie in memory.
std::string bytes_of(const scene::Model& model);

/// The model that `bytes_of` has written. The bytes are not trusted: counts are checked before anything is
/// allocated, and indices, enumerations and numbers before the model is returned. `subject` stands in errors.
Result<scene::Model> model_of(std::string_view bytes, const std::string& subject);

}  // namespace parvis::formats
