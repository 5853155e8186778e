// The pictures of a display's walls: drawn by the renderer, or traced.
#pragma once

#include <functional>

#include "graphics/display/screens.h"
#include "stage/stage.h"

namespace parvis::stage {

/// Draws all pictures in one frame and makes what each projector shows. `draw_over` is called for each
/// picture by its place in the list, when it is in its framebuffer (Screens::framebuffer_of). Fails only
/// where a shader does.
Status draw_walls(Stage& stage, const display::Display& display,
                  std::span<const display::WallPicture> pictures, display::Screens& screens,
                  const std::function<void(std::size_t picture)>& draw_over = {});

/// The same by the ray tracer, the rows of each picture divided among the processes: the first one has what
/// the projectors show.
void trace_walls(Stage& stage, const display::Display& display,
                 std::span<const display::WallPicture> pictures, int samples_per_pixel,
                 const machines::Processes& processes, display::Screens& screens);

/// Writes into a folder what each projector shows, WALL.png, and of stereo the picture of each eye,
/// WALL_left.png and WALL_right.png. Stereo by two buffers has these alone.
Status write_walls(const display::Display& display, std::span<const display::WallPicture> pictures,
                   const display::Screens& screens, const std::filesystem::path& folder);

}  // namespace parvis::stage
