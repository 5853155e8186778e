#include "viewer/window_hearing.h"

#include <algorithm>
#include <chrono>

#include "base/files.h"

namespace parvis::viewer {
namespace {

constexpr double update_s = 1.0 / 15.0;  // between two updates; playback glides from one to the next
constexpr std::size_t max_voices_when_lowered =
    48;                             // of which a share is left where frames are over their budget
constexpr double patience_s = 3.0;  // without an answer the server is gone
constexpr std::string_view server_scheme = "osc://";

}  // namespace

void Hearing::begin_to_play() {
  if (!device_.starts_with(server_scheme)) {
    playback_ = std::make_unique<sound::Playback>(
        [device = device_](std::size_t streams) { return sound::open_device(device, streams); });
    return;
  }
  Result<sound::Datagrams> server = sound::Datagrams::connect(device_.substr(server_scheme.size()));
  if (server)
    server_.emplace(*std::move(server));
  else
    message_ = "No sound: " + to_string(server.errors());
}

void Hearing::send(const sound::OscMessage& message) {
  if (const Result<std::string> packet = sound::liblo.call(&sound::LibloFunctions::encode, message))
    server_->send(*packet);
}

/// The name by which it is sent; empty until it has been read, which begins when it is first heard, and again
/// where the file was written since. A file that is gone by then has no bytes: nothing is sent.
std::string Hearing::sent_name(const sound::Recording& recording) {
  SentFile& sent = sent_files_[recording.file];
  sent.unheard_s = 0.0;
  std::error_code ignored;
  const auto written = std::filesystem::last_write_time(recording.file, ignored);
  if (!sent.read.valid() && (sent.name.empty() || written != sent.written)) {
    sent.written = written;
    sent.read = std::async(std::launch::async, [file = recording.file] {
      Result<std::string> bytes = read_file(file, sound::max_recording_bytes);
      return bytes ? *std::move(bytes) : std::string();
    });
  }
  if (sent.read.valid() && sent.read.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    sent.bytes = sent.read.get();
    sent.name = sound::name_of_recording(sent.bytes);
  }
  return sent.name;
}

/// Sends the parts of a recording that the server lacks.
void Hearing::answer(const sound::OscMessage& wanted) {
  if (wanted.address != "/parvis/want" || wanted.numbers.size() != 3) return;
  for (const auto& [path, file] : sent_files_) {
    if (file.name != wanted.texts[0]) continue;
    const auto first = std::size_t(std::clamp(wanted.numbers[1], 0.0, 1e9)),
               count = std::size_t(std::clamp(wanted.numbers[2], 0.0, double(sound::parts_wanted)));
    for (std::size_t i = first; i < first + count && i * sound::part_bytes < file.bytes.size(); ++i)
      send(sound::part_of(file.name, file.bytes, i));
  }
}

/// Packets go to a server that has vanished, too: it may come back.
void Hearing::tell_server(const scene::Scene& scene, std::span<const sound::HeardSound> heard,
                          double time_s) {
  bool answers = false;
  for (std::string packet = server_->receive(0); !packet.empty(); packet = server_->receive(0)) {
    answers = true;
    if (const auto message = sound::liblo.call(&sound::LibloFunctions::decode, packet)) answer(*message);
  }
  unanswered_s_ = answers ? 0.0 : unanswered_s_ + waited_s_;
  if (const bool is_lost = unanswered_s_ > patience_s; is_lost != is_server_lost_) {
    is_server_lost_ = is_lost;
    message_ =
        is_lost ? fmt::format("No sound: the server at {} does not answer", device_) : "Sound is back.";
  }
  send({"/parvis/ping", {}, {}});
  send({"/parvis/mute", {is_muted_ ? 1.0 : 0.0}, {""}});
  for (auto& [path, file] : sent_files_) file.unheard_s += waited_s_;
  for (const sound::HeardSound& sound : heard)
    if (const std::string file = sound.recording ? sent_name(*sound.recording) : "";
        !sound.recording || !file.empty())
      send(sound::message_of(sound, time_s, file));
  for (const sound::Bed& bed : sound::beds_of(scene))
    if (const std::string file = sent_name(*bed.recording); !file.empty())
      send({"/parvis/bed", {0.0, double(bed.gain)}, {file, ""}});
  std::erase_if(sent_files_, [](const auto& it) {
    return it.second.unheard_s > sound::SentRecordings::forgotten_s && !it.second.read.valid();
  });
}

std::string Hearing::take_message() {
  if (message_.empty() && playback_) return playback_->take_message();
  return std::exchange(message_, {});
}

void Hearing::step(const scene::Scene& scene, const Camera& ears, double time_s, double passed_s) {
  if (device_ == "off") return;
  waited_s_ += passed_s;
  if (waited_s_ < update_s / share_) return;
  if (!listening_) {
    if (!found_.valid()) {
      const glm::dvec3 place(ears.world_from_camera[3]);
      if (sound::beds_of(scene).empty() && sound::SceneSounds().at(scene, 0.0, place).empty()) return;
      found_ = std::async(std::launch::async, [place = scene] {
        return std::make_unique<sound::Listening>(place, sound::Output::headphones);
      });
    }
    if (found_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    listening_ = found_.get();
    begin_to_play();
  }
  std::vector<sound::HeardSound> heard = listening_->heard(scene, ears, time_s, waited_s_);
  sounds_ = listening_->sources();
  if (share_ < 1.0) sound::keep_loudest(heard, std::size_t(share_ * double(max_voices_when_lowered)));
  if (server_) tell_server(scene, heard, time_s);
  if (playback_) {
    playback_->mute(is_muted_);
    playback_->update(std::move(heard), sound::beds_of(scene), time_s);
  }
  waited_s_ = 0.0;
}

}  // namespace parvis::viewer
