#include "graphics/light/nodes_day_light.h"

#include <filesystem>
#include <memory>

#include "graphics/light/day_light.h"
#include "graphics/light/sky_picture.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"

namespace parvis::light {
namespace {

using scene::AttributeSchema;

AttributeSchema live_number(std::string name, std::string help, std::string fallback, std::string unit,
                            double min, double max, std::vector<std::string> spellings = {}) {
  return scene::attribute::number(std::move(name), std::move(help))
      .in(std::move(unit))
      .between(min, max)
      .by_default(std::move(fallback))
      .spelled(std::move(spellings))
      .live();
}

AttributeSchema live_integer(std::string name, std::string help, std::string fallback, double min,
                             double max) {
  return scene::attribute::integer(std::move(name), std::move(help))
      .between(min, max)
      .by_default(std::move(fallback))
      .live();
}

scene::NodeSchema day_light_schema() {
  using namespace scene::attribute;
  return {
      .type = "dayLight",
      .help =
          "Sun and sky of a place on the earth at an hour: in place of sun(...) and sky(...). Sets the "
          "exposure, too, which exposure(value=...) multiplies.",
      .attributes = {live_number("latitude", "north positive", "43.70", "degrees", -90, 90, {"lattitude"}),
                     live_number("longitude", "east positive", "7.27", "degrees", -180, 180),
                     live_number("standardMeridian",
                                 "the clock's time zone: hours ahead of universal time, east positive", "0",
                                 "h", -12, 14, {"standartMeridian"}),
                     live_integer("julianDay", "of the year: 1 is 1 January", "172", 1, 366),
                     live_number("timeOfDay", "by the clock, below 24: 14.25 is 14:15", "12", "h", 0, 24),
                     live_number("turbidity", "1 pure air, 2 to 6 clear days, 10 haze, 30 and more mist", "3",
                                 "", min_turbidity, max_turbidity, {"turbidy"}),
                     live_integer("year", "matters by some hundredths of a degree, and for 29 February",
                                  "2026", min_year, max_year),
                     choice("model",
                            "atmosphere: computed from scattering; preetham: the thesis's fit of 1999",
                            {sky_kind_names.begin(), sky_kind_names.end()})
                         .by_default(sky_kind_names[0])
                         .live()},
      .example =
          "dayLight(latitude=43.70, longitude=7.27, standardMeridian=1, julianDay=80, timeOfDay=17.5, "
          "turbidity=3)",
      .is_unique = true};
}

void relight(const scene::Node& node, scene::SceneBuilder& builder) {
  if (const Status status = light_scene(builder.scene); !status) builder.fail(status.errors(), node.where);
}

void build_day_light(const scene::Node& node, scene::SceneBuilder& builder) {
  DayLight& day = builder.scene.data<DayLight>();
  day.is_given = true;
  const PlaceAndTime when{node.number("latitude"),         node.number("longitude"),
                          node.number("standardMeridian"), int(node.integer("year")),
                          int(node.integer("julianDay")),  node.number("timeOfDay")};
  // A message that cannot be leaves all as it was, for those that read it, too.
  if (const Status status = check(when); !status) return builder.fail(status.errors(), node.where);
  day.when = when;
  day.when.true_north_deg = builder.scene.true_north_deg;
  day.air = {node.number("turbidity")};
  for (std::size_t i = 0; i < sky_kind_names.size(); ++i)
    if (node.text("model") == sky_kind_names[i]) day.kind = SkyKind(i);
  relight(node, builder);
}

scene::NodeSchema sky_dome_schema() {
  using namespace scene::attribute;
  return {.type = "skyDome",
          .help =
              "Clouds and land of a photographed sky, under the light of dayLight: cloud is where the "
              "photograph is not blue.",
          .attributes = {file("texture",
                              "equirectangular picture of the whole sky, twice as wide as high; without it "
                              "the sky is clear"),
                         angle("heading_deg",
                               "turns the picture, clockwise from above; at 0 its middle lies north")
                             .in("degrees")
                             .by_default("0")
                             .live()},
          .example = "dayLight(timeOfDay=10)\nskyDome(texture=\"hdri/park.hdr\", heading_deg=90)",
          .is_unique = true};
}

void build_sky_dome(const scene::Node& node, scene::SceneBuilder& builder) {
  DayLight& day = builder.scene.data<DayLight>();
  day.dome_node = node.where;
  day.dome_heading = node.angle("heading_deg");
  const std::filesystem::path file = node.file("texture");
  if (file.empty()) {
    day.dome = nullptr;
  } else if (file != day.dome_file) {
    std::optional<ImageF> picture = read_sky_picture(node, "texture", builder);
    if (!picture) return;
    if (picture->width != 2 * picture->height)
      return builder.fail(
          error_at(node.where_of("texture"),
                   "the picture of a whole sky is twice as wide as high; this one has {} x {} pixels",
                   picture->width, picture->height));
    day.dome = std::make_shared<const ImageF>(*std::move(picture));
  }
  day.dome_file = file;
  relight(node, builder);
}

/// Whatever their order in the script: a sky that nothing would show is an error.
void check_sky_dome(scene::SceneBuilder& builder) {
  const DayLight& day = builder.scene.data<DayLight>();
  if (!day.is_given && day.dome_node)
    builder.fail(error_at(*day.dome_node,
                          "skyDome lies over the sky of dayLight: add dayLight(...), or take sky(file=...) "
                          "for a photograph by itself"));
}

/// The map whose north is not the earth's may be that of a model after the node.
void turn_to_north(scene::SceneBuilder& builder) {
  const DayLight& day = builder.scene.data<DayLight>();
  if (!day.is_given || day.when.true_north_deg == builder.scene.true_north_deg) return;
  if (const Status status = light_scene(builder.scene); !status) builder.fail(status.errors());
}

}  // namespace

void add_day_light_nodes(scene::NodeRegistry& registry) {
  registry.add(day_light_schema(), build_day_light);
  registry.add(sky_dome_schema(), build_sky_dome);
  registry.add_finish_step(check_sky_dome);
  registry.add_finish_step(turn_to_north);
}

}  // namespace parvis::light
