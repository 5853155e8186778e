#include "bench/readers/places_bench.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <osmium/io/pbf_output.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/writer.hpp>
#include <osmium/io/xml_input.hpp>

#include "base/files.h"
#include "base/random.h"
#include "base/test_data.h"
#include "bench/readers/first_picture.h"
#include "bench/readers/planted_faults.h"
#include "bench/scratch_folder.h"
#include "formats/city_models/osm_file.h"
#include "formats/terrain/place_heights.h"
#include "graphics/reference/camera_ray.h"
#include "house/stage/place_check.h"
#include "house/stage/stage.h"
#include "life/vegetation/scene_plant.h"
#include "places/dressing/bare_file.h"
#include "scene/data/triangle_kinds.h"
#include "scene/roads/paving.h"
#include "scene/roads/road_builder.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

constexpr int views = 50;  // of each place

/// Streets for a town of `side` times `side` houses, of which the map holds the first `houses`.
std::string town_xml(int side, int houses) {
  std::string text = "<osm version=\"0.6\">\n", ways;
  int id = 0;
  const auto node = [&](double x, double y) {
    text += fmt::format("<node id=\"{}\" version=\"1\" lat=\"{:.7f}\" lon=\"{:.7f}\"/>\n", ++id,
                        48.0 + y / 111200.0, 11.0 + x / 74600.0);
    return id;
  };
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side && row * side + column < houses; ++column) {
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
  const int side = setup.is_quick ? 120 : 250;
  const std::size_t houses = std::size_t(side) * std::size_t(side);
  if (Status status = write_file(xml, town_xml(side, side * side)); !status) return status;
  if (Status status = write_pbf(xml, pbf); !status) return status;
  std::vector<double> mb_s;
  for (int i = 0; i < (setup.is_quick ? 3 : 7); ++i) {
    Status read = Done{};
    const double ms = milliseconds([&] {
      Errors warnings;
      const auto osm = scene::read_osm_file(pbf, warnings);
      if (!osm) read = osm.errors();
      if (osm && (osm->ways.size() < houses || osm->nodes.size() < 4 * houses))
        read = error("{}: houses are missing", pbf.string());
    });
    if (!read) return read;
    mb_s.push_back(1e-3 * double(fs::file_size(pbf)) / ms);
  }
  report.add("pbf_mb_s", median(mb_s));
  return Done{};
}

/// Where somebody stands: on a lane of the place, or, where it has none, anywhere outside of its houses.
glm::vec3 eye_in(const scene::Scene& scene, const scene::PlaceHeights& place, Random& random) {
  constexpr float eye_m = 1.7f;
  const std::vector<scene::Lane>& lanes = scene.roads.lanes;
  if (!lanes.empty()) {
    const scene::Lane& lane = lanes[std::size_t(random.index(int(lanes.size())))];
    const auto at = std::size_t(random.index(int(lane.points.size())));
    return lane.points[at] + glm::vec3(0.0f, 0.0f, eye_m);
  }
  constexpr int max_tries = 1000;
  const scene::GroundGrid& plan = place.heights();
  glm::ivec2 cell(0);
  for (int i = 0; i < max_tries; ++i) {
    cell = {random.index(plan.width), random.index(plan.height)};
    if (!place.built().at(cell.x, cell.y)) break;
  }
  const glm::vec2 spot = plan.centre_of(cell);
  return {spot, place.at(spot) + eye_m};
}

