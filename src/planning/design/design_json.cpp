#include "planning/design/design_json.h"

#include <cstring>
#include <glm/gtx/component_wise.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "base/colour.h"
#include "base/json_guard.h"
#include "base/path_inside.h"

namespace parvis::design {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int json_version = 1;

std::string colour_text(const glm::vec3& linear) {
  const glm::vec3 srgb = glm::round(255.0f * glm::clamp(srgb_from_linear(linear), 0.0f, 1.0f));
  return fmt::format("#{:02X}{:02X}{:02X}", int(srgb.x), int(srgb.y), int(srgb.z));
}

Json point(const glm::dvec3& at) { return {at.x, at.y, at.z}; }

Json object_json(const PlacedObject& object) {
  Json entry;
  entry["name"] = object.name, entry["kind"] = object.kind;
  if (object.kind == "ground") {
    Json outline = Json::array();
    for (const glm::dvec2& corner : object.outline)
      outline.push_back(point(glm::dvec3(corner, object.position.z)));
    entry["outline"] = std::move(outline);
  } else {
    entry["position"] = point(object.position), entry["heading_deg"] = object.heading_deg;
    entry["size"] = point(glm::round(object.size_m * 1e6) / 1e6);
  }
  entry["colour"] = colour_text(object.colour);
  if (!object.material.empty()) entry["material"] = object.material;
  if (!object.group.empty()) entry["group"] = object.group;
  if (object.is_locked) entry["locked"] = true;
  return entry;
}

Json measurement_json(const Measurement& made) {
  Json entry, points = Json::array();
  entry["name"] = made.name, entry["kind"] = measured_type;
  entry["measures"] = quantity_names()[std::size_t(made.quantity)];
  for (const glm::dvec3& each : made.points) points.push_back(point(each));
  entry["points"] = std::move(points), entry["value"] = made.value();
  if (made.is_locked) entry["locked"] = true;
  return entry;
}

Json view_json(const Camera& camera, const std::string& name) {
  const KeepView view = view_of(camera, name);
  Json entry;
  entry["name"] = name, entry["position"] = point(view.position);
  entry["heading_deg"] = view.heading_deg, entry["pitch_deg"] = view.pitch_deg;
  if (view.parallel_m)
    entry["parallel_m"] = *view.parallel_m;
  else
    entry["fov_deg"] = view.fov_deg;
  return entry;
}

/// An entry of a list, whose values have the types of the schema; keeps the first problem.
class Entry {
 public:
  explicit Entry(const Json& json) : json_(json) {
    if (!json.is_object()) fail("expected an object");
  }

  /// Empty: there is none.
  std::string text(const char* key) {
    const Json* value = find(key);
    if (!value) return "";
    if (!value->is_string()) return fail(fmt::format("\"{}\" is a text", key)), "";
    const std::string text = value->get<std::string>();
    if (std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }))
      return fail(fmt::format("\"{}\" holds control characters", key)), "";
    return text;
  }
  std::optional<double> number(const char* key) {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_number()) return fail(fmt::format("\"{}\" is a number", key)), std::nullopt;
    return value->get<double>();
  }
  bool flag(const char* key) {
    const Json* value = find(key);
    if (value && !value->is_boolean()) fail(fmt::format("\"{}\" is true or false", key));
    return value && value->is_boolean() && value->get<bool>();
  }
  std::optional<glm::dvec3> point(const char* key) {
    const Json* value = find(key);
    return value ? point_in(*value, fmt::format("\"{}\" is [x, y, z] in metres", key)) : std::nullopt;
  }
  glm::dvec3 needed_point(const char* key) {
    if (!find(key)) fail(fmt::format("\"{}\" is missing: [x, y, z] in metres", key));
    return point(key).value_or(glm::dvec3(0.0));
  }
  std::vector<glm::dvec3> needed_points(const char* key) {
    const std::string expected = fmt::format("\"{}\" is a list of points [x, y, z] in metres", key);
    const Json* value = find(key);
    std::vector<glm::dvec3> points;
    if (!value || !value->is_array()) return fail(expected), points;
    for (const Json& each : *value) points.push_back(point_in(each, expected).value_or(glm::dvec3(0.0)));
    return points;
  }
  void fail(std::string problem) {
    if (problem_.empty()) problem_ = std::move(problem);
  }
  const std::string& problem() const { return problem_; }

 private:
  const Json* find(const char* key) const {
    const bool has = json_.is_object() && json_.contains(key);
    return has ? &json_.at(key) : nullptr;
  }
  std::optional<glm::dvec3> point_in(const Json& value, const std::string& expected) {
    const bool is_point = value.is_array() && value.size() == 3 &&
                          std::ranges::all_of(value, [](const Json& each) { return each.is_number(); });
    if (!is_point) return fail(expected), std::nullopt;
    return glm::dvec3(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
  }

  const Json& json_;
  std::string problem_;
};

