#include "planning/planner/tool.h"

#include <algorithm>
#include <cmath>

#include "graphics/reference/camera_ray.h"
#include "life/vegetation/plant_drawable.h"
#include "life/vegetation/scene_plant.h"

namespace parvis::planner {
namespace {

using design::Names, design::PlacedObject;

constexpr double snap_px = 9.0, drag_px = 4.0, close_px = 10.0;
constexpr double heading_step_deg = 15.0;
constexpr double row_gap_m = 1.2;  // between objects of a row, at least

reference::Ray ray_of(const Pointer& pointer) {
  return reference::camera_ray(pointer.camera, pointer.size.x, pointer.size.y, glm::vec2(pointer.pixel));
}

/// Rounds to a tenth of a millimetre: things placed by hand are written with no more digits.
glm::dvec2 rounded(glm::dvec2 p) { return glm::round(p * 1e4) * 1e-4; }

double wrapped_deg(double degrees) { return degrees - 360.0 * std::floor(degrees / 360.0); }

/// Clockwise from north.
double bearing_deg(glm::dvec2 away) { return glm::degrees(std::atan2(away.x, away.y)); }

/// The pixel of a place in the pointer's picture; none: behind the eye.
std::optional<glm::dvec2> pixel_of(const Pointer& pointer, const glm::dvec3& place) {
  const glm::vec4 clip = pointer.camera.clip_from_camera(float(pointer.size.x) / float(pointer.size.y)) *
                         pointer.camera.camera_from_world() * glm::vec4(glm::vec3(place), 1.0f);
  if (clip.w <= 0.0f) return std::nullopt;
  return (glm::dvec2(clip) / double(clip.w) * glm::dvec2(0.5, -0.5) + 0.5) * glm::dvec2(pointer.size);
}

double distance_to_line(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * along);
}

glm::dvec3 rounded(glm::dvec3 p) { return glm::round(p * 1e4) * 1e-4; }

bool is_measured(const design::Change& change) {
  const scene::Node& node = change.after ? *change.after : *change.before;
  return node.schema->type == design::measured_type;
}

void add_outline(const std::vector<glm::dvec2>& outline, SnapTargets& targets) {
  for (std::size_t i = 0; i < outline.size(); ++i)
    targets.lines.push_back({outline[i], outline[(i + 1) % outline.size()]});
}

}  // namespace

Tool::Tool(const scene::Scene& scene, const scene::LiveScene& live, design::Session& session,
           design::SceneSurfaces& surfaces)
    : scene_(scene), live_(live), session_(session), surfaces_(surfaces), preview_(scene, live) {}

const scene::Node* Tool::object_at(int object) const {
  const scene::Node* design = session_.design();
  if (!design || object < 0) return nullptr;
  if (std::size_t(object) < scene_.objects.size()) {
    for (const scene::Node& node : design->children)
      if (std::ranges::count(live_.objects_of(node), object) > 0) return &node;
    return nullptr;
  }
  const scene::Node* found = nullptr;
  const std::string plants = vegetation::traced_plants().name;
  scene::for_each_traced_kind(scene_, [&](const scene::TracedKind& kind, int first_thing) {
    const std::vector<int>& makers = scene_.data<vegetation::ScenePlants>().makers;
    const auto plant = std::size_t(object - first_thing);
    if (kind.name != plants || object < first_thing || plant >= makers.size()) return;
    for (const scene::Node& node : design->children)
      if (const scene::NodeRange range = live_.range_of(node);
          makers[plant] >= range.first && makers[plant] <= range.last)
        found = &node;
  });
  return found;
}

void Tool::settle() {
  if (unsettled_.empty()) return;
  unsettled_.clear();
  show(command_now());
}

/// Runs a command; what it has brought or moved stays in the picture as it was held.
Status Tool::run(const design::Command& command) {
  const Status status = session_.run(command);
  if (!status) return status;
  for (const design::Change& change : session_.done().back().changes)
    if (change.after && !is_measured(change) &&
        std::ranges::count(unsettled_, change.after->text("name")) == 0)
      unsettled_.push_back(change.after->text("name"));
  show(std::nullopt);
  return status;
}

