#include "formats/meshes/file_frame.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "formats/readers/zip_member.h"

namespace parvis::scene {
namespace {

/// An exchange of coordinates, which is exact.
glm::dmat4 z_up_from_y_up_file() {
  glm::dmat4 frame(1.0);
  frame[1] = {0.0, 0.0, 1.0, 0.0}, frame[2] = {0.0, -1.0, 0.0, 0.0};
  return frame;
}

/// A number of the file's settings, in whichever type assimp has kept it.
std::optional<double> setting(const aiScene& scene, const char* name) {
  if (scene.mMetaData == nullptr) return std::nullopt;
  if (std::int32_t value = 0; scene.mMetaData->Get(name, value)) return double(value);
  if (double value = 0.0; scene.mMetaData->Get(name, value)) return value;
  if (float value = 0.0f; scene.mMetaData->Get(name, value)) return double(value);
  return std::nullopt;
}

/// A unit vector of an FBX file's frame: 0, 1 or 2 for x, y or z, with a sign.
std::optional<glm::dvec3> axis(const aiScene& scene, const std::string& name) {
  const std::optional<double> index = setting(scene, name.c_str()),
                              sign = setting(scene, (name + "Sign").c_str());
  if (!index || (*index != 0.0 && *index != 1.0 && *index != 2.0)) return std::nullopt;
  glm::dvec3 direction(0.0);
  direction[int(*index)] = sign.value_or(1.0) < 0.0 ? -1.0 : 1.0;
  return direction;
}

/// The matrix that lets the right side be east, the top be up and the front look south. Nothing where the
/// file names no such axes, or those of a left hand, which no mesh of FBX has.
std::optional<glm::dmat4> frame_of_fbx(const aiScene& scene) {
  const std::optional<glm::dvec3> right = axis(scene, "CoordAxis"), up = axis(scene, "UpAxis"),
                                  front = axis(scene, "FrontAxis");
  if (!right || !up || !front) return std::nullopt;
  const glm::dmat3 frame = glm::transpose(glm::dmat3(*right, -*front, *up));
  if (!(glm::determinant(frame) > 0.5)) return std::nullopt;
  return glm::dmat4(frame);
}

}  // namespace

double metres_of_3mf(std::string_view model_front) {
  constexpr std::array<std::pair<std::string_view, double>, 6> units{{{"micron", 1e-6},
                                                                      {"millimeter", 1e-3},
                                                                      {"centimeter", 1e-2},
                                                                      {"inch", 0.0254},
                                                                      {"foot", 0.3048},
                                                                      {"meter", 1.0}}};
  const std::size_t model = model_front.find("<model");
  if (model == std::string_view::npos) return 1e-3;
  const std::string_view tag = model_front.substr(model, model_front.find('>', model) - model);
  for (const auto& [name, metres] : units)
    if (tag.find(fmt::format(" unit=\"{}\"", name)) != std::string_view::npos ||
        tag.find(fmt::format(" unit='{}'", name)) != std::string_view::npos)
      return metres;
  return 1e-3;
}

glm::dmat4 model_from_file(const aiScene& scene, const std::string& extension, std::string_view bytes,
                           formats::UpAxis up, bool is_y_up, FileAccount& account) {
  constexpr std::size_t front_bytes = 4096;
  const bool is_fbx = extension == ".fbx", is_3mf = extension == ".3mf";
  glm::dmat4 frame = is_y_up ? z_up_from_y_up_file() : glm::dmat4(1.0);
  if (is_fbx && up == formats::UpAxis::file)
    if (const std::optional<glm::dmat4> own = frame_of_fbx(scene)) frame = *own;
  double metres = 1.0;
  if (is_fbx) {
    const double centimetres = setting(scene, "UnitScaleFactor").value_or(1.0);
    metres = centimetres > 0.0 && std::isfinite(centimetres) ? 0.01 * centimetres : 0.01;
  }
  if (is_3mf) metres = metres_of_3mf(formats::zip_member_front(bytes, ".model", front_bytes).value_or(""));
  if (metres == 1.0) return frame;
  account.changed("lengths", fmt::format("given in metres: the file's unit is {:g} m", metres));
  for (int column = 0; column < 3; ++column) frame[column] *= metres;
  return frame;
}

}  // namespace parvis::scene
