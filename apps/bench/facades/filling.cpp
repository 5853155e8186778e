// Filling of a texture that is known.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "base/image.h"
#include "base/image_io.h"
#include "base/result.h"
#include "bench/parts.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/layer_model.h"
#include "capture/facades/place_layers.h"
#include "capture/photographs/photograph.h"
#include "graphics/reference/tracer.h"
#include "graphics/shading/tone_curve.h"
#include "places/paper_city/city_buildings.h"
#include "places/paper_city/paper_city.h"
#include "places/paper_city/paper_script.h"
#include "synthesis/sky_picture.h"

namespace parvis::bench {
namespace {

/// One house, photographed along the street.
struct PhotographedHouse {
  std::vector<photographs::Photograph> photographs;  ///< in the folder given; with the board
  std::vector<Image8> truths;                        ///< the same views without the board: 8-bit sRGB
  std::vector<facades::NamedMesh>
      meshes;  ///< its street front, `hidden_surface`, as one rectangle; the board
};
inline constexpr const char* hidden_surface = "front";

constexpr std::uint64_t seed = 1;
constexpr int width = 480, height = 360;
constexpr float camera_distance_m = 10.0f, camera_step_m = 2.0f, field_of_view = 0.9f;  // vertical
constexpr float board_distance_m = 3.0f, board_width_m = 2.4f, board_height_m = 2.6f;
constexpr int cameras_each_way = 2;

/// Metres along a house's front, from it toward the street, and up.
struct StreetFront {
  city::Frame frame;
  float width_m = 0.0f, low_m = 0.0f, high_m = 0.0f;

