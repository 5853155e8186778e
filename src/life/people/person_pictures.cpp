#include "life/people/person_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/colour.h"

namespace parvis::people {
namespace {

using glm::ivec2, glm::vec2, glm::vec3;

constexpr int samples_per_side = 2;  // of a pixel
constexpr int samples_x = samples_per_side * picture_width_px,
              samples_y = samples_per_side * picture_height_px;
constexpr float pictured_speed_m_s = 1.25f;

/// The axes of a picture in the person's frame: to the right, up, and to the viewer.
struct PictureFrame {
  vec3 right, up, to_viewer;
  float lowest;  ///< as PictureRing
};

PictureFrame frame_of(int direction) {
  int ring = 0;
  if (direction >= picture_rings[0].azimuths) ring = 1, direction -= picture_rings[0].azimuths;
  const PictureRing& from = picture_rings[std::size_t(ring)];
  const float azimuth = 2.0f * pi * float(direction) / float(from.azimuths),
              elevation = glm::radians(from.elevation_deg);
  PictureFrame frame;
  frame.to_viewer = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                     std::sin(elevation)};
  frame.right = {-std::sin(azimuth), std::cos(azimuth), 0.0f};
  frame.up = glm::cross(frame.to_viewer, frame.right);
  frame.lowest = from.lowest;
  return frame;
}

/// The triangle that a sample shows, and where on it.
struct PictureSample {
  float depth = -std::numeric_limits<float>::max();  ///< toward the viewer
  std::uint32_t triangle = 0;
  vec2 weights{0.0f};  ///< of the second and the third corner

  bool is_hit() const { return depth > -1e9f; }
};

/// One picture in samples.
class SampledPicture {
 public:
  SampledPicture() : samples_(std::size_t(samples_x * samples_y)) {}

  void clear() { std::ranges::fill(samples_, PictureSample{}); }
  const PictureSample& at(int x, int y) const { return samples_[std::size_t(y * samples_x + x)]; }

  /// Draws all triangles of a mesh.
  void draw(const Mesh& mesh, const PictureFrame& frame, float stature_m) {
    const float per_m = float(samples_per_side) * picture_px_per_stature / stature_m;
    in_picture_.resize(mesh.positions.size());
    for (std::size_t v = 0; v < in_picture_.size(); ++v) {
      const vec3 p = mesh.positions[v];
      in_picture_[v] = {0.5f * float(samples_x) + per_m * glm::dot(p, frame.right),
                        float(samples_y) - per_m * (glm::dot(p, frame.up) - frame.lowest * stature_m),
                        glm::dot(p, frame.to_viewer)};
    }
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
      draw(t, in_picture_[mesh.indices[3 * t]], in_picture_[mesh.indices[3 * t + 1]],
           in_picture_[mesh.indices[3 * t + 2]]);
  }

 private:
  void draw(std::uint32_t triangle, vec3 a, vec3 b, vec3 c) {
    const vec2 ab(b - a), ac(c - a);
    const float area = ab.x * ac.y - ab.y * ac.x;
    if (std::abs(area) < 1e-6f) return;  // both sides are seen
    const vec2 low = glm::min(glm::min(vec2(a), vec2(b)), vec2(c)),
               high = glm::max(glm::max(vec2(a), vec2(b)), vec2(c));
    const int x0 = std::max(0, int(std::ceil(low.x - 0.5f))),
              x1 = std::min(samples_x - 1, int(std::floor(high.x - 0.5f)));
    const int y0 = std::max(0, int(std::ceil(low.y - 0.5f))),
              y1 = std::min(samples_y - 1, int(std::floor(high.y - 0.5f)));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const vec2 p = vec2(float(x) + 0.5f, float(y) + 0.5f) - vec2(a);
        const float of_b = (p.x * ac.y - p.y * ac.x) / area, of_c = (ab.x * p.y - ab.y * p.x) / area;
        if (of_b < 0.0f || of_c < 0.0f || of_b + of_c > 1.0f) continue;
        const float depth = a.z + of_b * (b.z - a.z) + of_c * (c.z - a.z);
        PictureSample& sample = samples_[std::size_t(y * samples_x + x)];
        if (depth > sample.depth) sample = {depth, triangle, {of_b, of_c}};
      }
  }

  std::vector<PictureSample> samples_;
  std::vector<vec3> in_picture_;
};