/// Pixels of the lower halves of street views that show no ground within a camera's far plane, per cent.
/// A report notes where a few of them are.
double gap_percent(const scene::Scene& scene, const scene::NamedCamera& street, Report* report) {
  constexpr std::size_t noted = 5;
  constexpr int width = 64, height = 36;
  constexpr float margin_m = 20.0f;
  const reference::RayScene rays(scene);
  const scene::PlaceHeights place(scene, {}, margin_m);
  const Camera& first = street.camera;
  Random random(15);
  std::size_t open = 0, all = 0;
  for (int view = 0; view < views; ++view) {
    const glm::vec3 eye = view == 0 ? first.position_in_world() : eye_in(scene, place, random);
    const float heading = 2.0f * 3.14159265f * float(view) / float(views);
    Camera camera = first;
    camera.world_from_camera = look_at(eye, eye + glm::vec3(std::sin(heading), std::cos(heading), 0.0f));
    for (int y = height / 2; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        reference::Ray ray = reference::camera_ray(camera, width, height, glm::vec2(x, y) + 0.5f);
        ray.max_m = camera.far_m;
        ++all;
        if (rays.nearest_hit(ray)) continue;
        if (++open <= noted && report)
          report->note(fmt::format("  no ground from ({:.2f} {:.2f} {:.2f}) to ({:.4f} {:.4f} {:.4f})", eye.x,
                                   eye.y, eye.z, ray.direction.x, ray.direction.y, ray.direction.z));
      }
  }
  return 100.0 * double(open) / double(all);
}

/// Pixels of a picture that show the place, per cent.
double shown_percent(const scene::Scene& scene, const Camera& camera) {
  constexpr int width = 64, height = 36;
  const Image8 shown = pixels_of_place(scene, camera, width, height);
  return 100.0 * double(std::ranges::count(shown.pixels, 255)) / double(width * height);
}

/// The same camera beside the place, turned away from it.
Camera turned_away(const scene::Scene& scene, Camera camera) {
  constexpr float beside_m = 100.0f;
  Bounds bounds;
  for (const scene::Object& object : scene.objects)
    if (is_of_place(scene, object))
      bounds.add(transformed(object.world_from_model, scene::bounds(*object.model)));
  const glm::vec3 eye(glm::vec2(bounds.max) + beside_m, camera.position_in_world().z);
  camera.world_from_camera = look_at(eye, eye + glm::vec3(1.0f, 1.0f, 0.0f));
  return camera;
}

scene::Scene without_plane(scene::Scene scene) {
  std::erase_if(scene.objects, [&](const scene::Object& object) { return !is_of_place(scene, object); });
  return scene;
}

/// What a place's triangles are.
struct TriangleCount {
  double buildings = 0.0;  ///< dressed walls and roofs
  double own = 0.0;        ///< the map, its paving and the terrain around it
  double stored = 0.0;     ///< the same, and each model that is repeated along kerbs once
  double placed = 0.0;     ///< the same, and those once per place
  double plants = 0.0;     ///< full leaves and wood of grown plants, once; they are drawn at levels of detail
  double own_over_buildings() const { return own / std::max(buildings, 1.0); }
  double stored_over_buildings() const { return stored / std::max(buildings, 1.0); }
};

/// The land around the place is left out: it is the same for all maps.
TriangleCount count_triangles(const scene::Scene& scene, Report& report) {
  TriangleCount count;
  for (const scene::TriangleKind& kind : scene::triangle_kinds(scene)) {
    if (kind.name == "land around") continue;
    count.stored += double(kind.stored), count.placed += double(kind.placed);
    if (kind.objects == 1) count.own += double(kind.stored);
    report.note(fmt::format("  {}: {} triangles, {} in {} places", kind.name, kind.stored, kind.placed,
                            kind.objects));
  }
  count.plants = double(vegetation::plant_triangles(scene).stored);
  for (const scene::Object& object : scene.objects)
    for (const scene::Part& part : object.model->parts)
      if (part.object == "facade" || part.object.starts_with("WallSurface") || part.object == "RoofSurface")
        count.buildings += double(part.mesh.triangle_count());
  return count;
}

struct Totals {
  std::map<std::string, double> minutes_of;  ///< by kind of file
  double minutes = 0.0, warnings = 0.0, gap = 0.0, gap_without = 100.0;
  double osm_own = 0.0, osm_stored = 0.0, osm_stored_large = 0.0, osm_placed = 0.0,
         osm_plants = 0.0;  ///< over buildings
  double shown = 100.0, shown_away = 0.0;
  double picture_flip = 0.0, black_flip = 1.0;  ///< the greatest, and the lowest of black pictures
};

