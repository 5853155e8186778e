#include "capture/photographs/clicked_camera.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace parvis::photographs {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double click_sigma_px = 1.0, distortion_sigma = 0.05, focal_sigma = 0.05;
constexpr double centre_sigma_of_width = 0.01;
constexpr double max_error_of_width = 0.02;  ///< beyond it a click belongs to another point

/// A first estimate in OpenCV's frame: x_camera = rotation (X - position).
struct Estimate {
  Matrix3d rotation;
  Vector3d position;
  double focal_px;
};

/// The points, moved and scaled so that numbers are near 1.
struct Problem {
  std::vector<Vector2d> pixels;  ///< from the picture's centre
  std::vector<Vector3d> places;
  Vector3d middle{0.0, 0.0, 0.0};
  double scale = 1.0;
  double width = 0.0, height = 0.0;
  std::optional<double> focal_px;
};

Problem problem_of(std::span<const ClickedPoint> points, int width, int height, std::optional<double> focal) {
  Problem problem;
  problem.width = width, problem.height = height, problem.focal_px = focal;
  for (const ClickedPoint& each : points) {
    problem.pixels.emplace_back(each.pixel.x - 0.5 * width, each.pixel.y - 0.5 * height);
    const glm::dvec3& p = each.position_in_world;
    problem.middle += Vector3d(p.x, p.y, p.z) / double(points.size());
  }
  double spread = 0.0;
  for (const ClickedPoint& each : points) {
    const glm::dvec3& p = each.position_in_world;
    problem.places.push_back(Vector3d(p.x, p.y, p.z) - problem.middle);
    spread = std::max(spread, problem.places.back().norm());
  }
  problem.scale = std::max(spread, 1e-9);
  for (Vector3d& place : problem.places) place /= problem.scale;
  return problem;
}

Matrix3d nearest_rotation(const Matrix3d& matrix) {
  const Eigen::JacobiSVD<Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d turn = Matrix3d::Identity();
  turn(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * turn * svd.matrixV().transpose();
}

/// The unit vector that a matrix makes smallest.
VectorXd smallest_direction(const MatrixXd& rows) {
  const Eigen::JacobiSVD<MatrixXd> svd(rows, Eigen::ComputeFullV);
  return svd.matrixV().col(svd.matrixV().cols() - 1);
}

/// Adds the estimate of the direct linear transformation: square pixels, the principal point in the centre.
void add_linear_estimate(const Problem& problem, std::vector<Estimate>& estimates) {
  MatrixXd rows(2 * problem.places.size(), 12);
  for (std::size_t i = 0; i < problem.places.size(); ++i) {
    const Eigen::Vector4d place = problem.places[i].homogeneous();
    const Vector2d at = problem.pixels[i] / problem.width;
    const Eigen::Index row = Eigen::Index(2 * i);
    rows.row(row) << place.transpose(), Eigen::RowVector4d::Zero(), -at.x() * place.transpose();
    rows.row(row + 1) << Eigen::RowVector4d::Zero(), place.transpose(), -at.y() * place.transpose();
  }
  const VectorXd p = smallest_direction(rows);
  Matrix3d left;
  left << p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10];
  if (std::abs(left.determinant()) < 1e-12) return;
  const double sign = left.determinant() < 0.0 ? -1.0 : 1.0, depth = left.row(2).norm();
  left *= sign / depth;
  const Vector3d last = Vector3d(p[3], p[7], p[11]) * sign / depth;
  const Vector3d forward = left.row(2);
  const double fx = left.row(0).transpose().cross(forward).norm(),
               fy = left.row(1).transpose().cross(forward).norm();
  Matrix3d turned;
  turned.row(0) = (left.row(0) - left.row(0).dot(forward) * forward.transpose()) / fx;
  turned.row(1) = (left.row(1) - left.row(1).dot(forward) * forward.transpose()) / fy;
  turned.row(2) = forward;
  estimates.push_back({nearest_rotation(turned), -left.inverse() * last, 0.5 * (fx + fy) * problem.width});
}

