// What vertices are guessed to have while their rays are few: from their light where they stood before, from
// what places around see there and here, and from a few rays that judge which of these is nearest.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "graphics/light/vertex_light.h"

namespace parvis::lit_objects {

/// Irradiance of vertices by the sky, with what surfaces give back, and by the sun that comes straight.
struct SplitLight {
  std::vector<glm::vec3> sky, sun;
};

/// The sky of vertices as places around see it.
struct InterpolatedSky {
  std::vector<glm::vec3> irradiance, open;  ///< with what stands around, and as if nothing did
  float uncertainty = 0.0f;                 ///< light::VisibilityPlaces::uncertainty
};

/// The light of vertices where they had all their rays.
struct KnownLight {
  SplitLight traced;
  std::optional<InterpolatedSky> interpolated;  ///< of what may move
};

/// What is found of vertices that have moved, without rays to their sky.
struct Clues {
  InterpolatedSky interpolated;
  std::vector<glm::vec3> sun;  ///< by few rays
};

/// How far a guess goes from the known light towards what there is beside it.
struct GuessWeights {
  float sky = 0.0f;  ///< towards the known light of the sky, changed as the interpolated one has
  float sun = 0.0f;  ///< towards the sun by few rays
};

/// Finds weights by vertices that have been traced here and now.
class GuessJudge {
 public:
  /// What rays of its own found of vertex `v` of those that `known` and `now` are about.
  void add(const KnownLight& known, const Clues& now, std::size_t v, glm::vec3 traced_sky,
           glm::vec3 traced_sun);
  /// Those for which guesses are nearest to all that was added, by the sum of the squares of what they are
  /// off: the rays' own errors are not those of the guesses, and fall out of it.
  GuessWeights weights() const;

 private:
  std::vector<glm::vec3> sky_, wanted_sky_, sun_, wanted_sun_;  ///< differences from the known light
};

/// What `known` says of vertices under `now`.
SplitLight guessed_light(const KnownLight& known, const Clues& now, const GuessWeights& weights);

/// The guess and what rays have found so far, each by its weight (light::weight_of_rays).
SplitLight mixed(const SplitLight& guess, const light::VertexLight& traced);

}  // namespace parvis::lit_objects
