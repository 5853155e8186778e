#include "capture/facades/stacks.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <span>
#include <unordered_set>

#include "capture/facades/item_buffer.h"

namespace parvis::facades {
namespace {

struct Found {
  std::unordered_set<Stack> stacks;
  std::vector<bool> is_visible;
  Stack last;  ///< most pixels have their neighbour's stack
};

/// Takes the items that are not visible out of a stack.
Stack visible_part(const Stack& stack, const std::vector<bool>& is_visible) {
  Stack part;
  for (const char32_t item : stack)
    if (is_visible[item]) part.push_back(item);
  return part;
}

/// Tarjan's algorithm without recursion: chains of occlusion are as long as the model is large.
class Components {
 public:
  explicit Components(const std::vector<std::vector<std::uint32_t>>& edges)
      : edges_(edges), order_(edges.size(), 0), low_(edges.size(), 0), on_stack_(edges.size(), false) {
    for (std::uint32_t v = 0; v < edges.size(); ++v)
      if (!order_[v]) search(v);
  }
  std::vector<std::vector<std::uint32_t>> components;

 private:
  struct Visit {
    std::uint32_t vertex;
    std::size_t next;
  };

  void enter(std::uint32_t v) {
    order_[v] = low_[v] = ++counter_;
    stack_.push_back(v), on_stack_[v] = true;
    visits_.push_back({v, 0});
  }
  void leave(std::uint32_t v) {
    if (low_[v] == order_[v]) {
      std::vector<std::uint32_t>& component = components.emplace_back();
      do {
        component.push_back(stack_.back()), on_stack_[stack_.back()] = false, stack_.pop_back();
      } while (component.back() != v);
      std::ranges::sort(component);
    }
    visits_.pop_back();
    if (!visits_.empty()) low_[visits_.back().vertex] = std::min(low_[visits_.back().vertex], low_[v]);
  }
  void search(std::uint32_t from) {
    enter(from);
    while (!visits_.empty()) {
      Visit& visit = visits_.back();
      const std::uint32_t v = visit.vertex;
      if (visit.next == edges_[v].size()) {
        leave(v);
        continue;
      }
      const std::uint32_t w = edges_[v][visit.next++];
      if (!order_[w])
        enter(w);
      else if (on_stack_[w])
        low_[v] = std::min(low_[v], order_[w]);
    }
  }

  const std::vector<std::vector<std::uint32_t>>& edges_;
  std::vector<std::uint32_t> order_, low_, stack_;
  std::vector<bool> on_stack_;
  std::vector<Visit> visits_;
  std::uint32_t counter_ = 0;
};

}  // namespace

Stacks distinct_stacks(const LayerModel& model, const View& view,
                       std::span<const std::uint32_t> item_of_triangle, std::uint32_t item_count) {
  tbb::enumerable_thread_specific<Found> per_thread([&] {
    return Found{{}, std::vector<bool>(item_count), {}};
  });
  visit_stacks(model, view, false, {}, [&](int, int, std::span<const Fragment> fragments) {
    Found& found = per_thread.local();
    const std::uint32_t first = item_of_triangle[fragments.front().triangle];
    if (first != no_item) found.is_visible[first] = true;
    Stack stack;
    for (const Fragment& fragment : fragments)
      if (const std::uint32_t item = item_of_triangle[fragment.triangle];
          item != no_item && has_layer_pixel(model, fragment, fragments))
        stack.push_back(item);
    if (stack.empty() || stack == found.last) return;
    found.last = stack;
    found.stacks.insert(std::move(stack));
  });
  Stacks result;
  result.is_visible.assign(item_count, false);
  for (const Found& found : per_thread)
    for (std::size_t i = 0; i < item_count; ++i)
      if (found.is_visible[i]) result.is_visible[i] = true;
  std::unordered_set<Stack> all;
  for (const Found& found : per_thread)
    for (const Stack& stack : found.stacks)
      if (Stack part = visible_part(stack, result.is_visible); !part.empty()) all.insert(std::move(part));
  result.distinct.assign(all.begin(), all.end());
  std::ranges::sort(result.distinct);
  return result;
}

std::vector<std::vector<std::uint32_t>> direct_occlusion(const std::vector<Stack>& stacks,
                                                         std::uint32_t item_count) {
  std::vector<std::vector<std::uint32_t>> hides(item_count);
  for (const Stack& stack : stacks)
    for (std::size_t i = 1; i < stack.size(); ++i) hides[stack[i - 1]].push_back(stack[i]);
  for (std::vector<std::uint32_t>& behind : hides) {
    std::ranges::sort(behind);
    behind.erase(std::unique(behind.begin(), behind.end()), behind.end());
  }
  return hides;
}

std::vector<std::vector<std::uint32_t>> cycles(const std::vector<std::vector<std::uint32_t>>& hides) {
  std::vector<std::vector<std::uint32_t>> found = std::move(Components(hides).components);
  std::erase_if(found, [&](const std::vector<std::uint32_t>& component) {
    return component.size() == 1 && !std::ranges::binary_search(hides[component[0]], component[0]);
  });
  std::ranges::sort(found);
  return found;
}

}  // namespace parvis::facades
