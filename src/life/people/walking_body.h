// A body that goes where it is led: its feet stand on the ground where they were set down, whatever way,
// turns and speeds the body takes, and are set down ahead of where it will be.
#pragma once

#include <functional>
#include <optional>

#include "life/people/gait.h"

namespace parvis::people {

/// Where a body is led: a place on the ground, and where it looks.
struct Lead {
  glm::vec3 place{0.0f};
  float heading = 0.0f;  ///< radians, counter-clockwise from +x, continuous: it does not jump by full turns
};

/// Height of the ground at a place.
using GroundHeight = std::function<float(glm::vec3)>;

/// The feet of one body, and how it holds itself. Steps of fixed length; between two of them it is shown
/// interpolated.
class WalkingBody {
 public:
  /// Stands at a place; `number` makes bodies differ. The body must outlive it.
  WalkingBody(const BodyField& body, const Lead& lead, float number);

  /// `step_s` passes, in which the body was led to `lead`.
  void step(const Lead& lead, float step_s, const GroundHeight& ground);

  /// The lead when `part` of the last step has passed, 0..1.
  Lead lead_at(float part) const;
  /// The posture at that time, in the frame of the lead.
  Posture posture_at(float part) const;
  /// The phase of the left foot's cycle at that time, 0..1, of a body that holds itself as one who walks.
  std::optional<float> cycle_at(float part) const;

  /// False when it stands, or shifts its feet where it stands.
  bool walks() const { return now_.walks; }
  /// Its activity when it stands.
  Activity activity = Activity::stand;

 private:
  /// A foot in world coordinates.
  struct Foot {
    double phase = 0.3;  ///< goes on by one for each cycle
    Footprint stands, next;
  };
  struct State {
    Lead lead;
    std::array<Foot, 2> feet;
    float speed = 0.0f;    ///< smoothed, m/s
    float walking = 0.0f;  ///< 0: holds itself as one who stands, 1: as one who walks
    double carriage_phase = 0.0;
    double time_s = 0.0;
    bool walks = false;
  };

  double carriage_at(float part) const;
  Footprint in_world(const Footprint& print, const Lead& lead, const GroundHeight& ground) const;
  void walk(float way_m, float step_s, const Stride& stride, const GroundHeight& ground);
  void stand(float step_s, const Stride& stride, const GroundHeight& ground);

  const BodyField* body_;
  float number_;
  State before_, now_;
};

}  // namespace parvis::people
