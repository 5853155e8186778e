#include "formats/readers/bench/places_bench.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <osmium/io/pbf_output.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/writer.hpp>
#include <osmium/io/xml_input.hpp>

#include "base/files.h"
#include "base/random.h"
#include "base/test_data.h"
#include "bench/scratch_folder.h"
#include "formats/city_models/osm_file.h"
#include "formats/terrain/ground_heights.h"
#include "graphics/reference/camera_ray.h"
#include "house/stage/stage.h"
#include "places/dressing/bare_file.h"
#include "scene/data/surroundings.h"
#include "scene/roads/paving.h"
#include "scene/roads/road_builder.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

constexpr int views = 50;  // of each place

/// A town of `side` times `side` houses with streets between them.
std::string town_xml(int side) {
  std::string text = "<osm version=\"0.6\">\n", ways;
  int id = 0;
  const auto node = [&](double x, double y) {
    text += fmt::format("<node id=\"{}\" version=\"1\" lat=\"{:.7f}\" lon=\"{:.7f}\"/>\n", ++id,
                        48.0 + y / 111200.0, 11.0 + x / 74600.0);
    return id;
  };
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const double x = 24.0 * column, y = 40.0 * row;
      const int a = node(x, y), b = node(x + 14, y), c = node(x + 14, y + 11), d = node(x, y + 11);
      ways += fmt::format(
          "<way id=\"{}\" version=\"1\"><nd ref=\"{}\"/><nd ref=\"{}\"/><nd ref=\"{}\"/><nd ref=\"{}\"/><nd "
          "ref=\"{}\"/>"
          "<tag k=\"building\" v=\"house\"/><tag k=\"building:levels\" v=\"{}\"/>"
          "<tag k=\"roof:shape\" v=\"gabled\"/></way>\n",
          ++id, a, b, c, d, a, 1 + (row + column) % 3);
    }
  for (int row = 0; row <= side; row += 2) {
    const int from = node(-20.0, 40.0 * row - 9.0), to = node(24.0 * side, 40.0 * row - 9.0);
    ways += fmt::format(
        "<way id=\"{}\" version=\"1\"><nd ref=\"{}\"/><nd ref=\"{}\"/>"
        "<tag k=\"highway\" v=\"residential\"/></way>\n",
        ++id, from, to);
  }
  return text + ways + "</osm>\n";
}

Status write_pbf(const fs::path& xml, const fs::path& pbf) {
  try {
    osmium::io::Reader reader(osmium::io::File(xml.string()));
    osmium::io::Writer writer(osmium::io::File(pbf.string()), reader.header(), osmium::io::overwrite::allow);
    while (osmium::memory::Buffer buffer = reader.read()) writer(std::move(buffer));
    writer.close();
    return Done{};
  } catch (const std::exception& problem) {
    return error("{}: {}", pbf.string(), problem.what());
  }
}

Status measure_pbf(const BenchSetup& setup, const fs::path& folder, Report& report) {
  const fs::path xml = folder / "big.osm", pbf = folder / "big.osm.pbf";
  if (Status status = write_file(xml, town_xml(setup.is_quick ? 120 : 250)); !status) return status;
  if (Status status = write_pbf(xml, pbf); !status) return status;
  std::vector<double> mb_s;
  for (int i = 0; i < (setup.is_quick ? 3 : 7); ++i) {
    Status read = Done{};
    const double ms = milliseconds([&] {
      Errors warnings;
      if (const auto osm = scene::read_osm_file(pbf, warnings); !osm) read = osm.errors();
    });
    if (!read) return read;
    mb_s.push_back(1e-3 * double(fs::file_size(pbf)) / ms);
  }
  report.add("pbf_mb_s", median(mb_s));
  return Done{};
}

/// Where somebody stands on a lane of the place, or near its first view where it has none.
glm::vec3 eye_on_street(const scene::Scene& scene, const Camera& first, Random& random) {
  constexpr float eye_m = 1.7f;
  const std::vector<scene::Lane>& lanes = scene.roads.lanes;
  if (lanes.empty())
    return first.position_in_world() +
           glm::vec3(random.uniform(-3.0f, 3.0f), random.uniform(-3.0f, 3.0f), 0.0f);
  const scene::Lane& lane = lanes[std::size_t(random.index(int(lanes.size())))];
  const auto at = std::size_t(random.index(int(lane.points.size())));
  return lane.points[at] + glm::vec3(0.0f, 0.0f, eye_m);
}

