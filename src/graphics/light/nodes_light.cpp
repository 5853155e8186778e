// sun, sky, air, exposure: light and how it is shown. Each stands once in a scene.
#include <cmath>
#include <filesystem>

#include "base/content_hash.h"
#include "base/registries.h"
#include "graphics/light/day_light.h"
#include "graphics/light/nodes_day_light.h"
#include "graphics/light/nodes_shadow_map.h"
#include "graphics/light/nodes_sun_path.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/light/sky_picture.h"
#include "graphics/light/sun_and_sky.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::scene {
namespace {

NodeSchema sun_schema() {
  using namespace attribute;
  return {.type = "sun",
          .help =
              "Sunlight; where to find the sun is given as a direction or as azimuth and elevation. "
              "dayLight replaces it.",
          .attributes = {vec3("direction", "points to the sun; any length")
                             .by_default("0.45 -0.55 0.70")
                             .replacing({"azimuth_deg", "elevation_deg"})
                             .live(),
                         angle("azimuth_deg", "compass direction of the sun: 0 north, 90 east")
                             .in("degrees")
                             .replacing({"direction"})
                             .live(),
                         angle("elevation_deg",
                               "height of the sun above the horizon; below it the sun does not shine")
                             .in("degrees")
                             .between(-90, 90)
                             .by_default("45")
                             .replacing({"direction"})
                             .live(),
                         colour("irradiance", "on a plane that faces the sun")
                             .in("W/m2")
                             .from(0)
                             .by_default("3.0 2.75 2.35")
                             .live()},
          .example = "sun(azimuth_deg=140, elevation_deg=40, irradiance=\"3.0 2.75 2.35\")",
          .is_unique = true};
}

glm::vec3 direction_of(float azimuth, float elevation) {
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

void build_sun(const Node& node, SceneBuilder& builder) {
  const bool by_angles = node.gives("azimuth_deg") || node.gives("elevation_deg");
  if (by_angles && node.gives("direction"))
    builder.fail(error_at(node.where_of("direction"),
                          "a sun takes direction= or azimuth_deg= and elevation_deg=, "
                          "not both"));
  const glm::vec3 direction = by_angles ? direction_of(node.angle("azimuth_deg"), node.angle("elevation_deg"))
                                        : node.vec3("direction");
  if (glm::length(direction) < 1e-6f)
    return builder.fail(error_at(node.where_of("direction"), "the sun's direction has no length"));
  if (builder.scene.data<light::DayLight>().is_given) return;
  const bool is_up = direction.z > 0.0f;
  light::set_sun(builder.scene,
                 {glm::normalize(direction), is_up ? node.vec3("irradiance") : glm::vec3(0.0f)});
}

NodeSchema sky_schema() {
  using namespace attribute;
  return {
      .type = "sky",
      .help =
          "A picture of the whole sky: background and ambient light. Without a file the sky is plain blue. "
          "dayLight replaces it.",
      .attributes = {file("file", "equirectangular picture, twice as wide as high (.hdr, .exr)"),
                     number("intensity", "multiplies the picture").between(0, 1e6).by_default("1").live(),
                     angle("heading_deg",
                           "turns the picture, clockwise from above; at 0 its middle lies north")
                         .in("degrees")
                         .by_default("0")
                         .live()},
      .example = "sky(file=\"hdri/park.hdr\", intensity=0.8, heading_deg=90)",
      .is_unique = true};
}

void build_sky(const Node& node, SceneBuilder& builder) {
  if (builder.scene.data<light::DayLight>().is_given) return;
  Sky& sky = builder.scene.sky;
  sky.intensity = float(node.number("intensity"));
  sky.heading = node.angle("heading_deg");
  const std::filesystem::path file = node.file("file");
  ContentHash content;
  content.add_text(file.string());
  const int version = file.empty() ? Sky().version : int(content.value());
  if (version == sky.version) return;  // it is there already
  std::optional<ImageF> picture = file.empty() ? ImageF() : light::read_sky_picture(node, "file", builder);
  if (!picture) return;
  sky.picture = std::move(*picture);
  sky.version = version;
}

NodeSchema air_schema() {
  using namespace attribute;
  return {.type = "air",
          .help = "Haze that lightens what is far away.",
          .attributes =
              {number("haze_per_m", "extinction of the air").in("1/m").between(0, 1).by_default("0").live()},
          .example = "air(haze_per_m=0.0004)",
          .is_unique = true};
}

NodeSchema exposure_schema() {
  using namespace attribute;
  return {.type = "exposure",
          .help = "How bright the picture is.",
          .attributes = {number("value",
                                "multiplies radiance before the tone curve; with dayLight: what that chooses")
                             .between(1e-6, 1e6)
                             .by_default("1")
                             .live()},
          .example = "exposure(value=1.2)",
          .is_unique = true};
}

}  // namespace

}  // namespace parvis::scene

/// Adds the node types, and sun and sky as lights.
void parvis::light::register_room(Registries& registries) {
  using namespace parvis::scene;
  registries.get<render::Lights>().make = light::sun_and_sky;
  NodeRegistry& registry = registries.get<NodeRegistry>();
  registry.add(sun_schema(), build_sun);
  registry.add(sky_schema(), build_sky);
  light::add_day_light_nodes(registry);
  light::add_shadow_map_node(registry);
  light::add_sun_path(registries);
  registry.add(air_schema(), [](const Node& node, SceneBuilder& builder) {
    builder.scene.haze_per_m = float(node.number("haze_per_m"));
  });
  registry.add(exposure_schema(), [](const Node& node, SceneBuilder& builder) {
    light::DayLight& day = builder.scene.data<light::DayLight>();
    day.chosen_exposure = float(node.number("value"));
    builder.scene.exposure = day.chosen_exposure * day.adaptation;
  });
}
