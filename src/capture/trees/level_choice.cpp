#include "capture/trees/level_choice.h"

namespace parvis::trees {

std::vector<std::size_t> levels_in_view(std::span<const TreeInView> trees, const TreeDetail& detail) {
  std::vector<std::size_t> levels;
  levels.reserve(trees.size());
  std::size_t billboards = 0;
  for (const TreeInView& in_view : trees) {
    levels.push_back(level_for(*in_view.tree, in_view.seen, detail.limits));
    billboards += in_view.tree->levels[levels.back()].grid.size();
  }
  for (std::size_t i = 0; i < trees.size() && billboards < detail.affordable_billboards; ++i) {
    const std::vector<BillboardTree>& own = trees[i].tree->levels;
    const std::size_t finer = level_for(*trees[i].tree, trees[i].seen, detail.finer_limits);
    if (finer >= levels[i]) continue;
    const std::size_t more = own[finer].grid.size() - own[levels[i]].grid.size();
    if (billboards + more > detail.affordable_billboards) break;
    billboards += more, levels[i] = finer;
  }
  return levels;
}

}  // namespace parvis::trees
