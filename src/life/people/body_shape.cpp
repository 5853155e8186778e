#include "life/people/body_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace parvis::people {
namespace {

/// A value at an age.
struct AtAge {
  float age, value;
};

constexpr std::array<AtAge, 13> male_stature{{{4, 1.02f},
                                              {6, 1.15f},
                                              {8, 1.28f},
                                              {10, 1.39f},
                                              {12, 1.49f},
                                              {14, 1.64f},
                                              {16, 1.735f},
                                              {18, 1.76f},
                                              {40, 1.76f},
                                              {60, 1.745f},
                                              {70, 1.73f},
                                              {80, 1.705f},
                                              {95, 1.69f}}};
constexpr std::array<AtAge, 13> female_stature{{{4, 1.01f},
                                                {6, 1.15f},
                                                {8, 1.275f},
                                                {10, 1.38f},
                                                {12, 1.515f},
                                                {14, 1.60f},
                                                {16, 1.625f},
                                                {18, 1.63f},
                                                {40, 1.62f},
                                                {60, 1.605f},
                                                {70, 1.59f},
                                                {80, 1.56f},
                                                {95, 1.54f}}};
constexpr std::array<AtAge, 5> male_head{
    {{4, 0.187f}, {6, 0.194f}, {10, 0.206f}, {14, 0.220f}, {18, 0.231f}}};
constexpr std::array<AtAge, 5> female_head{
    {{4, 0.185f}, {6, 0.191f}, {10, 0.203f}, {14, 0.213f}, {18, 0.218f}}};
constexpr float stature_deviation_m = 0.068f;  // of adults

float at_age(std::span<const AtAge> table, float age) {
  if (age <= table.front().age) return table.front().value;
  for (std::size_t i = 1; i < table.size(); ++i)
    if (age <= table[i].age)
      return std::lerp(table[i - 1].value, table[i].value,
                       (age - table[i - 1].age) / (table[i].age - table[i - 1].age));
  return table.back().value;
}

}  // namespace

float mean_stature_m(Sex sex, float age) {
  return sex == Sex::male ? at_age(male_stature, age) : at_age(female_stature, age);
}

BodyShape shape_of(const Person& person) {
  const bool is_female = person.sex == Sex::female;
  const float adult_m = is_female ? 1.63f : 1.76f;
  BodyShape s{};
  const float mean = mean_stature_m(person.sex, person.age);
  s.childhood = std::clamp((18.0f - person.age) / 14.0f, 0.0f, 1.0f);
  s.stature = mean + person.taller_sd * stature_deviation_m * mean / adult_m;
  const float h = s.stature;
  s.head = at_age(is_female ? std::span<const AtAge>(female_head) : std::span<const AtAge>(male_head),
                  person.age) *
           std::pow(h / mean, 0.4f);
  s.chin_z = h - s.head;
  s.neck_z = s.chin_z - 0.022f * h;
  s.shoulder_z = s.chin_z - 0.056f * h;
  // Legs of small children are short: sitting height is 0.56 of the stature at 4 years and 0.52 at 18.
  s.hip_z = (0.520f - 0.045f * s.childhood) * h;
  s.knee_z = (0.283f - 0.022f * s.childhood) * h;
  s.ankle_z = 0.043f * h;
  s.shoulder_y = (is_female ? 0.091f : 0.102f) * h * (1.0f - 0.04f * s.childhood);
  s.hip_y = 0.052f * h;
  s.upper_arm = 0.176f * h, s.forearm = 0.146f * h;
  s.hand = 0.108f * h;
  s.foot = 0.152f * h;
  // Mass over stature squared goes with the product of breadth and depth: half of its exponent each.
  const float build = std::sqrt(person.bmi / 22.0f), soft = build * build;
  s.thickness = build;
  s.chest_half = (is_female ? 0.084f : 0.095f) * h * build;
  s.waist_half = (is_female ? 0.073f : 0.083f) * h * std::pow(soft, 0.8f);
  s.hips_half = (is_female ? 0.104f : 0.096f) * h * build;
  s.chest_depth = (is_female ? 0.058f : 0.066f) * h * build;
  s.waist_depth = (is_female ? 0.052f : 0.057f) * h * std::pow(soft, 0.9f);
  s.hips_depth = (is_female ? 0.066f : 0.063f) * h * build;
  s.bust = is_female && person.age > 13.0f ? 0.022f * h * build : 0.0f;
  s.belly = std::max(0.0f, person.bmi - 24.0f) * 0.0028f * h;
  if (s.childhood > 0.3f) s.waist_half = std::lerp(s.waist_half, 0.088f * h * build, s.childhood);
  return s;
}

}  // namespace parvis::people
