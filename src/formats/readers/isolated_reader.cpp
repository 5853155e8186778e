#include "formats/readers/isolated_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/memory_budget.h"
#include "base/openimageio_module.h"
#include "base/sealed_file.h"
#include "formats/readers/model_bytes.h"
#include "formats/readers/packed_file.h"
#include "formats/readers/texture_limit.h"

namespace parvis::formats {
namespace {
namespace fs = std::filesystem;

/// Limits of a reader's time: a start, and more for each megabyte of its file, ten times what the slowest of
/// them was seen to need.
constexpr double start_s = 30.0, s_per_mb = 6.0, max_s = 1800.0;
/// Limits of its memory; the start is for the pictures that a small model may show.
constexpr std::uint64_t start_bytes = std::uint64_t{4} << 30, bytes_per_byte = 256,
                        max_bytes = std::uint64_t{16} << 30;

/// Folders of the system that libraries read: map projections.
constexpr std::array system_folders{"/usr/share/proj", "/usr/share/gdal"};

/// Size up to which a file is read again for its pictures; larger files prepare for pictures before they are
/// read.
constexpr std::uint64_t small_bytes = std::uint64_t{1} << 20;

/// The part of `ModelReading` that travels.
struct Order {
  UpAxis up;
  bool has_detail, has_cell;
  double max_detail, cell_m;
};

void append_text(std::string& bytes, const std::string& text) {
  append_value(bytes, std::uint64_t(text.size()));
  bytes += text;
}

std::string take_text(ByteReader& reader) {
  return std::string(reader.take_bytes(reader.take<std::uint64_t>()));
}

/// A place on the earth as it travels back; not a number where the file says none.
glm::dvec2 place_to_send(const std::optional<glm::dvec2>& place_deg) {
  return place_deg.value_or(glm::dvec2(std::numeric_limits<double>::quiet_NaN()));
}

std::optional<glm::dvec2> take_place(ByteReader& reader) {
  const glm::dvec2 deg = reader.take<glm::dvec2>();
  const bool is_on_earth = std::abs(deg.x) <= 180.0 && std::abs(deg.y) <= 90.0;
  return is_on_earth ? std::optional(deg) : std::nullopt;
}

}  // namespace

IsolationLimits limits_for(const fs::path& file) {
  IsolationLimits limits;
  std::error_code code;
  const std::uint64_t size = likely_content_bytes(file);
  limits.seconds = std::min(start_s + s_per_mb * 1e-6 * double(size), max_s);
  constexpr std::uint64_t full_size = (max_bytes - start_bytes) / bytes_per_byte;
  limits.memory_bytes = start_bytes + bytes_per_byte * std::min(size, full_size);
  limits.readable.push_back(fs::weakly_canonical(file, code).parent_path());
  limits.readable.insert(limits.readable.end(), system_folders.begin(), system_folders.end());
  return limits;
}

std::string bytes_of_warnings(const Errors& warnings) {
  std::string bytes;
  append_value(bytes, std::uint64_t(warnings.size()));
  for (const Error& warning : warnings) {
    append_text(bytes, warning.message);
    append_text(bytes, warning.where.file);
    append_value(bytes, warning.where.line);
    append_value(bytes, warning.where.column);
  }
  return bytes;
}

void take_warnings(ByteReader& reader, Errors& warnings) {
  for (auto left = reader.take<std::uint64_t>(); left > 0 && !reader.has_ended_early(); --left) {
    Error& warning = warnings.emplace_back();
    warning.message = take_text(reader);
    warning.where.file = take_text(reader);
    warning.where.line = reader.take<int>();
    warning.where.column = reader.take<int>();
  }
}

std::string bytes_of_account(const scene::FileAccount& account) {
  std::string bytes;
  append_text(bytes, account.format());
  append_value(bytes, std::uint64_t(account.lines().size()));
  for (const scene::AccountLine& line : account.lines()) {
    append_value(bytes, line.fate);
    append_text(bytes, line.kind), append_text(bytes, line.reason);
    append_value(bytes, std::uint64_t(line.count));
    append_value(bytes, std::uint64_t(line.names.size()));
    for (const std::string& name : line.names) append_text(bytes, name);
  }
  return bytes;
}

scene::FileAccount take_account(ByteReader& reader) {
  scene::FileAccount account(take_text(reader));
  for (auto left = reader.take<std::uint64_t>(); left > 0 && !reader.has_ended_early(); --left) {
    const auto fate = std::min(reader.take<std::uint8_t>(), std::uint8_t(scene::Fate::left_out));
    const std::string kind = take_text(reader), reason = take_text(reader);
    const auto count = std::size_t(reader.take<std::uint64_t>());
    auto names = reader.take<std::uint64_t>();
    account.add(scene::Fate(fate), kind, reason, "", count);
    for (; names > 0 && !reader.has_ended_early(); --names) account.name_last(take_text(reader));
  }
  return account;
}

Status read_in_worker(ReadFunction* read, std::string_view input, IsolatedOutput& output) {
  ByteReader reader(input);
  const Order order = reader.take<Order>();
  ModelReading reading;
  reading.up = order.up;
  if (order.has_detail) reading.max_detail = order.max_detail;
  if (order.has_cell) reading.cell_m = order.cell_m;
  reading.map = take_text(reader);
  const fs::path file = take_text(reader);
  if (likely_content_bytes(file) > small_bytes) std::ignore = openimageio.functions();
  std::optional<glm::dvec2> place_deg;
  reading.place_deg = &place_deg;
  Errors warnings;
  const LeftInWorker<Result<FileContent>> read_content(
      new Result<FileContent>(read(file, reading, warnings)));
  Result<FileContent>& content = *read_content;
  if (!content) return content.errors();
  limit_textures(content->model, content->account);
  const scene::Model& model = content->model;
  std::string front = bytes_of_warnings(warnings) + bytes_of_account(content->account);
  append_value(front, place_to_send(place_deg));
  const std::uint64_t size = byte_count(model);
  if (Status status = check_memory(size, file.string() + ": its content"); !status) return status;
  const std::span<std::byte> bytes = output.allocate(front.size() + std::size_t(size));
  if (bytes.empty()) return error("{}: there is no memory for its {} bytes", file.string(), size);
  std::memcpy(bytes.data(), front.data(), front.size());
  put_bytes(model, bytes.subspan(front.size()));
  return Ok{};
}

Result<FileContent> read_isolated(IsolatedWork work, const fs::path& file, const ModelReading& reading,
                                  Errors& warnings) {
  const std::string subject = file.string();
  if (reading.ground) return error("{}: its reader knows no ground=; leave it out", subject);
  std::string input;
  append_value(input, Order{reading.up, reading.max_detail.has_value(), reading.cell_m.has_value(),
                            reading.max_detail.value_or(0.0), reading.cell_m.value_or(0.0)});
  append_text(input, reading.map), append_text(input, fs::absolute(file).string());
  const Result<IsolatedBytes> made = run_isolated(work, input, subject, limits_for(file));
  if (!made) return made.errors();
  const std::string_view bytes(reinterpret_cast<const char*>(made->bytes().data()), made->bytes().size());
  ByteReader reader(bytes);
  take_warnings(reader, warnings);
  scene::FileAccount account = take_account(reader);
  const std::optional<glm::dvec2> place_deg = take_place(reader);
  if (reading.place_deg) *reading.place_deg = place_deg;
  if (Status status = check_memory(reader.rest().size(), subject + ": its content"); !status)
    return status.errors();
  Result<scene::Model> model = model_of(reader.rest(), subject);
  if (!model) return model.errors();
  return FileContent{*std::move(model), std::move(account)};
}

}  // namespace parvis::formats
