// Something that moves a scene: traffic, paths, animations, a crowd. One clock drives all processes
// (scene_clock.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/action/event_queue.h"
#include "scene/data/scene.h"
#include "scene/script/live_scene.h"

namespace parvis::action {

/// Who looks on while the scene runs.
struct Observer {
  std::optional<glm::vec3> eye = {};  ///< in the world; nothing where nobody looks
};

/// State shared by the processes of a scene. It stays where it is in memory and outlives them.
struct SharedByProcesses {
  scene::LiveScene live;  ///< the script's nodes: set their attributes, and what they make follows
  EventQueue queue;       ///< messages on their way
};

/// A process keeps its own state; a scene is handed to it, and is the same one each time.
class Process {
 public:
  Process() = default;
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  virtual ~Process() = default;

  /// One word, by which a panel calls it.
  virtual std::string name() const = 0;
  /// Its activity in a few words: "30 vehicles". Where it says something, a window can halt the process.
  virtual std::string status() const { return ""; }

  /// Once, before the scene is drawn: objects that it moves are added, or marked as dynamic, here.
  virtual void begin(scene::Scene& scene, SharedByProcesses& shared) = 0;
  /// `step_s` passes. Only the process's own state, attributes of nodes and the queue change.
  virtual void step(const scene::Scene&) {}
  /// Looks at the scene as it is after a step; called where `looks` says so.
  virtual void look(const scene::Scene&, const Observer&) {}
  /// True where `look` is to be called; the scene is then presented at every step.
  virtual bool looks() const { return false; }
  /// Puts into the scene what is to be seen `ahead_s`, less than a step, after the last step.
  virtual void present(scene::Scene&, double /*ahead_s*/) {}
  /// Shows what is presented as these eyes need it, before a frame is drawn from them: levels of detail.
  /// Nothing moves.
  virtual void adapt(scene::Scene&, std::span<const glm::vec3> /*eyes*/) {}
  /// The share of its usual detail, 0 to 1, with which it shows what it presents from now on: a window that
  /// cannot hold its rate lowers it. Nothing moves otherwise.
  virtual void set_detail(float /*share*/) {}
  /// Finishes what it has spread over the frames to come, for a picture that stands by itself.
  virtual void settle(scene::Scene&) {}
  /// Does what the message to this node asks for. False where it is for another process, or for the node
  /// itself.
  virtual bool receive(scene::Scene&, const scene::Node&, const scene::Message&) { return false; }

  /// Returns and clears the warnings since the last call.
  Errors take_warnings() { return std::exchange(warnings_, {}); }

 protected:
  void warn(Error warning) { warnings_.push_back(std::move(warning)); }
  void warn(const Errors& warnings) { warnings_.insert(warnings_.end(), warnings.begin(), warnings.end()); }

 private:
  Errors warnings_;
};

/// The kinds of processes that rooms bring: each scene gets one of each.
class Processes {
 public:
  /// Makes a process that has not begun.
  using Make = std::function<std::unique_ptr<Process>()>;
  /// Processes step, look and present in the order in which their kinds were added.
  void add(Make make) { makers_.push_back(std::move(make)); }
  /// The makers in the order in which they were added.
  const std::vector<Make>& makers() const { return makers_; }

 private:
  std::vector<Make> makers_;
};

}  // namespace parvis::action
