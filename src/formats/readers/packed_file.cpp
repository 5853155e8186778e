#include "formats/readers/packed_file.h"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <span>

#include "base/file_front.h"
#include "base/files.h"
#include "base/memory_budget.h"

namespace parvis::formats {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t piece_bytes = std::size_t{1} << 20;  // unpacked at a time
/// Size of the front of a packed file in which the first bytes of its content lie: a block of bzip2 is
/// smaller.
constexpr std::size_t packed_front_bytes = std::size_t{1} << 20;
/// XML and JSON with many blanks unpack to some 50 times their size. What unpacks to far more than that was
/// made to fill the memory; small files may.
constexpr std::uint64_t max_ratio = 250, harmless_bytes = std::uint64_t{64} << 20;
constexpr std::uint64_t usual_ratio = 20;  // of city models and maps
constexpr std::string_view gzip_mark = "\x1f\x8b", bzip2_mark = "BZh";

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// The name without the extension of a packing.
fs::path unpacked_name(const fs::path& file) {
  const std::string extension = lower_case(file.extension().string());
  return extension == ".gz" || extension == ".bz2" ? file.stem() : file.filename();
}

/// The remaining packed bytes, and the room for unpacked ones.
struct Flow {
  std::string_view packed;
  std::span<char> room;
};

enum class Outcome : unsigned char { continues, stream_ended, damaged };

class GzipStream {
 public:
  static constexpr std::string_view mark = gzip_mark;
  static constexpr const char* name = "gzip";

  GzipStream() { open(); }
  ~GzipStream() { inflateEnd(&stream_); }
  GzipStream(const GzipStream&) = delete;
  GzipStream& operator=(const GzipStream&) = delete;

  Outcome run(Flow& flow) {
    if (!is_open_) return Outcome::damaged;
    const std::size_t given = std::min(flow.packed.size(), piece_bytes);
    // zlib only reads what it calls not constant.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(flow.packed.data()));
    stream_.avail_in = uInt(given);
    stream_.next_out = reinterpret_cast<Bytef*>(flow.room.data());
    stream_.avail_out = uInt(flow.room.size());
    const int code = inflate(&stream_, Z_NO_FLUSH);
    flow.packed.remove_prefix(given - stream_.avail_in);
    flow.room = flow.room.last(stream_.avail_out);
    if (code == Z_STREAM_END) return Outcome::stream_ended;
    return code == Z_OK || code == Z_BUF_ERROR ? Outcome::continues : Outcome::damaged;
  }
  void restart() { is_open_ = inflateReset(&stream_) == Z_OK; }

 private:
  void open() {
    constexpr int largest_window = 15, with_gzip_header = 16;
    is_open_ = inflateInit2(&stream_, largest_window + with_gzip_header) == Z_OK;
  }

  z_stream stream_{};
  bool is_open_ = false;
};

class Bzip2Stream {
 public:
  static constexpr std::string_view mark = bzip2_mark;
  static constexpr const char* name = "bzip2";

  Bzip2Stream() { open(); }
  ~Bzip2Stream() { BZ2_bzDecompressEnd(&stream_); }
  Bzip2Stream(const Bzip2Stream&) = delete;
  Bzip2Stream& operator=(const Bzip2Stream&) = delete;

  Outcome run(Flow& flow) {
    if (!is_open_) return Outcome::damaged;
    const std::size_t given = std::min(flow.packed.size(), piece_bytes);
    stream_.next_in = const_cast<char*>(flow.packed.data());  // which it only reads
    stream_.avail_in = unsigned(given);
    stream_.next_out = flow.room.data();
    stream_.avail_out = unsigned(flow.room.size());
    const int code = BZ2_bzDecompress(&stream_);
    flow.packed.remove_prefix(given - stream_.avail_in);
    flow.room = flow.room.last(stream_.avail_out);
    if (code == BZ_STREAM_END) return Outcome::stream_ended;
    return code == BZ_OK ? Outcome::continues : Outcome::damaged;
  }
  void restart() {
    BZ2_bzDecompressEnd(&stream_);
    stream_ = {};
    open();
  }

 private:
  void open() { is_open_ = BZ2_bzDecompressInit(&stream_, 0, 0) == BZ_OK; }

