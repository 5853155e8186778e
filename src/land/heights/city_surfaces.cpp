#include "land/heights/city_surfaces.h"

#include <array>

#include "base/colour.h"

namespace parvis::scene {
namespace {

struct Look {
  const char* name;
  int red, green, blue;  ///< sRGB
  float roughness;
  bool is_ground;
};
constexpr std::array<Look, 26> looks{{{"WallSurface", 203, 191, 168, 0.85f, false},
                                      {"RoofSurface", 150, 92, 70, 0.8f, false},
                                      {"GroundSurface", 120, 114, 106, 0.9f, false},
                                      {"Window", 40, 46, 52, 0.08f, false},
                                      {"Door", 94, 72, 54, 0.6f, false},
                                      {"OuterCeilingSurface", 190, 186, 178, 0.85f, false},
                                      {"OuterFloorSurface", 150, 146, 140, 0.85f, false},
                                      {"InteriorWallSurface", 226, 222, 212, 0.9f, false},
                                      {"CeilingSurface", 236, 234, 228, 0.9f, false},
                                      {"FloorSurface", 150, 120, 88, 0.6f, false},
                                      {"BuildingFurniture", 148, 112, 76, 0.6f, false},
                                      {"Road", 62, 63, 66, 0.9f, true},
                                      {"TrafficArea", 62, 63, 66, 0.9f, true},
                                      {"AuxiliaryTrafficArea", 150, 144, 136, 0.9f, true},
                                      {"TransportSquare", 140, 132, 122, 0.9f, true},
                                      {"Railway", 110, 100, 92, 0.9f, true},
                                      {"WaterBody", 40, 58, 62, 0.06f, true},
                                      {"WaterSurface", 40, 58, 62, 0.06f, true},
                                      {"PlantCover", 84, 108, 52, 0.95f, true},
                                      {"SolitaryVegetationObject", 66, 92, 44, 0.95f, false},
                                      {"LandUse", 158, 150, 138, 0.9f, true},
                                      {"TINRelief", 132, 126, 112, 0.95f, true},
                                      {"Bridge", 150, 144, 136, 0.85f, false},
                                      {"Tunnel", 120, 116, 110, 0.85f, false},
                                      {"CityFurniture", 70, 74, 78, 0.6f, false},
                                      {"GenericCityObject", 146, 140, 130, 0.9f, true}}};

const Look* find(const std::string& name) {
  for (const Look& look : looks)
    if (name == look.name) return &look;
  return nullptr;
}

/// The look of a type: CityJSON's derived types begin with it ("BridgePart"), others are alike.
std::string type_name(const std::string& object_type) {
  for (const Look& look : looks)
    if (object_type.starts_with(look.name)) return look.name;
  return object_type == "Waterway" ? "WaterBody" : "GenericCityObject";
}

}  // namespace

bool is_building(const std::string& object_type) {
  return (object_type.find("Building") != std::string::npos && object_type != "BuildingFurniture") ||
         object_type == "OtherConstruction";
}

std::string surface_name(const std::string& semantics, const std::string& object_type, float up) {
  std::string type = type_name(object_type);
  // Walls and roofs of a bridge are no houses', and what of a road is driven on is road.
  const bool is_of_structure = (type == "Bridge" || type == "Tunnel") && semantics.ends_with("Surface");
  if (is_of_structure || semantics == "TrafficArea") return type;
  if (find(semantics)) return semantics;
  if (!is_building(object_type)) return type;
  constexpr float steep = 0.34f;  // cosine of 70 degrees
  if (up > steep) return "RoofSurface";
  return up < -steep ? "GroundSurface" : "WallSurface";
}

Material surface_material(const std::string& name) {
  const Look& look = *find(name);
  Material material;
  material.name = name;
  material.base_colour = linear_from_srgb8(look.red, look.green, look.blue);
  material.roughness = look.roughness;
  return material;
}

bool is_ground(const std::string& name) {
  const Look* look = find(name.substr(0, name.find(' ')));
  return look != nullptr && look->is_ground;
}

bool is_below_ground(const std::string& name) { return name.ends_with(" below ground"); }

bool is_city_surface(const std::string& name) { return find(name.substr(0, name.find(' '))) != nullptr; }

}  // namespace parvis::scene
