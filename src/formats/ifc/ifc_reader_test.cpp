#include "formats/ifc/ifc_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "base/files.h"
#include "base/image_io.h"
#include "base/test_data.h"
#include "base/test_folder.h"

namespace parvis::scene {
namespace {

const std::filesystem::path pavilion_file = source_folder() / "scenes/pavilion.ifc";

class IfcTest : public testing::Test {
 protected:
  Model pavilion() { return read(pavilion_file); }
  Model read(const std::filesystem::path& file) {
    Result<Model> model = read_ifc(file, warnings_);
    EXPECT_TRUE(model) << to_string(model.errors());
    return model ? *std::move(model) : Model();
  }
  /// The pavilion with one text for another, as a file.
  std::filesystem::path changed(const std::string& from, const std::string& to) {
    std::string text = *read_file(pavilion_file);
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
    EXPECT_TRUE(write_file(folder_.path() / "changed.ifc", text));
    return folder_.path() / "changed.ifc";
  }
  static const Part* part(const Model& model, const std::string& object) {
    const auto found = std::ranges::find(model.parts, object, &Part::object);
    return found == model.parts.end() ? nullptr : &*found;
  }
  static const Material& material(const Model& model, const Part& part) {
    return model.materials[std::size_t(part.material)];
  }

  TestFolder folder_;
  Errors warnings_;
};

/// Area of the triangles that face `normal`, square metres.
float area_facing(const Mesh& mesh, glm::vec3 normal) {
  float area = 0.0f;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.positions[mesh.indices[i]];
    const glm::vec3 sides =
        glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
    if (glm::dot(glm::normalize(sides), normal) > 0.999f) area += 0.5f * glm::length(sides);
  }
  return area;
}

TEST_F(IfcTest, ABuildingIsReadInMetresWithStoreysAndNames) {
  const Model model = pavilion();
  EXPECT_TRUE(warnings_.empty()) << to_string(warnings_);
  const Bounds all = bounds(model);
  EXPECT_NEAR(all.size().x, 13.8f, 1e-3f);
  EXPECT_NEAR(all.max.z, 3.68f, 1e-3f);
  ASSERT_EQ(model.nodes.size(), 3u);
  EXPECT_EQ(model.nodes[1].name, "Ground floor");
  EXPECT_EQ(model.nodes[2].name, "Roof");
  const Part* column = part(model, "IfcColumn Column \xc3\xb8 240");
  ASSERT_TRUE(column) << "a letter beyond ASCII, without Revit's number";
  EXPECT_EQ(model.nodes[std::size_t(column->node)].name, "Ground floor");
  const Part* roof = part(model, "IfcSlab Roof:Zinc");
  ASSERT_TRUE(roof);
  EXPECT_EQ(model.nodes[std::size_t(roof->node)].name, "Roof");
}

TEST_F(IfcTest, CellarsAndFoundationsAreNamedAsWhatLiesBelowTheGround) {
  const std::string ground_floor = ".ELEMENT.,0.);", column = "IfcColumn Column \xc3\xb8 240";
  const Model with_cellar = read(changed(ground_floor, ".ELEMENT.,-3000.);"));
  EXPECT_TRUE(part(with_cellar, column + " below ground")) << "millimetres, below the storey \"Roof\"";
  EXPECT_FALSE(part(with_cellar, column));
  EXPECT_TRUE(part(with_cellar, "IfcSlab Roof:Zinc"));
  const Model sunken = read(changed(ground_floor, ".ELEMENT.,-300.);"));
  EXPECT_TRUE(part(sunken, column)) << "a step down";
  const Model founded = read(changed(
      "#73=IFCSLAB('000000000000000000000A',#5,'Step:Stone:184701',$,$,#72,#69,$,.FLOOR.);",
      "#73=IFCFOOTING('000000000000000000000A',#5,'Step:Stone:184701',$,$,#72,#69,$,.STRIP_FOOTING.);"));
  EXPECT_TRUE(part(founded, "IfcFooting Step:Stone below ground"));
  EXPECT_TRUE(part(founded, column));
}

TEST_F(IfcTest, OpeningsAreCutOutOfWalls) {
  const Part* wall = nullptr;
  const Model model = pavilion();
  wall = part(model, "IfcWallStandardCase Wall:Render 300");
  ASSERT_TRUE(wall);
  const float front = 12.0f * 3.2f - 4.0f * 1.4f * 1.6f - 2.0f * 1.0f * 2.3f;
  const float back = 12.0f * 3.2f - 4.0f * 1.4f * 1.6f;
  float reveals = 0.0f;  // jambs have the depth of the wall
  for (const glm::vec3 side : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0)})
    reveals += area_facing(wall->mesh, side);
  // Each wall has two large faces; the short walls close the gaps between the long ones.
  const float south = area_facing(wall->mesh, {0, -1, 0});
  const float jambs_of_short_walls = 2.0f * 1.6f * 0.3f, ends_of_short_walls = 2.0f * 3.2f * 0.3f;
  EXPECT_NEAR(south, front + back + jambs_of_short_walls + ends_of_short_walls, 0.01f);
  EXPECT_GT(reveals, 0.3f * (10.0f * 1.6f + 4.0f * 2.3f));
}

