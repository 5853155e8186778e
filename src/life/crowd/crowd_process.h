// The people of a scene that runs.
#pragma once

#include <optional>
#include <vector>

#include "base/random.h"
#include "land/roads/street_crossings.h"
#include "life/crowd/crowd.h"
#include "life/crowd/demand.h"
#include "life/crowd/ground_watch.h"
#include "life/crowd/passengers.h"
#include "life/crowd/scene_ground.h"
#include "life/crowd/shown_people.h"
#include "scene/action/process.h"

namespace parvis::crowd {

/// Name of a person's object, counted from 1 ("person 1"): cameras follow people by these names.
inline std::string person_name(std::size_t person) { return fmt::format("person {}", person + 1); }

/// People who walk between places of the scene's ground, rest there for a while and walk on, as its
/// CrowdDemand asks.
class CrowdProcess final : public action::Process {
 public:
  std::string name() const override { return "crowd"; }
  /// "60 people"; empty where there are none.
  std::string status() const override {
    return shown_.empty() ? "" : fmt::format("{} people", shown_.size());
  }
  /// Puts people on the scene's ground.
  void begin(scene::Scene& scene, action::SharedByProcesses&) override;
  void step(const scene::Scene& scene) override;
  void present(scene::Scene& scene, double ahead_s) override;
  void adapt(scene::Scene& scene, std::span<const glm::vec3> eyes) override {
    if (generated_)
      generated_->adapt(scene, eyes, [this](std::size_t p) { return bodies_[p].posture_at(shown_part_); });
  }
  void set_detail(float share) override {
    if (generated_) generated_->set_detail(share);
  }

  /// The crowd after `begin`; null where nobody walks.
  const Crowd* crowd() const { return crowd_ ? &*crowd_ : nullptr; }
  /// False: people cross at red, too, which benches compare with.
  bool heeds_lights = true;
  /// False: people walk as if no vehicles and trams were there, which benches compare with.
  bool heeds_vehicles = true;
  /// The scene's streets as people see them; null where there is no traffic.
  const scene::StreetTraffic* streets() const { return streets_.get(); }
  /// Who rides trams; nothing where there are no stops.
  const Passengers* passengers() const { return passengers_ ? &*passengers_ : nullptr; }
  /// Generated people; nothing where models of the user's walk.
  const ShownPeople* generated() const { return generated_ ? &*generated_ : nullptr; }

 private:
  /// A person as shown.
  struct Shown {
    std::size_t object = 0;                       ///< of the scene
    const PersonModel* model = nullptr;           ///< null: a generated person
    glm::vec3 before{0.0f}, now{0.0f};            ///< places at the last two steps
    float heading_before = 0.0f, heading = 0.0f;  ///< radians, counter-clockwise from +x
    double walked_before_m = 0.0, walked_m = 0.0;
    bool is_gone = false;  ///< not to be seen
  };

  void populate(const CrowdDemand& demand, const scene::RoadGraph& roads);
  void keep_company();
  void walk();
  void follow_ground(const scene::Scene& scene);
  void come_and_go();
  void follow_presence();
  void add_flows(const CrowdDemand& demand);
  void cross_streets();
  void stay_at_kerbs(const std::vector<glm::vec2>& before);
  void add_objects(scene::Scene& scene, bool is_visible);
  void follow_visibility(scene::Scene& scene);
  int new_destination(Random& random);
  /// True for who is not to be seen: aboard a tram, or not here yet.
  bool is_gone(std::size_t person) const {
    return crowd_->people()[person].is_away && !(passengers_ && passengers_->between(person));
  }

  std::optional<Crowd> crowd_;
  GroundWatch watch_;
  GroundHeights heights_;
  std::vector<PersonModel> models_;
  std::vector<Shown> shown_;
  std::optional<ShownPeople> generated_;     ///< where no model says how people look
  std::vector<people::WalkingBody> bodies_;  ///< of generated people, in their order
  std::vector<Random> randoms_;
  std::vector<int> leaders_;  ///< of each person: whom they walk with, themselves if others follow; -1: alone
  /// A flow of the demand.
  struct RunningFlow {
    glm::vec3 from{0.0f};
    int destination = 0;
    float per_hour = 0.0f;
    double next_s = 0.0;  ///< somebody comes then
    Random random{0};
  };
  std::vector<RunningFlow> flows_;
  double flow_time_s_ = 0.0;
  bool is_short_of_people_ = false;
  std::optional<Passengers> passengers_;                    ///< where there are stops
  std::shared_ptr<scene::StreetTraffic> streets_;           ///< null: no traffic
  std::shared_ptr<std::vector<scene::TransitStop>> stops_;  ///< null: no trams stop
  std::vector<MovingBody> vehicles_;
  long steps_ = 0;
  float shown_part_ = 0.0f;  ///< of a step, at the moment that was presented last
  bool is_visible_ = true;
};

}  // namespace parvis::crowd
