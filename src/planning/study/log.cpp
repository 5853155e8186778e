#include "planning/study/log.h"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>

namespace parvis::study {
namespace {

constexpr int application_id = 0x50725374;  // "PrSt"
constexpr int version = 1;

// Rows are never changed, and deleted only by `forget`, which lifts the trigger for its transaction.
constexpr const char* no_update =
    "CREATE TRIGGER event_stays BEFORE UPDATE ON event BEGIN SELECT RAISE(ABORT, 'append only'); END;"
    "CREATE TRIGGER frame_stays BEFORE UPDATE ON frame BEGIN SELECT RAISE(ABORT, 'append only'); END;";
constexpr const char* no_delete =
    "CREATE TRIGGER event_kept BEFORE DELETE ON event BEGIN SELECT RAISE(ABORT, 'append only'); END;"
    "CREATE TRIGGER frame_kept BEFORE DELETE ON frame BEGIN SELECT RAISE(ABORT, 'append only'); END;";
constexpr const char* tables =
    "CREATE TABLE session(id INTEGER PRIMARY KEY, participant TEXT NOT NULL UNIQUE, study TEXT NOT NULL,"
    " script TEXT NOT NULL, row INTEGER NOT NULL, clock_s REAL NOT NULL);"
    "CREATE TABLE event(session INTEGER NOT NULL, number INTEGER NOT NULL, time_us INTEGER NOT NULL,"
    " kind TEXT NOT NULL, text TEXT NOT NULL, PRIMARY KEY(session, number)) WITHOUT ROWID;"
    "CREATE TABLE frame(session INTEGER NOT NULL, number INTEGER NOT NULL, time_us INTEGER NOT NULL,"
    " step_s REAL NOT NULL, frame_ms REAL NOT NULL, eye BLOB NOT NULL, wand BLOB,"
    " PRIMARY KEY(session, number)) WITHOUT ROWID;";

/// A camera's numbers, as they are: a replay is exact.
using EyeNumbers = std::array<float, 25>;

EyeNumbers numbers_of(const Camera& eye) {
  EyeNumbers numbers{};
  std::memcpy(numbers.data(), glm::value_ptr(eye.world_from_camera), 16 * sizeof(float));
  numbers[16] = eye.vertical_fov, numbers[17] = eye.near_m, numbers[18] = eye.far_m;
  if (eye.parallel) numbers[19] = eye.parallel->height_m, numbers[20] = eye.parallel->distance_m;
  if (eye.off_axis)
    numbers[21] = eye.off_axis->left, numbers[22] = eye.off_axis->right, numbers[23] = eye.off_axis->bottom,
    numbers[24] = eye.off_axis->top;
  return numbers;
}

Camera camera_of(const EyeNumbers& numbers) {
  Camera eye;
  std::memcpy(glm::value_ptr(eye.world_from_camera), numbers.data(), 16 * sizeof(float));
  eye.vertical_fov = numbers[16], eye.near_m = numbers[17], eye.far_m = numbers[18];
  if (numbers[19] > 0.0f) eye.parallel = ParallelView{numbers[19], numbers[20]};
  if (numbers[21] != numbers[22])
    eye.off_axis = FrustumTangents{numbers[21], numbers[22], numbers[23], numbers[24]};
  return eye;
}

/// A prepared statement; its arguments are bound in their order.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql) : database_(database) {
    code_ = sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr);
  }
  Statement(const Statement&) = delete;
  ~Statement() { sqlite3_finalize(statement_); }

  void bind(std::int64_t value) { keep(sqlite3_bind_int64(statement_, ++bound_, value)); }
  void bind(double value) { keep(sqlite3_bind_double(statement_, ++bound_, value)); }
  void bind(const std::string& value) {
    keep(sqlite3_bind_text(statement_, ++bound_, value.data(), int(value.size()), SQLITE_TRANSIENT));
  }
  void bind_bytes(const void* data, std::size_t size) {
    keep(sqlite3_bind_blob(statement_, ++bound_, data, int(size), SQLITE_TRANSIENT));
  }
  void bind_nothing() { keep(sqlite3_bind_null(statement_, ++bound_)); }

  /// True: there is a row.
  bool step() {
    if (code_ == SQLITE_OK || code_ == SQLITE_ROW) code_ = sqlite3_step(statement_);
    return code_ == SQLITE_ROW;
  }
  bool has_ended() const { return code_ == SQLITE_DONE; }
  /// Runs it, and makes it ready to be bound again.
  bool run() {
    step();
    const bool is_done = has_ended();
    if (is_done) sqlite3_reset(statement_), code_ = SQLITE_OK, bound_ = 0;
    return is_done;
  }

  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  double number(int column) const { return sqlite3_column_double(statement_, column); }
  std::string text(int column) const {
    const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    return data ? std::string(data, std::size_t(sqlite3_column_bytes(statement_, column))) : std::string();
  }

 private:
  void keep(int code) {
    if (code_ == SQLITE_OK) code_ = code;
  }

  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
  int code_, bound_ = 0;
};

