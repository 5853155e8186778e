// All rooms of the program, in the order in which they register what they bring: node types, processes,
// drawables, reflection methods, readers, bake steps. A room joins by its own folder and one line here, and
// defines the function that is declared below. The scene reference lists node types, and --help methods, in
// this order.
#pragma once

namespace parvis {
class Registries;
}

#define PARVIS_ROOMS(ROOM)                                                                 \
  ROOM(script)                                                                             \
  ROOM(gltf)                                                                               \
  ROOM(city_models)                                                                        \
  ROOM(ifc)                                                                                \
  ROOM(inventor)                                                                           \
  ROOM(terrain)                                                                            \
  ROOM(meshes)                                                                             \
  ROOM(dressing) /* before roads: carriageways are laid on the ground that is made here */ \
  ROOM(roads)                                                                              \
  ROOM(traffic)                                                                            \
  ROOM(tram)                                                                               \
  ROOM(noise)                                                                              \
  ROOM(sound)                                                                              \
  ROOM(people)                                                                             \
  ROOM(crowd)                                                                              \
  ROOM(light)                                                                              \
  ROOM(kerbside) /* after roads */                                                         \
  ROOM(action)                                                                             \
  ROOM(shadows) /* after light, whose shadows it replaces */                               \
  ROOM(realism)                                                                            \
  ROOM(lamps)         /* after shadows: its light is laid over that one */                 \
  ROOM(bounced_light) /* likewise; before what is baked in its light */                    \
  ROOM(probes)                                                                             \
  ROOM(environment_rays)                                                                   \
  ROOM(traced)                                                                             \
  ROOM(local_maps)                                                                         \
  ROOM(reflector_maps)                                                                     \
  ROOM(reference_maps)                                                                     \
  ROOM(virtual_objects)                                                                    \
  ROOM(refraction)                                                                         \
  ROOM(lit_objects) /* after all processes that move things */                             \
  ROOM(facades)                                                                            \
  ROOM(trees)                                                                              \
  ROOM(vegetation)                                                                         \
  ROOM(design) /* after vegetation, whose plants it places */                              \
  ROOM(devices)                                                                            \
  ROOM(view_dependent_objects)                                                             \
  ROOM(plan_drawing)

/// Declares each room's function, in its namespace, that adds its contributions to the registries.
#define PARVIS_DECLARE_ROOM(name)             \
  namespace parvis::name {                    \
  void register_room(Registries& registries); \
  }
PARVIS_ROOMS(PARVIS_DECLARE_ROOM)
#undef PARVIS_DECLARE_ROOM
