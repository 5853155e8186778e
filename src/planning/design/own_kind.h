// A person's own model becomes a kind of object: the file is read, and kept beside the scene as glTF.
#pragma once

#include <filesystem>

#include "formats/readers/readers.h"
#include "planning/design/command.h"

namespace parvis::design {

/// Metres in the unit of a file's lengths.
inline constexpr double metre = 1.0, centimetre = 0.01, millimetre = 0.001;

/// A model that was read for a design.
struct OwnKind {
  TakeKind command;                ///< that adds it to a design
  std::string note;                ///< its size, for people, and the unit that was taken for that of the file
  std::filesystem::path new_file;  ///< that was written for it; empty: there was one of equal content
};

/// Reads a model and writes it to `kinds/NAME.glb` in the scene's folder, a free name made of the file's,
/// with its foot at the origin. `unit_m`: metres in the file's unit; 0: metres, or millimetres or
/// centimetres where it would
/// be larger than a house. Errors: those of the reader; a model without triangles; one that is smaller than a
/// centimetre or larger than 200 m, with its extents in metres, centimetres and millimetres; a folder that
/// cannot be written.
Result<OwnKind> import_kind(const formats::Readers& readers, const scene::Scene& scene,
                            const std::filesystem::path& file, double unit_m = 0.0);

}  // namespace parvis::design
