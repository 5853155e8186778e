#include "life/sound/sound_server.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace parvis::sound {
namespace {

constexpr std::size_t sound_arguments = 14;
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
  if (result.socket_ < 0) return error("no socket can be opened ({})", std::strerror(errno));
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
  if (read->address != "/parvis/sound" || numbers.size() != sound_arguments)
    return error(
        "{} with {} arguments: expected /parvis/sound with {}, /parvis/silent, /parvis/mute or "
        "/parvis/ping",
        read->address, numbers.size(), sound_arguments);
  const SoundKind kind = sound_kind(read->texts[1]);
  if (std::size_t(kind) >= synthetic_kinds)
    return error("/parvis/sound: \"{}\" is no kind of sound", read->texts[1]);
  if (sounds_.size() >= max_sounds && !sounds_.contains(id()))
    return error("/parvis/sound: more than {} sounds", max_sounds);
  Served served;
  served.told_s = now_s;
  served.sound.id = id(), served.sound.kind = kind;
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
    result.push_back(served.sound);
    result.back().emitted_s = now_s - served.sound.emitted_s;
  }
  return result;
}

OscMessage message_of(const HeardSound& sound, double time_s) {
  OscMessage message{"/parvis/sound", {double(sound.id % 16'000'000)}, {""}};
  const auto add = [&](double number) { message.numbers.push_back(number), message.texts.emplace_back(); };
  message.numbers.push_back(0.0), message.texts.emplace_back(sound_names[std::size_t(sound.kind)]);
  for (int axis = 0; axis < 3; ++axis) add(double(sound.direction[axis]));
  for (const double energy : sound.energy) add(propagation::level(energy) + full_scale_db);
  add(time_s - sound.emitted_s);
  return message;
}

}  // namespace parvis::sound
