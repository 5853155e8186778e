#include "scene/action/actions.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/known_names.h"

namespace parvis::action {
namespace {

using scene::Node, scene::Scene;

bool is_running(const Node& node) { return node.flag("running"); }

double length_of(const Node& node) { return node.children.back().number("time_s"); }

/// Period after which a path or tour repeats, seconds; 0: it does not.
double period_of(const Node& node) { return node.flag("loop") ? length_of(node) : 0.0; }

/// The place, view and lens of a camera without roll.
Keyframe keyframe_of(const Camera& camera, double time_s) {
  const glm::vec3 forward = camera.forward_in_world(), right(camera.world_from_camera[0]);
  return {time_s, camera.position_in_world(), std::atan2(-right.y, right.x),
          std::asin(std::clamp(forward.z, -1.0f, 1.0f)), camera.vertical_fov};
}

Camera camera_of(const Keyframe& key, const Camera& lens) {
  Camera camera = lens;
  const glm::mat4 upright =
      glm::rotate(glm::mat4(1.0f), glm::half_pi<float>() + key.pitch, glm::vec3(1, 0, 0));
  camera.world_from_camera = glm::translate(glm::mat4(1.0f), key.position) *
                             glm::rotate(glm::mat4(1.0f), -key.heading, glm::vec3(0, 0, 1)) * upright;
  camera.vertical_fov = key.field_of_view;
  return camera;
}

}  // namespace

void Actions::begin(Scene& scene, SharedByProcesses& shared) {
  shared_ = &shared;
  edits_ = live().edits();
  for (const Node& node : live().nodes()) read(node);
  for (const Motion& motion : motions_)
    for (const int object : live().objects_of(*motion.target))
      scene.objects[std::size_t(object)].is_dynamic = true;
  for (const Timer& timer : timers_)
    if (is_running(*timer.node)) fire_marks(timer);
  for (const Motion& motion : motions_)
    if (is_running(*motion.node)) fire_marks(motion);
}

std::vector<Actions::Trigger> Actions::triggers(const Node& node, const std::string& name) const {
  std::vector<Trigger> all;
  for (const scene::NodeAttribute& attribute : node.attributes) {
    if (attribute.schema->name != name) continue;
    const auto& event = std::get<scene::Event>(attribute.value);
    const Node* target = live().find(event.target);
    Result<scene::Message> message = parse_message(*target->schema, event.message, attribute.where);
    assert(message && "the checker lets only messages through that nodes take");
    const double mark = attribute.schema->source == scene::AttributeType::number ||
                                attribute.schema->source == scene::AttributeType::integer
                            ? std::strtod(event.source.c_str(), nullptr)
                            : 0.0;
    all.push_back({event.source, mark, event.delay_s, {target, *std::move(message), attribute.where, 0}});
  }
  return all;
}

void Actions::read(const Node& node) {
  const std::string& type = node.schema->type;
  const auto append = [](std::vector<Trigger>& to, std::vector<Trigger> from) {
    std::move(from.begin(), from.end(), std::back_inserter(to));
  };
  if (type == "keys") {
    append(on_press_, triggers(node, "onPress"));
    append(on_release_, triggers(node, "onRelease"));
  } else if (type == "timer" && running_.insert(&node).second) {
    timers_.push_back({&node, Clock(node.number("period_s")), triggers(node, "onTime")});
  } else if (type == "path" && running_.insert(&node).second) {
    read_motion(node);
  } else if (type == "tour" && running_.insert(&node).second) {
    tours_.push_back({&node, Clock(period_of(node)), node.flag("smooth")});
  } else if (type == "proximity") {
    for (const bool is_entry : {true, false})
      for (Trigger& trigger : triggers(node, is_entry ? "onEnter" : "onLeave"))
        watches_.push_back({&node, std::move(trigger), is_entry, false});
  }
  for (const Node& child : node.children) read(child);
}

/// Nodes have come or gone. What runs goes on.
void Actions::follow_nodes() {
  if (std::exchange(edits_, live().edits()) == live().edits()) return;
  const auto is_gone = [this](const auto& thing) { return !live().holds(*thing.node); };
  std::erase_if(timers_, is_gone), std::erase_if(tours_, is_gone), std::erase_if(motions_, is_gone);
  std::erase_if(running_, [this](const Node* node) { return !live().holds(*node); });
  on_press_.clear(), on_release_.clear();
  const std::vector<Watch> watches = std::exchange(watches_, {});
  for (const Node& node : live().nodes()) read(node);
  for (Watch& watch : watches_)
    for (const Watch& before : watches)
      if (before.node == watch.node && before.is_entry == watch.is_entry &&
          before.trigger.source == watch.trigger.source)
        watch.is_inside = before.is_inside;
}

void Actions::read_motion(const Node& node) {
  const Node& target = *live().find(node.text("of"));
  Motion motion{&node,
                &target,
                Clock(period_of(node)),
                {},
                triggers(node, "onPass"),
                false,
                false,
                node.flag("smooth"),
                node.flag("along"),
                target.angle("heading_deg")};
  for (const Node& key : node.children) {
    motion.keys.push_back(
        {key.number("time_s"), key.vec3("position"), key.angle("heading_deg"), key.angle("pitch_deg")});
    motion.has_heading = key.gives("heading_deg"), motion.has_pitch = key.gives("pitch_deg");
  }
  motions_.push_back(std::move(motion));
}

bool Actions::uses_key(const std::string& key) const {
  const auto is_of_key = [&](const Trigger& trigger) { return trigger.source == key; };
  return std::any_of(on_press_.begin(), on_press_.end(), is_of_key) ||
         std::any_of(on_release_.begin(), on_release_.end(), is_of_key);
}

void Actions::fire(const Trigger& trigger) { shared_->queue.post(trigger.delivery, trigger.delay_s); }

void Actions::fire_marks(const Timer& timer) {
  for (const Trigger& trigger : timer.on_time)
    if (timer.clock.passed(trigger.mark)) fire(trigger);
}

void Actions::fire_marks(const Motion& motion) {
  for (const Trigger& trigger : motion.on_pass)
    if (motion.clock.passed(motion.keys[std::size_t(trigger.mark) - 1].time_s)) fire(trigger);
}

/// Starts, halts or resumes the thing among `things` that the message is for; false where it is for none.
template <class Things>
bool Actions::run(Things& things, const Node& node, const scene::Message& message) {
  for (auto& thing : things) {
    if (thing.node != &node) continue;
    const std::string& name = message.schema->name;
    if (name != "start" && name != "stop" && name != "resume") return false;
    live().set(node, "running", name != "stop");
    if (name == "start") {
      thing.clock.start();
      fire_marks(thing);
    }
    return true;
  }
  return false;
}

bool Actions::receive(Scene& scene, const Node& node, const scene::Message& message) {
  const std::string &type = node.schema->type, &name = message.schema->name;
  if (run(timers_, node, message) || run(motions_, node, message) || run(tours_, node, message)) return true;
  if (type == "camera" && name == "look") {
    stop_tours();
    camera_ = node.text("name");
    return true;
  }
  if (type == "scenario" && name == "choose") {
    if (Status status = live().choose(scene, node.text("name")); !status) warn(status.errors());
    return true;
  }
  return false;
}

/// Where the visitor is, or a node, or an object that another room put into the scene.
std::optional<glm::vec3> Actions::place_of(const std::string& source, const Scene& scene,
                                           const std::optional<glm::vec3>& visitor) const {
  if (source == "visitor") return visitor;
  if (const Node* node = live().find(source)) {
    for (const int index : live().objects_of(*node))
      if (const scene::Object& object = scene.objects[std::size_t(index)]; object.is_visible)
        return glm::vec3(object.world_from_model[3]);
    if (!node->schema->find("position")) return std::nullopt;
    return glm::vec3(live().frame_of(*node).world_from_nodes * glm::vec4(node->vec3("position"), 1.0f));
  }
  for (const scene::Object& object : scene.objects)
    if (object.is_visible && object.name == source) return glm::vec3(object.world_from_model[3]);
  return std::nullopt;
}

void Actions::look(const Scene& scene, const Observer& observer) {
  for (Watch& watch : watches_) {
    const glm::vec3 centre =
        live().frame_of(*watch.node).world_from_nodes * glm::vec4(watch.node->vec3("position"), 1);
    const std::optional<glm::vec3> place = place_of(watch.trigger.source, scene, observer.eye);
    const bool is_inside = place && glm::distance(*place, centre) <= float(watch.node->number("radius_m"));
    if (is_inside != watch.is_inside && is_inside == watch.is_entry) fire(watch.trigger);
    watch.is_inside = is_inside;
  }
}

/// Puts what paths move to where it is then.
void Actions::present(Scene&, double ahead_s) {
  ahead_s_ = ahead_s;
  for (const Motion& motion : motions_) {
    if (!is_running(*motion.node)) continue;
    const double time_s = motion.clock.time_s(ahead_s);
    const Keyframe key = between(motion.keys, time_s, motion.is_smooth);
    const bool is_camera = motion.target->schema->type == "camera";
    live().set(*motion.target, "position", key.position);
    if (is_camera && motion.target->gives("target")) continue;  // it keeps its eye on that
    float heading = key.heading, pitch = key.pitch;
    if (motion.looks_along) {
      const glm::vec3 direction = direction_at(motion.keys, time_s, motion.is_smooth);
      heading = is_camera ? std::atan2(direction.x, direction.y)
                          : motion.own_heading - std::atan2(direction.y, direction.x);
      pitch = std::asin(std::clamp(direction.z, -1.0f, 1.0f));
    }
    const auto set_angle = [&](const char* name, float angle) {
      live().set(*motion.target, name, double(angle));
    };
    if (motion.looks_along || motion.has_heading) set_angle("heading_deg", heading);
    if (is_camera && (motion.looks_along || motion.has_pitch)) set_angle("pitch_deg", pitch);
  }
}

void Actions::change_key(const std::string& key, double in_s, bool is_pressed) {
  key_changes_.push_back({key, shared_->queue.now() + std::lround(in_s / step_s), is_pressed});
}

void Actions::send_keys() {
  std::vector<KeyChange> later;
  for (const KeyChange& change : key_changes_) {
    if (change.step >= shared_->queue.now()) {
      later.push_back(change);
      continue;
    }
    for (const Trigger& trigger : change.is_pressed ? on_press_ : on_release_)
      if (trigger.source == change.key) fire(trigger);
  }
  key_changes_ = std::move(later);
}

void Actions::step(const Scene&) {
  follow_nodes();
  send_keys();
  const auto advance_all = [this](auto& things) {
    for (auto& thing : things) {
      if (!is_running(*thing.node)) continue;
      thing.clock.advance(step_s);
      fire_marks(thing);
    }
  };
  advance_all(timers_), advance_all(motions_), advance_all(tours_);
}

std::optional<Camera> Actions::view_of(const Tour& tour, const Scene& scene) const {
  std::vector<Keyframe> keys;
  std::optional<Camera> lens;
  for (const Node& stop : tour.node->children) {
    const scene::NamedCamera* named = scene.find_camera(stop.text("camera"));
    const Result<Camera> camera = scene.camera_now(*named);
    if (!camera) continue;  // it follows what is hidden now
    if (!lens) lens = *camera;
    keys.push_back(keyframe_of(*camera, stop.number("time_s")));
  }
  if (!lens) return std::nullopt;
  return camera_of(between(keys, tour.clock.time_s(ahead_s_), tour.is_smooth), *lens);
}

std::optional<Camera> Actions::camera(const Scene& scene) const {
  for (const Tour& tour : tours_)
    if (is_running(*tour.node)) return view_of(tour, scene);
  if (camera_.empty()) return std::nullopt;
  const scene::NamedCamera* named = scene.find_camera(camera_);
  if (!named) return std::nullopt;  // it has been removed
  const Result<Camera> camera = scene.camera_now(*named);
  return camera ? std::optional(*camera) : std::nullopt;
}

void Actions::stop_tours() {
  for (const Tour& tour : tours_)
    if (is_running(*tour.node)) live().set(*tour.node, "running", false);
}

void Actions::release_view() {
  stop_tours();
  camera_.clear();
}

Result<double> Actions::start_tour(const std::string& name) {
  std::vector<std::string> known;
  for (Tour& tour : tours_) {
    known.push_back(tour.node->text("name"));
    if (known.back() != name) continue;
    stop_tours();
    live().set(*tour.node, "running", true);
    tour.clock.start();
    return length_of(*tour.node);
  }
  return error("the scene has no tour \"{}\"{}", name, names_that_exist(name, known));
}

}  // namespace parvis::action
