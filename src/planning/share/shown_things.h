// What a browser is to draw of a scene in its scenarios: plain models in their places, each once, whether the
// scene's objects or things that rooms draw by themselves.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/data/scene.h"

namespace parvis::share {

class ShownThings {
 public:
  /// Adds what is visible of `scene` now, still as it stands, and returns its numbers: those of `objects`,
  /// ascending. What is the same as before has the number that it had.
  std::vector<int> add(const scene::Scene& scene);

  /// Everything that was visible at some time; models have neither animations nor deformations.
  const std::vector<scene::Object>& objects() const { return objects_; }
  /// Numbers of those that lie around the place as far as the horizon.
  const std::vector<int>& surroundings() const { return surroundings_; }
  /// Kinds of things of rooms that are shown in plain colours, and how many of them.
  const std::map<std::string, int>& plain_kinds() const { return plain_kinds_; }
  /// True if a plant has fewer leaves here than it has in the scene.
  bool has_thinned_plants() const { return has_thinned_plants_; }

 private:
  int number_of(const scene::Object& object, std::uint64_t model_key);
  std::shared_ptr<const scene::Model> still(const scene::Object& object, std::uint64_t& key);
  void add_plants(const scene::Scene& scene, std::vector<int>& shown);
  void add_others(const scene::Scene& scene, std::vector<int>& shown);

  std::vector<scene::Object> objects_;
  std::map<std::uint64_t, int> numbers_;
  std::map<std::uint64_t, std::shared_ptr<const scene::Model>> models_;
  std::vector<int> surroundings_;
  std::map<std::string, int> plain_kinds_;
  bool has_thinned_plants_ = false;
};

}  // namespace parvis::share
