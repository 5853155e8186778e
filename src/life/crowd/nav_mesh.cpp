#include "life/crowd/nav_mesh.h"

#include <DetourNavMesh.h>
#include <DetourNavMeshBuilder.h>
#include <DetourNavMeshQuery.h>
#include <Recast.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/disjoint_sets.h"
#include "base/parallel.h"

namespace parvis::crowd {
namespace {

constexpr int tile_cells = 224;
constexpr float cell_height_m = 0.05f;
constexpr int climb_cells = 5;
constexpr float max_extent_m = 16'000.0f, max_tile_height_m = 400.0f;
constexpr int corners_per_polygon = 6;
constexpr std::size_t max_polygons_of_way = 2048, max_corners = 512;
constexpr float search_height_m = 1.2f;
constexpr float any_height_m = 1000.0f;

constexpr unsigned char floor_area = 1, road_area = 2, crossing_area = 3;

// Recast's y is up: Parvis's (x, y, z) is (x, z, -y).
std::array<float, 3> to_recast(glm::vec3 p) { return {p.x, p.z, -p.y}; }
glm::vec3 to_house(const float* p) { return {p[0], -p[2], p[1]}; }

template <class T, void (*free)(T*)>
struct Freed {
  void operator()(T* object) const { free(object); }
};
template <class T, void (*free)(T*)>
using Owned = std::unique_ptr<T, Freed<T, free>>;
using Heightfield = Owned<rcHeightfield, rcFreeHeightField>;
using Compact = Owned<rcCompactHeightfield, rcFreeCompactHeightfield>;
using Contours = Owned<rcContourSet, rcFreeContourSet>;
using Polygons = Owned<rcPolyMesh, rcFreePolyMesh>;
using Details = Owned<rcPolyMeshDetail, rcFreePolyMeshDetail>;

unsigned char area_of(const WalkingGround& ground, std::size_t triangle, float min_up) {
  const glm::vec3* c = &ground.corners[3 * triangle];
  const glm::vec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
  const float length = glm::length(normal);
  if (!(length > 0.0f) || std::abs(normal.z) < min_up * length) return RC_NULL_AREA;
  switch (ground.kinds[triangle]) {
    case GroundKind::floor:
      return floor_area;
    case GroundKind::road:
      return road_area;
    case GroundKind::crossing:
      return crossing_area;
    case GroundKind::obstacle:
      break;
  }
  return RC_NULL_AREA;
}

/// Marks the ground of strips: quads along their middle lines, a little longer than they are.
void mark_strips(rcContext& context, std::span<const RoadStrip> roads, unsigned char area, float longer_m,
                 rcCompactHeightfield& compact) {
  constexpr float above_m = 1.0f;
  for (const RoadStrip& road : roads) {
    const glm::vec2 along(road.b - road.a);
    const float length = glm::length(along);
    if (!(length > 0.0f)) continue;
    const glm::vec2 ahead = along * (longer_m / length),
                    side = glm::vec2(-along.y, along.x) * (0.5f * road.width_m / length);
    const glm::vec2 a(road.a), b(road.b);
    std::array<float, 12> corners{};
    std::size_t at = 0;
    for (const glm::vec2 p : {a - ahead - side, b + ahead - side, b + ahead + side, a - ahead + side})
      for (const float v : to_recast({p, 0.0f})) corners[at++] = v;
    rcMarkConvexPolyArea(&context, corners.data(), 4, std::min(road.a.z, road.b.z) - above_m,
                         std::max(road.a.z, road.b.z) + above_m, area, compact);
  }
}

/// Roads, and the crossings over them. Where there are crossings, the rest of the roads is closed to people.
void mark_roads(rcContext& context, const WalkingGround& ground, rcCompactHeightfield& compact) {
  mark_strips(context, ground.roads, road_area, 0.3f, compact);
  mark_strips(context, ground.crossings, crossing_area, 0.0f, compact);
  if (ground.crossings.empty()) return;
  for (int i = 0; i < compact.spanCount; ++i)
    if (compact.areas[i] == road_area) compact.areas[i] = RC_NULL_AREA;
}

/// The bytes that Detour takes as a tile; empty where nobody can walk.
struct TileBytes {
  unsigned char* bytes = nullptr;
  int size = 0;
};

TileBytes make_tile(const WalkingGround& ground, std::span<const std::uint32_t> triangles,
                    const NavMeshOptions& options, glm::vec2 corner, glm::ivec2 tile) {
  rcContext context(false);
  const int radius_cells = int(std::ceil(options.body_radius_m / options.cell_m - 0.01f));
  const int border = radius_cells + 3;
  const float tile_m = float(tile_cells) * options.cell_m, border_m = float(border) * options.cell_m;
  float low_z = 1e9f, high_z = -1e9f;
  std::vector<float> vertices;
  std::vector<int> indices;
  std::vector<unsigned char> areas;
  const float min_up = std::cos(glm::radians(options.max_slope_deg));
  for (const std::uint32_t t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::vec3 p = ground.corners[3 * std::size_t(t) + c];
      low_z = std::min(low_z, p.z), high_z = std::max(high_z, p.z);
      indices.push_back(int(vertices.size() / 3));
      for (const float v : to_recast(p)) vertices.push_back(v);
    }
    areas.push_back(area_of(ground, t, min_up));
  }
  // The lattice of heights is the world's.
  low_z = (std::floor(low_z / cell_height_m) - 1.0f) * cell_height_m;
  if (high_z - low_z > max_tile_height_m) high_z = low_z + max_tile_height_m;
  const glm::vec2 low = corner + glm::vec2(tile) * tile_m;  // Recast's x and z
  const std::array<float, 3> from{low.x - border_m, low_z, low.y - border_m},
      to{low.x + tile_m + border_m, high_z + 1.0f, low.y + tile_m + border_m};
  const int side = tile_cells + 2 * border;
  const int headroom = int(std::ceil(options.headroom_m / cell_height_m));

