// What the layers are compared with, on the same photographs and model: the methods of figure 3.14 and of
// section 3.8's claims, and what is usual today.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "capture/facades/prepared_photo.h"

namespace parvis::facades {

enum class BaselineMethod : std::uint8_t {
  single_best_view,           ///< per pixel the photograph with the least penalty, by depth maps
  extracted_texture,          ///< one unfolded texture per face, the same from everywhere: per texel the
                              ///< photograph with the finest pixels there
  view_dependent_subdivided,  ///< Debevec et al. 1998: faces divided until a photograph sees each part all or
                              ///< not at all; the three nearest photographs per part, holes by interpolation
  unstructured_lumigraph      ///< Buehler et al. 2001: per pixel the four best photographs, by depth maps
};
inline constexpr BaselineMethod baseline_methods[]{
    BaselineMethod::single_best_view, BaselineMethod::extracted_texture,
    BaselineMethod::view_dependent_subdivided, BaselineMethod::unstructured_lumigraph};
/// The name of the method, as in the keys of the bench.
const char* name_of(BaselineMethod method);

/// The model in `view` by a baseline: linear RGBA, alpha 0 where the method shows nothing. To be compared
/// with layers it needs photographs that are balanced and have their trust, as layers have them.
ImageF baseline_view(BaselineMethod method, const LayerModel& model, const View& view,
                     std::span<const PreparedPhoto> photos);

/// Bytes of the textures that extraction needs at the resolution of the photographs, compressed as ours are,
/// at the finest pixels that any photograph has of a face: per face a rectangle in its plane; dense objects
/// are unfolded as a whole, without waste.
std::size_t extracted_texture_bytes(const LayerModel& model, std::span<const PreparedPhoto> photos);

}  // namespace parvis::facades
