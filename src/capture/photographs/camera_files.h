// Cameras of photographs from the files of other programs. Where a format keeps no picture size, that of the
// picture of its name is taken.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "capture/photographs/colmap_set.h"

namespace parvis::photographs {

/// Reads the cameras of the pictures in `picture_folder` from `source`:
/// - a folder with a COLMAP model, text or binary;
/// - a folder of NAME.jpg.camera files (Strecha et al., CVPR 2008): K, 0 0 0, R, C, width and height; pixel
/// centres at
///   integers there;
/// - .json: {"convention": ..., "images": [{name, width, height, K, R, and C or t}]} with x_cam = R (X - C) =
/// R X + t;
/// - .wrl, .iv: viewpoints and perspective cameras, named by their description or DEF, y up;
/// - .gltf, .glb: perspective cameras, named by their nodes;
/// - other text (.txt, .xp): lines or attributes camera="x y z h p r fov aspect" of the thesis's scripts,
/// each after the
///   name of its picture.
/// Cameras are left in the world of the source: alignment.h turns z up. Problems name each camera without a
/// picture, each picture without a camera, and sizes that do not agree; they are left out.
Result<LoadedSet> read_cameras(const std::filesystem::path& source,
                               const std::filesystem::path& picture_folder);

/// A place to look from without the size of a picture, as viewpoints have it.
struct ViewOfPicture {
  std::string name;                   ///< of the picture, with or without folder and extension
  glm::dmat4 world_from_camera{1.0};  ///< Parvis's
  double fov = 0.0;                   ///< radians
  enum class Across { width, height, smaller_side } across = Across::height;
};

/// Viewpoints of VRML 97, perspective cameras of VRML 1.0 and Inventor. Here and below `name` stands in
/// errors.
Result<std::vector<ViewOfPicture>> parse_viewpoints(std::string_view text, const std::string& name);
/// Perspective cameras of a glTF 2.0 file, text or binary.
Result<std::vector<ViewOfPicture>> parse_gltf_cameras(std::string_view bytes, const std::string& name);
/// camera="x y z h p r fov aspect" of the thesis's scripts, each named by the file="..." before it.
Result<std::vector<ViewOfPicture>> parse_thesis_cameras(std::string_view text, const std::string& name);
/// A list of photographs as JSON. They have no files yet.
Result<PhotographSet> parse_camera_json(std::string_view text, const std::string& name);
/// One .camera file. The photograph has no name and no file yet.
Result<Photograph> parse_strecha_camera(std::string_view text, const std::string& name);

}  // namespace parvis::photographs
