// Tests whose scripts are files in a folder of their own, loaded with the nodes of a house.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "base/registries.h"
#include "base/test_folder.h"
#include "scene/script/scene_loader.h"

namespace parvis::scene {

/// `Base` is what the test needs beside, such as an OpenGL context.
template <class Base = testing::Test>
class ScriptTest : public Base {
 protected:
  explicit ScriptTest(Registries registries = {}) : registries_(std::move(registries)) {}

  Result<LoadedScene> load(const std::string& script) const {
    return load_scene(folder_.write("scene.xp", script), registries_.get<NodeRegistry>(), data_folders_);
  }
  /// Empty where the script cannot be loaded, which fails the test.
  Scene scene_of(const std::string& script) const {
    auto loaded = load(script);
    EXPECT_TRUE(loaded) << (loaded ? "" : to_string(loaded.errors()));
    return loaded ? std::move(loaded->scene) : Scene();
  }
  /// The errors of a script that cannot be loaded.
  std::string errors_of(const std::string& script) const {
    const auto loaded = load(script);
    EXPECT_FALSE(loaded) << script;
    return loaded ? "" : without_folder(to_string(loaded.errors()));
  }
  /// The text whose places read "scene.xp:1:2:".
  std::string without_folder(std::string text) const {
    const std::string prefix = (folder_.path() / "").string();
    for (std::size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
    return text;
  }
  static bool holds(const std::string& text, const std::string& piece) {
    return text.find(piece) != std::string::npos;
  }

  TestFolder folder_;
  Registries registries_;
  std::vector<std::filesystem::path> data_folders_;  ///< that scripts may read from, too
};

}  // namespace parvis::scene
