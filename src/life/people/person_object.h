// Somebody as an object of a scene, for every node that shows people one by one.
#pragma once

#include <optional>
#include <string>

#include "life/people/person_model.h"
#include "scene/script/scene_builder.h"

namespace parvis::people {

/// The person that is asked for.
struct PersonRequest {
  std::uint64_t seed = 1;
  std::optional<Sex> sex = {};    ///< none: by the seed
  std::optional<float> age = {};  ///< in years; none: by the seed
  float speed_m_s = 1.3f;         ///< of who walks
  std::string does = "stand";     ///< an animation of `make_person`
  bool is_still = false;          ///< a posture in place of the animation
  bool holds_handle = false;      ///< of a pram, say
};

/// The person of a request without its colours: sex and age as asked for.
Someone someone_of(const PersonRequest& request);

/// An object of this model, which all objects of the same person share, in its posture; x forward, feet at
/// z = 0. Its name and place are the caller's.
scene::Object person_object(const PersonRequest& request, scene::SceneBuilder& builder);

}  // namespace parvis::people
