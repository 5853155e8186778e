#include "land/heights/city_surfaces.h"

#include <gtest/gtest.h>

namespace parvis::scene {
namespace {

TEST(CitySurfaces, TakeTheNameOfTheirKindOrOfTheirObject) {
  EXPECT_EQ(surface_name("RoofSurface", "BuildingPart", 1.0f), "RoofSurface");
  EXPECT_EQ(surface_name("", "Building", 1.0f), "RoofSurface");
  EXPECT_EQ(surface_name("", "Building", 0.0f), "WallSurface");
  EXPECT_EQ(surface_name("", "Road", 1.0f), "Road");
  EXPECT_EQ(surface_name("AuxiliaryTrafficArea", "Road", 1.0f), "AuxiliaryTrafficArea");
  EXPECT_EQ(surface_name("TrafficArea", "Road", 1.0f), "Road") << "what is driven on";
  for (const char* kind : {"WallSurface", "RoofSurface", "GroundSurface", "OuterFloorSurface"})
    EXPECT_EQ(surface_name(kind, "BridgePart", 0.0f), "Bridge") << kind << ": no house's";
  EXPECT_EQ(surface_name("Window", "Bridge", 0.0f), "Window");
}

}  // namespace
}  // namespace parvis::scene
