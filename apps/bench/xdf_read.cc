// A reader that is not ours, for the key xdf_read_back: prints what libxdf (Debian, GPL-3) finds in a file, one line for each
// stream and event. The bench compiles it where libxdf-dev is installed; it is no part of parvis.
#include <xdf.h>

#include <cstdio>

int main(int, char** arguments) {
  Xdf file;
  if (file.load_xdf(arguments[1]) != 0) return 1;
  for (const Xdf::Stream& stream : file.streams) {
    std::printf("stream %s %d %zu", stream.info.name.c_str(), stream.info.channel_count, stream.time_stamps.size());
    for (const double time : stream.time_stamps) std::printf(" %.6f", time);
    for (const auto& channel : stream.time_series)
      for (const float value : channel) std::printf(" %a", double(value));
    std::printf("\n");
  }
  for (const auto& event : file.eventMap) std::printf("event %.6f %s\n", event.first.second, event.first.first.c_str());
  return 0;
}
