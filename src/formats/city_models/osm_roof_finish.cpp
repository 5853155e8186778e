#include "formats/city_models/osm_roof_finish.h"

#include <algorithm>
#include <array>

#include "formats/city_models/building_attributes.h"

namespace parvis::scene {
namespace {

/// The finish that a word in roof:material names.
struct NamedMaterial {
  const char *word, *finish;
};
constexpr std::array<NamedMaterial, 15> named_materials{{{"copper", "copper"},
                                                         {"metal", "metal"},
                                                         {"zinc", "metal"},
                                                         {"steel", "metal"},
                                                         {"alumin", "metal"},
                                                         {"lead", "metal"},
                                                         {"tin", "metal"},
                                                         {"glass", "glass"},
                                                         {"acrylic", "glass"},
                                                         {"polycarbonate", "glass"},
                                                         {"thatch", "thatch"},
                                                         {"reed", "thatch"},
                                                         {"grass", "green"},
                                                         {"sod", "green"},
                                                         {"plants", "green"}}};

/// The plain look of a finish: sRGB, and X3D's shininess.
struct Look {
  const char* finish;
  int red, green, blue;
  float shininess;
};
constexpr std::array<Look, 5> looks_of_finishes{{{"metal", 140, 149, 152, 0.25f},
                                                 {"copper", 112, 158, 138, 0.1f},  // as it weathers
                                                 {"glass", 96, 118, 128, 0.9f},
                                                 {"thatch", 138, 116, 82, 0.0f},
                                                 {"green", 92, 112, 62, 0.0f}}};
constexpr Look canopy{"metal", 206, 208, 206, 0.2f};

const char* given_finish(const OsmTags& tags) {
  const std::string& text = tag(tags, "roof:material");
  const auto found = std::ranges::find_if(
      named_materials, [&](const NamedMaterial& each) { return text.find(each.word) != std::string::npos; });
  return found == named_materials.end() ? nullptr : found->finish;
}

bool is_round(const std::string& shape) { return shape == "dome" || shape == "onion" || shape == "round"; }

}  // namespace

OsmRoofFinish finish_of_osm_roof(const OsmTags& tags, const std::string& shape, bool is_canopy,
                                 CityAssembly& city) {
  const char* given = given_finish(tags);
  if (!given && !is_round(shape) && !is_canopy) return {};
  const std::string name = given ? given : "metal";
  const Look& look =
      !given && is_canopy ? canopy : *std::ranges::find(looks_of_finishes, name, [](const Look& each) {
        return std::string(each.finish);
      });
  CityMaterial material;
  material.diffuse = colour_in(tag(tags, tag(tags, "roof:colour").empty() ? "roof:color" : "roof:colour"))
                         .value_or(glm::vec3(look.red, look.green, look.blue) / 255.0f);
  material.shininess = look.shininess;
  return {name, city.add_material(material)};
}

}  // namespace parvis::scene