/// Reads one design into a session.
class Reader {
 public:
  Reader(const fs::path& file, Session& session, const TakeModel& take)
      : file_(file), session_(session), take_(take) {}

  Status read(const Json& whole) {
    if (Status status = read_head(whole); !status) return status;
    if (Status status = read_list(whole, "kinds", &Reader::read_kind); !status) return status;
    if (Status status = read_list(whole, "objects", &Reader::read_object); !status) return status;
    if (Status status = read_list(whole, "views", &Reader::read_view); !status) return status;
    for (const auto& [group, names] : groups_)
      if (Status status = session_.run(Command(Group{names, group})); !status) return status;
    return locked_.empty() ? Status(Ok{}) : session_.run(Command(Lock{locked_, true}));
  }

 private:
  Status read_head(const Json& whole) {
    Entry head(whole);
    if (const std::string unit = head.text("unit"); !unit.empty() && unit != "m")
      return error("{}: \"unit\" is \"{}\"; lengths of a design are metres (\"m\"): convert them first",
                   file_.string(), unit.substr(0, 20));
    (void)head.text("name");
    const glm::dvec3 own = session_.view().scene.origin;
    if (const auto origin = head.point("origin"); origin && own != glm::dvec3(0.0))
      if (origin->x != 0.0 || origin->y != 0.0) moved_ = *origin - own;  // coordinates of one map
    return head.problem().empty() ? Status(Ok{}) : error("{}: {}", file_.string(), head.problem());
  }

  Status read_list(const Json& whole, const char* key, Status (Reader::*read_one)(Entry&)) {
    if (!whole.contains(key)) return Ok{};
    if (!whole[key].is_array()) return error("{}: expected a list \"{}\"", file_.string(), key);
    std::size_t number = 0;
    for (const Json& json : whole[key]) {
      Entry entry(json);
      const Status status = (this->*read_one)(entry);
      ++number;
      const std::string problem = !entry.problem().empty() ? entry.problem()
                                  : !status                ? status.errors().front().message
                                                           : "";
      if (!problem.empty())
        return error("{}: {} {}: {}", file_.string(), std::string_view(key).substr(0, std::strlen(key) - 1),
                     number, problem);
    }
    return Ok{};
  }

  const scene::LiveScene& live() const { return session_.view().live; }
  /// Names are unique in a scene: where one is taken, the object gets the next free one of its kind.
  std::string free_or_none(const std::string& name) const { return live().find(name) ? "" : name; }

  /// Runs the command of an entry, unless something is wrong with that.
  Status run(const Entry& entry, const Command& command) {
    return entry.problem().empty() ? session_.run(command) : Status(Ok{});
  }

  Status read_kind(Entry& entry) {
    const std::string name = entry.text("name"), model = entry.text("file");
    const glm::dvec3 size = entry.needed_point("size");
    if (!entry.problem().empty()) return Ok{};
    constexpr double same_size_m = 0.001;
    if (const Kind* known = find_kind(session_.view().scene, name);
        known && glm::compMax(glm::abs(known->size_m - size)) < same_size_m)
      return Ok{};
    std::error_code code;
    const Result<fs::path> path =
        path_inside(fs::weakly_canonical(fs::absolute(file_), code).parent_path(), model);
    if (!path || !fs::is_regular_file(*path, code))
      return error("the model \"{}\" of the kind \"{}\" is not below the folder of this file; put it there",
                   model.substr(0, 80), name.substr(0, 40));
    Result<OwnKind> kind = take_(*path);
    if (!kind) return kind.errors();
    kind->command.size_m = size;
    kinds_[name] = kind->command.name;
    return run(entry, Command(kind->command));
  }

  Status read_object(Entry& entry) {
    const std::string kind = entry.text("kind"), name = free_or_none(entry.text("name"));
    const std::string group = entry.text("group"), colour = entry.text("colour"),
                      material = entry.text("material");
    const bool is_locked = entry.flag("locked");
    Status status = Ok{};
    if (kind == "ground") {
      status = run(entry, Surface{material, places(entry, "outline"), colour, name});
    } else if (kind == measured_type) {
      const std::string measures = entry.text("measures");
      status = run(entry, Measure{measures, places(entry, "points"), name});
    } else {
      status = read_placed(entry, kind, name, colour, material);
    }
    if (!status || !entry.problem().empty()) return status;
    const std::string made = session_.done().back().changes.front().after->text("name");
    if (!group.empty()) groups_[group].push_back(made);
    if (is_locked) locked_.push_back(made);
    return Ok{};
  }