TEST_F(IfcTest, StylesGiveColoursAndGlass) {
  const Model model = pavilion();
  std::size_t panes = 0;
  for (const Part& part : model.parts)
    if (material(model, part).alpha_mode == Alpha::blend) {
      ++panes;
      EXPECT_EQ(part.object, "IfcWindow Casement:1400x1600");
      EXPECT_NEAR(material(model, part).alpha, 0.35f, 1e-3f);
      EXPECT_FALSE(part.casts_shadow);
    }
  EXPECT_EQ(panes, 1u);
  const Part* wall = part(model, "IfcWallStandardCase Wall:Render 300");
  ASSERT_TRUE(wall);
  EXPECT_NEAR(material(model, *wall).base_colour.x, 0.75f, 0.02f) << "sRGB 0.88";
}

TEST_F(IfcTest, MaterialsGiveColoursToWhatHasNoStyle) {
  const auto has_red_wall = [&](const std::string& given) {
    const Model model = read(changed("#78=IFCSTYLEDITEM(#77,(#33),$);", given));
    return std::ranges::any_of(model.parts, [&](const Part& part) {
      return part.object == "IfcWallStandardCase Wall:Render 300" &&
             material(model, part).base_colour == glm::vec3(1.0f, 0.0f, 0.0f);
    });
  };
  const std::string paint =  // red, of the wall #84 or of its type
      "#90001=IFCCOLOURRGB($,1.0,0.,0.);\n#90002=IFCSURFACESTYLESHADING(#90001,$);\n"
      "#90003=IFCSURFACESTYLE('Red',.BOTH.,(#90002));\n#90004=IFCSTYLEDITEM($,(#90003),$);\n"
      "#90005=IFCSTYLEDREPRESENTATION(#13,$,$,(#90004));\n#90006=IFCMATERIAL('Paint',$,$);\n"
      "#90007=IFCMATERIALDEFINITIONREPRESENTATION($,$,(#90005),#90006);\n";
  const std::string layers =
      "#90008=IFCMATERIAL('Air',$,$);\n#90009=IFCMATERIALLAYER(#90008,10.,$,$,$,$,$);\n"
      "#90010=IFCMATERIALLAYER(#90006,20.,$,$,$,$,$);\n#90011=IFCMATERIALLAYERSET((#90009,#90010),$,$);\n"
      "#90012=IFCMATERIALLAYERSETUSAGE(#90011,.AXIS2.,.POSITIVE.,0.,$);\n";
  const std::string type =
      "#90020=IFCWALLTYPE('00000000000000000000zz',#5,'W',$,$,$,$,$,$,.STANDARD.);\n"
      "#90021=IFCRELDEFINESBYTYPE('00000000000000000000zy',#5,$,$,(#84),#90020);\n";
  const auto associated = [](const char* object, const char* with) {
    return std::string("#90030=IFCRELASSOCIATESMATERIAL('00000000000000000000zx',#5,$,$,(") + object + ")," +
           with + ");\n";
  };
  EXPECT_FALSE(has_red_wall(""));
  EXPECT_TRUE(has_red_wall(paint + associated("#84", "#90006")));
  EXPECT_TRUE(has_red_wall(paint + layers + associated("#84", "#90012")));
  EXPECT_TRUE(has_red_wall(paint + type + associated("#90020", "#90006")));
  EXPECT_FALSE(has_red_wall("#78=IFCSTYLEDITEM(#77,(#33),$);\n" + paint + associated("#84", "#90006")))
      << "what a body itself is styled as goes first";
}

