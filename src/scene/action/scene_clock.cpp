#include "scene/action/scene_clock.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace parvis::action {

SceneClock::SceneClock(const Processes& processes, scene::LiveScene live, scene::Scene& scene)
    : shared_(std::make_unique<SharedByProcesses>()) {
  shared_->live = std::move(live);
  for (const Processes::Make& make : processes.makers()) entries_.push_back({make()});
  for (Entry& entry : entries_) entry.process->begin(scene, *shared_);
  present(scene, 0.0);
}

void SceneClock::advance(scene::Scene& scene, double seconds, const Observer& observer) {
  assert(seconds >= 0.0);
  due_s_ += seconds;
  // A millionth of a step makes up for what adding frame times loses.
  for (; due_s_ >= step_s * (1.0 - 1e-6); due_s_ -= step_s) step(scene, observer);
  due_s_ = std::max(due_s_, 0.0);
  // What the sums of different frame times differ by, less than a tenth of a microsecond, is not shown: a
  // second looks the same whichever way it was reached.
  present(scene, std::round(due_s_ * 1e7) * 1e-7);
}

void SceneClock::step(scene::Scene& scene, const Observer& observer) {
  shared_->queue.begin_step();
  for (Entry& entry : entries_)
    if (!entry.is_paused) entry.process->step(scene);
  if (std::ranges::any_of(entries_, [](const Entry& entry) { return entry.process->looks(); })) {
    present(scene, 0.0);
    for (Entry& entry : entries_) entry.process->look(scene, observer);
  }
  for (Delivery delivery; shared_->queue.next(delivery);) deliver(scene, delivery);
}

/// Products of nodes follow their attributes before processes that read it show the moment, and after those
/// that set attributes have done so.
void SceneClock::present(scene::Scene& scene, double ahead_s) {
  warn(shared_->live.refresh(scene));
  for (Entry& entry : entries_) {
    if (!entry.is_paused) entry.ahead_s = ahead_s;
    entry.process->present(scene, entry.ahead_s);
  }
  warn(shared_->live.refresh(scene));
}

void SceneClock::adapt(scene::Scene& scene, std::span<const glm::vec3> eyes) {
  for (Entry& entry : entries_) entry.process->adapt(scene, eyes);
}

void SceneClock::set_detail(float share) {
  for (Entry& entry : entries_) entry.process->set_detail(share);
}

void SceneClock::settle(scene::Scene& scene) {
  for (Entry& entry : entries_) entry.process->settle(scene);
}

void SceneClock::deliver(scene::Scene& scene, const Delivery& delivery) {
  const scene::Node& node = *delivery.target;
  if (!shared_->live.holds(node)) return;  // it has been removed since
  for (Entry& entry : entries_)
    if (entry.process->receive(scene, node, delivery.message)) return;
  if (shared_->live.receive(node, delivery.message)) return;
  warn({error_at(delivery.where, "no process of the scene receives \"{}\", sent to a {}",
                 delivery.message.text, node.schema->type)});
}

Status SceneClock::send(const std::string& target, const std::string& text) {
  const scene::Node* node = live().find(target);
  if (!node) return error("no node of the scene is called \"{}\"", target);
  return send(*node, text);
}

Status SceneClock::send(const scene::Node& target, const std::string& text) {
  Result<scene::Message> message = parse_message(*target.schema, text, {});
  if (!message) return message.errors();
  for (std::size_t i = 0; i < message->arguments.size(); ++i)
    if (message->schema->arguments[i].type == scene::AttributeType::child) {
      const auto& name = std::get<std::string>(message->arguments[i]);
      const scene::Node* child = find_node(target.children, name);
      if (!child || !child->schema->find("visible"))
        return error("\"{}\": the {} holds nothing to be seen that is called \"{}\"", text,
                     target.schema->type, name);
    }
  shared_->queue.post({&target, *std::move(message), {}, 0});
  return Ok{};
}

Status SceneClock::send(const scene::Node& target, const scene::AttributeSchema& attribute,
                        scene::AttributeValue value) {
  if (Status status = scene::check_value(attribute, value); !status) return status;
  scene::Message message{target.schema->find_message(attribute.name), {}, attribute.name};
  message.arguments.push_back(std::move(value));
  shared_->queue.post({&target, std::move(message), {}, 0});
  return Ok{};
}

std::vector<Process*> SceneClock::processes() const {
  std::vector<Process*> all;
  all.reserve(entries_.size());
  for (const Entry& entry : entries_) all.push_back(entry.process.get());
  return all;
}

Process* SceneClock::find(const std::string& name) const {
  for (const Entry& entry : entries_)
    if (entry.process->name() == name) return entry.process.get();
  return nullptr;
}

const SceneClock::Entry& SceneClock::entry_of(const Process& process) const {
  const auto found =
      std::ranges::find_if(entries_, [&](const Entry& entry) { return entry.process.get() == &process; });
  assert(found != entries_.end() && "the process is another clock's");
  return *found;
}

bool SceneClock::is_paused(const Process& process) const { return entry_of(process).is_paused; }

void SceneClock::pause(const Process& process, bool is_paused) {
  const_cast<Entry&>(entry_of(process)).is_paused = is_paused;  // entries are ours
}

void SceneClock::step_alone(const scene::Scene& scene, Process& process, double seconds) {
  for (long steps = std::lround(seconds / step_s); steps > 0; --steps) process.step(scene);
}

Errors SceneClock::take_warnings() {
  warn(shared_->queue.take_warnings());
  for (Entry& entry : entries_) warn(entry.process->take_warnings());
  return std::exchange(warnings_, {});
}

}  // namespace parvis::action
