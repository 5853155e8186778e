// Methods of reflection judged, and timed, in the same near views: FLIP inside the reflective pixels of near
// cars, against the ray tracer.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/reflections/judged_method.h"
#include "bench/reflections/views.h"

namespace parvis::bench {

/// The compared methods, and how thoroughly they are compared.
struct Comparison {
  WantedMethods methods;  ///< by the names that rows use; the first is "none" where any is timed
  NearViewWish wish = {};
  int views = 8;
  glm::ivec2 size = full_picture;  ///< of the pictures that are judged; {0, 0}: none is
  int samples_per_pixel = 16;      ///< of the ground truth, whose shadows are the maps of the picture
  int repeats = 0;                 ///< with which each view is timed, at full size; 0: none is
  double step_s = 1e-3 * near_frame_step_ms;                                         ///< between timed frames
  std::function<void(const NearView&, const std::vector<JudgedMethod>&)> also = {};  ///< in each view
};

/// The measure that a row of a table reports.
enum class Measure : unsigned char {
  flip,        ///< mean FLIP; over that of another method
  worst_flip,  ///< the largest ratio of FLIP over views
  cost         ///< median of the ratios of milliseconds, in turn
};

/// One figure: a method, and what it is compared with.
struct MethodRow {
  const char* key;
  Measure measure;
  const char* method;
  const char* over = "";  ///< empty: by itself; "best": re-rendered maps with levels of detail or without,
                          ///< which cost less
};

/// Figures of each method in each view.
struct Compared {
  struct Method {
    std::string name;
    std::vector<double> flip, ms;
  };
  std::vector<Method> methods;
  std::vector<bool> is_at_crossing;  ///< of each view
  std::vector<double> seen;          ///< reflecting cars that "rerendered" drew, of each timed view

  /// Fails where no method has this name.
  const Method& method(const std::string& name) const;
  /// The value of a row.
  double value(const MethodRow& row) const;
  /// Notes each method's mean and views, and adds all rows.
  void report(std::span<const MethodRow> rows, Report& report) const;
};

/// Lets the stage's traffic drive from view to view.
Compared compared(stage::Stage& stage, const Comparison& comparison);

}  // namespace parvis::bench