/// The pavilion with some more entities, and with one text for another.
class TexturedIfcTest : public IfcTest {
 protected:
  std::filesystem::path textured(std::string entities, const std::string& from, const std::string& to) {
    const std::filesystem::path file = changed(from, to);
    std::string text = *read_file(file);
    text.insert(text.rfind("ENDSEC;"), entities);
    EXPECT_TRUE(write_file(file, text));
    return file;
  }
  /// The picture of the part's material; empty where it has none.
  static Image8 picture(const Model& model, const Part& part) {
    const int texture = material(model, part).base_colour_texture;
    return texture == no_index ? Image8() : model.textures[std::size_t(texture)].image;
  }
  /// 2 by 2 texels: red in the upper left, else white.
  static Image8 marked() {
    Image8 image(2, 2, 4, 255);
    image.at(0, 0)[1] = image.at(0, 0)[2] = 0;
    return image;
  }
};

const std::string plaster = "#33=IFCSURFACESTYLE('Plaster',.BOTH.,(#32));",
                  pictured = "#33=IFCSURFACESTYLE('Plaster',.BOTH.,(#32,#9001));",
                  with_texture = "#9001=IFCSURFACESTYLEWITHTEXTURES((#9002));\n";

TEST_F(TexturedIfcTest, PicturesLieBesideTheFileAndRepeatAsTheirTransformSays) {
  ASSERT_TRUE(write_image(folder_.path() / "plaster.png", marked()));
  const Model model =
      read(textured(with_texture + "#9002=IFCIMAGETEXTURE(.T.,.T.,$,#9003,$,'plaster.png');\n"
                                   "#9003=IFCCARTESIANTRANSFORMATIONOPERATOR2D($,$,#9004,0.5);\n"
                                   "#9004=IFCCARTESIANPOINT((0.,0.));\n",
                    plaster, pictured));
  EXPECT_TRUE(warnings_.empty()) << to_string(warnings_);
  const Part* wall = part(model, "IfcWallStandardCase Wall:Render 300");
  ASSERT_TRUE(wall);
  EXPECT_EQ(picture(model, *wall).pixels, marked().pixels);
  EXPECT_NEAR(material(model, *wall).base_colour.x, 0.75f, 0.02f) << "its colour multiplies it";
  for (std::size_t i = 0; i + 2 < wall->mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return std::size_t(wall->mesh.indices[i + k]); };
    const glm::vec3 side = wall->mesh.positions[corner(1)] - wall->mesh.positions[corner(0)];
    const glm::vec2 in_picture = wall->mesh.uvs[corner(1)] - wall->mesh.uvs[corner(0)];
    EXPECT_NEAR(glm::length(in_picture), 0.5f * glm::length(side), 1e-3f);
    if (std::abs(wall->mesh.normals[corner(0)].z) < 0.1f) {
      EXPECT_NEAR(in_picture.y, -0.5f * side.z, 1e-3f) << "upright";
    }
  }
}

