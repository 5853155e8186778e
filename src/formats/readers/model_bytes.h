// Models as flat bytes: how they come back from the child process that reads a file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::formats {

/// How many bytes `put_bytes` writes.
std::uint64_t byte_count(const scene::Model& model);

/// Writes all of `model` to `to`, which has byte_count(model) bytes; numbers as they lie in memory.
void put_bytes(const scene::Model& model, std::span<std::byte> to);

/// The model that `put_bytes` has written. The bytes are not trusted: counts are checked before anything is
/// allocated, and indices, enumerations and numbers before the model is returned. `subject` stands in errors.
Result<scene::Model> model_of(std::string_view bytes, const std::string& subject);

}  // namespace parvis::formats
