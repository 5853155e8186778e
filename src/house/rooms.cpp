#include "house/rooms.h"

#include "reflections/methods/registry.h"
#include "room_list.h"

namespace parvis::house {
namespace {

#define PARVIS_FURNISH(name) name::furnish,
constexpr Furnish rooms[]{PARVIS_ROOMS(PARVIS_FURNISH)};
#undef PARVIS_FURNISH

}  // namespace

House make_house(std::span<const Furnish> more) {
  House house;
  for (const Furnish furnish : rooms) furnish(house);
  for (const Furnish furnish : more) furnish(house);
  // The node's attributes are those of every method, so it comes last.
  methods::add_reflection_node(house.get<scene::NodeRegistry>(), house.get<methods::Registry>());
  return house;
}

const House& all_rooms() {
  static const House house = make_house();
  return house;
}

}  // namespace parvis::house