TEST_F(TexturedIfcTest, PicturesOfTheFileItselfLieAsItsCoordinatesSay) {
  const std::string bytes = *encode_image(marked(), "blob.png");
  std::string digits;
  for (const char byte : bytes) digits += fmt::format("{:02X}", unsigned(std::uint8_t(byte)));
  const Model model = read(
      textured("#9010=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(4000.,0.,0.),(4000.,0.,2000.),(0.,0.,2000.)));\n"
               "#9011=IFCSURFACESTYLEWITHTEXTURES((#9012));\n"
               "#9012=IFCBLOBTEXTURE(.F.,.F.,$,$,$,'PNG',\"0" +
                   digits +
                   "\");\n#9013=IFCTEXTUREVERTEXLIST(((0.,0.),(1.,0.),(1.,1.),(0.,1.)));\n"
                   "#9014=IFCINDEXEDTRIANGLETEXTUREMAP((#9012),#55,#9013,((1,2,3),(1,3,4)));\n"
                   "#9015=IFCSURFACESTYLE('Panel',.BOTH.,(#9011));\n#9016=IFCSTYLEDITEM(#55,(#9015),$);\n",
               "#55=IFCEXTRUDEDAREASOLID(#54,#12,#9,200.0);\n#56=IFCSTYLEDITEM(#55,(#45),$);",
               "#55=IFCTRIANGULATEDFACESET(#9010,$,.F.,((1,2,3),(1,3,4)),$);"));
  EXPECT_TRUE(warnings_.empty()) << to_string(warnings_);
  const auto panel = std::ranges::find_if(
      model.parts, [&](const Part& each) { return !picture(model, each).pixels.empty(); });
  ASSERT_NE(panel, model.parts.end());
  EXPECT_EQ(picture(model, *panel).pixels, marked().pixels);
  EXPECT_EQ(model.textures[std::size_t(material(model, *panel).base_colour_texture)].wrap_u,
            scene::Wrap::clamp);
  EXPECT_EQ(material(model, *panel).base_colour, glm::vec3(1.0f)) << "the picture alone";
  const Bounds box = panel->mesh.bounds();
  ASSERT_EQ(panel->mesh.indices.size(), 6u);
  for (std::size_t i = 0; i < panel->mesh.positions.size(); ++i) {
    const glm::vec3 share = (panel->mesh.positions[i] - box.min) / glm::max(box.size(), glm::vec3(1e-3f));
    EXPECT_NEAR(panel->mesh.uvs[i].x, share.x, 1e-4f);
    EXPECT_NEAR(panel->mesh.uvs[i].y, 1.0f - share.z, 1e-4f);
  }
}

/// A face of 30 corners, which IFC++ cuts into triangles as it likes.
TEST_F(TexturedIfcTest, PicturesLieOnFacesOfManyCorners) {
  constexpr int corners = 30;
  ASSERT_TRUE(write_image(folder_.path() / "disc.png", marked()));
  std::string entities, points, vertices;
  for (int i = 0; i < corners; ++i) {
    const double turn = 6.283185307 * i / corners, x = 0.5 + 0.5 * std::cos(turn),
                 z = 0.5 + 0.5 * std::sin(turn);
    entities +=
        fmt::format("#{}=IFCCARTESIANPOINT(({:.6f},0.,{:.6f}));\n#{}=IFCTEXTUREVERTEX(({:.6f},{:.6f}));\n",
                    9100 + i, 2000.0 * x, 2000.0 * z, 9200 + i, x, z);
    points += fmt::format("{}#{}", i > 0 ? "," : "", 9100 + i);
    vertices += fmt::format("{}#{}", i > 0 ? "," : "", 9200 + i);
  }
  const Model model =
      read(textured(entities + "#9010=IFCPOLYLOOP((" + points +
                        "));\n#9011=IFCFACEOUTERBOUND(#9010,.T.);\n#9012=IFCFACE((#9011));\n"
                        "#9013=IFCCONNECTEDFACESET((#9012));\n#9014=IFCSURFACESTYLEWITHTEXTURES((#9015));\n"
                        "#9015=IFCIMAGETEXTURE(.F.,.F.,$,$,$,'disc.png');\n#9016=IFCTEXTUREMAP((#9015),(" +
                        vertices +
                        "),#9012);\n#9017=IFCSURFACESTYLE('Disc',.BOTH.,(#9014));\n"
                        "#9018=IFCSTYLEDITEM(#55,(#9017),$);\n",
                    "#55=IFCEXTRUDEDAREASOLID(#54,#12,#9,200.0);\n#56=IFCSTYLEDITEM(#55,(#45),$);",
                    "#55=IFCFACEBASEDSURFACEMODEL((#9013));"));
  EXPECT_TRUE(warnings_.empty()) << to_string(warnings_);
  const auto disc = std::ranges::find_if(
      model.parts, [&](const Part& each) { return !picture(model, each).pixels.empty(); });
  ASSERT_NE(disc, model.parts.end());
  ASSERT_GE(disc->mesh.indices.size(), 3u * (corners - 2));
  const Bounds box = disc->mesh.bounds();
  for (std::size_t i = 0; i < disc->mesh.positions.size(); ++i) {
    const glm::vec3 share = (disc->mesh.positions[i] - box.min) / glm::max(box.size(), glm::vec3(1e-3f));
    EXPECT_NEAR(disc->mesh.uvs[i].x, share.x, 1e-2f);
    EXPECT_NEAR(disc->mesh.uvs[i].y, 1.0f - share.z, 1e-2f);
  }
}

