// The log of a study: everything that happened in its sessions, by one clock, in one SQLite file to which is
// only appended. Whoever is killed loses nothing that `flush` has acknowledged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/camera.h"
#include "base/result.h"

struct sqlite3;

namespace parvis::study {

/// Something that happened; docs/study.md lists the kinds.
struct Event {
  std::int64_t time_us = 0;  ///< since the session began
  std::string kind, text;

  bool operator==(const Event&) const = default;
};

/// A frame: how far the scene went on, and from where it is seen then.
struct Frame {
  std::int64_t time_us = 0;
  double step_s = 0.0;    ///< by which the scene advanced
  float frame_ms = 0.0f;  ///< what the frame took by the clock; 0: it was not drawn
  Camera eye;
  std::optional<glm::vec3> wand;  ///< the place in the scene to which the pointer or wand points

  bool operator==(const Frame& other) const;
};

using Record = std::variant<Event, Frame>;

/// When a record was made.
inline std::int64_t time_of(const Record& record) {
  return std::visit([](const auto& each) { return each.time_us; }, record);
}

/// A participant's session.
struct LoggedSession {
  std::int64_t id = 0;
  std::string participant;  ///< a code: letters, digits, _ and -
  std::string study;        ///< its name
  std::string script;       ///< of the study, as it was
  int row = 0;              ///< of the orders of conditions
  double clock_s =
      0.0;  ///< of the machine's steady clock, when the session began; 0: it had a clock of its own
};

/// A log that is open. One process at a time writes it.
class Log {
 public:
  /// Opens a log, or begins one where there is no file. Errors: another file, another version, a damaged log.
  static Result<Log> open(const std::filesystem::path& file);
  /// Opens one that is there, for reading.
  static Result<Log> read(const std::filesystem::path& file);

  const std::filesystem::path& file() const { return file_; }  ///< the log's
  /// Sessions in the order in which they began.
  Result<std::vector<LoggedSession>> sessions() const;
  /// The session of that participant; none: there is none yet.
  Result<std::optional<LoggedSession>> session_of(const std::string& participant) const;
  /// The records of a session in their order.
  Result<std::vector<Record>> records(std::int64_t session) const;

  /// Begins a session; gives it its id. Errors: the participant has one, the code is none.
  Result<LoggedSession> begin(LoggedSession session);
  /// Appends records to a session from now on.
  Status resume(const LoggedSession& session);
  /// Holds a record until the next `flush`.
  void add(Record record) { held_.push_back(std::move(record)); }
  /// Writes what is held; when it returns without an error, all of it is on the disk. After an error (a full
  /// disk) it is held still, and the next `flush` tries again.
  Status flush();
  /// How many records have not been written.
  std::size_t held() const { return held_.size(); }

  /// Deletes a participant's session, also from the file's free pages. Errors: there is no such participant.
  Status forget(const std::string& participant);

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  static Result<Log> open(const std::filesystem::path& file, int flags);
  Status write_held();

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
  std::int64_t session_ = 0, number_ = 0;  ///< to which is appended; number of its next record
  std::vector<Record> held_;
};

/// Whether a text is a participant's code: 1 to 40 letters, digits, _ or -.
Status check_participant(const std::string& code);

}  // namespace parvis::study
