#include "planning/devices/input_state.h"

#include <algorithm>
#include <cmath>

namespace parvis::devices {
namespace {

constexpr double max_coordinate_m = 1e3;  // a room is smaller
constexpr int max_button = 64;
constexpr std::size_t max_events = 10'000;

}  // namespace

Status InputState::take(const sound::OscMessage& message, const std::string& sender, double now_s) {
  const std::vector<double>& numbers = message.numbers;
  if (message.address == "/tuio/2Dcur") return take_fingers(message);
  // A sender that knows no NaN of OSC may still have one of its own making in a file.
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); }))
    return error("{}: a value is no number; it was left out", message.address);
  const std::string name = message.texts.empty() ? "" : message.texts[0];
  if (name.empty()) return error("{}: expected the name of a device first", message.address);
  if (message.address == "/parvis/tracker") return take_tracker(message, sender, now_s);
  if (message.address == "/parvis/button" && numbers.size() == 3) {
    if (!(numbers[1] >= 1 && numbers[1] <= max_button) || buttons_.size() >= max_events)
      return error("{} {}: button {}; expected 1 to {}", message.address, name, numbers[1], max_button);
    buttons_.push_back({name, int(numbers[1]), numbers[2] != 0.0});
    return Ok{};
  }
  const auto share = [&](std::size_t i) { return std::clamp(numbers[i], -1.0, 1.0); };
  if (message.address == "/parvis/stick" && numbers.size() == 3) {
    if (sticks_.size() >= max_devices && !sticks_.contains(name))
      return error("more than {} sticks", max_devices);
    sticks_[name] = {share(1), share(2)};
    return Ok{};
  }
  if (message.address == "/parvis/motion" && numbers.size() == 6) {
    if (motions_.size() >= max_devices && !motions_.contains(name))
      return error("more than {} 3D mice", max_devices);
    motions_[name] = {share(1), share(2), share(3), share(4), share(5)};
    return Ok{};
  }
  return error(
      "{} with {} arguments: expected /parvis/tracker NAME X Y Z [QX QY QZ QW], /parvis/button NAME NUMBER "
      "0|1, "
      "/parvis/stick NAME RIGHT AHEAD or /parvis/motion NAME and five numbers",
      message.address, numbers.size());
}

Status InputState::take_tracker(const sound::OscMessage& message, const std::string& sender, double now_s) {
  const std::vector<double>& n = message.numbers;
  const std::string& name = message.texts[0];
  if (n.size() != 4 && n.size() != 8)
    return error("/parvis/tracker {}: {} numbers; expected a place of 3, or a place and a turn of 7", name,
                 n.size() - 1);
  Pose pose;
  pose.position = {n[1], n[2], n[3]};
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(pose.position[axis]) > max_coordinate_m)
      return error("/parvis/tracker {}: {} m; a room has {} at most", name, pose.position[axis],
                   max_coordinate_m);
  if (n.size() == 8) {
    const glm::dquat turn(n[7], n[4], n[5], n[6]);
    if (!(glm::length(turn) > 1e-3)) return error("/parvis/tracker {}: the turn has no length", name);
    pose.turn = glm::normalize(turn);
  }
  if (!trackers_.contains(name) && trackers_.size() >= max_devices)
    return error("more than {} trackers", max_devices);
  const auto [found, is_new] = trackers_.try_emplace(name);
  Tracker& tracker = found->second;
  if (is_new) tracker.shown = pose, tracker.sender = sender;
  if (tracker.sender != sender) {
    if (now_s - tracker.said_s < stale_s) {
      if (!std::exchange(tracker.is_doubled, true))
        notes_.push_back(
            fmt::format("two trackers of the name \"{}\": {} is followed, {} is not; give one another name",
                        name, tracker.sender, sender));
      return error("/parvis/tracker {}: {} sends it, too", name, tracker.sender);
    }
    tracker.sender = sender;
  }
  tracker.said = pose, tracker.said_s = now_s;
  if (std::exchange(tracker.has_stopped, false)) {
    tracker.returned_s = now_s;
    notes_.push_back(fmt::format("tracker \"{}\" goes on", name));
  }
  return Ok{};
}

std::optional<Pose> InputState::pose(const std::string& name, double now_s) {
  const auto found = trackers_.find(name);
  if (found == trackers_.end()) return std::nullopt;
  Tracker& tracker = found->second;
  if (now_s - tracker.said_s > stale_s) {
    if (!std::exchange(tracker.has_stopped, true))
      notes_.push_back(fmt::format("tracker \"{}\" has stopped; it stays where it was", name));
    return tracker.shown;
  }
  double share = 1.0;  // of the way from where it is shown to where it is
  if (tracker.returned_s) {
    share = std::clamp((now_s - *tracker.returned_s) / return_s, 0.0, 1.0);
    if (share >= 1.0) tracker.returned_s.reset();
    share *= share;  // each call goes a part of what is left, a greater one each time
  }
  tracker.shown.position = glm::mix(tracker.shown.position, tracker.said.position, share);
  tracker.shown.turn = glm::slerp(tracker.shown.turn, tracker.said.turn, share);
  return tracker.shown;
}

glm::dvec2 InputState::stick(const std::string& device) const {
  const auto found = sticks_.find(device);
  return found == sticks_.end() ? glm::dvec2(0.0) : found->second;
}

std::array<double, 5> InputState::motion() const {
  std::array<double, 5> sum{};
  for (const auto& [name, motion] : motions_)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = std::clamp(sum[i] + motion[i], -1.0, 1.0);
  return sum;
}

/// TUIO 1.1: "set ID X Y ..." and "alive ID ID ...".
Status InputState::take_fingers(const sound::OscMessage& message) {
  const std::string kind = message.texts.empty() ? "" : message.texts[0];
  const std::vector<double>& n = message.numbers;
  if (kind == "set" && n.size() >= 4 && std::isfinite(n[2]) && std::isfinite(n[3])) {
    if (fingers_.size() < max_devices || fingers_.contains(int(n[1])))
      fingers_[int(n[1])] = glm::clamp(glm::dvec2(n[2], n[3]), 0.0, 1.0);
  } else if (kind == "alive") {
    std::erase_if(fingers_, [&](const auto& finger) {
      return std::find(n.begin() + 1, n.end(), double(finger.first)) == n.end();
    });
  } else if (kind != "fseq" && kind != "source") {
    return error("/tuio/2Dcur {}: expected set, alive, fseq or source", kind);
  }
  return Ok{};
}

}  // namespace parvis::devices
