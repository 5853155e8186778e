// A design while people work on it: commands done, undone and redone on the nodes of a running scene, each in
// the journal before it takes effect; what is selected.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "planning/design/command.h"
#include "planning/design/journal.h"

namespace parvis::design {

/// A command that has been done.
struct Step {
  std::string text;      ///< its text form
  std::string sentence;  ///< for people
  Changes changes;
};

/// Works on one design of a scene, both of which outlive it.
class Session {
 public:
  using Heights = std::function<double(glm::dvec2 at, const Names& without)>;

  /// Takes the design of that name; empty: the scene's first, or, where it has none, a new one called
  /// "design" that comes with the first object. `begins`: a new one of that name. `heights`: what objects
  /// rest on. Errors: there is no such design; of a new one, its name is taken.
  static Result<Session> open(scene::Scene& scene, scene::LiveScene& live, const std::string& design,
                              Heights heights, bool begins = false);

  /// Reads a command (command.h), or one of: undo, redo, select NAMES|all|none|kind KIND|like NAME|group
  /// NAME|box X,Y X,Y. Where names are asked for, "selected" stands for what is selected. An error changes
  /// nothing.
  Status run(std::string_view text);
  /// The same of a command.
  Status run(Command command);
  /// Takes the last step back. Errors: there is none.
  Status undo();
  /// Does the step again that was undone last.
  Status redo();

  /// Hears of a command, undo or redo that was tried: its text form, and how it went.
  using Witness = std::function<void(const std::string& text, const Status& done)>;
  /// Calls `witness` after each from now on.
  void set_witness(Witness witness) { witness_ = std::move(witness); }

  const std::vector<Step>& done() const { return done_; }  ///< steps that can be undone, the last one last
  /// Steps that can be done again, the next one last.
  const std::vector<Step>& undone() const { return undone_; }

  /// Names of what is selected.
  const Names& selected() const { return selected_; }
  /// Selects objects of these names; those that are not there are left out.
  void select(Names names);

  /// The design as it is; null: it has no objects yet.
  const scene::Node* design() const;
  const std::string& name() const { return name_; }  ///< of the design
  /// The design as commands see it.
  DesignView view() const { return {scene_.get(), live_.get(), design(), heights_}; }
  /// Its objects as plain data.
  std::vector<PlacedObject> objects() const;
  /// Its measurements as plain data.
  std::vector<Measurement> measurements() const { return design::measurements(live_.get(), name_); }
  /// The script of what stands in the design. Equal designs have equal scripts.
  std::string script() const;

  /// Keeps a journal in `file` from now on. One that is there is replayed first where it began with this
  /// design, or the design was saved in between: afterwards the design is as it was. One whose steps are all
  /// saved, of a design that was changed beside it, is put aside under another name. Returns a sentence about
  /// the steps that were restored or put aside; empty: none. Errors: it is damaged, of a newer version, of
  /// another design, or holds unsaved steps of a design that was changed beside it: it is not touched then,
  /// and no journal is kept.
  Result<std::string> keep_journal(const std::filesystem::path& file);
  /// Notes in the journal that the design has been saved as it is.
  Status note_saved();
  /// Is there anything that has not been saved?
  bool has_unsaved() const { return script() != saved_script_; }

 private:
  Session(scene::Scene& scene, scene::LiveScene& live, Heights heights)
      : scene_(scene), live_(live), heights_(std::move(heights)) {}
  Status begin_journal(const std::filesystem::path& file);
  Result<std::string> put_aside_journal(const std::filesystem::path& file);
  Status select_by(const std::vector<std::string>& words);
  Status apply(const Changes& changes, bool forward);
  Status apply_one(const Change& change, bool forward);
  void note_neighbours(Changes& changes) const;
  Status replace_all(const std::string& base, const std::filesystem::path& file);
  Status run_resolved(const Command& whole);
  Status witnessed(const std::string& text, Status done) const;
  Status do_step(const Command& command);
  Status take_step(std::vector<Step>& from, std::vector<Step>& to, bool forward);

  std::reference_wrapper<scene::Scene> scene_;
  std::reference_wrapper<scene::LiveScene> live_;
  Heights heights_;
  std::string name_;
  std::vector<Step> done_, undone_;
  Names selected_;
  Journal journal_;
  Witness witness_;
  std::string saved_script_;
};

/// Where the journal of a scene's design lies: beside the script, a hidden file.
std::filesystem::path journal_file(const std::filesystem::path& scene_script, const std::string& design);

}  // namespace parvis::design
