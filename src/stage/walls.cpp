#include "stage/walls.h"

#include "base/image_io.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::stage {

Status draw_walls(Stage& stage, const display::Display& display,
                  std::span<const display::WallPicture> pictures, display::Screens& screens,
                  const std::function<void(std::size_t picture)>& draw_over) {
  std::vector<render::EyeView> eyes;
  for (const display::WallPicture& picture : pictures)
    eyes.push_back({picture.camera, picture.size.x, picture.size.y});
  if (Status status = stage.draw(eyes); !status) return status;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    stage.renderer().select_eye(i);
    stage.renderer().display(screens.framebuffer_of(i), pictures[i].size, stage.scene().exposure);
    if (draw_over) draw_over(i);
  }
  stage.renderer().select_eye(0);
  screens.compose(display, pictures);
  return Ok{};
}

void trace_walls(Stage& stage, const display::Display& display,
                 std::span<const display::WallPicture> pictures, int samples_per_pixel,
                 const machines::Processes& processes, display::Screens& screens) {
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const glm::ivec2 size = pictures[i].size;
    const reference::TracedPicture traced =
        stage.trace(pictures[i].camera, size.x, size.y, samples_per_pixel, processes);
    if (processes.is_first())
      screens.put(i, shading::tone_mapped_picture(traced.radiance, stage.scene().exposure));
  }
  if (processes.is_first()) screens.compose(display, pictures);
}

Status write_walls(const display::Display& display, std::span<const display::WallPicture> pictures,
                   const display::Screens& screens, const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const display::WallPicture& picture = pictures[i];
    const display::Wall& wall = display.walls[picture.wall];
    const bool is_pair = wall.eye == display::Eye::both && picture.eye != display::Eye::both;
    const bool has_buffers = is_pair && display.stereo == display::Stereo::quad_buffer;
    if (is_pair) {
      const char* const eye = picture.eye == display::Eye::left ? "left" : "right";
      // Of two buffers what the projector shows: warped, blended.
      if (Status status =
              write_image(folder / fmt::format("{}_{}.png", wall.name, eye),
                          has_buffers ? screens.read(picture.wall, picture.eye) : screens.read_picture(i));
          !status)
        return status;
    }
    if (has_buffers || (is_pair && picture.eye == display::Eye::right)) continue;
    if (Status status = write_image(folder / (wall.name + ".png"), screens.read(picture.wall)); !status)
      return status;
  }
  return Ok{};
}

}  // namespace parvis::stage
