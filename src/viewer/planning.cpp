#include "viewer/planning.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <glm/gtx/rotate_vector.hpp>
#include <utility>

#include "base/files.h"
#include "graphics/reference/camera_ray.h"
#include "planning/design/design_file.h"
#include "planning/design/own_kind.h"
#include "planning/plan_drawing/scene_plan.h"

namespace parvis::viewer {
namespace {

constexpr float eye_m = 1.7f;
constexpr float stands_before_wall_m = 0.35f;

std::string time_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm local{};
  localtime_r(&now, &local);
  return fmt::format("{:02}:{:02}:{:02}", local.tm_hour, local.tm_min, local.tm_sec);
}

/// A file beside the scene that is not there yet.
std::filesystem::path new_file(const std::filesystem::path& scene, const std::string& design) {
  for (int number = 1;; ++number) {
    const std::string suffix = number == 1 ? "" : fmt::format("-{}", number);
    const std::filesystem::path file =
        scene.parent_path() / fmt::format("{}-{}{}.xp", scene.stem().string(), design, suffix);
    std::error_code code;
    if (!std::filesystem::exists(file, code)) return file;
  }
}

/// Empty: there is no such file, or it cannot be read.
std::string text_of(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file);
  return text ? *text : std::string();
}

constexpr float shoulders_m = 0.3f, max_step_m = 0.4f, max_fall_m = 1.2f;

/// The side of a wall that a visitor meets on a way, horizontal; nothing: the way is free.
std::optional<glm::vec2> wall_on(design::SceneSurfaces& surfaces, glm::vec3 from, glm::vec2 way) {
  constexpr float aside = 0.7f;  // rad, about what shoulders sweep
  const float length_m = glm::length(way);
  for (const float turn : {0.0f, aside, -aside}) {
    const glm::vec3 ahead(glm::rotate(way / length_m, turn), 0.0f);
    for (const float above_feet_m : {0.6f, 1.3f}) {
      const glm::vec3 origin = from + glm::vec3(0.0f, 0.0f, above_feet_m - eye_m);
      const auto met = surfaces.first_along_lately({origin, ahead, 0.0f, length_m + shoulders_m});
      if (!met) continue;
      const glm::vec2 normal(met->normal);
      const glm::vec2 side = glm::length(normal) > 0.1f ? glm::normalize(normal) : -way / length_m;
      if (glm::dot(way, side) < -1e-3f * length_m) return side;  // else the way goes along it or leaves it
    }
  }
  return std::nullopt;
}

/// Walking keeps to the ground, climbs steps, and stops at walls or goes along them.
std::optional<glm::vec3> step_on_foot(design::SceneSurfaces& surfaces, glm::vec3 from, glm::vec3 to) {
  constexpr float shortest_m = 1e-6f;
  glm::vec2 way(to - from);
  if (glm::length(way) < shortest_m) return to;
  for (int corners = 0; const std::optional<glm::vec2> side = wall_on(surfaces, from, way); ++corners) {
    way -= std::min(glm::dot(way, *side), 0.0f) * *side;
    if (corners == 2 || glm::length(way) < 0.1f * glm::length(glm::vec2(to - from))) return std::nullopt;
  }
  const glm::vec3 reached(glm::vec2(from) + way, to.z);
  const glm::vec3 knees = reached + glm::vec3(0.0f, 0.0f, max_step_m - eye_m);
  const auto below = surfaces.first_along_lately({knees, {0.0f, 0.0f, -1.0f}, 0.0f, max_step_m + max_fall_m});
  if (!below) return reached;  // nothing to stand on: the eye keeps its height
  return glm::vec3(reached.x, reached.y, float(below->position.z) + eye_m);
}

}  // namespace

Planning::Planning(Visit& visit, design::Language language)
    : visit_(visit),
      language_(language),
      surfaces_(std::make_shared<design::SceneSurfaces>(visit.stage().simulation().scene)) {
  visit_.navigation().on_foot = [surfaces = surfaces_](glm::vec3 from, glm::vec3 to) {
    return step_on_foot(*surfaces, from, to);
  };
  for (const scene::Node* node : design::designs_of(visit_.live()))
    known_.try_emplace(node->where.file, text_of(node->where.file));
}

std::vector<std::string> Planning::designs() const {
  std::vector<std::string> names;
  for (const scene::Node* node : design::designs_of(visit_.live())) names.push_back(node->text("name"));
  return names;
}

