#include "house/rooms.h"

#include "capture/facades/room.h"
#include "capture/trees/room.h"
#include "capture/view_dependent_objects/room.h"
#include "formats/city_models/room.h"
#include "formats/gltf/room.h"
#include "formats/ifc/room.h"
#include "formats/inventor/room.h"
#include "formats/meshes/room.h"
#include "formats/terrain/room.h"
#include "graphics/bounced_light/room.h"
#include "graphics/lamps/room.h"
#include "graphics/light/room.h"
#include "graphics/lit_objects/room.h"
#include "graphics/shadows/room.h"
#include "life/crowd/room.h"
#include "life/traffic/room.h"
#include "life/vegetation/room.h"
#include "places/dressing/room.h"
#include "places/kerbside/room.h"
#include "planning/design/room.h"
#include "planning/plan_drawing/room.h"
#include "reflections/environment_rays/room.h"
#include "reflections/local_maps/room.h"
#include "reflections/methods/registry.h"
#include "reflections/probes/room.h"
#include "reflections/reference_maps/room.h"
#include "reflections/reflector_maps/room.h"
#include "reflections/refraction/room.h"
#include "reflections/traced/room.h"
#include "reflections/virtual_objects/room.h"
#include "scene/action/room.h"
#include "scene/roads/room.h"
#include "scene/script/room.h"

namespace parvis::house {
namespace {

/// One line per room. The scene reference lists node types, and --help methods, in this order.
constexpr Furnish rooms[]{
    script::furnish,
    gltf::furnish,
    city_models::furnish,
    ifc::furnish,
    inventor::furnish,
    terrain::furnish,
    meshes::furnish,
    dressing::furnish,  // before roads: see its docstring
    roads::furnish,
    traffic::furnish,
    crowd::furnish,
    light::furnish,
    kerbside::furnish,  // after roads
    action::furnish,
    shadows::furnish,        // after light, whose shadows it replaces
    lamps::furnish,          // after shadows: its light is laid over that one
    bounced_light::furnish,  // likewise; before what is baked in its light
    probes::furnish,
    environment_rays::furnish,
    traced::furnish,
    local_maps::furnish,
    reflector_maps::furnish,
    reference_maps::furnish,
    virtual_objects::furnish,
    refraction::furnish,
    lit_objects::furnish,  // after all processes that move things
    facades::furnish,
    trees::furnish,
    vegetation::furnish,
    design::furnish,  // after vegetation, whose plants it places
    view_dependent_objects::furnish,
    plan_drawing::furnish,
};

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
