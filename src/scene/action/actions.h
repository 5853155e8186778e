// What happens in a scene while it runs: keys, timers and things that come near send messages; nodes do what
// they are told; paths move objects and cameras; tours lead the view. At a fixed step, so that the same
// happenings at the same times give the same scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/action/clock.h"
#include "scene/action/event_queue.h"
#include "scene/action/keyframes.h"
#include "scene/script/live_scene.h"

namespace parvis::action {

inline constexpr double step_s = 1.0 / 60.0;

/// Everything of one scene, which its functions take. A moved one goes on as it was.
class Actions {
 public:
  Actions() = default;  ///< of a scene without a script: nothing happens
  /// Marks what paths move as dynamic: to be made before the scene is drawn, when all its objects are there.
  Actions(scene::LiveScene live, scene::Scene& scene);

  scene::LiveScene& live() { return live_; }
  const scene::LiveScene& live() const { return live_; }

  /// A person presses or releases a key of `key_names`, some time from now; counts in the step after that.
  void press(const std::string& key, double in_s = 0.0) { change_key(key, in_s, true); }
  void release(const std::string& key, double in_s = 0.0) { change_key(key, in_s, false); }
  /// Does an event of the scene wait for this key?
  bool uses_key(const std::string& key) const;
  /// A message from outside of the scene (a panel, the command line), delivered in the next step.
  Status send(const std::string& target, const std::string& message);
  /// The same to a node of `live().nodes()`, which needs no name.
  Status send(const scene::Node& target, const std::string& message);

  /// Lets `seconds` >= 0 pass. `visitor`: where the eye is, if anybody looks.
  void advance(scene::Scene& scene, double seconds, const std::optional<glm::vec3>& visitor);

  /// The running tour's view of now, or the camera that a message told to look; nothing where there is
  /// neither.
  std::optional<Camera> camera(const scene::Scene& scene) const;
  /// Starts the tour and gives its length in seconds. Errors name the tours that there are.
  Result<double> start_tour(const std::string& name);
  /// From now on the visitor looks where they like: no tour runs, no message holds the view.
  void release_view();

  /// What went wrong since the last call.
  Errors take_warnings();

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
  void read(const scene::Node& node);
  void read_motion(const scene::Node& node);
  std::vector<Trigger> triggers(const scene::Node& node, const std::string& event) const;
  void fire(const Trigger& trigger, int chain = 0);
  template <class Things>
  bool run(Things& things, const Delivery& delivery);
  void fire_marks(const Timer& timer, int chain);
  void fire_marks(const Motion& motion, int chain);
  void fire_marks(const Tour&, int) {}

  void step(scene::Scene& scene, const std::optional<glm::vec3>& visitor);
  void look_around(const scene::Scene& scene, const std::optional<glm::vec3>& visitor);
  std::optional<glm::vec3> place_of(const std::string& source, const scene::Scene& scene,
                                    const std::optional<glm::vec3>& visitor) const;
  void send_keys();
  void stop_tours();
  void deliver(scene::Scene& scene, const Delivery& delivery);
  void move(double ahead_s);
  std::optional<Camera> view_of(const Tour& tour, const scene::Scene& scene) const;

  scene::LiveScene live_;
  std::vector<Trigger> on_press_, on_release_;
  std::vector<Timer> timers_;
  std::vector<Motion> motions_;
  std::vector<Tour> tours_;
  std::vector<Watch> watches_;
  std::vector<KeyChange> key_changes_;
  EventQueue queue_;
  std::string camera_;  ///< that a message told to look
  long steps_ = 0;
  double due_s_ = 0.0;  ///< time that has passed since the last step
  Errors warnings_;
};

}  // namespace parvis::action
