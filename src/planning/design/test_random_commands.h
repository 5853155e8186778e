// Random commands, as somebody at work gives them: for tests and measurements of undo, replay and
// journals.
#pragma once

#include <string>

#include "base/random.h"
#include "planning/design/session.h"

namespace parvis::design {

/// The text of a command that may be given to the session as it is; now and then undo or redo. The same seed
/// and the same design give the same command. Some are refused: a place is taken, a size is too large.
std::string random_command(Random& random, const Session& session);

}  // namespace parvis::design
