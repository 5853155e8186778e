#include "capture/trees/matte_folder.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "base/content_hash.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/kept_parts.h"
#include "base/known_names.h"
#include "base/path_inside.h"
#include "base/progress.h"
#include "base/sealed_file.h"

namespace parvis::trees {
namespace {
namespace fs = std::filesystem;

constexpr std::uint64_t record_version = 1;  // of the records' content
constexpr int matte_version = 1;             // to be raised whenever the same input gives another matte
constexpr double max_covered_edges = 0.2;    // of whole plants: a branch may be cut
constexpr std::uint8_t covered_from = 26;    // alpha, a tenth: background that is half taken for plant counts
const std::string records = ".mattes";       // below the output

/// The pictures of a folder, by name.
std::vector<fs::path> pictures_of(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".JPG")
      files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// Hashes of a matte and of its sources.
struct Record {
  std::uint64_t sources = 0, matte = 0;
};

std::uint64_t hash_of(const Image8& picture) {
  ContentHash hash;
  hash.add(picture.width), hash.add(picture.height), hash.add(picture.channels), hash.add(picture.pixels);
  return hash.value();
}

/// Which part of the left, upper and right edges of a picture is opaque.
double edges_covered(const Image8& rgba) {
  int covered = 0;
  const auto count = [&](int x, int y) { covered += rgba.at(x, y)[3] >= covered_from; };
  for (int x = 0; x < rgba.width; ++x) count(x, 0);
  for (int y = 0; y < rgba.height; ++y) count(0, y), count(rgba.width - 1, y);
  return double(covered) / (rgba.width + 2 * rgba.height);
}

/// One photograph on its way to its matte.
class MatteFile {
 public:
  MatteFile(const MatteFolder& folder, const fs::path& photograph)
      : folder_(folder),
        photograph_(photograph),
        output_(folder.output / (photograph.stem().string() + ".png")),
        records_(folder.output / records) {
    const fs::path painted = folder.zones / (photograph.stem().string() + ".png");
    if (!folder.zones.empty() && fs::exists(painted)) painted_ = painted;
  }

  /// Adds to the counts what became of it.
  Status make(MatteCounts& counts) const {
    const Result<fs::path> inside = path_inside(folder_.photographs, photograph_.filename());
    if (!inside) return inside.errors();
    const Result<std::uint64_t> sources = hash_of_sources();
    if (!sources) return sources.errors();
    if (fs::exists(output_)) {
      const std::optional<Record> record = recorded();
      if (record && record->sources == *sources) return ++counts.up_to_date, Ok{};
      if (!is_as_made(record)) {
        fmt::print(stderr,
                   "warning: {}: is not as parvis tree matte made it, and is kept; remove it to have "
                   "it made afresh\n",
                   output_.string());
        return ++counts.foreign, Ok{};
      }
    }
    const Result<Image8> rgba = matte_of_photograph();
    if (!rgba) return rgba.errors();
    if (const double covered = edges_covered(*rgba); covered > max_covered_edges) {
      ++counts.doubtful;
      fmt::print(
          stderr,
          "warning: {}: its matte covers {:.0f} % of the picture's sides and upper edge, more than that of a "
          "plant that was photographed whole: background was taken for plant; paint zones for it "
          "(--zones)\n",
          photograph_.string(), 100.0 * covered);
    }
    // The old matte goes before its record does: whoever interrupts this finds no matte, and not one that
    // looks like somebody's own.
    std::error_code code;
    fs::remove(output_, code);
    if (Status status = keep({*sources, hash_of(*rgba)}); !status) return status;
    if (Status status = write_image(output_, *rgba); !status) return status;
    return ++counts.made, Ok{};
  }

 private:
  Result<std::uint64_t> hash_of_sources() const {
    ContentHash hash;
    hash.add(matte_version), hash.add(folder_.method);
    for (const std::optional<fs::path>& file : {std::optional(photograph_), painted_}) {
      hash.add(file.has_value());
      if (!file) continue;
      const Result<std::string> bytes = read_file(*file);
      if (!bytes) return bytes.errors();
      hash.add_text(*bytes);
    }
    return hash.value();
  }

  std::optional<Record> recorded() const {
    const std::optional<std::string> bytes = records_.find(output_.stem().string(), record_version);
    if (!bytes) return std::nullopt;
    ByteReader reader(*bytes);
    const auto record = reader.take<Record>();
    return reader.is_at_end() ? std::optional(record) : std::nullopt;
  }

  Status keep(const Record& record) const {
    std::string bytes;
    append_value(bytes, record);
    return records_.keep(output_.stem().string(), record_version, bytes);
  }

  /// Whether the picture in its place is the recorded one.
  bool is_as_made(const std::optional<Record>& record) const {
    if (!record) return false;
    const Result<Image8> there = read_image8(output_);
    return there.ok() && hash_of(*there) == record->matte;
  }

  Result<Image8> matte_of_photograph() const {
    const std::string name = photograph_.filename().string();
    const Result<Image8> photograph = read_image8(photograph_);
    if (!photograph) return photograph.errors();
    Result<Zones> zones = Zones();
    if (painted_) {
      const Result<Image8> scribbles = read_image8(*painted_);
      if (!scribbles) return scribbles.errors();
      zones = zones_of_scribbles(*scribbles, photograph->width, photograph->height, name);
    } else if (has_matte(*photograph)) {
      return *photograph;
    } else {
      zones = zones_of_plain_background(*photograph, name);
      if (!zones)
        if (Result<Zones> sky = zones_of_sky(*photograph, name); sky) zones = std::move(sky);
    }
    if (!zones) return zones.errors();
    return matte(*photograph, *zones, name, folder_.method);
  }

  const MatteFolder& folder_;
  fs::path photograph_, output_;
  std::optional<fs::path> painted_;
  KeptParts records_;
};

}  // namespace

Result<MatteCounts> write_mattes(const MatteFolder& folder) {
  const std::vector<fs::path> files = pictures_of(folder.photographs);
  if (files.empty()) return error("{}: no .png or .jpg pictures are there", folder.photographs.string());
  if (const std::string missing = folder.zones.empty() ? "" : missing_folder(folder.zones); !missing.empty())
    return error("--zones {}: {}", folder.zones.string(), missing);
  std::error_code code;
  fs::create_directories(folder.output, code);
  if (code) return error("{}: the folder cannot be made: {}", folder.output.string(), code.message());
  std::map<fs::path, fs::path> file_of;
  for (const fs::path& file : files)
    if (const auto [known, is_new] = file_of.try_emplace(file.stem(), file); !is_new)
      return error("{} and {} would have the same matte; rename one of them", known->second.string(),
                   file.string());
  Progress progress("mattes", files.size());
  MatteCounts counts;
  Errors problems;
  for (const fs::path& file : files) {
    if (const Status status = MatteFile(folder, file).make(counts); !status)
      problems.insert(problems.end(), status.errors().begin(), status.errors().end());
    progress.advance();
  }
  if (!problems.empty()) return problems;
  return counts;
}

}  // namespace parvis::trees
