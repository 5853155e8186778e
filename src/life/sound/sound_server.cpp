#include "life/sound/sound_server.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/content_hash.h"

namespace parvis::sound {
namespace {

constexpr std::size_t sound_arguments = 14;  // without seed and file
constexpr double max_level_db = 140.0, max_delay_s = 10.0;

/// Addresses of a host and port; null where there are none.
using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Addresses addresses_of(const char* host, const std::string& port, bool listens) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_INET, wanted.ai_socktype = SOCK_DGRAM;
  wanted.ai_flags = listens ? AI_PASSIVE : 0;
  if (getaddrinfo(host, port.c_str(), &wanted, &found) != 0) found = nullptr;
  return {found, &freeaddrinfo};
}

}  // namespace

Result<Datagrams> Datagrams::listen(int port, bool is_public) {
  const Addresses at = addresses_of(is_public ? nullptr : "127.0.0.1", std::to_string(port), true);
  Datagrams result(at ? socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0) : -1);
  if (result.socket_ < 0 || bind(result.socket_, at->ai_addr, at->ai_addrlen) != 0)
    return error("port {} cannot be listened at ({}); give another --port", port, std::strerror(errno));
  return result;
}

Result<Datagrams> Datagrams::connect(const std::string& host_and_port) {
  const std::size_t colon = host_and_port.rfind(':');
  const Addresses to = colon == std::string::npos ? Addresses(nullptr, &freeaddrinfo)
                                                  : addresses_of(host_and_port.substr(0, colon).c_str(),
                                                                 host_and_port.substr(colon + 1), false);
  if (!to) return error("{}: there is no such place for a sound server; expected HOST:PORT", host_and_port);
  Datagrams result(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  // Connected, it takes no packets of others.
  if (result.socket_ < 0 || ::connect(result.socket_, to->ai_addr, to->ai_addrlen) != 0)
    return error("{}: no socket can be opened for it ({})", host_and_port, std::strerror(errno));
  result.peer_.assign(reinterpret_cast<const char*>(to->ai_addr), to->ai_addrlen);
  return result;
}

Datagrams::Datagrams(Datagrams&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), peer_(std::move(other.peer_)) {}

Datagrams::~Datagrams() {
  if (socket_ >= 0) close(socket_);
}

std::string Datagrams::receive(int wait_ms) {
  pollfd waiting{socket_, POLLIN, 0};
  if (poll(&waiting, 1, wait_ms) <= 0) return {};
  buffer_.resize(65'536);
  sockaddr_storage from{};
  socklen_t size = sizeof from;
  const ssize_t count = recvfrom(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT,
                                 reinterpret_cast<sockaddr*>(&from), &size);
  if (count <= 0) return {};
  peer_.assign(reinterpret_cast<const char*>(&from), size);
  return buffer_.substr(0, std::size_t(count));
}

void Datagrams::send(std::string_view packet) {
  if (!peer_.empty())
    static_cast<void>(sendto(socket_, packet.data(), packet.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                             reinterpret_cast<const sockaddr*>(peer_.data()), socklen_t(peer_.size())));
}

std::string Datagrams::sender() const {
  sockaddr_in from{};
  if (peer_.size() < sizeof from) return "";
  std::memcpy(&from, peer_.data(), sizeof from);
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &from.sin_addr, text.data(), text.size());
  return fmt::format("{}:{}", text.data(), ntohs(from.sin_port));
}

int Datagrams::port() const {
  sockaddr_in own{};
  socklen_t size = sizeof own;
  getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size);
  return ntohs(own.sin_port);
}

std::shared_ptr<const Recording> SentRecordings::find(const std::string& file, double now_s) {
  keep_read();
  read_next();
  std::erase_if(files_, [&](const auto& it) {
    return now_s - it.second.used_s > forgotten_s && !it.second.read.valid();
  });
  if (!files_.contains(file) && files_.size() >= max_files) {
    if (!std::exchange(is_full_, true))
      message_ = fmt::format("the client has more than {} recordings; some are not heard", max_files);
    return nullptr;
  }
  if (files_.size() < max_files) is_full_ = false;
  File& sent = files_[file];
  sent.used_s = now_s;
  return sent.recording;
}

