// Panoramas as six calibrated photographs: the faces of a cube around the viewpoint (thesis, section 5.3.1).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "capture/photographs/picture.h"

namespace parvis::photographs {

/// The faces of an equirectangular picture (RGBA, twice as wide as high, z up; its middle column looks
/// towards `heading_deg`, from north over east), each seeing 90 degrees, without distortion, at `position`:
/// NAME_north, _east, _south, _west, _up, _down. A face has a quarter of the picture's width on a side: as
/// many pixels per degree as the horizon has. Errors: another shape.
Result<std::vector<Picture>> faces_of_panorama(const Image8& panorama, const std::string& name,
                                               glm::dvec3 position, double heading_deg = 0.0);

/// Writes faces as files of their names into `folder` and returns them as a set without points. Faces with
/// transparent pixels get masks in the folder "masks" beside it; those without any other are left out.
Result<PhotographSet> write_faces(std::vector<Picture> faces, const std::filesystem::path& folder);

/// Reads an equirectangular picture, writes its faces as NAME_*.png into `folder` and returns them as a set
/// without points, whose files they are.
Result<PhotographSet> split_panorama(const std::filesystem::path& file, const std::filesystem::path& folder,
                                     glm::dvec3 position, double heading_deg = 0.0);

}  // namespace parvis::photographs
