// Bodies that IFC++ does not build by itself: indexed curves, swept disks, tapers; and what it loses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

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

/// A file in millimetres.
std::string in_millimetres(std::string text) {
  const std::string metres = "#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);";
  return text.replace(text.find(metres), metres.size(), "#1=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);");
}

TEST(IfcPrimitives, StandAtTheirCornerOrMiddleInTheFilesUnit) {
  constexpr double pi = std::numbers::pi;
  const double polygon = 24.0 * std::sin(pi / 24.0);  // area of 48 corners on a circle of 1
  struct Case {
    const char* entity;
    glm::vec3 low, high;
    double volume, tolerance;
  };
  for (const Case& shape :
       {Case{"IFCBLOCK(#31,4000.,2000.,1000.)", {1, 2, 3}, {5, 4, 4}, 8.0, 1e-4},
        Case{"IFCRECTANGULARPYRAMID(#31,4000.,2000.,3000.)", {1, 2, 3}, {5, 4, 6}, 8.0, 1e-4},
        Case{"IFCRIGHTCIRCULARCYLINDER(#31,3000.,1000.)", {0, 1, 3}, {2, 3, 6}, 3.0 * polygon, 1e-4},
        Case{"IFCRIGHTCIRCULARCONE(#31,3000.,1000.)", {0, 1, 3}, {2, 3, 6}, polygon, 1e-4},
        Case{"IFCSPHERE(#31,1000.)", {0, 1, 2}, {2, 3, 4}, 4.0 / 3.0 * pi, 0.04}}) {
    const std::string placed =
        std::string("#30=IFCCARTESIANPOINT((1000.,2000.,3000.));\n") + "#31=IFCAXIS2PLACEMENT3D(#30,$,$);\n";
    for (const std::string& body : {fmt::format("#40={};\n", shape.entity),
                                    fmt::format("#40=IFCCSGSOLID(#41);\n#41={};\n", shape.entity)}) {
      const ReadIfc read = read_text(in_millimetres(one_object("IFCBUILDINGELEMENTPROXY", placed + body)));
      ASSERT_TRUE(read.model);
      EXPECT_EQ(read.warnings, "") << body;
      const Bounds box = bounds(*read.model);
      EXPECT_LT(glm::distance(box.min, shape.low), 1e-4f)
          << body << box.min.x << " " << box.min.y << " " << box.min.z;
      EXPECT_LT(glm::distance(box.max, shape.high), 1e-4f)
          << body << box.max.x << " " << box.max.y << " " << box.max.z;
      EXPECT_NEAR(volume_m3(*read.model), shape.volume, shape.tolerance) << body;
    }
  }
}

