// Sessions as XDF, the Extensible Data Format of the Lab Streaming Layer, so that laboratories can join them
// with gaze and EEG. The format: github.com/sccn/xdf, specification 1.0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planning/study/log.h"

namespace parvis::study {

/// The bytes of an XDF file with the streams of a session: ParvisEvents (markers), ParvisEye (position and
/// direction), ParvisWand (position) and ParvisFrames (step, time of drawing), all on the machine's steady
/// clock, as the Lab Streaming Layer has it.
std::string xdf_of(const LoggedSession& session, const std::vector<Record>& records);

}  // namespace parvis::study
