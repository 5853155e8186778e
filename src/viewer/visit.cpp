#include "viewer/visit.h"

#include <algorithm>
#include <cmath>

#include "base/image_io.h"
#include "reflections/methods/settings.h"
#include "scene/data/realism.h"
#include "stage/probe.h"
#include "viewer/screenshots.h"

namespace parvis::viewer {
namespace {

constexpr double notice_s = 5.0, error_notice_s = 12.0;
constexpr std::size_t max_notices = 4;
constexpr float halted_step_s = 0.1f;
// A frame that takes longer than this is a pause, after which the scene goes on where it was.
constexpr float longest_step_s = 1.0f;

}  // namespace

glm::vec2 azimuth_and_elevation_deg(glm::vec3 direction) {
  const glm::vec3 unit = glm::normalize(direction);
  const float azimuth = glm::degrees(std::atan2(unit.x, unit.y));
  return {azimuth < 0.0f ? azimuth + 360.0f : azimuth,
          glm::degrees(std::asin(std::clamp(unit.z, -1.0f, 1.0f)))};
}

Visit::Visit(stage::Stage& stage, const Camera& start, PicturePlace pictures)
    : stage_(stage), navigation_(start), pictures_(std::move(pictures)) {
  for (const scene::Object& object : scene().objects)
    if (object.is_dynamic) first_places_.emplace(object.name, object.world_from_model[3]);
}

void Visit::step(const Controls& controls, float passed_s, bool stands_still) {
  time_s_ += double(passed_s);
  const float seconds = std::min(passed_s, longest_step_s);
  std::erase_if(notices_, [this](const Notice& notice) { return notice.ends_s < time_s_; });
  advanced_s_ = stands_still ? 0.0 : double(seconds);
  for (const Error& warning : stage_.simulation().advance(advanced_s_, camera().position_in_world()))
    notice_error(to_string(warning));
  follow_guidance(controls);
  const bool has_vehicle = followed_ >= 0 && followed_ < int(scene().objects.size());
  navigation_.step(controls, seconds,
                   has_vehicle ? scene().objects[std::size_t(followed_)].world_from_model : glm::mat4(1.0f));
}

/// The view goes where a tour or a message leads it, until the visitor moves.
void Visit::follow_guidance(const Controls& controls) {
  if (controls.move != glm::vec3(0.0f) || controls.turn != glm::vec2(0.0f)) actions().release_view();
  if (const std::optional<Camera> guided = actions().camera(scene())) navigation_.go_to(*guided);
}

void Visit::set_mode(Mode mode) {
  actions().release_view();
  navigation_.set_mode(mode == Mode::follow && followed_ < 0 ? Mode::fly : mode);
}

std::vector<int> Visit::vehicles() const {
  std::vector<int> all;
  for (std::size_t i = 0; i < scene().objects.size(); ++i)
    if (scene().objects[i].is_dynamic && scene().objects[i].is_visible) all.push_back(int(i));
  // Parked cars may move, too, where a visitor grabs them: those that do come first, alone.
  std::vector<int> moving = all;
  std::erase_if(moving, [this](int i) {
    const auto before = first_places_.find(scene().objects[std::size_t(i)].name);
    return before == first_places_.end() ||
           before->second == scene().objects[std::size_t(i)].world_from_model[3];
  });
  return moving.empty() ? all : moving;
}

void Visit::follow(int object) {
  followed_ = object;
  set_mode(Mode::follow);
}

void Visit::follow_next_vehicle() {
  const std::vector<int> all = vehicles();
  if (all.empty()) return notice("nothing in this scene moves");
  const auto next = std::upper_bound(all.begin(), all.end(), followed_);
  follow(next == all.end() ? all.front() : *next);
  notice("following " + scene().objects[std::size_t(followed_)].name);
}

void Visit::look_from(const std::string& camera) {
  if (const scene::Node* node = live().find(camera); node && node->schema->type == "camera")
    return report(stage_.simulation().clock.send(*node, "look"), "");
  const Result<Camera> found = stage_.camera(camera);
  if (!found) return notice_error(to_string(found.errors()));
  actions().release_view();
  navigation_.go_to(*found);
}

void Visit::fly_to(const Camera& camera, std::optional<Mode> arrives_in) {
  constexpr float flight_s = 1.5f;
  actions().release_view();
  navigation_.fly_to(camera, flight_s, arrives_in);
}

void Visit::start_tour(const std::string& name) {
  if (const Result<double> length_s = actions().start_tour(name); !length_s)
    notice_error(to_string(length_s.errors()));
}

void Visit::show_scenario(const std::string& name) {
  report(stage_.choose_scenario(name), name.empty() ? "the base scene" : "scenario " + name);
}

void Visit::show_next_scenario() {
  const std::vector<const scene::Node*> scenarios = live().scenarios();
  if (scenarios.empty()) return notice("this scene has no scenarios");
  std::size_t next = 0;
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    if (scenarios[i]->text("name") == live().scenario()) next = i + 1;
  show_scenario(next < scenarios.size() ? scenarios[next]->text("name") : "");
}

const scene::Node* Visit::node_at(glm::ivec2 pixel) {
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= stage_.width() || pixel.y >= stage_.height()) return nullptr;
  const render::ObjectPicture objects =
      stage_.renderer().pick(camera(), stage_.width(), stage_.height(), false);
  const std::uint32_t object_and_one = *objects.at(pixel.x, pixel.y);
  return object_and_one == 0 ? nullptr : live().maker_of(scene(), int(object_and_one) - 1);
}