TEST_F(TexturedIfcTest, EachPictureThatIsLeftOutIsNamed) {
  const auto warning = [&](const std::string& texture) {
    warnings_.clear();
    const Model model = read(textured(with_texture + texture, plaster, pictured));
    EXPECT_TRUE(part(model, "IfcWallStandardCase Wall:Render 300"));
    return to_string(warnings_);
  };
  const std::string absent = warning("#9002=IFCIMAGETEXTURE(.T.,.T.,$,$,$,'gone.png');\n");
  EXPECT_NE(absent.find("gone.png"), std::string::npos) << absent;
  EXPECT_NE(absent.find("a checker stands for it"), std::string::npos) << absent;
  const std::string outside = warning("#9002=IFCIMAGETEXTURE(.T.,.T.,$,$,$,'../../etc/hosts');\n");
  EXPECT_NE(outside.find("a checker stands for it"), std::string::npos) << outside;
  const std::string far = warning("#9002=IFCIMAGETEXTURE(.T.,.T.,$,$,$,'https://example.org/a.png');\n");
  EXPECT_NE(far.find("is no file beside the IFC file"), std::string::npos) << far;
  const std::string pixels = warning("#9002=IFCPIXELTEXTURE(.T.,.T.,$,$,$,1,1,3,(\"0FF0000\"));\n");
  EXPECT_NE(pixels.find("#9002: an IfcPixelTexture is not read"), std::string::npos) << pixels;
  const std::string broken = warning("#9002=IFCBLOBTEXTURE(.T.,.T.,$,$,$,'PNG',\"0FFD8\");\n");
  EXPECT_NE(broken.find("#9002"), std::string::npos) << broken;
}

TEST_F(IfcTest, RoundColumnsAreSmoothAndSlabsFlat) {
  const Model model = pavilion();
  const Part* column = part(model, "IfcColumn Column \xc3\xb8 240");
  const Part* roof = part(model, "IfcSlab Roof:Zinc");
  ASSERT_TRUE(column && roof);
  const auto worst_cosine = [](const Mesh& mesh) {
    float worst = 1.0f;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const glm::vec3 a = mesh.positions[mesh.indices[i]];
      const glm::vec3 flat = glm::normalize(
          glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a));
      for (int k = 0; k < 3; ++k)
        worst = std::min(worst, glm::dot(flat, mesh.normals[mesh.indices[i + std::size_t(k)]]));
    }
    return worst;
  };
  EXPECT_LT(worst_cosine(column->mesh), 0.9999f);
  EXPECT_GT(worst_cosine(column->mesh), 0.8f);
  EXPECT_GT(worst_cosine(roof->mesh), 0.9999f);
}

TEST_F(IfcTest, AnOlderSchemaIsReadAndAnUnknownOneRefused) {
  EXPECT_EQ(read(changed("'IFC4'", "'IFC2X3'")).nodes.size(), 3u);
  const Result<Model> unknown = read_ifc(changed("'IFC4'", "'IFC5'"), warnings_);
  ASSERT_FALSE(unknown);
  EXPECT_NE(to_string(unknown.errors()).find("FILE_SCHEMA(('IFC5'))"), std::string::npos)
      << to_string(unknown.errors());
  EXPECT_NE(to_string(unknown.errors()).find("export the building"), std::string::npos);
}

TEST_F(IfcTest, ABuildingOfTheNewestSchemaIsReadAndWhatItAddsIsNamed) {
  const Model model = read(changed("'IFC4'", "'IFC4X3_ADD2'"));
  EXPECT_EQ(to_string(warnings_), "");
  EXPECT_EQ(model.triangle_count(), pavilion().triangle_count());
  const std::string project = "#14=IFCPROJECT(";
  std::string text = *read_file(folder_.path() / "changed.ifc");
  text.insert(text.find(project), "#9001=IFCROAD('0000000000000000000R01',#5,'Lane',$,$,$,$,$,$,$);\n");
  ASSERT_TRUE(write_file(folder_.path() / "road.ifc", text));
  EXPECT_EQ(read(folder_.path() / "road.ifc").triangle_count(), model.triangle_count());
  EXPECT_NE(to_string(warnings_).find("are left out: 1 IFCROAD"), std::string::npos) << to_string(warnings_);
}

