// Lights the objects of litVirtualObject nodes while a scene runs.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "graphics/lit_objects/lit_object.h"
#include "scene/action/process.h"
#include "scene/data/scene.h"

namespace parvis::lit_objects {

inline constexpr const char* lit_type = "litVirtualObject";

/// When the scene begins, all vertices get all their rays. Later each presented moment compares where objects
/// stand, and which of them are visible, with where they stood, and the sky with the one before: what differs
/// is lit again, by rounds of rays for the vertices that have had the fewest, as many as the budget allows.
/// Budgets are counted in rays, not by the clock: the same moments give the same picture.
class LightingProcess final : public action::Process {
 public:
  std::string name() const override { return "lit objects"; }
  void begin(scene::Scene& scene, action::SharedByProcesses& shared) override;
  void present(scene::Scene& scene, double ahead_s) override;
  void settle(scene::Scene& scene) override;

  /// How many rays the vertex has had that has had the fewest; 0 without lit objects.
  int rays() const;

 private:
  /// The input that the sky was made of.
  struct SkySource {
    int version;
    float intensity, heading;
    scene::SunLight sun;
    bool operator==(const SkySource&) const = default;
  };
  /// A thing that may stand in the light.
  struct Standing {
    glm::mat4 world_from_model;
    bool is_visible;
    bool operator==(const Standing&) const = default;
  };

  void find_objects(scene::Scene& scene);
  void follow_nodes(scene::Scene& scene);
  std::vector<Standing> standing_in(const scene::Scene& scene) const;
  void make_casters(const scene::Scene& scene);
  bool follow_casters(const scene::Scene& scene);
  bool follow_sky(const scene::Scene& scene);
  void follow_changes(const scene::Scene& scene, bool is_new_place, bool is_new_sky);
  void refine();

  const scene::LiveScene* live_ = nullptr;
  int edits_ = -1;                ///< of the nodes, that `lit_` knows of; below 0: none yet
  std::size_t object_count_ = 0;  ///< of the scene then
  std::size_t texels_ = 0;
  std::vector<LitObject> lit_;
  std::vector<const scene::Node*> lit_nodes_;  ///< of each
  std::vector<bool> was_visible_;              ///< of each, at the moment before
  std::vector<bool> is_lit_;                   ///< by object
  double budget_ms_ = 0.0;                     ///< 0: none
  int moment_ = 0;                             ///< number of the one that is lit
  double rays_left_ = 0.0;                     ///< of this moment's budget
  bool is_settling_ = false;                   ///< all rays at once, whatever the budget
  std::optional<SkySource> sky_source_;
  std::unique_ptr<light::SkyTable> sky_;
  scene::Scene casters_;  ///< static things and lit objects; others come and go
  std::unique_ptr<reference::RayScene> rays_;
  std::vector<Standing> standing_;
};

}  // namespace parvis::lit_objects