/// Keeps the recording that has been read meanwhile.
void SentRecordings::keep_read() {
  const auto found = std::ranges::find_if(files_, [](const auto& it) { return it.second.read.valid(); });
  if (found == files_.end()) return;
  File& sent = found->second;
  if (sent.read.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  Result<Recording> read = sent.read.get();
  sent.bytes = {};
  double total_s = read ? read->length_s() : 0.0;
  for (const auto& [name, other] : files_) total_s += other.recording ? other.recording->length_s() : 0.0;
  if (read && total_s <= max_total_s) {
    sent.recording = std::make_shared<const Recording>(*std::move(read));
  } else {
    sent.is_bad = true;
    message_ = read ? fmt::format("the client's recordings last longer than {:.0f} s; some are not heard",
                                  max_total_s)
                    : to_string(read.errors());
  }
}

/// Begins to read a recording that has come whole, where none is being read.
void SentRecordings::read_next() {
  if (std::ranges::any_of(files_, [](const auto& it) { return it.second.read.valid(); })) return;
  const auto next = std::ranges::find_if(
      files_, [](const auto& it) { return it.second.missing == 0 && !it.second.bytes.empty(); });
  if (next == files_.end()) return;
  // The file stays where it is, with its bytes, while it is being read.
  next->second.read = std::async(std::launch::async, [&bytes = next->second.bytes]() -> Result<Recording> {
    try {
      return decode_recording(bytes, "the client's recording");
    } catch (const std::exception& exception) {
      return error("the client's recording cannot be read ({})", exception.what());
    }
  });
}

Status SentRecordings::take(const OscMessage& part) {
  const auto number = [&](std::size_t i) { return std::size_t(std::clamp(part.numbers[i], 0.0, 1e9)); };
  const auto found = part.numbers.size() == 3 ? files_.find(part.texts[0]) : files_.end();
  if (found == files_.end()) return error("/parvis/part: nobody has asked for it");
  File& file = found->second;
  const std::size_t index = number(1), size = number(2), parts = (size + part_bytes - 1) / part_bytes;
  if (size == 0 || size > max_recording_bytes || index >= parts ||
      part.blob.size() != std::min(part_bytes, size - index * part_bytes))
    return error("/parvis/part: part {} of {} bytes has {}", index, size, part.blob.size());
  if (file.missing == 0) return Ok{};  // it has come twice
  const auto begin_anew = [&] { file.missing = 1, file.bytes = {}, file.has.clear(); };
  if (!file.has.empty() && size != file.bytes.size()) {
    begin_anew();
    return error("/parvis/part: a part of {} bytes of all comes after those of another size", size);
  }
  std::size_t coming = size;
  for (const auto& [name, other] : files_) coming += other.bytes.size();
  if (file.has.empty() && coming > max_bytes)
    return error("/parvis/part: recordings of more than {} MB come at a time", max_bytes >> 20);
  if (file.has.empty()) file.bytes.assign(size, '\0'), file.has.assign(parts, false), file.missing = parts;
  if (file.has[index]) return Ok{};
  std::memcpy(file.bytes.data() + index * part_bytes, part.blob.data(), part.blob.size());
  file.has[index] = true;
  if (--file.missing > 0) return Ok{};
  file.has.clear();
  if (name_of_recording(file.bytes) != found->first) {  // parts of different files
    begin_anew();
    return error("/parvis/part: the bytes are not those of the recording");
  }
  read_next();
  return Ok{};
}

std::vector<std::string> SentRecordings::wanted(double now_s) {
  std::vector<std::string> messages;
  for (const auto& [name, file] : files_) {
    constexpr double still_used_s = 2.0;
    if (file.missing == 0 || file.is_bad || now_s - file.used_s > still_used_s) continue;
    const auto first = std::size_t(std::ranges::find(file.has, false) - file.has.begin());
    const OscMessage want{
        "/parvis/want", {0.0, double(first), file.has.empty() ? 1.0 : double(parts_wanted)}, {name, "", ""}};
    if (Result<std::string> packet = liblo.call(&LibloFunctions::encode, want))
      messages.push_back(*std::move(packet));
  }
  return messages;
}

Status ServedSounds::take_bed(const OscMessage& message, double now_s) {
  if (message.numbers.size() != 2 || message.texts[0].empty())
    return error("/parvis/bed with {} arguments: expected a file and a gain", message.numbers.size());
  if (beds_.size() >= max_beds && !beds_.contains(message.texts[0]))
    return error("/parvis/bed: more than {} beds", max_beds);
  constexpr double max_gain = 100.0;
  beds_[message.texts[0]] = {std::clamp(message.numbers[1], 0.0, max_gain), now_s};
  return Ok{};
}

Result<std::string> ServedSounds::take(std::string_view packet, double now_s) {
  const Result<OscMessage> read = liblo.call(&LibloFunctions::decode, packet);
  if (!read) return read.errors();
  const std::vector<double>& numbers = read->numbers;
  const auto id = [&] { return std::uint64_t(std::clamp(numbers[0], 0.0, 1e9)); };
  if (read->address == "/parvis/ping")
    return liblo.call(&LibloFunctions::encode, OscMessage{"/parvis/pong", {}, {}});
  if (read->address == "/parvis/mute" && numbers.size() == 1) {
    is_muted_ = numbers[0] != 0.0;
    return std::string();
  }
  if (read->address == "/parvis/silent" && numbers.size() == 1) {
    sounds_.erase(id());
    return std::string();
  }
  if (const bool is_part = read->address == "/parvis/part"; is_part || read->address == "/parvis/bed") {
    const Status status = is_part ? recordings_.take(*read) : take_bed(*read, now_s);
    return status ? Result<std::string>(std::string()) : status.errors();
  }
  if (read->address != "/parvis/sound" || numbers.size() < sound_arguments ||
      numbers.size() > sound_arguments + 2)
    return error(
        "{} with {} arguments: expected /parvis/sound with {} to {}, /parvis/bed, /parvis/part, "
        "/parvis/silent, /parvis/mute or /parvis/ping",
        read->address, numbers.size(), sound_arguments, sound_arguments + 2);
  const SoundKind kind = sound_kind(read->texts[1]);
  const std::string file = numbers.size() > sound_arguments + 1 ? read->texts[sound_arguments + 1] : "";
  if (std::size_t(kind) >= synthetic_kinds && (kind != SoundKind::recording || file.empty()))
    return error("/parvis/sound: \"{}\" is no kind of sound that can be sent so", read->texts[1]);
  if (sounds_.size() >= max_sounds && !sounds_.contains(id()))
    return error("/parvis/sound: more than {} sounds", max_sounds);
  Served served;
  served.told_s = now_s, served.file = file;
  served.sound.id = id(), served.sound.kind = kind;
  served.sound.seed =
      numbers.size() > sound_arguments ? std::uint64_t(std::clamp(numbers[sound_arguments], 0.0, 1e9)) : id();
  const glm::dvec3 direction(numbers[2], numbers[3], numbers[4]);
  const double length = glm::length(direction);
  if (!(length > 1e-6 && length < 1e6)) return error("/parvis/sound: the direction has no length");
  served.sound.direction = glm::vec3(direction / length);
  for (std::size_t band = 0; band < octaves; ++band)
    served.sound.energy[band] = propagation::energy(
        std::clamp(numbers[5 + band], propagation::silence_db, max_level_db) - full_scale_db);
  served.sound.emitted_s = std::clamp(numbers[13], 0.0, max_delay_s);
  sounds_[served.sound.id] = served;
  return std::string();
}

std::vector<HeardSound> ServedSounds::heard(double now_s) {
  std::erase_if(sounds_, [&](const auto& it) { return now_s - it.second.told_s > forgotten_s; });
  std::vector<HeardSound> result;
  for (const auto& [id, served] : sounds_) {
    HeardSound sound = served.sound;
    if (!served.file.empty() && !(sound.recording = recordings_.find(served.file, now_s))) continue;
    sound.emitted_s = now_s - served.sound.emitted_s;
    result.push_back(std::move(sound));
  }
  return result;
}

std::vector<Bed> ServedSounds::beds(double now_s) {
  std::erase_if(beds_, [&](const auto& it) { return now_s - it.second.told_s > forgotten_s; });
  std::vector<Bed> result;
  for (const auto& [file, bed] : beds_)
    if (const auto recording = recordings_.find(file, now_s)) result.push_back({recording, float(bed.gain)});
  return result;
}

OscMessage message_of(const HeardSound& sound, double time_s, const std::string& file) {
  constexpr std::uint64_t whole_floats = 16'000'000;
  OscMessage message{"/parvis/sound", {double(sound.id % whole_floats)}, {""}};
  const auto add = [&](double number) { message.numbers.push_back(number), message.texts.emplace_back(); };
  message.numbers.push_back(0.0), message.texts.emplace_back(sound_names[std::size_t(sound.kind)]);
  for (int axis = 0; axis < 3; ++axis) add(double(sound.direction[axis]));
  for (const double energy : sound.energy) add(propagation::level(energy) + full_scale_db);
  add(time_s - sound.emitted_s), add(double(sound.seed % whole_floats));
  if (!file.empty()) message.numbers.push_back(0.0), message.texts.push_back(file);
  return message;
}

std::string name_of_recording(std::string_view bytes) {
  ContentHash hash;
  hash.add_text(bytes);
  return fmt::format("{:016x}", hash.value());
}

OscMessage part_of(const std::string& name, std::string_view bytes, std::size_t index) {
  return {"/parvis/part",
          {0.0, double(index), double(bytes.size())},
          {name, "", ""},
          std::string(bytes.substr(std::min(index * part_bytes, bytes.size()), part_bytes))};
}

}  // namespace parvis::sound
