// The sound server: a process of its own, on this machine or another, that plays what a client says it hears,
// in Open Sound Control over UDP.
//
// /parvis/sound ID KIND X Y Z L63 L125 ... L8000 DELAY [SEED [FILE]]: a sound as it reaches the listener:
// direction (right, ahead, up), levels in dB by octave, seconds of travel. It is to be said again within two
// seconds, else it fades away: so a client may vanish and come back. Sounds of one seed have the same events.
// /parvis/bed FILE GAIN: likewise, a recording that is heard everywhere.
// /parvis/silent ID; /parvis/mute 0 or 1; /parvis/ping, which is answered with /parvis/pong.
// A recording's FILE is the hash of its bytes. The server asks for those that it lacks with
// /parvis/want FILE FIRST COUNT, and the client sends each part, of `part_bytes`, with
// /parvis/part FILE INDEX BYTES_OF_ALL BLOB: parts that are lost are asked for again.
#pragma once

#include <future>
#include <map>
#include <memory>
#include <optional>
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
  /// Sends to HOST:PORT, and takes packets from there alone.
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

/// Bytes of a recording in one message, and how many parts a server asks for at a time.
inline constexpr std::size_t part_bytes = 1024, parts_wanted = 64;

/// Recordings that a client sends in parts.
class SentRecordings {
 public:
  /// Files at a time, bytes of those that come, and seconds of all together; further ones are refused.
  static constexpr std::size_t max_files = 16, max_bytes = 256u << 20;
  static constexpr double max_total_s = 1200.0, forgotten_s = 60.0;

  /// The recording, where all of it has come; else it is asked for from now on.
  std::shared_ptr<const Recording> find(const std::string& file, double now_s);
  /// Takes a part. Errors: nobody asked for it, or it does not fit; where it is of another size than those
  /// before it, all are asked for again.
  Status take(const OscMessage& part);
  /// Messages to send to the client now, some times in a second.
  std::vector<std::string> wanted(double now_s);
  /// A message about a recording that could not be read, once; empty for none.
  std::string take_message() { return std::exchange(message_, {}); }

 private:
  struct File {
    double used_s = 0.0;
    std::string bytes;                    ///< until it is read
    std::vector<bool> has;                ///< parts; empty: none has come, or all have
    std::size_t missing = 1;              ///< parts
    std::future<Result<Recording>> read;  ///< from `bytes`; of one file at a time
    std::shared_ptr<const Recording> recording;
    bool is_bad = false;
  };
  void keep_read();
  void read_next();

  std::map<std::string, File> files_;
  std::string message_;
  bool is_full_ = false;
};

/// The state of a server, from packets; the network is elsewhere.
class ServedSounds {
 public:
  static constexpr std::size_t max_sounds = 10'000, max_beds = 8;
  static constexpr double forgotten_s = 2.0;

  /// Takes a packet that came at a time of the server's clock. Returns the packet to answer with, or an empty
  /// one. Errors say what is wrong with it; nothing is changed then.
  Result<std::string> take(std::string_view packet, double now_s);
  /// The sounds that are heard now; those that were not renewed are dropped.
  std::vector<HeardSound> heard(double now_s);
  /// The beds that are heard now, likewise.
  std::vector<Bed> beds(double now_s);
  /// Recordings that the client sends.
  SentRecordings& recordings() { return recordings_; }
  /// Whether the client has muted the server.
  bool is_muted() const { return is_muted_; }

 private:
  struct Served {
    HeardSound sound;
    double told_s = 0.0;
    std::string file;  ///< of a recording
  };
  struct ServedBed {
    double gain = 0.0, told_s = 0.0;
  };
  Status take_bed(const OscMessage& message, double now_s);

  std::map<std::uint64_t, Served> sounds_;
  std::map<std::string, ServedBed> beds_;  ///< by file
  SentRecordings recordings_;
  bool is_muted_ = false;
};

/// The message that says a sound; `time_s` is that of `HeardSound::emitted_s`. `file`: of a recording.
OscMessage message_of(const HeardSound& sound, double time_s, const std::string& file = {});

/// The name by which recordings are sent.
std::string name_of_recording(std::string_view bytes);
/// A part of a recording's bytes.
OscMessage part_of(const std::string& name, std::string_view bytes, std::size_t index);

}  // namespace parvis::sound