  Heightfield solid(rcAllocHeightfield());
  if (!rcCreateHeightfield(&context, *solid, side, side, from.data(), to.data(), options.cell_m,
                           cell_height_m))
    return {};
  rcRasterizeTriangles(&context, vertices.data(), int(vertices.size() / 3), indices.data(), areas.data(),
                       int(areas.size()), *solid, climb_cells);
  rcFilterLowHangingWalkableObstacles(&context, climb_cells, *solid);
  rcFilterLedgeSpans(&context, headroom, climb_cells, *solid);
  rcFilterWalkableLowHeightSpans(&context, headroom, *solid);
  Compact compact(rcAllocCompactHeightfield());
  constexpr int min_region = 16, merged_region = 400;
  if (!rcBuildCompactHeightfield(&context, headroom, climb_cells, *solid, *compact)) return {};
  mark_roads(context, ground, *compact);
  if (!rcErodeWalkableArea(&context, radius_cells, *compact) || !rcBuildDistanceField(&context, *compact) ||
      !rcBuildRegions(&context, *compact, border, min_region, merged_region))
    return {};
  Contours contours(rcAllocContourSet());
  Polygons polygons(rcAllocPolyMesh());
  Details details(rcAllocPolyMeshDetail());
  constexpr float max_edge_error_cells = 1.1f, detail_distance_cells = 8.0f, detail_error_m = 0.08f;
  if (!rcBuildContours(&context, *compact, max_edge_error_cells, int(12.0f / options.cell_m), *contours) ||
      contours->nconts == 0 || !rcBuildPolyMesh(&context, *contours, corners_per_polygon, *polygons) ||
      polygons->npolys == 0 ||
      !rcBuildPolyMeshDetail(&context, *polygons, *compact, detail_distance_cells * options.cell_m,
                             detail_error_m, *details))
    return {};
  std::fill_n(polygons->flags, polygons->npolys, static_cast<unsigned short>(1));

  dtNavMeshCreateParams params{};
  params.verts = polygons->verts, params.vertCount = polygons->nverts;
  params.polys = polygons->polys, params.polyFlags = polygons->flags, params.polyAreas = polygons->areas;
  params.polyCount = polygons->npolys, params.nvp = polygons->nvp;
  params.detailMeshes = details->meshes, params.detailVerts = details->verts;
  params.detailVertsCount = details->nverts;
  params.detailTris = details->tris, params.detailTriCount = details->ntris;
  params.walkableHeight = options.headroom_m, params.walkableRadius = options.body_radius_m;
  params.walkableClimb = climb_cells * cell_height_m;
  params.tileX = tile.x, params.tileY = tile.y;
  rcVcopy(params.bmin, polygons->bmin), rcVcopy(params.bmax, polygons->bmax);
  params.cs = options.cell_m, params.ch = cell_height_m, params.buildBvTree = true;
  TileBytes result;
  if (!dtCreateNavMeshData(&params, &result.bytes, &result.size)) return {};
  return result;
}

}  // namespace