  std::vector<glm::dvec3> places(Entry& entry, const char* key) const {
    std::vector<glm::dvec3> points = entry.needed_points(key);
    for (glm::dvec3& each : points) each += moved_;
    return points;
  }

  Status read_placed(Entry& entry, const std::string& kind, const std::string& name,
                     const std::string& colour, const std::string& material) {
    const auto taken = kinds_.find(kind);
    Insert insert{taken == kinds_.end() ? kind : taken->second, entry.needed_point("position") + moved_};
    insert.name = name, insert.material = material;
    insert.heading_deg = entry.number("heading_deg").value_or(0.0);
    const Kind* known = find_kind(session_.view().scene, insert.kind);
    if (const std::optional<glm::dvec3> size = entry.point("size"); size && known) {
      if (known->may_change(Changeable::width)) insert.width = size->x;
      if (known->may_change(Changeable::depth)) insert.depth = size->y;
      if (known->may_change(Changeable::height)) insert.height = size->z;
    }
    if (known && known->may_change(Changeable::colour)) insert.colour = colour;
    return run(entry, insert);
  }

  Status read_view(Entry& entry) {
    const std::string name = entry.text("name");
    KeepView view{name, entry.needed_point("position") + moved_};
    for (int number = 2; live().find(view.name); ++number) view.name = fmt::format("{}_{}", name, number);
    view.heading_deg = entry.number("heading_deg").value_or(0.0);
    view.pitch_deg = entry.number("pitch_deg").value_or(0.0);
    view.fov_deg = entry.number("fov_deg").value_or(view.fov_deg);
    view.parallel_m = entry.number("parallel_m");
    return run(entry, view);
  }

  const fs::path& file_;
  Session& session_;
  const TakeModel& take_;
  glm::dvec3 moved_{0.0};                     ///< from places about its origin to places about ours
  std::map<std::string, std::string> kinds_;  ///< the scene's name for a kind of the file
  std::map<std::string, Names> groups_;
  Names locked_;
};

}  // namespace

std::string json_of(const scene::Scene& scene, const Session& session, const fs::path& file) {
  Json objects = Json::array(), kinds = Json::array(), views = Json::array();
  std::error_code code;
  const fs::path folder = fs::weakly_canonical(fs::absolute(file), code).parent_path();
  const std::vector<PlacedObject> placed = session.objects();
  for (const PlacedObject& object : placed) objects.push_back(object_json(object));
  for (const Measurement& made : session.measurements()) objects.push_back(measurement_json(made));
  for (const Kind& kind : scene.data<Kinds>().own) {
    const bool is_used =
        std::ranges::any_of(placed, [&](const PlacedObject& object) { return object.kind == kind.name; });
    if (!is_used || kind.file.empty()) continue;
    Json& entry = kinds.emplace_back();
    entry["name"] = kind.name, entry["label"] = kind.label, entry["size"] = point(kind.size_m);
    entry["file"] = fs::path(kind.file).lexically_relative(folder).generic_string();
  }
  if (const scene::Node* design = session.design())
    for (const scene::Node& node : design->children)
      if (node.schema->type == view_type)
        if (const scene::NamedCamera* camera = scene.find_camera(node.text("name")))
          views.push_back(view_json(camera->camera, node.text("name")));
  Json whole;
  whole["parvis_design"] = json_version, whole["name"] = session.name(), whole["unit"] = "m";
  whole["origin"] = point(scene.origin);
  if (!kinds.empty()) whole["kinds"] = std::move(kinds);
  whole["objects"] = std::move(objects);
  if (!views.empty()) whole["views"] = std::move(views);
  return whole.dump(2) + "\n";
}

Status read_json(const std::string& text, const fs::path& file, Session& session, const TakeModel& take) {
  if (Status status = check_json_depth(text, file.string()); !status) return status;
  const Json whole = Json::parse(text, nullptr, false);
  if (whole.is_discarded()) return error("{}: this is no JSON, or its end is missing", file.string());
  if (!whole.is_object() || !whole.contains("parvis_design") || !whole["parvis_design"].is_number_integer())
    return error("{}: this is no design: expected \"parvis_design\": {}", file.string(), json_version);
  const long version = whole["parvis_design"].get<long>();
  if (version != json_version)
    return error("{}: the design is of version {}, {} ({}){}", file.string(), version,
                 version > json_version ? "newer than this program" : "which is none; expected", json_version,
                 version > json_version ? "; open it with that one" : "");
  if (!whole.contains("objects")) return error("{}: expected a list \"objects\"", file.string());
  return Reader(file, session, take).read(whole);
}

}  // namespace parvis::design
