// Designs as files: scripts that a scene includes. As JSON: design_json.h.
#pragma once

#include <filesystem>
#include <string>

#include "planning/design/session.h"

namespace parvis::design {

/// The file in which the design was written, where it can be saved: its own design file, or the scene's
/// script; empty: it is in none yet.
std::filesystem::path file_of(const Session& session);

/// Writes the design. `file` is made of the file that the design stands in, with the design as it is now and
/// all else, comments included, as it was; of a design that stands in no file: of an include of the scene's
/// script, and the design. It lies in the folder of the scene, for files are named relative to that. Errors:
/// another folder, a file that is not this design's, the script was changed since, the disk is full; what was
/// there is as before then.
Status save(const Session& session, const std::filesystem::path& scene_script,
            const std::filesystem::path& file);

}  // namespace parvis::design
