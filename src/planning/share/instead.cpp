#include "planning/share/instead.h"

#include <array>
#include <map>

#include "scene/data/lamp.h"

namespace parvis::share {
namespace {

struct Substitute {
  const char *type, *instead;
};

constexpr std::array substitutes{
    Substitute{"traffic", "vehicles stand where they are when the site is written"},
    Substitute{"tram", "it stands where it is when the site is written"},
    Substitute{"crowd", "people stand where they are when the site is written"},
    Substitute{"path", "what follows it stands where it is when the site is written"},
    Substitute{"tour", "the saved views can be chosen one by one"},
    Substitute{"keys", "no key or button of the scene acts; the scenarios can be chosen"},
    Substitute{"timer", "nothing happens by itself"},
    Substitute{"proximity", "nothing happens by itself"},
    Substitute{"sound", "the page is silent"},
    Substitute{"lamp", "its own brightness is shown, but it lights nothing"},
    Substitute{"bouncedLight",
               "the light between surfaces is that of the scene's own moment, dimmed as the sun is"},
    Substitute{"sunPath", "it shows the scene's own moment, whatever hour is chosen"},
    Substitute{"reflection", "what mirrors shows the sky and the mean light around it"},
};

void count_types(const scene::Nodes& nodes, std::map<std::string, int>& counts) {
  for (const scene::Node& node : nodes) {
    ++counts[node.schema->type];
    count_types(node.children, counts);
  }
}

}  // namespace

std::vector<std::string> shown_instead(const scene::Scene& scene, const scene::LiveScene& live,
                                       const ShownThings& things) {
  std::map<std::string, int> counts;
  count_types(live.nodes(), counts);
  std::vector<std::string> sentences;
  for (const Substitute& each : substitutes)
    if (const int count = counts[each.type]; count > 0)
      sentences.push_back(fmt::format("{} ({}): {}", each.type, count, each.instead));
  for (const auto& [kind, count] : things.plain_kinds())
    sentences.push_back(
        fmt::format("{} ({}): their shapes in plain colours, without their photographs", kind, count));
  if (things.has_thinned_plants())
    sentences.push_back("plants: fewer leaves, each so much larger that the crown is as dense");
  bool has_glass = false;
  for (const scene::Object& object : things.objects())
    for (const scene::Material& material : object.materials()) has_glass = has_glass || material.refracts();
  if (has_glass)
    sentences.push_back("solid glass: it mirrors, and shows the light behind it without bending it");
  if (scene.data<scene::Darkness>().is_dark && counts["lamp"] == 0)
    sentences.push_back("night: the page is as dark as the sky");
  return sentences;
}

}  // namespace parvis::share
