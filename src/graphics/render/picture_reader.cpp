#include "graphics/render/picture_reader.h"

namespace parvis::render {
namespace {

constexpr std::size_t max_pending = 2;

GLsizeiptr bytes_of(int width, int height) { return GLsizeiptr(4) * width * height; }

}  // namespace

Image8 PictureReader::take() {
  Pending& oldest = pending_.front();
  Image8 picture(oldest.width, oldest.height, 4);
  spare_bytes_ = bytes_of(oldest.width, oldest.height);
  glGetNamedBufferSubData(oldest.pixels.name(), 0, spare_bytes_, picture.pixels.data());
  spare_ = std::move(oldest.pixels);
  pending_.pop_front();
  flip_rows(picture);
  return picture;
}

std::optional<Image8> PictureReader::next(Renderer& renderer, float exposure) {
  std::optional<Image8> picture;
  if (pending_.size() == max_pending) picture = take();

  const GLsizeiptr bytes = bytes_of(renderer.width(), renderer.height());
  Pending started{gl::Buffer(), renderer.width(), renderer.height()};
  if (spare_ && spare_bytes_ == bytes) {
    started.pixels = *std::exchange(spare_, std::nullopt);
  } else {
    started.pixels = gl::Buffer::create();
    glNamedBufferStorage(started.pixels.name(), bytes, nullptr, 0);
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, started.pixels.name());
  renderer.start_reading(exposure, bytes);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  pending_.push_back(std::move(started));
  return picture;
}

std::optional<Image8> PictureReader::rest() {
  if (pending_.empty()) return std::nullopt;
  return take();
}

}  // namespace parvis::render
