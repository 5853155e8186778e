// How long, wide and deep the parts of a person are, by age, sex and build.
//
// Stature by age and sex: medians of the CDC growth charts of 2000 (stature-for-age) to 18 years, rounded to
// centimetres; above, the mean of adults, which falls with age as in the surveys of NHANES. Segment lengths:
// fractions of stature after Drillis and Contini 1966 (in Winter, "Biomechanics and motor control of human
// movement", figure 4.1). Heights of heads, breadths and depths are our own, drawn to look right beside these
// lengths and the body mass index.
#pragma once

#include <glm/glm.hpp>

#include "base/random.h"

namespace parvis::people {

enum class Sex : std::uint8_t { male, female };

/// Who a body is of.
struct Person {
  Sex sex = Sex::male;
  float age = 35.0f;       ///< years, from 4 on
  float taller_sd = 0.0f;  ///< stature beyond that of the age, standard deviations
  float bmi = 24.0f;       ///< body mass index, kg/m2; children: of the adult that they would be
};

/// Mean stature of an age, metres.
float mean_stature_m(Sex sex, float age);

/// Lengths in metres; heights are above the soles.
struct BodyShape {
  float stature, head;  ///< head: from chin to vertex
  float chin_z, neck_z, shoulder_z, hip_z, knee_z, ankle_z;
  float shoulder_y, hip_y;  ///< from the middle plane to the joints
  float upper_arm, forearm, hand, foot;
  float chest_half, waist_half, hips_half;     ///< half breadths of the trunk
  float chest_depth, waist_depth, hips_depth;  ///< half depths
  float bust, belly;                           ///< how far these stand out beyond the depths
  float thickness;                             ///< of limbs, beside those of a body mass index of 22
  float childhood;                             ///< 1 at 4 years, 0 from 18 on

  float thigh() const { return hip_z - knee_z; }   ///< from hip to knee
  float shin() const { return knee_z - ankle_z; }  ///< from knee to ankle
  float leg() const { return hip_z - ankle_z; }    ///< from hip to ankle
};

/// The shape of a person.
BodyShape shape_of(const Person& person);

}  // namespace parvis::people