TEST(IfcPrimitives, AreOperandsOfBooleans) {
  // A block of 4 x 2 x 1 m less its corner of 1 m3, and what lies beyond x = 3, whose box is no limit.
  const ReadIfc cut = read_text(one_object("IFCSLAB", R"(#30=IFCBLOCK(#4,4.,2.,1.);
#31=IFCBLOCK(#4,1.,1.,2.);
#32=IFCBOOLEANRESULT(.DIFFERENCE.,#30,#31);
#33=IFCCARTESIANPOINT((3.,0.,0.));
#34=IFCDIRECTION((-1.,0.,0.));
#35=IFCAXIS2PLACEMENT3D(#33,#34,#10);
#36=IFCPLANE(#35);
#37=IFCCARTESIANPOINT((3.,-1.,-1.));
#38=IFCBOUNDINGBOX(#37,9.,9.,9.);
#39=IFCBOXEDHALFSPACE(#36,.T.,#38);
#41=IFCBOOLEANRESULT(.DIFFERENCE.,#32,#39);
#40=IFCCSGSOLID(#41);
)"));
  ASSERT_TRUE(cut.model);
  EXPECT_EQ(cut.warnings, "");
  EXPECT_NEAR(volume_m3(*cut.model), 3.0 * 2.0 - 1.0, 1e-4);
  EXPECT_NEAR(bounds(*cut.model).max.x, 3.0f, 1e-4f);
}

TEST(IfcBodies, ExtrusionsGoAsFarAsTheirDepth) {
  const ReadIfc slanted = read_text(one_object("IFCCOLUMN", R"(#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,1.,1.);
#31=IFCDIRECTION((3.,0.,4.));
#40=IFCEXTRUDEDAREASOLID(#30,#4,#31,5.);
)"));
  EXPECT_NEAR(volume_m3(*slanted.model), 4.0, 1e-4);
  EXPECT_NEAR(bounds(*slanted.model).max.x, 3.5f, 1e-4f);
  EXPECT_NEAR(bounds(*slanted.model).max.z, 4.0f, 1e-4f);
}

TEST(IfcBodies, AnglesWithoutAUnitAreRadiansUnlessTheyExceedAWholeTurn) {
  const auto volume = [](const char* angle) {
    return volume_m3(*read_text(one_object("IFCSLAB", fmt::format(R"(#30=IFCCARTESIANPOINT((2.,0.));
#31=IFCAXIS2PLACEMENT2D(#30,$);
#32=IFCRECTANGLEPROFILEDEF(.AREA.,$,#31,1.,1.);
#33=IFCDIRECTION((0.,1.,0.));
#34=IFCAXIS1PLACEMENT(#3,#33);
#40=IFCREVOLVEDAREASOLID(#32,#4,#34,{});
)",
                                                                  angle)))
                          .model);
  };
  constexpr double whole = 4.0 * std::numbers::pi;  // a ring of 1 m2 at 2 m
  for (const auto& [angle, fraction] : {std::pair{"6.283185307179586", 1.0},
                                        {"4.71238898038469", 0.75},
                                        {"1.5707963267949", 0.25},
                                        {"360.", 1.0},
                                        {"270.", 0.75}})
    EXPECT_NEAR(volume(angle), fraction * whole, 0.01 * whole) << angle;
}

TEST(IfcBodies, ProfilesThatIfcPlusPlusCannotDrawHaveTheirArea) {
  const auto read = [](const std::string& profile) {
    return read_text(one_object("IFCBEAM", profile + "#40=IFCEXTRUDEDAREASOLID(#30,#4,#10,2.);\n"));
  };
  const ReadIfc beam =
      read(R"(#30=IFCASYMMETRICISHAPEPROFILEDEF(.AREA.,$,#31,0.4,0.3,0.01,0.02,$,0.2,0.03,$,$,$,$,$);
#31=IFCAXIS2PLACEMENT2D(#32,$);
#32=IFCCARTESIANPOINT((5.,0.));
)");
  EXPECT_NEAR(volume_m3(*beam.model), 2.0 * (0.4 * 0.02 + 0.2 * 0.03 + 0.25 * 0.01), 1e-6);
  EXPECT_NEAR(bounds(*beam.model).min.x, 4.8f, 1e-4f);
  const ReadIfc angle = read(R"(#31=IFCLSHAPEPROFILEDEF(.AREA.,$,$,2.,1.,.1,$,$,$);
#30=IFCMIRROREDPROFILEDEF(.AREA.,$,#31,*,$);
)");
  EXPECT_NEAR(volume_m3(*angle.model), 2.0 * (2.0 * 0.1 + 0.9 * 0.1), 1e-6);
  int corners_to_the_right = 0;
  for (const Part& part : angle.model->parts)
    for (const glm::vec3& corner : part.mesh.positions)
      corners_to_the_right += corner.x > 0.3f && corner.y > 0.5f;
  EXPECT_GT(corners_to_the_right, 0) << "its long leg stands to the right, unmirrored to the left";
  const std::string path = R"(#31=IFCPOLYLINE((#32,#33,#34{}));
#32=IFCCARTESIANPOINT((0.,0.));
#33=IFCCARTESIANPOINT((4.,0.));
#34=IFCCARTESIANPOINT((4.,3.));
#30=IFCCENTERLINEPROFILEDEF(.AREA.,$,#31,0.2);
)";
  EXPECT_NEAR(volume_m3(*read(fmt::format(fmt::runtime(path), "")).model), 2.0 * 0.2 * (4.0 + 3.0), 1e-4);
  EXPECT_NEAR(volume_m3(*read(fmt::format(fmt::runtime(path), ",#32")).model), 2.0 * 0.2 * (4.0 + 3.0 + 5.0),
              1e-4)
      << "a ring";
}