/// Kerbs, walls and the lines of drawings, to which points are drawn. Of a large city the plan would take
/// seconds: there points are drawn to the objects of designs alone, with a notice.
const std::vector<planner::PlanSegment>& Planning::plan_lines() {
  constexpr std::size_t max_triangles = 1'000'000;
  std::size_t triangles = 0;
  for (const scene::Object& object : visit_.scene().objects) triangles += object.model->triangle_count();
  if (triangles > max_triangles)
    visit_.notice(word("so large a place: points snap to placed objects alone, not to walls and kerbs"));
  if (!plan_lines_.empty() || triangles > max_triangles) return plan_lines_;
  const plan_drawing::ScenePlan plan =
      plan_drawing::plan_of(visit_.scene(), design::placed_objects(visit_.scene(), visit_.live(), "", false));
  for (const plan_drawing::PlanLine& line : plan.lines)
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
      plan_lines_.push_back({glm::dvec2(line.points[i]), glm::dvec2(line.points[i + 1])});
  return plan_lines_;
}

/// False: it cannot be opened, and the one that was open stays.
bool Planning::open(const std::string& design, bool begins) {
  if (desk_) desk_->tool.choose(planner::Mode::select);
  if (const auto known = desks_.find(design); known != desks_.end() && !begins && !study) {
    desk_ = known->second.get();
    return true;
  }
  stage::Simulation& simulation = visit_.stage().simulation();
  const auto heights = [surfaces = surfaces_](glm::dvec2 at, const design::Names& without) {
    return surfaces->resting_height(at, without);
  };
  Result<design::Session> session =
      design::Session::open(simulation.scene, simulation.live(), design, heights, begins);
  if (!session) return tell(session.errors());
  const std::string name = session->name();
  desk_ = (desks_[name] = std::make_unique<Desk>(simulation, *std::move(session), *surfaces_)).get();
  desk_->tool.set_plan(plan_lines());
  if (study)
    desk_->session.set_witness(
        [this](const std::string& text, const Status& done) { study->note_command(text, done); });
  if (study || !keeps_files || simulation.scene.file.empty()) return true;
  const Result<std::string> restored =
      desk_->session.keep_journal(design::journal_file(simulation.scene.file, desk_->session.name()));
  if (!restored)
    visit_.notice_error(to_string(restored.errors()));
  else if (!restored->empty())
    visit_.notice(*restored);
  return true;
}

void Planning::turn_on(bool on) {
  if (on && !desk_) open("");
  is_on_ = on && desk_;
  if (!is_on_ && desk_) desk_->tool.choose(planner::Mode::select);
}

void Planning::open_design(const std::string& name) {
  if (!open(name)) return;
  for (const scene::Node* node : design::designs_of(visit_.live()))
    visit_.live().set(*node, "visible", node->text("name") == name);
}

void Planning::begin_design() {
  int number = 2;
  while (visit_.live().find(fmt::format("design_{}", number))) ++number;
  if (!open(fmt::format("design_{}", number), true)) return;
  for (const scene::Node* node : design::designs_of(visit_.live()))
    visit_.live().set(*node, "visible", false);
  visit_.notice(word("a new design: what is placed from here on belongs to it"));
}

void Planning::compare_with_next() {
  if (!desk_) return;
  std::vector<std::string> others = designs();
  std::erase(others, desk_->session.name());
  const auto now = std::ranges::find(others, compared_);
  const auto next = now == others.end() ? others.begin() : now + 1;
  compared_ = next == others.end() ? "" : *next;
  if (others.empty()) return visit_.notice_error("this scene has no other design");
  if (compared_.empty()) return;
  std::array<int, 4> counts{};
  for (const design::Difference& each : differences()) ++counts[std::size_t(each.how)];
  visit_.notice(fmt::format("{} -> {}: +{} -{}, {} {}, {} {}", compared_, desk_->session.name(), counts[0],
                            counts[1], counts[2], word("moved"), counts[3], word("changed")));
}

bool Planning::compares_pictures() const {
  return is_on_ && desk_ && !compared_.empty() && compared_ != desk_->session.name() &&
         desk_->session.design() && compared_view_ != ComparedView::colours;
}

void Planning::next_compared_view() {
  if (!desk_) return;
  if (compared_.empty() || compared_ == desk_->session.name()) {
    compare_with_next();
    compared_view_ = ComparedView::slider;
  } else {
    compared_view_ = ComparedView((std::size_t(compared_view_) + 1) % 3);
  }
  if (compared_.empty()) return;
  constexpr std::array words{"compared in colours", "drag the line between the designs", "side by side"};
  visit_.notice(word(words[std::size_t(compared_view_)]));
}