void Visit::probe(glm::ivec2 pixel) {
  notice(to_string(stage::probe(scene(), camera(), {stage_.width(), stage_.height()}, pixel), scene()));
}

Status Visit::tell(const scene::Node& node, const std::string& message) {
  return stage_.simulation().clock.send(node, message);
}

Status Visit::tell(const scene::Node& node, const scene::AttributeSchema& attribute,
                   scene::AttributeValue value) {
  return stage_.simulation().clock.send(node, attribute, std::move(value));
}

void Visit::set(const char* type, const char* attribute, scene::AttributeValue value) {
  live().set(live().unique_node(type), attribute, std::move(value));
}

void Visit::set_sun(float azimuth_deg, float elevation_deg) {
  set("sun", "azimuth_deg", double(glm::radians(azimuth_deg)));
  set("sun", "elevation_deg", double(glm::radians(elevation_deg)));
}

void Visit::set_day(int day_of_year) { set("dayLight", "julianDay", long(day_of_year)); }

void Visit::set_hour(double hour) { set("dayLight", "timeOfDay", hour); }

double Visit::exposure() const {
  if (!day_light()) return double(scene().exposure);
  const scene::Node* chosen = live().find("%exposure");
  return chosen ? chosen->number("value") : 1.0;
}

void Visit::set_exposure(double exposure) { set("exposure", "value", exposure); }

void Visit::set_realism(double level) { set("realism", "level", std::clamp(level, 0.0, 1.0)); }

void Visit::step_realism(int steps) {
  const double last = double(realism_names.size() - 1);
  const double now = last * double(scene().data<scene::Realism>().level);
  constexpr double rounding = 1e-3;
  const double next =
      std::clamp(steps > 0 ? std::floor(now + rounding) + 1.0 : std::ceil(now - rounding) - 1.0, 0.0, last);
  set_realism(next / last);
  notice(realism_names[std::size_t(next)]);
}

void Visit::set_reflection(const std::string& method) { set("reflection", "method", method); }

std::vector<action::Process*> Visit::processes() const {
  std::vector<action::Process*> all = stage_.simulation().clock.processes();
  std::erase_if(all, [](const action::Process* process) { return process->status().empty(); });
  return all;
}

bool Visit::is_halted() const {
  const std::vector<action::Process*> all = processes();
  return !all.empty() && std::ranges::all_of(all, [&](const action::Process* process) {
    return stage_.simulation().clock.is_paused(*process);
  });
}

void Visit::halt(bool halts) {
  for (const action::Process* process : processes()) stage_.simulation().clock.pause(*process, halts);
}

void Visit::step_halted() {
  halt(true);
  for (action::Process* process : processes())
    stage_.simulation().clock.step_alone(scene(), *process, halted_step_s);
}

void Visit::take_picture() {
  const Result<std::filesystem::path> file = write_numbered(
      pictures_.folder, pictures_.name,
      [this](const std::filesystem::path& path) { return write_image(path, stage_.whole_picture()); });
  if (file)
    notice("picture " + file->string());
  else
    notice_error(to_string(file.errors()));
}

void Visit::report(const Status& status, const std::string& done) {
  if (!status)
    notice_error(to_string(status.errors()));
  else if (!done.empty())
    notice(done);
}

void Visit::notice(std::string text) { add_notice({std::move(text), false, time_s_ + notice_s}); }

void Visit::notice_error(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  add_notice({std::move(text), true, time_s_ + error_notice_s});
}

/// Another word of the same takes the place of the first.
void Visit::add_notice(Notice notice) {
  std::erase_if(notices_, [&](const Notice& each) { return each.text == notice.text; });
  if (notices_.size() == max_notices) notices_.erase(notices_.begin());
  notices_.push_back(std::move(notice));
}

}  // namespace parvis::viewer
