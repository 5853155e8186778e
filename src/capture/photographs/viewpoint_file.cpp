// Viewpoints of VRML 97 (ISO/IEC 14772-1, 6.53), and perspective cameras of VRML 1.0 and Inventor: a small
// reader of exactly these nodes and the transforms around them. Everything else in the file is passed over.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <span>

#include "capture/photographs/camera_files.h"

namespace parvis::photographs {
namespace {

constexpr double default_fov = 0.785398;  // of both standards
constexpr int max_depth = 200;

/// Words of the file: numbers, names, strings without their quotes, and brackets. Commas are blanks; # begins
/// a comment.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  bool next(std::string_view& word) {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] == '#')
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      else if (!is_blank(text_[at_]))
        break;
    }
    if (at_ >= text_.size()) return false;
    const std::size_t begin = at_;
    if (text_[at_] == '"') {
      at_ = std::min(text_.find('"', begin + 1), text_.size());
      word = text_.substr(begin + 1, at_ - begin - 1);
      at_ = std::min(at_ + 1, text_.size());
      return true;
    }
    if (is_bracket(text_[at_])) {
      word = text_.substr(at_++, 1);
      return true;
    }
    while (at_ < text_.size() && !is_blank(text_[at_]) && !is_bracket(text_[at_]) && text_[at_] != '"') ++at_;
    word = text_.substr(begin, at_ - begin);
    return true;
  }
  /// Reads numbers into `values`; false at the first word that is none.
  bool numbers(std::span<double> values) {
    for (double& value : values) {
      std::string_view word;
      if (!next(word)) return false;
      if (word.starts_with('+')) word.remove_prefix(1);
      const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return false;
    }
    return true;
  }
  int line() const { return line_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ','; }
  static bool is_bracket(char c) { return c == '{' || c == '}' || c == '[' || c == ']'; }
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

/// One node of the file that is being read.
struct Frame {
  std::string_view type, name;
  glm::dvec3 translation{0.0}, scale{1.0}, centre{0.0}, position{0.0};
  glm::dvec4 rotation{0.0, 0.0, 1.0, 0.0}, orientation{0.0, 0.0, 1.0, 0.0};  // axis and angle
  double fov = default_fov;
  std::string_view description;
  bool is_view() const { return type == "Viewpoint" || type == "PerspectiveCamera"; }
  bool is_transform() const { return type == "Transform" || type == "MatrixTransform"; }
};

glm::dmat4 turned(glm::dvec4 axis_angle) {
  const glm::dvec3 axis(axis_angle);
  return glm::length(axis) > 1e-12 ? glm::rotate(glm::dmat4(1.0), axis_angle.w, glm::normalize(axis))
                                   : glm::dmat4(1.0);
}

/// world_from_node of a Transform (VRML 97, 6.52), without scaleOrientation.
glm::dmat4 transform_of(const Frame& frame) {
  return glm::translate(glm::dmat4(1.0), frame.translation + frame.centre) * turned(frame.rotation) *
         glm::scale(glm::dmat4(1.0), frame.scale) * glm::translate(glm::dmat4(1.0), -frame.centre);
}

/// False where the field's numbers are missing.
bool read_field(Words& words, std::string_view field, Frame& frame) {
  const auto three = [&](glm::dvec3& v) { return words.numbers({&v.x, 3}); };
  const auto four = [&](glm::dvec4& v) { return words.numbers({&v.x, 4}); };
  if (frame.is_view()) {
    if (field == "position") return three(frame.position);
    if (field == "orientation") return four(frame.orientation);
    if (field == "fieldOfView" || field == "heightAngle") return words.numbers({&frame.fov, 1});
    if (field == "description") return words.next(frame.description);
  }
  if (frame.is_transform()) {
    if (field == "translation") return three(frame.translation);
    if (field == "rotation") return four(frame.rotation);
    if (field == "scale" || field == "scaleFactor") return three(frame.scale);
    if (field == "center") return three(frame.centre);
  }
  return true;
}

ViewOfPicture view_of(const std::vector<Frame>& frames) {
  const Frame& view = frames.back();
  glm::dmat4 world_from_view(1.0);
  for (std::size_t i = 0; i + 1 < frames.size(); ++i)
    if (frames[i].is_transform()) world_from_view *= transform_of(frames[i]);
  const glm::dmat4 placed =
      world_from_view * glm::translate(glm::dmat4(1.0), view.position) * turned(view.orientation);
  glm::dmat4 z_up(0.0);  // (x, y, z) of a world with y up becomes (x, -z, y)
  z_up[0][0] = z_up[1][2] = z_up[3][3] = 1.0;
  z_up[2][1] = -1.0;
  ViewOfPicture result;
  result.name = view.description.empty() ? view.name : view.description;
  result.world_from_camera = z_up * placed;
  for (int axis = 0; axis < 3; ++axis)  // scales move cameras but are none of theirs
    result.world_from_camera[axis] = glm::normalize(result.world_from_camera[axis]);
  result.fov = view.fov;
  result.across =
      view.type == "Viewpoint" ? ViewOfPicture::Across::smaller_side : ViewOfPicture::Across::height;
  return result;
}

}  // namespace

Result<std::vector<ViewOfPicture>> parse_viewpoints(std::string_view text, const std::string& name) {
  if (!text.starts_with("#VRML") && !text.starts_with("#Inventor V2"))
    return error_at({name, 1, 0}, "expected a file that begins with #VRML or #Inventor, as text");
  std::vector<ViewOfPicture> views;
  std::vector<Frame> frames;
  Words words(text);
  std::string_view word, before, defined;
  while (words.next(word)) {
    if (word == "DEF") {
      if (!words.next(defined)) break;
    } else if (word == "{") {
      if (int(frames.size()) >= max_depth)
        return error_at({name, words.line(), 0}, "nodes are nested more than {} deep", max_depth);
      Frame& frame = frames.emplace_back();
      frame.type = before;
      frame.name = defined;
      defined = {};
    } else if (word == "}") {
      if (frames.empty()) return error_at({name, words.line(), 0}, "a closing bracket closes nothing");
      if (frames.back().is_view()) views.push_back(view_of(frames));
      frames.pop_back();
    } else if (!frames.empty() && !read_field(words, word, frames.back())) {
      return error_at({name, words.line(), 0}, "{} of a {}: expected numbers", std::string(word),
                      std::string(frames.back().type));
    }
    before = word;
  }
  if (!frames.empty())
    return error_at({name, words.line(), 0}, "the file ends inside of a {}", std::string(frames.back().type));
  return views;
}

}  // namespace parvis::photographs
