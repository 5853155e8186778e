#include "viewer/comparison.h"

#include <cmath>

#include "base/content_hash.h"
#include "stage/stillness.h"

namespace parvis::viewer {

void Comparison::draw_one(stage::Stage& stage, const Camera& camera, const std::string& shown,
                          const std::string& hidden, glm::ivec2 size, bool is_whole, const Shown& into) {
  scene::LiveScene& live = stage.simulation().live();
  for (const auto& [name, is_visible] : {std::pair(&shown, true), std::pair(&hidden, false)})
    if (const scene::Node* node = live.find(*name)) live.set(*node, "visible", is_visible);
  // All else has been built when the scene took its step: visibility alone waits, which cannot fail.
  live.refresh(stage.simulation().scene);
  stage.simulation().clock.follow(stage.simulation().scene);
  stage.draw(camera, size.x, size.y);
  if (is_whole) stage.whole_picture();
  stage.display(into.framebuffer.name());
}

void Comparison::draw(stage::Stage& stage, const Camera& camera, const std::string& before,
                      const std::string& after, ComparedView view, glm::ivec2 size) {
  if (view == ComparedView::side_by_side) size.x = std::max(size.x / 2, 1);
  ContentHash hash;
  hash.add(stage::state_of(stage.scene(), camera, size.x, size.y));
  hash.add_text(before + "/" + after);
  const bool is_same = hash.value() == state_ && view == view_ && size == size_;
  if (is_same && is_whole_) return;
  is_whole_ = is_same;
  view_ = view, size_ = size;
  if (glm::any(glm::greaterThan(size, room_))) {
    room_ = size;
    for (Shown* const each : {&before_, &after_}) {
      each->texture = gl::texture_2d(GL_RGBA8, size.x, size.y);
      each->framebuffer = gl::Framebuffer::create();
      glNamedFramebufferTexture(each->framebuffer.name(), GL_COLOR_ATTACHMENT0, each->texture.name(), 0);
    }
  }
  draw_one(stage, camera, before, after, size, is_whole_, before_);
  draw_one(stage, camera, after, before, size, is_whole_, after_);
  hash = {};
  hash.add(stage::state_of(stage.scene(), camera, size.x, size.y));
  hash.add_text(before + "/" + after);
  state_ = hash.value();
}

void Comparison::display(GLuint framebuffer, float split, bool only_before) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);  // what lies over the pictures is drawn there
  const auto copy = [&](const Shown& from, glm::ivec2 columns, int to_left) {
    if (columns.y <= columns.x) return;
    glBlitNamedFramebuffer(from.framebuffer.name(), framebuffer, columns.x, 0, columns.y, size_.y, to_left, 0,
                           to_left + columns.y - columns.x, size_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  };
  if (view_ == ComparedView::side_by_side) {
    copy(before_, {0, size_.x}, 0);
    if (!only_before) copy(after_, {0, size_.x}, size_.x);
    return;
  }
  const int at = std::clamp(int(std::lround(split * float(size_.x))), 0, size_.x);
  copy(before_, {0, at}, 0);
  if (!only_before) copy(after_, {at, size_.x}, at);
}

}  // namespace parvis::viewer
