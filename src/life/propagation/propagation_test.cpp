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
  const auto sequences = site.sequences_seen_from({-15, 6}, choice);
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
  const PathChoice choice{.reflections = 0};
  double largest_db = 0.0, largest_without_db = 0.0, before = 0.0, before_without = 0.0;
  // Behind the box, from its shadow into the light; beyond y = 5, where a second edge leaves the way round
  // and the standard's C" steps from 3 to 1.
  constexpr double begin = 5.1;
  for (double y = begin; y < 40.0; y += 0.02) {
    const Place source(-20, 0, 1), receiver(20, y, 1.7);
    const Octaves heard = site.transfer(source, receiver, {}, choice, air_10_70).homogeneous_db,
                  lost = site.grazing_loss(source, receiver);
    const double now = heard[3] - lost[3], without = heard[3];
    if (y > begin) largest_db = std::max(largest_db, std::abs(now - before));
    if (y > begin) largest_without_db = std::max(largest_without_db, std::abs(without - before_without));
    before = now, before_without = without;
  }
  EXPECT_LT(largest_db, 0.5);
  EXPECT_GT(largest_without_db, 3.0) << "without it the level jumps";
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
      const auto sequences = each->sequences_seen_from(glm::dvec2(source), choice);
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
