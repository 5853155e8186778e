#include "rooms/rooms.h"

#include "reflections/methods/registry.h"
#include "room_list.h"

namespace parvis::rooms {
namespace {

#define PARVIS_REGISTER(name) name::register_room,
constexpr RegisterRoom rooms[]{PARVIS_ROOMS(PARVIS_REGISTER)};
#undef PARVIS_REGISTER

}  // namespace

Registries make_registries(std::span<const RegisterRoom> more) {
  Registries registries;
  for (const RegisterRoom register_room : rooms) register_room(registries);
  for (const RegisterRoom register_room : more) register_room(registries);
  // The node's attributes are those of every method, so it comes last.
  methods::add_reflection_node(registries.get<scene::NodeRegistry>(), registries.get<methods::Registry>());
  return registries;
}

const Registries& all_registries() {
  static const Registries registries = make_registries();
  return registries;
}

}  // namespace parvis::rooms
