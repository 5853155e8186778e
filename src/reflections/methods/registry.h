// The methods of reflection that scripts may name, and the overlays that lie over them. A room adds its own
// (`void register_room(Registries&)`) and touches no other file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reflections/methods/reflections.h"
#include "reflections/methods/settings.h"
#include "scene/script/node_registry.h"

namespace parvis::methods {

/// A method of reflection, or an overlay: what lies over any method where the scene asks for it.
struct Method {
  /// Makes it for a scene and the renderer of that scene; both outlive it. `below`: what it lies over; null
  /// for a method that lies over none.
  using Make = Result<std::unique_ptr<Reflections>> (*)(const scene::Scene& scene, render::Renderer& renderer,
                                                        std::unique_ptr<Reflections> below);

  std::string name;  ///< as scripts write it: reflection(method="name")
  std::string help;  ///< one line: what it draws
  Make make = nullptr;
  bool is_overlay = false;
  bool is_default = false;  ///< of the methods, one is
  /// Scenes that leave the choice have this method in place of the default where it is true; null: none.
  bool (*suits)(const scene::Scene& scene) = nullptr;
  std::string suits_where = {};  ///< what such scenes have, for people: "where there are streets"
  std::string lies_over = {};    ///< the name of the method that is made below it; empty: none
  bool (*is_wanted)(const scene::Scene& scene) = nullptr;  ///< of an overlay
  /// Attributes of the node `reflection`; several methods may share one, described alike.
  std::vector<scene::AttributeSchema> attributes = {};
  /// Takes the values of those attributes over into Settings::own.
  void (*read)(const scene::Node& node, Settings& settings) = nullptr;
  /// Changes a scene before it goes to a renderer, if the method is the scene's, or the overlay is wanted.
  void (*prepare)(scene::Scene& scene) = nullptr;
  /// Names of bake steps (render::BakeSteps) whose results a scene of this method never reads.
  std::vector<std::string> unused_bake_steps = {};
  /// A frame shows what earlier frames left: a process that draws some frames alone would draw others.
  bool needs_earlier_frames = false;
};

/// The word by which scripts leave the choice of the method: the first that suits the scene, or the default.
inline constexpr const char* automatic = "automatic";

/// All methods and overlays that rooms have added.
class Registry {
 public:
  /// Names are added once. Overlays lie over one another in the order in which they are added.
  void add(Method method);

  /// Names of the methods in the order in which they were added; overlays have none that scripts write.
  std::vector<std::string> names() const;
  /// Methods and overlays, in the order in which they were added.
  const std::vector<Method>& all() const { return methods_; }
  /// The name of the method that a scene means; empty where it leaves the choice and there is no default.
  std::string name_of(const scene::Scene& scene) const;
  /// The attributes of all methods, each once.
  std::vector<scene::AttributeSchema> attributes() const;
  /// Takes over what the node says for any method.
  void read(const scene::Node& node, Settings& settings) const;

  /// The method of a scene; an error that lists the names where it names none of these.
  Result<const Method*> method_of(const scene::Scene& scene) const { return find(name_of(scene)); }
  /// Whether pictures of the scene may read what the bake step of that name keeps.
  bool reads_baked(const scene::Scene& scene, const std::string& bake_step) const;
  /// Errors of a scene that names no method of these; the message lists those that there are.
  Status prepare(scene::Scene& scene) const;
  /// The scene's method, with the overlays that it wants. Not yet set in the renderer.
  Result<std::unique_ptr<Reflections>> make(const scene::Scene& scene, render::Renderer& renderer) const;

 private:
  Result<const Method*> find(const std::string& name) const;
  Result<std::unique_ptr<Reflections>> make_one(const Method& method, const scene::Scene& scene,
                                                render::Renderer& renderer) const;

  std::vector<Method> methods_;
};

/// Adds the node `reflection`, whose attributes are those of all methods in the registry; to be called when
/// they have been added.
void add_reflection_node(scene::NodeRegistry& nodes, const Registry& registry);

}  // namespace parvis::methods
