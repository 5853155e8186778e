// What a command would make of a design, shown before it is done: the objects that it brings or changes, in a
// small scene of their own.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "planning/design/session.h"

namespace parvis::design {

/// The objects that hang on a pointer or move with it.
class Preview {
 public:
  /// Both outlive it.
  Preview(const scene::Scene& scene, const scene::LiveScene& live) : place_(scene), live_(live) {}

  /// Shows what these changes bring, as they would stand in the design (null: a new one at the top level),
  /// the first `refused` of them in red. Errors: those that building them meets; nothing is shown then.
  Status show(const Changes& changes, const scene::Node* design, std::size_t refused = 0);
  /// Shows nothing.
  void clear();
  bool is_empty() const { return names_.empty(); }

  /// The scene that is shown: objects of earlier calls stay, hidden, at their indices.
  const scene::Scene& scene() const { return shown_; }
  /// A flag for each object and thing of the scene (render::View::shown_objects): false for those that the
  /// changes take away or put elsewhere.
  std::vector<std::uint8_t> what_stays() const;
  /// Names of these, as the scene has them.
  const Names& taken() const { return taken_; }

 private:
  void put_objects(std::vector<scene::Object> objects, const std::set<std::string>& refused);

  const scene::Scene& place_;
  const scene::LiveScene& live_;
  scene::Scene shown_;
  scene::SharedModels models_;
  std::map<const scene::Model*, std::shared_ptr<const std::vector<scene::Material>>> red_;
  Names names_, taken_;
};

}  // namespace parvis::design