template <class T>
T interpolated(const std::vector<T>& values, const Mesh& mesh, const PictureSample& sample) {
  const std::uint32_t* corner = mesh.indices.data() + 3 * std::size_t(sample.triangle);
  return (1.0f - sample.weights.x - sample.weights.y) * values[corner[0]] +
         sample.weights.x * values[corner[1]] + sample.weights.y * values[corner[2]];
}

std::uint8_t byte_of(float value) { return std::uint8_t(std::clamp(255.0f * value + 0.5f, 0.0f, 255.0f)); }

/// A picture within an image: its first pixel, its size, and which pixels something covers.
struct PictureCell {
  ivec2 first{0}, size{0};
  std::vector<std::uint8_t> is_covered;

  std::uint8_t& covered(int x, int y) { return is_covered[std::size_t(y * size.x + x)]; }
};

/// Colours of pixels that nothing covers are those of the covered pixels beside them, for filters that mix
/// both; farther away the mean of the picture.
void spread(Image8& image, PictureCell cell) {
  constexpr int rounds = 1;
  glm::ivec3 sum(0);
  int count = 0;
  const auto rgb_at = [&](int x, int y) {
    const std::uint8_t* rgb = image.at(cell.first.x + x, cell.first.y + y);
    return glm::ivec3(rgb[0], rgb[1], rgb[2]);
  };
  for (int y = 0; y < cell.size.y; ++y)
    for (int x = 0; x < cell.size.x; ++x)
      if (cell.covered(x, y) != 0) sum += rgb_at(x, y), ++count;
  const glm::ivec3 mean = sum / std::max(count, 1);
  for (int round = 0; round <= rounds; ++round) {
    PictureCell before = cell;
    for (int y = 0; y < cell.size.y; ++y)
      for (int x = 0; x < cell.size.x; ++x) {
        if (before.covered(x, y) != 0) continue;
        glm::ivec3 beside(0);
        int neighbours = 0;
        for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, cell.size.y - 1); ++ny)
          for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, cell.size.x - 1); ++nx)
            if (before.covered(nx, ny) != 0) beside += rgb_at(nx, ny), ++neighbours;
        if (neighbours == 0 && round < rounds) continue;
        const glm::ivec3 colour = neighbours > 0 ? beside / neighbours : mean;
        for (int i = 0; i < 3; ++i) image.at(cell.first.x + x, cell.first.y + y)[i] = std::uint8_t(colour[i]);
        cell.covered(x, y) = 1;
      }
  }
}

/// Writes one sampled picture: normals and coverage. Returns the pixels that are covered, as
/// PersonPictures::covered has them.
glm::ivec4 write_shape(const SampledPicture& picture, const Mesh& mesh, vec3 to_viewer, ivec2 first,
                       Image8& shapes) {
  PictureCell cell{first, {picture_width_px, picture_height_px}, {}};
  cell.is_covered.resize(std::size_t(picture_width_px * picture_height_px));
  glm::ivec4 covered(picture_width_px, picture_height_px, 0, 0);
  for (int y = 0; y < picture_height_px; ++y)
    for (int x = 0; x < picture_width_px; ++x) {
      vec3 normal(0.0f);
      int count = 0;
      for (int s = 0; s < samples_per_side * samples_per_side; ++s) {
        const PictureSample& sample = picture.at(samples_per_side * x + s % samples_per_side,
                                                 samples_per_side * y + s / samples_per_side);
        if (!sample.is_hit()) continue;
        const vec3 n = interpolated(mesh.normals, mesh, sample);
        normal += glm::dot(n, to_viewer) < 0.0f ? -n : n, ++count;
      }
      if (count == 0) continue;
      cell.covered(x, y) = 1;
      covered = {std::min(covered.x, x), std::min(covered.y, y), std::max(covered.z, x + 1),
                 std::max(covered.w, y + 1)};
      normal = glm::length(normal) > 1e-4f ? glm::normalize(normal) : to_viewer;
      std::uint8_t* shape = shapes.at(first.x + x, first.y + y);
      for (int i = 0; i < 3; ++i) shape[i] = byte_of(0.5f + 0.5f * normal[i]);
      shape[3] = byte_of(float(count) / float(samples_per_side * samples_per_side));
    }
  spread(shapes, std::move(cell));
  return covered;
}