void Tool::give_up() {
  action_ = Action::none;
  is_pressed_ = follows_click_ = copies_ = false;
  moved_ = {}, turned_deg_ = 0.0, factor_ = 1.0;
  typed_.clear(), refusal_.clear();
  snapped_ = {};
  show(std::nullopt);
}

void Tool::choose(Mode mode) {
  give_up();
  points_.clear(), kind_.clear();
  placed_at_.reset();
  mode_ = mode;
}

void Tool::choose_measure() {
  const bool continues = mode_ == Mode::measure;
  choose(Mode::measure);
  if (continues) quantity_ = design::Quantity((std::size_t(quantity_) + 1) % design::quantity_names().size());
}

void Tool::choose_kind(const std::string& kind) {
  choose(Mode::insert);
  kind_ = kind;
}

void Tool::leave() {
  if (is_pressed_ || action_ != Action::none) return;
  place_.reset(), pointed_.clear();
  show(std::nullopt);
}

std::optional<glm::dvec3> Tool::on_level(const Pointer& pointer, double height_m) const {
  const reference::Ray ray = ray_of(pointer);
  const double fall = double(ray.direction.z);
  if (std::abs(fall) < 1e-4) return std::nullopt;
  const double along = (height_m - double(ray.origin.z)) / fall;
  if (along <= 0.0 || along > 5000.0) return std::nullopt;
  return glm::dvec3(ray.origin) + along * glm::dvec3(ray.direction);
}

/// Metres that some pixels of the picture cover at a place.
double Tool::snap_within_m(const Pointer& pointer, glm::dvec3 at) const {
  const double pixel_at_1m = double(pointer.camera.height_at_1m()) / double(pointer.size.y);
  const double distance_m = pointer.camera.parallel
                                ? double(pointer.camera.parallel->distance_m)
                                : glm::distance(at, glm::dvec3(pointer.camera.position_in_world()));
  return snap_px * pixel_at_1m * distance_m;
}

SnapTargets Tool::targets(const Names& without) const {
  SnapTargets all;
  all.grid_m = grid_m;
  all.lines = plan_;
  for (const PlanSegment& line : plan_) all.ends.insert(all.ends.end(), line.begin(), line.end());
  for (const PlacedObject& object : session_.objects()) {
    if (std::ranges::count(without, object.name) > 0) continue;
    add_outline(object.outline, all);
    if (object.kind == "ground")
      all.ends.insert(all.ends.end(), object.outline.begin(), object.outline.end());
    else
      all.middles.emplace_back(object.position);
  }
  return all;
}

/// The point as it is held; `at` where nothing holds it.
glm::dvec3 Tool::snap_point(const Pointer& pointer, glm::dvec3 at, const Names& without,
                            const std::optional<glm::dvec2>& origin) {
  if (pointer.is_free) {
    snapped_ = {glm::dvec2(at), SnapKind::none, {}};
    return at;
  }
  SnapTargets all = targets(without);
  all.origin = origin;
  const glm::dvec2 wanted(at);
  std::ranges::sort(all.middles, {}, [&](glm::dvec2 p) { return glm::distance(p, wanted); });
  snapped_ = snap(wanted, all, snap_within_m(pointer, at), pointer.adds && origin);
  snapped_height_m_ = at.z;
  return {snapped_.at, at.z};
}

/// Where the first object that is selected stands.
glm::dvec3 Tool::first_foot() const {
  return design::placed_object(scene_, *live_.find(session_.selected().front()), "").position;
}

design::Command Tool::move_by(glm::dvec2 by) const {
  const Names& names = session_.selected();
  if (copies_) return design::Duplicate{names, glm::dvec3(by, design::rests)};
  return design::Move{names, glm::dvec3(by, design::rests)};
}

