// A photograph ready to be projected onto the model.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "capture/facades/item_buffer.h"
#include "capture/photographs/photograph.h"

namespace parvis::facades {

/// The view of an undistorted photograph; an error that names it where its lens has distortion.
Result<View> view_of(const photographs::Photograph& photograph);

/// A photograph with the model's depth behind each pixel, ready for blending and filling.
struct PreparedPhoto {
  std::string name;
  View view;
  ImageF colours;             ///< linear Rec. 709 times the photograph's gain, 3 channels
  std::vector<float> depths;  ///< of the model behind every pixel centre; infinite: nothing
  ImageF trust;  ///< 1 channel, 0..1: how certainly the pixel shows the model and nothing before it, 0 where
                 ///< the photograph's mask leaves it out; empty: everywhere 1
};

/// Reads the picture and rasterises the model. Errors name the photograph: no pixels, another size than its
/// camera's, a lens with distortion.
Result<PreparedPhoto> prepared_photo(const photographs::Photograph& photograph, const LayerModel& model);

/// Difference between two depths, of the depth, up to which one surface has both (not_hidden).
inline constexpr float depth_tolerance = 0.01f;

/// Depths of the four pixels around a point of the picture.
glm::vec4 depths_around(const PreparedPhoto& photo, glm::dvec2 pixel);

/// Bilinear between pixel centres, repeated beyond the border. `channel` of an image at a point of it in
/// pixels.
float sampled(const ImageF& image, glm::dvec2 pixel, int channel);
/// The same for the first three channels.
glm::vec3 sampled_rgb(const ImageF& image, glm::dvec2 pixel);

}  // namespace parvis::facades
