#include "planning/design/design_file.h"

#include <nlohmann/json.hpp>

#include "base/colour.h"
#include "base/files.h"
#include "base/json_guard.h"
#include "scene/script/node_text.h"
#include "scene/script/script_format.h"
#include "scene/script/script_reader.h"

namespace parvis::design {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int json_version = 1;

/// The node of the file's tree that is the design of this name; null: there is none.
scene::ScriptNode* design_in(scene::ScriptNode& parent, const std::string& name) {
  for (scene::ScriptNode& child : parent.children) {
    const auto named = std::ranges::find(child.attributes, "name", &scene::ScriptAttribute::name);
    if (child.type == design_type && named != child.attributes.end() && named->value == name) return &child;
    if (scene::ScriptNode* inside = design_in(child, name)) return inside;
  }
  return nullptr;
}

/// Objects that the file has keep their comments.
void put_objects(scene::ScriptNode& design, const scene::Node& node) {
  std::vector<scene::ScriptNode> before = std::exchange(design.children, {});
  for (const scene::Node& object : node.children) {
    scene::ScriptNode written = scene::written_node(object);
    for (const scene::ScriptNode& known : before) {
      const auto named = std::ranges::find(known.attributes, "name", &scene::ScriptAttribute::name);
      if (named == known.attributes.end() || named->value != object.text("name")) continue;
      written.comments_before = known.comments_before, written.comments_behind = known.comments_behind;
    }
    design.children.push_back(std::move(written));
  }
}

std::string colour_text(const glm::vec3& linear) {
  const glm::vec3 srgb = glm::round(255.0f * glm::clamp(srgb_from_linear(linear), 0.0f, 1.0f));
  return fmt::format("#{:02X}{:02X}{:02X}", int(srgb.x), int(srgb.y), int(srgb.z));
}

Json point(const glm::dvec3& at) { return {at.x, at.y, at.z}; }

}  // namespace

fs::path file_of(const Session& session) {
  return session.design() ? session.design()->where.file : std::string();
}

namespace {

/// Refuses to write over a script that is neither the one in which the design stands nor one that was made of
/// this design before.
Status check_target(const fs::path& file, const fs::path& from, const fs::path& scene_script,
                    const std::string& design) {
  std::error_code code;
  const fs::path target = fs::weakly_canonical(fs::absolute(file), code);
  if (!fs::exists(target, code) || target == from) return Ok{};
  if (from.empty() && target == fs::weakly_canonical(fs::absolute(scene_script), code)) return Ok{};
  const Result<std::string> text = read_file(target);
  if (text)
    if (Result<scene::ScriptNode> tree = scene::parse_script_file(*text, target.string());
        tree && !tree->children.empty() && design_in(*tree, design) &&
        target != fs::weakly_canonical(fs::absolute(scene_script), code))
      return Ok{};
  return error("{}: there is a file that is not this design's, and it is left as it is; {}", file.string(),
               from.empty()
                   ? std::string("choose another name")
                   : fmt::format("the design \"{}\" stands in {}: write it there, or choose another name",
                                 design, from.string()));
}

}  // namespace

Status save(const Session& session, const fs::path& scene_script, const fs::path& file) {
  const scene::Node* node = session.design();
  if (!node) return error("the design has no objects yet; there is nothing to write");
  std::error_code code;
  const fs::path folder = fs::weakly_canonical(fs::absolute(scene_script), code).parent_path();
  if (fs::weakly_canonical(fs::absolute(file), code).parent_path() != folder)
    return error(
        "{}: a design lies in the folder of its scene, for files are named relative to it; write it to {}",
        file.string(), (folder / file.filename()).string());
  const fs::path from = file_of(session);
  if (Status status = check_target(file, from, scene_script, session.name()); !status) return status;
  const bool is_scene = fs::weakly_canonical(fs::absolute(file), code) ==
                        fs::weakly_canonical(fs::absolute(scene_script), code);
  scene::ScriptNode tree;
  if (!from.empty()) {
    const Result<std::string> text = read_file(from);
    if (!text) return text.errors();
    Result<scene::ScriptNode> read = scene::parse_script_file(*text, from.string());
    if (!read) return read.errors();
    tree = *std::move(read);
    scene::ScriptNode* design = design_in(tree, session.name());
    if (!design)
      return error("{}: the design \"{}\" is not there any more; the file was changed meanwhile",
                   from.string(), session.name());
    put_objects(*design, *node);
    // A file beside the scene that is no scene by itself includes it.
    if (fs::weakly_canonical(file, code) != from && from != fs::weakly_canonical(scene_script, code))
      tree.comments_before.insert(tree.comments_before.begin(),
                                  "// A design of " + scene_script.filename().string());
  } else if (is_scene) {  // its first design, behind all else
    const Result<std::string> text = read_file(file);
    if (!text) return text.errors();
    Result<scene::ScriptNode> read = scene::parse_script_file(*text, file.string());
    if (!read) return read.errors();
    tree = *std::move(read);
    tree.children.push_back(scene::written_node(*node));
  } else {
    scene::ScriptNode include;
    include.type = scene::include_type;
    include.attributes.emplace_back().name = "file";
    include.attributes.back().value = scene_script.filename().string();
    tree.children = {std::move(include), scene::written_node(*node)};
  }
  return write_file(file, scene::format_script(tree));
}

