// Both methods that work on surfaces (extraction and subdivision) are evaluated lazily: a texel, or a part of
// a face, is computed when a pixel first asks for it. The pictures are those of whole textures and meshes.
#include "capture/facades/baselines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

#include "capture/facades/blend.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/novel_view.h"

namespace parvis::facades {
namespace {

constexpr double part_pixels = 12.0;  ///< of subdivision: a part's size in the photograph that sees it best
constexpr int nearest_photos = 3;
constexpr std::size_t max_texture_side = 16384;

/// The pixel that shows a point, where the photograph sees it.
std::optional<glm::dvec2> seen_at(const PreparedPhoto& photo, glm::dvec3 point) {
  const glm::dvec3 p = photo.view.to_camera(point);
  if (p.z <= 0.0) return std::nullopt;
  const glm::dvec2 pixel = photo.view.to_pixel(p);
  if (pixel.x < 0.0 || pixel.y < 0.0 || pixel.x >= photo.view.width || pixel.y >= photo.view.height)
    return std::nullopt;
  const std::size_t index = std::size_t(pixel.y) * std::size_t(photo.view.width) + std::size_t(pixel.x);
  if (not_hidden(float(p.z), photo.depths[index], depth_tolerance) < 0.5f) return std::nullopt;
  // As the layers do it (distrust): what stands before the model is not seen of it.
  if (!photo.trust.empty() && photo.trust.pixels[index] < 0.5f) return std::nullopt;
  return pixel;
}

/// Pixels of a photograph per metre of a surface, foreshortened.
double pixels_per_metre(const PreparedPhoto& photo, glm::dvec3 point, glm::dvec3 normal) {
  const glm::dvec3 off = photo.view.centre - point;
  const double distance = glm::length(off);
  return photo.view.fx / distance * std::sqrt(std::abs(glm::dot(off, normal)) / distance);
}

/// The finest pixels that photographs which see a face's corner or middle have of it.
double finest_pixels(const LayerTriangle& triangle, glm::dvec3 normal,
                     std::span<const PreparedPhoto> photos) {
  double finest = 0.0;
  const auto& c = triangle.corners;
  const glm::dvec3 middle = (c[0] + c[1] + c[2]) / 3.0;
  for (const PreparedPhoto& photo : photos)
    for (const glm::dvec3& point :
         {middle, 0.8 * c[0] + 0.2 * middle, 0.8 * c[1] + 0.2 * middle, 0.8 * c[2] + 0.2 * middle})
      if (seen_at(photo, point)) finest = std::max(finest, pixels_per_metre(photo, point, normal));
  return finest;
}

double area(const LayerTriangle& triangle) {
  const auto& c = triangle.corners;
  return 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
}

/// A point of a surface that a picture asks for.
struct AskedPoint {
  std::uint32_t triangle;
  glm::dvec3 point, eye;
};

template <class Colour>
ImageF drawn(const LayerModel& model, const View& view, Colour colour_of) {
  const ItemBuffer seen = item_buffer(model, view);
  ImageF picture(view.width, view.height, 4);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const std::uint32_t triangle = seen.triangles[seen.index(x, y)];
      if (triangle == no_triangle_seen) continue;
      const glm::vec4 colour = colour_of(AskedPoint{
          triangle, view.to_world({x + 0.5, y + 0.5}, seen.depths[seen.index(x, y)]), view.centre});
      for (int c = 0; c < 4; ++c) picture.at(x, y)[c] = colour[c];
    }
  return picture;
}

/// One texture per face.
class ExtractedTextures {
 public:
  ExtractedTextures(const LayerModel& model, std::span<const PreparedPhoto> photos)
      : model_(model), photos_(photos) {}

  glm::vec4 at(const AskedPoint& asked) {
    const std::uint32_t face = model_.triangles[asked.triangle].face;
    auto known = faces_.find(face);
    if (known == faces_.end()) {
      const LayerTriangle& triangle = model_.triangles[asked.triangle];
      const PlaneFrame frame = frame_of(triangle);
      known = faces_.emplace(face, Face{frame, finest_pixels(triangle, frame.normal, photos_), {}}).first;
    }
    Face& of_face = known->second;
    if (of_face.texels_per_metre <= 0.0) return glm::vec4(0.0f);
    const glm::dvec3 off = asked.point - of_face.frame.origin;
    const glm::dvec2 at = of_face.texels_per_metre *
                              glm::dvec2(glm::dot(off, of_face.frame.u), glm::dot(off, of_face.frame.v)) -
                          0.5;
    const glm::dvec2 low = glm::floor(at);
    const glm::vec2 f(at - low);
    glm::vec4 sum(0.0f);
    for (int k = 0; k < 4; ++k) {
      const float weight = (k & 1 ? f.x : 1 - f.x) * (k >> 1 ? f.y : 1 - f.y);
      sum += weight * texel(of_face, glm::ivec2(low) + glm::ivec2(k & 1, k >> 1));
    }
    return sum.w > 0.0f ? glm::vec4(glm::vec3(sum) / sum.w, 1.0f) : glm::vec4(0.0f);
  }

