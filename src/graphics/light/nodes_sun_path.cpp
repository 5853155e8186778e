#include "graphics/light/nodes_sun_path.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "graphics/light/day_light.h"
#include "graphics/light/sun_path_model.h"
#include "graphics/light/sun_path_process.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::light {
namespace {

scene::NodeSchema sun_path_schema() {
  using namespace scene::attribute;
  return {
      .type = sun_path_type,
      .help =
          "Where the sun goes, as seen from a point: an arc with a bead at each full hour of the clock for "
          "certain days and for the present one, and the sun's disc where it stands now. It follows the "
          "place, the day and the hour of dayLight, which stands before it.",
      .attributes = {text("name", "by which other nodes refer to it"),
                     integer("julianDay",
                             "of the year, beside the day of dayLight; 0: 21 December, 21 March and 21 June "
                             "together")
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
  if (node.integer("julianDay") > 0) {
    PlaceAndTime when = day.when;
    when.day_of_year = int(node.integer("julianDay"));
    if (const Status status = check(when); !status)
      return builder.fail(status.errors(), node.where_of("julianDay"));
  }
  scene::Object object;
  object.name = node.gives("name") ? node.text("name") : "sun path";
  object.model = builder.shared_model(sun_path_type, sun_path_model);
  object.world_from_model =
      builder.world_from_parent() * glm::scale(glm::translate(glm::mat4(1.0f), node.vec3("position")),
                                               glm::vec3(float(node.number("radius"))));
  object.pose = sun_path_pose(day.when, sun_path_days(node, day.when.year));
  object.is_dynamic = true;  // no part of the place: what is baked does not depend on it
  object.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(object));
}

}  // namespace

std::vector<int> sun_path_days(const scene::Node& node, int year) {
  if (const long day = node.integer("julianDay"); day > 0) return {std::min(int(day), days_in_year(year))};
  return {day_of_year(year, 12, 21), day_of_year(year, 3, 21), day_of_year(year, 6, 21)};
}

void add_sun_path(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(sun_path_schema(), build_sun_path);
  registries.get<action::Processes>().add([] { return std::make_unique<SunPathProcess>(); });
}

}  // namespace parvis::light
