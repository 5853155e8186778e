#include "planning/devices/devices.h"

#include <charconv>
#include <sstream>

#include "base/files.h"
#include "base/json_fields.h"
#include "planning/devices/spnav_module.h"

namespace parvis::devices {
namespace {

constexpr std::size_t max_reported = 20;  // of messages that were refused

/// The use of a button; kind none: the text is no such.
ButtonUse use_of(const std::string& text) {
  const std::string first(text.begin(), std::ranges::find(text, ' ')),
      rest = first.size() < text.size() ? text.substr(first.size() + 1) : "";
  using Kind = ButtonUse::Kind;
  if (rest.empty()) return {first == "action" ? Kind::action : first == "menu" ? Kind::menu : Kind::none, ""};
  const bool is_view = rest == "plan" || rest == "street" || rest == "balcony";
  return {first == "view" && is_view ? Kind::view
          : first == "key"           ? Kind::key
          : first == "do"            ? Kind::command
                                     : Kind::none,
          rest};
}

/// A big-endian number of OSC.
std::uint32_t number_at(std::string_view packet, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | std::uint8_t(packet[at + i]);
  return number;
}

void split(std::string_view packet, int depth, std::vector<sound::OscMessage>& messages, Errors& errors) {
  constexpr std::string_view bundle("#bundle\0", 8);
  constexpr int deepest = 4;
  if (!packet.starts_with(bundle)) {
    Result<sound::OscMessage> message = sound::liblo.call(&sound::LibloFunctions::decode, packet);
    if (message)
      messages.push_back(*std::move(message));
    else
      errors.insert(errors.end(), message.errors().begin(), message.errors().end());
    return;
  }
  std::size_t at = bundle.size() + 8;  // its time
  while (depth < deepest && at + 4 <= packet.size()) {
    const std::size_t size = number_at(packet, at);
    at += 4;
    if (size > packet.size() - at) break;
    split(packet.substr(at, size), depth + 1, messages, errors);
    at += size;
  }
  if (at != packet.size())
    errors.push_back(error("a bundle of {} bytes has parts that are longer than it", packet.size()));
}

}  // namespace

Result<DeviceSettings> read_devices(const std::string& text, const std::string& file) {
  const Result<OrderedJson> whole = read_versioned_json(text, file, "parvis_devices", 1);
  if (!whole) return whole.errors();
  DeviceSettings settings;
  Errors errors;
  JsonFields fields(*whole, file, errors);
  fields.find("parvis_devices"), fields.find("$schema");
  settings.osc_port = int(fields.number("osc_port", settings.osc_port, 0, 65535));
  settings.is_public = fields.flag("public", false);
  settings.has_gamepads = fields.flag("gamepads", true);
  settings.has_3d_mice = fields.flag("mice_3d", true);
  settings.buttons_of = fields.text("wand", settings.buttons_of);
  if (const OrderedJson* buttons = fields.find("buttons")) {
    JsonFields uses(*buttons, file + ": buttons", errors);
    for (std::size_t i = 0; i < DeviceSettings::wand_buttons; ++i) {
      const std::string number = std::to_string(i + 1), use = uses.text(number.c_str());
      settings.buttons[i] = use_of(use);
      if (!use.empty() && settings.buttons[i].kind == ButtonUse::Kind::none)
        uses.wrong(
            number,
            fmt::format("\"{}\": expected action, menu, view plan|street|balcony, key NAME or do COMMAND",
                        use));
    }
    uses.finish();
  }
  fields.finish();
  if (!errors.empty()) return errors;
  return settings;
}

std::vector<sound::OscMessage> messages_of(std::string_view packet, Errors& errors) {
  std::vector<sound::OscMessage> messages;
  split(packet, 0, messages, errors);
  return messages;
}

std::string RecordedMessage::line() const {
  std::string line = fmt::format("{:.6f} {} {}", at_s, sender, message.address);
  for (std::size_t i = 0; i < message.numbers.size(); ++i)
    line += " " + (message.texts[i].empty() ? fmt::format("{}", message.numbers[i]) : message.texts[i]);
  return line + "\n";
}

Result<RecordedMessage> RecordedMessage::read(const std::string& line, const FileLocation& where) {
  RecordedMessage result;
  std::istringstream words(line);
  if (!(words >> result.at_s >> result.sender >> result.message.address) || result.message.address[0] != '/')
    return error_at(where, "expected SECONDS SENDER /ADDRESS and what it says");
  for (std::string word; words >> word;) {
    double number = 0.0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_number = problem == std::errc() && end == word.data() + word.size();
    result.message.numbers.push_back(is_number ? number : 0.0);
    result.message.texts.push_back(is_number ? "" : word);
  }
  return result;
}

Result<Devices> Devices::open(const DeviceSettings& settings, const std::filesystem::path& recording,
                              const std::filesystem::path& replayed) {
  Devices devices;
  devices.settings_ = settings;
  if (!recording.empty()) {
    devices.recording_ = std::make_unique<std::ofstream>(recording);
    if (!*devices.recording_) return error("{}: it cannot be written", recording.string());
  }
  if (!replayed.empty()) {
    const Result<std::string> text = read_file(replayed, std::uint64_t{1} << 30);
    if (!text) return text.errors();
    std::istringstream lines(*text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      Result<RecordedMessage> message = RecordedMessage::read(line, {replayed.string(), ++number, 0});
      if (!message) return message.errors();
      devices.replayed_.push_back(*std::move(message));
    }
    return devices;
  }
  if (settings.osc_port > 0) {
    Result<sound::Datagrams> socket = sound::Datagrams::listen(settings.osc_port, settings.is_public);
    if (!socket) return error("trackers: {}", socket.errors()[0].message);
    devices.socket_.emplace(*std::move(socket));
  }
  const auto begin = [&](bool is_wanted, const auto& module, auto function) {
    if (!is_wanted) return false;
    const Status status = module.call(function);
    if (!status) devices.note(status.errors()[0].message);
    return status.ok();
  };
  devices.has_sdl_ = begin(settings.has_gamepads, sdl, &SdlFunctions::begin);
  devices.has_spnav_ = begin(settings.has_3d_mice, spnav, &SpnavFunctions::begin);
  return devices;
}

void Devices::note(std::string text) {
  constexpr std::size_t max_notes = 1000;
  if (notes_.size() < max_notes) notes_.push_back(std::move(text));
}

void Devices::take(const sound::OscMessage& message, const std::string& sender, double now_s) {
  if (recording_) *recording_ << RecordedMessage{now_s - *began_s_, sender, message}.line();
  if (const Status status = state_.take(message, sender, now_s); !status && ++refused_ <= max_reported)
    note(status.errors()[0].message);
}

void Devices::poll(double now_s) {
  if (!began_s_) began_s_ = now_s;
  constexpr double written_s = 1e-6;  // to which recordings write times
  while (next_replayed_ < replayed_.size() &&
         replayed_[next_replayed_].at_s <= now_s - *began_s_ + written_s) {
    const RecordedMessage& next = replayed_[next_replayed_++];
    take(next.message, next.sender, now_s);
  }
  constexpr int max_packets = 20'000;  // in one frame; a burst may be longer than the network's buffer
  for (int i = 0; socket_ && i < max_packets; ++i) {
    const std::string packet = socket_->receive(0);
    if (packet.empty()) break;
    Errors errors;
    const std::string sender = socket_->sender();
    for (const sound::OscMessage& message : messages_of(packet, errors)) take(message, sender, now_s);
    for (const Error& wrong : errors)
      if (++refused_ <= max_reported) note(fmt::format("{}: {}", sender, wrong.message));
  }
  const auto take_all = [&](const Result<std::vector<sound::OscMessage>>& messages) {
    if (messages)
      for (const sound::OscMessage& message : *messages) take(message, "here", now_s);
  };
  if (has_sdl_) take_all(sdl.call(&SdlFunctions::poll));
  if (has_spnav_) take_all(spnav.call(&SpnavFunctions::poll));
  if (recording_) recording_->flush();
}

int Devices::pulse(const Pulse& pulse) {
  if (!has_sdl_) return 0;
  const Result<int> felt = sdl.call(&SdlFunctions::pulse, pulse);
  return felt ? *felt : 0;
}

std::vector<std::string> Devices::take_notes() {
  std::vector<std::string> notes = std::exchange(notes_, {});
  for (std::string& note : state_.take_notes()) notes.push_back(std::move(note));
  return notes;
}

}  // namespace parvis::devices
