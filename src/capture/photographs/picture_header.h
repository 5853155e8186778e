// What a picture's header says, without its pixels; and whether a JPEG is whole.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace parvis::photographs {

/// Size, and what EXIF says of the camera.
struct PictureHeader {
  int width = 0, height = 0;  ///< as stored, before `orientation`
  int orientation =
      1;               ///< EXIF: 1 as stored, 3 upside down, 6 and 8 turned by a quarter; 2, 4, 5, 7 mirrored
  std::string camera;  ///< EXIF: the model's name; empty: not given
  double focal_length_mm = 0.0;       ///< EXIF; 0: not given
  double focal_length_35mm_mm = 0.0;  ///< EXIF: as on film 36 mm wide; 0: not given
  std::string taken;  ///< EXIF, by the camera's clock: "2026:06:21 14:15:00"; empty: not given
};

/// The header of a JPEG (ITU-T T.81, annex B; EXIF: CIPA DC-008) or PNG; pictures of other formats are
/// decoded for it. Errors name the file: no picture, damaged.
Result<PictureHeader> read_picture_header(const std::filesystem::path& file);
/// The same of the bytes of a JPEG or PNG, or of their first ones; `name` stands in errors.
Result<PictureHeader> parse_picture_header(std::string_view bytes, const std::string& name);

/// True for bytes that are no JPEG, and for a JPEG whose segments lead to its end marker: decoders fill the
/// rest of one that is cut short with grey, and say nothing.
bool is_whole_jpeg(std::string_view bytes);

}  // namespace parvis::photographs
