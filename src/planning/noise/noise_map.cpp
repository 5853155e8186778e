#include "planning/noise/noise_map.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/progress.h"

namespace parvis::noise {
namespace {

using propagation::octaves;
using propagation::Place;

constexpr std::size_t max_cells = 1'000'000, max_pairs = 200'000'000;
constexpr double facade_gap_m = 0.1;  // of receivers before a facade: Directive 2002/49/EC, annex I, 1

Status lay_out(const propagation::SceneTerrain& terrain, const NoiseOptions& options, NoiseMap& map) {
  const glm::dvec4 area = options.area.value_or(terrain.area());
  map.cell_m = options.cell_m;
  map.corner = glm::min(glm::dvec2(area.x, area.y), glm::dvec2(area.z, area.w));
  const glm::dvec2 size = glm::max(glm::dvec2(area.x, area.y), glm::dvec2(area.z, area.w)) - map.corner;
  const glm::dvec2 counts = glm::ceil(size / options.cell_m);
  if (!(counts.x >= 1.0 && counts.y >= 1.0)) return error("the area of the noise map is empty");
  if (counts.x * counts.y > double(max_cells))
    return error(
        "{:.0f} x {:.0f} m in cells of {} m are {:.0f} cells; at most {} are computed: take a larger --cell "
        "or "
        "a smaller --area",
        size.x, size.y, options.cell_m, counts.x * counts.y, max_cells);
  map.columns = int(counts.x), map.rows = int(counts.y);
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      const glm::dvec2 at = map.corner + map.cell_m * (glm::dvec2(column, row) + 0.5);
      const bool is_built = terrain.roof_z(at).has_value();
      map.receiver_of_cell.push_back(is_built ? -1 : int(map.receivers.size()));
      if (!is_built) map.receivers.push_back({.place = Place(at, terrain.ground_z(at) + options.height_m)});
    }
  return Ok{};
}

/// Receivers before walls of buildings, at each floor, on the sides that are open.
void add_facades(const propagation::Site& site, const NoiseOptions& options, NoiseMap& map) {
  const glm::dvec2 high = map.corner + map.cell_m * glm::dvec2(map.columns, map.rows);
  for (std::size_t w = 0; w < site.walls().size(); ++w) {
    const propagation::Wall& wall = site.walls()[w];
    if (!wall.absorption) continue;
    const double length_m = glm::distance(wall.a, wall.b);
    const int count = std::max(1, int(std::lround(length_m / options.facade_step_m)));
    for (int i = 0; i < count; ++i) {
      const glm::dvec2 on_wall = glm::mix(wall.a, wall.b, (i + 0.5) / count),
                       along = (wall.b - wall.a) / length_m;
      for (const double side : {1.0, -1.0}) {
        const glm::dvec2 out = side * glm::dvec2(-along.y, along.x), at = on_wall + facade_gap_m * out;
        const bool is_outside =
            !site.terrain().roof_z(on_wall + 1.2 * out) && site.terrain().roof_z(on_wall - 1.2 * out);
        if (!is_outside || at.x < map.corner.x || at.y < map.corner.y || at.x > high.x || at.y > high.y)
          continue;
        const double ground = site.terrain().ground_z(at);
        for (int floor = 0; ground + 1.5 + floor * options.floor_m < wall.top_a; ++floor) {
          const Place place(at, ground + 1.5 + floor * options.floor_m);
          if (place.z < wall.bottom) continue;  // the open mouth of an arcade
          map.receivers.push_back({place, out, int(w), floor, length_m / count,
                                   std::min(options.floor_m, wall.top_a - ground - floor * options.floor_m)});
        }
      }
    }
  }
}

/// The source's place on the scene's ground: lanes lie on paving, which the ground's raster may not follow.
/// A source with a height of its own keeps it.
Place on_ground(Place source, double height_m, const propagation::SceneTerrain& terrain) {
  constexpr double bridge_m = 2.0;
  const double ground = terrain.ground_z(glm::dvec2(source));
  if (height_m >= 0.0 && std::abs(source.z - ground) < bridge_m) source.z = ground + height_m;
  return source;
}

using PatchTransfer = std::pair<std::uint32_t, std::array<float, octaves>>;

/// Transfers to one receiver from all patches within reach. Near patches are divided, so that each piece is
/// shorter than half of its distance.
std::vector<PatchTransfer> transfers_to(const propagation::SceneSite& scene, const Receiver& receiver,
                                        std::span<const SourcePatch> patches, const NoiseOptions& options,
                                        const propagation::Octaves& air) {
  const propagation::Site& site = *scene.site;
  std::vector<propagation::WallSequence> sequences = site.sequences_seen_from(receiver.place, options.paths);
  std::erase_if(sequences,
                [&](const propagation::WallSequence& walls) { return walls.back() == receiver.wall; });
  std::vector<PatchTransfer> result;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const SourcePatch& patch = patches[i];
    const double distance_m = glm::distance(patch.middle, receiver.place);
    if (distance_m > options.reach_m) continue;
    constexpr int max_pieces = 4;
    const int pieces =
        std::clamp(int(std::ceil(patch.length_m() / std::max(0.5 * distance_m, 1.0))), 1, max_pieces);
    std::array<double, octaves> sum{};
    for (int k = 0; k < pieces; ++k) {
      const Place source = on_ground(patch.middle + patch.half * ((2.0 * k + 1.0) / pieces - 1.0),
                                     patch.height_m, *scene.terrain);
      const propagation::Octaves levels = site.transfer(source, receiver.place, sequences, options.paths, air)
                                              .long_term_db(options.favourable_fraction);
      for (std::size_t band = 0; band < octaves; ++band)
        sum[band] += propagation::energy(levels[band]) / pieces;
    }
    PatchTransfer kept{std::uint32_t(i), {}};
    for (std::size_t band = 0; band < octaves; ++band) kept.second[band] = float(sum[band]);
    result.push_back(kept);
  }
  return result;
}

}  // namespace

