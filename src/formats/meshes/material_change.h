// Gives another material to a part of a model: by object, by place in the picture, by colour.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "formats/meshes/material_mask.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// What is overridden; the rest stays as the model's file has it.
struct MaterialChange {
  std::optional<glm::vec3> colour = {};  ///< linear; in place of the picture's
  std::optional<float> roughness = {}, metallic = {}, clear_coat = {}, alpha = {};
  std::optional<glm::vec3> emission = {};
  std::optional<float> ior = {};  ///< makes it solid glass
  std::optional<glm::vec3> absorption_per_m = {};
  std::optional<bool> is_mirror_like = {};
};

/// A surface by name: paint, glass, chrome, ...
struct MaterialPreset {
  std::string name;
  std::string help;
  MaterialChange change;
};
std::span<const MaterialPreset> material_presets();

/// `over` where it says something, else `under`.
MaterialChange merged(const MaterialChange& under, const MaterialChange& over);

/// Changes the material of the triangles of `parts` that lie in one of `masks` (of all, if there is none). A
/// part of which only some triangles do is split in two. Returns the number of triangles changed. Triangles
/// rarely end where a colour does. So that no spikes of glass stand in the paint, a colour that is given with
/// masks is painted into a copy of the picture, texel by texel, and both sides of the split use that copy.
std::size_t change_material(Model& model, std::span<const std::size_t> parts,
                            std::span<const MaterialMask> masks, const MaterialChange& change,
                            const std::string& name);

}  // namespace parvis::scene
