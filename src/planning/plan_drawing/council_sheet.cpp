#include "planning/plan_drawing/council_sheet.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/files.h"
#include "planning/plan_drawing/cairo_module.h"
#include "planning/plan_drawing/plan_files.h"
#include "planning/sun_hours/sun_plan.h"

namespace parvis::plan_drawing {
namespace {

using design::Difference, design::Differs, design::PlacedObject;

std::string detail_of(const std::vector<const Difference*>& alike, const design::Words& words) {
  const PlacedObject& first = alike.front()->shown();
  if (alike.front()->how == Differs::moved) {
    double least = 1e30, most = 0.0;
    for (const Difference* each : alike)
      least = std::min(least, each->moved_m), most = std::max(most, each->moved_m);
    if (most < 0.005) return words("turned");
    return most - least < 0.005 ? words.format("by {:.2f} m", most)
                                : words.format("by {:.2f} to {:.2f} m", least, most);
  }
  if (first.kind == "ground") {
    double area_m2 = 0.0;
    for (const Difference* each : alike) area_m2 += std::abs(design::signed_area_m2(each->shown().outline));
    return words.format("{}, {:.0f} m\u00b2", words(first.material), area_m2);
  }
  const bool is_one_size = std::ranges::all_of(
      alike, [&](const Difference* each) { return each->shown().size_m == first.size_m; });
  if (!is_one_size) return words("of several sizes");
  return words.format("{:.2f} x {:.2f} x {:.2f} m", first.size_m.x, first.size_m.y, first.size_m.z);
}

/// Blue where sun is lost, orange where it is gained, nearly white between; -1 to 1, sRGB from 0 to 255.
glm::vec3 change_colour(double share) {
  const glm::vec3 none(244, 244, 240), lost(28, 76, 160), gained(226, 116, 16);
  return glm::mix(none, share < 0.0 ? lost : gained, float(std::min(std::abs(share), 1.0)));
}

void put(Image8& image, int x, int y, glm::vec3 colour) {
  for (int channel = 0; channel < 3; ++channel)
    image.at(x, y)[channel] = std::uint8_t(std::clamp(colour[channel] + 0.5f, 0.0f, 255.0f));
}

template <class ColourOf>
Image8 picture_of(const SunDifference& sun, const ColourOf& colour_of) {
  Image8 image(sun.columns, sun.rows, 3, 255);
  for (int row = 0; row < sun.rows; ++row)
    for (int column = 0; column < sun.columns; ++column) {
      const std::size_t cell = std::size_t(row) * std::size_t(sun.columns) + std::size_t(column);
      if (sun.is_ground[cell]) put(image, column, sun.rows - 1 - row, colour_of(cell));
    }
  return image;
}

}  // namespace

SunPictures sun_pictures(const SunDifference& sun, const design::Words& words) {
  constexpr int scale_px = 96;
  SunPictures made;
  made.max_hours = sun.max_hours;
  for (std::size_t cell = 0; cell < sun.before.size(); ++cell)
    made.max_change_h =
        std::max(made.max_change_h, std::abs(double(sun.after[cell]) - double(sun.before[cell])));
  made.max_change_h = std::max(1.0, std::ceil(made.max_change_h));
  const auto hours = [&](const std::vector<float>& of) {
    return picture_of(
        sun, [&](std::size_t cell) { return sun_hours::hours_colour(double(of[cell]) / sun.max_hours); });
  };
  made.before = hours(sun.before), made.after = hours(sun.after);
  made.change = picture_of(sun, [&](std::size_t cell) {
    return change_colour((double(sun.after[cell]) - double(sun.before[cell])) / made.max_change_h);
  });
  made.hours_scale = made.change_scale = Image8(scale_px, 1, 3);
  for (int x = 0; x < scale_px; ++x) {
    const double share = (x + 0.5) / scale_px;
    put(made.hours_scale, x, 0, sun_hours::hours_colour(share));
    put(made.change_scale, x, 0, change_colour(2.0 * share - 1.0));
  }
  const double mean_before = sun.mean_hours(sun.before), mean_after = sun.mean_hours(sun.after);
  made.figures.push_back({words("Mean hours of sun per day"), words.format("{:.1f} h", mean_before),
                          words.format("{:.1f} h", mean_after),
                          words.format("{:+.1f} h", mean_after - mean_before)});
  for (const double min_h : {2.0, 4.0}) {
    const double before = sun.area_with_m2(sun.before, min_h), after = sun.area_with_m2(sun.after, min_h);
    made.figures.push_back({words.format("Ground with {:g} hours or more", min_h),
                            words.format("{:.0f} m\u00b2", before), words.format("{:.0f} m\u00b2", after),
                            words.format("{:+.0f} m\u00b2", after - before)});
  }
  made.figures.push_back({words("Ground that loses an hour or more"), "", "",
                          words.format("{:.0f} m\u00b2", sun.area_changed_m2(-1.0))});
  made.figures.push_back({words("Ground that gains an hour or more"), "", "",
                          words.format("{:.0f} m\u00b2", sun.area_changed_m2(1.0))});
  made.figures.push_back(
      {words("Ground in all, without what is built"), "", "", words.format("{:.0f} m\u00b2", sun.area_m2())});
  return made;
}

std::vector<DifferenceRow> difference_rows(const std::vector<Difference>& differences,
                                           const design::Words& words) {
  constexpr std::array order{Differs::removed, Differs::added, Differs::moved, Differs::changed};
  std::vector<DifferenceRow> rows;
  for (const Differs how : order) {
    std::map<std::string, std::vector<const Difference*>> by_label;
    for (const Difference& each : differences) {
      const PlacedObject& object = each.shown();
      if (each.how == how) by_label[object.label.empty() ? object.kind : object.label].push_back(&each);
    }
    for (const auto& [label, alike] : by_label)
      rows.push_back({how, label, int(alike.size()), detail_of(alike, words)});
  }
  return rows;
}

Result<std::pair<glm::dvec2, glm::dvec2>> extent_of(const std::vector<Difference>& differences) {
  if (differences.empty()) return error("the two designs are the same: there is nothing to show");
  glm::dvec2 min(1e30), max(-1e30);
  for (const Difference& each : differences)
    for (const PlacedObject* object : {&each.before, &each.after})
      for (const glm::dvec2& corner : object->outline)
        min = glm::min(min, corner), max = glm::max(max, corner);
  return std::pair(0.5 * (min + max), 0.5 * (max - min));
}

double fitting_scale(glm::dvec2 half_extent_m) {
  constexpr std::array scales{20.0,   50.0,   100.0,  200.0,    250.0,   500.0,
                              1000.0, 2000.0, 5000.0, 10'000.0, 20'000.0};
  constexpr double around_m = 8.0;  // by which the place is recognised
  const glm::dvec2 plan_mm(council_plan_mm);
  for (const double scale : scales)
    if (glm::all(glm::lessThanEqual(2.0 * (half_extent_m + around_m), plan_mm * scale / 1000.0)))
      return scale;
  return max_plan_scale;
}

Status write_council_sheet(const std::filesystem::path& file, const CouncilSheet& sheet) {
  if (Status status = check_scale(sheet.scale); !status) return status;
  return write_atomically(file, [&](const std::filesystem::path& temporary) {
    const SunPictures sun = sheet.sun ? sun_pictures(*sheet.sun, sheet.words) : SunPictures{};
    return cairo.call(&CairoFunctions::draw_council_sheet, temporary, sheet, sun);
  });
}

}  // namespace parvis::plan_drawing
