// Designs as JSON (docs/design.schema.json), for other programs.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "planning/design/own_kind.h"
#include "planning/design/session.h"

namespace parvis::design {

/// The design as JSON. `file`: where it will lie; files of own kinds are named relative to its folder.
std::string json_of(const scene::Scene& scene, const Session& session, const std::filesystem::path& file);

/// Makes a model's file a kind, as `import_kind` does.
using TakeModel = std::function<Result<OwnKind>(const std::filesystem::path& file)>;

/// Inserts the objects, own kinds and views of a design in JSON, each by a command; one whose name is taken
/// gets the next free name. Where both are on a map, places are those of the map. `take` is called for own
/// kinds that the scene lacks; their files lie below the folder of `file`. Errors name the place in the file:
/// a value of another type or unit than the schema's, control characters, a kind that is in neither; what
/// stands before it has been inserted.
Status read_json(const std::string& text, const std::filesystem::path& file, Session& session,
                 const TakeModel& take);

}  // namespace parvis::design
