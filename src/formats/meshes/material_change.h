// Replaces the material of a part of a model: selected by object, by region of the texture, by colour.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "formats/meshes/material_mask.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// The properties to override; unset ones stay as the model's file has them.
struct MaterialChange {
  std::optional<glm::vec3> colour = {};  ///< linear; replaces the texture's colour
  std::optional<float> roughness = {}, metallic = {}, clear_coat = {}, alpha = {};
  std::optional<glm::vec3> emission = {};
  std::optional<float> ior = {};  ///< makes it solid glass
  std::optional<glm::vec3> absorption_per_m = {};
  std::optional<bool> is_mirror_like = {};
};

/// A named material: paint, glass, chrome, ...
struct MaterialPreset {
  std::string name;
  std::string help;
  MaterialChange change;
};
/// All presets, in the order in which the scene reference lists them.
std::span<const MaterialPreset> material_presets();

/// The properties of `over` where they are set, else those of `under`.
MaterialChange merged(const MaterialChange& under, const MaterialChange& over);

/// Changes the material of the triangles of `parts` that lie in one of `masks` (of all triangles if there is
/// none). A part that is only partly covered is split in two. Returns the number of triangles changed.
/// Because edges of triangles rarely follow edges of colour, a colour that is given with masks is painted
/// texel by texel into a copy of the texture, which both sides of the split use: this avoids spikes along the
/// border.
std::size_t change_material(Model& model, std::span<const std::size_t> parts,
                            std::span<const MaterialMask> masks, const MaterialChange& change,
                            const std::string& name);

}  // namespace parvis::scene
