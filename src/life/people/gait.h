// How people walk, stand and sit: postures of a skeleton.
//
// Angles of hip, knee and ankle over the cycle of a foot, which begins when its heel touches the ground, are
// smooth curves through the key events of normal gait on which teaching texts agree (those after Perry, "Gait
// analysis"): hip 30 degrees flexed at first contact and 10 extended late in stance; knee 15 to 20
// flexed in loading and 60 in the swing; ankle 5 down in loading, 10 up late in stance, 15 to 20 down at
// push-off. Between the events the curves are our own. Their excursions and the stride grow with a power of
// the speed; both are taken beside the length of the leg.
//
// Departure: feet are where they stand, not where these angles put them. The ankle of a foot on the ground
// turns about its heel, then about its ball; that of a foot in the air goes from one place to the next; the
// angles give the length of the leg that carries, hence the height of the pelvis, and the pitch of the foot;
// hip and knee follow from the ankle (two bones, exact).
#pragma once

#include "life/people/body_field.h"

namespace parvis::people {

/// Flexion in degrees at a phase of the cycle, 0..1, at ordinary speed; ankle: toes up is positive.
struct LegAngles {
  float hip, knee, ankle;
};
/// The angles of a leg in normal gait at a phase of its cycle.
LegAngles normal_angles(float phase);

/// How a body walks at a speed.
struct Stride {
  float length_m = 1.4f;   ///< of a cycle: two steps
  float duty = 0.62f;      ///< the fraction of the cycle for which a foot is on the ground
  float excursion = 1.0f;  ///< of the angles, beside those at ordinary speed
};
/// The stride of a body at a speed; slower than 0.12 m/s counts as that.
Stride stride_of(const BodyShape& shape, float speed_m_s);

/// A place where a foot stands flat: the point of the ground below its ankle, in the person's frame (x
/// forward, y left, origin on the ground below the pelvis), metres, and where it points.
struct Footprint {
  glm::vec3 place{0.0f};
  float yaw = 0.0f;
};

/// A foot in its cycle.
struct FootInCycle {
  float phase = 0.0f;      ///< 0..1; on the ground up to the duty
  Footprint stands, next;  ///< next: where it goes while it is in the air
};

/// The two feet, left first.
using Feet = std::array<FootInCycle, 2>;

/// How far behind the pelvis the middle of a foot's stance is, metres: who walks leans into the way.
float stance_behind_m(const BodyShape& shape, const Stride& stride);

/// Feet of somebody who walks straight on at a phase of the left one.
Feet straight_feet(const BodyField& body, const Stride& stride, float left_phase);

/// Trunk, arms and head of somebody who walks, by the phase of the left foot; the legs are as bound.
Posture carriage(const BodyField& body, const Stride& stride, float left_phase);
/// Puts the feet of a posture where they are, and the pelvis as high as the legs reach.
void put_down(const BodyField& body, const Stride& stride, const Feet& feet, Posture& posture);
/// Both together.
Posture walking(const BodyField& body, const Stride& stride, const Feet& feet);

/// Activities of people who do not walk.
enum class Activity : std::uint8_t { stand, wait, talk, phone, sit };

/// Somebody on the spot, at a time; each by its own number. Sitting: the seat is at `seat_m` above the
/// ground.
Posture on_the_spot(const BodyField& body, Activity activity, float time_s, float number,
                    float seat_m = 0.45f);

/// Puts the hands of somebody who stands or walks onto a handle in front of the body.
void hold_handle(const BodyField& body, Posture& posture);

/// The places of a bicycle on which somebody rides, in the person's frame.
struct BicyclePlaces {
  glm::vec3 saddle{-0.22f, 0.0f, 0.9f}, cranks{0.0f, 0.0f, 0.28f};
  float crank_m = 0.17f;
};
/// A saddle over these cranks as high as the legs of a body need it.
BicyclePlaces bicycle_for(const BodyField& body);
/// Somebody who rides, hands before the chest; `turn`: radians of the left crank, from the front downward.
Posture on_bicycle(const BodyField& body, const BicyclePlaces& places, float turn);

/// Where a foot stands (0: left) of somebody at rest.
Footprint standing_place(const BodyField& body, int side);

/// Turns thigh, shin, foot and toes so that the ankle is at a place (of the person's frame) with the foot
/// pitched (toes up, radians) and turned; the pelvis is where the posture has it. Returns how far out of
/// reach the place was, metres.
float place_foot(const BodyField& body, Posture& posture, int side, glm::vec3 ankle, float pitch, float yaw,
                 float toes_up);

}  // namespace parvis::people
