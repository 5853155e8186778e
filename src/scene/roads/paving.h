// Carriageways for roads that are only written down: asphalt with markings, laid on the ground that is there.
#pragma once

#include "scene/data/scene.h"

namespace parvis::scene {

/// Lays all lanes of the scene on the ground below them (whatever static, nearly level surface is highest
/// within 2.5 m of a lane's own height) and appends an object "paving" that shows them: asphalt as wide as
/// the lanes, dashes between opposite lanes, lines where vehicles wait before crossings. Where there is no
/// ground, lanes keep their height. A scene without roads stays as it is.
void pave(Scene& scene);

}  // namespace parvis::scene
