// parvis soundserver: plays what windows elsewhere hear.
#include <fmt/format.h>

#include <chrono>

#include "commands.h"
#include "interruption.h"
#include "life/sound/playback.h"
#include "life/sound/sound_server.h"

namespace parvis {
namespace {

struct SoundServerArguments {
  int port = 7770;
  bool is_public = false;
  std::string device = "default";
  double seconds = 0.0;
};

Status run_soundserver(const SoundServerArguments& arguments) {
  Result<sound::Datagrams> socket = sound::Datagrams::listen(arguments.port, arguments.is_public);
  if (!socket) return socket.errors();
  sound::Playback playback(
      [&](std::size_t streams) { return sound::open_device(arguments.device, streams); });
  sound::ServedSounds served;
  fmt::print("listening at port {}{}\n", socket->port(),
             arguments.is_public ? " of all addresses" : ", for this machine alone");
  std::fflush(stdout);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  constexpr double update_s = 1.0 / 30.0;
  constexpr int max_reported = 10;
  double updated_s = 0.0;
  int refused = 0;
  while (!interruption()) {
    const double now_s = std::chrono::duration<double>(Clock::now() - begin).count();
    if (arguments.seconds > 0.0 && now_s > arguments.seconds) break;
    if (const std::string packet = socket->receive(10); !packet.empty()) {
      const Result<std::string> answer = served.take(packet, now_s);
      if (!answer && ++refused <= max_reported)
        fmt::print(stderr, "refused: {}\n", to_string(answer.errors()));
      else if (answer && !answer->empty())
        socket->send(*answer);
    }
    if (now_s - updated_s < update_s) continue;
    updated_s = now_s;
    playback.mute(served.is_muted());
    std::vector<sound::HeardSound> heard = served.heard(now_s);
    playback.update(std::move(heard), served.beds(now_s), now_s);
    for (const std::string& wanted : served.recordings().wanted(now_s)) socket->send(wanted);
    if (const std::string message = served.recordings().take_message(); !message.empty())
      fmt::print(stderr, "{}\n", message);
    if (const std::string message = playback.take_message(); !message.empty())
      fmt::print(stderr, "{}\n", message);
  }
  if (refused > 0) fmt::print(stderr, "{} packets were refused\n", refused);
  return Ok{};
}

}  // namespace

void add_soundserver(CLI::App& app, Chosen& chosen) {
  CLI::App* command =
      app.add_subcommand("soundserver", "Plays what a window hears, on this machine or another, told in OSC");
  const auto arguments = std::make_shared<SoundServerArguments>();
  command->add_option("--port", arguments->port, "To listen at; 0: a free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_flag("--public", arguments->is_public,
                    "Listen at all addresses of this machine: whoever reaches it can make it sound");
  command->add_option("--device", arguments->device, "As parvis view --sound names them")
      ->capture_default_str();
  command->add_option("--seconds", arguments->seconds, "End after so long; 0: when interrupted")
      ->check(CLI::Range(0.0, 1e6));
  command->footer(
      "Example: parvis soundserver --port 7770\n"
      "Example: parvis view scenes/tram.xp --sound osc://127.0.0.1:7770");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run_soundserver(*arguments); }; });
}

}  // namespace parvis
