// Air, emission of roads, attenuation along paths and the search for paths: closed forms, and the published
// cases.
#include <gtest/gtest.h>

#include <numbers>

#include "base/test_data.h"
#include "life/propagation/air.h"
#include "life/propagation/road_emission.h"
#include "life/propagation/site.h"
#include "life/propagation/test_noise_cases.h"

namespace parvis::propagation {
namespace {

const Octaves air_10_70 = absorption_db_per_m({10.0, 70.0});

/// Level ground with one box of a building, 10 m square and 8 m high, about (0, 0).
class BoxOnPlain final : public Terrain {
 public:
  explicit BoxOnPlain(double factor = 0.0) : factor_(factor) {}
  double ground_z(glm::dvec2) const override { return 0.0; }
  double ground_factor(glm::dvec2) const override { return factor_; }
  std::optional<double> roof_z(glm::dvec2 p) const override {
    return std::max(std::abs(p.x), std::abs(p.y)) <= 5.0 ? std::optional(8.0) : std::nullopt;
  }
  void add_breaks(glm::dvec2, glm::dvec2, std::vector<double>&) const override {}

  static std::vector<Wall> walls() {
    const glm::dvec2 corners[]{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
    std::vector<Wall> result;
    for (int i = 0; i < 4; ++i) result.push_back({corners[i], corners[(i + 1) % 4], 8.0, 8.0, Octaves{}});
    return result;
  }

 private:
  double factor_;
};

Profile plain(double length_m, double source_z, double receiver_z, double factor) {
  return {.ground = {{0, 0, factor}, {length_m, 0, factor}},
          .walls = {},
          .source_z_m = source_z,
          .receiver_z_m = receiver_z};
}

TEST(Air, AbsorptionHasThePublishedValuesOfIso9613) {
  // ISO 9613-2, table 2, at 10 °C and 70 %.
  const Octaves printed{0.1, 0.4, 1.0, 1.9, 3.7, 9.7, 32.8, 117.0};
  for (std::size_t i = 0; i < octaves; ++i)
    EXPECT_NEAR(1000.0 * air_10_70[i], printed[i], i == 7 ? 0.5 : 0.05) << nominal_hz[i];
}

TEST(Path, HardPlainAddsThreeDecibelsToDivergence) {
  const Octaves loss = attenuation_over(plain(190, 1, 4, 0.0), air_10_70, Condition::homogeneous);
  const double d = std::hypot(190.0, 3.0);
  for (std::size_t i = 0; i < octaves; ++i)
    EXPECT_NEAR(loss[i], 20.0 * std::log10(d) + 11.0 + air_10_70[i] * d - 3.0, 1e-9);
}

TEST(Path, PorousGroundAttenuatesMiddleOctavesAndLessInFavourableConditions) {
  const Profile far = plain(300, 0.5, 1.5, 1.0);
  const Octaves calm = attenuation_over(far, air_10_70, Condition::homogeneous),
                wind = attenuation_over(far, air_10_70, Condition::favourable),
                hard = attenuation_over(plain(300, 0.5, 1.5, 0.0), air_10_70, Condition::homogeneous);
  EXPECT_GT(calm[3], hard[3] + 10.0);
  EXPECT_LT(wind[3], calm[3]);
}

TEST(Path, ThinScreenFollowsMaekawasFormula) {
  // Over hard ground the screened ground terms differ from -3 dB by less than 1; far above it they vanish
  // into -3 - 3.
  Profile screened = plain(100, 5, 5, 0.0);
  screened.walls = {{50, 10}};
  const Octaves loss = attenuation_over(screened, air_10_70, Condition::homogeneous),
                air = absorption_db_per_m({10.0, 70.0});
  const double difference = 2.0 * std::hypot(50.0, 5.0) - 100.0;
  for (std::size_t i = 2; i < octaves; ++i) {
    const double screen = std::min(10.0 * std::log10(3.0 + 40.0 * nominal_hz[i] / 340.0 * difference), 25.0);
    EXPECT_NEAR(loss[i], 51.0 + 100.0 * air[i] + screen - 3.0, 3.0) << nominal_hz[i];
    EXPECT_GT(loss[i], 51.0 + 100.0 * air[i] + screen - 6.1) << nominal_hz[i];
  }
}

TEST(Path, LevelsDoNotJumpWhereAScreenGrowsIntoTheRay) {
  double before = 0.0;
  for (double top = 4.0; top < 6.0; top += 0.01) {
    Profile screened = plain(100, 5, 5, 0.0);
    screened.walls = {{50, top}};
    const double loss = attenuation_over(screened, air_10_70, Condition::homogeneous)[0];
    // Rayleigh's criterion is a step of the method.
    EXPECT_LT(std::abs(top > 4.0 ? loss - before : 0.0), 5.0) << top;
    before = loss;
  }
}

TEST(Path, DegenerateProfilesHaveFiniteLevels) {
  for (const double length : {1e-6, 0.01, 5000.0})
    for (const double z : {0.0, -3.0, 1e4})
      for (const Condition condition : {Condition::homogeneous, Condition::favourable}) {
        Profile profile = plain(length, z, 0.0, 0.7);
        profile.walls = {{0.5 * length, 2.0}, {0.5 * length, 2.0}};
        for (const double loss : attenuation_over(profile, air_10_70, condition))
          EXPECT_TRUE(std::isfinite(loss));
      }
}

TEST(Site, MirrorsASourceAtAFacade) {
  const BoxOnPlain terrain;
  const Site site(terrain, BoxOnPlain::walls());
  PathChoice choice;
  const auto sequences = site.sequences_seen_from({-15, 6, 1}, choice);
  ASSERT_FALSE(sequences.empty());
  int lines = 0;
  for (const WallSequence& walls : sequences)
    if (const auto line = site.reflected_line({-15, -4, 1}, {-15, 6, 1}, walls); !line.empty()) {
      ++lines;
      EXPECT_NEAR(line[1].x, -5.0, 1e-9);
      EXPECT_NEAR(line[1].y, 1.0, 1e-9);
      const auto loss = site.reflected({-15, -4, 1}, {-15, 6, 1}, walls, air_10_70, Condition::homogeneous);
      ASSERT_TRUE(loss);
      const double d = std::hypot(20.0, 10.0);
      EXPECT_NEAR((*loss)[4], 20.0 * std::log10(d) + 11.0 + air_10_70[4] * d - 3.0, 1e-9);
      EXPECT_FALSE(site.reflected({-15, -4, 9}, {-15, 6, 9}, walls, air_10_70, Condition::homogeneous))
          << "the ray passes above the wall";
    }
  EXPECT_EQ(lines, 1);
}

TEST(Site, FindsTheWayRoundABoxOnBothSides) {
  const BoxOnPlain terrain;
  const Site site(terrain, BoxOnPlain::walls());
  const Place source(-20, 0, 1), receiver(20, 0, 1.5);
  const auto left = site.corners_around(source, receiver, Condition::homogeneous, true, 800.0);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_NEAR(left[0].y, 5.0, 1e-9);
  EXPECT_EQ(site.corners_around(source, receiver, Condition::homogeneous, false, 800.0).size(), 2u);
  EXPECT_TRUE(site.corners_around({-20, 0, 20}, {20, 0, 20}, Condition::homogeneous, true, 800.0).empty());
  EXPECT_TRUE(site.corners_around(source, receiver, Condition::homogeneous, true, 40.5).empty())
      << "too long";
}

TEST(Site, LevelsDoNotJumpAtTheShadowOfACorner) {
  const BoxOnPlain terrain;
  std::vector<Wall> walls = BoxOnPlain::walls();
  for (Wall& wall : walls) wall.top_a = wall.top_b = 60.0;  // nothing comes over it
  const Site site(terrain, walls);
  const PathChoice of_map{.reflections = 0}, heard{.reflections = 0, .softens_shadows = true};
  // Behind the box, from its shadow into the light; at y = 5 a second edge leaves the way round.
  const auto largest_step_db = [&](const PathChoice& choice, double from_m, double to_m) {
    double largest_db = 0.0, before = 0.0;
    for (double y = from_m; y < to_m; y += 0.02) {
      const double now = site.transfer({-20, 0, 1}, {20, y, 1.7}, {}, choice, air_10_70).homogeneous_db[3];
      if (y > from_m) largest_db = std::max(largest_db, std::abs(now - before));
      before = now;
    }
    return largest_db;
  };
  EXPECT_LT(largest_step_db(heard, 4.5, 40.0), 0.5);
  EXPECT_GT(largest_step_db(of_map, 5.1, 40.0), 3.0) << "at the shadow's edge";
  EXPECT_GT(largest_step_db(of_map, 4.5, 5.5), 1.0) << "where C\" steps from 3 to 1";
}

/// An arcade 4 m deep and 3.5 m high along the x axis, before a house 12 m high: its back wall lies at y = 4.
class ArcadeOnPlain final : public Terrain {
 public:
  double ground_z(glm::dvec2) const override { return 0.0; }
  double ground_factor(glm::dvec2) const override { return 0.0; }
  std::optional<double> roof_z(glm::dvec2 p) const override {
    return p.y >= 0.0 && p.y <= 12.0 ? std::optional(12.0) : std::nullopt;
  }
  std::optional<double> ceiling_z(glm::dvec2 p) const override {
    return p.y >= 0.0 && p.y < 4.0 ? std::optional(3.5) : std::nullopt;
  }
  void add_breaks(glm::dvec2, glm::dvec2, std::vector<double>&) const override {}
};

TEST(Site, SoundPassesBelowTheFrontOfAnArcade) {
  const ArcadeOnPlain terrain;
  std::vector<Wall> walls{{{-40, 0}, {40, 0}, 12, 12, Octaves{}, 3.5},
                          {{-40, 4}, {40, 4}, 12, 12, Octaves{}}};
  const Site open(terrain, walls);
  walls[0].bottom = -1e9;
  const Site closed(terrain, walls);
  const Place source(3, -10, 0.5), receiver(0, 2, 1.7);
  const PathChoice choice;
  const auto level_db = [&](const Site& site, const Place& place) {
    const auto sequences = site.sequences_seen_from(place, choice);
    return site.transfer(source, place, sequences, choice, air_10_70).homogeneous_db[4];
  };
  EXPECT_GT(level_db(open, receiver), level_db(closed, receiver) + 15.0);
  int reflected = 0;
  for (const SoundPath& path : open.paths(source, receiver, open.sequences_seen_from(receiver, choice),
                                          choice, air_10_70, Condition::homogeneous)) {
    if (!path.walls) continue;
    ++reflected;
    EXPECT_NEAR(path.comes_from.y, 4.0, 1e-9) << "the back wall, which the closed front hides";
    EXPECT_NEAR(path.length_m, glm::distance(Place(3, -10, 0.5), Place(0, 6, 1.7)), 1e-9);
  }
  EXPECT_EQ(reflected, 1);
  EXPECT_NEAR(level_db(open, {0, 2, 5}), level_db(closed, {0, 2, 5}), 1e-9)
      << "above the opening it is a wall";
}

TEST(Site, AnEdgeAboveTheRayTakesNothingFromIt) {
  const ArcadeOnPlain terrain;
  std::vector<Wall> walls{{{-40, 0}, {40, 0}, 12, 12, Octaves{}, 3.5}};
  const Site open(terrain, walls);
  walls[0].bottom = -1e9;
  const Site closed(terrain, walls);
  const auto softened_by_db = [&](const Site& site) {  // in clear sight past the front's end at -40
    const auto level_db = [&](bool softens) {
      const PathChoice choice{.reflections = 0, .softens_shadows = softens};
      return site.transfer({-36, -10, 1}, {-41, 2, 1.7}, {}, choice, air_10_70).homogeneous_db[4];
    };
    return level_db(false) - level_db(true);
  };
  EXPECT_NEAR(softened_by_db(open), 0.0, 1e-9);
  EXPECT_GT(softened_by_db(closed), 1.0);
}

TEST(Site, PathsAreReciprocalOverHardGround) {
  const BoxOnPlain terrain;
  const Site site(terrain, BoxOnPlain::walls());
  const Place a(-20, 3, 1), b(25, -7, 4);
  const Octaves there = site.over(a, b, air_10_70, Condition::homogeneous),
                back = site.over(b, a, air_10_70, Condition::homogeneous);
  for (std::size_t i = 0; i < octaves; ++i) EXPECT_NEAR(there[i], back[i], 1e-6);
}

TEST(Site, OutlierPlacesAreAnswered) {
  const BoxOnPlain terrain;
  const Site site(terrain, BoxOnPlain::walls()), empty(terrain, {});
  const PathChoice choice{.reflections = 3};
  for (const Site* each : {&site, &empty})
    for (const Place& source :
         {Place(0, 0, 1), Place(5, 5, 1), Place(1e5, 0, 1)}) {  // inside, at a corner, far off
      const auto sequences = each->sequences_seen_from(source, choice);
      for (const double loss :
           each->transfer(source, {0, 0, 1}, sequences, choice, air_10_70).long_term_db(0.5))
        EXPECT_TRUE(std::isfinite(loss));
    }
}

TEST(Road, OneVehicleAndAFlowOfItAgree) {
  RoadTraffic traffic;
  traffic.flow_per_h = {1000, 0, 0, 0, 0};
  traffic.speed_km_h.fill(70.0);
  const Octaves road = road_power_db(road_coefficients_2020, {}, traffic),
                car = vehicle_power_db(road_coefficients_2020, VehicleCategory::light, 70.0);
  for (std::size_t i = 0; i < octaves; ++i) EXPECT_NEAR(road[i], car[i] + level(1.0 / 70.0), 1e-9);
  // A light vehicle at 70 km/h and 1 kHz: 100.1 rolling and 84.7 propulsion.
  EXPECT_NEAR(car[4], level(energy(100.1) + energy(84.7)), 1e-9);
  EXPECT_EQ(road_power_db(road_coefficients_2020, {}, RoadTraffic{})[0], silence_db) << "no traffic";
}

TEST(PublishedCases, EveryOctaveWithinATenthOfADecibel) {
  const auto folder = shared_data("noise");
  if (!folder) GTEST_SKIP() << "../shared/data/noise is absent";
  const auto results = compute_cases(*folder);
  EXPECT_GT(compute_cases(*folder, 5.0).front().total_db, 0.1) << "in warmer air";
  EXPECT_EQ(results.size(), 28u);
  double largest_db = 0.0;
  for (const CaseResult& result : results) {
    largest_db = std::max({largest_db, result.total_db, result.without_lateral_db});
    // Octagons whose corners are printed to half a metre: TC12, TC14.
    const bool is_coarse = result.id == "TC12" || result.id == "TC14";
    EXPECT_LE(std::max(result.total_db, result.without_lateral_db), is_coarse ? 0.1 : 0.02)
        << result.id << result.worst;
    EXPECT_LE(result.path_db, is_coarse ? 0.16 : 0.05) << result.id << ": " << result.worst;
    // Where the report's paths cross buildings (TC15, TC19, TC28), lead round a court (TC22), or are the same
    // for straight and curved rays though those reach other parts of a wall (TC11, TC14), ours differ.
    for (const char* id : {"TC08", "TC09", "TC10", "TC12", "TC13", "TC21", "TC25"})
      EXPECT_TRUE(result.id != id || result.finds_corners) << result.id;
  }
  RecordProperty("cases", int(results.size()));
  RecordProperty("largest_difference_db", fmt::format("{:.3f}", largest_db));
}

TEST(PublishedCases, AirAndRoads) {
  const auto folder = shared_data("noise");
  if (!folder) GTEST_SKIP() << "../shared/data/noise is absent";
  const Matches air = compare_air_table(*folder);
  EXPECT_EQ(air.all, 48);
  EXPECT_EQ(air.agree, 48) << air.differing;
  EXPECT_EQ(air.rounded, 47) << air.differing;
  RecordProperty("air_values", fmt::format("{} of {}", air.agree, air.all));
  for (const char* key : {"checks", "further_checks"}) {
    const Matches road = compare_road_checks(*folder, key);
    EXPECT_EQ(road.agree, road.all) << road.differing;
  }
  const Matches coefficients = compare_road_coefficients(*folder);
  EXPECT_EQ(coefficients.agree, coefficients.all);
}

}  // namespace
}  // namespace parvis::propagation
