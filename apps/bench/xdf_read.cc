// A reader that is not ours, for the key xdf_read_back: prints what libxdf (Debian, GPL-3) finds in a file, one line for each
// stream and event, to a file (libxdf itself prints to the standard output). The bench compiles it where libxdf-dev is installed; it is no part of parvis.
#include <xdf.h>

#include <cstdio>

int main(int, char** arguments) {
  Xdf file;
  std::FILE* const out = std::fopen(arguments[2], "w");
  if (file.load_xdf(arguments[1]) != 0 || !out) return 1;
  for (const Xdf::Stream& stream : file.streams) {
    std::fprintf(out, "stream %s %d %zu", stream.info.name.c_str(), stream.info.channel_count, stream.time_stamps.size());
    for (const double time : stream.time_stamps) std::fprintf(out, " %.6f", time);
    for (const auto& channel : stream.time_series)
      for (const float value : channel) std::fprintf(out, " %a", double(value));
    std::fprintf(out, "\n");
  }
  for (const auto& event : file.eventMap) std::fprintf(out, "event %.6f %s\n", event.first.second, event.first.first.c_str());
  return std::fclose(out);
}
