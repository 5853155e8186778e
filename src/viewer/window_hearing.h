// What the window sounds like: the scene at the visitor's ears, played by a thread of its own.
#pragma once

#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "life/sound/listening.h"
#include "life/sound/playback.h"
#include "life/sound/sound_server.h"

namespace parvis::viewer {

/// Hears a running scene from the first moment on at which something in it sounds.
class Hearing {
 public:
  /// `device`: as `parvis view --sound` names it (sound/device.h); osc://HOST:PORT: a sound server;
  /// "off": nothing is heard.
  explicit Hearing(std::string device) : device_(std::move(device)) {}

  /// Brings what is heard up to date, some times in a second. The place that sound goes about in is found out
  /// in the background when it is first asked for.
  void step(const scene::Scene& scene, const Camera& ears, double time_s, double passed_s);

  /// Whether something sounds, or would if it were not muted.
  bool is_on() const { return listening_ != nullptr; }
  bool is_muted() const { return is_muted_; }
  void mute(bool is_muted) { is_muted_ = is_muted; }
  /// The share of what is usually heard, 0 to 1: of the voices the loudest, brought up to date less often.
  void set_share(double share) { share_ = share; }
  /// How many sounds are heard.
  std::size_t sounds() const { return sounds_; }
  /// The cost of mixing; nothing where a server mixes.
  sound::Playback::Cost cost() const { return playback_ ? playback_->cost() : sound::Playback::Cost(); }
  /// The latest message to the visitor that was not taken yet; empty for none.
  std::string take_message();

 private:
  /// A recording as a server asks for it.
  struct SentFile {
    std::string name, bytes;
    std::filesystem::file_time_type written = {};
    std::future<std::string> read;  ///< of its bytes
    double unheard_s = 0.0;
  };
  std::string sent_name(const sound::Recording& recording);
  void answer(const sound::OscMessage& wanted);
  void send(const sound::OscMessage& message);
  void begin_to_play();
  void tell_server(const scene::Scene& scene, std::span<const sound::HeardSound> heard, double time_s);

  std::string device_;
  std::future<std::unique_ptr<sound::Listening>> found_;
  std::unique_ptr<sound::Listening> listening_;
  std::unique_ptr<sound::Playback> playback_;  ///< null: a server plays
  std::optional<sound::Datagrams> server_;
  std::map<std::filesystem::path, SentFile> sent_files_;
  double waited_s_ = 0.0, unanswered_s_ = 0.0;
  bool is_muted_ = false, is_server_lost_ = false;
  std::string message_;
  std::size_t sounds_ = 0;
  double share_ = 1.0;
};

}  // namespace parvis::viewer
