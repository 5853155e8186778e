// A view: camera, selection of objects, and render target. Every drawable draws into every view.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/camera.h"

namespace parvis::render {

class SurfacePrograms;
class VirtualVertices;

/// Purpose of a view, which decides the shaders and the output.
enum class ViewKind : std::uint8_t {
  main,       ///< the displayed image
  cube_face,  ///< surroundings of a reflector
  mirrored,   ///< the scene in a curved reflector, by `virtual_vertices`
  shadow,     ///< depth from the sun
  mirrors,    ///< the mirror-like surfaces of the main view, by `surface_programs`
  picking     ///< the object of each pixel
};

/// Which of the scene's objects a view shows.
enum class Subjects : std::uint8_t {
  all,
  moving,
  fixed,
  staying,   ///< fixed ones without newcomers
  newcomers  ///< fixed ones that appeared or were moved in this frame
};

/// One image to be rendered: camera, selection and target. The pointers must stay valid while the view is
/// drawn.
struct View {
  ViewKind kind = ViewKind::main;
  glm::mat4 clip_from_world{1.0f};    ///< depth -1 near, 1 far; the renderer reverses it
  glm::vec3 position_in_world{0.0f};  ///< of the eye; for shadows, a point far toward the sun
  GLuint framebuffer = 0;
  int width = 0, height = 0;
  /// Rectangle to be drawn: x, y, width, height in pixels from the lower left; zero: all.
  glm::ivec4 part{0};
  /// A flag for each object and, after them, for each thing that rooms draw; those beyond are hidden. Null:
  /// all are shown.
  const std::vector<std::uint8_t>* shown_objects = nullptr;
  int excluded_object = -1;  ///< a reflector does not draw into its own surroundings
  /// Items of GpuScene to leave out: parts of objects that do not see themselves.
  std::span<const std::uint32_t> left_out_items;
  bool shows_glass = true;      ///< includes refracting materials
  bool has_one_sample = false;  ///< a main view with one sample per pixel in place of samples_per_pixel
  Subjects subjects = Subjects::all;
  VirtualVertices* virtual_vertices = nullptr;  ///< of a mirrored view
  /// Programs of a view of mirrors for GpuScene::mirror_materials().
  const SurfacePrograms* surface_programs = nullptr;
  bool clears = true;  ///< clears depth first; else it draws over the content
  /// Occlusion culling, for views of no more than 640 x 360 pixels, or of a camera. Not where the view leaves
  /// out a static object: static occluders are one list, whichever object they belong to.
  bool culls_hidden = false;

  /// True if `shown_objects` selects this object or thing; all are selected where there is no list.
  bool shows(int object) const {
    return !shown_objects ||
           (std::size_t(object) < shown_objects->size() && (*shown_objects)[std::size_t(object)]);
  }
  /// True if only a rectangle of the target is drawn.
  bool has_part() const { return part.z > 0 && part.w > 0; }
  /// Crop matrix, applied after projection: maps the rectangle `part` of clip space to the whole of it.
  glm::mat4 clip_of_part() const;
};

inline glm::mat4 View::clip_of_part() const {
  glm::mat4 crop(1.0f);
  if (!has_part()) return crop;
  const glm::vec2 size{float(width), float(height)},
      middle{float(part.x) + 0.5f * float(part.z), float(part.y) + 0.5f * float(part.w)};
  const glm::vec2 grow = size / glm::vec2(float(part.z), float(part.w));
  crop[0][0] = grow.x, crop[1][1] = grow.y;
  crop[3] = glm::vec4(grow * (1.0f - 2.0f * middle / size), 0.0f, 1.0f);
  return crop;
}

/// The main view of a camera onto a framebuffer of the given size in pixels.
inline View camera_view(const Camera& camera, GLuint framebuffer, int width, int height) {
  View view;
  view.clip_from_world = camera.clip_from_camera(float(width) / float(height)) * camera.camera_from_world();
  view.position_in_world = camera.position_in_world();
  view.framebuffer = framebuffer;
  view.width = width;
  view.height = height;
  return view;
}

/// Passes of a view, in drawing order. Shadow and picking views have no blend pass.
enum class Pass : std::uint8_t { opaque, cutout, blend };
inline constexpr int pass_count = 3;

}  // namespace parvis::render