/// The command that a click, or letting go, would give now.
std::optional<design::Command> Tool::command_now() const {
  switch (action_) {
    case Action::move: {
      glm::dvec2 by = moved_;
      if (!typed_.empty() && glm::length(by) > 0.0) by = glm::normalize(by) * std::atof(typed_.c_str());
      return move_by(rounded(by));
    }
    case Action::turn:
      return design::Turn{session_.selected(), typed_.empty() ? turned_deg_ : std::atof(typed_.c_str())};
    case Action::resize:
      return design::Resize{session_.selected(), typed_.empty() ? factor_ : std::atof(typed_.c_str())};
    case Action::point:
      if (session_.selected().empty()) return std::nullopt;
      return design::MovePoint{session_.selected().front(), pointed_end_ + 1, rounded(end_at_)};
    case Action::box:
      return std::nullopt;
    case Action::none:
      break;
  }
  if (mode_ != Mode::insert || kind_.empty() || !place_ || placed_at_) return std::nullopt;
  const bool is_row = is_pressed_ && pressed_place_ &&
                      glm::distance(pointer_.pixel, pressed_.pixel) > drag_px &&
                      glm::distance(glm::dvec2(*place_), glm::dvec2(*pressed_place_)) > 0.3;
  if (!is_row) {
    design::Insert insert{kind_, glm::dvec3(rounded(glm::dvec2(*place_)), design::rests), heading_deg_};
    return insert;
  }
  const design::Kind* kind = design::find_kind(scene_, kind_);
  design::Row row{kind_, rounded(glm::dvec2(*pressed_place_)), rounded(glm::dvec2(*place_))};
  const double step_m = (kind ? kind->size_m.x : 1.0) + row_gap_m;
  row.count = std::max(2, 1 + int(glm::distance(row.from, row.to) / step_m));
  return row;
}

void Tool::show(const std::optional<design::Command>& command) {
  refusal_.clear();
  Errors refusals;
  design::Changes changes;
  if (command) {
    Result<design::Changes> made = design::changes_of(design_view(), *command, &refusals);
    if (made)
      changes = *std::move(made);
    else
      refusals = made.errors();
  }
  if (!refusals.empty()) refusal_ = refusals.front().message;
  held_.clear();
  for (const design::Change& change : changes)
    if (is_measured(change) && change.after)
      held_.push_back(design::measurement(*change.after, session_.name()));
  std::erase_if(changes, is_measured);
  const std::size_t refused = refusals.empty() ? 0 : changes.size();
  for (const std::string& name : unsettled_) {
    const scene::Node* node = live_.find(name);
    const bool moves = std::ranges::any_of(changes, [&](const design::Change& change) {
      return change.before && change.before->text("name") == name;
    });
    if (node && !moves) changes.push_back({*node, *node, {}});
  }
  if (const Status status = preview_.show(changes, session_.design(), refused); !status)
    refusal_ = status.errors().front().message;
}

void Tool::point_for_insertion(const Pointer& pointer) {
  constexpr double same_click_px = 3.0;  // what was placed there does not hang there, too
  if (placed_at_ && glm::distance(*placed_at_, pointer.pixel) >= same_click_px) placed_at_.reset();
  if (!place_) return show(std::nullopt);
  const std::optional<glm::dvec2> from =
      is_pressed_ && pressed_place_ ? std::optional(glm::dvec2(*pressed_place_)) : std::nullopt;
  place_ = snap_point(pointer, *place_, {}, from);
  if (mode_ == Mode::insert) show(command_now());
}

void Tool::point_for_action(const Pointer& pointer) {
  if (action_ == Action::move) {
    const std::optional<glm::dvec3> now = on_level(pointer, grabbed_.z);
    if (!now) return;
    copies_ = pointer.copies;
    const glm::dvec3 wanted = anchor_ + *now - grabbed_;
    const glm::dvec3 held = snap_point(pointer, wanted, session_.selected(), glm::dvec2(anchor_));
    moved_ = glm::dvec2(held - anchor_);
  } else if (action_ == Action::point) {
    const auto below = surfaces_.first_along(ray_of(pointer));
    if (!below) return;
    place_ = below->position;
    end_at_ = snap_point(pointer, *place_, {}, std::nullopt);
  } else if (action_ == Action::turn) {
    const std::optional<glm::dvec3> now = on_level(pointer, anchor_.z);
    if (!now) return;
    const double from = bearing_deg(glm::dvec2(grabbed_ - anchor_)),
                 to = bearing_deg(glm::dvec2(*now - anchor_));
    turned_deg_ = wrapped_deg(to - from);
    if (turned_deg_ > 180.0) turned_deg_ -= 360.0;
    const double step = pointer.is_free ? 0.1 : heading_step_deg;
    turned_deg_ = std::round(turned_deg_ / step) * step;
  } else if (action_ == Action::resize) {
    const std::optional<glm::dvec3> now = on_level(pointer, anchor_.z);
    const double before = glm::distance(glm::dvec2(grabbed_), glm::dvec2(anchor_));
    if (!now || before < 1e-3) return;
    factor_ = std::clamp(glm::distance(glm::dvec2(*now), glm::dvec2(anchor_)) / before, 0.05, 20.0);
    if (!pointer.is_free) factor_ = std::round(factor_ * 20.0) / 20.0;
  }
  show(command_now());
}

