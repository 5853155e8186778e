// parvis plan: a project is placed in a scene, without a window; and a scene as a plan, for offices: PDF at a
// true scale, DXF, CSV.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

#include "base/files.h"
#include "base/known_names.h"
#include "commands.h"
#include "graphics/gl/context.h"
#include "plan_council.h"
#include "planning/design/design_file.h"
#include "planning/design/design_json.h"
#include "planning/design/difference.h"
#include "planning/design/own_kind.h"
#include "planning/design/scene_surfaces.h"
#include "planning/plan_drawing/plan_files.h"
#include "scene_arguments.h"
#include "window_surroundings.h"

namespace parvis {
namespace {

struct Arguments {
  SceneArguments scene;
  std::filesystem::path pdf, dxf, csv;
  plan_drawing::Sheet sheet;
  std::string centre;
  std::string design, begun;
  std::vector<std::string> commands;
  std::vector<std::filesystem::path> kind_files;  ///< models that become kinds
  std::string kind_unit;
  std::filesystem::path command_file, import_json, output, json;
  std::string compared;  ///< a design that the scene's is compared with
  CouncilOptions council;
  bool gives_scale = false;
  bool lists_objects = false, lists_kinds = false, keeps_journal = false;
};

void list_kinds(const scene::Scene& scene) {
  for (const design::Kind& kind : design::kinds_of(scene))
    fmt::print("{:<14} {:<18} {:<20} {:g} x {:g} x {:g} m\n", kind.name, kind.label, kind.label_fr,
               kind.size_m.x, kind.size_m.y, kind.size_m.z);
}

void list_objects(const design::Session& session) {
  for (const design::PlacedObject& object : session.objects())
    fmt::print("{:<18} {:<14} {:.3f},{:.3f},{:.3f} heading {:g}, {:g} x {:g} x {:g} m{}\n", object.name,
               object.kind, object.position.x, object.position.y, object.position.z, object.heading_deg,
               object.size_m.x, object.size_m.y, object.size_m.z, object.is_locked ? ", locked" : "");
  for (const design::Measurement& each : session.measurements())
    fmt::print("{:<18} {:<14} {}{}\n", each.name, design::quantity_names()[std::size_t(each.quantity)],
               each.text(), each.is_locked ? ", locked" : "");
}

/// Whether the scene has a design of that name. The error names those that it has.
Status expect_design(const stage::Simulation& simulation, const std::string& name) {
  std::vector<std::string> names;
  for (const scene::Node* node : design::designs_of(simulation.live())) names.push_back(node->text("name"));
  if (std::ranges::find(names, name) != names.end()) return Ok{};
  return error("the scene has no design \"{}\"{}", name.substr(0, 40), names_that_exist(name, names));
}

/// Prints each difference that turns the other design into this one, and their counts.
Status list_differences(const design::Session& session, const stage::Simulation& simulation,
                        const std::string& other) {
  if (Status status = expect_design(simulation, other); !status) return status;
  std::array<int, 4> counts{};
  for (const design::Difference& each : design::differences(
           design::placed_objects(simulation.scene, simulation.live(), other), session.objects())) {
    fmt::print("{}\n", design::line_of(each));
    ++counts[std::size_t(each.how)];
  }
  fmt::print("from \"{}\" to \"{}\": {} added, {} removed, {} moved, {} changed\n", other, session.name(),
             counts[0], counts[1], counts[2], counts[3]);
  return Ok{};
}

/// The lines of a file; # begins a comment.
Result<std::vector<std::pair<std::string, int>>> lines_of(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file, 64u << 20);
  if (!text) return text.errors();
  std::vector<std::pair<std::string, int>> lines;
  int number = 0;
  for (std::size_t at = text->starts_with("\xEF\xBB\xBF") ? 3 : 0; at < text->size();) {
    const std::size_t end = std::min(text->find('\n', at), text->size());
    std::string line = text->substr(at, end - at);
    ++number;
    if (const std::size_t comment = line.find("# "); comment != std::string::npos || line.starts_with('#'))
      line.resize(line.starts_with('#') ? 0 : comment);
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.emplace_back(std::move(line), number);
    at = end + 1;
  }
  return lines;
}

/// Files that are removed at its end, unless something that was written names them.
struct NewFiles {
  std::vector<std::filesystem::path> files;
  NewFiles() = default;
  NewFiles(const NewFiles&) = delete;
  NewFiles& operator=(const NewFiles&) = delete;
  ~NewFiles() {
    std::error_code ignored;
    for (const std::filesystem::path& file : files) {
      std::filesystem::remove(file, ignored);
      std::filesystem::remove(file.parent_path(), ignored);  // only where it is empty
    }
  }
};

/// Keeps a model as a kind of the scene; the file that is written for it.
Result<design::OwnKind> take_kind(const Arguments& arguments, const stage::Simulation& simulation,
                                  const std::filesystem::path& file, double unit_m, NewFiles& new_files) {
  Result<design::OwnKind> kind =
      design::import_kind(simulation.registries->get<formats::Readers>(), simulation.scene, file, unit_m);
  const bool is_named_by_journal = arguments.keeps_journal;
  if (kind && !kind->new_file.empty() && !is_named_by_journal) new_files.files.push_back(kind->new_file);
  return kind;
}

Status import_design(const Arguments& arguments, const stage::Simulation& simulation,
                     design::Session& session, NewFiles& new_files) {
  if (arguments.import_json.empty()) return Ok{};
  const Result<std::string> text = read_file(arguments.import_json, 256u << 20);
  if (!text) return text.errors();
  return design::read_json(*text, arguments.import_json, session, [&](const std::filesystem::path& file) {
    return take_kind(arguments, simulation, file, design::metre, new_files);
  });
}

/// Models of --kind.
Status take_kinds(const Arguments& arguments, const stage::Simulation& simulation, design::Session& session,
                  NewFiles& new_files) {
  const std::map<std::string, double> units{
      {"", 0.0}, {"m", design::metre}, {"cm", design::centimetre}, {"mm", design::millimetre}};
  for (const std::filesystem::path& file : arguments.kind_files) {
    const Result<design::OwnKind> kind =
        take_kind(arguments, simulation, file, units.at(arguments.kind_unit), new_files);
    if (!kind) return kind.errors();
    if (Status status = session.run(design::Command(kind->command)); !status) return status;
    fmt::print("{}\n", kind->note);
  }
  return Ok{};
}

/// Does a command and prints what was done.
Status run_command(design::Session& session, const std::string& command) {
  const std::size_t before = session.done().size();
  const Status status = session.run(command);
  if (status && session.done().size() > before) fmt::print("{}\n", session.done().back().sentence);
  return status;
}

Status run_commands(const Arguments& arguments, design::Session& session) {
  if (!arguments.command_file.empty()) {
    const auto lines = lines_of(arguments.command_file);
    if (!lines) return lines.errors();
    for (const auto& [line, number] : *lines)
      if (Status status = run_command(session, line); !status)
        return error_at({arguments.command_file.string(), number, 1}, "{}", status.errors().front().message);
  }
  for (const std::string& command : arguments.commands)
    if (Status status = run_command(session, command); !status)
      return error("--do \"{}\": {}", command, status.errors().front().message);
  return Ok{};
}

Status read_centre(const std::string& text, plan_drawing::Sheet& sheet) {
  if (text.empty()) return Ok{};
  const std::vector<double> numbers = scene::parse_numbers(text);
  if (numbers.size() != 2) return error("--centre {}: expected two numbers, as 12.5,-3", text);
  sheet.centre = glm::dvec2(numbers[0], numbers[1]);
  return Ok{};
}

/// The scene with its designs on paper.
Status write_drawings(const Arguments& arguments, const stage::Simulation& simulation) {
  if (arguments.pdf.empty() && arguments.dxf.empty() && arguments.csv.empty()) return Ok{};
  plan_drawing::Sheet sheet = arguments.sheet;
  sheet.words = design::words_in(arguments.council.language);
  if (Status status = read_centre(arguments.centre, sheet); !status) return status;
  const plan_drawing::ScenePlan plan = plan_drawing::plan_of(
      simulation.scene,
      design::labelled_in(arguments.council.language,
                          design::placed_objects(simulation.scene, simulation.live(), "", true)),
      design::measurements(simulation.live(), "", true), design::words_in(arguments.council.language));
  if (sheet.title.empty()) sheet.title = arguments.scene.scene.stem().string();
  if (!arguments.pdf.empty())
    if (Status status = plan_drawing::write_plan_pdf(arguments.pdf, plan, sheet); !status) return status;
  if (!arguments.dxf.empty())
    if (Status status = plan_drawing::write_plan_dxf(arguments.dxf, plan); !status) return status;
  if (!arguments.csv.empty())
    if (Status status = plan_drawing::write_plan_csv(arguments.csv, plan); !status) return status;
  fmt::print("{} lines, {} trees, {} placed objects\n", plan.lines.size(), plan.trees.size(),
             plan.placed.size());
  for (const std::string& note : plan.left_out) fmt::print("{}: {}\n", sheet.words("Not on this plan"), note);
  return Ok{};
}

/// The sheet that compares the design with another.
Status write_council_of(const Arguments& arguments, const design::Session& session, stage::Stage& stage) {
  CouncilOptions options = arguments.council;
  options.before = arguments.compared;
  if (options.before == session.name())
    return error("--compare {}: this is the design itself; name another with --design", options.before);
  options.title =
      arguments.sheet.title.empty() ? arguments.scene.scene.stem().string() : arguments.sheet.title;
  options.subtitle = arguments.sheet.subtitle;
  if (arguments.gives_scale) options.scale = arguments.sheet.scale;
  return write_council(stage, session, options);
}

/// No output may be another one or an input, and a file of another kind is not written over.
Status check_outputs(const Arguments& a) {
  namespace fs = std::filesystem;
  const auto whole = [](const fs::path& file) {
    std::error_code code;
    return fs::weakly_canonical(fs::absolute(file), code);
  };
  std::vector<fs::path> taken{whole(a.scene.scene)};
  for (const fs::path* file : {&a.command_file, &a.import_json})
    if (!file->empty()) taken.push_back(whole(*file));
  for (const fs::path& file : a.kind_files) taken.push_back(whole(file));
  if (!a.output.empty()) taken.push_back(whole(a.output));
  using Output = std::pair<const fs::path*, const char*>;
  for (const auto& [file, ending] : {Output(&a.json, ".json"),
                                     {&a.pdf, ".pdf"},
                                     {&a.dxf, ".dxf"},
                                     {&a.csv, ".csv"},
                                     {&a.council.file, ".pdf"}}) {
    if (file->empty()) continue;
    if (std::ranges::find(taken, whole(*file)) != taken.end())
      return error("{}: this file is read or written by this command, too; give each a name of its own",
                   file->string());
    std::error_code code;
    if (fs::exists(*file, code) && file->extension() != ending)
      return error("{}: there is a file that is no {}, and it is left as it is; choose another name",
                   file->string(), ending);
    taken.push_back(whole(*file));
  }
  return Ok{};
}

bool asks_for_nothing(const Arguments& a) {
  return a.commands.empty() && a.kind_files.empty() && a.compared.empty() && !a.lists_objects &&
         !a.lists_kinds && !a.keeps_journal &&
         std::ranges::all_of(std::array{&a.command_file, &a.import_json, &a.json, &a.output, &a.pdf, &a.dxf,
                                        &a.csv, &a.council.file},
                             [](const std::filesystem::path* file) { return file->empty(); });
}

/// `stage`: where pictures are asked for, the one of the simulation.
Status work_on(const Arguments& arguments, stage::Simulation& simulation, stage::Stage* stage) {
  if (arguments.lists_kinds) list_kinds(simulation.scene);
  Result<design::Session> session = design::Session::open(
      simulation.scene, simulation.live(), arguments.begun.empty() ? arguments.design : arguments.begun,
      design::resting_heights(simulation.scene), !arguments.begun.empty());
  if (!session) return session.errors();
  if (arguments.keeps_journal) {
    const Result<std::string> restored =
        session->keep_journal(design::journal_file(arguments.scene.scene, session->name()));
    if (!restored) return restored.errors();
    if (!restored->empty()) fmt::print("{}\n", *restored);
  }
  NewFiles new_files;
  if (Status status = import_design(arguments, simulation, *session, new_files); !status) return status;
  if (Status status = take_kinds(arguments, simulation, *session, new_files); !status) return status;
  if (Status status = run_commands(arguments, *session); !status) return status;
  if (arguments.lists_objects) list_objects(*session);
  if (!arguments.compared.empty())
    if (Status status = list_differences(*session, simulation, arguments.compared); !status) return status;
  if (!arguments.json.empty())
    if (Status status =
            write_file(arguments.json, design::json_of(simulation.scene, *session, arguments.json));
        !status)
      return status;
  if (!arguments.json.empty()) new_files.files.clear();
  if (!arguments.output.empty()) {
    if (Status status = design::save(*session, simulation.scene.file, arguments.output); !status)
      return status;
    new_files.files.clear();
    fmt::print("{}: design \"{}\" with {} objects\n", arguments.output.string(), session->name(),
               session->objects().size());
    if (Status status = session->note_saved(); !status) return status;
  }
  if (Status status = write_drawings(arguments, simulation); !status) return status;
  return stage ? write_council_of(arguments, *session, *stage) : Status(Ok{});
}

Status plan(const Arguments& arguments) {
  if (asks_for_nothing(arguments))
    return error(
        "nothing is asked for: give commands (--do, --file), --list, --kinds, or a file to write (-o, "
        "--json, "
        "--pdf, --dxf, --csv, --council)");
  if (Status status = check_outputs(arguments); !status) return status;
  if (Status status = arguments.scene.expect_one_scenario(); !status) return status;
  if (!arguments.council.file.empty()) {
    if (arguments.compared.empty()) return error("--council needs two designs: --design NEW --compare OLD");
    const Result<gl::Context> context = gl::Context::create_headless();
    if (!context) return context.errors();
    Result<std::unique_ptr<stage::Stage>> stage = arguments.scene.open_stage();
    if (!stage) return stage.errors();
    return work_on(arguments, (*stage)->simulation(), stage->get());
  }
  Result<stage::Simulation> simulation = arguments.scene.open_simulation();
  if (!simulation) return simulation.errors();
  return work_on(arguments, *simulation, nullptr);
}

}  // namespace

