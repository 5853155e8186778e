// One budget for all that a window does in a frame: what a frame takes beyond it is lowered in a stated
// order, and raised again in the reverse one.
#pragma once

#include <array>
#include <cstddef>

namespace parvis::stage {

/// The parts of a frame that are lowered, in this order, once a picture has as few pixels as PictureScale
/// allows; sound last, since it takes least and a gap in it is noticed most.
enum class Lowered : unsigned char { reflections, people, sound };
inline constexpr std::size_t lowered_count = 3;

/// Decides how much of each is left.
class SharedBudget {
 public:
  static constexpr int frames_before_lowering = 12, frames_before_raising = 45;
  static constexpr double min_share = 0.25;

  /// Takes a frame of `frame_ms` under a budget (0: none, all is whole again at once). `is_smallest`: its
  /// picture had as few pixels as pictures have.
  void frame_took(double frame_ms, double budget_ms, bool is_smallest);

  /// The fraction that is left of one of them, min_share to 1.
  double share(Lowered what) const { return shares_[std::size_t(what)]; }

 private:
  void lower();
  void raise();

  std::array<double, lowered_count> shares_{1.0, 1.0, 1.0};
  int frames_over_ = 0, frames_with_room_ = 0;  ///< one after the other
};

}  // namespace parvis::stage
