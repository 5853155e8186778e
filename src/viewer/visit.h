// One visit to a stage: the visitor's pose, the followed object, the selection, the notices. The operations
// behind keys and panel, independent of the window.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "stage/stage.h"
#include "viewer/navigation.h"

namespace parvis::viewer {

/// The places from a sketch to a photograph that have names, evenly spaced.
inline constexpr std::array realism_names{"sketch", "white model", "plain colours", "materials",
                                          "everything"};

/// A message that is displayed for a while.
struct Notice {
  std::string text;
  bool is_error = false;
  double ends_s = 0.0;  ///< in the visit's time
};

/// Folder and name prefix of saved pictures.
struct PicturePlace {
  std::filesystem::path folder;
  std::string name;
};

/// State and operations of one visit. Failures become notices, unless they are returned.
class Visit {
 public:
  /// The stage must outlive the visit.
  Visit(stage::Stage& stage, const Camera& start, PicturePlace pictures);

  /// Advances the scene by `passed_s`, but at most by a second: after a pause of the program it continues
  /// where it stopped. The visitor moves for a tenth of a second at most.
  /// Where `stands_still`, the scene's time does not go on.
  void step(const Controls& controls, float passed_s, bool stands_still = false);
  double advanced_s() const { return advanced_s_; }       ///< by which the last step advanced the scene
  Camera camera() const { return navigation_.camera(); }  ///< the visitor's present view

  Mode mode() const { return navigation_.mode(); }  ///< walk, fly or follow
  /// Changes the mode and ends a tour. Following without an object to follow becomes flying.
  void set_mode(Mode mode);
  /// Indices of the objects that can be followed: visible dynamic ones that have moved since the visit began,
  /// or all where none has.
  std::vector<int> vehicles() const;
  /// Index of the followed object; -1 if none has been followed yet.
  int followed() const { return followed_; }
  /// Follows an object of the scene by its index.
  void follow(int object);
  /// Follows the next of `vehicles`, cyclically.
  void follow_next_vehicle();

  /// Goes to a camera of the scene by name.
  void look_from(const std::string& camera);
  /// Flies to a camera within a second and a half.
  void fly_to(const Camera& camera, std::optional<Mode> arrives_in = {});  ///< as Navigation::fly_to
  /// The motion of the visitor, for those who lead it.
  Navigation& navigation() { return navigation_; }
  /// Starts a tour of the scene by name; any motion of the visitor ends it.
  void start_tour(const std::string& name);
  /// Activates a scenario; empty: the base scene.
  void show_scenario(const std::string& name);
  /// Cycles through the scenarios in their order, then the base scene.
  void show_next_scenario();

  /// The node that made the object at a pixel of the last picture; null for the sky and for objects that no
  /// node made.
  const scene::Node* node_at(glm::ivec2 pixel);
  /// Says in a notice what the pixel of the present view shows: metres, object, kind.
  void probe(glm::ivec2 pixel);
  /// Sends a message to a node. An error says what the node expects; nothing changes then. If the changed
  /// node cannot be built, a notice says so one step later.
  Status tell(const scene::Node& node, const std::string& message);
  /// The same with the value of an attribute that can change while the scene runs.
  Status tell(const scene::Node& node, const scene::AttributeSchema& attribute, scene::AttributeValue value);
  // Light and reflections: attributes of their nodes; visible with the next step.
  /// Sets the sun's compass direction (0 north, 90 east) and elevation, degrees.
  void set_sun(float azimuth_deg, float elevation_deg);
  /// The node that gives sun and sky of a place and hour, in place of the sun's own; null: there is none.
  const scene::Node* day_light() const { return live().find("%dayLight"); }
  /// Sets the day of its year, from 1.
  void set_day(int day_of_year);
  /// Sets its hour by the clock, 0 to 24.
  void set_hour(double hour);
  /// The factor that was chosen on radiance before the tone curve; day light multiplies it by its own.
  double exposure() const;
  /// Sets it.
  void set_exposure(double exposure);
  /// Sets the picture's place between a sketch (0) and a photograph (1): scene::Realism.
  void set_realism(double level);
  /// Goes to the next of the five places that have names, or the one before, and says which.
  void step_realism(int steps);
  /// Selects a reflection method by its name in the registry.
  void set_reflection(const std::string& method);

  /// The processes that say what they do (Process::status): traffic, a crowd. They are halted together.
  std::vector<action::Process*> processes() const;
  /// True if there are such processes and all are halted.
  bool is_halted() const;
  /// Halts these processes, or lets them go on; all others go on.
  void halt(bool halts);
  /// Halts them and moves them on by a tenth of a second.
  void step_halted();

  /// Saves the last picture, without the panel, as a new file.
  void take_picture();

  /// Displays a message for a few seconds.
  void notice(std::string text);
  /// Displays an error, for longer.
  void notice_error(std::string text);
  /// The notices to be displayed now, oldest first.
  const std::vector<Notice>& notices() const { return notices_; }

  stage::Stage& stage() { return stage_; }                               ///< as given
  const scene::Scene& scene() const { return stage_.scene(); }           ///< the stage's
  action::Actions& actions() { return stage_.simulation().actions(); }   ///< events, messages and tours
  scene::LiveScene& live() const { return stage_.simulation().live(); }  ///< nodes and scenarios

 private:
  void set(const char* type, const char* attribute, scene::AttributeValue value);
  void follow_guidance(const Controls& controls);
  void report(const Status& status, const std::string& done);
  void add_notice(Notice notice);

  stage::Stage& stage_;
  Navigation navigation_;
  PicturePlace pictures_;
  int followed_ = -1;
  std::unordered_map<std::string, glm::vec4> first_places_;  ///< of dynamic objects, by name
  double time_s_ = 0.0, advanced_s_ = 0.0;
  std::vector<Notice> notices_;
};

/// Compass direction (0 north, 90 east) and height above the horizon of a direction, in degrees.
glm::vec2 azimuth_and_elevation_deg(glm::vec3 direction);

}  // namespace parvis::viewer
