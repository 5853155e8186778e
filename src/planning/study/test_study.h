// A study of two tasks in a small scene, for tests and measurements.
#pragma once

#include <filesystem>
#include <string>

#include "base/files.h"
#include "planning/study/performance.h"

namespace parvis::study {

/// Something moves in it, a key starts it, and two states differ.
inline constexpr const char* test_scene = R"(
camera(name=street, position="0 -10 1.7", target="0 0 1")
camera(name=plan, position="0 0 100", heading_deg=0, pitch_deg=-90, parallel=40)
design(name=furniture) { placed(name=walker, kind=bollard, position="0 8 0") }
path(name=walk, of=street, loop=1) { key(time_s=0, position="0 -10 1.7") key(time_s=4, position="3 -10 1.7") }
scenario(name=low) { }
scenario(name=high) { override(of=furniture, visible=0) }
)";

inline constexpr const char* test_script = R"(
study(name=tiny, scene="scene.xp", order=balanced, asked="sus remarks") {
  condition(name=calm, scenario=low)
  condition(name=busy, scenario=high)
  task(name=left, minutes=1, asked=quick, area="-9 -9, 0 -9, 0 9, -9 9", instruction="left")
  task(name=right, instruction="right", instruction_fr="à droite")
  questionnaire(name=quick, low=1, high=7) { question(item=liked, text="I liked it") }
}
)";

/// A session of it in inputs.
inline constexpr const char* test_inputs = R"(# of P1
0.0 view plan
1.5 do insert bin -2,3
2.0 do insert bin 4,3
2.5 do insert nonsense 1,1
3.0 do undo
3.5 view street
4.0 note it works
12.0 done
12.5 answer quick.liked 6
13.0 done
14.0 do row bin from 0,0 to 6,0 count 3
24.0 done
25.0 answer sus.1 4
26.0 done
)";

/// Writes scene and study into a folder and reads the study.
inline Result<Study> write_test_study(const std::filesystem::path& folder,
                                      const std::string& script = test_script) {
  for (const auto& [name, text] :
       {std::pair("scene.xp", std::string(test_scene)), std::pair("tiny.study", script)})
    if (Status status = write_file(folder / name, text); !status) return status.errors();
  return read_study(folder / "tiny.study");
}

}  // namespace parvis::study