bool execute(sqlite3* database, const char* sql) {
  return sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK;
}

std::int64_t pragma(sqlite3* database, const char* sql) {
  Statement statement(database, sql);
  return statement.step() ? statement.integer(0) : -1;
}

Error failure(sqlite3* database, const std::filesystem::path& file) {
  switch (sqlite3_errcode(database) & 0xff) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
      return error("{}: the log cannot be written ({}); make room, it is tried again", file.string(),
                   sqlite3_errmsg(database));
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return error("{}: another session writes this log; wait for it, or give another --log", file.string());
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return error(
          "{}: the log is damaged or cut ({}); take a copy of it that is whole, or save what is left with: "
          "sqlite3 "
          "\"{}\" .recover",
          file.string(), sqlite3_errmsg(database), file.string());
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
      return error("{}: the log cannot be opened ({}); give a place that can be written by --log",
                   file.string(), sqlite3_errmsg(database));
    default:
      return error("{}: {}", file.string(), sqlite3_errmsg(database));
  }
}

LoggedSession session_in(const Statement& row) {
  return {row.integer(0), row.text(1), row.text(2), row.text(3), int(row.integer(4)), row.number(5)};
}

}  // namespace

bool Frame::operator==(const Frame& other) const {
  return time_us == other.time_us && step_s == other.step_s && frame_ms == other.frame_ms &&
         wand == other.wand && numbers_of(eye) == numbers_of(other.eye);
}

Status check_participant(const std::string& code) {
  const bool is_code = !code.empty() && code.size() <= 40 && std::ranges::all_of(code, [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  if (is_code) return Ok{};
  return error("\"{}\" is no participant code; expected letters, digits, _ or -, as P7 (and nobody's name)",
               code.substr(0, 40));
}

void Log::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

Result<Log> Log::open(const std::filesystem::path& file, int flags) {
  Log log;
  log.file_ = file;
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, flags, nullptr);
  log.database_.reset(opened);
  if (code != SQLITE_OK) return failure(opened, file);
  // The file may be a stranger's: no functions of its schema run, and no value is larger than a study's.
  constexpr int max_value_bytes = 16 << 20, patience_ms = 500;
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, max_value_bytes);
  sqlite3_busy_timeout(opened, patience_ms);
  if (!execute(opened, "PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON; PRAGMA secure_delete=ON;"))
    return failure(opened, file);
  Statement schema(opened, "PRAGMA schema_version");
  if (!schema.step()) return failure(opened, file);
  const bool is_new = schema.integer(0) == 0;
  schema.run();  // it is not left open
  if (is_new && (flags & SQLITE_OPEN_CREATE) != 0) {
    const std::string begin = fmt::format(
        "PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; BEGIN IMMEDIATE; PRAGMA application_id={}; PRAGMA "
        "user_version={}; {}{}{} COMMIT;",
        application_id, version, tables, no_update, no_delete);
    if (!execute(opened, begin.c_str())) return failure(opened, file);
    return log;
  }
  if (pragma(opened, "PRAGMA application_id") != application_id)
    return error("{}: this is no log of a study", file.string());
  if (const std::int64_t found = pragma(opened, "PRAGMA user_version"); found != version)
    return error(
        "{}: the log is of version {}, this program reads version {}; open it with the one that wrote it",
        file.string(), found, version);
  Statement check(opened, "PRAGMA quick_check(1)");
  if (!check.step()) return failure(opened, file);
  if (check.text(0) != "ok")
    return error(
        "{}: the log is damaged or cut ({}); take a copy of it that is whole, or save what is left with: "
        "sqlite3 "
        "\"{}\" .recover",
        file.string(), check.text(0).substr(0, 120), file.string());
  if ((flags & SQLITE_OPEN_CREATE) != 0 &&
      !execute(opened, "PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL;"))
    return failure(opened, file);
  return log;
}