double lden_of(double lday, double levening, double lnight) {
  using propagation::energy;
  return propagation::level(
      (12.0 * energy(lday) + 4.0 * energy(levening + 5.0) + 8.0 * energy(lnight + 10.0)) / 24.0);
}

std::vector<NoiseLevels> sum_levels(const KeptTransfers& transfers, std::span<const PatchPower> power) {
  // A-weights go into the powers: one product for each band and period.
  std::vector<std::array<std::array<float, octaves>, periods>> weighted(power.size());
  for (std::size_t i = 0; i < power.size(); ++i)
    for (std::size_t p = 0; p < periods; ++p)
      for (std::size_t band = 0; band < octaves; ++band)
        weighted[i][p][band] =
            float(power[i][p][band] * propagation::energy(propagation::a_weights_db[band]));
  std::vector<NoiseLevels> levels(transfers.first.size() - 1);
  parallel_for(
      levels.size(),
      [&](std::size_t i) {
        std::array<std::array<float, octaves>, periods> sums{};
        for (std::size_t k = transfers.first[i]; k < transfers.first[i + 1]; ++k) {
          const auto& own = weighted[transfers.patches[k]];
          for (std::size_t p = 0; p < periods; ++p)
            for (std::size_t band = 0; band < octaves; ++band)
              sums[p][band] += transfers.energies[k][band] * own[p][band];
        }
        std::array<double, periods> level;
        for (std::size_t p = 0; p < periods; ++p) {
          double sum = 0.0;
          for (const float band : sums[p]) sum += double(band);
          level[p] = std::max(propagation::level(sum), 0.0);  // 0 dB(A): nothing is heard
        }
        levels[i] = {level[0], level[1], level[2], lden_of(level[0], level[1], level[2])};
      },
      64);
  return levels;
}

Result<NoiseMap> compute_noise(const scene::Scene& scene, const NoiseOptions& options) {
  Result<RoadSources> sources = road_sources(scene, options.patch_m);
  if (!sources) return sources.errors();
  NoiseMap map;
  map.sources = *std::move(sources);
  const propagation::SceneSite site = propagation::site_of(scene);
  if (Status status = lay_out(*site.terrain, options, map); !status) return status.errors();
  if (options.has_facades) add_facades(*site.site, options, map);
  if (map.receivers.empty()) return error("buildings stand all over the area of the noise map");
  if (map.receivers.size() * map.sources.patches.size() > max_pairs)
    return error(
        "{} receivers and {} pieces of road are too many pairs; at most {} are computed: take a larger "
        "--cell or "
        "a smaller --area",
        map.receivers.size(), map.sources.patches.size(), max_pairs);

  const propagation::Octaves air = propagation::absorption_db_per_m(options.air);
  std::vector<std::vector<PatchTransfer>> found(map.receivers.size());
  Progress progress("noise", map.receivers.size());
  parallel_for(map.receivers.size(), [&](std::size_t i) {
    found[i] = transfers_to(site, map.receivers[i], map.sources.patches, options, air);
    progress.advance();
  });
  for (const std::vector<PatchTransfer>& of_receiver : found) {
    for (const auto& [patch, energies] : of_receiver)
      map.transfers.patches.push_back(patch), map.transfers.energies.push_back(energies);
    map.transfers.first.push_back(map.transfers.patches.size());
  }
  map.levels = sum_levels(map.transfers, map.sources.power);
  return map;
}

std::optional<NoiseLevels> levels_at(const NoiseMap& map, int column, int row) {
  const int receiver =
      map.receiver_of_cell[std::size_t(row) * std::size_t(map.columns) + std::size_t(column)];
  if (receiver < 0) return std::nullopt;
  return map.levels[std::size_t(receiver)];
}

}  // namespace parvis::noise
