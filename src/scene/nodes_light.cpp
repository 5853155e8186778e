// sun, sky, air, exposure, reflection: light and how it is shown. Each stands once in a scene.
#include <cmath>

#include "base/image_io.h"
#include "scene/node_registry.h"
#include "scene/nodes.h"
#include "scene/scene_builder.h"

namespace parvis::scene {
namespace {

NodeSchema sun_schema() {
  return {.type = "sun",
          .help = "Sunlight; where to find the sun is given as a direction or as azimuth and elevation.",
          .attributes = {{.name = "direction",
                          .type = AttributeType::vec3,
                          .help = "points to the sun; any length",
                          .fallback = "0.45 -0.55 0.70",
                          .is_live = true,
                          .in_place_of = {"azimuth_deg", "elevation_deg"}},
                         {.name = "azimuth_deg",
                          .type = AttributeType::angle,
                          .help = "compass direction of the sun: 0 north, 90 east",
                          .unit = "degrees",
                          .is_live = true,
                          .in_place_of = {"direction"}},
                         {.name = "elevation_deg",
                          .type = AttributeType::angle,
                          .help = "height of the sun above the horizon",
                          .fallback = "45",
                          .unit = "degrees",
                          .minimum = -90,
                          .maximum = 90,
                          .is_live = true,
                          .in_place_of = {"direction"}},
                         {.name = "irradiance",
                          .type = AttributeType::colour,
                          .help = "on a plane that faces the sun",
                          .fallback = "3.0 2.75 2.35",
                          .unit = "W/m2",
                          .minimum = 0,
                          .is_live = true}},
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
  builder.scene.sun = {glm::normalize(direction), node.vec3("irradiance")};
}

NodeSchema sky_schema() {
  return {
      .type = "sky",
      .help =
          "A picture of the whole sky: background and ambient light. Without a file the sky is plain blue.",
      .attributes = {{.name = "file",
                      .type = AttributeType::file,
                      .help = "equirectangular picture, twice as wide as high (.hdr, .exr)"},
                     {.name = "intensity",
                      .type = AttributeType::number,
                      .help = "multiplies the picture",
                      .fallback = "1",
                      .minimum = 0,
                      .maximum = 1e6,
                      .is_live = true},
                     {.name = "heading_deg",
                      .type = AttributeType::angle,
                      .help = "turns the picture, clockwise from above; at 0 its middle lies north",
                      .fallback = "0",
                      .unit = "degrees",
                      .is_live = true}},
      .example = "sky(file=\"hdri/park.hdr\", intensity=0.8, heading_deg=90)",
      .is_unique = true};
}

void build_sky(const Node& node, SceneBuilder& builder) {
  Sky& sky = builder.scene.sky;
  sky.intensity = float(node.number("intensity"));
  sky.heading = node.angle("heading_deg");
  const std::filesystem::path file = node.file("file");
  if (file == sky.file) return;  // built again
  Result<ImageF> picture = file.empty() ? ImageF() : read_image_float(file);
  if (!picture) return builder.fail(picture.errors(), node.where_of("file"));
  sky.picture = std::move(*picture);
  sky.file = file;
}

NodeSchema air_schema() {
  return {.type = "air",
          .help = "Haze that lightens what is far away.",
          .attributes = {{.name = "haze_per_m",
                          .type = AttributeType::number,
                          .help = "extinction of the air",
                          .fallback = "0",
                          .unit = "1/m",
                          .minimum = 0,
                          .maximum = 1,
                          .is_live = true}},
          .example = "air(haze_per_m=0.0004)",
          .is_unique = true};
}

NodeSchema exposure_schema() {
  return {.type = "exposure",
          .help = "How bright the picture is.",
          .attributes = {{.name = "value",
                          .type = AttributeType::number,
                          .help = "multiplies radiance before the tone curve",
                          .fallback = "1",
                          .minimum = 1e-6,
                          .maximum = 1e6,
                          .is_live = true}},
          .example = "exposure(value=1.2)",
          .is_unique = true};
}

NodeSchema reflection_schema() {
  return {.type = "reflection",
          .help = "How the mirror-like parts of moving things see their surroundings.",
          .attributes =
              {{.name = "method",
                .type = AttributeType::choice,
                .help = "how reflections are made",
                .fallback = reflection_method_names[std::size_t(Reflection().method)],
                .choices = {reflection_method_names.begin(), reflection_method_names.end()},
                .is_live = true},
               {.name = "resolution",
                .type = AttributeType::integer,
                .help = "edge of one face of a cube map",
                .fallback = "128",
                .unit = "pixels",
                .minimum = 8,
                .maximum = 4096,
                .is_live = true},
               {.name = "level_of_detail",
                .type = AttributeType::flag,
                .help = "resolution by size on screen; far objects share one map",
                .fallback = "1",
                .is_live = true},
               {.name = "maps",
                .type = AttributeType::integer,
                .help = "reference maps along the streets, of the methods with environment_maps and of "
                        "simple_blend",
                .fallback = "240",
                .minimum = 1,
                .maximum = 2000,
                .is_live = true},
               {.name = "budget_ms",
                .type = AttributeType::number,
                .help = "the time of a frame that is held: the two methods with environment_maps make "
                        "less of small reflections, and windows draw fewer pixels, enlarged, where that is "
                        "not enough; pictures and films go by what reflections are known to cost and keep "
                        "their pixels; 0: none",
                .fallback = "0",
                .unit = "ms",
                .minimum = 0,
                .maximum = 1000,
                .is_live = true},
               {.name = "faces_a_frame",
                .type = AttributeType::integer,
                .help = "of time_sliced_cube_map: how many faces of maps a frame draws, over all reflectors; "
                        "0: one for each of them",
                .fallback = "0",
                .minimum = 0,
                .maximum = 1000,
                .is_live = true},
               {.name = "virtual_within",
                .type = AttributeType::number,
                .help = "people, trees, cars that stand wholly within this distance of a mirror are drawn as "
                        "virtual objects, where ray tracing has them, over what the method shows beyond; 0: "
                        "none. (virtual_objects draws everything so, whatever its distance.)",
                .fallback = "0",
                .unit = "m",
                .minimum = 0,
                .maximum = 1000,
                .is_live = true},
               {.name = "bounces",
                .type = AttributeType::integer,
                .help = "of virtual_objects and of the ray tracer: 2, what a mirror shows in a mirror is "
                        "drawn, too; 1: mirrors in mirrors show the sky",
                .fallback = "1",
                .minimum = 1,
                .maximum = 2,
                .is_live = true},
               {.name = "virtual_grid",
                .type = AttributeType::number,
                .help = "of virtual objects: reflection points are searched for the corners of a grid about "
                        "each mesh, at most this share of as many as it has vertices, and its vertices are "
                        "interpolated between them; 1: for each vertex itself. With level_of_detail fewer "
                        "where that is not seen",
                .fallback = "1",
                .minimum = 0,
                .maximum = 1,
                .is_live = true},
               {.name = "search",
                .type = AttributeType::choice,
                .help = "of virtual objects: how reflection points are searched for; midpoint is the method "
                        "of Estalella and others 2005, drawn however far it has come (mirrors in mirrors are "
                        "searched for by newton)",
                .fallback = reflection_search_names[0],
                .choices = {reflection_search_names.begin(), reflection_search_names.end()},
                .is_live = true},
               {.name = "iterations",
                .type = AttributeType::integer,
                .help = "of search=midpoint",
                .fallback = "9",
                .minimum = 1,
                .maximum = 100,
                .is_live = true},
               {.name = "show",
                .type = AttributeType::choice,
                .help = "of local_environment_maps, to look into it: its mesh in red over the maps, or "
                        "the weights of the two reference maps in red and green, blue where neither "
                        "sees what is mirrored",
                .fallback = reflection_view_names[0],
                .choices = {reflection_view_names.begin(), reflection_view_names.end()},
                .is_live = true}},
          .example = "reflection(method=\"rerendered_cube_map\", resolution=128)",
          .is_unique = true};
}

void build_reflection(const Node& node, SceneBuilder& builder) {
  Reflection& reflection = builder.scene.reflection;
  for (std::size_t i = 0; i < reflection_method_names.size(); ++i)
    if (node.text("method") == reflection_method_names[i]) reflection.method = ReflectionMethod(i);
  reflection.resolution = int(node.integer("resolution"));
  reflection.uses_level_of_detail = node.flag("level_of_detail");
  reflection.most_maps = int(node.integer("maps"));
  reflection.budget_ms = float(node.number("budget_ms"));
  reflection.faces_a_frame = int(node.integer("faces_a_frame"));
  reflection.virtual_within_m = float(node.number("virtual_within"));
  reflection.bounces = int(node.integer("bounces"));
  reflection.virtual_grid = float(node.number("virtual_grid"));
  for (std::size_t i = 0; i < reflection_search_names.size(); ++i)
    if (node.text("search") == reflection_search_names[i]) reflection.search = ReflectionSearch(i);
  reflection.iterations = int(node.integer("iterations"));
  for (std::size_t i = 0; i < reflection_view_names.size(); ++i)
    if (node.text("show") == reflection_view_names[i]) reflection.shown = ReflectionView(i);
}

}  // namespace

void add_light_nodes(NodeRegistry& registry) {
  registry.add(sun_schema(), build_sun);
  registry.add(sky_schema(), build_sky);
  registry.add(air_schema(), [](const Node& node, SceneBuilder& builder) {
    builder.scene.haze_per_m = float(node.number("haze_per_m"));
  });
  registry.add(exposure_schema(), [](const Node& node, SceneBuilder& builder) {
    builder.scene.exposure = float(node.number("value"));
  });
  registry.add(reflection_schema(), build_reflection);
}

}  // namespace parvis::scene
