// The mattes of a folder of photographs.
#pragma once

#include <filesystem>

#include "base/result.h"
#include "capture/trees/matte.h"

namespace parvis::trees {

/// Input of `write_mattes`.
struct MatteFolder {
  std::filesystem::path photographs;  ///< folder of .png and .jpg pictures
  /// Folder of small painted pictures of the same names, .png (zones_of_scribbles); empty: none. Photographs
  /// without one have a matte already, a plain background, or the sky behind them.
  std::filesystem::path zones;
  std::filesystem::path output;  ///< folder, which is made
  MatteMethod method = MatteMethod::clusters;
};

/// How many mattes there are of which kind.
struct MatteCounts {
  int made = 0;
  int doubtful = 0;    ///< of those that were made: they cover so much of the edges that they cannot be right
  int up_to_date = 0;  ///< made before, of the same photograph and zones by the same method
  int foreign = 0;     ///< pictures of these names that are not as this function made them: kept as they are
};

/// Writes OUTPUT/NAME.png, the RGBA picture of each photograph, unless it is there already. What a matte was
/// made of is kept in OUTPUT/.mattes: one of another photograph, of other zones or of another method is made
/// afresh; one that somebody painted over, or put there, is kept with a warning; one that cannot be right is
/// warned of. Errors name the photographs; the others have their mattes then.
Result<MatteCounts> write_mattes(const MatteFolder& folder);

}  // namespace parvis::trees
