// A strip below a picture that says what it shows.
#pragma once

#include <string>

#include "base/image.h"
#include "base/result.h"

namespace parvis::photomontage {

/// The picture (RGB) with a white strip below it that holds `text` in black, broken into lines of the
/// picture's width. Errors: letters that cannot be drawn (cairo is missing).
Result<Image8> with_caption(const Image8& picture, const std::string& text);

}  // namespace parvis::photomontage
