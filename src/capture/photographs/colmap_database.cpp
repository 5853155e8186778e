#include "capture/photographs/colmap_database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <span>

namespace parvis::photographs {
namespace {

/// Two images share one number: COLMAP's pair_id.
constexpr std::int64_t max_images = 2147483647;

/// Calls `row` for each row of a query. A database that is busy, damaged or absent has no rows.
void query(const std::filesystem::path& database, const char* text,
           const std::function<void(sqlite3_stmt*)>& row) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(database.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> connection(opened, sqlite3_close);
  if (code != SQLITE_OK) return;
  sqlite3_busy_timeout(opened, 100);
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(opened, text, -1, &prepared, nullptr) != SQLITE_OK) return;
  const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement(prepared, sqlite3_finalize);
  while (sqlite3_step(prepared) == SQLITE_ROW) row(prepared);
}

std::size_t count(const std::filesystem::path& database, const char* text) {
  std::size_t result = 0;
  query(database, text, [&](sqlite3_stmt* row) {
    result = std::size_t(std::max<sqlite3_int64>(sqlite3_column_int64(row, 0), 0));
  });
  return result;
}

/// A column's bytes, which live until the next row.
std::span<const std::uint8_t> bytes_of(sqlite3_stmt* row, int column) {
  const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(row, column));
  return {bytes, bytes ? std::size_t(sqlite3_column_bytes(row, column)) : 0};
}

/// Where keypoints are, and their sizes.
struct Keypoints {
  std::vector<glm::vec2> pixels;
  std::vector<float> sizes;
};

/// Keypoints of rows of x, y, then size and angle, or an affine shape a11 a12 a21 a22.
Keypoints keypoints_of(std::span<const std::uint8_t> bytes, std::size_t columns) {
  Keypoints keypoints;
  if (columns != 4 && columns != 6) return keypoints;
  for (std::size_t at = 0; at + columns * sizeof(float) <= bytes.size(); at += columns * sizeof(float)) {
    float k[6] = {};
    std::memcpy(k, bytes.data() + at, columns * sizeof(float));
    keypoints.pixels.emplace_back(k[0], k[1]);
    keypoints.sizes.push_back(columns == 4 ? k[2] : 0.5f * (std::hypot(k[2], k[4]) + std::hypot(k[3], k[5])));
  }
  return keypoints;
}

/// Adds features, the largest first; none where the two lists differ in length.
void add_features(const Keypoints& keypoints, std::span<const std::uint8_t> descriptors,
                  PictureFeatures& to) {
  const std::vector<float>& sizes = keypoints.sizes;
  if (descriptors.size() != sizes.size() * descriptor_bytes) return;
  to.pixels = keypoints.pixels;
  to.numbers.resize(sizes.size());
  std::iota(to.numbers.begin(), to.numbers.end(), 0u);
  std::ranges::stable_sort(to.numbers, std::greater{}, [&](std::uint32_t i) { return sizes[i]; });
  to.descriptors.reserve(descriptors.size());
  for (const std::uint32_t number : to.numbers) {
    const auto one = descriptors.subspan(number * descriptor_bytes, descriptor_bytes);
    to.descriptors.insert(to.descriptors.end(), one.begin(), one.end());
  }
}

}  // namespace

ColmapProgress colmap_progress(const std::filesystem::path& database) {
  std::error_code ignored;
  if (!std::filesystem::exists(database, ignored)) return {};
  return {count(database, "SELECT COUNT(*) FROM descriptors"),
          count(database, "SELECT COUNT(*) FROM two_view_geometries")};
}

std::vector<PictureFeatures> picture_features(const std::filesystem::path& database) {
  std::vector<PictureFeatures> pictures;
  query(database,
        "SELECT images.name, keypoints.cols, keypoints.data, descriptors.data FROM images "
        "LEFT JOIN keypoints ON keypoints.image_id = images.image_id "
        "LEFT JOIN descriptors ON descriptors.image_id = images.image_id ORDER BY images.image_id",
        [&](sqlite3_stmt* row) {
          const auto* name = sqlite3_column_text(row, 0);
          if (!name) return;
          pictures.push_back({reinterpret_cast<const char*>(name), {}, {}, {}});
          const std::size_t columns = std::size_t(std::max(sqlite3_column_int(row, 1), 0));
          add_features(keypoints_of(bytes_of(row, 2), columns), bytes_of(row, 3), pictures.back());
        });
  return pictures;
}

std::map<std::string, int> best_agreement(const std::filesystem::path& database) {
  std::map<std::int64_t, std::string> names;
  std::map<std::string, int> best;
  query(database, "SELECT image_id, name FROM images", [&](sqlite3_stmt* row) {
    const auto* name = sqlite3_column_text(row, 1);
    if (!name) return;
    names[sqlite3_column_int64(row, 0)] = reinterpret_cast<const char*>(name);
    best[reinterpret_cast<const char*>(name)] = 0;
  });
  query(database, "SELECT pair_id, rows FROM two_view_geometries", [&](sqlite3_stmt* row) {
    const std::int64_t pair = sqlite3_column_int64(row, 0);
    for (const std::int64_t id : {pair % max_images, pair / max_images})
      if (const auto name = names.find(id); name != names.end())
        best[name->second] = std::max(best[name->second], sqlite3_column_int(row, 1));
  });
  return best;
}

Status number_by_name(const std::filesystem::path& database) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(database.c_str(), &opened, SQLITE_OPEN_READWRITE, nullptr);
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> connection(opened, sqlite3_close);
  if (code != SQLITE_OK) return error("{}: cannot be opened ({})", database.string(), sqlite3_errmsg(opened));
  sqlite3_busy_timeout(opened, 10000);
  // By way of numbers beyond all others, since each must be unique at all times.
  std::string text =
      "BEGIN;CREATE TEMP TABLE numbers AS SELECT image_id AS old, "
      "ROW_NUMBER() OVER (ORDER BY name) AS new FROM images;";
  for (const char* table : {"images", "keypoints", "descriptors"})
    text += fmt::format(
        "UPDATE {0} SET image_id={1}+(SELECT new FROM numbers WHERE old=image_id);"
        "UPDATE {0} SET image_id=image_id-{1};",
        table, max_images / 2);
  text += "COMMIT;";
  if (sqlite3_exec(opened, text.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    return error("{}: its pictures cannot be numbered ({})", database.string(), sqlite3_errmsg(opened));
  return Ok{};
}

}  // namespace parvis::photographs