struct NavMesh::Data {
  NavMeshOptions options;
  std::unique_ptr<dtNavMesh, void (*)(dtNavMesh*)> mesh{dtAllocNavMesh(), dtFreeNavMesh};
  std::unique_ptr<dtNavMeshQuery, void (*)(dtNavMeshQuery*)> query{dtAllocNavMeshQuery(), dtFreeNavMeshQuery};
  dtQueryFilter filter;
  glm::vec2 corner{0.0f};  ///< of the first tile, Recast's x and z
  glm::ivec2 tiles{0};
  struct Piece {
    glm::vec3 a, b, c;
    float area_before;  ///< of all pieces before it, m2

    float area() const {
      const glm::vec2 u = b - a, v = c - a;
      return 0.5f * std::abs(u.x * v.y - u.y * v.x);
    }
  };
  std::vector<Piece> pieces;
  float area = 0.0f;

  float tile_m() const { return float(tile_cells) * options.cell_m; }
  /// Makes the tiles from `first` to `last`.
  void make(const WalkingGround& ground, glm::ivec2 first, glm::ivec2 last);
  void measure();
  std::optional<std::pair<dtPolyRef, glm::vec3>> find(glm::vec3 p, float reach_m, float reach_z_m) const;
};

void NavMesh::Data::make(const WalkingGround& ground, glm::ivec2 first, glm::ivec2 last) {
  const glm::ivec2 size = last - first + 1;
  std::vector<std::vector<std::uint32_t>> of_tiles(std::size_t(size.x) * std::size_t(size.y));
  const float margin = 8.0f * options.cell_m;
  for (std::uint32_t t = 0; t < ground.kinds.size(); ++t) {
    glm::vec2 low(1e9f), high(-1e9f);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::array<float, 3> p = to_recast(ground.corners[3 * std::size_t(t) + c]);
      low = glm::min(low, {p[0], p[2]}), high = glm::max(high, {p[0], p[2]});
    }
    const glm::ivec2 from = glm::max(glm::ivec2(glm::floor((low - margin - corner) / tile_m())), first),
                     to = glm::min(glm::ivec2(glm::floor((high + margin - corner) / tile_m())), last);
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x)
        of_tiles[std::size_t((y - first.y) * size.x + x - first.x)].push_back(t);
  }
  const auto tile_at = [&](std::size_t i) { return first + glm::ivec2(int(i) % size.x, int(i) / size.x); };
  std::vector<TileBytes> tiles_made(of_tiles.size());
  parallel_for(of_tiles.size(), [&](std::size_t i) {
    if (!of_tiles[i].empty()) tiles_made[i] = make_tile(ground, of_tiles[i], options, corner, tile_at(i));
  });
  for (std::size_t i = 0; i < of_tiles.size(); ++i) {
    const TileBytes& tile = tiles_made[i];
    mesh->removeTile(mesh->getTileRefAt(tile_at(i).x, tile_at(i).y, 0), nullptr, nullptr);
    if (tile.bytes && dtStatusFailed(mesh->addTile(tile.bytes, tile.size, DT_TILE_FREE_DATA, 0, nullptr)))
      dtFree(tile.bytes);
  }
  measure();
}

void NavMesh::Data::measure() {
  // Floors inside closed buildings are walkable, too, but nobody gets there: the widest ground that hangs
  // together counts.
  const dtNavMesh& tiles_of = *mesh;
  std::vector<std::size_t> first(std::size_t(tiles_of.getMaxTiles()) + 1, 0);
  for (int i = 0; i < tiles_of.getMaxTiles(); ++i) {
    const dtMeshTile* tile = tiles_of.getTile(i);
    first[std::size_t(i) + 1] =
        first[std::size_t(i)] + (tile->header ? std::size_t(tile->header->polyCount) : 0);
  }
  DisjointSets sets(first.back());
  std::vector<std::vector<Piece>> pieces_of(first.back());
  std::vector<float> areas(first.back(), 0.0f);
  for (int i = 0; i < tiles_of.getMaxTiles(); ++i) {
    const dtMeshTile* tile = tiles_of.getTile(i);
    for (int p = 0; tile->header && p < tile->header->polyCount; ++p) {
      const std::size_t number = first[std::size_t(i)] + std::size_t(p);
      const dtPoly& polygon = tile->polys[p];
      for (unsigned link = polygon.firstLink; link != DT_NULL_LINK; link = tile->links[link].next) {
        unsigned salt = 0, other_tile = 0, other = 0;
        tiles_of.decodePolyId(tile->links[link].ref, salt, other_tile, other);
        sets.join(number, first[other_tile] + other);
      }
      if (polygon.getArea() != floor_area) continue;  // nobody stays on others
      const auto at = [&](int c) { return to_house(tile->verts + 3 * std::size_t(polygon.verts[c])); };
      for (int c = 2; c < polygon.vertCount; ++c) {
        pieces_of[number].push_back({at(0), at(c - 1), at(c), 0.0f});
        areas[number] += pieces_of[number].back().area();
      }
    }
  }
  pieces.clear(), area = 0.0f;
  if (areas.empty()) return;
  std::vector<float> of_set(first.back(), 0.0f);
  for (std::size_t n = 0; n < areas.size(); ++n) of_set[sets.root(n)] += areas[n];
  const auto widest = std::size_t(std::ranges::max_element(of_set) - of_set.begin());
  for (std::size_t n = 0; n < areas.size(); ++n)
    if (sets.root(n) == widest)
      for (Piece piece : pieces_of[n]) {
        piece.area_before = area;
        area += piece.area();
        pieces.push_back(piece);
      }
}