 private:
  struct Face {
    PlaneFrame frame;
    double texels_per_metre = 0.0;
    std::unordered_map<std::uint64_t, glm::vec4> texels;
  };

  glm::vec4 texel(Face& face, glm::ivec2 place) {
    const std::uint64_t key = std::uint64_t(std::uint32_t(place.x)) << 32 | std::uint32_t(place.y);
    const auto [at, is_new] = face.texels.try_emplace(key, glm::vec4(0.0f));
    if (!is_new) return at->second;
    const glm::dvec2 metres = (glm::dvec2(place) + 0.5) / face.texels_per_metre;
    const glm::dvec3 point = face.frame.origin + metres.x * face.frame.u + metres.y * face.frame.v;
    double finest = 0.0;
    for (const PreparedPhoto& photo : photos_)
      if (const auto pixel = seen_at(photo, point))
        if (const double fine = pixels_per_metre(photo, point, face.frame.normal); fine > finest)
          finest = fine, at->second = glm::vec4(sampled_rgb(photo.colours, *pixel), 1.0f);
    return at->second;
  }

  const LayerModel& model_;
  std::span<const PreparedPhoto> photos_;
  std::unordered_map<std::uint32_t, Face> faces_;
};

/// Parts of faces, each seen all or not at all by each photograph.
class SubdividedFaces {
 public:
  SubdividedFaces(const LayerModel& model, std::span<const PreparedPhoto> photos)
      : model_(model), photos_(photos) {}

  glm::vec4 at(const AskedPoint& asked) {
    const LayerTriangle& triangle = model_.triangles[asked.triangle];
    const std::uint32_t face = triangle.face;
    auto known = faces_.find(face);
    if (known == faces_.end()) {
      const PlaneFrame frame = frame_of(triangle);
      known = faces_.emplace(face, Face{frame, finest_pixels(triangle, frame.normal, photos_), {}}).first;
    }
    Face& of_face = known->second;
    if (of_face.pixels_per_metre <= 0.0) return glm::vec4(0.0f);
    const glm::dvec3 off = asked.point - of_face.frame.origin;
    const double side = part_pixels / of_face.pixels_per_metre;
    const glm::ivec2 place(
        glm::floor(glm::dvec2(glm::dot(off, of_face.frame.u), glm::dot(off, of_face.frame.v)) / side));
    return blended_of(photos_of(of_face, place, side), asked);
  }

 private:
  struct Face {
    PlaneFrame frame;
    double pixels_per_metre = 0.0;
    std::map<std::pair<int, int>, std::vector<std::uint32_t>> photos_of_part;
  };

  const std::vector<std::uint32_t>& photos_of(Face& face, glm::ivec2 place, double side) {
    const auto [at, is_new] = face.photos_of_part.try_emplace({place.x, place.y});
    if (!is_new) return at->second;
    for (std::uint32_t i = 0; i < photos_.size(); ++i) {
      bool sees_all = true;
      for (const glm::dvec2 corner :
           {glm::dvec2(0.02, 0.02), {0.98, 0.02}, {0.98, 0.98}, {0.02, 0.98}, {0.5, 0.5}}) {
        const glm::dvec2 metres = (glm::dvec2(place) + corner) * side;
        sees_all = sees_all &&
                   seen_at(photos_[i], face.frame.origin + metres.x * face.frame.u + metres.y * face.frame.v);
      }
      if (sees_all) at->second.push_back(i);
    }
    return at->second;
  }

  glm::vec4 blended_of(const std::vector<std::uint32_t>& seeing, const AskedPoint& asked) const {
    std::vector<std::pair<float, std::uint32_t>> nearest;
    const glm::vec3 to_eye(glm::normalize(asked.eye - asked.point));
    for (const std::uint32_t i : seeing)
      nearest.emplace_back(
          view_penalty(to_eye, glm::vec3(glm::normalize(photos_[i].view.centre - asked.point)), 1.0f, 0.0f),
          i);
    std::ranges::sort(nearest);
    if (nearest.size() > nearest_photos) nearest.resize(nearest_photos);
    glm::vec3 sum(0.0f);
    float weights = 0.0f;
    for (const auto& [angle, i] : nearest) {
      const View& view = photos_[i].view;
      sum += sampled_rgb(photos_[i].colours, view.to_pixel(view.to_camera(asked.point))) / angle;
      weights += 1.0f / angle;
    }
    return weights > 0.0f ? glm::vec4(sum / weights, 1.0f) : glm::vec4(0.0f);
  }

