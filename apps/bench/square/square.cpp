// The square of `parvis city square` as a whole, measured as a newcomer meets it: its first picture.
#include "base/image_io.h"
#include "bench/own_program.h"
#include "bench/parts.h"

namespace parvis::bench {
namespace fs = std::filesystem;

void measure_square_first_picture(const BenchSetup& setup, Report& report) {
  // As script/demo makes it: from no folder at all.
  const fs::path folder = setup.folder / "first_square";
  fs::remove_all(folder);
  const double seconds =
      milliseconds([&] {
        run_own_program("", {"city", "square", "-o", folder.string()});
        run_own_program("", {"render", (folder / "square.xp").string(), "--time", "8", "--size", "960x540",
                             "--camera", "square", "-o", (folder / "first.png").string()});
      }) *
      1e-3;
  if (must(read_image8(folder / "first.png")).width != 960) fail("the first picture has another size");
  report.add("first_picture_s", seconds);
  report.add("first_picture_s_if_seconds_were_minutes", 60.0 * seconds);
}

}  // namespace parvis::bench
