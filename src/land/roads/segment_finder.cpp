#include "land/roads/segment_finder.h"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <utility>

namespace parvis::scene {
namespace {

namespace geometry = boost::geometry;
using Point = geometry::model::d2::point_xy<float>;
using Box = geometry::model::box<Point>;
using Entry = std::pair<Box, std::size_t>;

Box as_box(const PlanBox& box) { return {{box.min.x, box.min.y}, {box.max.x, box.max.y}}; }

std::vector<Entry> numbered(const std::vector<PlanBox>& boxes) {
  std::vector<Entry> entries;
  entries.reserve(boxes.size());
  for (const PlanBox& box : boxes) entries.emplace_back(as_box(box), entries.size());
  return entries;
}

}  // namespace

struct SegmentFinder::Tree {
  geometry::index::rtree<Entry, geometry::index::linear<16>> boxes;
};

SegmentFinder::SegmentFinder(const std::vector<PlanBox>& boxes)
    : tree_(std::make_unique<Tree>(Tree{decltype(Tree::boxes)(numbered(boxes))})) {}

SegmentFinder::~SegmentFinder() = default;

void SegmentFinder::find(const PlanBox& box, std::size_t after, std::vector<std::size_t>& found) const {
  found.clear();
  const auto end = tree_->boxes.qend();
  for (auto entry = tree_->boxes.qbegin(geometry::index::intersects(as_box(box))); entry != end; ++entry)
    if (entry->second > after) found.push_back(entry->second);
  std::ranges::sort(found);
}

}  // namespace parvis::scene
