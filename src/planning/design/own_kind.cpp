#include "planning/design/own_kind.h"

#include <algorithm>
#include <cctype>
#include <glm/gtx/component_wise.hpp>

#include "base/files.h"
#include "formats/gltf/gltf_writer.h"

namespace parvis::design {
namespace {

namespace fs = std::filesystem;

constexpr double smallest_m = 0.01, largest_m = 200.0;
constexpr double house_m = 60.0;   // what is larger was hardly drawn in metres
constexpr double bollard_m = 0.3;  // what is smaller was hardly drawn in millimetres

/// A name that commands can write: letters, digits and underscores.
std::string name_of(const fs::path& file) {
  std::string name;
  for (const char c : file.stem().string())
    name += std::isalnum(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) < 128
                ? char(std::tolower(static_cast<unsigned char>(c)))
                : '_';
  return name.empty() ? "own" : name.substr(0, 40);
}

std::string extents(const glm::dvec3& size) {
  return fmt::format("{:.3g} x {:.3g} x {:.3g} m", size.x, size.y, size.z);
}

/// A name that neither a kind nor an object of the scene has.
bool is_free(const scene::Scene& scene, const std::string& name) {
  return !find_kind(scene, name) && std::ranges::none_of(scene.objects, [&](const scene::Object& object) {
    return object.name == name;
  });
}

bool have_equal_bytes(const fs::path& one, const fs::path& other) {
  const Result<std::string> a = read_file(one), b = read_file(other);
  return a && b && *a == *b;
}

}  // namespace

Result<OwnKind> import_kind(const formats::Readers& readers, const scene::Scene& scene, const fs::path& file,
                            double unit_m) {
  if (scene.file.empty())
    return error("{}: the scene has no file beside which a kind could lie", file.string());
  Errors warnings;
  Result<scene::Model> model = readers.read(file, {}, warnings);
  if (!model) return model.errors();
  for (const Error& warning : warnings) fmt::print(stderr, "warning: {}\n", to_string(warning));
  const Bounds box = bounds(*model);
  if (model->triangle_count() == 0 || box.empty())
    return error("{}: the model has no triangles: nothing would be seen of it", file.string());
  const glm::dvec3 drawn(box.size());
  const bool is_guessed = unit_m == 0.0 && glm::compMax(drawn) > house_m;
  const double guess = millimetre * glm::compMax(drawn) < bollard_m ? centimetre : millimetre;
  const double unit = unit_m > 0.0 ? unit_m : is_guessed ? guess : metre;
  const glm::dvec3 size = glm::max(unit * drawn, glm::dvec3(smallest_m));
  if (glm::compMax(unit * drawn) < smallest_m || glm::compMax(size) > largest_m)
    return error(
        "{}: the model is {} in metres, {} in centimetres, {} in millimetres; say in which unit it was "
        "drawn (parvis plan --kind FILE --kind-unit cm)",
        file.string(), extents(drawn), extents(centimetre * drawn), extents(millimetre * drawn));

  const fs::path folder = scene.file.parent_path() / "kinds";
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return error("{}: the folder cannot be made: {}", folder.string(), code.message());
  OwnKind made;
  made.command.size_m = glm::round(1e4 * size) / 1e4;
  scene::Object object;
  object.model = std::make_shared<const scene::Model>(*std::move(model));
  const glm::vec3 foot(box.centre().x, box.centre().y, box.min.z);
  object.world_from_model = glm::translate(glm::scale(glm::mat4(1.0f), glm::vec3(float(unit))), -foot);
  const scene::Object* const objects[]{&object};
  const fs::path trial = folder / ".new";
  const std::string stem = name_of(file);
  for (int number = 1; made.command.file.empty(); ++number) {
    object.name = number == 1 ? stem : fmt::format("{}_{}", stem, number);
    const fs::path kept = folder / (object.name + ".glb");
    if (!is_free(scene, object.name)) continue;
    if (fs::exists(kept, code)) {  // the same model, dropped once more, is the same file
      fs::create_directories(trial, code);
      const fs::path again = trial / kept.filename();
      const bool is_same = scene::write_gltf(again, objects, {}).ok() && have_equal_bytes(again, kept);
      fs::remove_all(trial, code);
      if (!is_same) continue;
    } else if (Status status = scene::write_gltf(kept, objects, {}); !status) {
      return status.errors();
    } else {
      made.new_file = kept;
    }
    made.command.name = object.name, made.command.file = "kinds/" + object.name + ".glb";
  }
  made.note = fmt::format("{}: {}{}", made.command.name, extents(made.command.size_m),
                          !is_guessed           ? ""
                          : guess == centimetre ? ", read as centimetres"
                                                : ", read as millimetres");
  return made;
}

}  // namespace parvis::design
