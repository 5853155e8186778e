#include "planning/design/session.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "base/known_names.h"
#include "base/plan_polygon.h"
#include "scene/data/name_pattern.h"
#include "scene/script/node_text.h"

namespace parvis::design {
namespace {

using scene::Node;

const Node* child_of(const Node* design, const std::string& name) {
  if (design)
    for (const Node& node : design->children)
      if (node.text("name") == name) return &node;
  return nullptr;
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    const std::size_t end = std::min(text.find_first_of(" \t\r\n", first), text.size());
    if (end > first) words.emplace_back(text.substr(first, end - first));
    at = end;
  }
  return words;
}

std::optional<glm::dvec2> plan_point(const std::string& word) {
  const std::vector<double> numbers = scene::parse_numbers(word);
  if (numbers.size() < 2) return std::nullopt;
  return glm::dvec2(numbers[0], numbers[1]);
}

/// " on table_1", where what has come to a place stands on another object of the design; else empty.
std::string carrier_of(const Changes& changes, const std::vector<PlacedObject>& objects) {
  constexpr double touching_m = 0.02;
  if (changes.size() != 1 || !changes.front().after) return "";
  const std::string name = changes.front().after->text("name");
  const auto placed = std::ranges::find(objects, name, &PlacedObject::name);
  if (placed == objects.end()) return "";
  for (const PlacedObject& other : objects)
    if (other.name != name && other.kind != "ground" &&
        std::abs(other.position.z + other.size_m.z - placed->position.z) < touching_m &&
        is_in_ring(other.outline, placed->position))
      return " on " + other.name;
  return "";
}

}  // namespace

Result<Session> Session::open(scene::Scene& scene, scene::LiveScene& live, const std::string& design,
                              Heights heights, bool begins) {
  Session session(scene, live, std::move(heights));
  const std::vector<const Node*> designs = designs_of(live);
  std::vector<std::string> names;
  for (const Node* each : designs) names.push_back(each->text("name"));
  if (design.empty()) {
    session.name_ = names.empty() ? "design" : names.front();
    for (int number = 2; names.empty() && live.find(session.name_); ++number)
      session.name_ = fmt::format("design_{}", number);
  } else if (begins) {
    if (live.find(design))
      return error("the name \"{}\" is taken; names are unique in a scene", design.substr(0, 40));
    session.name_ = design;
  } else if (std::ranges::find(names, design) == names.end()) {
    return error("the scene has no design \"{}\"{}", design.substr(0, 40), names_that_exist(design, names));
  } else {
    session.name_ = design;
  }
  for (const Node* each : designs)
    for (const Node& object : each->children)
      if (each->text("name") == session.name_ && !object.gives("name"))
        return error_at(object.where,
                        "this object has no name; give it one (name=), so that commands can call it");
  session.saved_script_ = session.script();
  return session;
}

const Node* Session::design() const {
  const Node* node = live_.get().find(name_);
  return node && node->schema->type == design_type ? node : nullptr;
}

std::vector<PlacedObject> Session::objects() const { return placed_objects(scene_, live_, name_); }

std::string Session::script() const {
  const Node* node = design();
  return node ? scene::script_of(node->children) : "";
}

void Session::select(Names names) {
  std::erase_if(names, [this](const std::string& name) { return !child_of(design(), name); });
  selected_ = std::move(names);
}

