#include "capture/photographs/colmap_database.h"

#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>

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

}  // namespace

ColmapProgress colmap_progress(const std::filesystem::path& database) {
  std::error_code ignored;
  if (!std::filesystem::exists(database, ignored)) return {};
  return {count(database, "SELECT COUNT(*) FROM descriptors"),
          count(database, "SELECT COUNT(*) FROM two_view_geometries")};
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

}  // namespace parvis::photographs