void Tool::point(const Pointer& pointer) {
  pointer_ = pointer;
  if (is_pressed_ && action_ == Action::none && mode_ == Mode::select && !session_.selected().empty() &&
      glm::distance(pointer.pixel, pressed_.pixel) > drag_px) {
    action_ = pointed_end_ >= 0 ? Action::point : Action::move;
    anchor_ = first_foot();
    grabbed_ = pressed_place_.value_or(glm::dvec3(0.0));
  }
  if (action_ == Action::box) return;
  if (action_ != Action::none) return point_for_action(pointer);
  const auto below = surfaces_.first_along(ray_of(pointer));
  place_ = below ? std::optional(below->position) : std::nullopt;
  const scene::Node* node = below ? object_at(below->object) : nullptr;
  pointed_ = node && mode_ == Mode::select ? node->text("name") : "";
  if (!is_pressed_) point_at_measurement(pointer);
  snapped_ = {};
  if (mode_ != Mode::select) point_for_insertion(pointer);
}

/// Measurements are drawn over all else, and are taken first: a point of one, or its line.
void Tool::point_at_measurement(const Pointer& pointer) {
  constexpr double line_px = 5.0;
  pointed_end_ = -1;
  if (mode_ != Mode::select) return;
  double nearest = snap_px;
  std::string on_line;
  for (const design::Measurement& each : own_measurements()) {
    for (std::size_t i = 0; i < each.points.size(); ++i) {
      const std::optional<glm::dvec2> at = pixel_of(pointer, each.points[i]);
      if (!at || glm::distance(*at, pointer.pixel) >= nearest) continue;
      nearest = glm::distance(*at, pointer.pixel);
      pointed_ = each.name, pointed_end_ = int(i);
    }
    const std::vector<glm::dvec3> line = each.line();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const std::optional<glm::dvec2> a = pixel_of(pointer, line[i]), b = pixel_of(pointer, line[i + 1]);
      if (a && b && distance_to_line(pointer.pixel, *a, *b) < line_px) on_line = each.name;
    }
  }
  if (pointed_end_ < 0 && !on_line.empty()) pointed_ = on_line;
}

bool Tool::press(const Pointer& pointer) {
  if (follows_click_) return is_pressed_ = true;
  point(pointer);
  pressed_ = pointer, pressed_place_ = place_;
  if (mode_ != Mode::select) return is_pressed_ = place_.has_value();
  if (pointed_.empty()) {
    const bool draws_box = pointer.camera.parallel || pointer.is_free;
    if (draws_box) action_ = Action::box;
    return is_pressed_ = draws_box;
  }
  Names names = session_.selected();
  const bool is_selected = std::ranges::count(names, pointed_) > 0;
  if (pointer.adds) {
    if (is_selected)
      std::erase(names, pointed_);
    else
      names.push_back(pointed_);
    session_.select(names);
    return is_pressed_ = true;
  }
  if (pointed_end_ >= 0) names.clear();
  if (is_selected && pointed_end_ < 0) return is_pressed_ = true;
  names = {pointed_};
  const std::string group = live_.find(pointed_)->text("group");
  for (const PlacedObject& object : session_.objects())
    if (!group.empty() && object.group == group && object.name != pointed_) names.push_back(object.name);
  session_.select(names);
  return is_pressed_ = true;
}

