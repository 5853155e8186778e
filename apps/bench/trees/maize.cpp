// A real plant on a turntable.
#include <array>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/image_io.h"
#include "base/json_guard.h"
#include "base/test_data.h"
#include "bench/parts.h"
#include "bench/trees/reconstructed_tree.h"

namespace parvis::bench {
namespace {

constexpr int picture_factor = 4;        // 514 x 613 pixels
constexpr std::size_t photographs = 12;  // from the side
constexpr std::size_t apart = 5;         // photographs between the two that are left out
constexpr float metres_per_millimetre = 1e-3f;

/// A photograph with its matte as alpha, reduced.
Image8 matted(const std::filesystem::path& photograph, const std::filesystem::path& matte) {
  const Image8 colour = must(read_image8(photograph)), alpha = must(read_image8(matte));
  if (colour.width != alpha.width || colour.height != alpha.height)
    fail("{}: {} x {} pixels, but its photograph has {} x {}", matte.string(), alpha.width, alpha.height,
         colour.width, colour.height);
  Image8 result(colour.width / picture_factor, colour.height / picture_factor, 4);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      std::array<int, 4> sums{};
      for (int k = 0; k < picture_factor * picture_factor; ++k) {
        const int from_x = picture_factor * x + k % picture_factor,
                  from_y = picture_factor * y + k / picture_factor;
        for (int c = 0; c < 3; ++c) sums[std::size_t(c)] += colour.at(from_x, from_y)[c];
        sums[3] += alpha.at(from_x, from_y)[0];
      }
      for (std::size_t c = 0; c < 4; ++c)
        result.at(x, y)[c] = std::uint8_t(sums[c] / (picture_factor * picture_factor));
    }
  return result;
}

/// A camera of cameras.json: x_camera = R x + t in millimetres, y down and z forward.
Pinhole camera_of(const nlohmann::json& entry, const Image8& picture) {
  const auto number = [](const nlohmann::json& value) { return value.get<float>(); };
  Pinhole camera;
  camera.width = picture.width, camera.height = picture.height;
  camera.focal = glm::vec2(number(entry.at("fx")), number(entry.at("fy"))) / float(picture_factor);
  camera.principal_point = glm::vec2(number(entry.at("cx")), number(entry.at("cy"))) / float(picture_factor);
  glm::vec3 rows[3], offset;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) rows[i][k] = number(entry.at("R").at(std::size_t(i)).at(std::size_t(k)));
    offset[i] = metres_per_millimetre * number(entry.at("t").at(std::size_t(i)));
  }
  camera.world_from_camera = glm::mat3(rows[0], -rows[1], -rows[2]);
  camera.position_in_world = -(rows[0] * offset.x + rows[1] * offset.y + rows[2] * offset.z);
  return camera;
}

std::vector<TreeView> maize_views(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "cameras.json";
  const std::string text = must(read_file(file));
  must(check_json_depth(text, file.string()));
  std::vector<TreeView> views;
  try {
    for (const nlohmann::json& entry : nlohmann::json::parse(text)) {
      const std::string name = entry.at("name");
      if (!name.starts_with("side")) continue;
      Image8 picture = matted(folder / entry.at("image").get<std::string>(),
                              folder / entry.at("matte").get<std::string>());
      const Pinhole camera = camera_of(entry, picture);
      views.push_back({name, camera, std::move(picture)});
    }
  } catch (const nlohmann::json::exception& problem) {
    fail("{}: {}", file.string(), json_reason(problem.what()));
  }
  if (views.size() != photographs)
    fail("{}: {} photographs from the side, {} were expected", file.string(), views.size(), photographs);
  return views;
}

}  // namespace

void measure_maize(const BenchSetup& setup, Report& report) {
  const std::string key = "maize_silhouette_iou";
  const auto folder = shared_data("plant_maize", std::filesystem::current_path());
  if (!folder) {
    report.skip(key, "the photographs ../shared/data/plant_maize are not here");
    return;
  }
  const std::vector<TreeView> views = maize_views(*folder);
  const BenchCaptureSize size;
  ViewErrors mean, mean_of_wrong;
  const std::size_t folds = setup.is_quick ? 1 : photographs / 2;
  for (std::size_t fold = 0; fold < folds; ++fold) {
    SampleCapture capture;
    std::vector<TreeView> wrong;
    for (std::size_t i = 0; i < photographs; ++i) {
      const TreeView& view = views[i];
      const std::size_t first = 2 * fold, second = (2 * fold + apart) % photographs;
      if (i != first && i != second) {
        capture.views.push_back(view);
        continue;
      }
      capture.held_out.push_back(view);
      wrong.push_back({view.name, views[(i + 1) % photographs].camera, view.picture});
    }
    const ReconstructedTree made = reconstructed_tree(capture, size);
    for (const std::string& row : made.notes)
      if (row.find("left out") != std::string::npos) report.note(row);  // its leaves move
    const ViewErrors errors = errors_of(made.levels, capture.held_out);
    const ViewErrors errors_of_wrong = errors_of(made.levels, wrong);
    report.note(fmt::format("maize without {} and {}: silhouette IoU {:.3f}", capture.held_out[0].name,
                            capture.held_out[1].name, errors.silhouette_iou));
    mean += errors, mean_of_wrong += errors_of_wrong;
  }
  mean /= double(folds), mean_of_wrong /= double(folds);
  report.add(key, mean.silhouette_iou);
  report.add(key + "_next_camera", mean_of_wrong.silhouette_iou);
}

}  // namespace parvis::bench
