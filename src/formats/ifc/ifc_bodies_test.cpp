// Bodies that IFC++ does not build by itself: indexed curves, swept disks, tapers; and what it loses.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/bounds.h"
#include "base/test_folder.h"
#include "formats/ifc/ifc_curves.h"
#include "formats/ifc/ifc_reader.h"

namespace parvis::scene {
namespace {

/// A building of one object in metres, whose body is #40; `entities` are further lines.
std::string one_object(const std::string& kind, const std::string& entities, const std::string& north = "$") {
  return R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('IFC4'));
ENDSEC;
DATA;
#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);
#2=IFCUNITASSIGNMENT((#1));
#3=IFCCARTESIANPOINT((0.,0.,0.));
#4=IFCAXIS2PLACEMENT3D(#3,$,$);
#5=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#4,)" +
         north + R"();
#6=IFCPROJECT('0000000000000000000001',$,'P',$,$,$,$,(#5),#2);
#7=IFCLOCALPLACEMENT($,#4);
#8=IFCBUILDING('0000000000000000000002',$,'B',$,$,#7,$,$,.ELEMENT.,$,$,$);
#9=IFCRELAGGREGATES('0000000000000000000003',$,$,$,#6,(#8));
#10=IFCDIRECTION((0.,0.,1.));
#20=)" + kind +
         R"(('0000000000000000000004',$,'the one',$,$,#7,#21,$,$);
#21=IFCPRODUCTDEFINITIONSHAPE($,$,(#22));
#22=IFCSHAPEREPRESENTATION(#5,'Body','SweptSolid',(#40));
#23=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000005',$,$,$,(#20),#8);
)" + entities +
         "ENDSEC;\nEND-ISO-10303-21;\n";
}

struct ReadIfc {
  Result<Model> model;
  std::string warnings;
};

ReadIfc read_text(const std::string& text, const std::string& map = {}) {
  const TestFolder folder;
  Errors warnings;
  Result<Model> model = read_ifc(folder.write("one.ifc", text), warnings, nullptr, map);
  EXPECT_TRUE(model) << to_string(model.errors());
  return {std::move(model), to_string(warnings)};
}

/// Volume of closed bodies whose triangles face outward.
double volume_m3(const Model& model) {
  double volume = 0.0;
  for (const Part& part : model.parts)
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) {
        return glm::dvec3(part.mesh.positions[part.mesh.indices[i + k]]);
      };
      volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
    }
  return volume;
}

TEST(IfcCurves, LinesAndArcsBecomePoints) {
  const std::string plain = with_plain_curves(
      "#1=IFCCARTESIANPOINTLIST2D(((0.,0.),(2.,0.),(2.,1.),(0.,1.)));\n/* #2=NOTHING(); */"
      "#7=IFCLABEL('a; b'); #3 = IFCINDEXEDPOLYCURVE(#1,(IFCLINEINDEX((1,2,3,4)),IFCLINEINDEX((4,1))),.F.);");
  EXPECT_NE(plain.find("#3=IFCPOLYLINE((#8,#9,#10,#11,#12));"), std::string::npos) << plain;
  EXPECT_NE(plain.find("#10=IFCCARTESIANPOINT((2.,1.));"), std::string::npos) << plain;
  EXPECT_NE(plain.find("/* #2=NOTHING(); */#7=IFCLABEL('a; b');"), std::string::npos) << plain;
  const std::string arc = with_plain_curves(
      "#1=IFCCARTESIANPOINTLIST3D(((1.,0.,5.),(0.,1.,5.),(-1.,0.,5.)));"
      "#2=IFCINDEXEDPOLYCURVE(#1,(IFCARCINDEX((1,2,3))),$);");
  EXPECT_NE(arc.find("IFCCARTESIANPOINT((0.,1.,5.))"), std::string::npos) << "its middle point is one of it\n"
                                                                          << arc;
  for (const char* damaged :
       {"#2=IFCINDEXEDPOLYCURVE(#1,$,$);",
        "#1=IFCCARTESIANPOINTLIST2D(((0.,0.)));#2=IFCINDEXEDPOLYCURVE(#1,$,$);",
        "#1=IFCCARTESIANPOINTLIST2D(((0.,0.),(1.,1.)));#2=IFCINDEXEDPOLYCURVE(#1,(IFCLINEINDEX((1,7))),$);",
        "#2=IFCINDEXEDPOLYCURVE(", "IFCINDEXEDPOLYCURVE"})
    EXPECT_EQ(with_plain_curves(damaged), damaged);
}