Status Tool::finish() {
  const std::optional<design::Command> command = command_now();
  give_up();
  if (!command) return Ok{};
  return run(*command);
}

void Tool::select_in_box(const Pointer& pointer) {
  const glm::dvec2 low = glm::min(pressed_.pixel, pointer.pixel),
                   high = glm::max(pressed_.pixel, pointer.pixel);
  if (glm::distance(low, high) < drag_px) return session_.select({});
  Names names = pointer.adds ? session_.selected() : Names{};
  for (const PlacedObject& object : session_.objects()) {
    const std::optional<glm::dvec2> at = pixel_of(pointer, object.position);
    if (!at || !object.is_visible) continue;
    const bool is_inside = at->x >= low.x && at->y >= low.y && at->x <= high.x && at->y <= high.y;
    if (is_inside && std::ranges::count(names, object.name) == 0) names.push_back(object.name);
  }
  session_.select(names);
}

Status Tool::release(const Pointer& pointer) {
  if (!is_pressed_) return Ok{};
  point(pointer);
  is_pressed_ = false;
  if (action_ == Action::box) {
    select_in_box(pointer);
    give_up();
    return Ok{};
  }
  if (action_ != Action::none) return finish();
  if (mode_ == Mode::insert) {
    is_pressed_ = pressed_place_.has_value();  // a row reaches from where the button was pressed
    const std::optional<design::Command> command = command_now();
    is_pressed_ = false;
    if (command) {
      placed_at_ = pointer.pixel;
      return run(*command);
    }
    show(std::nullopt);
    return Ok{};
  }
  if (mode_ == Mode::select || !place_) return Ok{};
  const bool closes =
      draws_outline() && points_.size() > 2 &&
      glm::distance(*place_, points_.front()) < snap_within_m(pointer, *place_) * close_px / snap_px;
  if (closes) return finish_points();
  points_.push_back(rounded(*place_));
  return mode_ == Mode::measure && !draws_outline() && points_.size() == 2 ? finish_points() : Status(Ok{});
}

/// Makes a surface or a measurement of the points that were clicked.
Status Tool::finish_points() {
  const std::vector<glm::dvec3> points = std::exchange(points_, {});
  if (mode_ == Mode::surface) return session_.run(design::Surface{surface_material, points});
  return session_.run(design::Measure{design::quantity_names()[std::size_t(quantity_)], points});
}

bool Tool::cancel() {
  if (action_ != Action::none || is_pressed_) {
    give_up();
    return true;
  }
  if (!points_.empty()) {
    points_.clear();
    return true;
  }
  if (mode_ != Mode::select) {
    choose(Mode::select);
    return true;
  }
  if (session_.selected().empty()) return false;
  session_.select({});
  return true;
}

Status Tool::begin(Action action) {
  if (session_.selected().empty()) return error("nothing is selected: click an object first");
  give_up();
  anchor_ = first_foot();
  action_ = action;
  follows_click_ = true;
  grabbed_ = on_level(pointer_, anchor_.z).value_or(anchor_ + glm::dvec3(0.0, 1.0, 0.0));
  return Ok{};
}

Status Tool::turn(double degrees) {
  if (mode_ == Mode::insert) {
    heading_deg_ = wrapped_deg(heading_deg_ + degrees);
    point(pointer_);
    return Ok{};
  }
  if (session_.selected().empty()) return error("nothing is selected: click an object first");
  return session_.run(design::Turn{session_.selected(), degrees});
}

Status Tool::nudge(const Camera& camera, double right_m, double ahead_m) {
  if (session_.selected().empty()) return error("nothing is selected: click an object first");
  // In a plan the picture's up is ahead; elsewhere the direction of view. North, east, south or west.
  const glm::vec3 ahead =
      camera.parallel ? glm::vec3(camera.world_from_camera[1]) : camera.forward_in_world();
  const glm::dvec2 axis = std::abs(ahead.x) > std::abs(ahead.y)
                              ? glm::dvec2(ahead.x > 0.0f ? 1.0 : -1.0, 0.0)
                              : glm::dvec2(0.0, ahead.y > 0.0f ? 1.0 : -1.0);
  const glm::dvec2 right(axis.y, -axis.x);
  anchor_ = first_foot();
  copies_ = false;
  return session_.run(move_by(rounded(right_m * right + ahead_m * axis)));
}