TEST_F(IfcTest, HugeAxesOfAMapConversionTurnTheBuilding) {
  const std::string site = "'Square',$,$,#17,$,$,.ELEMENT.,$,$,$,$,$);";
  const Result<Model> placed =
      read_ifc(changed(site, site + "\n#9001=IFCPROJECTEDCRS('EPSG:25831',$,$,$,$,$,$);\n"
                                    "#9003=IFCMAPCONVERSION(#13,#9001,566000.,5933000.,12.5,0.,1.E200,1.);"),
               warnings_);
  ASSERT_TRUE(placed) << to_string(placed.errors());
  EXPECT_NEAR(bounds(*placed).size().y, bounds(pavilion()).size().x, 1e-3f) << "its x axis runs north";
}

TEST_F(IfcTest, MapConversionPutsTheBuildingOnItsMapAndTheSiteOnTheEarth) {
  const std::string site = "'Square',$,$,#17,$,$,.ELEMENT.,$,$,$,$,$);";
  const auto on_map = [&](const char* unit, const char* east_north) {
    return changed(site, fmt::format("'Square',$,$,#17,$,$,.ELEMENT.,(52,9,36,0),(4,29,24,0),0.,$,$);\n"
                                     "#9001=IFCPROJECTEDCRS('EPSG:25831',$,$,$,$,$,{});\n"
                                     "#9002=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n"
                                     "#9003=IFCMAPCONVERSION(#13,#9001,{},12.5,0.,1.,1.);",
                                     unit, east_north));
  };
  const Bounds as_drawn = bounds(pavilion());
  std::optional<glm::dvec2> place_deg;
  const Result<Model> placed = read_ifc(on_map("#9002", "566000.,5933000."), warnings_, &place_deg);
  ASSERT_TRUE(placed) << to_string(placed.errors());
  EXPECT_EQ(placed->origin, glm::dvec3(566000.0, 5933000.0, 12.5));
  const Bounds turned = bounds(*placed);
  EXPECT_NEAR(turned.size().y, as_drawn.size().x, 1e-3f) << "its x axis runs north";
  EXPECT_NEAR(turned.max.x, -as_drawn.min.y, 1e-3f);
  EXPECT_NEAR(turned.max.y, as_drawn.max.x, 1e-3f);
  ASSERT_TRUE(place_deg);
  EXPECT_NEAR(place_deg->y, 52.16, 1e-6);
  EXPECT_NEAR(place_deg->x, 4.49, 1e-6);
  const Model in_metres = read(on_map("$", "566000.,5933000."));
  EXPECT_EQ(in_metres.origin.x, 566000.0) << "no map unit, and a project in millimetres: no map is so small";
  EXPECT_NEAR(read(on_map("$", "566000000.,5933000000.")).origin.x, 566000.0, 1e-3);
}

TEST_F(IfcTest, FilesWithoutBodiesAreErrors) {
  const Result<Model> empty = read_ifc(changed("'Body'", "'Axis'"), warnings_);
  ASSERT_FALSE(empty);
  EXPECT_NE(to_string(empty.errors()).find("no object has a body"), std::string::npos);
}

TEST_F(IfcTest, AFarPlaceIsMovedToTheOrigin) {
  const Model model = read(changed("(0.,0.,0.)", "(2600000000.,1200000000.,400000.)"));
  EXPECT_GT(model.origin.x, 2.5e6);
  EXPECT_LT(glm::length(bounds(model).centre()), 1000.0f);
}

TEST_F(IfcTest, WhatHasNoStyleLooksAsItsKindDoes) {
  const Model model = read(changed("IFCSTYLEDITEM", "IFCTHATISNOT"));
  const Part* wall = part(model, "IfcWallStandardCase Wall:Render 300");
  ASSERT_TRUE(wall);
  EXPECT_GT(material(model, *wall).base_colour.x, 0.7f);
}

}  // namespace
}  // namespace parvis::scene
