// The rooms of a scene, for tests of what they do together.
#pragma once

#include "base/registries.h"
#include "room_list.h"

namespace parvis::scene {

inline Registries test_registries() {
  Registries registries;
  for (const auto register_room : {script::register_room, gltf::register_room, city_models::register_room,
                                   terrain::register_room, meshes::register_room, roads::register_room,
                                   traffic::register_room, light::register_room, action::register_room})
    register_room(registries);
  return registries;
}

}  // namespace parvis::scene