bool Tool::type(char character) {
  if (action_ != Action::move && action_ != Action::turn && action_ != Action::resize) return false;
  if (character == '\b') {
    if (!typed_.empty()) typed_.pop_back();
  } else if ((character >= '0' && character <= '9') || character == '-') {
    typed_ += character;
  } else if (character == '.' || character == ',') {
    typed_ += '.';
  } else {
    return false;
  }
  show(command_now());
  return true;
}

Status Tool::confirm() {
  if (action_ != Action::none) return finish();
  if (draws_outline() && points_.size() > 2) return finish_points();
  return Ok{};
}

std::vector<Dimension> Tool::dimensions() const {
  std::vector<Dimension> all;
  if (action_ != Action::move) return all;
  const glm::dvec3 now = anchor_ + glm::dvec3(moved_, 0.0);
  if (glm::length(moved_) > 0.0) all.push_back({anchor_, now});
  // To the two objects that stand nearest.
  std::vector<glm::dvec3> others;
  for (const PlacedObject& object : session_.objects())
    if (object.kind != "ground" && std::ranges::count(session_.selected(), object.name) == 0)
      others.push_back(object.position);
  std::ranges::sort(others, {}, [&](glm::dvec3 p) { return glm::distance(p, now); });
  for (std::size_t i = 0; i < std::min<std::size_t>(2, others.size()); ++i) all.push_back({now, others[i]});
  return all;
}

/// Those of the open design that are shown.
std::vector<design::Measurement> Tool::own_measurements() const {
  return design::measurements(live_, session_.name(), true);
}

std::vector<design::Measurement> Tool::measurements() const {
  std::vector<design::Measurement> all = own_measurements();
  for (const design::Measurement& held : held_) {
    const auto same = std::ranges::find(all, held.name, &design::Measurement::name);
    if (same == all.end())
      all.push_back(held);
    else
      same->points = held.points;
  }
  if (mode_ != Mode::measure || points_.empty() || !place_) return all;
  design::Measurement drawn{{}, session_.name(), quantity_, points_};
  drawn.points.push_back(*place_);
  all.push_back(std::move(drawn));
  return all;
}

std::vector<glm::dvec3> Tool::corners() const {
  if (mode_ != Mode::surface) return {};
  std::vector<glm::dvec3> all = points_;
  if (place_ && !all.empty()) all.push_back(*place_);
  return all;
}

std::optional<std::array<glm::dvec2, 2>> Tool::box() const {
  if (action_ != Action::box) return std::nullopt;
  return std::array{pressed_.pixel, pointer_.pixel};
}

const char* Tool::hint() const {
  if (action_ == Action::point) return "Let go where the end shall be. Esc takes it back.";
  if (action_ != Action::none && action_ != Action::box)
    return follows_click_ ? "Move the pointer and click, or type a distance and Enter. Esc takes it back."
                          : "Let go where it shall stand, or type a distance and Enter. Esc takes it back.";
  switch (mode_) {
    case Mode::insert:
      return "Click where it shall stand; drag for a row; Q and E turn it. Esc ends.";
    case Mode::measure:
      switch (quantity_) {
        case design::Quantity::distance:
          return "Click two points to measure from one to the other. M: an area.";
        case design::Quantity::area:
          return "Click the corners of the area; Enter or the first corner closes it. M: a height.";
        case design::Quantity::height:
          return "Click the foot, then the top: the height from one to the other. M: a slope.";
        case design::Quantity::slope:
          return "Click two points: the slope from one to the other. M: a distance.";
      }
      break;
    case Mode::surface:
      return "Click the corners of the surface; Enter or the first corner closes it.";
    case Mode::select:
      break;
  }
  return session_.objects().empty()
             ? "Press K for the catalogue."
             : "Click an object to select it; drag it to move it. Shift adds to the selection.";
}

}  // namespace parvis::planner