Result<Log> Log::open(const std::filesystem::path& file) {
  return open(file, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
}

Result<Log> Log::read(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code))
    return error("{}: there is no log of sessions here; parvis study run writes one", file.string());
  return open(file, SQLITE_OPEN_READWRITE);
}

Result<std::vector<LoggedSession>> Log::sessions() const {
  Statement rows(database_.get(),
                 "SELECT id, participant, study, script, row, clock_s FROM session ORDER BY id");
  std::vector<LoggedSession> sessions;
  while (rows.step()) sessions.push_back(session_in(rows));
  if (!rows.has_ended()) return failure(database_.get(), file_);
  return sessions;
}

Result<std::optional<LoggedSession>> Log::session_of(const std::string& participant) const {
  Result<std::vector<LoggedSession>> all = sessions();
  if (!all) return all.errors();
  const auto found = std::ranges::find(*all, participant, &LoggedSession::participant);
  return found == all->end() ? std::optional<LoggedSession>() : std::optional(*found);
}

Result<std::vector<Record>> Log::records(std::int64_t session) const {
  std::vector<std::pair<std::int64_t, Record>> numbered;
  Statement events(database_.get(),
                   "SELECT number, time_us, kind, text FROM event WHERE session=? ORDER BY number");
  events.bind(session);
  while (events.step())
    numbered.emplace_back(events.integer(0), Event{events.integer(1), events.text(2), events.text(3)});
  if (!events.has_ended()) return failure(database_.get(), file_);
  Statement frames(
      database_.get(),
      "SELECT number, time_us, step_s, frame_ms, eye, wand FROM frame WHERE session=? ORDER BY number");
  frames.bind(session);
  while (frames.step()) {
    Frame frame{frames.integer(1), frames.number(2), float(frames.number(3)), {}, {}};
    const std::string eye = frames.text(4), wand = frames.text(5);
    EyeNumbers numbers{};
    if (eye.size() != sizeof numbers || (!wand.empty() && wand.size() != sizeof(glm::vec3)))
      return error("{}: record {} of the log is damaged", file_.string(), frames.integer(0));
    std::memcpy(numbers.data(), eye.data(), sizeof numbers);
    frame.eye = camera_of(numbers);
    if (!wand.empty()) {
      glm::vec3 place;
      std::memcpy(glm::value_ptr(place), wand.data(), sizeof place);
      frame.wand = place;
    }
    numbered.emplace_back(frames.integer(0), std::move(frame));
  }
  if (!frames.has_ended()) return failure(database_.get(), file_);
  std::ranges::sort(numbered, {}, &std::pair<std::int64_t, Record>::first);
  std::vector<Record> records;
  for (auto& [number, record] : numbered) records.push_back(std::move(record));
  return records;
}

