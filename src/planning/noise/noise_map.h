// The map of noise: levels at a grid over the ground and at facades, by CNOSSOS-EU.
#pragma once

#include <filesystem>
#include <optional>

#include "life/propagation/air.h"
#include "life/propagation/scene_site.h"
#include "planning/noise/road_sources.h"

namespace parvis::noise {

/// The settings of a map.
struct NoiseOptions {
  double cell_m = 5.0;               ///< of the map
  double height_m = 4.0;             ///< of the map's receivers over the ground; the Directive asks for 4 m
  std::optional<glm::dvec4> area;    ///< x and y of two corners; absent: the whole place
  double reach_m = 800.0;            ///< sources farther away are left out: the method's limit
  double patch_m = 10.0;             ///< longest piece of a lane that one source stands for
  double favourable_fraction = 0.5;  ///< of the time
  propagation::Air air;
  propagation::PathChoice paths;
  double facade_step_m = 10.0;  ///< between receivers along facades
  double floor_m = 3.0;         ///< height of a floor; the lowest receiver stands at 1.5 m
  bool has_facades = true;
};

/// Where levels are computed.
struct Receiver {
  propagation::Place place{0.0};
  glm::dvec2 facing{
      0.0};       ///< unit normal in plan of its facade, whose own reflection does not count; 0: on the map
  int wall = -1;  ///< of the facade, in the site
  int floor = 0;  ///< counted from 0, the ground floor
  double width_m = 0.0, height_m = 0.0;  ///< of the piece of facade that it stands for
};

/// Levels in dB(A) of a receiver.
struct NoiseLevels {
  double lday = 0.0, levening = 0.0, lnight = 0.0, lden = 0.0;
};

/// Transfers of all pairs within reach, kept: each is the mean over a patch, as an energy by octave. Those of
/// receiver i are [first[i], first[i + 1]).
struct KeptTransfers {
  std::vector<std::size_t> first{0};
  std::vector<std::uint32_t> patches;
  std::vector<std::array<float, propagation::octaves>> energies;
};

/// A map with all that it is summed from.
struct NoiseMap {
  int columns = 0, rows = 0;
  glm::dvec2 corner{0.0};  ///< lower left
  double cell_m = 0.0;
  std::vector<int> receiver_of_cell;  ///< -1 where a building stands; row 0 is the southernmost
  std::vector<Receiver> receivers;    ///< those of cells, then those of facades
  KeptTransfers transfers;
  RoadSources sources;
  std::vector<NoiseLevels> levels;  ///< of each receiver
};

/// Errors: those of road_sources; an empty area; more than a million cells or 200 million pairs.
Result<NoiseMap> compute_noise(const scene::Scene& scene, const NoiseOptions& options);

/// Levels of the same places for other powers of the same patches: sums of kept transfers, without rays.
std::vector<NoiseLevels> sum_levels(const KeptTransfers& transfers, std::span<const PatchPower> power);

/// Lden of the Directive 2002/49/EC out of the levels of day, evening and night.
double lden_of(double lday, double levening, double lnight);

/// Lday, Levening, Lnight and Lden of a cell; nothing where a building stands.
std::optional<NoiseLevels> levels_at(const NoiseMap& map, int column, int row);

/// The map as a model: the ground's cells 10 cm above it and, with their colours of Lden, the pieces of
/// facades 5 cm before them.
scene::Model noise_model(const NoiseMap& map, double receiver_height_m);

/// PREFIX.png (Lden in steps of 5 dB), PREFIX.csv, PREFIX.tif (bands Lden, Lday, Levening, Lnight, in the
/// coordinates of the scene's map), PREFIX.glb (`noise_model`) and, of a map with facades,
/// PREFIX_facades.csv.
Status write_noise(const std::filesystem::path& prefix, const NoiseMap& map, const scene::Scene& scene,
                   double receiver_height_m);

/// PREFIX_difference.png and .csv: Lden of `map` less that of `before`, whose grid must be the same.
Status write_difference(const std::filesystem::path& prefix, const NoiseMap& map, const NoiseMap& before);

}  // namespace parvis::noise