void Planning::draw_compared(int width, int height, GLuint framebuffer) {
  comparison_.draw(visit_.stage(), visit_.camera(), compared_, desk_->session.name(), compared_view_,
                   {width, height});
  comparison_.display(framebuffer, split_);
}

std::vector<design::Difference> Planning::differences() const {
  if (!desk_ || compared_.empty() || compared_ == desk_->session.name()) return {};
  return design::differences(design::placed_objects(visit_.scene(), visit_.live(), compared_),
                             desk_->session.objects());
}

void Planning::take_file(const std::filesystem::path& file) {
  if (!is_on_) turn_on(true);
  if (!desk_) return;
  const Result<design::OwnKind> kind =
      design::import_kind(visit_.stage().registries().get<formats::Readers>(), visit_.scene(), file);
  if (!kind) return visit_.notice_error(to_string(kind.errors()));
  if (!tell(desk_->session.run(design::Command(kind->command)))) return;
  visit_.notice(kind->note);
  shows_catalogue = true;
  desk_->tool.choose_kind(kind->command.name);
}

bool Planning::tell(const Status& status) {
  if (!status) visit_.notice_error(to_string(status.errors()));
  return status.ok();
}

bool Planning::run(const std::string& command) { return desk_ && tell(desk_->session.run(command)); }

bool Planning::group_selected() {
  return desk_ && run(fmt::format("group selected as group_{}", desk_->session.done().size() + 1));
}

void Planning::undo() {
  if (!desk_) return;
  desk_->tool.choose(planner::Mode::select);
  const std::string what = desk_->session.done().empty() ? "" : desk_->session.done().back().sentence;
  if (tell(desk_->session.undo())) visit_.notice(word("Undo") + ": " + what);
}

void Planning::redo() {
  if (desk_ && tell(desk_->session.redo()))
    visit_.notice(word("Redo") + ": " + desk_->session.done().back().sentence);
}

/// Who opens the saved script can undo as who goes on here.
void Planning::keep_steps_beside(const std::filesystem::path& file) {
  const auto journal = [&](const std::filesystem::path& script) {
    return design::journal_file(script, desk_->session.name());
  };
  const std::filesystem::path from = journal(visit_.scene().file);
  std::error_code code;
  if (std::filesystem::exists(from, code))
    std::filesystem::copy_file(from, journal(file), std::filesystem::copy_options::overwrite_existing, code);
  if (code)
    visit_.notice_error(fmt::format("{}: its steps could not be kept: {}", file.string(), code.message()));
}

void Planning::save() {
  if (!desk_ || study || !keeps_files) return;
  const std::filesystem::path scene = visit_.scene().file;
  if (scene.empty()) return visit_.notice_error("this scene has no file beside which the design could lie");
  const std::filesystem::path own = design::file_of(desk_->session);
  std::filesystem::path file = desk_->file.empty() ? own : desk_->file;
  // Another program's changes are not written over.
  const bool was_changed = !file.empty() && text_of(file) != known_[file];
  if (file.empty() || was_changed) file = new_file(scene, desk_->session.name());
  if (!tell(design::save(desk_->session, scene, file)) || !tell(desk_->session.note_saved())) return;
  desk_->file = file, known_[file] = text_of(file);
  if (file != own) keep_steps_beside(file);
  saved_at_ = time_now();
  visit_.notice(fmt::format(
      "{}{} {}", was_changed ? word("the script was changed elsewhere and stays as it is:") + " " : "",
      word("saved"), file.filename().string()));
}

void Planning::look(PlanningView view) {
  const Camera now = visit_.camera();
  constexpr std::array names{"plan", "street", "balcony"};
  if (study) study->note("view", names[std::size_t(view)]);
  waits_for_balcony_ = view == PlanningView::balcony;
  if (view == PlanningView::balcony) return;
  if (view == PlanningView::street) {
    if (!now.parallel && !stands_at_wall()) return;
    stood_at_wall_ = false;
    if (street_view_) return visit_.fly_to(*street_view_, Mode::walk);
    const Result<Camera> first = visit_.stage().camera("");
    if (first) visit_.fly_to(*first, Mode::walk);
    return;
  }
  if (now.parallel) return;
  if (!stands_at_wall()) street_view_ = now;
  stood_at_wall_ = false;
  // What the eye looks at becomes the middle of the plan.
  const reference::Ray ray{now.position_in_world(), now.forward_in_world()};
  const auto seen = surfaces_->first_along(ray);
  const double reach_m = seen ? std::min(60.0, glm::distance(seen->position, glm::dvec3(ray.origin))) : 20.0;
  const glm::vec3 middle = ray.origin + float(reach_m) * ray.direction;
  Camera plan;
  plan.parallel = ParallelView{std::max(24.0f, 1.6f * float(reach_m)), 300.0f};
  plan.world_from_camera =
      look_at({middle.x, middle.y, 300.0f}, {middle.x, middle.y, 0.0f}, {0.0f, 1.0f, 0.0f});
  visit_.fly_to(plan);
}