/// Adds estimates by the homography of the plane that fits the points best, for some focal lengths: of points
/// on the ground alone the linear one finds nothing.
void add_plane_estimates(const Problem& problem, std::vector<Estimate>& estimates) {
  MatrixXd spread(problem.places.size(), 3);
  for (std::size_t i = 0; i < problem.places.size(); ++i) spread.row(Eigen::Index(i)) = problem.places[i];
  const Eigen::JacobiSVD<MatrixXd> svd(spread, Eigen::ComputeFullV);
  Matrix3d axes = svd.matrixV();  // columns: two in the plane, its normal
  if (axes.determinant() < 0.0) axes.col(2) *= -1.0;
  MatrixXd rows(2 * problem.places.size(), 9);
  for (std::size_t i = 0; i < problem.places.size(); ++i) {
    const Vector3d place = axes.transpose() * problem.places[i], on_plane(place.x(), place.y(), 1.0);
    const Vector2d at = problem.pixels[i] / problem.width;
    const Eigen::Index row = Eigen::Index(2 * i);
    rows.row(row) << on_plane.transpose(), Eigen::RowVector3d::Zero(), -at.x() * on_plane.transpose();
    rows.row(row + 1) << Eigen::RowVector3d::Zero(), on_plane.transpose(), -at.y() * on_plane.transpose();
  }
  const VectorXd h = smallest_direction(rows);
  Matrix3d homography;
  homography << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  for (const double focal : {0.5, 0.7, 0.9, 1.2, 1.6, 2.2, 3.2}) {
    Matrix3d turned = homography;
    turned.topRows(2) /= focal;
    turned /= 0.5 * (turned.col(0).norm() + turned.col(1).norm());
    if (turned(2, 2) < 0.0) turned = -turned;  // the plane's middle lies before the camera
    const Vector3d translation = turned.col(2);
    turned.col(2) = turned.col(0).cross(turned.col(1));
    const Matrix3d rotation = nearest_rotation(turned) * axes.transpose();
    estimates.push_back({rotation, -rotation.transpose() * translation, focal * problem.width});
  }
}

/// The function that is minimised: distances from clicks and from what is probable, in standard deviations.
/// Variables: a rotation vector after the estimate's rotation, the position, the logarithm of the focal
/// length over the estimate's, the principal point, the distortion.
struct Residuals {
  static constexpr int variables = 10;
  // As Eigen's search asks for them.
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
  int inputs() const { return variables; }
  int values() const { return int(2 * problem.pixels.size()) + (problem.focal_px ? 4 : 3); }

  Matrix3d rotation(const VectorXd& x) const {
    const Vector3d turn = x.head<3>();
    const double angle = turn.norm();
    if (angle < 1e-12) return estimate.rotation;
    return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * estimate.rotation;
  }
  Vector3d position(const VectorXd& x) const { return estimate.position + x.segment<3>(3); }
  double focal_px(const VectorXd& x) const { return estimate.focal_px * std::exp(x[6]); }
  Vector2d centre_px(const VectorXd& x) const {
    return x.segment<2>(7) * centre_sigma_of_width * problem.width;
  }
  double distortion(const VectorXd& x) const { return x[9] * distortion_sigma; }

  int operator()(const VectorXd& x, VectorXd& out) const {
    const Matrix3d turned = rotation(x);
    const Vector3d eye = position(x);
    for (std::size_t i = 0; i < problem.pixels.size(); ++i) {
      const Vector3d seen = turned * (problem.places[i] - eye);
      const double depth = std::max(seen.z(), 1e-6);  // what is behind the camera is far off in the picture
      const Vector2d flat = seen.head<2>() / depth;
      const Vector2d at = focal_px(x) * (1.0 + distortion(x) * flat.squaredNorm()) * flat + centre_px(x);
      out.segment<2>(Eigen::Index(2 * i)) = (at - problem.pixels[i]) / click_sigma_px;
    }
    Eigen::Index row = Eigen::Index(2 * problem.pixels.size());
    for (int i = 7; i < variables; ++i) out[row++] = x[i];
    if (problem.focal_px) out[row] = std::log(focal_px(x) / *problem.focal_px) / focal_sigma;
    return 0;
  }

  const Problem& problem;
  const Estimate& estimate;
};

struct Refined {
  VectorXd x;
  double cost = 0.0;
  bool sees_all = false;
};

Refined refine(const Residuals& residuals, const Problem& problem) {
  Refined refined{VectorXd::Zero(Residuals::variables)};
  Eigen::NumericalDiff<Residuals, Eigen::Central> differences(residuals);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals, Eigen::Central>> search(differences);
  search.parameters.maxfev = 4000;
  search.parameters.xtol = 1e-12, search.parameters.ftol = 1e-12;
  search.minimize(refined.x);
  refined.cost = search.fnorm;
  const Matrix3d rotation = residuals.rotation(refined.x);
  const Vector3d eye = residuals.position(refined.x);
  refined.sees_all = refined.x.allFinite() && std::isfinite(refined.cost) &&
                     std::ranges::all_of(problem.places, [&](const Vector3d& place) {
                       return (rotation * (place - eye)).z() > 1e-6;
                     });
  return refined;
}

Photograph photograph_of(const Residuals& residuals, const VectorXd& x, const Problem& problem) {
  Photograph photograph;
  const double focal = residuals.focal_px(x);
  const Vector2d centre = residuals.centre_px(x) + 0.5 * Vector2d(problem.width, problem.height);
  photograph.lens.model = LensModel::simple_radial;
  photograph.lens.width = int(problem.width), photograph.lens.height = int(problem.height);
  photograph.lens.parameters = {focal, centre.x(), centre.y(), residuals.distortion(x)};
  const Matrix3d rotation = residuals.rotation(x);
  const Vector3d eye = problem.scale * residuals.position(x) + problem.middle;
  const Vector3d translation = -rotation * eye;
  glm::dmat4 camera_from_world(1.0);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) camera_from_world[column][row] = rotation(row, column);
  camera_from_world[3] = glm::dvec4(translation.x(), translation.y(), translation.z(), 1.0);
  photograph.world_from_camera = world_from_camera_of_opencv(camera_from_world);
  return photograph;
}

