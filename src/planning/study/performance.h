// The scenes of a session and what its records do to them: by a file of inputs, and when a log is replayed.
#pragma once

#include "planning/design/session.h"
#include "planning/study/session.h"
#include "stage/stage.h"

namespace parvis::study {

/// Puts a scene into the state of a part's condition.
Status show_condition(stage::Simulation& simulation, const Study& study, const Part& part);

/// A hash of all that moves and is designed: the same bits, the same number.
std::uint64_t state_of(const stage::Simulation& simulation, const design::Session& design);
/// The same as logs write it.
std::string state_text(std::uint64_t state);
/// Whether a frame's time is one after which the state is logged.
bool is_state_due(std::int64_t before_us, std::int64_t now_us);

/// Adapts a scene to the eye from which a frame shows it, as drawing does (people nearby are finer): part of
/// its state.
void adapt_to(stage::Simulation& simulation, const Camera& eye);

/// Whether the study's scenes are scripts without errors and have the scenarios of its conditions. Opens no
/// model.
Status check_scenes(const Study& study, const Registries& registries);

/// Scenes as a session goes through them.
class Performance {
 public:
  /// A place for simulations: it keeps the one that is given and returns it, where it stays.
  using Keep = std::function<Result<stage::Simulation*>(stage::Simulation)>;

  /// All arguments outlive it. Without `keep` it keeps simulations by itself.
  Performance(const Study& study, const std::vector<Part>& parts, const Registries& registries,
              Keep keep = {});

  /// Shows the scene of a part, in the state of its condition.
  Status begin(const Part& part);
  /// Lets a record happen once more: its part, step, command or key. A command that fails is no error: it
  /// failed before.
  Status apply(const Record& record);

  /// The present scene; null: no part has begun.
  stage::Simulation* simulation() { return simulation_; }
  /// The design on which participants work; null as above.
  design::Session* design() { return design_ ? &*design_ : nullptr; }
  /// Gives the scene away, to a window: this has none then.
  stage::Simulation take();

 private:
  Status open_design();

  const Study& study_;
  const std::vector<Part>& parts_;
  const Registries& registries_;
  Keep keep_;
  std::filesystem::path open_;  ///< scene
  std::optional<stage::Simulation> kept_;
  stage::Simulation* simulation_ = nullptr;
  std::optional<design::Session> design_;
  std::optional<glm::vec3> eye_;  ///< of the frame before: it is there while the scene goes on
};

/// The outcome of a replay.
struct Replay {
  std::size_t frames = 0, states = 0;  ///< that were replayed, and compared
  std::optional<std::int64_t> differs_at_us =
      {};  ///< of the first state that is another; none: all are the same
};

/// Lets the records of a session happen again. `shown` is called after each frame; an error of it ends the
/// replay.
Result<Replay> replay(Performance& performance, const std::vector<Record>& records,
                      const std::function<Status(const Frame&)>& shown = {});

/// A session whose inputs stand in a file, one on each line: SECONDS do COMMAND | view CAMERA | eye X,Y,Z
/// heading DEG pitch DEG [fov DEG | parallel M] | press KEY | release KEY | note TEXT | answer
/// QUESTIONNAIRE.ITEM VALUE | done. Frames are steps of a 60th of a second by a clock of its own. Begins
/// where the session is, in the scene that `performance` shows. Errors name file and line; what was before
/// them is logged.
Status run_inputs(Session& session, Performance& performance, const std::filesystem::path& inputs);

}  // namespace parvis::study
