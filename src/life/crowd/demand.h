// How many people a scene asks for, and who they are.
#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "life/crowd/flows.h"
#include "life/crowd/person_model.h"
#include "scene/data/room_data.h"

namespace parvis::crowd {

/// Settings by the node `crowd`.
struct CrowdDemand {
  static constexpr std::string_view name = "crowd.demand";
  static constexpr scene::DataRole role =
      scene::DataRole::settings;  // pictures show the people, which are objects
  int people = 0;
  std::uint64_t seed = 1;
  glm::vec2 centre{0.0f};
  float radius_m = 80.0f;
  bool is_visible = true;
  std::vector<PersonModel> models;
  std::vector<Flow> flows;  ///< in the world; none: people walk between places of their own choice

  void hash(ContentHash& hash) const {
    hash.add(people), hash.add(seed), hash.add(centre), hash.add(radius_m), hash.add(is_visible);
    for (const Flow& flow : flows) hash.add(flow.from), hash.add(flow.to), hash.add(flow.per_hour);
    for (const PersonModel& person : models) hash.add_text(person.model->name), hash.add(person.cycle_m);
  }
};

}  // namespace parvis::crowd