void add_plan(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand(
      "plan", "Places a project in a scene; and the scene as a plan: PDF at a true scale, DXF, CSV");
  const auto arguments = std::make_shared<Arguments>();
  arguments->scene.add_scene(*command);
  arguments->scene.add_state(*command);
  command->add_option("--design", arguments->design,
                      "Name of the design (default: the scene's first, or a new one)");
  command->add_option("--new", arguments->begun, "Begin another design of this name")->excludes("--design");
  command
      ->add_option("--do", arguments->commands,
                   "A command, as \"insert bench_wood 12.40,3.05 heading 90\"; may repeat")
      ->allow_extra_args(false);
  command
      ->add_option("--kind", arguments->kind_files,
                   "A model file that becomes a kind of this design, before the commands; may repeat")
      ->allow_extra_args(false);
  command->add_option("--kind-unit", arguments->kind_unit, "In which it was drawn (default: metres)")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  command->add_option("--file", arguments->command_file,
                      "A file with a command on each line; # begins a comment");
  command->add_option("--import", arguments->import_json,
                      "A design in JSON (docs/design.schema.json), before the commands");
  command->add_flag("--list", arguments->lists_objects, "Print the objects of the design");
  command->add_option(
      "--compare", arguments->compared,
      "Print what this design adds, removes, moves and changes, against another of the scene");
  command->add_flag("--kinds", arguments->lists_kinds, "Print the kinds of objects that can be placed");
  command->add_flag(
      "--journal", arguments->keeps_journal,
      "Keep a journal beside the scene: undo reaches back over earlier calls, as in the window");
  command->add_option("--json", arguments->json, "Write the design as JSON");
  command->add_option("-o,--output", arguments->output, "Write the design (.xp), into the scene's folder");
  command->add_option("--pdf", arguments->pdf, "A sheet with title block, legend, scale bar and north");
  command->add_option("--dxf", arguments->dxf,
                      "A drawing in metres, in map coordinates where there are some");
  command->add_option("--csv", arguments->csv, "A table of trees and placed objects");
  command->add_option(
      "--council", arguments->council.file,
      "The sheet that compares --design with --compare (.pdf): pictures before and after, plan, "
      "table, hours of sun");
  command
      ->add_option("--view", arguments->council.views,
                   "A camera of the scene for --council (default: all of them); may repeat")
      ->allow_extra_args(false);
  command->add_option("--link", arguments->council.link,
                      "An address for --council, drawn as a QR code: of a shared site, say");
  command->add_option("--sun-day", arguments->council.day, "Day of the hours of sun of --council")
      ->capture_default_str();
  CLI::Option* scale =
      command->add_option("--scale", arguments->sheet.scale, "Of the plan, 1 : SCALE (--council: what fits)")
          ->capture_default_str();
  command->add_option("--paper", arguments->sheet.paper, "A4, A3, A2, A1 or A0, landscape")
      ->capture_default_str();
  command->add_option("--centre", arguments->centre, "Middle of the sheet, metres: X,Y in the scene's frame");
  command->add_option("--title", arguments->sheet.title, "Of the title block (default: the scene's name)");
  command
      ->add_option_function<std::string>(
          "--language",
          [arguments](const std::string& name) { arguments->council.language = design::language_of(name); },
          "Of --pdf and --council: en or fr (default: the locale's)")
      ->check(CLI::IsMember({"en", "fr"}));
  arguments->council.language = design::language_of(locale());
  command->add_option("--subtitle", arguments->sheet.subtitle, "Its second line: project, state, author");
  std::string forms;
  for (const std::string& form : design::command_forms()) forms += "\n  " + form;
  command->footer(
      "Commands:" + forms +
      "\n  undo | redo | select NAMES|all|none|kind KIND|like NAME|group NAME|box X,Y X,Y\n"
      "NAMES are parted by commas; * and ? stand for any; \"selected\" is what was selected last.\n"
      "Example: parvis plan scenes/planned_square.xp --do \"row umbrella from 0,-6 to 12,-6 count 4\" "
      "-o scenes/planned_square.xp\n"
      "         parvis plan out/paper/paper.xp --pdf plan.pdf --scale 500 --dxf plan.dxf --csv plan.csv");
  command->callback([arguments, scale, &chosen] {
    arguments->gives_scale = scale->count() > 0;
    chosen = [arguments] { return plan(*arguments); };
  });
}

}  // namespace parvis
