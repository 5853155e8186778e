// Pictures of an IFC file's surface styles, and where they lie on bodies. A part of the module
// ifcplusplus.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class BuildingModel;
class IfcSurfaceTexture;
class IfcTextureCoordinate;

namespace parvis::scene {

/// A picture of a surface style.
struct IfcPicture {
  std::string name;     ///< of the file that holds it, or "#12" of one that the IFC file itself holds
  std::string bytes{};  ///< of a picture in the IFC file; empty: it is a file beside it
  bool repeats = true;
};

/// The pictures of a file that surface styles name (IfcSurfaceStyleWithTextures).
class IfcTextures {
 public:
  /// `warn` takes what is left out, by its number in the file; both must outlive this.
  IfcTextures(BuildingModel& building, std::function<void(const std::string&)> warn);

  /// Index of the picture of the entity with this number, a surface style or what names one; none: it has no
  /// picture that can be shown.
  std::optional<std::size_t> picture_of_style(int number);
  /// Texture coordinates of a triangle in the frame of its representation, metres: those that the file gives,
  /// else its extent in metres along the surface; u to the right, v down.
  std::array<glm::vec2, 3> coordinates(std::size_t picture, const std::array<glm::dvec3, 3>& corners);
  /// All pictures that were found so far.
  const std::vector<IfcPicture>& pictures() const { return pictures_; }

 private:
  using Place = std::array<std::int64_t, 3>;
  /// Texture coordinates of a face by its corners: triangles that it is cut into have some of these.
  using Polygon = std::map<Place, glm::dvec2>;
  /// How a picture lies on what it covers.
  struct Mapping {
    glm::dmat3 transform{1.0};  ///< IfcSurfaceTexture.TextureTransform
    std::vector<Polygon> polygons;
    std::map<Place, std::vector<std::uint32_t>> polygons_at;  ///< by each of their corners
  };

  std::optional<std::size_t> add(const std::shared_ptr<IfcSurfaceTexture>& texture);
  void read_coordinates(const IfcTextureCoordinate& coordinates, Mapping& mapping);
  static const Polygon* polygon_with(const std::array<Place, 3>& corners, const Mapping& mapping);

  BuildingModel& building_;
  std::function<void(const std::string&)> warn_;
  double metres_ = 1.0;  ///< of the file's unit
  std::map<int, std::optional<std::size_t>> picture_of_style_, picture_of_texture_;
  std::vector<IfcPicture> pictures_;
  std::vector<Mapping> mappings_;  ///< of each picture
};

}  // namespace parvis::scene