/// Pixels of the lower halves of street views that show no ground within a camera's far plane, per cent.
double gap_percent(const scene::Scene& scene, const scene::NamedCamera& street) {
  constexpr int width = 64, height = 36;
  const reference::RayScene rays(scene);
  const Camera& first = street.camera;
  Random random(15);
  std::size_t open = 0, all = 0;
  for (int view = 0; view < views; ++view) {
    const glm::vec3 eye = view == 0 ? first.position_in_world() : eye_on_street(scene, first, random);
    const float heading = 2.0f * 3.14159265f * float(view) / float(views);
    Camera camera = first;
    camera.world_from_camera = look_at(eye, eye + glm::vec3(std::sin(heading), std::cos(heading), 0.0f));
    for (int y = height / 2; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        reference::Ray ray = reference::camera_ray(camera, width, height, glm::vec2(x, y) + 0.5f);
        ray.max_m = camera.far_m;
        open += !rays.nearest_hit(ray), ++all;
      }
  }
  return 100.0 * double(open) / double(all);
}

scene::Scene without_plane(scene::Scene scene) {
  std::erase_if(scene.objects, [&](const scene::Object& object) {
    return object.name == "terrain" || scene::surrounds_place(scene, object);
  });
  return scene;
}

/// Static triangles but trees, and those of buildings.
struct Counts {
  double all = 0.0, buildings = 0.0;
};

Counts counts_of(const scene::Scene& scene) {
  Counts counts;
  for (const scene::Object& object : scene.objects)
    for (const scene::Part& part : object.model->parts) {
      const double triangles = double(part.mesh.triangle_count());
      const std::string& material = object.model->materials[std::size_t(part.material)].name;
      const bool is_tree = part.object == "trees" || material == "leaves" || material == "bark" ||
                           part.object == "SolitaryVegetationObject";
      const bool is_building =
          part.object == "facade" || part.object == "WallSurface" || part.object == "RoofSurface";
      if (!is_tree) counts.all += triangles;
      if (is_building) counts.buildings += triangles;
    }
  return counts;
}

struct Totals {
  std::map<std::string, double> minutes_of;  ///< by kind of file
  double minutes = 0.0, warnings = 0.0, gap = 0.0, gap_without = 100.0, osm_ratio = 0.0;
};

/// Kind of a model file: "cityjson", "citygml", "osm", "ifc".
std::string kind_of(const fs::path& file) {
  if (file.extension() == ".json") return "cityjson";
  if (file.extension() == ".gml") return "citygml";
  return file.extension().string().substr(1);
}

/// A warning is explained if it says where and what to do: those of the file's own defects name an object.
bool is_unexplained(const Error& warning) {
  return warning.where.file.empty() || warning.message.find("nothing that matches") != std::string::npos;
}

/// Unexplained warnings of a made-up script that is wrong: it dresses what the file does not have. A control.
Result<double> unexplained_of_wrong_script(const House& house, const fs::path& folder, const fs::path& town) {
  const fs::path script = folder / "wrong.xp";
  const Status written = write_file(
      script, fmt::format("model(name=\"place\", file=\"{}\") {{ facades(target=\"TINRelief\") }}\n"
                          "camera(name=\"street\", position=\"0 0 2\", target=\"9 0 2\")\n",
                          town.filename().string()));
  if (!written) return written.errors();
  const Result<scene::LoadedScene> loaded = scene::load_scene(script, house.get<scene::NodeRegistry>(), {});
  if (!loaded) return loaded.errors();
  return double(std::ranges::count_if(loaded->warnings, is_unexplained));
}

