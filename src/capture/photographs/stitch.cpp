#include "capture/photographs/stitch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/files.h"
#include "base/parallel.h"
#include "base/path_inside.h"
#include "base/progress.h"
#include "capture/photographs/alignment.h"
#include "capture/photographs/colmap_database.h"
#include "capture/photographs/colmap_features.h"
#include "capture/photographs/one_spot.h"
#include "capture/photographs/panorama.h"
#include "capture/photographs/picture_header.h"
#include "capture/photographs/picture_pairs.h"
#include "capture/photographs/resample.h"

namespace parvis::photographs {
namespace fs = std::filesystem;
namespace {

constexpr int max_face_side = 4096;
constexpr int max_features = 3000;

/// A placed picture of a spot.
struct Placed {
  const Image8* image;
  glm::dmat3 camera_from_world;
};

/// Where a direction of the world appears in a picture; false where it does not.
bool appears(const Placed& placed, double focal, glm::dvec3 direction, glm::dvec2& pixel) {
  const glm::dvec3 d = placed.camera_from_world * direction;
  if (d.z > -1e-6) return false;
  pixel = 0.5 * glm::dvec2(placed.image->width, placed.image->height) + focal / -d.z * glm::dvec2(d.x, -d.y);
  return pixel.x > 0.5 && pixel.y > 0.5 && pixel.x < placed.image->width - 0.5 &&
         pixel.y < placed.image->height - 0.5;
}

/// Grows from the border, where a photograph ends, to its middle.
double feather(const Image8& image, glm::dvec2 pixel) {
  const double inside = std::min({pixel.x, pixel.y, image.width - pixel.x, image.height - pixel.y});
  return std::pow(inside / (0.5 * std::min(image.width, image.height)), 2) + 1e-6;
}

/// Per picture, a factor for its sRGB values that makes the exposures alike: least squares over logarithms of
/// what pictures show along the same directions, alternating; the mean is 1.
std::vector<double> gains_of(const std::vector<Placed>& placed, double focal) {
  struct Overlap {
    std::size_t a, b;
    double log_ratio;  ///< mean of log(b / a)
  };
  std::vector<Overlap> overlaps;
  constexpr int step = 16;
  for (std::size_t a = 0; a < placed.size(); ++a)
    for (std::size_t b = 0; b < placed.size(); ++b) {
      if (a == b) continue;
      double of_a = 0.0, of_b = 0.0;
      int count = 0;
      const Image8& image = *placed[a].image;
      for (int y = step / 2; y < image.height; y += step)
        for (int x = step / 2; x < image.width; x += step) {
          const glm::dvec2 p(x + 0.5 - 0.5 * image.width, y + 0.5 - 0.5 * image.height);
          glm::dvec2 in_b;
          if (!appears(placed[b], focal,
                       glm::transpose(placed[a].camera_from_world) * glm::dvec3(p.x, -p.y, -focal), in_b))
            continue;
          for (int c = 0; c < 3; ++c) {
            of_a += double(image.at(x, y)[c]);
            of_b += double(placed[b].image->at(int(in_b.x), int(in_b.y))[c]);
          }
          ++count;
        }
      if (count > 20 && of_a > 0.0 && of_b > 0.0) overlaps.push_back({a, b, std::log(of_b / of_a)});
    }
  std::vector<double> logs(placed.size(), 0.0);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> sums(placed.size(), 0.0), counts(placed.size(), 1e-9);
    for (const Overlap& overlap : overlaps)
      sums[overlap.a] += logs[overlap.b] + overlap.log_ratio, ++counts[overlap.a];
    double mean = 0.0;
    for (std::size_t i = 0; i < logs.size(); ++i)
      logs[i] = sums[i] / counts[i], mean += logs[i] / double(logs.size());
    for (double& log : logs) log -= mean;
  }
  for (double& log : logs) log = std::exp(log);
  return logs;
}

/// The mean of what photographs show along a direction; transparent where none does.
void mean_along(const std::vector<Placed>& placed, const std::vector<double>& gains, double focal,
                glm::dvec3 direction, std::uint8_t* out) {
  std::array<double, 3> sum{};
  double weights = 0.0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    glm::dvec2 pixel;
    if (!appears(placed[i], focal, direction, pixel)) continue;
    std::uint8_t colour[4];
    sample_bicubic(*placed[i].image, pixel, Border::clamped, colour);
    const double weight = feather(*placed[i].image, pixel);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * gains[i] * colour[c];
    weights += weight;
  }
  for (std::size_t c = 0; c < 3 && weights > 0.0; ++c)
    out[c] = std::uint8_t(std::lround(std::clamp(sum[c] / weights, 0.0, 255.0)));
  out[3] = weights > 0.0 ? 255 : 0;
}

/// Photographs of one size that can be read, in the order of their names.
struct SpotPictures {
  std::vector<std::string> names;
  std::vector<Image8> images;
};

Result<SpotPictures> read_pictures(const fs::path& folder, Errors& problems) {
  SpotPictures pictures;
  for (const std::string& name : picture_names(folder)) {
    const Result<fs::path> file = path_inside(folder, name);
    const Result<PictureHeader> header = file ? read_picture_header(*file) : file.errors();
    Photograph photograph;
    photograph.name = name, photograph.file = folder / name;
    if (header) photograph.lens = pinhole_lens(header->width, header->height, 1.0, 1.0, 0.0, 0.0);
    Result<Image8> image = header ? read_picture(photograph) : header.errors();
    if (!image) {
      problems.push_back(image.errors().front());
      continue;
    }
    if (!pictures.images.empty() &&
        (image->width != pictures.images[0].width || image->height != pictures.images[0].height))
      return error("{}: {} has {} x {} pixels, {} has {} x {}; expected one size for all", folder.string(),
                   name, image->width, image->height, pictures.names[0], pictures.images[0].width,
                   pictures.images[0].height);
    pictures.names.push_back(name), pictures.images.push_back(*std::move(image));
  }
  if (pictures.names.size() < 2) {
    problems.push_back(error("{}: holds {} photographs that can be read; expected 2 or more", folder.string(),
                             pictures.names.size()));
    return problems;
  }
  return pictures;
}