/// Kind of a model file: "cityjson", "citygml", "osm", "ifc".
std::string kind_of(const fs::path& file) {
  if (file.extension() == ".json") return "cityjson";
  if (file.extension() == ".gml") return "citygml";
  return file.extension().string().substr(1);
}

/// A warning is explained if it names the file and says, in a clause of its own, what was done about it or
/// what to do; what a made-up script itself does wrong is not.
bool is_unexplained(const Error& warning) {
  constexpr std::size_t min_words = 3;
  const std::string& text = warning.message;
  const std::size_t before_clause = std::max(text.rfind("; ") + 1, text.rfind(": ") + 1);  // npos + 1 is 0
  const auto words = std::size_t(std::count(text.begin() + std::ptrdiff_t(before_clause), text.end(), ' '));
  return warning.where.file.empty() || text.find("nothing that matches") != std::string::npos ||
         before_clause == 0 || words < min_words;
}

double unexplained_of(const scene::LoadedScene& loaded, Report& report) {
  Errors warnings = loaded.warnings;
  for (const Error& warning : house::check_place(loaded.scene)) warnings.push_back(warning);
  for (const Error& warning : warnings) report.note("warning: " + to_string(warning));
  return double(std::ranges::count_if(warnings, is_unexplained));
}

/// Unexplained warnings of a made-up script that is wrong: it dresses what the file does not have. A control.
Result<double> unexplained_of_wrong_script(const House& house, const fs::path& folder, const fs::path& town,
                                           Report& report) {
  const fs::path script = folder / "wrong.xp";
  const Status written = write_file(
      script, fmt::format("model(name=\"place\", file=\"{}\") {{ facades(target=\"TINRelief\") }}\n"
                          "camera(name=\"street\", position=\"0 0 2\", target=\"9 0 2\")\n",
                          town.filename().string()));
  if (!written) return written.errors();
  const Result<scene::LoadedScene> loaded = scene::load_scene(script, house.get<scene::NodeRegistry>(), {});
  if (!loaded) return loaded.errors();
  return unexplained_of(*loaded, report);
}

/// A map of few houses holds the same stock of cars as a large one: the ratio of large maps stands beside
/// that of all.
void note_triangles(const TriangleCount& count, Totals& totals, const std::string& file, Report& report) {
  constexpr double large_map = 4000.0;  // triangles of buildings; the map had 13,528
  totals.osm_stored = std::max(totals.osm_stored, count.stored_over_buildings());
  if (count.buildings >= large_map)
    totals.osm_stored_large = std::max(totals.osm_stored_large, count.stored_over_buildings());
  totals.osm_own = std::max(totals.osm_own, count.own_over_buildings());
  totals.osm_plants = std::max(totals.osm_plants, count.plants / std::max(count.buildings, 1.0));
  totals.osm_placed = std::max(totals.osm_placed, count.placed / std::max(count.buildings, 1.0));
  report.note(
      fmt::format("{}: {:.0f} triangles of buildings; by these {:.2f} of the map, {:.2f} with the models "
                  "of what is repeated, {:.0f} with all of it",
                  file, count.buildings, count.own_over_buildings(), count.stored_over_buildings(),
                  count.placed / std::max(count.buildings, 1.0)));
}

