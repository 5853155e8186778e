// parvis facade light: sun and sky of a packed place, set to match its photographs.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "capture/facades/photographed_light.h"
#include "facade_stages.h"

namespace parvis {
namespace {

Status find_light(const std::filesystem::path& folder) {
  const std::filesystem::path packed = folder / "place.facade";
  std::error_code code;
  if (!std::filesystem::exists(packed, code))
    return error("{}: the place is not packed; run parvis facade pack \"{}\"", packed.string(),
                 folder.string());
  const Result<facades::PackedFacade> facade = facades::read_facade(packed);
  if (!facade) return facade.errors();
  const Result<facades::PhotographedLight> light = facades::find_photographed_light(*facade);
  if (!light) return light.errors();
  if (Status status = facades::write_photographed_light(folder, *light); !status) return status;
  if (light->points == 0)
    fmt::print("overcast: no surface is partly lit and partly shaded\n");
  else if (light->is_overcast)
    fmt::print(
        "overcast: no sun agrees with what {} points show lit or shaded; the best by {:.2f}, needed {:.2f}\n",
        light->points, light->agreement, facades::sunlit_agreement);
  else
    fmt::print("sun: azimuth {:.1f}, elevation {:.1f} degrees; it agrees with {} points by {:.2f}\n",
               glm::degrees(std::atan2(double(light->to_sun.x), double(light->to_sun.y))),
               glm::degrees(std::asin(double(light->to_sun.z))), light->points, light->agreement);
  fmt::print("written to {}\n", (folder / "light.xp").string());
  return Ok{};
}

}  // namespace

void add_facade_light(CLI::App& stage, Chosen& chosen) {
  const auto folder = std::make_shared<std::filesystem::path>();
  stage.add_option("folder", *folder, "Folder of a packed place")->required()->check(CLI::ExistingDirectory);
  stage.footer("Example: parvis facade light courtyard");
  stage.callback([folder, &chosen] { chosen = [folder] { return find_light(*folder); }; });
}

}  // namespace parvis