  const LayerModel& model_;
  std::span<const PreparedPhoto> photos_;
  std::unordered_map<std::uint32_t, Face> faces_;
};

/// Pixels of the model without a colour take the mean of their row's and column's nearest: Debevec's
/// interpolation over unseen polygons, in the picture.
void interpolate_holes(const ItemBuffer& seen, ImageF& picture) {
  constexpr int reach = 64;
  const ImageF before = picture;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      if (seen.triangles[seen.index(x, y)] == no_triangle_seen || before.at(x, y)[3] > 0.0f) continue;
      glm::vec4 sum(0.0f);
      for (const glm::ivec2 step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}})
        for (int d = 1; d <= reach; ++d) {
          const int px = x + d * step.x, py = y + d * step.y;
          if (px < 0 || py < 0 || px >= picture.width || py >= picture.height) break;
          const float* p = before.at(px, py);
          if (p[3] <= 0.0f) continue;
          sum += glm::vec4(p[0], p[1], p[2], 1.0f) / float(d);
          break;
        }
      if (sum.w <= 0.0f) continue;
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = sum[c] / sum.w;
      picture.at(x, y)[3] = 1.0f;
    }
}

BlendSettings lumigraph(int best) {
  BlendSettings settings;
  settings.best = best, settings.max_contradiction = 1.0f;
  return settings;
}

}  // namespace

const char* name_of(BaselineMethod method) {
  constexpr const char* names[]{"single_best_view", "extracted_texture", "view_dependent_subdivided",
                                "unstructured_lumigraph"};
  return names[std::size_t(method)];
}

ImageF baseline_view(BaselineMethod method, const LayerModel& model, const View& view,
                     std::span<const PreparedPhoto> photos) {
  switch (method) {
    case BaselineMethod::single_best_view:
      return novel_view(model, view, photos, lumigraph(1));
    case BaselineMethod::unstructured_lumigraph:
      return novel_view(model, view, photos, lumigraph(4));
    case BaselineMethod::extracted_texture: {
      ExtractedTextures textures(model, photos);
      return drawn(model, view, [&](const AskedPoint& asked) { return textures.at(asked); });
    }
    case BaselineMethod::view_dependent_subdivided: {
      SubdividedFaces faces(model, photos);
      ImageF picture = drawn(model, view, [&](const AskedPoint& asked) { return faces.at(asked); });
      interpolate_holes(item_buffer(model, view), picture);
      return picture;
    }
  }
  return {};
}

std::size_t extracted_texture_bytes(const LayerModel& model, std::span<const PreparedPhoto> photos) {
  struct Face {
    PlaneFrame frame;
    double finest = 0.0;
    glm::dvec2 low{1e300}, high{-1e300};
  };
  std::map<std::uint32_t, Face> faces;
  double bytes = 0.0;  // BC7: one per texel
  for (const LayerTriangle& triangle : model.triangles) {
    if (model.objects[triangle.object].is_dense) {
      // A scan or a relief is unfolded as a whole: a rectangle with borders for each of its triangles would
      // be mostly waste. What its charts waste is not counted.
      const double finest = finest_pixels(triangle, frame_of(triangle).normal, photos);
      bytes += area(triangle) * finest * finest;
      continue;
    }
    auto [at, is_new] = faces.try_emplace(triangle.face);
    if (is_new) at->second.frame = frame_of(triangle);
    Face& face = at->second;
    face.finest = std::max(face.finest, finest_pixels(triangle, face.frame.normal, photos));
    for (const glm::dvec3& corner : triangle.corners) {
      const glm::dvec3 off = corner - face.frame.origin;
      const glm::dvec2 place(glm::dot(off, face.frame.u), glm::dot(off, face.frame.v));
      face.low = glm::min(face.low, place), face.high = glm::max(face.high, place);
    }
  }
  for (const auto& [number, face] : faces) {
    if (face.finest <= 0.0) continue;
    const glm::dvec2 side =
        glm::min(glm::ceil((face.high - face.low) * face.finest) + 4.0, double(max_texture_side));
    bytes += side.x * side.y;  // with 4 texels of border
  }
  return std::size_t(bytes * 21.0 / 16.0);  // three levels of mipmaps, as ours
}

}  // namespace parvis::facades
