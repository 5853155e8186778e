// Few sets that cover much: greedy set cover, improved by exchange.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace parvis::reference_maps {

/// Sets of the elements 0 .. element_count - 1, some of which may not be chosen together.
class SetCover {
 public:
  using Elements = std::vector<std::uint32_t>;
  using Chosen = std::vector<std::size_t>;  ///< indices of sets

  /// `go_together` is symmetric.
  SetCover(std::vector<Elements> sets, std::size_t element_count,
           std::function<bool(std::size_t, std::size_t)> go_together);

  /// Each next set adds the most elements; up to `maximum` of them, until `enough` elements are covered or
  /// none adds any.
  Chosen greedy(std::size_t maximum, std::size_t enough) const;
  /// Improves `start`, whose sets go together: puts other sets in place of single ones while that covers
  /// more, and leaves sets out while `enough` elements remain covered.
  Chosen improved(const Chosen& start, std::size_t enough) const;

 private:
  class State;

  std::vector<Elements> sets_;
  std::vector<Elements> holders_;  ///< of each element: the sets that hold it
  std::function<bool(std::size_t, std::size_t)> go_together_;
};

}  // namespace parvis::reference_maps