std::optional<std::pair<dtPolyRef, glm::vec3>> NavMesh::Data::find(glm::vec3 p, float reach_m,
                                                                   float reach_z_m) const {
  const std::array<float, 3> centre = to_recast(p), extents{reach_m, reach_z_m, reach_m};
  dtPolyRef polygon = 0;
  std::array<float, 3> nearest{};
  if (dtStatusFailed(
          query->findNearestPoly(centre.data(), extents.data(), &filter, &polygon, nearest.data())) ||
      polygon == 0)
    return std::nullopt;
  return std::pair(polygon, to_house(nearest.data()));
}

NavMesh::NavMesh(std::unique_ptr<Data> data) : data_(std::move(data)) {}
NavMesh::NavMesh(NavMesh&&) noexcept = default;
NavMesh& NavMesh::operator=(NavMesh&&) noexcept = default;
NavMesh::~NavMesh() = default;

Result<NavMesh> NavMesh::create(const WalkingGround& ground, const NavMeshOptions& options) {
  if (ground.kinds.empty()) return error("there is no ground to walk on; add a terrain, streets or a model");
  glm::vec3 low(1e9f), high(-1e9f);
  for (const glm::vec3 p : ground.corners) {
    if (!std::isfinite(p.x + p.y + p.z)) return error("the ground has a position that is no number");
    low = glm::min(low, p), high = glm::max(high, p);
  }
  const glm::vec2 extent(high - low);
  if (std::max(extent.x, extent.y) > max_extent_m)
    return error("the ground is {:.0f} m wide; people walk in places of at most {:.0f} m: give their area",
                 std::max(extent.x, extent.y), max_extent_m);
  auto data = std::make_unique<Data>();
  data->options = options;
  const float tile_m = data->tile_m();
  data->corner = glm::vec2(low.x, -high.y) - 0.5f;
  data->tiles = glm::ivec2(glm::ceil((extent + 1.0f) / tile_m));
  dtNavMeshParams params{};
  params.orig[0] = data->corner.x, params.orig[1] = 0.0f, params.orig[2] = data->corner.y;
  params.tileWidth = params.tileHeight = tile_m;
  params.maxTiles = data->tiles.x * data->tiles.y;
  // A reference has 22 bits for tile and polygon beside its salt.
  int tile_bits = 0;
  while ((1 << tile_bits) < params.maxTiles) ++tile_bits;
  if (tile_bits > 12) return error("the ground has {} tiles; people walk in at most 4096", params.maxTiles);
  params.maxPolys = 1 << (22 - tile_bits);
  constexpr int search_nodes = 8192;
  if (dtStatusFailed(data->mesh->init(&params)) ||
      dtStatusFailed(data->query->init(data->mesh.get(), search_nodes)))
    return error("the mesh of the walkable ground does not fit into memory");
  data->filter.setAreaCost(road_area, options.road_cost);
  data->filter.setAreaCost(crossing_area, 1.0f);
  data->filter.setAreaCost(floor_area, 1.0f);
  data->make(ground, glm::ivec2(0), data->tiles - 1);
  NavMesh mesh(std::move(data));
  if (mesh.area_m2() <= 0.0f)
    return error(
        "nobody can walk anywhere: all ground is steeper than {:.0f} degrees, narrower than a body or "
        "covered",
        options.max_slope_deg);
  return mesh;
}

