#include "graphics/gl/pass_times.h"

#include <utility>

#include "graphics/gl/context.h"

namespace parvis::gl {

using Clock = std::chrono::steady_clock;

void PassTimes::begin_waiting_frame() {
  if (is_timed_ && !waited_.empty()) latest_ = std::exchange(waited_, {});
  is_timed_ = frame_++ % timed_every == 0;
  if (!is_timed_) return;
  glFinish();
  pass_began_ = Clock::now();
}

void PassTimes::begin_frame() {
  if (!waits_) waits_ = is_software();
  if (*waits_) return begin_waiting_frame();
  frames_[current_].is_waiting = !frames_[current_].names.empty();
  current_ = (current_ + 1) % frames_.size();
  for (std::size_t age = 0; age < frames_.size(); ++age)  // the oldest first
    read(frames_[(current_ + age) % frames_.size()]);
  frames_[current_].is_waiting = false;  // the driver lies that far behind: this one's times are lost
  frames_[current_].names.clear();
  stamp();
}

void PassTimes::end_pass(std::string name) {
  if (waits_.value_or(false)) {
    if (!is_timed_) return;
    glFinish();
    const Clock::time_point now = Clock::now();
    waited_.push_back({std::move(name), std::chrono::duration<double>(now - pass_began_).count()});
    pass_began_ = now;
    return;
  }
  frames_[current_].names.push_back(std::move(name));
  stamp();
}

void PassTimes::stamp() {
  Frame& frame = frames_[current_];
  if (frame.stamps.size() == frame.names.size()) frame.stamps.push_back(Query::create(GLenum(GL_TIMESTAMP)));
  glQueryCounter(frame.stamps[frame.names.size()].name(), GL_TIMESTAMP);
}

/// Takes over the frame's times if they have come.
void PassTimes::read(Frame& frame) {
  if (!frame.is_waiting) return;
  GLint has_come = 0;
  glGetQueryObjectiv(frame.stamps[frame.names.size()].name(), GL_QUERY_RESULT_AVAILABLE, &has_come);
  if (!has_come) return;
  const auto time_ns = [](const Query& stamp) {
    GLuint64 ns = 0;
    glGetQueryObjectui64v(stamp.name(), GL_QUERY_RESULT, &ns);
    return ns;
  };
  latest_.clear();
  for (std::size_t i = 0; i < frame.names.size(); ++i)
    latest_.push_back(
        {frame.names[i], 1e-9 * double(time_ns(frame.stamps[i + 1]) - time_ns(frame.stamps[i]))});
  frame.is_waiting = false;
}

}  // namespace parvis::gl
