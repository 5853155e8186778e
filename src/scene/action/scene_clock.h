// The one clock of a scene that runs: fixed steps for every process, messages between them, and the moment
// between two steps that is shown. The same happenings at the same times give the same scene at any frame
// rate.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/action/process.h"

namespace parvis::action {

class SceneClock {
 public:
  /// Begins all processes. Without a script, `live` has no nodes.
  SceneClock(const Processes& processes, scene::LiveScene live, scene::Scene& scene);

  scene::LiveScene& live() { return shared_->live; }
  const scene::LiveScene& live() const { return shared_->live; }
  double time_s() const { return double(shared_->queue.now()) * step_s + due_s_; }

  /// Lets `seconds` >= 0 pass: as many steps as have come due, then the moment after the last.
  void advance(scene::Scene& scene, double seconds, const Observer& observer = {});
  /// Shows the present moment once more, after another scenario has been chosen, say.
  void follow(scene::Scene& scene) { present(scene, due_s_); }
  /// Shows the present moment as these eyes need it: Process::adapt. Before a frame is drawn.
  void adapt(scene::Scene& scene, std::span<const glm::vec3> eyes);
  /// The share of their usual detail with which processes show things: Process::set_detail.
  void set_detail(float share);
  /// Finishes what processes have spread over frames to come: for pictures and films, whose frames must not
  /// depend on those drawn before. After `advance` or `follow`.
  void settle(scene::Scene& scene);

  /// A message from outside of the scene (a panel, the command line), delivered in the next step.
  Status send(const std::string& target, const std::string& message);
  /// The same to a node of `live().nodes()`, which needs no name.
  Status send(const scene::Node& target, const std::string& message);
  /// The message that gives a live attribute of the node a value. An error says what the attribute expects.
  Status send(const scene::Node& target, const scene::AttributeSchema& attribute,
              scene::AttributeValue value);

  /// The process of this type; null where no room brings one.
  template <class P>
  P* find() const {
    for (const Entry& entry : entries_)
      if (P* process = dynamic_cast<P*>(entry.process.get())) return process;
    return nullptr;
  }
  /// All processes, in the order in which they step.
  std::vector<Process*> processes() const;
  /// The process of this name; null where there is none.
  Process* find(const std::string& name) const;

  /// A paused process stands still; all else goes on.
  void pause(const Process& process, bool is_paused);
  bool is_paused(const Process& process) const;
  /// Moves one process on, also where it is paused.
  void step_alone(const scene::Scene& scene, Process& process, double seconds);

  /// Returns and clears the warnings of all processes since the last call.
  Errors take_warnings();

 private:
  struct Entry {
    std::unique_ptr<Process> process;
    bool is_paused = false;
    double ahead_s = 0.0;  ///< that was shown last: a paused process stays there
  };

  void step(scene::Scene& scene, const Observer& observer);
  void present(scene::Scene& scene, double ahead_s);
  void deliver(scene::Scene& scene, const Delivery& delivery);
  void warn(const Errors& warnings) { warnings_.insert(warnings_.end(), warnings.begin(), warnings.end()); }
  const Entry& entry_of(const Process& process) const;

  std::unique_ptr<SharedByProcesses> shared_;
  std::vector<Entry> entries_;
  double due_s_ = 0.0;  ///< time that has passed since the last step
  Errors warnings_;
};

}  // namespace parvis::action