TEST(IfcBodies, FacesHaveHoles) {
  const ReadIfc frame = read_text(
      one_object("IFCPLATE", R"(#40=IFCPOLYGONALFACESET(#30,.T.,(#31,#32,#33,#34,#35,#36,#37,#38,#39,#41),$);
#30=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(4.,0.,0.),(4.,4.,0.),(0.,4.,0.),(0.,0.,1.),(4.,0.,1.),(4.,4.,1.),(0.,4.,1.),(1.,1.,0.),(3.,1.,0.),(3.,3.,0.),(1.,3.,0.),(1.,1.,1.),(3.,1.,1.),(3.,3.,1.),(1.,3.,1.)));
#31=IFCINDEXEDPOLYGONALFACEWITHVOIDS((4,3,2,1),((9,10,11,12)));
#32=IFCINDEXEDPOLYGONALFACEWITHVOIDS((5,6,7,8),((16,15,14,13)));
#33=IFCINDEXEDPOLYGONALFACE((1,2,6,5));
#34=IFCINDEXEDPOLYGONALFACE((2,3,7,6));
#35=IFCINDEXEDPOLYGONALFACE((3,4,8,7));
#36=IFCINDEXEDPOLYGONALFACE((4,1,5,8));
#37=IFCINDEXEDPOLYGONALFACE((9,13,14,10));
#38=IFCINDEXEDPOLYGONALFACE((10,14,15,11));
#39=IFCINDEXEDPOLYGONALFACE((11,15,16,12));
#41=IFCINDEXEDPOLYGONALFACE((12,16,13,9));
)"));
  ASSERT_TRUE(frame.model);
  EXPECT_NEAR(volume_m3(*frame.model), 12.0, 1e-4);
}

TEST(IfcBodies, FacesOfAdvancedBrepsAreBoundedByEdges) {
  // A cylinder of 1 m and 2 m: two plane faces with a circle each, and one that a seam closes.
  const std::string body = R"(#40=IFCADVANCEDBREP(#60);
#60=IFCCLOSEDSHELL((#61,#62,#63));
#64=IFCCARTESIANPOINT((1.,0.,0.));
#65=IFCCARTESIANPOINT((1.,0.,2.));
#66=IFCVERTEXPOINT(#64);
#67=IFCVERTEXPOINT(#65);
#68=IFCCARTESIANPOINT((0.,0.,2.));
#69=IFCAXIS2PLACEMENT3D(#68,$,$);
#70=IFCCIRCLE(#4,1.);
#71=IFCCIRCLE(#69,1.);
#72=IFCEDGECURVE(#66,#66,#70,.T.);
#73=IFCEDGECURVE(#67,#67,#71,.T.);
#74=IFCVECTOR(#10,2.);
#75=IFCLINE(#64,#74);
#76=IFCEDGECURVE(#66,#67,#75,.T.);
#77=IFCORIENTEDEDGE(*,*,#72,.T.);
#78=IFCORIENTEDEDGE(*,*,#72,.F.);
#79=IFCORIENTEDEDGE(*,*,#73,.T.);
#80=IFCORIENTEDEDGE(*,*,#73,.F.);
#81=IFCORIENTEDEDGE(*,*,#76,.T.);
#82=IFCORIENTEDEDGE(*,*,#76,.F.);
#83=IFCEDGELOOP((#78));
#84=IFCFACEOUTERBOUND(#83,.T.);
#85=IFCPLANE(#4);
#61=IFCADVANCEDFACE((#84),#85,.F.);
#86=IFCEDGELOOP((#79));
#87=IFCFACEOUTERBOUND(#86,.T.);
#88=IFCPLANE(#69);
#62=IFCADVANCEDFACE((#87),#88,.T.);
#89=IFCEDGELOOP((#77,#81,#80,#82));
#90=IFCFACEOUTERBOUND(#89,.T.);
#91=IFCCYLINDRICALSURFACE(#4,1.);
#63=IFCADVANCEDFACE((#90),#91,.T.);
)";
  const ReadIfc whole = read_text(one_object("IFCCOLUMN", body));
  ASSERT_TRUE(whole.model);
  EXPECT_EQ(whole.warnings, "");
  EXPECT_NEAR(volume_m3(*whole.model), 2.0 * 24.0 * std::sin(std::numbers::pi / 24.0), 1e-4);
}

/// Lines of a closed shell #60 whose faces are #100, #110 and so on, each in a surface and with one or two
/// loops of oriented edges.
std::string shell_of(const std::vector<std::string>& faces) {
  std::string numbers, lines;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    numbers += fmt::format("{}#{}", i == 0 ? "" : ",", 100 + 10 * i);
    lines += fmt::format(fmt::runtime(faces[i]), fmt::arg("n", 10 + i));
  }
  return fmt::format("#40=IFCADVANCEDBREP(#60);\n#60=IFCCLOSEDSHELL(({}));\n", numbers) + lines;
}

double volume_of_shell(const std::string& entities, const std::vector<std::string>& faces) {
  const ReadIfc body = read_text(one_object("IFCCOLUMN", shell_of(faces) + entities));
  EXPECT_EQ(body.warnings, "");
  return body.model ? volume_m3(*body.model) : 0.0;
}

