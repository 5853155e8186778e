#include "planning/study/xdf.h"

#include <cstring>

namespace parvis::study {
namespace {

enum Tag : std::uint16_t {
  file_header = 1,
  stream_header = 2,
  samples = 3,
  clock_offset = 4,
  stream_footer = 6
};

/// Appends a number as it lies in memory: XDF is little endian, as all machines that this program runs on.
template <class T>
void put(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// A length, with the number of bytes that it takes before it.
void put_length(std::string& bytes, std::size_t length) {
  bytes += '\4';
  put(bytes, std::uint32_t(length));
}

void put_chunk(std::string& file, Tag tag, const std::string& content) {
  put_length(file, content.size() + sizeof tag);
  put(file, std::uint16_t(tag));
  file += content;
}

std::string xml_text(const std::string& text) {
  std::string made;
  for (const char c : text)
    made += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return made;
}

/// A stream while its samples come.
struct Stream {
  const char *name, *type, *format;
  std::vector<const char*> channels;  ///< label and unit in turn
  std::string samples = {};
  std::uint32_t count = 0;
  double first_s = 0.0, last_s = 0.0;

  /// Begins a sample; its values follow.
  void begin(double time_s) {
    samples += '\10';
    put(samples, time_s);
    if (count++ == 0) first_s = time_s;
    last_s = time_s;
  }
  void put_values(std::initializer_list<float> values) {
    for (const float value : values) put(samples, value);
  }
};

std::string header_of(const Stream& stream, const LoggedSession& session) {
  std::string channels;
  for (std::size_t i = 0; i + 1 < stream.channels.size(); i += 2)
    channels += fmt::format("<channel><label>{}</label><unit>{}</unit></channel>", stream.channels[i],
                            stream.channels[i + 1]);
  return fmt::format(
      "<?xml version=\"1.0\"?><info><name>{}</name><type>{}</type><channel_count>{}</channel_count>"
      "<nominal_srate>0</nominal_srate><channel_format>{}</channel_format><source_id>parvis {} {}</source_id>"
      "<version>1.1</version><created_at>{}</created_at><desc><participant>{}</participant><channels>{}</"
      "channels>"
      "</desc></info>",
      stream.name, stream.type, stream.channels.size() / 2, stream.format, xml_text(session.study),
      session.participant, session.clock_s, session.participant, channels);
}

}  // namespace

std::string xdf_of(const LoggedSession& session, const std::vector<Record>& records) {
  Stream streams[]{
      {"ParvisEvents", "Markers", "string", {"event", ""}},
      {"ParvisEye", "Position", "float32", {"x", "m", "y", "m", "z", "m", "dx", "", "dy", "", "dz", ""}},
      {"ParvisWand", "Position", "float32", {"x", "m", "y", "m", "z", "m"}},
      {"ParvisFrames", "Timing", "float32", {"step", "s", "frame", "ms"}}};
  auto& [events, eyes, wands, frames] = streams;
  for (const Record& record : records) {
    const double time_s = session.clock_s + 1e-6 * double(time_of(record));
    if (const Event* event = std::get_if<Event>(&record)) {
      const std::string text = event->text.empty() ? event->kind : event->kind + " " + event->text;
      events.begin(time_s);
      put_length(events.samples, text.size());
      events.samples += text;
      continue;
    }
    const Frame& frame = std::get<Frame>(record);
    const glm::vec3 at = frame.eye.position_in_world(), ahead = frame.eye.forward_in_world();
    eyes.begin(time_s), eyes.put_values({at.x, at.y, at.z, ahead.x, ahead.y, ahead.z});
    if (frame.wand) wands.begin(time_s), wands.put_values({frame.wand->x, frame.wand->y, frame.wand->z});
    frames.begin(time_s), frames.put_values({float(frame.step_s), frame.frame_ms});
  }

  std::string file = "XDF:";
  put_chunk(file, file_header, "<?xml version=\"1.0\"?><info><version>1.0</version></info>");
  const auto put_of_stream = [&](Tag tag, std::uint32_t id, const std::string& content) {
    std::string chunk;
    put(chunk, id);
    put_chunk(file, tag, chunk + content);
  };
  std::uint32_t id = 0;
  for (const Stream& stream : streams) {
    put_of_stream(stream_header, ++id, header_of(stream, session));
    std::string offset, content;
    put(offset, stream.first_s), put(offset, 0.0);  // all streams have one clock
    put_of_stream(clock_offset, id, offset);
    put_length(content, stream.count);
    if (stream.count > 0) put_of_stream(samples, id, content + stream.samples);
    put_of_stream(
        stream_footer, id,
        fmt::format("<?xml version=\"1.0\"?><info><first_timestamp>{}</first_timestamp><last_timestamp>{}"
                    "</last_timestamp><sample_count>{}</sample_count></info>",
                    stream.first_s, stream.last_s, stream.count));
  }
  return file;
}

}  // namespace parvis::study