Status measure_place(const House& house, const fs::path& file, const fs::path& folder, Totals& totals) {
  Status done = Done{};
  std::optional<dressing::WrittenScene> written;
  const double ms = milliseconds([&] {
    Result<dressing::WrittenScene> script =
        dressing::write_bare_scene(file, house.get<formats::Readers>(), folder);
    if (!script) return void(done = script.errors());
    written = *script;
    Result<house::Play> play = house::open_play(house, script->script, {&written->data_folder, 1});
    if (!play) return void(done = play.errors());
    Result<std::unique_ptr<house::Stage>> stage = house::Stage::create(*std::move(play));
    if (!stage) return void(done = stage.errors());
    const Result<Camera> camera = (*stage)->camera("street");
    if (!camera) return void(done = camera.errors());
    (*stage)->draw(*camera, 1280, 720);
    (void)(*stage)->picture();
  });
  if (!done) return done;
  totals.minutes = std::max(totals.minutes, ms / 60'000.0);
  double& of_kind = totals.minutes_of[kind_of(file)];
  of_kind = std::max(of_kind, ms / 60'000.0);
  const Result<scene::LoadedScene> loaded =
      scene::load_scene(written->script, house.get<scene::NodeRegistry>(), {&written->data_folder, 1});
  if (!loaded) return loaded.errors();
  for (const Error& warning : loaded->warnings) totals.warnings += is_unexplained(warning);
  const scene::NamedCamera* street = loaded->scene.find_camera("street");
  totals.gap = std::max(totals.gap, gap_percent(loaded->scene, *street));
  totals.gap_without = std::min(totals.gap_without, gap_percent(without_plane(loaded->scene), *street));
  if (file.extension() == ".osm") {
    const Counts counts = counts_of(loaded->scene);
    totals.osm_ratio = std::max(totals.osm_ratio, counts.all / std::max(counts.buildings, 1.0));
  }
  return Done{};
}

/// Time to read an IFC file, in a child process as always.
Status measure_ifc(const BenchSetup& setup, const fs::path& file, Report& report) {
  const formats::Readers& readers = setup.house.get<formats::Readers>();
  std::vector<double> ms;
  for (int i = 0; i < (setup.is_quick ? 3 : 9); ++i) {
    Status read = Done{};
    ms.push_back(milliseconds([&] {
      Errors warnings;
      if (const auto model = readers.read(file, {}, warnings); !model) read = model.errors();
    }));
    if (!read) return read;
  }
  report.add("ifc_load_ms", median(ms));
  return Done{};
}

/// A street over a hill with things on it that are no ground, or with a slab on it that is.
scene::Scene street_with_things(bool has_slab, bool has_things) {
  scene::Scene scene;
  const auto add = [&](const Mesh& mesh, const scene::Material& material, const char* name) {
    auto model = std::make_shared<scene::Model>();
    model->materials.push_back(material);
    model->parts.emplace_back();
    model->parts.back().mesh = mesh, model->parts.back().object = name;
    scene.objects.emplace_back().model = model;
  };
  const auto ground_m = [](float x, float y) { return 0.03f * x + 1.5f * std::sin(0.02f * x) + 0.02f * y; };
  const auto sheet = [&](glm::vec2 low, glm::vec2 high, float step_m, float lift_m) {
    Mesh mesh;
    const glm::ivec2 cells(glm::max(glm::round((high - low) / step_m), glm::vec2(1.0f)));
    for (int y = 0; y <= cells.y; ++y)
      for (int x = 0; x <= cells.x; ++x) {
        const glm::vec2 p = low + (high - low) * glm::vec2(x, y) / glm::vec2(cells);
        mesh.positions.emplace_back(p, ground_m(p.x, p.y) + lift_m);
      }
    const std::uint32_t row = std::uint32_t(cells.x) + 1;
    for (std::uint32_t y = 0; y < std::uint32_t(cells.y); ++y)
      for (std::uint32_t x = 0; x + 1 < row; ++x) {
        const std::uint32_t a = y * row + x;
        mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
      }
    return mesh;
  };
  add(sheet({-30, -60}, {230, 60}, 5.0f, 0.0f), {}, "hill");
  scene::Material leaves;
  leaves.alpha_mode = scene::Alpha::cutout;
  if (has_things) {
    for (float x = 0.0f; x < 200.0f; x += 17.0f) add(sheet({x, 3}, {x + 8, 11}, 2.0f, 2.2f), leaves, "crown");
    for (float x = 5.0f; x < 200.0f; x += 23.0f)
      add(sheet({x, 1.5f}, {x + 4.5f, 3.3f}, 1.0f, 1.45f), {}, "van");
    for (float x = 9.0f; x < 200.0f; x += 31.0f)
      add(sheet({x, -5}, {x + 1.8f, -4.4f}, 0.6f, 0.45f), {}, "bench");
  }
  if (has_slab) add(sheet({40, -30}, {140, 30}, 5.0f, 1.0f), {}, "slab");
  scene::Road road;
  for (float x = 0.0f; x <= 200.0f; x += 20.0f) road.path.emplace_back(x, 0.0f, ground_m(x, 0.0f));
  scene.roads = *scene::build_road_graph(std::vector{road});
  scene::pave(scene);
  return scene;
}

/// 99th percentile of how far the carriageway of the second scene lies off that of the first, along the
/// lanes.
double paving_error_m(const scene::Scene& bare, const scene::Scene& judged) {
  const auto rays_down = [](const scene::Scene& scene) {
    scene::Scene paving;
    paving.objects.push_back(scene.objects.back());
    return paving;
  };
  const scene::Scene a = rays_down(bare), b = rays_down(judged);
  const reference::RayScene of_bare(a), of_judged(b);
  std::vector<double> errors;
  for (float x = 1.0f; x < 199.0f; x += 0.5f)
    for (float y = -6.0f; y <= 6.0f; y += 0.5f) {
      const reference::Ray down{{x, y, 100.0f}, {0.0f, 0.0f, -1.0f}};
      const auto first = of_bare.nearest_hit(down), second = of_judged.nearest_hit(down);
      if (first && second) errors.push_back(std::abs(double(first->distance_m - second->distance_m)));
    }
  std::ranges::sort(errors);
  return errors.empty() ? 1e3 : errors[errors.size() * 99 / 100];
}

}  // namespace

Status measure_places(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  std::error_code code;
  fs::create_directories(folder.path, code);
  std::vector<fs::path> files;
  const fs::path town = folder.path / "town.osm";
  if (Status status = write_file(town, town_xml(16)); !status) return status;
  files.push_back(town);
  for (const char* name : {"scenes/crossroads.osm", "scenes/canal.osm", "scenes/pavilion.ifc"})
    if (const fs::path map = fs::current_path() / name; fs::exists(map)) files.push_back(map);
  for (const char* name : {"cities/delft_context.city.json", "cities/citygml/lod3_building_v2.gml"})
    if (const auto file = shared_data(name, fs::current_path())) files.push_back(*file);
  Totals totals;
  for (const fs::path& file : files)
    if (Status status = measure_place(setup.house, file, folder.path, totals); !status) return status;
  report.add("minutes_to_first_street", totals.minutes);
  for (const auto& [kind, minutes] : totals.minutes_of)
    report.add("minutes_to_first_street_" + kind, minutes);
  report.add("warnings_unexplained", totals.warnings);
  const Result<double> unexplained = unexplained_of_wrong_script(setup.house, folder.path, town);
  if (!unexplained) return unexplained.errors();
  report.add("warnings_unexplained_of_a_wrong_script", *unexplained);
  report.add("osm_triangles_over_buildings", totals.osm_ratio);
  report.add("ground_gap_percent", totals.gap);
  report.add("ground_gap_percent_without_plane", totals.gap_without);
  const scene::Scene bare = street_with_things(false, false);
  report.add("paving_height_error_m", paving_error_m(bare, street_with_things(false, true)));
  report.add("paving_height_error_m_on_a_slab", paving_error_m(bare, street_with_things(true, true)));
  if (const fs::path pavilion = fs::current_path() / "scenes/pavilion.ifc"; fs::exists(pavilion)) {
    if (Status status = measure_ifc(setup, pavilion, report); !status) return status;
  } else {
    report.skip("ifc_load_ms", "scenes/pavilion.ifc is not in the working folder");
  }
  return measure_pbf(setup, folder.path, report);
}

}  // namespace parvis::bench
