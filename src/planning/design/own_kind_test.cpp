#include "planning/design/own_kind.h"

#include <gtest/gtest.h>

#include "planning/design/design_file.h"
#include "planning/design/design_json.h"
#include "planning/design/test_design.h"

namespace parvis::design {
namespace {

class OwnKindTest : public DesignTest {
 protected:
  OwnKindTest() {
    gltf::register_room(registries_), meshes::register_room(registries_);
    open();
  }

  /// A box as OBJ, y up.
  std::filesystem::path box(const std::string& name, double x, double y, double z) {
    std::string text;
    for (int corner = 0; corner < 8; ++corner)
      text +=
          fmt::format("v {} {} {}\n", (corner & 1) ? x : 0.0, (corner & 2) ? y : 0.0, (corner & 4) ? z : 0.0);
    return folder_.write(name, text + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n");
  }
  Result<OwnKind> import(const std::filesystem::path& file, double unit_m = 0.0) {
    return import_kind(registries_.get<formats::Readers>(), scene_, file, unit_m);
  }
  void take(const std::filesystem::path& file) {
    const Result<OwnKind> kind = import(file);
    ASSERT_TRUE(kind) << to_string(kind.errors());
    const Status status = session_->run(Command(kind->command));
    ASSERT_TRUE(status) << to_string(status.errors());
  }
};

TEST_F(OwnKindTest, AModelIsPlacedInItsOwnSizeWithItsFootOnTheGround) {
  take(box("Bench of Nice.obj", 2.0, 0.5, 0.4));
  run("insert bench_of_nice 3,4 heading 0");
  EXPECT_EQ(object("bench_of_nice_1").size_m, glm::dvec3(2.0, 0.4, 0.5));
  const scene::Object& placed = scene_.objects.at(0);
  const Bounds shown = transformed(placed.world_from_model, bounds(*placed.model));
  EXPECT_NEAR(shown.min.z, 0.0f, 1e-4f);
  EXPECT_NEAR(shown.max.z, 0.5f, 1e-4f);
  EXPECT_NEAR(shown.centre().x, 3.0f, 1e-4f);
  EXPECT_NEAR(shown.centre().y, 4.0f, 1e-4f);
  run("resize bench_of_nice_1 width 3");
  EXPECT_EQ(object("bench_of_nice_1").size_m.x, 3.0);
  EXPECT_EQ(session_->objects().size(), 1u) << "the kind itself is no object";
}

TEST_F(OwnKindTest, TheSameModelOnceMoreIsTheSameFile) {
  const std::filesystem::path file = box("seat.obj", 1, 1, 1);
  EXPECT_EQ(import(file)->command.file, "kinds/seat.glb");
  EXPECT_EQ(import(file)->command.file, "kinds/seat.glb");
  box("seat.obj", 2, 1, 1);
  EXPECT_EQ(import(file)->command.file, "kinds/seat_2.glb") << "another model of the name";
}

TEST_F(OwnKindTest, JsonTakesTheModelToAnotherScene) {
  take(box("seat.obj", 1.5, 1, 1));
  run("insert seat 3,4");
  const std::string json = json_of(scene_, *session_, folder_.path() / "design.json");
  EXPECT_NE(json.find("\"file\": \"kinds/seat.glb\""), std::string::npos) << json;
  const std::filesystem::path elsewhere = folder_.path() / "elsewhere";
  open();
  scene_.file = elsewhere / "scene.xp";
  const auto take_model = [this](const std::filesystem::path& file) { return import(file); };
  const Status status = read_json(json, folder_.path() / "design.json", *session_, take_model);
  ASSERT_TRUE(status) << to_string(status.errors());
  EXPECT_EQ(object("seat_1").size_m, glm::dvec3(1.5, 1.0, 1.0));
  EXPECT_TRUE(std::filesystem::exists(elsewhere / "kinds/seat.glb"));
  open();
  const Status gone = read_json(json, elsewhere / "below/design.json", *session_, take_model);
  ASSERT_FALSE(gone);
  EXPECT_NE(gone.errors().front().message.find("put it there"), std::string::npos);
}

TEST_F(OwnKindTest, TheKindGoesWithItsStepAndIsInTheScript) {
  take(box("seat.obj", 1, 1, 1));
  EXPECT_NE(session_->script().find("kind(name=seat, file=kinds/seat.glb"), std::string::npos)
      << session_->script();
  run("insert seat 0,0");
  run("undo");
  run("undo");
  EXPECT_EQ(find_kind(scene_, "seat"), nullptr);
  EXPECT_NE(refusal("insert seat 0,0").find("no kind"), std::string::npos);
  run("redo");
  run("redo");
  EXPECT_EQ(object("seat_1").kind, "seat");
  run("select all");
  run("delete selected");
  EXPECT_NE(find_kind(scene_, "seat"), nullptr);
  EXPECT_EQ(import(box("seat.obj", 1, 1, 1))->command.name, "seat_2") << "nothing is overwritten";
}

TEST_F(OwnKindTest, UnitsAreFoundOrAskedFor) {
  const Result<OwnKind> millimetres = import(box("mm.obj", 1800, 450, 500));
  ASSERT_TRUE(millimetres) << to_string(millimetres.errors());
  EXPECT_EQ(millimetres->command.size_m, glm::dvec3(1.8, 0.5, 0.45));
  EXPECT_NE(millimetres->note.find("millimetres"), std::string::npos);
  EXPECT_EQ(import(box("cm.obj", 180, 45, 50))->command.size_m, glm::dvec3(1.8, 0.5, 0.45));
  const Result<OwnKind> mountain = import(box("huge.obj", 9e6, 1, 1));
  ASSERT_FALSE(mountain);
  const std::string why = to_string(mountain.errors());
  EXPECT_NE(why.find("centimetres"), std::string::npos) << why;
}

TEST_F(OwnKindTest, WhatIsNoModelIsRefused) {
  EXPECT_FALSE(import(folder_.write("note.txt", "a bench")));
  EXPECT_FALSE(import(folder_.write("empty.obj", "v 0 0 0\n")));
  EXPECT_FALSE(import(folder_.path() / "gone.obj"));
  EXPECT_NE(refusal("kind lost kinds/lost.glb 1,1,1").find("lost.glb"), std::string::npos);
  take(box("seat.obj", 1, 1, 1));
  EXPECT_NE(refusal("kind umbrella kinds/seat.glb 1,1,1").find("already"), std::string::npos);
  EXPECT_NE(refusal("kind large kinds/seat.glb 1e30,1,1").find("200"), std::string::npos);
}

}  // namespace
}  // namespace parvis::design
