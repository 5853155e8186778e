#include "planning/design/design_file.h"

#include "base/files.h"
#include "scene/script/node_text.h"
#include "scene/script/script_format.h"
#include "scene/script/script_reader.h"

namespace parvis::design {
namespace {

namespace fs = std::filesystem;

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

}  // namespace parvis::design
