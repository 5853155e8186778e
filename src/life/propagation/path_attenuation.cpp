// Section numbers are those of the Directive's annex. Rules that its text leaves open follow what ISO/TR
// 17534-4 needs; each is named where it applies.
#include "life/propagation/path_attenuation.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <numbers>

namespace parvis::propagation {
namespace {

constexpr double sound_speed_m_s = 340.0;
constexpr double max_edge_loss_db = 25.0;  // 2.5.5, over horizontal edges alone

/// A point of the profile's plane: distance, height.
using Point = glm::dvec2;

double wavelength(std::size_t band) { return sound_speed_m_s / nominal_hz[band]; }

// ---- lengths in the two conditions ----------------------------------------------------------------------

double ray_radius(double distance_m) { return std::max(1000.0, 8.0 * distance_m); }

/// Length of rays: of chords, or of arcs of one radius.
struct Lengths {
  Condition condition;
  double radius_m;

  double between(Point a, Point b) const {
    const double chord = glm::distance(a, b);
    if (condition == Condition::homogeneous) return chord;
    return 2.0 * radius_m * std::asin(std::min(chord / (2.0 * radius_m), 1.0));
  }
  /// Height of the ray over the straight line from 0 to `length_m`, nearly: a parabola for the arc.
  double rise(double distance_m, double length_m) const {
    return condition == Condition::homogeneous ? 0.0
                                               : distance_m * (length_m - distance_m) / (2.0 * radius_m);
  }
};

double line_at(Point a, Point b, double x) {
  return b.x == a.x ? a.y : a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

/// Path difference over edges, metres; negative for one edge below the straight line (2.5.5, figures 2.5.d
/// and 2.5.e). For curved paths, too, the straight line decides which formula applies.
double path_difference(Point source, std::span<const Point> edges, Point receiver, const Lengths& lengths) {
  const double direct = lengths.between(source, receiver);
  double over = 0.0;
  Point from = source;
  for (const Point edge : edges) over += lengths.between(from, edge), from = edge;
  over += lengths.between(from, receiver);
  if (edges.size() > 1) return over - direct;
  const Point edge = edges.front(), on_line(edge.x, line_at(source, receiver, edge.x));
  if (edge.y >= on_line.y) return over - direct;
  if (lengths.condition == Condition::homogeneous) return direct - over;
  return 2.0 * (lengths.between(source, on_line) + lengths.between(on_line, receiver)) - over - direct;
}

// ---- diffraction, 2.5.5
// -------------------------------------------------------------------------------------

/// C'' of edges of which the first and the last are so far apart.
double several_edges(double between_m, double wavelength_m) {
  if (between_m <= 0.3) return 1.0;
  const double ratio = 5.0 * wavelength_m / between_m;
  return (1.0 + ratio * ratio) / (1.0 / 3.0 + ratio * ratio);
}

/// Δdif in dB of one band for a path difference.
double loss_of_edges(double difference_m, double several, double wavelength_m) {
  const double x = 40.0 / wavelength_m * several * difference_m;
  return x >= -2.0 ? std::max(10.0 * std::log10(3.0 + x), 0.0) : 0.0;
}

/// The same; `between_m` separates the first edge from the last.
double edge_loss(double difference_m, double between_m, double wavelength_m) {
  return loss_of_edges(difference_m, several_edges(between_m, wavelength_m), wavelength_m);
}

// ---- ground, 2.5.3
// ------------------------------------------------------------------------------------------

/// A stretch of ground with its mean plane: least squares over the ground line in plan.
struct MeanPlane {
  double slope = 0.0, offset = 0.0, factor = 0.0;

  double height(Point p) const {
    return std::max((p.y - slope * p.x - offset) / std::hypot(1.0, slope), 0.0);  // below counts as 0
  }
  double along(Point p) const { return (p.x + slope * (p.y - offset)) / std::hypot(1.0, slope); }
  Point image(Point p) const {
    const double out = (p.y - slope * p.x - offset) / (1.0 + slope * slope);
    return p - 2.0 * out * Point(-slope, 1.0);
  }
};

MeanPlane mean_plane(std::span<const GroundPoint> ground, double from_m, double to_m) {
  // Moments about the stretch's first end, exact for straight pieces.
  double m0 = 0.0, mx = 0.0, mz = 0.0, mxx = 0.0, mxz = 0.0, factor = 0.0;
  double last_z = ground.front().z_m;
  for (std::size_t i = 0; i + 1 < ground.size(); ++i) {
    const GroundPoint &a = ground[i], &b = ground[i + 1];
    const double x0 = std::max(a.distance_m, from_m), x1 = std::min(b.distance_m, to_m), w = x1 - x0;
    if (a.distance_m <= from_m) last_z = a.z_m;
    if (w < 1e-9) continue;
    const Point pa(a.distance_m, a.z_m), pb(b.distance_m, b.z_m);
    const double u0 = x0 - from_m, u1 = x1 - from_m, z0 = line_at(pa, pb, x0), z1 = line_at(pa, pb, x1);
    m0 += w, mx += w * (u0 + u1) / 2.0, mz += w * (z0 + z1) / 2.0;
    mxx += w * (u0 * u0 + u0 * u1 + u1 * u1) / 3.0;
    mxz += w * (2.0 * u0 * z0 + 2.0 * u1 * z1 + u0 * z1 + u1 * z0) / 6.0;
    factor += w * a.factor;
  }
  if (m0 < 1e-6) return {0.0, last_z, ground.front().factor};
  const double slope = (m0 * mxz - mx * mz) / (m0 * mxx - mx * mx);
  return {slope, (mz - slope * mx) / m0 - slope * from_m, factor / m0};
}

/// Attenuation by the ground in dB (2.5.15 to 2.5.20). `source_factor`: G at the source, where the lower end
/// of the stretch is the source itself, else the factor of the path.
Octaves ground_attenuation(double source_m, double receiver_m, double length_m, double factor,
                           double source_factor, Condition condition) {
  const bool is_favourable = condition == Condition::favourable;
  const double sum_m = std::max(source_m + receiver_m, 1e-6), dp = std::max(length_m, 1e-3);
  const double test = dp / (30.0 * sum_m);
  const double near_factor = test <= 1.0 ? factor * test + source_factor * (1.0 - test) : factor;  // G'
  double min_db = -3.0 * (1.0 - near_factor);
  if (is_favourable && test > 1.0) min_db *= 1.0 + 2.0 * (1.0 - 1.0 / test);
  Octaves result;
  if (factor == 0.0) {
    result.fill(is_favourable ? min_db : -3.0);
    return result;
  }
  if (is_favourable) {  // curved paths as greater heights, 2.5.19
    const double turbulence_m = 6e-3 * dp / sum_m, bow_m = 1e-4 * dp * dp;
    const double s = source_m / sum_m, r = receiver_m / sum_m;
    source_m += bow_m * s * s + turbulence_m, receiver_m += bow_m * r * r + turbulence_m;
  }
  const double g = is_favourable ? factor : near_factor, g13 = std::pow(g, 1.3), g26 = g13 * g13;
  for (std::size_t i = 0; i < octaves; ++i) {
    const double f = nominal_hz[i], k = 2.0 * std::numbers::pi * f / sound_speed_m_s;
    const double f15 = f * std::sqrt(f), f25 = f15 * f, f075 = std::sqrt(f15);
    const double w = 0.0185 * f25 * g26 / (f15 * g26 + 1.3e3 * f075 * g13 + 1.16e6), wd = w * dp;
    const double cf = dp * (1.0 + 3.0 * wd * std::exp(-std::sqrt(wd))) / (1.0 + wd);
    const auto height = [&](double z) { return z * z - std::sqrt(2.0 * cf / k) * z + cf / k; };
    result[i] =
        std::max(-10.0 * std::log10(4.0 * k * k / (dp * dp) * height(source_m) * height(receiver_m)), min_db);
  }
  return result;
}

/// Ground attenuation over one mean plane between two points of the profile.
Octaves over_plane(const MeanPlane& plane, Point from, Point to, double source_factor, Condition condition) {
  return ground_attenuation(plane.height(from), plane.height(to), plane.along(to) - plane.along(from),
                            plane.factor, source_factor, condition);
}

/// Δground in dB of one side of an edge (2.5.31, 2.5.32): the ground's effect, weighted by how much less the
/// image is screened.
double screened_ground(double ground_db, double image_loss_db, double loss_db) {
  return -20.0 * std::log10(1.0 + (std::pow(10.0, -ground_db / 20.0) - 1.0) *
                                      std::pow(10.0, -(image_loss_db - loss_db) / 20.0));
}

// ---- a vertical cut -------------------------------------------------------------------------------------

struct Cut {
  const Profile& profile;
  Condition condition;
  Lengths lengths;
  Point source, receiver;

  Cut(const Profile& of, Condition in)
      : profile(of),
        condition(in),
        lengths{in, ray_radius(of.distance_m())},
        source(0.0, of.source_z_m),
        receiver(of.length_m(), of.receiver_z_m) {}
};

/// Every point at which the path may be diffracted, by distance: tops of walls, breaks of the ground.
std::vector<Point> candidate_edges(const Profile& profile) {
  std::vector<Point> points;
  points.reserve(profile.ground.size() + profile.walls.size());
  const double end = profile.length_m();
  for (const GroundPoint& p : profile.ground) points.emplace_back(p.distance_m, p.z_m);
  for (const Edge& e : profile.walls) points.emplace_back(e.distance_m, e.z_m);
  std::erase_if(points, [&](Point p) { return p.x < 1e-6 || p.x > end - 1e-6; });
  std::ranges::sort(points, [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  return points;
}

/// The edges over which a string from source to receiver is tight: the upper hull, under curved rays of the
/// heights less what the ray rises.
std::vector<Point> edges_in_the_way(const Cut& cut, std::span<const Point> candidates) {
  std::vector<Point> hull{cut.source};
  const auto lowered = [&](Point p) { return Point(p.x, p.y - cut.lengths.rise(p.x, cut.receiver.x)); };
  const auto add = [&](Point p) {
    while (hull.size() > 1) {
      const Point a = lowered(hull[hull.size() - 2]), b = lowered(hull.back()), c = lowered(p);
      if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) < -1e-9) break;  // a right turn: b stays
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Point p : candidates)
    if (lowered(p).y > line_at(cut.source, cut.receiver, p.x)) add(p);
  add(cut.receiver);
  return {hull.begin() + 1, hull.end() - 1};
}

/// Attenuation that the boundary adds in dB where the path is diffracted over the edges, by band (2.5.5).
struct Diffraction {
  Octaves loss_db{};
  double difference_m = 0.0;        ///< δ
  double image_difference_m = 0.0;  ///< δ*: of the images of source and receiver
};

Diffraction diffracted(const Cut& cut, std::span<const Point> edges) {
  const Point first = edges.front(), last = edges.back();
  const std::span<const GroundPoint> ground(cut.profile.ground);
  const MeanPlane near_source = mean_plane(ground, 0.0, first.x),
                  near_receiver = mean_plane(ground, last.x, cut.receiver.x);
  double between_m = 0.0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) between_m += cut.lengths.between(edges[i], edges[i + 1]);

  const auto difference = [&](Point from, Point to) { return path_difference(from, edges, to, cut.lengths); };
  // A point below its plane has no image: the image's path is its own.
  const Point source_image =
      near_source.height(cut.source) > 0.0 ? near_source.image(cut.source) : cut.source;
  const Point receiver_image =
      near_receiver.height(cut.receiver) > 0.0 ? near_receiver.image(cut.receiver) : cut.receiver;
  const double from_source_image = difference(source_image, cut.receiver),
               to_receiver_image = difference(cut.source, receiver_image);
  const Octaves source_ground =
      over_plane(near_source, cut.source, first, ground.front().factor, cut.condition);
  const Octaves receiver_ground =
      over_plane(near_receiver, last, cut.receiver, near_receiver.factor, cut.condition);

  Diffraction result;
  result.difference_m = difference(cut.source, cut.receiver);
  result.image_difference_m = difference(source_image, receiver_image);
  for (std::size_t i = 0; i < octaves; ++i) {
    const double wave = wavelength(i), loss = edge_loss(result.difference_m, between_m, wave);
    result.loss_db[i] =
        std::min(loss, max_edge_loss_db) +
        screened_ground(source_ground[i], edge_loss(from_source_image, between_m, wave), loss) +
        screened_ground(receiver_ground[i], edge_loss(to_receiver_image, between_m, wave), loss);
  }
  return result;
}

Octaves ground_of_whole_path(const Cut& cut) {
  const MeanPlane plane = mean_plane(cut.profile.ground, 0.0, cut.receiver.x);
  return over_plane(plane, cut.source, cut.receiver, cut.profile.ground.front().factor, cut.condition);
}

double divergence_db(double distance_m) { return 20.0 * std::log10(std::max(distance_m, 0.1)) + 11.0; }

/// Attenuation by ground and edges, in dB.
Octaves boundary(const Cut& cut) {
  const std::vector<Point> candidates = candidate_edges(cut.profile);
  if (const std::vector<Point> edges = edges_in_the_way(cut, candidates); !edges.empty())
    return diffracted(cut, edges).loss_db;

  // In clear sight the edge with the largest path difference diffracts in those bands in which it is near the
  // ray by Rayleigh's criterion (2.5.4).
  Octaves result = ground_of_whole_path(cut);
  const Point* nearest = nullptr;
  double largest_m = -std::numeric_limits<double>::infinity();
  for (const Point& p : candidates)
    if (const double d = path_difference(cut.source, {&p, 1}, cut.receiver, cut.lengths); d > largest_m)
      largest_m = d, nearest = &p;
  if (!nearest || largest_m < -wavelength(0) / 20.0) return result;
  const Diffraction edge = diffracted(cut, {nearest, 1});
  for (std::size_t i = 0; i < octaves; ++i) {
    const double wave = wavelength(i);
    if (edge.difference_m > -wave / 20.0 && edge.difference_m > wave / 4.0 - edge.image_difference_m)
      result[i] = edge.loss_db[i];
  }
  return result;
}

}  // namespace

Octaves attenuation_over(const Profile& profile, const Octaves& air_db_per_m, Condition condition) {
  const Cut cut(profile, condition);
  Octaves result = boundary(cut);
  const double distance_m = profile.distance_m(), divergence = divergence_db(distance_m);
  for (std::size_t i = 0; i < octaves; ++i) result[i] += divergence + air_db_per_m[i] * distance_m;
  return result;
}

Octaves attenuation_around(const Profile& profile, const Detour& detour, const Octaves& air_db_per_m,
                           Condition condition) {
  Octaves result = ground_of_whole_path(Cut(profile, condition));
  const double divergence = divergence_db(detour.direct_m), longer_m = detour.path_m - detour.direct_m;
  for (std::size_t i = 0; i < octaves; ++i) {
    const double wave = wavelength(i);
    const double several = std::pow(several_edges(detour.between_m, wave), 1.0 - detour.grazed[i]) *
                           std::pow(several_edges(detour.with_grazed_m, wave), detour.grazed[i]);
    result[i] += divergence + air_db_per_m[i] * detour.path_m + loss_of_edges(longer_m, several, wave);
  }
  return result;
}

std::optional<Octaves> reflection_loss(const Profile& profile, std::span<const Reflector> reflectors,
                                       Condition condition) {
  const Cut cut(profile, condition);
  const std::vector<Point> edges = edges_in_the_way(cut, candidate_edges(profile));
  Octaves result{};
  for (const Reflector& wall : reflectors) {
    // The ray that reaches the wall leads from the edge before it to the edge behind it.
    const auto behind = std::ranges::find_if(edges, [&](Point edge) { return edge.x > wall.distance_m; });
    const Point from = behind == edges.begin() ? cut.source : *std::prev(behind),
                to = behind == edges.end() ? cut.receiver : *behind, top(wall.distance_m, wall.top_z_m);
    const double ray_z = line_at(from, to, top.x) + cut.lengths.rise(top.x - from.x, to.x - from.x);
    if (ray_z >= top.y || ray_z < wall.bottom_z_m) return std::nullopt;
    // The part of the wave that passes over the edge is lost.
    const double difference_m = -std::abs(path_difference(from, {&top, 1}, to, cut.lengths));
    for (std::size_t i = 0; i < octaves; ++i) {
      constexpr double max_absorption = 0.9999;
      result[i] += -10.0 * std::log10(1.0 - std::min(wall.absorption[i], max_absorption)) +
                   edge_loss(difference_m, 0.0, wavelength(i));
    }
  }
  return result;
}

Octaves edge_loss_db(double difference_m) {
  Octaves result;
  for (std::size_t i = 0; i < octaves; ++i) result[i] = edge_loss(difference_m, 0.0, wavelength(i));
  return result;
}

double rise_of_ray(double distance_m, double length_m, Condition condition) {
  return Lengths{condition, ray_radius(length_m)}.rise(distance_m, length_m);
}

}  // namespace parvis::propagation
