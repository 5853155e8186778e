#include "planning/plan_drawing/layer_choice.h"

#include "base/known_names.h"
#include "scene/data/name_pattern.h"

namespace parvis::plan_drawing {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> divided_at_commas(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    if (const std::string word = trimmed(text.substr(at, comma - at)); !word.empty()) words.push_back(word);
    at = comma + 1;
  }
  return words;
}

Result<std::vector<bool>> shown_layers(const formats::Drawing& drawing, const std::string& choice) {
  std::vector<bool> shown;
  std::vector<std::string> names;
  for (const formats::DrawingLayer& layer : drawing.layers) {
    names.push_back(layer.name);
    // Programs that draw dimensions keep their construction points there; it is never printed.
    shown.push_back(layer.is_shown() && layer.name != "Defpoints");
  }
  for (const std::string& word : divided_at_commas(choice)) {
    const bool hides = word.starts_with('-');
    const std::string name = trimmed(hides || word.starts_with('+') ? word.substr(1) : word);
    bool is_known = false;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (scene::matches(name, names[i])) shown[i] = !hides, is_known = true;
    if (!is_known) return error("the drawing has no layer \"{}\"{}", name, names_that_exist(name, names));
  }
  return shown;
}

}  // namespace parvis::plan_drawing
