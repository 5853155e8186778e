// One visit to a stage: where the visitor stands, what they follow and have chosen, which notices they see.
// All that keys and the panel can do, without a window.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "house/stage/stage.h"
#include "viewer/navigation.h"

namespace parvis::viewer {

/// A notice that a visitor sees for a while.
struct Notice {
  std::string text;
  bool is_error = false;
  double ends_s = 0.0;  ///< in the visit's time
};

/// Where pictures go, and what their names begin with.
struct PicturePlace {
  std::filesystem::path folder;
  std::string name;
};

class Visit {
 public:
  /// The stage outlives the visit.
  Visit(house::Stage& stage, const Camera& start, PicturePlace pictures);

  /// Lets `passed_s` pass, for the scene and the visitor's motion at most a tenth of a second: after a halt,
  /// life goes on where it stopped.
  void step(const Controls& controls, float passed_s);
  Camera camera() const { return navigation_.camera(); }

  Mode mode() const { return navigation_.mode(); }
  /// To follow without a vehicle to follow flies.
  void set_mode(Mode mode);
  /// The objects that can be followed: those that move and are to be seen.
  std::vector<int> vehicles() const;
  /// Index of the object; -1 where none has been followed yet.
  int followed() const { return followed_; }
  void follow(int object);
  void follow_next_vehicle();

  void look_from(const std::string& camera);
  void start_tour(const std::string& name);
  /// Empty: the base scene.
  void show_scenario(const std::string& name);
  /// Through the scene's scenarios in their order, then the base scene.
  void show_next_scenario();

  /// The node that made what stands at a pixel of the picture drawn last; null where it is the sky, or what
  /// no node made.
  const scene::Node* node_at(glm::ivec2 pixel);
  /// Sends a message to a node; errors say what it expects, and nothing has changed then. What cannot be
  /// built is a notice, a step later.
  Status tell(const scene::Node& node, const std::string& message);
  // Light and reflections: attributes of the nodes that stand for them, seen with the next step.
  void set_sun(float azimuth_deg, float elevation_deg);
  void set_exposure(float exposure);
  void set_reflection(const std::string& method);

  /// The processes that say what they do (Process::status): traffic, a crowd. They are halted together.
  std::vector<action::Process*> processes() const;
  /// True if there are such processes and all are halted.
  bool is_halted() const;
  /// Halts these processes, or lets them go on; all others go on.
  void halt(bool halts);
  /// Halts them and moves them on by a tenth of a second.
  void step_halted();

  /// Writes what was drawn last, without the panel, into a new file.
  void take_picture();

  void notice(std::string text);
  void notice_error(std::string text);
  /// Those that are to be read now, the oldest first.
  const std::vector<Notice>& notices() const { return notices_; }

  house::Stage& stage() { return stage_; }
  const scene::Scene& scene() const { return stage_.scene(); }
  action::Actions& actions() { return stage_.play().actions(); }
  scene::LiveScene& live() { return stage_.play().live(); }

 private:
  void set(const char* type, const char* attribute, scene::AttributeValue value);
  void follow_guidance(const Controls& controls);
  void report(const Status& status, const std::string& done);
  void add_notice(Notice notice);

  house::Stage& stage_;
  Navigation navigation_;
  PicturePlace pictures_;
  int followed_ = -1;
  double time_s_ = 0.0;
  std::vector<Notice> notices_;
};

/// Compass direction (0 north, 90 east) and height above the horizon of a direction, in degrees.
glm::vec2 azimuth_and_elevation_deg(glm::vec3 direction);

}  // namespace parvis::viewer
