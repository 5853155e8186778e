// The sound server: a process of its own, on this machine or another, that plays what a client says it hears,
// in Open Sound Control over UDP.
//
// /parvis/sound ID KIND X Y Z L63 L125 ... L8000 DELAY: a sound as it reaches the listener: direction (right,
// ahead, up), levels in dB by octave, seconds of travel. It is to be said again within two seconds, else it
// fades away: so a client may vanish and come back.
// /parvis/silent ID; /parvis/mute 0 or 1; /parvis/ping, which is answered with /parvis/pong.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "life/sound/liblo_module.h"
#include "life/sound/mixer.h"
#include "life/sound/scene_sounds.h"

namespace parvis::sound {

/// A UDP socket.
class Datagrams {
 public:
  /// Waits for packets at a port of this machine; of all its addresses only where `is_public`.
  static Result<Datagrams> listen(int port, bool is_public);
  /// Sends to HOST:PORT.
  static Result<Datagrams> connect(const std::string& host_and_port);
  Datagrams(Datagrams&& other) noexcept;
  Datagrams& operator=(Datagrams&&) = delete;
  ~Datagrams();

  /// The next packet, within `wait_ms`; empty for none. What is sent next goes to who sent it.
  std::string receive(int wait_ms);
  /// Sends; what cannot be sent is lost, as any packet may be.
  void send(std::string_view packet);
  /// Address and port of who sent the last packet, as 127.0.0.1:5000; empty: nobody has.
  std::string sender() const;
  /// The port at which packets are waited for.
  int port() const;

 private:
  explicit Datagrams(int socket) : socket_(socket) {}
  int socket_;
  std::string peer_;    ///< address of the last sender
  std::string buffer_;  ///< of packets that come
};

/// The state of a server, from packets; the network is elsewhere.
class ServedSounds {
 public:
  static constexpr std::size_t max_sounds = 10'000;
  static constexpr double forgotten_s = 2.0;

  /// Takes a packet that came at a time of the server's clock. Returns the packet to answer with, or an empty
  /// one. Errors say what is wrong with it; nothing is changed then.
  Result<std::string> take(std::string_view packet, double now_s);
  /// The sounds that are heard now; those that were not renewed are dropped.
  std::vector<HeardSound> heard(double now_s);
  /// Whether the client has muted the server.
  bool is_muted() const { return is_muted_; }

 private:
  struct Served {
    HeardSound sound;
    double told_s = 0.0;
  };
  std::map<std::uint64_t, Served> sounds_;
  bool is_muted_ = false;
};

/// The message that says a sound; `time_s` is that of `HeardSound::emitted_s`.
OscMessage message_of(const HeardSound& sound, double time_s);

}  // namespace parvis::sound