/// Writes the colours of one sampled picture in one paint.
void write_colours(const SampledPicture& picture, const Mesh& mesh, const std::vector<glm::vec4>& paint,
                   ivec2 first, Image8& colours) {
  constexpr int samples = samples_per_side * pixels_per_colour;
  PictureCell cell{first / pixels_per_colour,
                   {picture_width_px / pixels_per_colour, picture_height_px / pixels_per_colour},
                   {}};
  cell.is_covered.resize(std::size_t(cell.size.x * cell.size.y));
  for (int y = 0; y < cell.size.y; ++y)
    for (int x = 0; x < cell.size.x; ++x) {
      vec3 colour(0.0f);
      int count = 0;
      for (int s = 0; s < samples * samples; ++s) {
        const PictureSample& sample = picture.at(samples * x + s % samples, samples * y + s / samples);
        if (sample.is_hit()) colour += vec3(interpolated(paint, mesh, sample)), ++count;
      }
      if (count == 0) continue;
      cell.covered(x, y) = 1;
      colour = srgb_from_linear(glm::clamp(colour / float(count), vec3(0.0f), vec3(1.0f)));
      for (int i = 0; i < 3; ++i) colours.at(cell.first.x + x, cell.first.y + y)[i] = byte_of(colour[i]);
    }
  spread(colours, std::move(cell));
}

}  // namespace

glm::vec3 picture_view(int direction) { return frame_of(direction).to_viewer; }

int nearest_picture(glm::vec3 to_viewer) {
  const float elevation_deg = glm::degrees(std::atan2(to_viewer.z, glm::length(vec2(to_viewer))));
  const bool is_high =
      elevation_deg > 0.5f * (picture_rings[0].elevation_deg + picture_rings[1].elevation_deg);
  const PictureRing& ring = picture_rings[is_high ? 1 : 0];
  const float turns = std::atan2(to_viewer.y, to_viewer.x) / (2.0f * pi);
  const int azimuth = int(std::lround(turns * float(ring.azimuths))),
            wrapped = (azimuth + ring.azimuths) % ring.azimuths;
  return is_high ? picture_rings[0].azimuths + wrapped : wrapped;
}

Posture pictured_posture(const BodyField& body, int posture) {
  if (posture >= walking_pictures)
    return on_the_spot(body, rest_pictures[std::size_t(posture - walking_pictures)], 0.0f, 0.0f);
  const Stride stride = stride_of(body.shape(), pictured_speed_m_s);
  return walking(body, stride, straight_feet(body, stride, float(posture) / float(walking_pictures)));
}

int picture_of(std::optional<float> phase, Activity at_rest) {
  if (phase) return int(std::lround(*phase * float(walking_pictures))) % walking_pictures;
  const auto found = std::ranges::find(rest_pictures, at_rest);
  return walking_pictures + (found == rest_pictures.end() ? 0 : int(found - rest_pictures.begin()));
}

PersonPictures make_pictures(const PersonLevels& levels, const Someone& who,
                             std::span<const Colours> colours) {
  const scene::Model& model = *levels.models[std::size_t(Detail::far)];
  const scene::Part& part = model.parts.front();
  PersonPictures result;
  result.stature_m = levels.body.shape().stature;
  const int width = picture_directions * picture_width_px, height = picture_postures * picture_height_px;
  result.shapes = Image8(width, height, 4, 0);
  result.colours.assign(colours.size(),
                        Image8(width / pixels_per_colour, height / pixels_per_colour, 4, 255));
  std::vector<std::vector<glm::vec4>> paints;
  for (const Colours& paint : colours)
    paints.push_back(painted_vertices(levels.covers[std::size_t(Detail::far)], who, paint));
  Mesh mesh = part.mesh;
  SampledPicture picture;
  for (int posture = 0; posture < picture_postures; ++posture) {
    scene::deform(*part.deformation, {},
                  pose_of(levels.body.skeleton(), pictured_posture(levels.body, posture)), part.node, mesh);
    for (int direction = 0; direction < picture_directions; ++direction) {
      const PictureFrame frame = frame_of(direction);
      picture.clear();
      picture.draw(mesh, frame, result.stature_m);
      const ivec2 first(direction * picture_width_px, posture * picture_height_px);
      result.covered.push_back(write_shape(picture, mesh, frame.to_viewer, first, result.shapes));
      for (std::size_t c = 0; c < paints.size(); ++c)
        write_colours(picture, mesh, paints[c], first, result.colours[c]);
    }
  }
  return result;
}

}  // namespace parvis::people