Result<LoggedSession> Log::begin(LoggedSession session) {
  if (Status status = check_participant(session.participant); !status) return status.errors();
  const Result<std::optional<LoggedSession>> taken = session_of(session.participant);
  if (!taken) return taken.errors();
  if (*taken)
    return error(
        "the participant {} has a session in {} already; give another code, go on with it by --resume, or "
        "delete it: "
        "parvis study forget",
        session.participant, file_.string());
  Statement insert(database_.get(),
                   "INSERT INTO session(participant, study, script, row, clock_s) VALUES(?, ?, ?, ?, ?)");
  insert.bind(session.participant), insert.bind(session.study), insert.bind(session.script);
  insert.bind(std::int64_t(session.row)), insert.bind(session.clock_s);
  if (!insert.run()) return failure(database_.get(), file_);
  session.id = session_ = sqlite3_last_insert_rowid(database_.get());
  number_ = 0;
  return session;
}

Status Log::resume(const LoggedSession& session) {
  Statement last(database_.get(),
                 "SELECT max(coalesce((SELECT max(number) FROM event WHERE session=?1), -1),"
                 " coalesce((SELECT max(number) FROM frame WHERE session=?1), -1))");
  last.bind(session.id);
  if (!last.step()) return failure(database_.get(), file_);
  session_ = session.id, number_ = last.integer(0) + 1;
  return Ok{};
}

Status Log::write_held() {
  Statement event(database_.get(), "INSERT INTO event VALUES(?, ?, ?, ?, ?)"),
      frame(database_.get(), "INSERT INTO frame VALUES(?, ?, ?, ?, ?, ?, ?)");
  std::int64_t number = number_;
  for (const Record& record : held_) {
    if (const Event* happened = std::get_if<Event>(&record)) {
      event.bind(session_), event.bind(number), event.bind(happened->time_us);
      event.bind(happened->kind), event.bind(happened->text);
      if (!event.run()) return failure(database_.get(), file_);
    } else {
      const Frame& shown = std::get<Frame>(record);
      const EyeNumbers eye = numbers_of(shown.eye);
      frame.bind(session_), frame.bind(number), frame.bind(shown.time_us);
      frame.bind(shown.step_s), frame.bind(double(shown.frame_ms)), frame.bind_bytes(eye.data(), sizeof eye);
      shown.wand ? frame.bind_bytes(&*shown.wand, sizeof *shown.wand) : frame.bind_nothing();
      if (!frame.run()) return failure(database_.get(), file_);
    }
    ++number;
  }
  return Ok{};
}

Status Log::flush() {
  if (held_.empty()) return Ok{};
  if (!execute(database_.get(), "BEGIN IMMEDIATE")) return failure(database_.get(), file_);
  Status status = write_held();
  if (status && !execute(database_.get(), "COMMIT")) status = failure(database_.get(), file_);
  if (!status) {
    execute(database_.get(), "ROLLBACK");
    return status;
  }
  number_ += std::int64_t(held_.size());
  held_.clear();
  return Ok{};
}

Status Log::forget(const std::string& participant) {
  const Result<std::vector<LoggedSession>> all = sessions();
  if (!all) return all.errors();
  const auto found = std::ranges::find(*all, participant, &LoggedSession::participant);
  if (found == all->end())
    return error("{} has no participant \"{}\"", file_.string(), participant.substr(0, 40));
  const std::string sql = fmt::format(
      "BEGIN IMMEDIATE; DROP TRIGGER event_kept; DROP TRIGGER frame_kept; DELETE FROM event WHERE "
      "session={0}; "
      "DELETE FROM frame WHERE session={0}; DELETE FROM session WHERE id={0}; {1} COMMIT; VACUUM; "
      "PRAGMA wal_checkpoint(TRUNCATE);",
      found->id, no_delete);
  if (execute(database_.get(), sql.c_str())) return Ok{};
  const Status status = failure(database_.get(), file_);
  execute(database_.get(), "ROLLBACK");
  return status;
}

}  // namespace parvis::study