void NavMesh::update(const WalkingGround& ground, glm::vec2 low, glm::vec2 high) {
  const float margin = 8.0f * data_->options.cell_m;
  const glm::vec2 from(low.x - margin, -high.y - margin), to(high.x + margin, -low.y + margin);
  const auto tile_of = [&](glm::vec2 p) {
    return glm::clamp(glm::ivec2(glm::floor((p - data_->corner) / data_->tile_m())), glm::ivec2(0),
                      data_->tiles - 1);
  };
  data_->make(ground, tile_of(from), tile_of(to));
}

std::optional<Way> NavMesh::way(glm::vec3 from, glm::vec3 to) const {
  const auto start = data_->find(from, 1.0f, search_height_m), end = data_->find(to, 1.0f, search_height_m);
  if (!start || !end) return std::nullopt;
  const std::array<float, 3> a = to_recast(start->second), b = to_recast(end->second);
  std::vector<dtPolyRef> polygons(max_polygons_of_way);
  int count = 0;
  if (dtStatusFailed(data_->query->findPath(start->first, end->first, a.data(), b.data(), &data_->filter,
                                            polygons.data(), &count, int(polygons.size()))) ||
      count == 0 || polygons[std::size_t(count) - 1] != end->first)
    return std::nullopt;
  std::vector<float> corners(3 * max_corners);
  int corner_count = 0;
  if (dtStatusFailed(data_->query->findStraightPath(a.data(), b.data(), polygons.data(), count,
                                                    corners.data(), nullptr, nullptr, &corner_count,
                                                    int(max_corners), 0)))
    return std::nullopt;
  Way way;
  for (int c = 0; c < corner_count; ++c) way.push_back(to_house(&corners[3 * std::size_t(c)]));
  return way;
}

std::optional<glm::vec3> NavMesh::nearest(glm::vec3 p, float reach_m, float reach_z_m) const {
  const auto found = data_->find(p, reach_m, reach_z_m);
  if (!found) return std::nullopt;
  glm::vec3 place = found->second;
  const std::array<float, 3> at = to_recast(place);
  float height = 0.0f;
  if (dtStatusSucceed(data_->query->getPolyHeight(found->first, at.data(), &height))) place.z = height;
  return place;
}

glm::vec3 NavMesh::place(float pick, float u, float v) const {
  const float wanted = pick * data_->area;
  auto piece = std::ranges::upper_bound(data_->pieces, wanted, {}, &Data::Piece::area_before);
  if (piece != data_->pieces.begin()) --piece;
  if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
  return piece->a + u * (piece->b - piece->a) + v * (piece->c - piece->a);
}

std::vector<Wall> NavMesh::borders() const {
  std::vector<Wall> walls;
  const dtNavMesh& mesh = *data_->mesh;
  const auto add = [&](glm::vec3 a, glm::vec3 b) {
    constexpr float below_m = 0.5f;
    walls.push_back({a, b, std::min(a.z, b.z) - below_m, std::max(a.z, b.z) + data_->options.headroom_m});
  };
  for (int i = 0; i < mesh.getMaxTiles(); ++i) {
    const dtMeshTile* tile = mesh.getTile(i);
    if (!tile->header) continue;
    for (int p = 0; p < tile->header->polyCount; ++p) {
      const dtPoly& polygon = tile->polys[p];
      for (int e = 0; e < polygon.vertCount; ++e) {
        const glm::vec3 a = to_house(tile->verts + 3 * std::size_t(polygon.verts[e])),
                        b = to_house(tile->verts +
                                     3 * std::size_t(polygon.verts[(e + 1) % polygon.vertCount]));
        if (polygon.neis[e] == 0) {
          add(a, b);
        } else if ((polygon.neis[e] & DT_EXT_LINK) != 0) {
          // Parts of an edge between tiles that no polygon of the other tile continues.
          std::vector<glm::vec2> open;
          for (unsigned link = polygon.firstLink; link != DT_NULL_LINK; link = tile->links[link].next)
            if (tile->links[link].edge == e)
              open.emplace_back(tile->links[link].bmin / 255.0f, tile->links[link].bmax / 255.0f);
          std::ranges::sort(open, {}, &glm::vec2::x);
          float at = 0.0f;
          constexpr float min_gap = 0.02f;
          for (const glm::vec2 part : open) {
            if (part.x > at + min_gap) add(glm::mix(a, b, at), glm::mix(a, b, part.x));
            at = std::max(at, part.y);
          }
          if (at < 1.0f - min_gap) add(glm::mix(a, b, at), b);
        }
      }
    }
  }
  return walls;
}

float NavMesh::area_m2() const { return data_->area; }

}  // namespace parvis::crowd
