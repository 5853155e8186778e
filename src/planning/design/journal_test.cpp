// Nothing is lost: journals that are replayed, cut, damaged, of another design, and of programs that were
// killed.
#include "planning/design/journal.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "base/files.h"
#include "planning/design/design_file.h"
#include "planning/design/design_json.h"
#include "planning/design/test_design.h"
#include "planning/design/test_random_commands.h"

namespace parvis::design {
namespace {

class JournalTest : public DesignTest {
 protected:
  std::filesystem::path file() const { return folder_.path() / ".scene.design.journal"; }
  /// The report of a session that reads the journal.
  std::string keep() {
    const Result<std::string> kept = session_->keep_journal(file());
    EXPECT_TRUE(kept) << to_string(kept.errors());
    return kept ? *kept : "";
  }
  std::string keep_refused() {
    const Result<std::string> kept = session_->keep_journal(file());
    EXPECT_FALSE(kept);
    return kept ? "" : kept.errors().front().message;
  }
};

TEST_F(JournalTest, WhatWasNotSavedIsThereAgainAndCanBeUndone) {
  open();
  EXPECT_EQ(keep(), "");
  run("insert bench_stone 1,2 heading 45");
  run("row bollard from 0,0 to 9,0 count 4");
  run("move bench_stone_1 by 0.5,0");
  run("undo");
  const std::string before = session_->script();
  open();
  EXPECT_EQ(keep(), "4 steps that had not been saved are there again");
  EXPECT_EQ(session_->script(), before);
  run("redo");
  EXPECT_EQ(object("bench_stone_1").position.x, 1.5);
  for (int i = 0; i < 3; ++i) run("undo");
  EXPECT_EQ(session_->script(), "");
}

TEST_F(JournalTest, OneAloneWritesIt) {
  open();
  keep();
  run("insert bench_stone 1,2");
  const std::string kept = *read_file(file());
  const Result<Journal> second = Journal::lock(file());
  ASSERT_FALSE(second);
  EXPECT_NE(second.errors().front().message.find("close it there"), std::string::npos);
  EXPECT_EQ(*read_file(file()), kept);
  session_.reset();
  EXPECT_TRUE(Journal::lock(file())) << "a program that has ended holds nothing";
}

TEST_F(JournalTest, ASavedDesignOpensWithItsSteps) {
  open();
  keep();
  run("insert bench_stone 1,2");
  const std::filesystem::path design = folder_.path() / "square.xp";
  ASSERT_TRUE(save(*session_, folder_.path() / "scene.xp", design));
  ASSERT_TRUE(session_->note_saved());
  EXPECT_FALSE(session_->has_unsaved());
  const std::string saved = session_->script();
  const Result<std::string> text = read_file(design);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("include(file=scene.xp)"), std::string::npos) << *text;
  auto loaded = scene::load_scene(design, registries_.get<scene::NodeRegistry>(), data_folders_);
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene_ = std::move(loaded->scene), live_ = scene::LiveScene(std::move(loaded->script));
  session_ = *Session::open(scene_, live_, "", {});
  EXPECT_EQ(session_->script(), saved);
  EXPECT_EQ(keep(), "");
  run("undo");
  EXPECT_EQ(session_->script(), "") << "a step before it was saved";
}

TEST_F(JournalTest, ALineThatWasBeingWrittenIsLeftOut) {
  open();
  keep();
  run("insert bench_stone 1,2");
  run("insert bench_stone 3,2");
  const Result<std::string> text = read_file(file());
  ASSERT_TRUE(text);
  for (std::size_t cut = text->size() - 1; cut > text->rfind('\n', text->size() - 2) + 1; cut -= 7) {
    std::ofstream(file(), std::ios::trunc) << text->substr(0, cut);
    open();
    EXPECT_NE(keep().find("one that was being written is not"), std::string::npos);
    EXPECT_EQ(session_->objects().size(), 1u);
  }
  run("insert bench_stone 5,2");
  open();
  keep();
  EXPECT_EQ(session_->objects().size(), 2u) << "lines after the cut one are whole";
}

TEST_F(JournalTest, OneThatIsOfNoUseIsLeftAsItIs) {
  open();
  keep();
  run("insert bench_stone 1,2");
  const std::string whole = *read_file(file());
  const auto refused = [&](const std::string& content, const std::string& script) {
    std::ofstream(file(), std::ios::trunc) << content;
    open(script);
    const std::string why = keep_refused();
    EXPECT_EQ(*read_file(file()), content);
    run("insert bench_stone 8,2");
    EXPECT_EQ(*read_file(file()), content) << "nothing is appended";
    return why;
  };
  const std::string plain = "camera(name=eye)";
  EXPECT_NE(refused(whole, "design(name=other) { }").find("of another design"), std::string::npos);
  EXPECT_NE(refused("# My notes\n", plain).find("no journal"), std::string::npos);
  EXPECT_NE(refused("parvis design journal 7\n", plain).find("newer version"), std::string::npos);
  EXPECT_NE(refused("parvis design journal 1\n", plain).find("ends before"), std::string::npos);
  std::string damaged = whole;
  damaged[damaged.find("base") + 1] = 'X';
  EXPECT_NE(refused(damaged, plain).find("damaged"), std::string::npos);
}

TEST_F(JournalTest, OneOfSavedStepsIsPutAsideWhereTheDesignWasChangedBesideIt) {
  open("design(name=design) { }");
  keep();
  run("insert bench_stone 1,2");
  EXPECT_TRUE(session_->note_saved());
  const std::string before = *read_file(file());
  open("design(name=design) { placed(name=a, kind=bench_stone, position=\"9 9 0\") }");
  EXPECT_NE(keep().find("beside its journal"), std::string::npos);
  EXPECT_EQ(*read_file(file().string() + ".1"), before);
  run("insert bench_stone 1,2");
  open("design(name=design) { placed(name=a, kind=bench_stone, position=\"9 9 0\") }");
  EXPECT_NE(keep().find("had not been saved"), std::string::npos);
  EXPECT_EQ(session_->objects().size(), 2u);
}

/// The work of a program that is killed: commands of one seed, each acknowledged by a byte when it has
/// returned.
[[noreturn]] void work(Session& session, int acknowledge) {
  Random random(5);
  for (;;) {
    (void)session.run(random_command(random, session));
    if (write(acknowledge, "x", 1) != 1) _exit(1);
  }
}

TEST_F(JournalTest, AProgramThatIsKilledLosesNoCommand) {
  Random moments(3);
  for (int kill_number = 0; kill_number < 6; ++kill_number) {
    std::filesystem::remove(file());
    open();
    keep();
    int pipes[2];
    ASSERT_EQ(pipe(pipes), 0);
    const pid_t child = fork();
    if (child == 0) work(*session_, pipes[1]);
    close(pipes[1]);
    const int wanted = 1 + moments.index(60);
    int acknowledged = 0;
    char byte;
    while (acknowledged < wanted && read(pipes[0], &byte, 1) == 1) ++acknowledged;
    kill(child, SIGKILL);
    while (read(pipes[0], &byte, 1) == 1) ++acknowledged;
    close(pipes[0]);
    waitpid(child, nullptr, 0);

    open();
    keep();
    const std::string restored = session_->script();
    // The same commands once more: the design is as it was after the last one that was acknowledged, or one
    // later.
    std::filesystem::remove(file());
    open();
    Random random(5);
    for (int i = 0; i < acknowledged; ++i) (void)session_->run(random_command(random, *session_));
    const std::string after = session_->script();
    (void)session_->run(random_command(random, *session_));
    EXPECT_TRUE(restored == after || restored == session_->script()) << "killed after " << acknowledged;
  }
}

TEST_F(JournalTest, ADesignInJsonComesBackAsItWas) {
  open();
  run("insert bench_wood 1.25,2.5 heading 30 width 2.4");
  run("insert tree_oak 7,8 height 6");
  run("surface gravel 0,0 4,0 4,4");
  const std::string json = json_of(scene_, *session_, "design.json");
  const std::string before = session_->script();
  open();
  const Status status = read_json(json, "design.json", *session_, {});
  ASSERT_TRUE(status) << to_string(status.errors());
  EXPECT_EQ(json_of(scene_, *session_, "design.json"), json);
  open();
  const auto refused = [&](const std::string& text) {
    const Status read = read_json(text, "design.json", *session_, {});
    return read ? "" : to_string(read.errors());
  };
  EXPECT_NE(refused(json.substr(0, json.size() / 2)).find("its end is missing"), std::string::npos);
  EXPECT_NE(refused("{\"parvis_design\": 9, \"objects\": []}").find("newer than this program"),
            std::string::npos);
  EXPECT_NE(refused("{\"parvis_design\": 1, \"objects\": [{\"kind\": \"bench\"}]}").find("object 1"),
            std::string::npos);
  EXPECT_NE(refused("[]").find("no design"), std::string::npos);
  const auto refused_object = [&](const std::string& values) {
    return refused("{\"parvis_design\":1,\"objects\":[{\"kind\":\"bollard\"," + values + "}]}");
  };
  EXPECT_NE(refused("{\"parvis_design\":1,\"unit\":\"cm\",\"objects\":[]}").find("convert them"),
            std::string::npos);
  EXPECT_NE(refused_object("\"position\":[0,0]").find("[x, y, z] in metres"), std::string::npos);
  EXPECT_NE(refused_object("\"position\":[0,0,0],\"heading_deg\":\"90\"").find("is a number"),
            std::string::npos);
  EXPECT_NE(refused_object("\"position\":[0,0,0],\"locked\":\"no\"").find("true or false"),
            std::string::npos);
  EXPECT_NE(refused_object("\"position\":[0,0,0],\"name\":\"a\\nb\"").find("control characters"),
            std::string::npos);
  EXPECT_TRUE(session_->objects().empty()) << "what was refused stands nowhere";
}

TEST_F(JournalTest, JsonKeepsGroupsLocksAndViews) {
  open();
  run("row bollard from 0,0 to 4,0 count 3");
  run("group bollard_1,bollard_2 as gate");
  run("lock bollard_3");
  run("view terrace 1,2,1.7 heading 90 pitch -5 fov 70");
  const std::string json = json_of(scene_, *session_, "design.json");
  open();
  ASSERT_TRUE(read_json(json, "design.json", *session_, {}));
  EXPECT_EQ(json_of(scene_, *session_, "design.json"), json);
  EXPECT_NE(json.find("terrace"), std::string::npos);
  EXPECT_NE(json.find("gate"), std::string::npos);
}

}  // namespace
}  // namespace parvis::design