Status Session::select_by(const std::vector<std::string>& words) {
  const std::string how = words.size() > 1 ? words[1] : "";
  std::vector<PlacedObject> all;  // and measurements
  if (const Node* node = design())
    for (const Node& child : node->children)
      if (is_thing(child)) all.push_back(placed_object(scene_, child, name_));
  const auto choose = [&](const auto& fits) {
    Names names;
    for (const PlacedObject& object : all)
      if (fits(object)) names.push_back(object.name);
    selected_ = std::move(names);
    return Status(Ok{});
  };
  if (how == "all" && words.size() == 2) return choose([](const PlacedObject&) { return true; });
  if (how == "none" && words.size() == 2) return choose([](const PlacedObject&) { return false; });
  if (how == "kind" && words.size() == 3)
    return choose([&](const PlacedObject& each) { return each.kind == words[2]; });
  if (how == "group" && words.size() == 3)
    return choose([&](const PlacedObject& each) { return each.group == words[2]; });
  if (how == "like" && words.size() == 3) {
    const auto like = std::ranges::find(all, words[2], &PlacedObject::name);
    if (like == all.end()) return error("the design has no object \"{}\"", words[2].substr(0, 40));
    return choose([&](const PlacedObject& each) {
      return each.kind == like->kind && each.size_m == like->size_m && each.colour == like->colour &&
             each.material == like->material;
    });
  }
  if (how == "box" && words.size() == 4) {
    const std::optional<glm::dvec2> a = plan_point(words[2]), b = plan_point(words[3]);
    if (!a || !b) return error("a box has two corners X,Y X,Y");
    const glm::dvec2 low = glm::min(*a, *b), high = glm::max(*a, *b);
    return choose([&](const PlacedObject& each) {
      const glm::dvec2 at(each.position);
      return glm::all(glm::greaterThanEqual(at, low)) && glm::all(glm::lessThanEqual(at, high));
    });
  }
  if (words.size() != 2)
    return error(
        "select is written: select NAMES | all | none | kind KIND | like NAME | group NAME | box X,Y X,Y");
  Names names;
  for (std::size_t at = 0; at <= how.size();) {
    const std::size_t end = std::min(how.find(',', at), how.size());
    const std::string name = how.substr(at, end - at);
    bool is_any = false;
    for (const PlacedObject& object : all)
      if (scene::is_pattern(name) ? scene::matches(name, object.name) : name == object.name) {
        names.push_back(object.name);
        is_any = true;
      }
    if (!is_any) {
      std::vector<std::string> known;
      for (const PlacedObject& object : all) known.push_back(object.name);
      return error("the design has no object \"{}\"{}", name.substr(0, 40), names_that_exist(name, known));
    }
    at = end + 1;
  }
  selected_ = std::move(names);
  return Ok{};
}

Status Session::run(std::string_view text) {
  std::vector<std::string> words = split(text);
  if (words.empty()) return Ok{};
  if (words.front() == "select") return select_by(words);
  if (words.size() == 1 && words.front() == "undo") return undo();
  if (words.size() == 1 && words.front() == "redo") return redo();
  for (std::string& word : words) {
    if (word != "selected") continue;
    if (selected_.empty()) return error("nothing is selected: name the objects, or select some first");
    word = fmt::format("{}", fmt::join(selected_, ","));
  }
  Result<Command> command = parse_command(fmt::format("{}", fmt::join(words, " ")));
  if (!command) return witnessed(std::string(text), command.errors());
  return run(*std::move(command));
}

Status Session::witnessed(const std::string& text, Status done) const {
  if (witness_) witness_(text, done);
  return done;
}

Status Session::run(Command command) {
  const std::string text = text_of(command);
  const Result<Command> whole = resolved(view(), std::move(command));
  if (!whole) return witnessed(text, whole.errors());
  return witnessed(text_of(*whole), run_resolved(*whole));
}

Status Session::run_resolved(const Command& whole) {
  if (Result<Changes> changes = changes_of(view(), whole); !changes)
    return changes.errors();  // before it is noted
  if (Status status = journal_.append({JournalEntry::What::command, text_of(whole)}); !status) return status;
  Status status = do_step(whole);
  if (!status)  // what was noted is taken back there, too
    if (Status noted = journal_.append({JournalEntry::What::undo, "failed"}); !noted) return noted;
  return status;
}

/// Which objects stand behind those that go, so that they come back where they were: of several, the last to
/// go is the first to come back, so that those that went before it are not there.
void Session::note_neighbours(Changes& changes) const {
  const Node* node = design();
  std::set<const Node*> gone;
  for (Change& change : changes) {
    if (!change.before || change.after || !node) continue;
    const Node* here = child_of(node, change.before->text("name"));
    const Node* next = here;
    do next = next ? live_.get().next_of(*next) : nullptr;
    while (next && gone.contains(next));
    gone.insert(here);
    if (next) change.behind = next->text("name");
  }
}