constexpr double pi = std::numbers::pi,
                 chords = 0.01;  // by which bodies of chords are smaller than round ones
// A face #N0 with the loop #N3 of edges, "#72 forward" or "#72 back", on the surface #N1.
const std::string one_loop =
    "#{n}0=IFCADVANCEDFACE((#{n}2),#{n}1,.T.);\n#{n}2=IFCFACEOUTERBOUND(#{n}3,.T.);\n";

TEST(IfcBodies, FacesLieOnSpheres) {
  const std::string ball = one_loop + R"(#{n}1=IFCSPHERICALSURFACE(#4,2.);
#{n}3=IFCVERTEXLOOP(#65);
)";
  EXPECT_NEAR(volume_of_shell("#65=IFCVERTEXPOINT(#66);\n#66=IFCCARTESIANPOINT((0.,0.,2.));\n", {ball}),
              4.0 / 3.0 * pi * 8.0, chords * 4.0 / 3.0 * pi * 8.0);
  const std::string edges = R"(#64=IFCCARTESIANPOINT((1.,0.,0.));
#65=IFCVERTEXPOINT(#64);
#66=IFCCARTESIANPOINT((0.,0.,1.));
#67=IFCVERTEXPOINT(#66);
#68=IFCDIRECTION((0.,-1.,0.));
#69=IFCDIRECTION((1.,0.,0.));
#70=IFCAXIS2PLACEMENT3D(#3,#68,#69);
#71=IFCCIRCLE(#4,1.);
#72=IFCEDGECURVE(#65,#65,#71,.T.);
#73=IFCCIRCLE(#70,1.);
#74=IFCEDGECURVE(#65,#67,#73,.T.);
#75=IFCORIENTEDEDGE(*,*,#72,.T.);
#76=IFCORIENTEDEDGE(*,*,#72,.F.);
#77=IFCORIENTEDEDGE(*,*,#74,.T.);
#78=IFCORIENTEDEDGE(*,*,#74,.F.);
)";
  const std::string floor = one_loop + "#{n}1=IFCPLANE(#4);\n#{n}3=IFCEDGELOOP((#76));\n";
  for (const char* loop : {"#75,#77,#78", "#75"})  // with a seam and without
    EXPECT_NEAR(volume_of_shell(edges, {one_loop + "#{n}1=IFCSPHERICALSURFACE(#4,1.);\n#{n}3=IFCEDGELOOP((" +
                                            loop + "));\n",
                                        floor}),
                2.0 / 3.0 * pi, chords * 2.0 / 3.0 * pi)
        << loop;
  std::string shell = shell_of({one_loop + "#{n}1=IFCSPHERICALSURFACE(#4,1.);\n#{n}3=IFCEDGELOOP((#75));\n"});
  shell.replace(shell.find("#40=IFCADVANCEDBREP(#60)"), 24, "#40=IFCSHELLBASEDSURFACEMODEL((#60))");
  const ReadIfc cupola = read_text(one_object("IFCROOF", shell + edges));
  EXPECT_EQ(cupola.warnings, "");
  EXPECT_NEAR(volume_m3(*cupola.model), 2.0 / 3.0 * pi, chords * 2.0 / 3.0 * pi) << "of a surface model";
  // An eighth, whose axis is turned by less than a millionth: its corner is the pole for all that.
  const std::string eighth = R"(#41=IFCCARTESIANPOINT((0.,1.,0.));
#42=IFCVERTEXPOINT(#41);
#43=IFCDIRECTION((0.,1.,0.));
#44=IFCAXIS2PLACEMENT3D(#3,#69,#43);
#45=IFCCIRCLE(#44,1.);
#46=IFCEDGECURVE(#65,#42,#71,.T.);
#47=IFCEDGECURVE(#42,#67,#45,.T.);
#48=IFCORIENTEDEDGE(*,*,#46,.T.);
#49=IFCORIENTEDEDGE(*,*,#47,.T.);
#50=IFCDIRECTION((4.E-7,4.E-7,1.));
#51=IFCAXIS2PLACEMENT3D(#3,#50,#69);
)";
  shell = shell_of({one_loop + "#{n}1=IFCSPHERICALSURFACE(#51,1.);\n#{n}3=IFCEDGELOOP((#48,#49,#78));\n"});
  shell.replace(shell.find("#40=IFCADVANCEDBREP(#60)"), 24, "#40=IFCSHELLBASEDSURFACEMODEL((#60))");
  const ReadIfc corner = read_text(one_object("IFCROOF", shell + edges + eighth));
  EXPECT_EQ(corner.warnings, "");
  EXPECT_NEAR(volume_m3(*corner.model), pi / 6.0, chords * pi / 6.0) << "a corner on the pole";
  const std::string cone = one_loop + R"(#{n}1=IFCSURFACEOFREVOLUTION(#80,#70,#81);
