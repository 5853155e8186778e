// Who may enter shared lanes (turns through crossings): a vehicle asks for all of them up to the next place
// where it can stand without being in the way, and gets all or none. So whoever has entered can leave, and
// nobody waits inside for somebody who waits for him. First come, first served, unless ways do not touch; who
// has waited long is not passed over any more.
#pragma once

#include <span>
#include <vector>

#include "life/traffic/lane_network.h"

namespace parvis::traffic {

class RightOfWay {
 public:
  explicit RightOfWay(const std::vector<DrivingLane>& lanes)
      : lanes_(lanes), holders_(lanes.size(), 0), barred_(lanes.size(), 0) {}

  /// Begins a round of requests, which come in the order of their age.
  void begin_round() { ++round_; }

  /// Gives `wanted` if no other vehicle holds a lane in conflict with one of them; `held` are the asking
  /// vehicle's own. A request refused after `waited_s` of waiting bars the lanes that are in its way to all
  /// later ones.
  bool request(std::span<const int> wanted, std::span<const int> held, float waited_s);

  void release(int lane) { --holders_[std::size_t(lane)]; }

 private:
  bool is_free(int lane, std::span<const int> held) const;

  const std::vector<DrivingLane>& lanes_;
  std::vector<int> holders_;  ///< how many vehicles hold each lane
  std::vector<int> barred_;   ///< the last round in which each lane was barred
  int round_ = 0;
};

}  // namespace parvis::traffic
