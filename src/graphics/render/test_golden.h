// Golden pictures: what a test draws must equal a picture that somebody has looked at, docs/goldens/NAME.png.
// script/update-goldens writes them again (PARVIS_UPDATE_GOLDENS=1), and nothing else does.
#pragma once

#include <filesystem>
#include <string>

#include "base/image.h"
#include "base/result.h"

namespace parvis::render {

/// Permitted differences, in steps of 8 bits of the worst channel. Say why beside each number that is not 0.
struct GoldenTolerance {
  int max_difference = 0;         ///< of any pixel
  int failing_difference = 0;     ///< a pixel that differs by more fails
  double failing_fraction = 0.0;  ///< of all pixels
  double mean_difference = 0.0;
};

/// An error gives the differences and the page that shows actual, expected and difference side by side: in
/// `build/golden-failures` below `source_folder`.
Status matches_golden(const Image8& actual, const std::string& name, const GoldenTolerance& tolerance,
                      const std::filesystem::path& source_folder);

}  // namespace parvis::render