#{n}3=IFCEDGELOOP((#75));
#80=IFCARBITRARYOPENPROFILEDEF(.CURVE.,$,#82);
#81=IFCAXIS1PLACEMENT(#83,#84);
#82=IFCPOLYLINE((#85,#86));
#83=IFCCARTESIANPOINT((0.,0.));
#84=IFCDIRECTION((0.,1.,0.));
#85=IFCCARTESIANPOINT((1.,0.));
#86=IFCCARTESIANPOINT((0.,2.));
)";
  EXPECT_NEAR(volume_of_shell(edges, {cone, floor}), 2.0 / 3.0 * pi, chords * 2.0 / 3.0 * pi);
}

TEST(IfcBodies, FacesLieOnTori) {
  // A quarter of a ring: two plane faces, and one between two circles that no seam joins.
  const std::string pipe = R"(#{n}0=IFCADVANCEDFACE((#{n}2,#{n}3),#{n}1,.T.);
#{n}1=IFCTOROIDALSURFACE(#4,2.,0.5);
#{n}2=IFCFACEOUTERBOUND(#{n}4,.T.);
#{n}3=IFCFACEBOUND(#{n}5,.T.);
#{n}4=IFCEDGELOOP((#81));
#{n}5=IFCEDGELOOP((#82));
)";
  const std::string edges = R"(#61=IFCDIRECTION((0.,-1.,0.));
#62=IFCDIRECTION((1.,0.,0.));
#63=IFCDIRECTION((0.,1.,0.));
#64=IFCCARTESIANPOINT((2.,0.,0.));
#65=IFCCARTESIANPOINT((0.,2.,0.));
#66=IFCAXIS2PLACEMENT3D(#64,#61,#62);
#67=IFCAXIS2PLACEMENT3D(#65,#62,#63);
#68=IFCCIRCLE(#66,0.5);
#69=IFCCIRCLE(#67,0.5);
#70=IFCCARTESIANPOINT((2.5,0.,0.));
#71=IFCCARTESIANPOINT((0.,2.5,0.));
#72=IFCVERTEXPOINT(#70);
#73=IFCVERTEXPOINT(#71);
#74=IFCEDGECURVE(#72,#72,#68,.T.);
#75=IFCEDGECURVE(#73,#73,#69,.T.);
#80=IFCORIENTEDEDGE(*,*,#74,.T.);
#81=IFCORIENTEDEDGE(*,*,#74,.F.);
#82=IFCORIENTEDEDGE(*,*,#75,.T.);
#83=IFCORIENTEDEDGE(*,*,#75,.F.);
)";
  const std::vector<std::string> ends = {one_loop + "#{n}1=IFCPLANE(#66);\n#{n}3=IFCEDGELOOP((#80));\n",
                                         one_loop + "#{n}1=IFCPLANE(#67);\n#{n}3=IFCEDGELOOP((#83));\n"};
  EXPECT_NEAR(volume_of_shell(edges, {pipe, ends[0], ends[1]}), 0.25 * pi * pi, chords * 0.25 * pi * pi);
  // The same by a circle that turns, within one loop, which runs along the seam and back below it.
  const std::string turned = one_loop + R"(#{n}1=IFCSURFACEOFREVOLUTION(#41,#66,#42);
#{n}3=IFCEDGELOOP((#81,#50,#82,#51));
#41=IFCARBITRARYCLOSEDPROFILEDEF(.CURVE.,$,#43);
#42=IFCAXIS1PLACEMENT(#44,#63);
#43=IFCCIRCLE(#45,0.5);
#44=IFCCARTESIANPOINT((-2.,0.,0.));
#45=IFCAXIS2PLACEMENT2D(#46,$);
#46=IFCCARTESIANPOINT((0.,0.));
)";
  std::string seam = R"(#47=IFCCIRCLE(#4,2.5);
