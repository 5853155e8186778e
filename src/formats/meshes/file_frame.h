// Axes and units that mesh files name themselves and assimp leaves as they are. A part of the module assimp.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "formats/readers/readers.h"
#include "scene/data/file_account.h"

struct aiScene;

namespace parvis::scene {

/// The matrix to metres with z up: by `up`, else, of FBX, by its global settings, of 3MF z up, of others y
/// up where `is_y_up`. The units of FBX (centimetres where it names none) and of 3MF (`bytes`, the file;
/// millimetres) are given in metres, which `account` says.
glm::dmat4 model_from_file(const aiScene& scene, const std::string& extension, std::string_view bytes,
                           formats::UpAxis up, bool is_y_up, FileAccount& account);

/// The metres of a unit of a 3MF file's model, by its first bytes.
double metres_of_3mf(std::string_view model_front);

}  // namespace parvis::scene
