// The model that a `model` node describes: a file, with the materials and wheels that its children give it.
#pragma once

#include <memory>

#include "formats/readers/readers.h"
#include "scene/data/model.h"
#include "scene/script/node.h"

namespace parvis::scene {

class SceneBuilder;

/// Nodes that say the same share one model. Null, with the errors in `builder`, where the file cannot be
/// used.
std::shared_ptr<const Model> model_of(const Node& node, SceneBuilder& builder,
                                      const formats::Readers& readers);

}  // namespace parvis::scene
