#include "capture/trees/consistent_views.h"

#include <fmt/format.h>

#include <ranges>

#include "capture/trees/visual_hull.h"

namespace parvis::trees {

std::vector<std::string> inconsistency_notes(std::span<const TreeView> views,
                                             std::span<const std::size_t> wrong, bool keeps) {
  std::vector<std::string> notes;
  for (const std::size_t i : wrong)
    notes.push_back(fmt::format(
        "{}: its silhouette contradicts all other photographs: the camera or the matte is wrong; {}",
        views[i].name, keeps ? "used all the same" : "left out (--keep-inconsistent uses it all the same)"));
  return notes;
}

std::vector<std::string> leave_out_inconsistent(std::vector<TreeView>& views, bool keeps) {
  const std::vector<std::size_t> wrong = inconsistent_views(views, silhouettes(views));
  std::vector<std::string> notes = inconsistency_notes(views, wrong, keeps);
  if (!keeps)
    for (const std::size_t i : std::views::reverse(wrong)) views.erase(views.begin() + std::ptrdiff_t(i));
  return notes;
}

}  // namespace parvis::trees
