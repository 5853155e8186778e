// A scene with the nodes of designs, for tests.
#pragma once

#include "base/registries.h"
#include "planning/design/session.h"
#include "room_list.h"
#include "scene/script/test_script.h"

namespace parvis::design {

inline Registries test_registries() {
  Registries registries;
  script::register_room(registries), vegetation::register_room(registries), register_room(registries);
  return registries;
}

/// Opens scenes of scripts, whose ground is level.
class DesignTest : public scene::ScriptTest<> {
 protected:
  DesignTest() : ScriptTest(test_registries()) {}

  void open(const std::string& script = "camera(name=eye)", Session::Heights heights = {}) {
    session_.reset();
    auto loaded = ScriptTest::load(script);
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    scene_ = std::move(loaded->scene);
    live_ = scene::LiveScene(std::move(loaded->script));
    Result<Session> session = Session::open(scene_, live_, "", std::move(heights));
    ASSERT_TRUE(session) << to_string(session.errors());
    session_ = *std::move(session);
  }
  void run(const std::string& command) {
    const Status status = session_->run(command);
    EXPECT_TRUE(status) << command << ": " << to_string(status.errors());
  }
  std::string refusal(const std::string& command) {
    const std::string before = session_->script();
    const Status status = session_->run(command);
    EXPECT_FALSE(status) << command;
    EXPECT_EQ(session_->script(), before) << command;
    return status ? "" : status.errors().front().message;
  }
  PlacedObject object(const std::string& name) const {
    for (const PlacedObject& each : session_->objects())
      if (each.name == name) return each;
    ADD_FAILURE() << "no " << name;
    return {};
  }
  int visible() const {
    int count = 0;
    for (const scene::Object& each : scene_.objects) count += each.is_visible;
    return count;
  }

  scene::Scene scene_;
  scene::LiveScene live_;
  std::optional<Session> session_;
};

}  // namespace parvis::design
