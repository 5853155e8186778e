// parvis format: scene scripts in one style.
#include "base/files.h"
#include "commands.h"
#include "scene/script/script_format.h"
#include "scene/script/script_reader.h"

namespace parvis {
namespace {

struct FormatArguments {
  std::vector<std::filesystem::path> scripts;
  bool only_checks = false;
};

Status format_one(const std::filesystem::path& script, bool only_checks) {
  const Result<std::string> text = read_file(script);
  if (!text) return text.errors();
  const Result<scene::ScriptNode> tree = scene::parse_script_file(*text, script.string());
  if (!tree) return tree.errors();
  const std::string formatted = scene::format_script(*tree);
  if (formatted == *text) return Ok{};
  if (only_checks)
    return error_at({script.string()}, "is not formatted; run parvis format \"{}\"", script.string());
  // The user may name a link: it is the script that it points to.
  return write_file(std::filesystem::weakly_canonical(script), formatted);
}

Status format(const FormatArguments& arguments) {
  Errors errors;
  for (const std::filesystem::path& script :
       arguments.scripts)  // one that is broken keeps none of the others
    if (const Status status = format_one(script, arguments.only_checks); !status)
      errors.insert(errors.end(), status.errors().begin(), status.errors().end());
  if (!errors.empty()) return errors;
  return Ok{};
}

}  // namespace

void add_format(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("format", "Writes scene scripts in one style; comments stay");
  const auto arguments = std::make_shared<FormatArguments>();
  command->add_option("scripts", arguments->scripts, "Scene scripts (.xp)")->required();
  command->add_flag("--check", arguments->only_checks, "Change nothing; fail where something would change");
  command->footer("Example: parvis format scenes/delft.xp");
  command->callback([arguments, &chosen] { chosen = [arguments] { return format(*arguments); }; });
}

}  // namespace parvis
