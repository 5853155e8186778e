#include "planning/design/test_random_commands.h"

#include <array>

namespace parvis::design {
namespace {

std::string somewhere(Random& random) {
  return fmt::format("{:.3f},{:.3f}", random.uniform(-40.0f, 40.0f), random.uniform(-40.0f, 40.0f));
}

/// A command on things that are there.
std::string on_things(Random& random, const Session& session, const std::string& kind) {
  const std::vector<PlacedObject> objects = session.objects();
  const auto any = [&] { return objects[std::size_t(random.index(int(objects.size())))].name; };
  const auto several = [&] { return fmt::format("{},{},{}", any(), any(), any()); };
  switch (random.index(22)) {
    case 0:
    case 1:
      return fmt::format("move {} by {:.3f},{:.3f}", several(), random.uniform(-2.0f, 2.0f),
                         random.uniform(-2.0f, 2.0f));
    case 2:
      return fmt::format("move {} to {}", any(), somewhere(random));
    case 3:
      return fmt::format("move {} by 0,0,{:.3f}", any(), random.uniform(-0.5f, 0.5f));
    case 4:
      return fmt::format("turn {} by {}", any(), random.index(90));
    case 5:
      return fmt::format("turn {} by {} about {}", several(), random.index(90), somewhere(random));
    case 6:
      return fmt::format("resize {} by {:.2f}", any(), random.uniform(0.8f, 1.2f));
    case 7:
      return fmt::format("resize {} width {:.2f}", any(), random.uniform(0.3f, 3.0f));
    case 8:
      return fmt::format("duplicate {} by 1,{:.2f}", several(), random.uniform(-1.0f, 1.0f));
    case 9:
      return fmt::format("colour {} #{:06X}", several(), random.index(0xFFFFFF));
    case 10:
      return fmt::format("material {} {}", any(), random.chance(0.5f) ? "stone" : "wood");
    case 11:
      return fmt::format("swap {} for {}", any(), kind);
    case 12:
      return fmt::format("apply {} to {}", any(), several());
    case 13:
      return random.chance(0.7f) ? fmt::format("group {} as g{}", several(), random.index(5))
                                 : fmt::format("ungroup g{}", random.index(5));
    case 14:
      return fmt::format("{} {}", random.chance(0.3f) ? "lock" : "unlock", any());
    case 15:
      return fmt::format("rename {} as n{}", any(), random.index(1'000'000));
    case 16:
      return fmt::format("space {}", several());
    case 17:
      return fmt::format("align {} {}", several(), random.chance(0.5f) ? "x" : "heading");
    case 18: {
      const std::vector<Measurement> made = session.measurements();
      if (made.empty() || random.chance(0.4f))
        return fmt::format("measure distance {} {}", somewhere(random), somewhere(random));
      const std::string& name = made[std::size_t(random.index(int(made.size())))].name;
      return random.chance(0.4f)
                 ? "delete " + name
                 : fmt::format("point {} {} to {}", name, 1 + random.index(2), somewhere(random));
    }
    case 19:
      return fmt::format("view v{} {} heading {}", random.index(6), somewhere(random), random.index(360));
    default:
      return objects.size() > 60 ? "delete " + several() : "delete " + any();
  }
}

}  // namespace

std::string random_command(Random& random, const Session& session) {
  constexpr std::array kinds{"bench_stone", "umbrella", "bollard", "planter", "tree_orange"};
  const std::string kind = kinds[std::size_t(random.index(int(kinds.size())))];
  switch (random.index(session.objects().size() < 3 ? 2 : session.objects().size() > 80 ? 8 : 6)) {
    case 0:
      return fmt::format("insert {} {} heading {}", kind, somewhere(random), random.index(360));
    case 1:
      return random.chance(0.5f) ? fmt::format("row {} from {} to {} count {}", kind, somewhere(random),
                                               somewhere(random), 2 + random.index(4))
                                 : fmt::format("surface lawn {} {} {}", somewhere(random), somewhere(random),
                                               somewhere(random));
    case 2:
      return random.chance(0.6f) ? "undo" : "redo";
    default:
      return on_things(random, session, kind);
  }
}

}  // namespace parvis::design
