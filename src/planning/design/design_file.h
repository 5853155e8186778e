// Designs as files: a script that a scene includes, and JSON (docs/design.schema.json) for other programs.
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

/// The design as JSON, after docs/design.schema.json.
std::string json_of(const scene::Scene& scene, const Session& session);

/// Inserts the objects of a design in JSON, each by a command; one whose name is taken gets the next free
/// name of its kind. Where both are on a map, places are those of the map. Errors name the place in the file;
/// what stands before it has been inserted.
Status read_json(const std::string& text, const std::string& file, Session& session);

}  // namespace parvis::design
