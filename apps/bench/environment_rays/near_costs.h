// What reflections cost where they are looked at: near the eye, in the street.
#pragma once

#include "bench/environment_rays/near_views.h"
#include "bench/judged_method.h"
#include "bench/report.h"
#include "house/stage/stage.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {

/// Between the frames that are timed, as in a film: cars drive on.
inline constexpr double timed_step_s = 1.0 / 30.0;

/// Milliseconds of each near view.
struct NearCosts {
  std::vector<double> mem_ms, traced_ms, local_ms;
  std::vector<double> full_ms, lod_ms;  ///< re-rendered, with maps of full size and with levels of detail
  std::vector<double> seen;             ///< reflecting cars
  std::vector<double> face_ms;          ///< of one re-rendered face of full size

  /// Re-rendered maps at their best: the variant that costs less over all views.
  const std::vector<double>& rerendered_ms() const {
    return median(lod_ms).value < median(full_ms).value ? lod_ms : full_ms;
  }
};

/// Times `shipped`, traced, local and re-rendered reflections at 1280 x 720 in one near view after another.
class NearTimer {
 public:
  /// An error where one of the methods cannot be made.
  static Result<NearTimer> create(house::Stage& stage, const methods::Settings& shipped, int repeats);

  /// Adds a view; traffic drives on by a frame from repetition to repetition.
  Status time(const NearView& view);

  /// Of the views that were timed.
  const NearCosts& costs() const { return costs_; }
  /// None, shipped, traced, local, re-rendered, re-rendered with levels of detail.
  const std::vector<JudgedMethod>& methods() const { return methods_; }

 private:
  NearTimer(house::Stage& stage, std::vector<JudgedMethod> methods, int repeats)
      : stage_(&stage), methods_(std::move(methods)), repeats_(repeats) {}

  house::Stage* stage_;
  std::vector<JudgedMethod> methods_;
  int repeats_;
  NearCosts costs_;
};

/// The same in so many near views.
Result<NearCosts> near_costs(house::Stage& stage, const methods::Settings& shipped, const NearViewWish& wish,
                             int views, int repeats);

/// `near_cost_ratio_rerendered_over_mem`, in street-level views of a near car in which ten of the city's
/// thirty are seen, with `near_flip_ratio_mem_over_rerendered` of the same views, and controls.
Status measure_near_costs(house::Stage& stage, const methods::Settings& shipped, bool is_quick,
                          Report& report);

}  // namespace parvis::bench
