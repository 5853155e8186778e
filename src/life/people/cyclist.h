// Somebody who rides a bicycle, as a model whose legs turn its cranks.
#pragma once

#include <memory>
#include <vector>

#include "life/people/gait.h"
#include "scene/data/model.h"

namespace parvis::people {

/// A cyclist: x forward, the road at z = 0, the middle between the axles at the origin. The wheels are nodes
/// whose names hold "wheel".
class Cyclist {
 public:
  /// Somebody by a number: the same number gives the same person on the same bicycle.
  explicit Cyclist(std::uint64_t number);

  const std::shared_ptr<const scene::Model>& model() const { return model_; }  ///< for objects that deform
  /// Poses the rider after so many metres: `pose` (model_from_node) of bones and cranks, whose other nodes
  /// stay as they are, and the deformed mesh of each part of the model.
  void ride(double travelled_m, std::vector<glm::mat4>& pose, std::vector<Mesh>& deformed) const;

 private:
  BodyField body_;
  BicyclePlaces places_;
  std::shared_ptr<const scene::Model> model_;
  int cranks_ = 0;  ///< node
};

}  // namespace parvis::people
