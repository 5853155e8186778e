#include "planning/share/site.h"

#include <dlfcn.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/content_hash.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/known_names.h"
#include "base/module.h"
#include "base/progress.h"
#include "base/reduction.h"
#include "formats/gltf/gltf_writer.h"
#include "planning/design/design_nodes.h"
#include "planning/plan_drawing/council_sheet.h"
#include "planning/plan_drawing/qr_code.h"
#include "planning/share/instead.h"
#include "planning/share/notes.h"
#include "planning/share/site_files.h"
#include "planning/share/site_light.h"
#include "scene/data/realism.h"

namespace parvis::share {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr glm::ivec2 picture_px(1280, 720);
constexpr int supersample = 2;
/// Textures that a page shows at once; sharper ones follow.
constexpr int first_texture_px = 256;
/// All pixels of textures that a page shows, at most: beyond it their longest side is halved. A GPU holds
/// each as 4 bytes and a third for its levels: 128 MB.
constexpr double max_texture_pixels = 24e6;
constexpr int min_texture_px = 64;
/// Scripts of sharper textures, bytes of pictures in each: the page shows them as they come.
constexpr std::size_t textures_script_bytes = 2'000'000;

/// One state of the scene: without a scenario, or with one.
struct State {
  std::string name, title;
  std::vector<int> things;
  std::vector<design::PlacedObject> placed;
  Json json;
};

std::string file_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return name.substr(0, 60);
}

/// The page's own files, which the build has packed.
Result<fs::path> page_folder() {
  Dl_info here{};
  dladdr(reinterpret_cast<const void*>(&module_functions), &here);
  const fs::path folder = fs::path(here.dli_fname).parent_path() / "site";
  std::error_code code;
  if (!fs::exists(folder / "page.js", code))
    return error(
        "{}: the page of shared sites is missing: this Parvis was built without npm; install npm, and build "
        "it "
        "again with script/build",
        (folder / "page.js").string());
  return folder;
}

class Writer {
 public:
  Writer(stage::Stage& stage, const SiteOptions& options, SiteFiles files)
      : stage_(stage), options_(options), files_(std::move(files)) {}

  Result<WrittenSite> write(const fs::path& page) {
    if (Status status = write_link(); !status) return status.errors();
    if (Status status = choose_views(); !status) return status.errors();
    if (Status status = visit_states(); !status) return status.errors();
    if (Status status = add_notes(); !status) return status.errors();
    add_differences();
    if (Status status = write_place(); !status) return status.errors();
    if (Status status = write_light(); !status) return status.errors();
    site_["title"] = options_.title.empty() ? stage_.scene().file.stem().string() : options_.title;
    const std::vector<std::string> instead = shown_instead(stage_.scene(), live(), things_);
    site_["instead"] = instead;
    if (Status status = files_.write_json("scene", site_.dump(-1, ' ', true, Json::error_handler_t::replace));
        !status)
      return status.errors();
    for (const char* name : {"index.html", "page.js"}) {
      const Result<std::string> bytes = read_file(page / name);
      if (!bytes) return bytes.errors();
      if (Status status = files_.write(name, *bytes); !status) return status.errors();
    }
    if (Status status = files_.keep(); !status) return status.errors();
    return WrittenSite{states_.size(), views_.size(), things_.objects().size(), files_.bytes(), instead};
  }

 private:
  scene::LiveScene& live() { return stage_.simulation().live(); }

  Status choose_views() {
    std::vector<std::string> known;
    for (const scene::NamedCamera& camera : stage_.scene().cameras) known.push_back(camera.name);
    for (const std::string& name : options_.views)
      if (std::ranges::find(known, name) == known.end())
        return error("--view: the scene has no camera \"{}\"{}", name.substr(0, 40),
                     names_that_exist(name, known));
    views_ = options_.views.empty() ? known : options_.views;
    if (views_.empty()) views_.emplace_back();  // a view of the whole
    return Ok{};
  }

  static std::string label_of(const std::string& view) { return view.empty() ? "overview" : view; }

  /// Everything that depends on the scenario, one after another.
  Status visit_states() {
    site_["first"] = live().scenario().empty() ? scene::base_scene : live().scenario();
    states_.push_back({scene::base_scene, "", {}, {}, {}});
    for (const scene::Node* scenario : live().scenarios())
      states_.push_back({scenario->text("name"), scenario->text("title"), {}, {}, {}});
    Progress progress("views of scenarios", states_.size() * views_.size());
    for (State& state : states_) {
      if (Status status = stage_.choose_scenario(state.name); !status) return status;
      stage_.simulation().settle();
      if (Status status = draw_views(state, progress); !status) return status;
      describe(state);
    }
    if (Status status = stage_.choose_scenario(scene::base_scene); !status) return status;
    stage_.simulation().settle();
    return Ok{};
  }