Status Session::do_step(const Command& command) {
  Result<Changes> changes = changes_of(view(), command);
  if (!changes) return changes.errors();
  note_neighbours(*changes);
  if (Status status = apply(*changes, true); !status) return status;
  Names made;
  for (const Change& change : *changes)
    if (change.after && is_thing(*change.after) &&
        (!change.before || change.before->text("name") != change.after->text("name")))
      made.push_back(change.after->text("name"));
  if (!made.empty()) selected_ = std::move(made);
  select(selected_);
  const bool comes_to_stand =
      std::holds_alternative<Insert>(command) || std::holds_alternative<Move>(command);
  const std::string carrier = comes_to_stand ? carrier_of(*changes, objects()) : "";
  done_.push_back({text_of(command), sentence_of(command) + carrier, *std::move(changes)});
  undone_.clear();
  return Ok{};
}

Status Session::apply_one(const Change& change, bool forward) {
  scene::LiveScene& live = live_;
  scene::Scene& scene = scene_;
  const std::optional<Node>&from = forward ? change.before : change.after,
        &to = forward ? change.after : change.before;
  const Node* here = from ? child_of(design(), from->text("name")) : nullptr;
  assert(!from || here);
  if (!to) {
    if (from->schema->type == kind_type) forget_kind(scene, from->text("name"));
    return live.remove(scene, *here);
  }
  if (!from) {
    const Node* parent = design();
    if (!parent) {
      Node made;
      made.schema = &live.registry().find(design_type)->schema;
      made.set("name", name_);
      const Result<const Node*> inserted = live.insert(scene, std::move(made), {});
      if (!inserted) return inserted.errors();
      parent = *inserted;
    }
    const Result<const Node*> inserted = live.insert(scene, *to, {parent, child_of(parent, change.behind)});
    if (!inserted) return inserted.errors();
    return Ok{};
  }
  if (to->text("name") != from->text("name"))
    if (Status status = live.rename(scene, *here, to->text("name")); !status) return status;
  live.set_all(*here, to->attributes);
  if (Errors errors = live.refresh(scene); !errors.empty()) return errors;
  return Ok{};
}

/// Applies all changes or none.
Status Session::apply(const Changes& changes, bool forward) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const Status status = apply_one(changes[forward ? i : changes.size() - 1 - i], forward);
    if (status) continue;
    while (i-- > 0) {
      const Status back = apply_one(changes[forward ? i : changes.size() - 1 - i], !forward);
      assert(back.ok() && "it has been so before");
    }
    return status;
  }
  return Ok{};
}

Status Session::take_step(std::vector<Step>& from, std::vector<Step>& to, bool forward) {
  if (from.empty()) return error("there is nothing to {}", forward ? "do again" : "undo");
  if (Status status = apply(from.back().changes, forward); !status) return status;
  to.push_back(std::move(from.back()));
  from.pop_back();
  select(selected_);
  return Ok{};
}

Status Session::undo() {
  if (done_.empty()) return error("there is nothing to undo");
  if (Status status = journal_.append({JournalEntry::What::undo}); !status) return status;
  return witnessed("undo", take_step(done_, undone_, false));
}

Status Session::redo() {
  if (undone_.empty()) return error("there is nothing to do again");
  if (Status status = journal_.append({JournalEntry::What::redo}); !status) return status;
  return witnessed("redo", take_step(undone_, done_, true));
}

/// Gives the design what a script says that stood in it.
Status Session::replace_all(const std::string& base, const std::filesystem::path& file) {
  scene::LiveScene& live = live_;
  if (const Node* node = design())
    while (!node->children.empty())
      if (Status status = live.remove(scene_, node->children.back()); !status) return status;
  if (base.empty() || !design()) return Ok{};
  const auto restored = live.insert_script(scene_, base, {design(), nullptr},
                                           Roots(scene_.get().file.parent_path()), file.string());
  if (!restored) return restored.errors();
  return Ok{};
}