/// What pairs of photographs have in common; `names` are those of the pictures.
Result<std::vector<SpotPair>> pairs_of(const fs::path& folder, const fs::path& work,
                                       const std::vector<std::string>& names) {
  std::error_code code;
  fs::remove(work / "database.db", code), fs::create_directories(work, code);
  std::string list;
  for (const std::string& name : names) list += name + "\n";
  if (Status status = write_file(work / "pictures.txt", list); !status) return status.errors();
  const FeatureJob job{folder, work / "pictures.txt", work / "database.db", "SIMPLE_PINHOLE",
                       true,   max_features};
  if (Status status = find_features(job, names.size(), work / "features.log"); !status)
    return status.errors();
  const std::vector<PictureFeatures> features = picture_features(job.database);
  const std::vector<PicturePair> promising = promising_pairs(features);
  std::vector<SpotPair> pairs(promising.size());
  Progress progress("comparing pairs of photographs", pairs.size());
  parallel_for(pairs.size(), [&](std::size_t i) {
    const PictureFeatures &a = features[promising[i].first], &b = features[promising[i].second];
    const auto number = [&](const std::string& name) {
      return std::size_t(std::ranges::find(names, name) - names.begin());
    };
    pairs[i].a = number(a.name), pairs[i].b = number(b.name);
    for (const auto& [of_a, of_b] : matching_features(a, b))
      pairs[i].pixels.emplace_back(glm::dvec2(a.pixels[of_a]), glm::dvec2(b.pixels[of_b]));
    progress.advance();
  });
  return pairs;
}

/// Turns the cameras so that z is up by the pictures' rows, and the first looks towards a heading.
void turn_upright(std::vector<glm::dmat3>& world_from_camera, double heading_deg) {
  PhotographSet set;
  for (const glm::dmat3& rotation : world_from_camera) {
    Photograph photograph;
    photograph.world_from_camera = glm::dmat4(rotation);
    set.photographs.push_back(photograph);
  }
  make_z_up(set, false);
  const glm::dvec3 first = set.photographs[0].forward_in_world();
  const double angle = std::atan2(first.x, first.y) - glm::radians(heading_deg);  // from north over east
  const glm::dmat3 turn(std::cos(angle), std::sin(angle), 0.0, -std::sin(angle), std::cos(angle), 0.0, 0.0,
                        0.0, 1.0);
  for (std::size_t i = 0; i < set.photographs.size(); ++i)
    world_from_camera[i] = turn * glm::dmat3(set.photographs[i].world_from_camera);
}

}  // namespace

std::vector<Picture> stitched_faces(const std::vector<Image8>& pictures,
                                    const std::vector<glm::dmat3>& world_from_camera, double focal_px,
                                    const std::string& name, glm::dvec3 position) {
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    placed.push_back({&pictures[i], glm::transpose(world_from_camera[i])});
  const std::vector<double> gains = gains_of(placed, focal_px);
  const int side = std::clamp(int(std::lround(2.0 * focal_px)), 8, max_face_side);
  std::vector<Picture> faces;
  for (const Photograph& face : face_cameras(name, side, position)) {
    Picture picture{face, Image8(side, side, 4, 0)};
    parallel_for(std::size_t(side), [&](std::size_t y) {
      for (int x = 0; x < side; ++x)
        if (const auto direction = direction_in_world(face, {x + 0.5, double(y) + 0.5}))
          mean_along(placed, gains, focal_px, *direction, picture.image.at(x, int(y)));
    });
    faces.push_back(std::move(picture));
  }
  return faces;
}

Result<StitchedSpot> stitch(const fs::path& pictures, const fs::path& work, const std::string& name,
                            glm::dvec3 position, double heading_deg) {
  StitchedSpot spot;
  Result<SpotPictures> read = read_pictures(pictures, spot.problems);
  if (!read) return read.errors();
  const Result<std::vector<SpotPair>> pairs = pairs_of(pictures, work, read->names);
  if (!pairs) return pairs.errors();
  const SpotCameras cameras = cameras_of_one_spot(read->names.size(), *pairs,
                                                  glm::dvec2(read->images[0].width, read->images[0].height));
  std::vector<Image8> images;
  std::vector<glm::dmat3> rotations;
  for (std::size_t i = 0; i < read->names.size(); ++i) {
    if (cameras.is_placed[i]) {
      images.push_back(std::move(read->images[i])), rotations.push_back(cameras.world_from_camera[i]);
    } else {
      spot.problems.push_back(
          error("{}: has nothing in common with the other photographs of this spot; photographs between are "
                "missing, or it was taken from elsewhere",
                read->names[i]));
    }
  }
  if (images.size() < 2) {
    spot.problems.push_back(
        error("{}: no two photographs hang together as seen from one spot; they should "
              "overlap by a third, and be taken without a step aside",
              pictures.string()));
    return spot.problems;
  }
  turn_upright(rotations, heading_deg);
  spot.faces = stitched_faces(images, rotations, cameras.focal_px, name, position);
  spot.focal_px = cameras.focal_px, spot.error_px = cameras.error_px, spot.used = images.size();
  return spot;
}

}  // namespace parvis::photographs