TEST(IfcBodies, OutlinesOfLinesAndArcsHaveTheirVolume) {
  // A D: a half circle of 3 m and its diameter, 2 m high, with a square hole by points alone.
  const ReadIfc d =
      read_text(one_object("IFCSLAB", R"(#30=IFCCARTESIANPOINTLIST2D(((0.,-3.),(3.,0.),(0.,3.)));
#31=IFCINDEXEDPOLYCURVE(#30,(IFCARCINDEX((1,2,3)),IFCLINEINDEX((3,1))),.F.);
#32=IFCCARTESIANPOINTLIST2D(((0.5,-0.5),(1.5,-0.5),(1.5,0.5),(0.5,0.5)));
#33=IFCINDEXEDPOLYCURVE(#32,$,.F.);
#34=IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#31,(#33));
#40=IFCEXTRUDEDAREASOLID(#34,#4,#10,2.);
)"));
  EXPECT_EQ(d.warnings, "");
  const double half_disc_m2 =
      0.5 * 9.0 * 24.0 * std::sin(std::numbers::pi / 24.0);  // of chords of 7.5 degrees
  EXPECT_NEAR(volume_m3(*d.model), 2.0 * (half_disc_m2 - 1.0), 1e-3);
  EXPECT_NEAR(bounds(*d.model).max.x, 3.0f, 1e-4f);
}

TEST(IfcBodies, DisksSweepUprightAndRoundCorners) {
  // A handrail that rises, bends and is short at its end; a tube of 2 cm with a wall of 5 mm.
  const ReadIfc rail = read_text(one_object("IFCRAILING", R"(#30=IFCCARTESIANPOINT((1.,1.,0.));
#31=IFCCARTESIANPOINT((1.,1.,1.));
#32=IFCCARTESIANPOINT((3.,1.,1.));
#33=IFCCARTESIANPOINT((3.,1.,0.8));
#34=IFCPOLYLINE((#30,#31,#32,#33));
#40=IFCSWEPTDISKSOLID(#34,0.02,0.015,$,$);
)"));
  EXPECT_EQ(rail.warnings, "");
  const double ring_m2 = 0.5 * 16.0 * std::sin(std::numbers::pi / 8.0) * (0.02 * 0.02 - 0.015 * 0.015);
  EXPECT_NEAR(volume_m3(*rail.model), 3.2 * ring_m2, 0.01 * 3.2 * ring_m2);
  const Bounds box = bounds(*rail.model);
  EXPECT_NEAR(box.min.z, 0.0f, 1e-4f);
  EXPECT_NEAR(box.max.z, 1.02f, 1e-3f);
  EXPECT_NEAR(box.max.x, 3.02f, 1e-3f);
}

TEST(IfcBodies, TapersEndInTheirOtherProfile) {
  const ReadIfc pier = read_text(one_object("IFCCOLUMN", R"(#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,2.,2.);
#31=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,1.,1.);
#40=IFCEXTRUDEDAREASOLIDTAPERED(#30,#4,#10,3.,#31);
)"));
  EXPECT_EQ(pier.warnings, "");
  EXPECT_NEAR(volume_m3(*pier.model), 3.0 * (4.0 + 2.0 + 1.0) / 3.0, 1e-3) << "a truncated pyramid";
}

TEST(IfcBodies, WhatGivesNoSurfaceIsNamed) {
  const std::string good = R"(#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,2.,2.);
#40=IFCEXTRUDEDAREASOLID(#30,#4,#10,3.);
#50=IFCWALL('0000000000000000000006',$,'the lost one',$,$,#7,#51,$,$);
#51=IFCPRODUCTDEFINITIONSHAPE($,$,(#52));
#52=IFCSHAPEREPRESENTATION(#5,'Body','SweptSolid',(#53));
#53=IFCEXTRUDEDAREASOLID(#54,#4,#10,3.);
#54=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#55);
#55=IFCOFFSETCURVE2D(#56,1.,.F.);
#56=IFCPOLYLINE((#3,#3));
#57=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000007',$,$,$,(#50),#8);
)";
  const ReadIfc house = read_text(one_object("IFCSLAB", good));
  EXPECT_NEAR(volume_m3(*house.model), 12.0, 1e-3);
  EXPECT_NE(house.warnings.find("IfcWall \"the lost one\" (#50)"), std::string::npos) << house.warnings;
}

TEST(IfcBodies, ObjectsAndUnknownEntitiesAreAccountedFor) {
  const TestFolder folder;
  Errors warnings;
  FileAccount account("IFC");
  const std::string text = one_object("IFCSLAB", R"(#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,2.,2.);
#40=IFCEXTRUDEDAREASOLID(#30,#4,#10,3.);
#70=IFCFLYINGCARPET('0000000000000000000008',$,'Aladdin',$,$,#7,$,$,$);
)");
  ASSERT_TRUE(read_ifc(folder.write("one.ifc", text), warnings, nullptr, {}, &account));
  EXPECT_EQ(account.count(Fate::used, "IfcSlab"), 1u) << account.text();
  EXPECT_EQ(account.count(Fate::left_out, "IFCFLYINGCARPET"), 1u) << account.text();
  EXPECT_NE(account.text().find("#70"), std::string::npos) << account.text();
}

TEST(IfcBodies, TrueNorthTurnsWhatNoMapConversionTurns) {
  const std::string body = R"(#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,20.,2.);
#40=IFCEXTRUDEDAREASOLID(#30,#4,#10,3.);
#60=IFCDIRECTION((1.,1.));
)";
  const auto corner_of = [](const Model& model) {
    glm::vec3 farthest(0.0f);
    for (const glm::vec3& point : model.parts.at(0).mesh.positions)
      if (point.x - 0.1f * point.y > farthest.x - 0.1f * farthest.y) farthest = point;
    return farthest;
  };
  const ReadIfc turned = read_text(one_object("IFCSLAB", body, "#60"));
  // North is north-east on the plan: what runs east there runs north-east in the world.
  EXPECT_NEAR(bounds(*turned.model).size().x, (20.0f + 2.0f) * std::sqrt(0.5f), 1e-3f);
  EXPECT_GT(corner_of(*turned.model).y, 5.0f);
  const std::string map = R"(#61=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,$);
#62=IFCMAPCONVERSION(#5,#61,600000.,5600000.,0.,1.,0.,1.);
)";
  const ReadIfc mapped = read_text(one_object("IFCSLAB", body + map, "#60"));
  EXPECT_NEAR(bounds(*mapped.model).size().x, 20.0f, 1e-3f) << "the map says where north is";
  EXPECT_EQ(mapped.model->map, "EPSG:25832");
  EXPECT_NEAR(mapped.model->true_north_deg, -1.09, 0.02) << "1.42 degrees east of the zone's meridian";
  const ReadIfc laid = read_text(one_object("IFCSLAB", body + map, "#60"), "EPSG:25833");
  EXPECT_EQ(laid.model->map, "EPSG:25833");
  EXPECT_NEAR(bounds(*laid.model).size().y, 20.0f * std::sin(glm::radians(4.65f)) + 2.0f, 0.1f)
      << "turned to the other zone's north";
}

}  // namespace
}  // namespace parvis::scene
