// Messages on their way: those that events have sent and that arrive at a later step of the simulation. In
// order, repeatable, and bounded: a storm spreads over steps, a circle of messages is cut.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/script/live_scene.h"

namespace parvis::action {

/// Seconds between two steps of a scene that runs.
inline constexpr double step_s = 1.0 / 60.0;
/// Messages of one step are delivered up to this number; the others wait for the next.
inline constexpr std::size_t max_messages_per_step = 1'000;
/// More do not wait: those that come then are lost, and reported.
inline constexpr std::size_t max_waiting_messages = 100'000;
/// A message that causes one that causes one ... within the same step.
inline constexpr int longest_chain = 32;

/// A message to a node, ready to be delivered.
struct Delivery {
  const scene::Node* target = nullptr;
  scene::Message message;
  FileLocation where;  ///< of the event that sent it
  int chain = 0;       ///< how many messages of the same step led to it; the queue counts
};

/// Messages that wait, by the step at which they arrive.
class EventQueue {
 public:
  /// The number of the present step; 0 before the first.
  long now() const { return now_; }
  /// Counts one step on.
  void begin_step() { ++now_; }

  /// Takes a message that arrives so many seconds from now.
  void post(Delivery delivery, double delay_s = 0.0);
  /// The next message that is due, first sent first; false where there is none or the step has had its share.
  /// What is posted before the next call is an effect of this message.
  bool next(Delivery& delivery);

  /// How many messages wait.
  std::size_t size() const { return waiting_.size(); }
  /// Warnings of events cut, lost or postponed since the last call; each circle is reported once, storms once
  /// in the queue's life.
  Errors take_warnings() { return std::exchange(warnings_, {}); }

 private:
  void warn(const std::string& kind, Error warning);

  std::map<std::pair<long, long>, Delivery> waiting_;  ///< by step and number
  long now_ = 0, posted_ = 0;
  long counted_step_ = -1;
  int next_chain_ = 0;         ///< of messages that are posted now
  std::size_t delivered_ = 0;  ///< in the counted step
  Errors warnings_;
  std::set<std::string> told_;
};

}  // namespace parvis::action
