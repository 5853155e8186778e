// The account that counts what a model shows, for readers that leave nothing out, or have not said so yet.
#pragma once

#include <string>

#include "formats/readers/readers.h"

namespace parvis::formats {

/// The model with an account of what came out of its file: objects, triangles, images, animations, roads.
/// `format` as in scene::FileAccount. Errors of `model` are passed on.
Result<FileContent> with_plain_account(std::string format, Result<scene::Model> model);

/// Counts the same into an account that says more, images as far as it has not counted them.
void count_what_is_shown(const scene::Model& model, scene::FileAccount& account);

}  // namespace parvis::formats
