#include "graphics/display/screens.h"

#include "graphics/gl/context.h"
#include "graphics/render/picture_target.h"

namespace parvis::display {

Screens::Target Screens::target(glm::ivec2 size) {
  Target target;
  target.size = size;
  target.texture = gl::texture_2d(GL_RGBA8, size.x, size.y);
  target.framebuffer = gl::Framebuffer::create();
  glNamedFramebufferTexture(target.framebuffer.name(), GL_COLOR_ATTACHMENT0, target.texture.name(), 0);
  return target;
}

Result<Screens> Screens::create(const Display& display, std::span<const WallPicture> pictures) {
  Result<gl::Program> program =
      gl::Program::create("graphics/display/wall.vert", "graphics/display/wall.frag");
  if (!program) return program.errors();
  Screens screens(*std::move(program));
  for (const WallPicture& picture : pictures) screens.pictures_.push_back(target(picture.size));
  screens.outputs_.resize(2 * display.walls.size());
  for (const WallPicture& picture : pictures) {
    const Wall& wall = display.walls[picture.wall];
    screens.outputs_[2 * picture.wall] = target(wall.pixels);
    if (display.stereo == Stereo::quad_buffer && wall.eye == Eye::both)
      screens.outputs_[2 * picture.wall + 1] = target(wall.pixels);
  }
  for (const Wall& wall : display.walls) {
    Surface surface;
    surface.vertex_array = gl::VertexArray::create();
    std::vector<GLuint> indices;
    const GLuint columns = GLuint(wall.columns), rows = GLuint(wall.surface.size()) / columns;
    for (GLuint row = 0; row + 1 < rows; ++row)
      for (GLuint i = row * columns; i + 1 < (row + 1) * columns; ++i)
        indices.insert(indices.end(), {i, i + 1, i + columns, i + columns, i + 1, i + columns + 1});
    surface.count = int(indices.size());
    surface.vertices = gl::immutable_buffer(std::span<const SurfaceVertex>(wall.surface));
    surface.indices = gl::immutable_buffer(std::span<const GLuint>(indices));
    const GLuint array = surface.vertex_array.name();
    glVertexArrayVertexBuffer(array, 0, surface.vertices.name(), 0, sizeof(SurfaceVertex));
    glVertexArrayElementBuffer(array, surface.indices.name());
    const std::array<std::pair<int, std::size_t>, 3> attributes{{{3, offsetof(SurfaceVertex, pixel)},
                                                                 {3, offsetof(SurfaceVertex, point)},
                                                                 {2, offsetof(SurfaceVertex, share)}}};
    for (GLuint i = 0; i < 3; ++i) {
      glEnableVertexArrayAttrib(array, i);
      glVertexArrayAttribFormat(array, i, attributes[i].first, GL_FLOAT, GL_FALSE,
                                GLuint(attributes[i].second));
      glVertexArrayAttribBinding(array, i, 0);
    }
    screens.surfaces_.push_back(std::move(surface));
  }
  screens.program_.set("left_picture", 0);
  screens.program_.set("right_picture", 1);
  if (const std::string why = gl::refused(); !why.empty())
    return error("the graphics driver refuses the walls' pictures: {}; smaller \"pixels\" need less", why);
  return screens;
}

void Screens::put(std::size_t picture, const Image8& image) {
  Image8 upward = image;
  render::flip_rows(upward);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(pictures_[picture].texture.name(), 0, 0, 0, image.width, image.height,
                      image.channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE, upward.pixels.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void Screens::compose(const Display& display, std::span<const WallPicture> pictures) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  program_.use();
  program_.set("gamma", float(display.gamma));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const WallPicture& picture = pictures[i];
    const Wall& wall = display.walls[picture.wall];
    const bool is_pair = i + 1 < pictures.size() && pictures[i + 1].wall == picture.wall;
    const bool is_second = i > 0 && pictures[i - 1].wall == picture.wall;
    const bool is_apart = display.stereo == Stereo::quad_buffer || display.stereo == Stereo::side_by_side ||
                          display.stereo == Stereo::top_bottom;
    if (is_second && !is_apart) continue;  // it was drawn with the first
    const int pattern = !is_pair || is_apart ? 0 : 1 + int(display.stereo) - int(Stereo::interlaced);
    const Target& into = output(picture.wall, picture.eye);
    glBindFramebuffer(GL_FRAMEBUFFER, into.framebuffer.name());
    glm::ivec2 from(0), size = wall.pixels;
    if (is_pair || is_second) {
      if (display.stereo == Stereo::side_by_side)
        size.x = wall.pixels.x / 2, from.x = is_second ? wall.pixels.x - size.x : 0;
      if (display.stereo == Stereo::top_bottom)
        size.y = wall.pixels.y / 2, from.y = is_second ? 0 : wall.pixels.y - size.y;
    }
    glViewport(0, 0, wall.pixels.x, wall.pixels.y);
    if (!is_second || display.stereo == Stereo::quad_buffer) {
      constexpr std::array black{0.0f, 0.0f, 0.0f, 1.0f};
      glClearBufferfv(GL_COLOR, 0, black.data());
    }
    glViewport(from.x, from.y, size.x, size.y);
    program_.set("is_curved", int(wall.is_curved));
    program_.set("pattern", pattern);
    program_.set("height_px", float(wall.pixels.y));
    program_.set("overlap", glm::vec4(wall.overlap[0], wall.overlap[1], wall.overlap[2], wall.overlap[3]));
    program_.set("left_from_room", picture.clip_from_room);
    program_.set("right_from_room", pictures[pattern > 0 ? i + 1 : i].clip_from_room);
    glBindTextureUnit(0, pictures_[i].texture.name());
    glBindTextureUnit(1, pictures_[pattern > 0 ? i + 1 : i].texture.name());
    glBindVertexArray(surfaces_[picture.wall].vertex_array.name());
    glDrawElements(GL_TRIANGLES, surfaces_[picture.wall].count, GL_UNSIGNED_INT, nullptr);
  }
}

Image8 Screens::read(const Target& target) {
  Image8 image(target.size.x, target.size.y, 4);
  glGetTextureSubImage(target.texture.name(), 0, 0, 0, 0, target.size.x, target.size.y, 1, GL_RGBA,
                       GL_UNSIGNED_BYTE, GLsizei(image.pixels.size()), image.pixels.data());
  render::flip_rows(image);
  return image;
}

Image8 Screens::read(std::size_t wall, Eye eye) const { return read(output(wall, eye)); }

}  // namespace parvis::display