std::string json_of(const scene::Scene& scene, const Session& session) {
  Json objects = Json::array();
  for (const PlacedObject& object : session.objects()) {
    Json& entry = objects.emplace_back();
    entry["name"] = object.name, entry["kind"] = object.kind;
    if (object.kind == "ground") {
      Json outline = Json::array();
      for (const glm::dvec2& corner : object.outline)
        outline.push_back(point(glm::dvec3(corner, object.position.z)));
      entry["outline"] = std::move(outline);
    } else {
      entry["position"] = point(object.position), entry["heading_deg"] = object.heading_deg;
      entry["size"] = point(object.size_m);
    }
    entry["colour"] = colour_text(object.colour);
    if (!object.material.empty()) entry["material"] = object.material;
    if (!object.group.empty()) entry["group"] = object.group;
    if (object.is_locked) entry["locked"] = true;
  }
  for (const Measurement& made : session.measurements()) {
    Json& entry = objects.emplace_back();
    entry["name"] = made.name, entry["kind"] = measured_type;
    entry["measures"] = quantity_names()[std::size_t(made.quantity)];
    Json points = Json::array();
    for (const glm::dvec3& each : made.points) points.push_back(point(each));
    entry["points"] = std::move(points), entry["value"] = made.value();
    if (made.is_locked) entry["locked"] = true;
  }
  Json whole;
  whole["parvis_design"] = json_version, whole["name"] = session.name(), whole["unit"] = "m";
  whole["origin"] = point(scene.origin), whole["objects"] = std::move(objects);
  return whole.dump(2) + "\n";
}

Status read_json(const std::string& text, const std::string& file, Session& session) {
  if (Status status = check_json_depth(text, file); !status) return status;
  const Json whole = Json::parse(text, nullptr, false);
  if (whole.is_discarded()) return error("{}: this is no JSON, or its end is missing", file);
  if (!whole.is_object() || !whole.contains("parvis_design") || !whole["parvis_design"].is_number_integer())
    return error("{}: this is no design: expected \"parvis_design\": {}", file, json_version);
  if (whole["parvis_design"].get<long>() > json_version)
    return error("{}: the design is of version {}, newer than this program ({}); open it with that one", file,
                 whole["parvis_design"].get<long>(), json_version);
  if (!whole.contains("objects") || !whole["objects"].is_array())
    return error("{}: expected a list \"objects\"", file);
  const auto numbers = [](const Json& entry, std::size_t count) {
    std::vector<double> values;
    if (entry.is_array() && entry.size() == count)
      for (const Json& value : entry)
        if (value.is_number()) values.push_back(value.get<double>());
    return values.size() == count ? values : std::vector<double>();
  };
  const auto text_in = [](const Json& entry, const char* key) {
    return entry.contains(key) && entry[key].is_string() ? entry[key].get<std::string>() : std::string();
  };
  // Both on a map: coordinates about one origin mean other places about another.
  glm::dvec3 moved(0.0);
  const glm::dvec3 own = session.view().scene.origin;
  if (whole.contains("origin") && own != glm::dvec3(0.0))
    if (const std::vector<double> origin = numbers(whole["origin"], 3);
        !origin.empty() && (origin[0] != 0.0 || origin[1] != 0.0))
      moved = glm::dvec3(origin[0], origin[1], origin[2]) - own;
  const auto points_in = [&](const Json& entry, const char* key) -> std::optional<std::vector<glm::dvec3>> {
    std::vector<glm::dvec3> points;
    if (!entry.contains(key) || !entry[key].is_array()) return std::nullopt;
    for (const Json& each : entry[key]) {
      const std::vector<double> at = numbers(each, 3);
      if (at.empty()) return std::nullopt;
      points.push_back(glm::dvec3(at[0], at[1], at[2]) + moved);
    }
    return points;
  };
  // Names are unique in a scene: where one is taken, the object gets the next free one of its kind.
  const auto free_or_none = [&](const std::string& name) {
    return name.empty() || session.view().live.find(name) ? std::string() : name;
  };
  std::size_t number = 0;
  for (const Json& entry : whole["objects"]) {
    ++number;
    const auto wrong = [&](const std::string& what) {
      return error("{}: object {}: {}", file, number, what);
    };
    if (!entry.is_object()) return wrong("expected an object");
    const std::string kind = text_in(entry, "kind"), name = free_or_none(text_in(entry, "name"));
    Status status = Ok{};
    if (kind == "ground") {
      const auto outline = points_in(entry, "outline");
      if (!outline) return wrong("a ground surface has an \"outline\" of corners [x, y, z] in metres");
      status =
          session.run(Command(Surface{text_in(entry, "material"), *outline, text_in(entry, "colour"), name}));
    } else if (kind == measured_type) {
      const auto points = points_in(entry, "points");
      if (!points) return wrong("a measurement has \"points\" [x, y, z] in metres");
      status = session.run(Command(Measure{text_in(entry, "measures"), *points, name}));
    } else {
      const std::vector<double> at =
          entry.contains("position") ? numbers(entry["position"], 3) : std::vector<double>();
      if (at.empty()) return wrong("\"position\" is [x, y, z] in metres");
      Insert insert{kind, glm::dvec3(at[0], at[1], at[2]) + moved};
      insert.name = name;
      if (entry.contains("heading_deg") && entry["heading_deg"].is_number())
        insert.heading_deg = entry["heading_deg"].get<double>();
      const Kind* known = find_kind(session.view().scene, kind);
      if (const std::vector<double> size =
              entry.contains("size") ? numbers(entry["size"], 3) : std::vector<double>();
          !size.empty() && known) {
        if (known->may_change(Changeable::width)) insert.width = size[0];
        if (known->may_change(Changeable::depth)) insert.depth = size[1];
        if (known->may_change(Changeable::height)) insert.height = size[2];
      }
      if (known && known->may_change(Changeable::colour)) insert.colour = text_in(entry, "colour");
      insert.material = text_in(entry, "material");
      status = session.run(Command(insert));
    }
    if (!status) return wrong(status.errors().front().message);
  }
  return Ok{};
}

}  // namespace parvis::design
