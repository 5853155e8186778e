// Carriageways for roads that are only written down: asphalt with markings, laid on the ground that is there.
#pragma once

#include "scene/data/scene.h"

namespace parvis::scene {

/// How far beside the outer edge of a road's lanes paving reaches: a margin of asphalt, then pavements.
inline constexpr float paved_beside_m = 2.85f;

/// Lays the lanes of the scene on the ground below them (GroundHeights: within 2.5 m of a lane's own height);
/// lanes that lie on it as they are, within 3 cm, stay as they are. Where there is no ground, lanes keep
/// their height.
void lay_lanes(Scene& scene);

/// The same, and appends an object "paving" that shows the lanes: asphalt as wide as they are, dashes between
/// opposite lanes, lines where vehicles wait before crossings, pavements with kerbs. Roads for less than 25
/// km/h (driveways, aisles of car parks, shared streets) have neither pavements nor dashes, roads for more
/// than 80 km/h no pavements. In plan lanes are those of `lay_lanes`, so that traffic does the same with
/// paving and without; they are raised by the height of the asphalt. A scene without roads stays as it is.
void pave(Scene& scene);

/// The same for lanes that `lay_lanes` has laid on ground which was shaped for them since: they follow it in
/// height alone.
void pave_laid_lanes(Scene& scene);

/// Bytes that the carriageways of these lanes take at most, to be asked before `pave`.
std::uint64_t paving_bytes(const RoadGraph& roads);

}  // namespace parvis::scene
