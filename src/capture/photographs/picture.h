// The pixels of photographs: read as their camera sees them, and freed from distortion.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "capture/photographs/colmap_set.h"

namespace parvis::photographs {

/// The largest photograph that is read, in pixels: 4 bytes each, and several are held at once.
inline constexpr std::size_t max_photograph_pixels = std::size_t(150) * 1000 * 1000;

/// The photograph's pixels as 8-bit sRGB RGBA, of the size of its lens; alpha is its mask where it has one. A
/// file that EXIF says is turned is turned upright where only then its size is that of the lens. Errors name
/// the file: damaged, cut short, too large, of another size.
Result<Image8> read_picture(const Photograph& photograph);

/// The stored picture as EXIF's orientation (CIPA DC-008, 4.6.4 A), 1 to 8, wants it shown. What turns it
/// back is 8 for 6, 6 for 8, and itself for the others.
Image8 upright(const Image8& stored, int orientation);

/// A photograph with its pixels.
struct Picture {
  Photograph photograph;
  Image8 image;  ///< sRGB RGBA; alpha 0 where the mask says so or where there is nothing
};

/// The photograph without distortion (lens.h: `undistorted`), resampled bicubically; itself where it has
/// none.
Picture undistorted(const Photograph& photograph, Image8 image);

/// Makes lenses and files agree: where a file's size is another than the lens's but of the same shape, the
/// lens is resized to it. Takes out photographs whose file is missing, unreadable, too large or of another
/// shape, each with a problem. Files of `picture_folder` without a camera are named, too. Only headers are
/// read.
void fit_to_files(LoadedSet& loaded, const std::filesystem::path& picture_folder);

/// The JPEG and PNG pictures in a folder and below it, as names relative to it with '/', in order. Hidden
/// files are left out.
std::vector<std::string> picture_names(const std::filesystem::path& folder);
/// The same of files with other extensions (".heic", in lower case), whichever case theirs are in.
std::vector<std::string> picture_names(const std::filesystem::path& folder,
                                       const std::set<std::string>& extensions);

}  // namespace parvis::photographs