Status Session::begin_journal(const std::filesystem::path& file) {
  Result<Journal> journal = Journal::begin(file, name_, script());
  if (!journal) return journal.errors();
  journal_ = *std::move(journal);
  return Ok{};
}

/// Nothing of the steps in a journal is unsaved, and the design was changed beside it: a new journal begins.
Result<std::string> Session::put_aside_journal(const std::filesystem::path& file) {
  std::error_code code;
  std::filesystem::path aside;
  for (int number = 1; aside.empty() || std::filesystem::exists(aside, code); ++number)
    aside = fmt::format("{}.{}", file.string(), number);
  std::filesystem::rename(file, aside, code);
  if (code) return error("{}: the journal cannot be put aside: {}", file.string(), code.message());
  if (Status status = begin_journal(file); !status) return status.errors();
  return fmt::format(
      "the design was changed beside its journal: earlier steps, which lie in {}, cannot be undone",
      aside.filename().string());
}

Result<std::string> Session::keep_journal(const std::filesystem::path& file) {
  const std::string now = script();
  std::error_code code;
  if (!std::filesystem::exists(file, code)) {
    if (Status status = begin_journal(file); !status) return status.errors();
    return std::string();
  }
  Result<Journal> journal = Journal::lock(file);  // first: nobody else writes from here on
  if (!journal) return journal.errors();
  const Result<JournalContent> content = read_journal(file);
  if (!content) return content.errors();
  std::set<std::string> known{hash_of(content->base)};
  std::size_t unsaved = 0;
  for (const JournalEntry& entry : content->entries)
    if (entry.what == JournalEntry::What::saved)
      known.insert(entry.text), unsaved = 0;
    else
      ++unsaved;
  const bool is_known = known.contains(hash_of(now));
  if (content->name == name_ && !is_known && unsaved == 0) return put_aside_journal(file);
  if (content->name != name_ || !is_known)
    return error(
        "{}: this journal is of another design, or the design was changed beside it while it held steps that "
        "were not saved; it is left as it is, and what is done from here on is kept only when it is saved. "
        "Move it away to begin a new one",
        file.string());
  // From the beginning: then all steps can be undone, those before the design was saved as well.
  if (Status status = replace_all(content->base, file); !status) return status.errors();
  int line = 3;
  for (const JournalEntry& entry : content->entries) {
    ++line;
    Status status = Ok{};
    if (entry.what == JournalEntry::What::command) {
      const Result<Command> command = parse_command(entry.text);
      status = command ? do_step(*command) : Status(command.errors());
      const bool was_taken_back = !status && &entry != &content->entries.back() &&
                                  (&entry + 1)->what == JournalEntry::What::undo &&
                                  (&entry + 1)->text == "failed";
      if (was_taken_back) status = Ok{};
    } else if (entry.what == JournalEntry::What::undo && entry.text != "failed") {
      status = take_step(done_, undone_, false);
    } else if (entry.what == JournalEntry::What::redo) {
      status = take_step(undone_, done_, true);
    } else if (entry.what == JournalEntry::What::saved) {
      saved_script_ = script();
    }
    if (!status)
      return error_at({file.string(), line, 1},
                      "the journal cannot be followed further: {}; what it says before this "
                      "line has been done",
                      status.errors().front().message);
  }
  if (Status status = journal->drop_cut_line(); !status) return status.errors();
  journal_ = *std::move(journal);
  if (unsaved == 0) return std::string();
  return fmt::format("{} that had not been saved {} there again{}",
                     unsaved == 1 ? "a step" : fmt::format("{} steps", unsaved), unsaved == 1 ? "is" : "are",
                     content->is_cut ? "; one that was being written is not" : "");
}

Status Session::note_saved() {
  saved_script_ = script();
  return journal_.append({JournalEntry::What::saved, hash_of(saved_script_)});
}

std::filesystem::path journal_file(const std::filesystem::path& scene_script, const std::string& design) {
  return scene_script.parent_path() / fmt::format(".{}.{}.journal", scene_script.stem().string(), design);
}

}  // namespace parvis::design