  Status draw_views(State& state, Progress& progress) {
    for (const std::string& view : views_) {
      const Result<Camera> camera = stage_.camera(view);
      if (!camera) return camera.errors();
      stage_.draw(*camera, supersample * picture_px.x, supersample * picture_px.y);
      const std::string name =
          fmt::format("pictures/{}_{}.jpg", file_name(label_of(view)), file_name(state.name));
      const Result<std::string> jpeg = encode_image(reduced(stage_.picture(), supersample), name);
      if (!jpeg) return jpeg.errors();
      if (Status status = files_.write(name, *jpeg); !status) return status;
      state.json["pictures"].push_back(name);
      if (&state == &states_.front())
        site_["views"].push_back({{"name", label_of(view)},
                                  {"position", array_of(camera->position_in_world())},
                                  {"forward", array_of(camera->forward_in_world())},
                                  {"fov", camera->vertical_fov},
                                  {"far", camera->far_m}});
      progress.advance();
    }
    return Ok{};
  }

  /// The same piece of light once, by what it is made of.
  template <class Make>
  std::size_t numbered(const char* list, std::uint64_t key, const Make& make) {
    const auto [found, is_new] = numbers_.try_emplace({list, key}, site_[list].size());
    if (is_new) site_[list].push_back(make());
    return found->second;
  }

  void describe(State& state) {
    const scene::Scene& scene = stage_.scene();
    state.things = things_.add(scene);
    state.json["name"] = state.name;
    state.json["title"] = !state.title.empty()              ? state.title
                          : state.name == scene::base_scene ? "as it is"
                                                            : state.name;
    state.json["things"] = state.things;
    state.json["realism"] = scene.data<scene::Realism>().level;
    state.json["haze_per_m"] = scene.haze_per_m;
    const shading::DrawnLight light = stage_.renderer().drawn_light_without_shadows();
    ContentHash moment, sky, bounced;
    moment.add(scene.sun.direction_to_sun), moment.add(scene.sun.irradiance), moment.add(scene.exposure);
    moment.add(stage_.renderer().sky().levels.front().pixels);
    state.json["moment"] = numbered("moments", moment.value(),
                                    [&] { return moment_json(scene, stage_.renderer().sky(), light_); });
    sky.add(light.sky_visibility->values);
    state.json["visibility"] =
        numbered("visibilities", sky.value(), [&] { return visibility_json(*light.sky_visibility, light_); });
    if (light.bounced) bounced.add(light.bounced->lobes);
    state.json["bounced"] =
        numbered("bounced", bounced.value(), [&] { return bounced_json(light.bounced, light_); });
    state.placed = design::placed_objects(scene, live(), "", true);
    std::erase_if(state.placed, [](const design::PlacedObject& object) { return !object.is_visible; });
    state.json["measures"] = Json::array();
    for (const design::Measurement& measured : design::measurements(live(), "", true)) {
      if (!measured.is_visible) continue;
      Json json{{"text", measured.text()}, {"name", measured.name}, {"line", Json::array()}};
      json["at"] = array_of(glm::vec3(measured.middle()));
      for (const glm::dvec3& point : measured.line()) json["line"].push_back(array_of(glm::vec3(point)));
      state.json["measures"].push_back(std::move(json));
    }
    site_["states"].push_back(state.json);
  }

  Status add_notes() {
    site_["notes"] = Json::array();
    if (options_.notes.empty()) return Ok{};
    std::vector<std::string> known;
    for (const std::string& view : views_) known.push_back(label_of(view));
    for (const State& state : states_) known.push_back(state.name);
    const Result<std::vector<Note>> notes = read_notes(options_.notes, known);
    if (!notes) return notes.errors();
    for (const Note& note : *notes) site_["notes"].push_back({{"about", note.about}, {"text", note.text}});
    return Ok{};
  }

