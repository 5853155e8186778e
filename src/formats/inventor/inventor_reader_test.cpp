#include "formats/inventor/inventor_reader.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/image_io.h"
#include "base/registries.h"
#include "base/test_folder.h"
#include "formats/inventor/test_files.h"
#include "room_list.h"

namespace parvis::inventor {
namespace {

using scene::Model;
using scene::Part;

class Inventor : public testing::Test {
 protected:
  Inventor() { inventor::register_room(registries_); }
  /// Loads a model as scripts do: in a child process.
  Result<Model> load(const std::string& name, std::string_view text) {
    return registries_.get<formats::Readers>().read(folder_.write(name, text), {}, warnings_);
  }
  Model read(const std::string& name, std::string_view text) {
    Result<Model> model = load(name, text);
    EXPECT_TRUE(model) << to_string(model.errors());
    return model ? *std::move(model) : Model();
  }
  std::string errors_of(const std::string& name, std::string_view text) {
    const Result<Model> model = load(name, text);
    EXPECT_FALSE(model);
    return model ? "" : to_string(model.errors());
  }
  static const Part* part(const Model& model, const std::string& object) {
    const auto found = std::ranges::find(model.parts, object, &Part::object);
    return found == model.parts.end() ? nullptr : &*found;
  }

  Registries registries_;
  TestFolder folder_;
  Errors warnings_;
};

TEST_F(Inventor, ColoursOfCornersAreThoseOfTheCorners) {
  const Model model =
      read("corners.wrl",
           "#VRML V2.0 utf8\nDEF board Shape { geometry IndexedFaceSet { coord Coordinate { point "
           "[ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } color Color { color [ 1 0 0, 0 0 1 ] } "
           "colorIndex [ 0 1 1 0 -1 ] coordIndex [ 0 1 2 3 -1 ] } }\n");
  ASSERT_EQ(model.parts.size(), 1u);
  const Mesh& mesh = model.parts[0].mesh;
  ASSERT_EQ(mesh.colours.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(mesh.colours[i], mesh.positions[i].x < 0.5f ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(model.materials[std::size_t(model.parts[0].material)].base_colour, glm::vec3(1.0f));
}

TEST_F(Inventor, ReadsShapesColoursPicturesAndPlaces) {
  ASSERT_TRUE(write_image(folder_.path() / "paint.png", Image8(4, 4, 4, 200)));
  const Model model = read("squares.wrl", squares_vrml);
  ASSERT_EQ(model.parts.size(), 2u);
  const Part* red = part(model, "red");
  ASSERT_NE(red, nullptr);
  EXPECT_EQ(red->mesh.triangle_count(), 2u);
  const Bounds bounds = red->mesh.bounds();
  EXPECT_NEAR(bounds.min.x, 2.0f, 1e-5f);
  EXPECT_NEAR(bounds.max.z, 1.0f, 1e-5f) << "y of the file is up";
  EXPECT_NEAR(bounds.size().y, 0.0f, 1e-5f);
  EXPECT_NEAR(red->mesh.normals[0].y, -1.0f, 1e-4f) << "toward the viewer";
  const scene::Material& paint = model.materials[std::size_t(red->material)];
  EXPECT_EQ(paint.base_colour, glm::vec3(1, 0, 0));
  EXPECT_FALSE(paint.is_double_sided);
  const Part* painted = part(model, "painted");
  ASSERT_NE(painted, nullptr);
  const scene::Material& picture = model.materials[std::size_t(painted->material)];
  EXPECT_TRUE(picture.is_double_sided);
  ASSERT_NE(picture.base_colour_texture, scene::no_index);
  EXPECT_EQ(model.textures[std::size_t(picture.base_colour_texture)].image.at(1, 1)[0], 200);
  for (std::size_t v = 0; v < painted->mesh.uvs.size(); ++v)
    EXPECT_NEAR(painted->mesh.uvs[v].y, 1.0f - painted->mesh.positions[v].z, 1e-5f);
  ASSERT_EQ(warnings_.size(), 1u) << to_string(warnings_);
  EXPECT_NE(to_string(warnings_).find("2 cameras left out"), std::string::npos) << to_string(warnings_);
}

TEST_F(Inventor, ReadsInventorWithAPictureInTheFile) {
  const Model model = read("cube.iv", cube_inventor);
  const Part* block = part(model, "block");
  ASSERT_NE(block, nullptr);
  EXPECT_EQ(block->mesh.triangle_count(), 12u);
  EXPECT_NEAR(block->mesh.bounds().centre().z, 3.0f, 1e-4f);
  const Part* chequer = part(model, "chequer");
  ASSERT_NE(chequer, nullptr);
  const scene::Material& material = model.materials[std::size_t(chequer->material)];
  ASSERT_NE(material.base_colour_texture, scene::no_index);
  const Image8& image = model.textures[std::size_t(material.base_colour_texture)].image;
  ASSERT_EQ(image.width, 2);
  EXPECT_EQ(image.at(0, 1)[0], 255) << "the first texel is at the bottom left";
  EXPECT_EQ(image.at(1, 0)[2], 255);
}

TEST_F(Inventor, MissingPicturesHaveAPlaceholderAndAreNamed) {
  const Model model = read("squares.wrl", squares_vrml);
  EXPECT_EQ(model.parts.size(), 2u);
  EXPECT_NE(to_string(warnings_).find("paint.png"), std::string::npos) << to_string(warnings_);
}

TEST_F(Inventor, NothingOutsideOfItsFolderIsRead) {
  std::string text = squares_vrml;
  text.replace(text.find("paint.png"), 9, "../../../etc/passwd");
  read("squares.wrl", text);
  EXPECT_NE(to_string(warnings_).find("leads out"), std::string::npos) << to_string(warnings_);
}

TEST_F(Inventor, DamagedFilesAreErrorsWithAReason) {
  EXPECT_NE(errors_of("a.wrl", "solid\n").find("is no .wrl file"), std::string::npos);
  EXPECT_NE(errors_of("b.wrl", "#VRML V2.0 utf8\nShape { geometry Box { size 1 1").find("b.wrl"),
            std::string::npos);
  EXPECT_NE(errors_of("c.iv", "#Inventor V2.1 ascii\nSeparator { }").find("no triangles"), std::string::npos);
  EXPECT_NE(errors_of("d.iv", std::string("#Inventor V2.1 binary\n") + '\0' + "x").find("not text"),
            std::string::npos);
}

TEST_F(Inventor, DeepNestingAndLargeFilesEndInWords) {
  std::string deep = "#Inventor V2.1 ascii\n";
  for (int i = 0; i < 10'000; ++i) deep += "Separator {\n";
  deep += "Cube { }\n" + std::string(10'000, '}');
  EXPECT_NE(errors_of("deep.iv", deep).find("nested more than 256 deep"), std::string::npos);
  // 100 MB of blanks and comments around a cube: read, within the limits of the child.
  std::string large = "#Inventor V2.1 ascii\n";
  const std::string blanks(4000, ' ');
  while (large.size() < 100'000'000) large += blanks, large += "# nothing\n";
  EXPECT_EQ(read("large.iv", large + "Cube { }\n").parts.size(), 1u);
}

TEST_F(Inventor, WhatMakesNoTrianglesIsCountedByKindAndName) {
  const Model vrml = read("square.wrl", R"(#VRML V2.0 utf8
DEF entrance Viewpoint { position 0 2 9 }
DEF noon DirectionalLight { } PointLight { }
Background { skyColor 0 0 1 }
DEF clock TimeSensor { } DEF sway OrientationInterpolator { key [0 1] keyValue [0 1 0 0, 0 1 0 1] }
Shape { geometry IndexedLineSet { coord Coordinate { point [0 0 0, 1 0 0] } coordIndex [0 1 -1] } }
LOD { level [ Shape { geometry Box { size 2 4 6 } } ] }
Inline { url "other.wrl" }
)");
  ASSERT_TRUE(vrml.account);
  const scene::FileAccount& account = *vrml.account;
  EXPECT_EQ(account.count(scene::Fate::left_out, "cameras"), 1u) << account.text();
  EXPECT_EQ(account.count(scene::Fate::left_out, "lights"), 2u) << account.text();
  EXPECT_EQ(account.count(scene::Fate::left_out, "fog and backgrounds"), 1u) << account.text();
  EXPECT_EQ(account.count(scene::Fate::left_out, "animations"), 2u) << account.text();
  EXPECT_EQ(account.count(scene::Fate::left_out, "lines and points"), 1u) << account.text();
  EXPECT_EQ(account.count(scene::Fate::changed, "levels of detail"), 1u) << account.text();
  EXPECT_EQ(account.count(scene::Fate::left_out, "files within the file"), 1u) << account.text();
  EXPECT_NE(account.text().find("noon"), std::string::npos) << account.text();
  EXPECT_EQ(account.count(scene::Fate::used, "triangles"), 12u) << account.text();

  const Model inventor = read("cube.iv", R"(#Inventor V2.1 ascii
Separator { PerspectiveCamera { } DEF lamp SpotLight { } DEF turning Rotor { } Cube { }
  Coordinate3 { point [0 0 0, 1 1 1] } PointSet { } Switch { whichChild -1 Cone { } } })");
  ASSERT_TRUE(inventor.account);
  EXPECT_EQ(inventor.account->count(scene::Fate::left_out, "cameras"), 1u) << inventor.account->text();
  EXPECT_EQ(inventor.account->count(scene::Fate::left_out, "lights"), 1u) << inventor.account->text();
  EXPECT_EQ(inventor.account->count(scene::Fate::left_out, "animations"), 1u) << inventor.account->text();
  EXPECT_EQ(inventor.account->count(scene::Fate::left_out, "lines and points"), 1u)
      << inventor.account->text();
  EXPECT_EQ(inventor.account->count(scene::Fate::unneeded, "switches"), 1u) << inventor.account->text();
}

}  // namespace
}  // namespace parvis::inventor
