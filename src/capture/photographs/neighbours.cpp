#include "capture/photographs/neighbours.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/median.h"

namespace parvis::photographs {
namespace {

constexpr double times_the_median = 3.0, always_fine_px = 1.5;
constexpr double share_of_the_median_points = 0.03;

}  // namespace

std::vector<Fit> fits(const PhotographSet& set) {
  std::vector<Fit> result(set.photographs.size());
  std::vector<double> error_sums(set.photographs.size(), 0.0);
  std::map<std::pair<int, int>, int> shared;
  for (const SparsePoint& point : set.points) {
    std::set<int> seen_by;
    for (const Observation& o : point.observations) seen_by.insert(o.photograph);
    if (seen_by.size() < 2) continue;
    for (const Observation& o : point.observations) {
      const std::size_t i = std::size_t(o.photograph);
      const auto pixel = pixel_of_world(set.photographs[i], point.position_in_world);
      if (!pixel) continue;
      ++result[i].points;
      error_sums[i] += glm::distance(*pixel, o.pixel);
    }
    for (auto a = seen_by.begin(); a != seen_by.end(); ++a)
      for (auto b = std::next(a); b != seen_by.end(); ++b) ++shared[{*a, *b}];
  }
  for (const auto& [pair, count] : shared)
    if (count >= min_shared_points) {
      ++result[std::size_t(pair.first)].neighbours;
      ++result[std::size_t(pair.second)].neighbours;
    }
  for (std::size_t i = 0; i < result.size(); ++i)
    if (result[i].points > 0) result[i].reprojection_error_px = error_sums[i] / result[i].points;
  return result;
}

namespace {

/// A photograph of a set, and why its camera does not fit.
struct Misfit {
  std::size_t photograph = 0;
  Error why;
};

std::vector<Misfit> misfits_of(const PhotographSet& set) {
  const std::vector<Fit> all = fits(set);
  std::vector<double> errors;
  std::vector<int> points;
  for (const Fit& fit : all) {
    if (fit.points > 0) errors.push_back(fit.reprojection_error_px);
    points.push_back(fit.points);
  }
  const double max_error = std::max(always_fine_px, times_the_median * median(errors));
  const double min_points = share_of_the_median_points * median(points);
  std::vector<Misfit> misfits;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& name = set.photographs[i].name;
    if (all[i].neighbours == 0)
      misfits.push_back(
          {i,
           error("{}: has no neighbours: no other photograph sees {} or more of its points; it shows another "
                 "place, or its camera is wrong",
                 name, min_shared_points)});
    else if (all[i].points < min_points)
      misfits.push_back(
          {i, error("{}: its camera does not fit its neighbours: {} points agree, of the others' {} (median)",
                    name, all[i].points, median(points))});
    else if (all[i].reprojection_error_px > max_error)
      misfits.push_back(
          {i, error("{}: its camera does not fit its neighbours: points lie {:.1f} pixels off, those of the "
                    "others {:.2f} (median)",
                    name, all[i].reprojection_error_px, median(errors))});
  }
  return misfits;
}

}  // namespace

Errors cameras_that_do_not_fit(const PhotographSet& set) {
  Errors messages;
  for (const Misfit& misfit : misfits_of(set)) messages.push_back(misfit.why);
  return messages;
}

Errors leave_out_what_does_not_fit(PhotographSet& set) {
  const std::vector<Misfit> misfits = misfits_of(set);
  if (misfits.empty() || set.photographs.size() < misfits.size() + 2) return cameras_that_do_not_fit(set);
  std::vector<int> new_index(set.photographs.size(), 0);
  Errors messages;
  for (const Misfit& misfit : misfits) {
    new_index[misfit.photograph] = -1;
    messages.push_back(misfit.why);
    messages.back().message += "; it is left out";
  }
  std::vector<Photograph> kept;
  for (std::size_t i = 0; i < new_index.size(); ++i)
    if (new_index[i] == 0) new_index[i] = int(kept.size()), kept.push_back(set.photographs[i]);
  set.photographs = std::move(kept);
  for (SparsePoint& point : set.points) {
    for (Observation& o : point.observations) o.photograph = new_index[std::size_t(o.photograph)];
    std::erase_if(point.observations, [](const Observation& o) { return o.photograph < 0; });
  }
  std::erase_if(set.points, [](const SparsePoint& point) { return point.observations.size() < 2; });
  return messages;
}

}  // namespace parvis::photographs