#48=IFCEDGECURVE(#72,#73,#47,.T.);
#50=IFCORIENTEDEDGE(*,*,#48,.T.);
#51=IFCORIENTEDEDGE(*,*,#48,.F.);
)";
  EXPECT_NEAR(volume_of_shell(edges + seam, {turned, ends[0], ends[1]}), 0.25 * pi * pi,
              4.0 * chords * 0.25 * pi * pi);
  // A hole above the seam in the ring that runs below it, and the face that fills the hole.
  auto corner = [&, number = 52](double u, double v) mutable {
    const double radius = 2.0 + 0.5 * std::cos(v);
    seam += fmt::format("#{}=IFCCARTESIANPOINT(({},{},{}));\n", number++, radius * std::cos(u),
                        radius * std::sin(u), 0.5 * std::sin(v));
  };
  corner(0.5, 0.5), corner(1.0, 0.5), corner(1.0, 1.0), corner(0.5, 1.0);
  const std::string torus = one_loop + "#{n}1=IFCTOROIDALSURFACE(#4,2.,0.5);\n#{n}3=";
  std::string holed = torus + "IFCEDGELOOP((#81,#50,#82,#51));\n#{n}4=IFCFACEBOUND(#{n}5,.T.);\n" +
                      "#{n}5=IFCPOLYLOOP((#52,#55,#54,#53));\n";
  holed.replace(holed.find("((#{n}2)"), 8, "((#{n}2,#{n}4)");
  const std::string filling = torus + "IFCPOLYLOOP((#52,#53,#54,#55));\n";
  EXPECT_NEAR(volume_of_shell(edges + seam, {holed, filling, ends[0], ends[1]}), 0.25 * pi * pi,
              chords * 0.25 * pi * pi);
}

TEST(IfcBodies, EdgesAreAnyPieceOfAClosedCurve) {
  // A pyramid of 1 m: two edges bound its floor, the shorter one within a side of the square that they lie
  // on.
  const std::string edges = R"(#61=IFCCARTESIANPOINT((1.,0.,0.));
#62=IFCCARTESIANPOINT((1.,1.,0.));
#63=IFCCARTESIANPOINT((0.,1.,0.));
#64=IFCCARTESIANPOINT((0.5,0.5,1.));
#65=IFCCARTESIANPOINT((0.1,0.,0.));
#66=IFCCARTESIANPOINT((0.3,0.,0.));
#67=IFCVERTEXPOINT(#65);
#68=IFCVERTEXPOINT(#66);
#69=IFCPOLYLINE((#3,#61,#62,#63,#3));
#70=IFCEDGECURVE(#67,#68,#69,.T.);
#71=IFCEDGECURVE(#68,#67,#69,.T.);
#72=IFCORIENTEDEDGE(*,*,#70,.F.);
#73=IFCORIENTEDEDGE(*,*,#71,.F.);
)";
  std::vector<std::string> faces = {one_loop + "#{n}1=IFCPLANE(#4);\n#{n}3=IFCEDGELOOP((#72,#73));\n"};
  for (const char* side : {"#3,#61", "#61,#62", "#62,#63", "#63,#3"})
    faces.push_back(std::string("#{n}0=IFCFACE((#{n}2));\n#{n}2=IFCFACEOUTERBOUND(#{n}3,.T.);\n") +
                    "#{n}3=IFCPOLYLOOP((" + side + ",#64));\n");
  EXPECT_NEAR(volume_of_shell(edges, faces), 1.0 / 3.0, 1e-5);
}

TEST(IfcBodies, FacesLieOnSplines) {
  // A vault 2 m wide and 3 m long whose height is 1 - x^2.
  const std::string edges = R"(#41=IFCCARTESIANPOINT((-1.,0.,0.));
#42=IFCCARTESIANPOINT((1.,0.,0.));
#43=IFCCARTESIANPOINT((1.,3.,0.));
#44=IFCCARTESIANPOINT((-1.,3.,0.));
#45=IFCCARTESIANPOINT((0.,0.,2.));
#46=IFCCARTESIANPOINT((0.,3.,2.));
#51=IFCVERTEXPOINT(#41);
#52=IFCVERTEXPOINT(#42);
#53=IFCVERTEXPOINT(#43);
#54=IFCVERTEXPOINT(#44);
#55=IFCBSPLINECURVEWITHKNOTS(2,(#41,#45,#42),.UNSPECIFIED.,.F.,.F.,(3,3),(0.,1.),.UNSPECIFIED.);
#56=IFCBSPLINECURVEWITHKNOTS(2,(#44,#46,#43),.UNSPECIFIED.,.F.,.F.,(3,3),(5.,7.),.UNSPECIFIED.);
#57=IFCEDGECURVE(#51,#52,#55,.T.);
#58=IFCEDGECURVE(#54,#53,#56,.T.);
#59=IFCEDGE(#51,#52);
#61=IFCEDGE(#54,#53);
#62=IFCEDGE(#51,#54);
#63=IFCEDGE(#52,#53);
)" + [] {
    std::string oriented;
    const std::array<int, 6> edge = {57, 58, 59, 61, 62, 63};
    for (std::size_t i = 0; i < edge.size(); ++i)
      oriented += fmt::format("#{}=IFCORIENTEDEDGE(*,*,#{},.T.);\n#{}=IFCORIENTEDEDGE(*,*,#{},.F.);\n",
                              70 + 2 * i, edge[i], 71 + 2 * i, edge[i]);
    return oriented;
  }();
  const std::string plane = one_loop + "#{n}1=IFCPLANE(#4);\n#{n}3=IFCEDGELOOP((";
  const std::string vault = one_loop + "#{n}3=IFCEDGELOOP((#70,#80,#73,#79));\n#{n}1=";
  const std::vector<std::string> rest = {plane + "#78,#76,#81,#75));\n", plane + "#74,#71));\n",
                                         plane + "#77,#72));\n"};
  const std::string spline =
      "IFCBSPLINESURFACEWITHKNOTS(2,1,((#41,#44),(#45,#46),(#42,#43)),.UNSPECIFIED.,.F.,.F.,.F.,(3,3),(2,2),"
      "(0.,4.),(1.,2.),.UNSPECIFIED.);\n";
  const std::string extruded = R"(IFCSURFACEOFLINEAREXTRUSION(#90,$,#91,3.);