bool Planning::stand_at(const planner::Pointer& pointer) {
  const reference::Ray ray =
      reference::camera_ray(pointer.camera, pointer.size.x, pointer.size.y, glm::vec2(pointer.pixel));
  const auto place = surfaces_->first_along(ray);
  if (!place || std::abs(place->normal.z) > 0.5f) return false;
  waits_for_balcony_ = false;
  const glm::vec3 away = glm::normalize(glm::vec3(place->normal.x, place->normal.y, 0.0f));
  const glm::vec3 eye = glm::vec3(place->position) + stands_before_wall_m * away;
  if (!visit_.camera().parallel && !stands_at_wall()) street_view_ = visit_.camera();
  stood_at_wall_ = true;
  Camera camera;
  camera.vertical_fov = glm::radians(60.0f);
  camera.world_from_camera = look_at(eye, eye + away - glm::vec3(0.0f, 0.0f, 0.35f));
  visit_.set_mode(Mode::fly);
  visit_.fly_to(camera);
  return true;
}

/// Views are cameras of the design: they are saved with it, and commands may look from them.
std::string Planning::name_of_view(int number) const {
  return fmt::format("{}_view_{}", desk_->session.name(), number);
}

void Planning::keep_view(int number) {
  if (desk_ &&
      tell(desk_->session.run(design::Command(design::view_of(visit_.camera(), name_of_view(number))))))
    visit_.notice(fmt::format("{} {}", word("saved"), number));
}

void Planning::go_to_view(int number) {
  if (!desk_) return;
  if (const scene::NamedCamera* kept = visit_.scene().find_camera(name_of_view(number)))
    visit_.fly_to(kept->camera);
}

std::vector<int> Planning::kept_views() const {
  std::vector<int> numbers;
  for (int number = 1; desk_ && number <= 9; ++number)
    if (visit_.live().find(name_of_view(number))) numbers.push_back(number);
  return numbers;
}

void Planning::frame_selection() {
  if (!desk_ || desk_->session.selected().empty()) return;
  Bounds all;
  for (const design::PlacedObject& object : desk_->session.objects())
    if (std::ranges::count(desk_->session.selected(), object.name) > 0)
      for (const glm::dvec2 corner : object.outline) {
        all.add(glm::vec3(glm::vec2(corner), float(object.position.z)));
        all.add(glm::vec3(glm::vec2(corner), float(object.position.z + object.size_m.z)));
      }
  const float radius = std::max(all.radius(), 0.5f);
  Camera camera = visit_.camera();
  if (camera.parallel) {
    camera.parallel->height_m = 4.0f * radius;
    camera.world_from_camera[3] = glm::vec4(glm::vec2(all.centre()), camera.world_from_camera[3].z, 1.0f);
    return visit_.fly_to(camera);
  }
  const float away_m = 1.6f * radius / std::tan(0.5f * camera.vertical_fov);
  glm::vec3 ahead = camera.forward_in_world();
  ahead = glm::normalize(glm::vec3(ahead.x, ahead.y, std::min(ahead.z, -0.2f)));
  camera.world_from_camera = look_at(all.centre() - away_m * ahead, all.centre());
  visit_.fly_to(camera);
}

void Planning::step(float seconds, bool pointer_moves) {
  constexpr float settles_after_s = 0.7f;
  if (!is_on_) return;
  const glm::mat4 eye = visit_.camera().world_from_camera;
  const bool eye_moves = std::exchange(eye_, eye) != eye;
  quiet_s_ = pointer_moves ? 0.0f : quiet_s_ + seconds;
  if (eye_moves || quiet_s_ > settles_after_s) desk_->tool.settle();
}

void Planning::draw_held(int width, int height) {
  const design::Preview& preview = desk_->tool.preview();
  visit_.stage().draw_held(visit_.camera(), width, height, preview.what_stays(), preview.scene());
}

}  // namespace parvis::viewer
