#include "graphics/light/nodes_sun_path.h"

#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "graphics/light/day_light.h"
#include "graphics/light/sun_path_model.h"
#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::light {
namespace {

using namespace scene::attribute;

scene::NodeSchema sun_path_schema() {
  return {
      .type = "sunPath",
      .help =
          "Where the sun goes over a day, as an arc about a point with a bead at each full hour of the "
          "clock: "
          "of the place and the year of dayLight, which stands before it; messages to that do not move it.",
      .attributes = {text("name", "by which other nodes refer to it"),
                     integer("julianDay", "of the year; 0: 21 December, 21 March and 21 June together")
                         .between(0, 366)
                         .by_default("0")
                         .live(),
                     vec3("position", "of the point from which the sun is seen there")
                         .in("m")
                         .by_default("0 0 0")
                         .live(),
                     number("radius", "of the arcs").in("m").between(0.1, 10'000).by_default("40").live(),
                     scene::visible_attribute()},
      .example =
          "dayLight(latitude=43.70, longitude=7.27, standardMeridian=1)\n"
          "sunPath(position=\"0 0 1.6\", radius=30)"};
}

void build_sun_path(const scene::Node& node, scene::SceneBuilder& builder) {
  const DayLight& day = builder.scene.data<DayLight>();
  if (!day.is_given)
    return builder.fail(
        error_at(node.where, "sunPath needs a dayLight before it, which says where on the earth it is"));
  std::vector<int> days{day_of_year(day.when.year, 12, 21), day_of_year(day.when.year, 3, 21),
                        day_of_year(day.when.year, 6, 21)};
  if (node.integer("julianDay") > 0) {
    days = {int(node.integer("julianDay"))};
    PlaceAndTime when = day.when;
    when.day_of_year = days.front();
    if (const Status status = check(when); !status)
      return builder.fail(status.errors(), node.where_of("julianDay"));
  }
  scene::Object object;
  object.name = node.gives("name") ? node.text("name") : "sun path";
  object.model = sun_path_model(day.when, days, float(node.number("radius")));
  object.world_from_model =
      builder.world_from_parent() * glm::translate(glm::mat4(1.0f), node.vec3("position"));
  object.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(object));
}

}  // namespace

void add_sun_path_node(scene::NodeRegistry& registry) { registry.add(sun_path_schema(), build_sun_path); }

}  // namespace parvis::light