Status measure_place(const House& house, const fs::path& file, const fs::path& folder, Totals& totals,
                     Report& report) {
  Status done = Done{};
  dressing::WrittenScene written;
  std::unique_ptr<house::Stage> stage;
  Image8 picture;
  const std::clock_t before = std::clock();
  const double ms = milliseconds([&] {
    Result<dressing::WrittenScene> script =
        dressing::write_bare_scene(file, house.get<formats::Readers>(), folder);
    if (!script) return void(done = script.errors());
    written = *script;
    Result<house::Play> play = house::open_play(house, written.script, {&written.data_folder, 1});
    if (!play) return void(done = play.errors());
    Result<std::unique_ptr<house::Stage>> created = house::Stage::create(*std::move(play));
    if (!created) return void(done = created.errors());
    stage = *std::move(created);
    const Result<Camera> camera = stage->camera("street");
    if (!camera) return void(done = camera.errors());
    stage->draw(*camera, 1280, 720);
    picture = stage->picture();
  });
  const double processor_s = double(std::clock() - before) / CLOCKS_PER_SEC;
  if (!done) return done;
  totals.minutes = std::max(totals.minutes, ms / 60'000.0);
  double& of_kind = totals.minutes_of[kind_of(file)];
  of_kind = std::max(of_kind, ms / 60'000.0);
  const Result<scene::LoadedScene> loaded =
      scene::load_scene(written.script, house.get<scene::NodeRegistry>(), {&written.data_folder, 1});
  if (!loaded) return loaded.errors();
  totals.warnings += unexplained_of(*loaded, report);
  const scene::NamedCamera* street = loaded->scene.find_camera("street");
  const double shown = shown_percent(loaded->scene, street->camera);
  totals.shown = std::min(totals.shown, shown);
  totals.shown_away =
      std::max(totals.shown_away, shown_percent(loaded->scene, turned_away(loaded->scene, street->camera)));
  const Result<PictureError> picture_error = error_of_picture(*stage, street->camera, picture);
  if (!picture_error) return picture_error.errors();
  totals.picture_flip = std::max(totals.picture_flip, picture_error->drawn);
  totals.black_flip = std::min(totals.black_flip, picture_error->black);
  report.note(
      fmt::format("{}: {:.2f} s to the picture ({:.2f} s of processor time), {:.0f} % of which show the "
                  "place, there FLIP {:.3f} from the traced one",
                  file.filename().string(), 1e-3 * ms, processor_s, shown, picture_error->drawn));
  const double gap = gap_percent(loaded->scene, *street, &report),
               gap_without = gap_percent(without_plane(loaded->scene), *street, nullptr);
  totals.gap = std::max(totals.gap, gap), totals.gap_without = std::min(totals.gap_without, gap_without);
  report.note(fmt::format("{}: gaps of {:.3f} % of the ground, {:.1f} % without terrain_plane()",
                          file.filename().string(), gap, gap_without));
  if (file.extension() == ".osm")
    note_triangles(count_triangles(loaded->scene, report), totals, file.filename().string(), report);
  return Done{};
}

/// Of the streets of a town with a single house. A control.
Result<TriangleCount> count_of_lone_house(const House& house, const fs::path& folder, Report& report) {
  const fs::path file = folder / "lone.osm";
  if (Status status = write_file(file, town_xml(16, 1)); !status) return status.errors();
  const Result<dressing::WrittenScene> written =
      dressing::write_bare_scene(file, house.get<formats::Readers>(), folder);
  if (!written) return written.errors();
  const Result<scene::LoadedScene> loaded =
      scene::load_scene(written->script, house.get<scene::NodeRegistry>(), {});
  if (!loaded) return loaded.errors();
  return count_triangles(loaded->scene, report);
}

/// Time to read an IFC file, in a child process as always.
Status measure_ifc(const BenchSetup& setup, const fs::path& file, Report& report) {
  const formats::Readers& readers = setup.house.get<formats::Readers>();
  std::vector<double> ms;
  for (int i = 0; i < (setup.is_quick ? 3 : 9); ++i) {
    Status read = Done{};
    ms.push_back(milliseconds([&] {
      Errors warnings;
      const auto model = readers.read(file, {}, warnings);
      if (!model) read = model.errors();
      const auto is_named = [](const scene::Part& part) { return part.object.starts_with("Ifc"); };
      if (model && std::ranges::none_of(model->parts, is_named))
        read = error("{}: nothing was read", file.string());
    }));
    if (!read) return read;
  }
  report.add("ifc_load_ms", median(ms));
  return Done{};
}

/// Height of the hill without any street.
float hill_m(float x, float y) { return 0.03f * x + 1.5f * std::sin(0.02f * x) + 0.02f * y; }

/// A street over a hill with things on it that are no ground, and with a slab on it that would be, were it
/// not hidden, as what stands in another scenario is.
scene::Scene street_with_things(bool shows_slab) {
  scene::Scene scene;
  const auto add = [&](const Mesh& mesh, const scene::Material& material, const char* name) {
    auto model = std::make_shared<scene::Model>();
    model->materials.push_back(material);
    model->parts.emplace_back();
    model->parts.back().mesh = mesh, model->parts.back().object = name;
    scene.objects.emplace_back().model = model;
  };
  const auto sheet = [&](glm::vec2 low, glm::vec2 high, float step_m, float lift_m) {
    Mesh mesh;
    const glm::ivec2 cells(glm::max(glm::round((high - low) / step_m), glm::vec2(1.0f)));
    for (int y = 0; y <= cells.y; ++y)
      for (int x = 0; x <= cells.x; ++x) {
        const glm::vec2 p = low + (high - low) * glm::vec2(x, y) / glm::vec2(cells);
        mesh.positions.emplace_back(p, hill_m(p.x, p.y) + lift_m);
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
  const auto along = [](int first_m, int step_m, const auto& place) {
    for (int x_m = first_m; x_m <= 200; x_m += step_m) place(float(x_m));
  };
  along(0, 17, [&](float x) { add(sheet({x, 3}, {x + 8, 11}, 2.0f, 2.2f), leaves, "crown"); });
  along(5, 23, [&](float x) { add(sheet({x, 1.5f}, {x + 4.5f, 3.3f}, 1.0f, 1.45f), {}, "van"); });
  along(9, 31, [&](float x) { add(sheet({x, -5}, {x + 1.8f, -4.4f}, 0.6f, 0.45f), {}, "bench"); });
  add(sheet({40, -30}, {140, 30}, 5.0f, 1.0f), {}, "slab");
  scene.objects.back().is_visible = shows_slab;
  scene::Road road;
  along(0, 20, [&](float x) { road.path.emplace_back(x, 0.0f, hill_m(x, 0.0f)); });
  scene.roads = *scene::build_road_graph(std::vector{road});
  scene::pave(scene);
  return scene;
}

/// 99th percentile of how far what is paved lies below the bare hill, or above it by more than the layers of
/// asphalt and paint are thick. Where a carriageway has a gap, this is a metre.
double paving_error_m(const scene::Scene& scene) {
  constexpr float thickness_m = 0.07f, half_carriageway_m = 2.5f;
  scene::Scene paving;
  paving.objects.push_back(scene.objects.back());
  const reference::RayScene rays(paving);
  std::vector<double> errors;
  for (int i = 2; i < 398; ++i)
    for (int j = -12; j <= 12; ++j) {
      const float x = 0.5f * float(i), y = 0.5f * float(j);
      const auto hit = rays.nearest_hit({{x, y, 100.0f}, {0.0f, 0.0f, -1.0f}});
      const float above_m = hit ? 100.0f - hit->distance_m - hill_m(x, y) : 1.0f;
      if (hit || std::abs(y) < half_carriageway_m)
        errors.push_back(std::max({-above_m, above_m - thickness_m, 0.0f}));
    }
  return percentile(errors, 0.99);
}

}  // namespace

Status measure_places(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  std::error_code code;
  fs::create_directories(folder.path, code);
  report.add("paving_height_error_m", paving_error_m(street_with_things(false)), up_to(0.05));
  report.add_control("paving_height_error_m_on_a_slab", paving_error_m(street_with_things(true)),
                     up_to(0.05));
  if (const fs::path pavilion = fs::current_path() / "scenes/pavilion.ifc"; fs::exists(pavilion)) {
    if (Status status = measure_ifc(setup, pavilion, report); !status) return status;
  } else {
    report.skip("ifc_load_ms", "scenes/pavilion.ifc is not in the working folder");
  }
  if (Status status = measure_pbf(setup, folder.path, report); !status) return status;
  if (Status status = measure_planted_faults(setup.house, folder.path, report); !status) return status;
  std::vector<fs::path> files;
  const fs::path town = folder.path / "town.osm";
  if (Status status = write_file(town, town_xml(setup.is_quick ? 8 : 16, 256)); !status) return status;
  const fs::path packed_town = folder.path / "packed.osm.pbf";
  if (Status status = write_pbf(town, packed_town); !status) return status;
  files = {town, packed_town};
  for (const char* name : {"scenes/crossroads.osm", "scenes/canal.osm", "scenes/pavilion.ifc"})
    if (const fs::path map = fs::current_path() / name; fs::exists(map))
      files.push_back(map);
    else
      report.skip(name, "the file is not in the working folder");
  for (const char* name :
       {"cities/delft_context.city.json", "cities/DenHaag_01.city.json",
        "cities/zurich_subset_lod2.city.json", "cities/rotterdam_two_buildings_textured/twobuildings_t.json",
        "cities/citygml/lod3_building_v2.gml"})
    if (const auto file = shared_data(name, fs::current_path()))
      files.push_back(*file);
    else
      report.skip(name, "the shared data is absent");
  Totals totals;
  for (const fs::path& file : files)
    if (Status status = measure_place(setup.house, file, folder.path, totals, report); !status) return status;
  report.add("minutes_to_first_street", totals.minutes, up_to(1.0));
  for (const auto& [kind, minutes] : totals.minutes_of)
    report.add("minutes_to_first_street_" + kind, minutes);
  const Target shown{10.0, true};
  report.add("first_street_shown_percent", totals.shown, shown);
  report.add_control("first_street_shown_percent_turned_away", totals.shown_away, shown);
  const Target picture = up_to(0.25);
  report.add("first_street_flip_to_traced", totals.picture_flip, picture);
  report.add_control("first_street_flip_to_traced_of_black_pictures", totals.black_flip, picture);
  if (totals.shown < shown.limit)
    return error("a first picture shows {:.1f} % of its place: its minutes do not count", totals.shown);
  report.add("warnings_unexplained", totals.warnings, up_to(0.0));
  const Result<double> unexplained = unexplained_of_wrong_script(setup.house, folder.path, town, report);
  if (!unexplained) return unexplained.errors();
  report.add_control("warnings_unexplained_of_a_wrong_script", *unexplained, up_to(0.0));
  report.add("osm_triangles_over_buildings", totals.osm_stored, up_to(20.0));
  report.add("osm_triangles_over_buildings_without_stock", totals.osm_own, up_to(20.0));
  report.add("osm_triangles_over_buildings_of_large_maps", totals.osm_stored_large, up_to(20.0));
  report.add("osm_triangles_over_buildings_placed", totals.osm_placed);
  report.add("osm_plant_triangles_over_buildings", totals.osm_plants);
  const Result<TriangleCount> lone = count_of_lone_house(setup.house, folder.path, report);
  if (!lone) return lone.errors();
  report.add_control("osm_triangles_over_buildings_of_a_lone_house", lone->stored_over_buildings(),
                     up_to(20.0));
  report.add_control("osm_triangles_over_buildings_without_stock_of_a_lone_house", lone->own_over_buildings(),
                     up_to(20.0));
  report.add("ground_gap_percent", totals.gap, up_to(0.0));
  report.add_control("ground_gap_percent_without_plane", totals.gap_without, up_to(0.0));
  return Done{};
}

}  // namespace parvis::bench