#90=IFCARBITRARYOPENPROFILEDEF(.CURVE.,$,#55);
#91=IFCDIRECTION((0.,1.,0.));
)";
  for (const std::string& surface : {spline, extruded})
    EXPECT_NEAR(volume_of_shell(edges, {vault + surface, rest[0], rest[1], rest[2]}), 4.0, 0.04) << surface;
  std::string lost = spline;
  lost.replace(lost.find("(3,3)"), 5, "(3,2)");
  EXPECT_NE(read_text(one_object("IFCCOLUMN", shell_of({vault + lost, rest[0], rest[1], rest[2]}) + edges))
                .warnings.find("IfcBSplineSurfaceWithKnots"),
            std::string::npos)
      << "knots that are none";
}

TEST(IfcBodies, CurvesOfProfilesRunWhereTheirFileSays) {
  // A circle as the rational B-spline that CAD programs write, its upper half, and lines trimmed by
  // parameters.
  const std::string circle = R"(#30=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,{});
#40=IFCEXTRUDEDAREASOLID(#30,#4,#10,2.);
#31=IFCCARTESIANPOINT((1.,0.));
#32=IFCCARTESIANPOINT((1.,1.));
#33=IFCCARTESIANPOINT((0.,1.));
#34=IFCCARTESIANPOINT((-1.,1.));
#35=IFCCARTESIANPOINT((-1.,0.));
#36=IFCCARTESIANPOINT((-1.,-1.));
#37=IFCCARTESIANPOINT((0.,-1.));
#38=IFCCARTESIANPOINT((1.,-1.));
#39=IFCRATIONALBSPLINECURVEWITHKNOTS(2,(#31,#32,#33,#34,#35,#36,#37,#38,#31),.CIRCULAR_ARC.,.T.,.F.,(3,2,2,2,3),(1.,2.,3.,4.,5.),.UNSPECIFIED.,(1.,0.7071067811865476,1.,0.7071067811865476,1.,0.7071067811865476,1.,0.7071067811865476,1.));
#41=IFCTRIMMEDCURVE(#39,(IFCPARAMETERVALUE(1.)),(IFCPARAMETERVALUE(3.)),.T.,.PARAMETER.);
#42=IFCLINE(#43,#44);
#43=IFCCARTESIANPOINT((-3.,0.));
#44=IFCVECTOR(#45,2.);
#45=IFCDIRECTION((1.,0.));
#46=IFCTRIMMEDCURVE(#42,(IFCPARAMETERVALUE(1.)),(IFCPARAMETERVALUE(2.)),.T.,.PARAMETER.);
#47=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#41);
#48=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#46);
#49=IFCCOMPOSITECURVE((#47,#48),.F.);
#50=IFCTRIMMEDCURVE(#39,(#33),(#37),.T.,.CARTESIAN.);
#51=IFCPOLYLINE((#37,#33));
#52=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#50);
#53=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#51);
#54=IFCCOMPOSITECURVE((#52,#53),.F.);
)";
  const auto read = [&](const char* curve) {
    return read_text(one_object("IFCCOLUMN", fmt::format(fmt::runtime(circle), curve)));
  };
  EXPECT_NEAR(volume_m3(*read("#39").model), 2.0 * pi, chords * 2.0 * pi);
  const ReadIfc upper = read("#49"), left = read("#54");
  EXPECT_NEAR(volume_m3(*upper.model), pi, chords * pi);
  EXPECT_NEAR(bounds(*upper.model).min.y, 0.0, 1e-6);
  EXPECT_NEAR(volume_m3(*left.model), pi, chords * pi);
  EXPECT_NEAR(bounds(*left.model).max.x, 0.0, 1e-6);
}

