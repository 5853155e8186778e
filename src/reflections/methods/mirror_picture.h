// What mirror-like surfaces show in each pixel of the main view. The rays that leave them are drawn first;
// then the radiance along each ray is computed once, however many small triangles share the pixel (deferred
// shading, Saito and Takahashi 1990).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "graphics/gl/objects.h"
#include "graphics/gl/program.h"
#include "graphics/render/surface_programs.h"
#include "reflections/methods/reflections.h"

namespace parvis::methods {

/// The mirror rays of a picture, read back: of each pixel, in rows from the bottom left of `pixels`.
struct MirrorRays {
  glm::ivec4 pixels{0};  ///< x, y, width, height in the main view
  /// xyz: where the ray leaves, in the world; w: roughness of the base.
  std::vector<glm::vec4> starts;
  /// xy: direction (octahedral); z: roughness of the coat; w: the object's index and 1; 0: no ray.
  std::vector<glm::vec4> directions;
};

/// How many mirror rays each pixel may have.
enum class RayCount : std::uint8_t {
  one,       ///< through its middle
  and_edges  ///< a second, where another surface covers a part of the pixel and no ray nearby fits it
};

/// Deferred reflection: ray picture in, light picture out. Both have a layer for each ray of a pixel.
class MirrorPicture {
 public:
  /// Creates it for the scene of that renderer. Fails only if a shader does.
  static Result<MirrorPicture> create(const render::Renderer& renderer, RayCount rays = RayCount::one);

  /// The rays of all mirror-like surfaces that the prepared main view shows; second ones only of these
  /// reflectors, where `create` allows them.
  void draw_rays(render::Renderer& renderer, std::span<const VisibleReflector> with_second_rays = {});

  /// Draws the light along the rays. For each reflector `use_program` uses a program of
  /// render/whole_screen.vert and a fragment shader that reads the layer ray_layer of ray_starts and
  /// ray_directions, as mirror_rays.frag writes them, and writes the light of base and coat.
  void draw_light(const render::Renderer& renderer, const std::vector<VisibleReflector>& reflectors,
                  const std::function<const gl::Program&(const VisibleReflector&)>& use_program) const;

  /// Reads, for methods that compute the light on the CPU, the first rays of all pixels that may show one of
  /// the reflectors. A readback, which waits for the GPU.
  void read_rays(const render::Renderer& renderer, const std::vector<VisibleReflector>& reflectors,
                 MirrorRays& rays) const;
  /// The light along them, in place of draw_light: base (alpha 1 where there is some, else 0) and coat.
  void put_light(const render::Renderer& renderer, const std::vector<VisibleReflector>& reflectors,
                 const MirrorRays& rays, std::span<const glm::vec4> base,
                 std::span<const glm::vec3> coat) const;

  /// Binds textures for programs with mirror_picture.frag; takes four texture units.
  void bind(const gl::Program& program, GLuint first_unit) const;

 private:
  struct EdgePrograms {
    render::SurfacePrograms rays;
    gl::Program outlines;       ///< leaves the depth of first rays where nothing shares their pixel
    gl::Program no_second_ray;  ///< leaves the depth of second rays
    static Result<EdgePrograms> create(render::SurfaceSource source,
                                       const std::vector<render::GpuMaterial>& materials);
  };

  MirrorPicture(render::SurfacePrograms ray_programs, std::optional<EdgePrograms> edge_programs,
                gl::Program spread);
  int layers() const { return edge_programs_ ? 2 : 1; }
  void resize(int width, int height);
  void draw_edge_rays(render::Renderer& renderer);
  void clear_second_depth(const gl::Program& program) const;
  void bind_rays(const gl::Program& program) const;
  void begin_light(int layer) const;
  static void end_light();
  void draw_over(const render::Renderer& renderer, const gl::Program& program,
                 const VisibleReflector& reflector) const;
  void spread_light(const render::Renderer& renderer, const std::vector<VisibleReflector>& reflectors) const;

  /// State of the rays drawn last: whether there are second ones, and a flag for each object that has them.
  bool has_second_rays_ = false;
  std::vector<std::uint8_t> are_seconded_;
  int width_ = 0, height_ = 0;
  glm::ivec2 room_{0};  ///< of the textures, which never shrink
  render::SurfacePrograms ray_programs_;
  std::optional<EdgePrograms> edge_programs_;
  gl::Program spread_;
  gl::Texture starts_, directions_, depth_;  ///< of rays; the nearest in each pixel
  gl::Texture base_light_, coat_light_;
  std::array<gl::Framebuffer, 2> rays_, light_;  ///< of each layer
  gl::Framebuffer second_depth_;
  gl::VertexArray no_attributes_;
};

/// The pixels that may show a box, with a margin of one: x, y, width, height; nothing has no width.
glm::ivec4 pixels_of(const render::View& view, const Bounds& bounds);

}  // namespace parvis::methods
