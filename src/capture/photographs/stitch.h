// Photographs that were taken from one spot, stitched: six calibrated faces of the sphere around it (thesis,
// section 5.3.1). Features are found by COLMAP, cameras by one_spot.h.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "capture/photographs/picture.h"

namespace parvis::photographs {

/// What became of a folder of photographs.
struct StitchedSpot {
  std::vector<Picture> faces;  ///< as faces_of_panorama gives them; alpha 0 where no photograph looked
  double focal_px = 0.0, error_px = 0.0;
  std::size_t used = 0;
  Errors problems;  ///< photographs that are left out, and why
};

/// The faces from placed pictures of one focal length: each direction is the mean of the photographs that see
/// it, weighted by the distance from their borders, after their exposures were made alike.
/// `world_from_camera` is a rotation per picture. A face has as many pixels per degree as the photographs, at
/// most 4096 per side.
std::vector<Picture> stitched_faces(const std::vector<Image8>& pictures,
                                    const std::vector<glm::dmat3>& world_from_camera, double focal_px,
                                    const std::string& name, glm::dvec3 position);

/// Stitches the photographs of a folder, all of one size and one lens. COLMAP's files go into `work`. North
/// is where the first photograph that is used looks, turned by `heading_deg`; z is up by the photographs'
/// rows. Errors: fewer than two photographs that hang together, pictures of several sizes, COLMAP missing.
Result<StitchedSpot> stitch(const std::filesystem::path& pictures, const std::filesystem::path& work,
                            const std::string& name, glm::dvec3 position, double heading_deg);

}  // namespace parvis::photographs
