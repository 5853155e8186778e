#include "planning/design/test_random_commands.h"

#include <array>

namespace parvis::design {
namespace {

std::string somewhere(Random& random) {
  return fmt::format("{:.3f},{:.3f}", random.uniform(-40.0f, 40.0f), random.uniform(-40.0f, 40.0f));
}

}  // namespace

std::string random_command(Random& random, const Session& session) {
  constexpr std::array kinds{"bench_stone", "umbrella", "bollard", "planter"};
  const std::string kind = kinds[std::size_t(random.index(int(kinds.size())))];
  const std::vector<PlacedObject> objects = session.objects();
  const auto any = [&] { return objects[std::size_t(random.index(int(objects.size())))].name; };
  const int choice = objects.size() < 3 ? random.index(2) : random.index(objects.size() > 60 ? 21 : 18);
  switch (choice) {
    case 0:
      return fmt::format("insert {} {} heading {}", kind, somewhere(random), random.index(360));
    case 1:
      return fmt::format("row {} from {} to {} count {}", kind, somewhere(random), somewhere(random),
                         2 + random.index(4));
    case 2:
    case 3:
      return fmt::format("move {} by {:.3f},{:.3f}", any(), random.uniform(-2.0f, 2.0f),
                         random.uniform(-2.0f, 2.0f));
    case 4:
      return fmt::format("move {} to {}", any(), somewhere(random));
    case 5:
      return fmt::format("turn {} by {}", any(), random.index(90));
    case 6:
      return fmt::format("resize {} by {:.2f}", any(), random.uniform(0.8f, 1.2f));
    case 7:
      return fmt::format("duplicate {} by 1,{:.2f}", any(), random.uniform(-1.0f, 1.0f));
    case 8:
      return fmt::format("colour {} #{:06X}", any(), random.index(0xFFFFFF));
    case 9:
      return fmt::format("swap {} for {}", any(), kind);
    case 10:
      return fmt::format("apply {} to {}", any(), any());
    case 11:
      return fmt::format("group {},{} as g{}", any(), any(), random.index(5));
    case 12:
      return fmt::format("surface lawn {} {} {}", somewhere(random), somewhere(random), somewhere(random));
    case 13:
      return random.chance(0.5f) ? "undo" : "redo";
    case 14:
      return "undo";
    case 15:
      return fmt::format("{} {}", random.chance(0.3f) ? "lock" : "unlock", any());
    case 16:
      return fmt::format("rename {} as n{}", any(), random.index(1'000'000));
    case 17: {
      const std::vector<Measurement> made = session.measurements();
      if (made.empty() || random.chance(0.4f))
        return fmt::format("measure distance {} {}", somewhere(random), somewhere(random));
      const std::string& name = made[std::size_t(random.index(int(made.size())))].name;
      return random.chance(0.4f)
                 ? "delete " + name
                 : fmt::format("point {} {} to {}", name, 1 + random.index(2), somewhere(random));
    }
    default:
      return fmt::format("delete {},{}", any(), any());
  }
}

}  // namespace parvis::design
