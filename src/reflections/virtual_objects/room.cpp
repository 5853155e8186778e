#include "base/registries.h"
#include "reflections/methods/registry.h"
#include "reflections/reflector_maps/settings.h"
#include "reflections/virtual_objects/long_edges.h"
#include "reflections/virtual_objects/search_settings.h"
#include "reflections/virtual_objects/virtual_objects.h"
#include "room_list.h"
#include "scene/script/attribute.h"

namespace parvis::virtual_objects {

using namespace reflection_search;
using namespace reflector_maps;
namespace {

using scene::AttributeSchema, scene::AttributeType;

std::vector<AttributeSchema> virtual_object_attributes() {
  using namespace scene::attribute;
  const SearchSettings defaults;
  const NearObjectSettings near;
  return {
      number("virtual_within",
             "people, trees, cars that stand wholly within this distance of a mirror are drawn as virtual "
             "objects, where ray tracing has them, over what the method shows beyond; 0: none. "
             "(virtual_objects draws everything so, whatever its distance.)")
          .in("m")
          .between(0, 1000)
          .by_default(fmt::format("{}", near.within_m))
          .live(),
      number("virtual_grid",
             "of virtual objects: reflection points are searched for the corners of a grid about each mesh, "
             "at most this share of as many as it has vertices, and its vertices are interpolated between "
             "them; 1: for each vertex itself. With level_of_detail fewer where that is not seen")
          .between(0, 1)
          .by_default(fmt::format("{}", defaults.grid_share))
          .live(),
      choice(
          "search",
          "of virtual objects: how reflection points are searched for; midpoint is the method of Estalella "
          "and others 2005, drawn however far it has come (mirrors in mirrors are searched for by newton)",
          {search_method_names.begin(), search_method_names.end()})
          .by_default(search_method_names[0])
          .live(),
      integer("iterations", "of search=midpoint")
          .between(1, 100)
          .by_default(fmt::format("{}", defaults.iterations))
          .live()};
}

void read_virtual_objects(const scene::Node& node, methods::Settings& settings) {
  settings.own.get<NearObjectSettings>().within_m = float(node.number("virtual_within"));
  SearchSettings& own = settings.own.get<SearchSettings>();
  own.grid_share = float(node.number("virtual_grid"));
  for (std::size_t i = 0; i < search_method_names.size(); ++i)
    if (node.text("search") == search_method_names[i]) own.search = SearchMethod(i);
  own.iterations = int(node.integer("iterations"));
}

}  // namespace

/// Adds them to Parvis's registries.
void register_room(Registries& registries) {
  methods::Registry& registry = registries.get<methods::Registry>();
  registry.add({.name = virtual_objects_method,
                .help = "every object by its virtual image: each vertex at its reflection point",
                .make = make_virtual_objects,
                .lies_over = "time_sliced_cube_map",
                .attributes = virtual_object_attributes(),
                .read = read_virtual_objects,
                .prepare = divide_long_edges,
                .unused_bake_steps = {"reference maps"}});
  registry.add({.name = "near virtual objects",
                .help = "what stands near a mirror by its virtual image, over what another method shows",
                .make = make_virtual_objects,
                .is_overlay = true,
                .is_wanted = shows_near_objects});
}

}  // namespace parvis::virtual_objects
