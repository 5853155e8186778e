#include "bench/trees/means.h"

#include <algorithm>
#include <cmath>

namespace parvis::trees {

Status Means::report() const {
  for (const Entry& entry : entries_) {
    const double mean = entry.sum / entry.count;
    if (!std::isfinite(mean)) return error("{}: the figure is {}, no number", entry.key, mean);
    if (!entry.target)
      report_.add(entry.key, mean);
    else if (entry.is_control)
      report_.add_control(entry.key, mean, *entry.target);
    else
      report_.add(entry.key, mean, *entry.target);
  }
  return Done{};
}

void Means::add_to(const std::string& key, double value, const std::optional<bench::Target>& target,
                   bool is_control) {
  report_.note(fmt::format("{}: {} {:.4g}", tree_, key, value));
  auto entry = std::ranges::find(entries_, key, &Entry::key);
  if (entry == entries_.end()) entry = entries_.insert(entries_.end(), {key, 0.0, 0.0, target, is_control});
  entry->sum += value, entry->count += 1.0;
}

}  // namespace parvis::trees
