// Facades for buildings that are bare volumes, as most city models are.
#pragma once

#include <cstdint>
#include <string_view>

#include "scene/data/model.h"

namespace parvis::dressing {

/// Gives bricks, front doors, shops and windows to the walls (triangles steeper than 70 degrees, once the
/// model's z is up) of the parts that match the pattern `target`. The polygons of the file and the heights of
/// eaves distinguish the houses of a row; each has its bricks, storey height, rhythm of windows and street
/// level, by `seed`. Where the names of parts have words for the kind of building
/// (scene/data/building_kind.h: "WallSurface office 1919-1945 4-storeys"), finish, windows and measures
/// are those of its time and use: bands of windows, shop fronts, gates without windows, tall windows of
/// churches; the storeys are as many as named. Whole storeys end at the eaves; gables, party walls, walls of
/// less than 1.6 m and walls that have windows of the model are bricks alone; low ones are sheds. Walls that
/// begin at an underside (OuterCeilingSurface) have windows and no doors. Walls with
/// a picture, and the model's own windows and doors ("Window" or "Door" is in the name of the object or the
/// material), are left as they are. Without openings (`has_openings`) all of them are bricks alone, as of
/// garden walls and quays. Returns the number of triangles changed.
std::size_t add_facades(scene::Model& model, std::string_view target, std::uint64_t seed = 1,
                        bool has_openings = true);

}  // namespace parvis::dressing