  glm::vec3 point(float along, float toward, float up) const { return frame.point(along, -toward, up); }
  glm::vec3 middle(float along_more, float toward) const {
    return point(0.5f * width_m + along_more, toward, 0.5f * (low_m + high_m));
  }
};

facades::NamedMesh rectangle(const std::string& name, glm::vec3 corner, glm::vec3 along, glm::vec3 up) {
  facades::NamedMesh named{name, {}};
  named.mesh.positions = {corner, corner + along, corner + along + up, corner + up};
  named.mesh.indices = {0, 1, 2, 0, 2, 3};
  named.mesh.normals.assign(4, glm::normalize(glm::cross(along, up)));
  named.mesh.uvs.assign(4, glm::vec2(0.0f));
  return named;
}

facades::NamedMesh front_of(const StreetFront& front) {
  return rectangle(hidden_surface, front.point(0, 0, front.low_m), front.width_m * front.frame.along,
                   {0, 0, front.high_m - front.low_m});
}
facades::NamedMesh board_before(const StreetFront& front) {
  const glm::vec3 middle = front.middle(0.0f, board_distance_m);
  return rectangle("board",
                   middle - 0.5f * board_width_m * front.frame.along - glm::vec3(0, 0, 0.5f * board_height_m),
                   board_width_m * front.frame.along, {0, 0, board_height_m});
}

/// A board of a plain colour; it casts no shadow, so that the truth is the picture without it.
scene::Object board_object(const facades::NamedMesh& board) {
  auto model = std::make_shared<scene::Model>();
  scene::Material material;
  material.base_colour = glm::vec3(0.5f, 0.1f, 0.05f), material.is_double_sided = true;
  model->materials.push_back(material);
  scene::Part part;
  part.mesh = board.mesh, part.casts_shadow = false;
  model->parts.push_back(std::move(part));
  scene::Object object;
  object.name = board.name, object.model = model;
  return object;
}

scene::Scene city_scene() {
  scene::Scene scene;
  scene::Object object;
  object.name = "city", object.model = std::make_shared<scene::Model>(city::make_city_model(seed));
  scene.objects.push_back(std::move(object));
  scene.sun.direction_to_sun = city::to_sun();
  scene.sky.picture = shading::without_sun(synthesis::sky_picture(256, city::to_sun(), seed));
  return scene;
}

Camera camera_before(const StreetFront& front, int step) {
  Camera camera;
  const glm::vec3 eye = front.middle(camera_step_m * float(step), camera_distance_m);
  camera.world_from_camera = look_at(eye, front.middle(0.0f, 0.0f));
  camera.vertical_fov = field_of_view;
  return camera;
}

Image8 traced(const scene::Scene& scene, const Camera& camera) {
  const reference::RayScene rays(scene);
  reference::TraceOptions options;
  options.samples_per_pixel = 4;
  const shading::SkyLight sky = shading::make_sky_light(scene.sky.picture, 1.0f, 0.0f);
  return shading::tone_mapped_picture(
      reference::trace_picture(rays, scene, sky, camera, width, height, options).radiance, scene.exposure);
}

PhotographedHouse photographed(const StreetFront& front, const std::filesystem::path& folder,
                               const std::string& name, scene::Scene& city) {
  PhotographedHouse house;
  house.meshes = {front_of(front), board_before(front)};
  for (int step = -cameras_each_way; step <= cameras_each_way; ++step) {
    const Camera camera = camera_before(front, step);
    house.truths.push_back(traced(city, camera));
    city.objects.push_back(board_object(house.meshes.back()));
    const Image8 picture = traced(city, camera);
    city.objects.pop_back();
    photographs::Photograph photo = photographs::photograph_of(
        camera, fmt::format("{}_{}.png", name, house.photographs.size()), width, height);
    photo.file = folder / photo.name;
    must(write_image(photo.file, picture));
    house.photographs.push_back(std::move(photo));
  }
  return house;
}

/// Traces `count` houses of the city that stand in a row and have one street front, five photographs each,
/// into `folder`. The city's own relief (bays, cornices) is not in the meshes.
std::vector<PhotographedHouse> photographed_houses(std::size_t count, const std::filesystem::path& folder) {
  scene::Scene city = city_scene();
  const city::StreetPlan plan = city::make_street_plan(seed);
  std::vector<PhotographedHouse> houses;
  for (const city::Building& building : city::plan_buildings(plan, seed)) {
    if (houses.size() == count) break;
    if (building.faces.size() != 1 || !building.plot.has_left_neighbour) continue;
    const city::Face& face = building.faces[0];
    const StreetFront front{face.frame, face.width_m, building.ground_m, building.eaves_m()};
    PhotographedHouse house = photographed(front, folder, fmt::format("house_{}", houses.size()), city);
    houses.push_back(std::move(house));
  }
  if (houses.size() < count) fail("the city has only {} houses of one street front", houses.size());
  return houses;
}

namespace fs = std::filesystem;
using facades::FillSource;
using facades::PlaceLayers;

/// Squared differences from the truth over hidden pixels.
struct HiddenError {
  double squared = 0.0, values = 0.0;
  void add(const std::uint8_t* filled, const std::uint8_t* truth) {
    for (int c = 0; c < 3; ++c) squared += std::pow(double(filled[c]) - double(truth[c]), 2), ++values;
  }
  double psnr_db() const { return 10.0 * std::log10(255.0 * 255.0 * values / std::max(squared, 1e-9)); }
};

/// The same pixels, filled by different means.
struct HiddenErrors {
  HiddenError filled;         ///< by all steps, with the other photographs
  HiddenError alone;          ///< by all steps, without them
  HiddenError plain;          ///< by plain inpainting
  HiddenError unfilled;       ///< the photograph's own: the board. Filling that does nothing
  HiddenError of_wrong_view;  ///< filled by all steps, the truth being the next photograph's
  double from_photographs = 0.0;
};

/// Calls `visit(layer, x, y)`, with the place in the layer's box, for pixels of the front that the board
/// hides from photograph `i`. (Panes that reflect are filled as well, but were never hidden.)
template <class Visit>
void for_each_hidden(const PlaceLayers& place, std::size_t i, Visit&& visit) {
  const facades::LayeredView& layered = place.layered[i];
  const facades::ItemBuffer seen = facades::item_buffer(place.model, place.views[i]);
  const auto object_at = [&](int x, int y) {
    const std::uint32_t triangle = seen.triangles[seen.index(x, y)];
    return triangle == facades::no_triangle_seen
               ? std::string()
               : place.model.objects[place.model.triangles[triangle].object].name;
  };
  for (std::size_t l = 0; l < layered.layers.size(); ++l) {
    const bool is_front = std::ranges::any_of(layered.layers[l].items, [&](std::uint32_t item) {
      return place.model.objects[place.visibility[i].items[item].object].name == hidden_surface;
    });
    const Image8& mask = layered.masks[l];
    for (int y = 0; is_front && y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x)
        if (mask.at(x, y)[0] &&
            object_at(x + layered.layers[l].box.x, y + layered.layers[l].box.y) == "board")
          visit(l, x, y);
  }
}

void add_house(const PhotographedHouse& house, HiddenErrors& errors) {
  const PlaceLayers filled = must(facades::place_layers(house.photographs, house.meshes)),
                    plain = must(facades::place_layers(house.photographs, house.meshes, {true, true, false}));
  for (std::size_t i = 0; i < house.photographs.size(); ++i) {
    const PlaceLayers alone = must(facades::place_layers({house.photographs[i]}, house.meshes));
    const Image8 &truth = house.truths[i], &wrong = house.truths[(i + 1) % house.truths.size()];
    for_each_hidden(filled, i, [&](std::size_t l, int x, int y) {
      const facades::PixelBox& box = filled.layered[i].layers[l].box;
      const std::uint8_t* right = truth.at(x + box.x, y + box.y);
      const std::uint8_t* found = filled.filled[i].pixels[l].at(x, y);
      errors.filled.add(found, right), errors.of_wrong_view.add(found, wrong.at(x + box.x, y + box.y));
      errors.plain.add(plain.filled[i].pixels[l].at(x, y), right);
      errors.alone.add(alone.filled[0].pixels[l].at(x, y), right);
      errors.unfilled.add(filled.originals[i][l].at(x, y), right);
      errors.from_photographs +=
          *filled.filled[i].sources[l].at(x, y) == std::uint8_t(FillSource::photographs);
    });
  }
}

}  // namespace

void measure_filling(const BenchSetup& setup, Report& report) {
  const auto houses = photographed_houses(setup.is_quick ? 2 : 6, setup.folder);
  HiddenErrors errors;
  for (const PhotographedHouse& house : houses) add_house(house, errors);
  const double plain = errors.plain.psnr_db(), pixels = errors.filled.values / 3.0;
  report.note(fmt::format("{:.0f} hidden pixels of {} photographs, {:.1f} % of them filled from others",
                          pixels, 5 * houses.size(),
                          100.0 * errors.from_photographs / std::max(pixels, 1.0)));
  report.add("fill_psnr_hidden_db", errors.filled.psnr_db(), minimum(plain + 3.0),
             {{"fill_psnr_hidden_db_control_unfilled", errors.unfilled.psnr_db()},
              {"fill_psnr_hidden_db_control_wrong_truth", errors.of_wrong_view.psnr_db()}});
  report.add("fill_psnr_hidden_db_one_photograph", errors.alone.psnr_db());
  report.add("fill_psnr_hidden_db_plain_inpainting", plain);
}

}  // namespace parvis::bench