Status expect_spread(const Problem& problem) {
  MatrixXd spread(problem.places.size(), 3);
  for (std::size_t i = 0; i < problem.places.size(); ++i) spread.row(Eigen::Index(i)) = problem.places[i];
  const Eigen::JacobiSVD<MatrixXd> svd(spread);
  if (svd.singularValues()[1] < 1e-3 * svd.singularValues()[0])
    return error("the points lie on one line; click corners that are spread over the picture");
  return Ok{};
}

/// The best camera of the points; nothing where none has all of them before it.
std::optional<ClickedCamera> best_camera(std::span<const ClickedPoint> points, const Problem& problem) {
  std::vector<Estimate> estimates;
  add_linear_estimate(problem, estimates);
  add_plane_estimates(problem, estimates);
  std::optional<ClickedCamera> best;
  double best_cost = 0.0;
  for (const Estimate& estimate : estimates) {
    const Residuals residuals{problem, estimate};
    const Refined refined = refine(residuals, problem);
    if (!refined.sees_all || (best && refined.cost >= best_cost)) continue;
    best_cost = refined.cost;
    best = ClickedCamera{photograph_of(residuals, refined.x, problem), {}};
  }
  if (best)
    for (const ClickedPoint& each : points) {
      const std::optional<glm::dvec2> at = pixel_of_world(best->photograph, each.position_in_world);
      best->errors_px.push_back(at ? glm::distance(*at, each.pixel) : problem.width);
    }
  return best;
}

bool fits(const std::optional<ClickedCamera>& camera, int width) {
  return camera && std::ranges::max(camera->errors_px) <= max_error_of_width * width;
}

/// Why no camera fits: the point without which one does, where there is such a point.
Error no_camera(std::span<const ClickedPoint> points, int width, int height, std::optional<double> focal_px) {
  for (std::size_t i = 0; points.size() > min_clicked_points && i < points.size(); ++i) {
    std::vector<ClickedPoint> others(points.begin(), points.end());
    others.erase(others.begin() + std::ptrdiff_t(i));
    const std::optional<ClickedCamera> camera =
        best_camera(others, problem_of(others, width, height, focal_px));
    if (!fits(camera, width)) continue;
    const std::optional<glm::dvec2> at = pixel_of_world(camera->photograph, points[i].position_in_world);
    return error(
        "no camera explains the points: point {} (at {:.0f},{:.0f}) does not fit the others{}; is it another "
        "point of "
        "the place?",
        i + 1, points[i].pixel.x, points[i].pixel.y,
        at ? fmt::format(", which show it at {:.0f},{:.0f}", at->x, at->y)
           : ", which have it behind the camera");
  }
  return error(
      "no camera explains the points; is one of them another point of the place, or the picture of another "
      "size? "
      "Seven points or more show which");
}

}  // namespace

Result<std::vector<ClickedPoint>> parse_clicked_points(std::string_view text, const std::string& name) {
  std::vector<ClickedPoint> points;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    line = line.substr(0, line.find('#'));
    std::array<double, 5> values{};
    std::size_t count = 0;
    bool is_bad = false;
    for (const char *now = line.data(), *last = now + line.size(); now < last;) {
      if (std::string_view(" \t\r,=").find(*now) != std::string_view::npos) {
        ++now;
        continue;
      }
      double value = 0.0;
      const std::from_chars_result read = std::from_chars(now, last, value);
      if (read.ec != std::errc() || count == values.size() || !(std::abs(value) < 1e8)) {
        is_bad = true;
        break;
      }
      values[count++] = value;
      now = read.ptr;
    }
    if (count == 0 && !is_bad) continue;
    if (is_bad || count != values.size())
      return error_at({name, number, 1}, "expected a point \"x y X Y Z\": two pixels, then three metres");
    points.push_back({{values[0], values[1]}, {values[2], values[3], values[4]}});
  }
  return points;
}

Result<ClickedCamera> camera_of_points(std::span<const ClickedPoint> points, int width, int height,
                                       std::optional<double> focal_px) {
  if (points.size() < min_clicked_points)
    return error("{} points; a camera takes {} at least, spread over the picture", points.size(),
                 min_clicked_points);
  const Problem problem = problem_of(points, width, height, focal_px);
  if (Status status = expect_spread(problem); !status) return status.errors();
  std::optional<ClickedCamera> camera = best_camera(points, problem);
  if (!fits(camera, width)) return no_camera(points, width, height, focal_px);
  return *std::move(camera);
}

}  // namespace parvis::photographs
