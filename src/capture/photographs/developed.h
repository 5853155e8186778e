// Photographs as telephones and cameras store them (HEIC, AVIF, raw files) and other pictures become JPEG,
// with their EXIF: COLMAP reads nothing of the former, and everything behind it reads JPEG and PNG.
#pragma once

#include <filesystem>

#include "base/result.h"

namespace parvis::photographs {

/// A folder of photographs that are all JPEG or PNG.
struct DevelopedFolder {
  std::filesystem::path folder;
  /// One line for each picture that is left out: pictures that cannot be read, and those that stand beside a
  /// JPEG or PNG of their name, as a camera writes a raw file beside its own JPEG.
  Errors problems;
};

/// The folder itself where no picture in it or below it needs to be developed. Else `kept`: with copies of
/// its JPEG and PNG pictures, and a JPEG for each other one, under its name. What stands there and is newer
/// than its original stays. Errors: a file cannot be written.
Result<DevelopedFolder> developed(const std::filesystem::path& pictures, const std::filesystem::path& kept);

}  // namespace parvis::photographs