  bz_stream stream_{};
  bool is_open_ = false;
};

struct UnpackLimits {
  std::uint64_t max_bytes;  ///< of content: more is an error
  std::size_t enough;       ///< bytes after which no more is needed
  bool may_end_early;       ///< only the beginning of the file is given
};

/// Room for one more piece, asked for before it is taken.
Status make_room(std::string& text, const std::string& subject) {
  if (text.size() + piece_bytes <= text.capacity()) return Ok{};
  const std::size_t wanted = 2 * text.capacity() + piece_bytes;
  if (Status enough = check_memory(wanted, "unpacking " + subject); !enough) return enough.errors();
  text.reserve(wanted);
  return Ok{};
}

template <class Stream>
Result<std::string> unpacked(std::string_view packed, const UnpackLimits& limits,
                             const std::string& subject) {
  Stream stream;
  std::string text;
  const std::uint64_t packed_bytes = packed.size();
  for (bool is_at_end = false; !is_at_end && text.size() < limits.enough;) {
    const std::size_t before = text.size();
    if (before > limits.max_bytes)
      return error("{}: unpacks to more than the {:.1f} MB that are read", subject,
                   double(limits.max_bytes) / 1e6);
    if (before > harmless_bytes && before > max_ratio * packed_bytes)
      return error(
          "{}: unpacks to more than {} times its size, which models do not: it is refused, for it may be "
          "made "
          "to fill the memory. If you trust it, unpack it by yourself",
          subject, max_ratio);
    if (Status room = make_room(text, subject); !room) return room.errors();
    text.resize(before + piece_bytes);
    Flow flow{packed, std::span(text).subspan(before)};
    const Outcome outcome = stream.run(flow);
    const bool stands_still = flow.packed.size() == packed.size() && flow.room.size() == piece_bytes;
    packed = flow.packed;
    text.resize(text.size() - flow.room.size());
    if (outcome == Outcome::damaged)
      return error("{}: its packing ({}) is damaged near byte {}; download it again", subject, Stream::name,
                   packed_bytes - packed.size());
    if (outcome == Outcome::stream_ended) {
      is_at_end = !packed.starts_with(Stream::mark);  // what follows the last stream is padding
      if (!is_at_end) stream.restart();
    } else if (stands_still) {
      if (limits.may_end_early) break;
      return error("{}: its packing ({}) ends too early: the file is cut short; download it again", subject,
                   Stream::name);
    }
  }
  if (text.size() > limits.enough) text.resize(limits.enough);
  return text;
}

Result<std::string> content_of(std::string bytes, const UnpackLimits& limits, const std::string& subject) {
  switch (packing_of(bytes)) {
    case Packing::gzip:
      return unpacked<GzipStream>(bytes, limits, subject);
    case Packing::bzip2:
      return unpacked<Bzip2Stream>(bytes, limits, subject);
    case Packing::none:
      break;
  }
  if (bytes.size() > limits.enough) bytes.resize(limits.enough);
  return bytes;
}

}  // namespace

Packing packing_of(std::string_view front) {
  if (front.starts_with(gzip_mark)) return Packing::gzip;
  return front.starts_with(bzip2_mark) ? Packing::bzip2 : Packing::none;
}

std::string model_extension(const fs::path& file) {
  return lower_case(unpacked_name(file).extension().string());
}

std::string model_stem(const fs::path& file) { return unpacked_name(file).stem().string(); }

Result<std::string> read_unpacked(const fs::path& file, std::uint64_t max_bytes) {
  Result<std::string> bytes = read_file(file, max_bytes);
  if (!bytes) return bytes.errors();
  return content_of(*std::move(bytes), {max_bytes, std::string().max_size(), false}, file.string());
}

Result<std::string> read_unpacked(const fs::path& file) { return read_unpacked(file, max_file_bytes); }

Result<std::string> unpacked_front(const fs::path& file, std::size_t count) {
  Result<std::string> front = read_front(file, count);
  if (!front || packing_of(*front) == Packing::none) return front;
  front = read_front(file, packed_front_bytes);
  if (!front) return front.errors();
  return content_of(*std::move(front), {max_file_bytes, count, true}, file.string());
}

std::uint64_t likely_content_bytes(const fs::path& file) {
  std::error_code code;
  const std::uintmax_t size = fs::file_size(file, code);
  if (code) return 0;
  constexpr std::size_t mark_bytes = 8;
  const Result<std::string> front = read_front(file, mark_bytes);
  const bool is_packed = front && packing_of(*front) != Packing::none;
  const std::uint64_t largest = max_file_bytes / usual_ratio;
  return is_packed ? usual_ratio * std::min<std::uint64_t>(size, largest) : size;
}

}  // namespace parvis::formats
