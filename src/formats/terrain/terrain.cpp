#include "formats/terrain/terrain.h"

#include <algorithm>
#include <cmath>

#include "formats/terrain/height_grid.h"
#include "land/heights/city_surfaces.h"

namespace parvis::scene {
namespace {

constexpr int tile_cells = 64;

bool has_height(const HeightGrid& grid, int column, int row) { return std::isfinite(grid.at(column, row).z); }

/// The lowest sample's height and the middle of the map, in whole metres.
std::optional<glm::dvec3> origin_of(const HeightGrid& grid) {
  double min_m = std::numeric_limits<double>::max();
  for (const glm::dvec3& point : grid.points)
    if (std::isfinite(point.z)) min_m = std::min(min_m, point.z);
  if (min_m == std::numeric_limits<double>::max()) return std::nullopt;
  if (!grid.has_place) return glm::dvec3(0.0);
  const glm::dvec3& middle = grid.at(grid.columns / 2, grid.rows / 2);
  return glm::floor(glm::dvec3(middle.x, middle.y, min_m));
}

/// The normal by the neighbours that exist, at most two along each axis.
glm::vec3 normal_at(const HeightGrid& grid, int column, int row) {
  const auto along = [&](int columns, int rows) {
    const auto neighbour = [&](int sign) {
      const int c = std::clamp(column + sign * columns, 0, grid.columns - 1),
                r = std::clamp(row + sign * rows, 0, grid.rows - 1);
      return has_height(grid, c, r) ? grid.at(c, r) : grid.at(column, row);
    };
    const glm::dvec3 step = neighbour(1) - neighbour(-1);
    return glm::length(step) > 0.0 ? step : glm::dvec3(columns, -rows, 0);
  };
  const glm::dvec3 normal = glm::cross(along(0, 1), along(1, 0));
  const double length = glm::length(normal);
  if (!(length > 0.0)) return {0.0f, 0.0f, 1.0f};
  return glm::vec3(normal.z < 0.0 ? -normal / length : normal / length);
}

/// The samples of one tile, and the triangles between those that have a height, facing up.
Mesh tile(const HeightGrid& grid, const glm::dvec3& origin, int first_column, int first_row) {
  const int columns = std::min(tile_cells, grid.columns - 1 - first_column) + 1,
            rows = std::min(tile_cells, grid.rows - 1 - first_row) + 1;
  Mesh mesh;
  std::vector<int> vertex_of(std::size_t(columns) * std::size_t(rows), no_index);
  const auto vertex = [&](int c, int r) {
    return vertex_of[std::size_t(r) * std::size_t(columns) + std::size_t(c)];
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      if (!has_height(grid, first_column + c, first_row + r)) continue;
      vertex_of[std::size_t(r) * std::size_t(columns) + std::size_t(c)] = int(mesh.positions.size());
      const glm::vec3 point(grid.at(first_column + c, first_row + r) - origin);
      mesh.positions.push_back(point);
      mesh.normals.push_back(normal_at(grid, first_column + c, first_row + r));
      mesh.uvs.emplace_back(point.x, -point.y);
    }
  const auto add = [&](int a, int b, int c) {
    if (std::min({a, b, c}) == no_index) return;
    const auto at = [&](int v) { return glm::vec2(mesh.positions[std::size_t(v)]); };
    const glm::vec2 ab = at(b) - at(a), ac = at(c) - at(a);
    if (ab.x * ac.y - ab.y * ac.x < 0.0f) std::swap(b, c);
    for (const int v : {a, b, c}) mesh.indices.push_back(std::uint32_t(v));
  };
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      const int nw = vertex(c, r), ne = vertex(c + 1, r), sw = vertex(c, r + 1), se = vertex(c + 1, r + 1);
      // across the diagonal whose ends are there: beside a hole, half a cell stays
      if (nw != no_index && se != no_index)
        add(nw, sw, se), add(nw, se, ne);
      else
        add(nw, sw, ne), add(sw, se, ne);
    }
  return mesh;
}

void account_for(const HeightGrid& grid, FileAccount& account) {
  const std::size_t holes = std::size_t(
      std::ranges::count_if(grid.points, [](const glm::dvec3& point) { return !std::isfinite(point.z); }));
  const std::size_t all = std::size_t(grid.file_columns) * std::size_t(grid.file_rows);
  if (grid.height_unit_m != 1.0)
    account.changed("samples", fmt::format("their unit of {:.6g} m becomes metres", grid.height_unit_m), "",
                    grid.points.size() - holes);
  else
    account.used("samples", grid.points.size() - holes);
  account.unneeded("samples", "they are holes: by value, mask or alpha", "", holes - grid.undeclared_holes);
  account.changed("samples", "-9999 and its like, which the file does not declare, are taken for holes", "",
                  grid.undeclared_holes);
  account.changed("samples", "those between the ones that are taken are left to interpolation", "",
                  all - std::min(all, grid.points.size()));
  if (grid.bands > 1)
    account.left_out("bands", "the first alone is read, as heights", "", std::size_t(grid.bands - 1));
}

}  // namespace

Result<Model> read_terrain(const std::filesystem::path& file, std::optional<double> cell_m, Errors& warnings,
                           std::optional<glm::dvec2>* place_deg, const std::string& map,
                           FileAccount* account) {
  const Result<HeightGrid> grid = read_height_grid(file, cell_m, warnings, map);
  if (!grid) return grid.errors();
  const FileLocation where{file.string(), 0, 0};
  const std::optional<glm::dvec3> origin = origin_of(*grid);
  if (!origin) return error_at(where, "this grid is all holes: no sample has a height");
  Model model;
  model.name = file.stem().string();
  model.origin = *origin;
  model.map = grid->map, model.true_north_deg = grid->true_north_deg;
  if (place_deg) *place_deg = grid->place_deg;
  if (account) account_for(*grid, *account);
  model.nodes.front().name = model.name;
  model.materials.push_back(surface_material("TINRelief"));
  for (int row = 0; row + 1 < grid->rows; row += tile_cells)
    for (int column = 0; column + 1 < grid->columns; column += tile_cells) {
      Mesh mesh = tile(*grid, *origin, column, row);
      if (mesh.indices.empty()) continue;
      if (const Status status = check(mesh, "terrain"); !status)
        return Error{status.errors().front().message, where};
      model.parts.push_back({"TINRelief", std::move(mesh), 0, 0, true});
    }
  if (model.parts.empty()) return error_at(where, "this grid has no three samples side by side with heights");
  return model;
}

}  // namespace parvis::scene
