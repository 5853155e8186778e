// Interaction and motion of a running scene: keys, timers and things that come near send messages; paths move
// objects and cameras; tours lead the view.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/action/clock.h"
#include "scene/action/keyframes.h"
#include "scene/action/process.h"

namespace parvis::action {

/// The process of the nodes keys, timer, proximity, path, tour; it also receives what cameras and scenarios
/// take.
class Actions final : public Process {
 public:
  std::string name() const override { return "actions"; }
  /// Marks what paths move as dynamic.
  void begin(scene::Scene& scene, SharedByProcesses& shared) override;
  void step(const scene::Scene& scene) override;
  bool looks() const override { return !watches_.empty(); }
  void look(const scene::Scene& scene, const Observer& observer) override;
  void present(scene::Scene& scene, double ahead_s) override;
  bool receive(scene::Scene& scene, const scene::Node& node, const scene::Message& message) override;

  /// A person presses or releases a key of `key_names`, some time from now; counts in the step after that.
  void press(const std::string& key, double in_s = 0.0) { change_key(key, in_s, true); }
  void release(const std::string& key, double in_s = 0.0) { change_key(key, in_s, false); }
  /// Does an event of the scene wait for this key?
  bool uses_key(const std::string& key) const;

  /// The running tour's view of now, or the camera that a message told to look; nothing where there is
  /// neither.
  std::optional<Camera> camera(const scene::Scene& scene) const;
  /// Starts the tour and gives its length in seconds. Errors name the tours that there are.
  Result<double> start_tour(const std::string& name);
  /// Lets the visitor look where they like from now on: no tour runs, no message holds the view.
  void release_view();

 private:
  struct Trigger {
    std::string source;
    double mark = 0.0;  ///< the source as a number
    double delay_s = 0.0;
    Delivery delivery;
  };
  struct KeyChange {
    std::string key;
    long step;
    bool is_pressed;
  };
  struct Timer {
    const scene::Node* node;
    Clock clock;
    std::vector<Trigger> on_time;
  };
  struct Motion {
    const scene::Node *node, *target;
    Clock clock;
    std::vector<Keyframe> keys;
    std::vector<Trigger> on_pass;
    bool has_heading, has_pitch, is_smooth, looks_along;
    float own_heading;  ///< radians, of the target as the script gives it
  };
  struct Tour {
    const scene::Node* node;
    Clock clock;
    bool is_smooth;
  };
  struct Watch {
    const scene::Node* node;
    Trigger trigger;
    bool is_entry, is_inside;
  };

  void change_key(const std::string& key, double in_s, bool is_pressed);
  void follow_nodes();
  void read(const scene::Node& node);
  void read_motion(const scene::Node& node);
  std::vector<Trigger> triggers(const scene::Node& node, const std::string& event) const;
  void fire(const Trigger& trigger);
  template <class Things>
  bool run(Things& things, const scene::Node& node, const scene::Message& message);
  void fire_marks(const Timer& timer);
  void fire_marks(const Motion& motion);
  void fire_marks(const Tour&) {}

  std::optional<glm::vec3> place_of(const std::string& source, const scene::Scene& scene,
                                    const std::optional<glm::vec3>& visitor) const;
  void send_keys();
  void stop_tours();
  std::optional<Camera> view_of(const Tour& tour, const scene::Scene& scene) const;

  scene::LiveScene& live() { return shared_->live; }
  const scene::LiveScene& live() const { return shared_->live; }

  SharedByProcesses* shared_ = nullptr;
  int edits_ = 0;                         ///< of the nodes, that are taken in
  std::set<const scene::Node*> running_;  ///< timers, paths and tours that have been read
  std::vector<Trigger> on_press_, on_release_;
  std::vector<Timer> timers_;
  std::vector<Motion> motions_;
  std::vector<Tour> tours_;
  std::vector<Watch> watches_;
  std::vector<KeyChange> key_changes_;
  std::string camera_;    ///< that a message told to look
  double ahead_s_ = 0.0;  ///< of what is shown after the last step
};

}  // namespace parvis::action
