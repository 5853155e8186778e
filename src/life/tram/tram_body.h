// An articulated low-floor tram of five sections, and how its sections lie on a track: the first, third and
// last rest on bogies, whose axles are on the rails; the second and fourth hang between the joints of their
// neighbours.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "scene/data/model.h"
#include "scene/data/path.h"

namespace parvis::tram {

inline constexpr int section_count = 5;
inline constexpr float width_m = 2.40f, height_m = 3.30f;
inline constexpr float wheelbase_m = 1.70f;   ///< of a bogie
inline constexpr float gauge_m = 1.435f;      ///< between the inner faces of the rails
inline constexpr float min_radius_m = 18.0f;  ///< of curves that the joints allow
inline constexpr float max_gradient = 0.09f;  ///< that the vehicle climbs

/// Lengths of the sections between their joints, from the front, metres.
inline constexpr std::array<float, section_count> section_length_m{6.8f, 6.6f, 5.2f, 6.6f, 6.8f};
/// Distance from a section's front to the middle of its bogie, if it has one.
inline constexpr std::array<float, section_count> bogie_m{4.6f, 0.0f, 2.6f, 0.0f, 2.2f};
/// Length of the whole tram.
inline constexpr float length_m = 32.0f;

/// Sections alike in shape share a model.
enum class SectionKind : std::uint8_t { front, hung, middle, rear };
inline constexpr std::array<SectionKind, section_count> kind_of_section{
    SectionKind::front, SectionKind::hung, SectionKind::middle, SectionKind::hung, SectionKind::rear};

/// The model of a section: x forward, origin below its front end at the height of the rails. Nodes after the
/// root are door leaves (hung sections) and wheels. `colour`: of the lacquer, linear.
std::shared_ptr<const scene::Model> section_model(SectionKind kind, glm::vec3 colour);

/// Poses of the nodes of a section: doors open by 0..1 on one side, wheels turned after `travelled_m`.
std::vector<glm::mat4> section_pose(const scene::Model& model, float doors, bool is_left_side,
                                    double travelled_m);

/// Distances of the middles of the doors of a tram from its front, metres.
std::vector<float> doors_behind_front();

/// world_from_model of all sections of a tram whose front is at `front_m` of a track.
std::array<glm::mat4, section_count> placed_sections(const scene::MeasuredPath& track, double front_m);

}  // namespace parvis::tram