  /// The each pair of states places otherwise; a page turns a pair round by itself.
  void add_differences() {
    site_["differences"] = Json::array();
    for (std::size_t from = 0; from < states_.size(); ++from)
      for (std::size_t to = from + 1; to < states_.size(); ++to) {
        const auto differences = design::differences(states_[from].placed, states_[to].placed);
        if (differences.empty()) continue;
        Json json{{"from", from}, {"to", to}};
        for (const plan_drawing::DifferenceRow& row : plan_drawing::difference_rows(differences))
          json["rows"].push_back({{"how", design::name_of(row.how)},
                                  {"label", row.label},
                                  {"count", row.count},
                                  {"detail", row.detail}});
        for (const design::Difference& each : differences) {
          Json item{{"how", design::name_of(each.how)}, {"outlines", Json::array()}};
          for (const design::PlacedObject* object : {&each.before, &each.after}) {
            if (object->outline.empty() || (object == &each.before && each.how == design::Differs::changed))
              continue;
            Json outline{{"z", object->position.z}, {"height", object->size_m.z}, {"corners", Json::array()}};
            for (const glm::dvec2& corner : object->outline)
              outline["corners"].push_back({float(corner.x), float(corner.y)});
            item["outlines"].push_back(std::move(outline));
          }
          json["items"].push_back(std::move(item));
        }
        site_["differences"].push_back(std::move(json));
      }
  }

  /// The longest side that keeps all textures within what a page may hold.
  int texture_px() const {
    std::set<const scene::Model*> models;
    for (const scene::Object& object : things_.objects()) models.insert(object.model.get());
    int side = options_.max_texture_px;
    const auto pixels = [&] {
      double sum = 0.0;
      for (const scene::Model* model : models)
        for (const scene::Texture& texture : model->textures) {
          const double share =
              std::min(1.0, double(side) / std::max({texture.image.width, texture.image.height, 1}));
          sum += share * share * texture.image.width * texture.image.height;
        }
      return sum;
    };
    while (side > min_texture_px && pixels() > max_texture_pixels) side /= 2;
    return side;
  }

  Status write_place() {
    std::vector<const scene::Object*> objects;
    for (const scene::Object& object : things_.objects()) objects.push_back(&object);
    const int side = texture_px();
    if (side < options_.max_texture_px)
      fmt::print(stderr,
                 "warning: the textures are larger than a page may hold: reduced to a side of {} pixels\n",
                 side);
    Result<scene::PackedGltf> packed = scene::packed_gltf(objects, std::min(first_texture_px, side), side);
    if (!packed) return packed.errors();
    site_["surroundings"] = things_.surroundings();
    if (Status status = files_.write_part("place", packed->glb); !status) return status;
    // A script for some sharper textures: the numbers of their images, and where each begins and ends.
    site_["textures"] = Json::array();
    std::string bytes;
    Json images = Json::array();
    const auto finish = [&]() -> Status {
      if (bytes.empty()) return Ok{};
      const std::string name = fmt::format("textures_{}", site_["textures"].size());
      site_["textures"].push_back({{"part", name}, {"images", std::exchange(images, Json::array())}});
      return files_.write_part(name, std::exchange(bytes, ""));
    };
    for (const auto& [image, picture] : packed->sharper) {
      images.push_back({{"image", image}, {"offset", bytes.size()}, {"size", picture.size()}});
      bytes += picture;
      if (bytes.size() >= textures_script_bytes)
        if (Status status = finish(); !status) return status;
    }
    return finish();
  }

  Status write_light() {
    if (Status status = files_.write_part("light", light_.bytes()); !status) return status;
    LightBytes hours;
    const Result<Json> days = days_json(stage_.scene(), hours);
    if (!days) return days.errors();
    site_["days"] = *days;
    if (const light::DayLight& day = stage_.scene().data<light::DayLight>(); day.is_given)
      site_["place"] = {{"latitude", day.when.latitude_deg},
                        {"longitude", day.when.longitude_deg},
                        {"hour", day.when.time_of_day_h}};
    return files_.write_part("hours", hours.bytes());
  }

  /// A QR code of the address, for print.
  Status write_link() {
    if (options_.link.empty()) return Ok{};
    const Result<plan_drawing::QrCode> code = plan_drawing::qr_code(options_.link);
    return code ? files_.write("link.svg", plan_drawing::qr_svg(*code)) : Status(code.errors());
  }

  stage::Stage& stage_;
  const SiteOptions& options_;
  SiteFiles files_;
  std::vector<std::string> views_;  ///< names of cameras; an empty one: the whole
  std::vector<State> states_;
  ShownThings things_;
  LightBytes light_;
  std::map<std::pair<std::string, std::uint64_t>, std::size_t> numbers_;
  Json site_ = Json::object();
};

}  // namespace

Result<WrittenSite> write_site(stage::Stage& stage, const SiteOptions& options) {
  const Result<fs::path> page = page_folder();
  if (!page) return page.errors();
  Result<SiteFiles> files = SiteFiles::create(options.folder);
  if (!files) return files.errors();
  return Writer(stage, options, *std::move(files)).write(*page);
}

}  // namespace parvis::share