TEST(IfcBodies, BrepsHaveTheirVoids) {
  std::string box;
  for (const auto& [first, low, high] : {std::tuple{200, 0, 3}, std::tuple{300, 1, 2}}) {
    for (int i = 0; i < 8; ++i)
      box += fmt::format("#{}=IFCCARTESIANPOINT(({}.,{}.,{}.));\n", first + i, (i & 1) != 0 ? high : low,
                         (i & 2) != 0 ? high : low, (i & 4) != 0 ? high : low);
    const std::array<std::array<int, 4>, 6> sides = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    std::string list;
    for (int k = 0; k < 6; ++k) {
      const auto& side = sides[std::size_t(k)];
      box += fmt::format(
          "#{0}=IFCPOLYLOOP((#{3},#{4},#{5},#{6}));\n#{1}=IFCFACEOUTERBOUND(#{0},.T.);\n#{2}=IFCFACE((#{1}));"
          "\n",
          first + 10 + k, first + 20 + k, first + 30 + k, first + side[0], first + side[1], first + side[2],
          first + side[3]);
      list += fmt::format("{}#{}", k == 0 ? "" : ",", first + 30 + k);
    }
    box += fmt::format("#{}=IFCCLOSEDSHELL(({}));\n", first + 40, list);
  }
  const ReadIfc tank = read_text(one_object("IFCTANK", box + "#40=IFCFACETEDBREPWITHVOIDS(#240,(#340));\n"));
  EXPECT_NEAR(volume_m3(*tank.model), 26.0, 1e-4);
}

TEST(IfcBodies, SpinesRunThroughTheirSectionsAndPipesRoundTheirCorners) {
  const ReadIfc mast = read_text(one_object("IFCCOLUMN", R"(#30=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,2.,2.);
#31=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,1.,1.);
#32=IFCCARTESIANPOINT((0.,0.,3.));
#33=IFCAXIS2PLACEMENT3D(#32,$,$);
#34=IFCPOLYLINE((#3,#32));
#35=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#34);
#36=IFCCOMPOSITECURVE((#35),.F.);
#40=IFCSECTIONEDSPINE(#36,(#30,#31),(#4,#33));
)"));
  ASSERT_TRUE(mast.model);
  EXPECT_NEAR(volume_m3(*mast.model), 7.0, 1e-4) << "a truncated pyramid";
  const ReadIfc pipe = read_text(one_object("IFCPIPESEGMENT", R"(#30=IFCCARTESIANPOINT((2.,0.,0.));
#31=IFCCARTESIANPOINT((2.,2.,0.));
#32=IFCPOLYLINE((#3,#30,#31));
#40=IFCSWEPTDISKSOLIDPOLYGONAL(#32,0.05,$,$,$,1.);
)"));
  ASSERT_TRUE(pipe.model);
  const double disk_m2 = 0.5 * 16.0 * std::sin(std::numbers::pi / 8.0) * 0.05 * 0.05;
  EXPECT_NEAR(volume_m3(*pipe.model), disk_m2 * (2.0 + 0.5 * std::numbers::pi), 0.01 * disk_m2 * 3.57);
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

TEST(IfcBodies, AFileWithoutAnySurfaceSaysOfWhatThereIsNone) {
  const TestFolder folder;
  Errors warnings;
  const Result<Model> lost =
      read_ifc(folder.write("one.ifc", one_object("IFCWALL",
                                                  "#40=IFCSURFACEOFLINEAREXTRUSION(#41,#4,#10,2.);\n"
                                                  "#41=IFCARBITRARYOPENPROFILEDEF(.CURVE.,$,#42);\n"
                                                  "#42=IFCPOLYLINE((#3,#43));\n"
                                                  "#43=IFCCARTESIANPOINT((2.,0.,0.));\n")),
               warnings);
  ASSERT_FALSE(lost);
  const std::string said = to_string(lost.errors());
  EXPECT_NE(said.find("IfcWall \"the one\" (#20)"), std::string::npos) << said;
  EXPECT_NE(said.find("IfcSurfaceOfLinearExtrusion #40"), std::string::npos) << said;
  EXPECT_NE(said.find("no object has a body that can be shown"), std::string::npos) << said;
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
