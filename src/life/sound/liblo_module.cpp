#include "life/sound/liblo_module.h"

#include <lo/lo.h>

#include <cmath>
#include <memory>

namespace parvis::sound {
namespace {

constexpr std::size_t max_arguments = 64;

struct Free {
  void operator()(void* message) const { lo_message_free(lo_message(message)); }
};
using Message = std::unique_ptr<void, Free>;

/// The address ends with a zero within the packet and begins as one; types follow it, in a string that begins
/// with a comma: without them a message's arguments are unknown.
bool has_types(std::string_view packet) {
  const std::size_t end = packet.find('\0');
  if (end == std::string_view::npos || packet.empty() || packet[0] != '/' || packet.size() % 4 != 0)
    return false;
  const std::size_t types = (end / 4 + 1) * 4;
  return types < packet.size() && packet[types] == ',' && packet.find('\0', types) != std::string_view::npos;
}

Result<OscMessage> decode(std::string_view packet) {
  constexpr std::size_t max_packet = 4096;
  if (packet.size() > max_packet || !has_types(packet))
    return error("a packet of {} bytes is no OSC message with types", packet.size());
  std::string own(packet);  // liblo turns numbers to the machine's byte order in place
  int code = 0;
  const Message message(lo_message_deserialise(own.data(), own.size(), &code));
  if (!message) return error("a packet of {} bytes is malformed OSC ({})", packet.size(), code);
  const lo_message read = lo_message(message.get());
  const int count = lo_message_get_argc(read);
  if (count < 0 || std::size_t(count) > max_arguments) return error("an OSC message has {} arguments", count);
  OscMessage result;
  result.address = packet.substr(0, packet.find('\0'));
  const char* const types = lo_message_get_types(read);
  lo_arg** const arguments = lo_message_get_argv(read);
  for (int i = 0; i < count; ++i) {
    double number = 0.0;
    std::string text;
    const lo_type type = lo_type(types[i]);
    if (lo_is_numerical_type(type))
      number = double(lo_hires_val(type, arguments[i]));
    else if (type == LO_STRING || type == LO_SYMBOL)
      text = &arguments[i]->s;
    else if (type == LO_BLOB && i + 1 == count) {
      const auto blob = lo_blob(arguments[i]);
      result.blob.assign(static_cast<const char*>(lo_blob_dataptr(blob)), lo_blob_datasize(blob));
      break;
    } else
      return error("{}: argument {} is of the type '{}'; expected a number or a text", result.address, i + 1,
                   types[i]);
    if (!std::isfinite(number)) return error("{}: argument {} is no number", result.address, i + 1);
    result.numbers.push_back(number);
    result.texts.push_back(std::move(text));
  }
  return result;
}

Result<std::string> encode(const OscMessage& message) {
  constexpr double max_whole = 2147483647.0;
  const Message written(lo_message_new());
  for (std::size_t i = 0; i < message.numbers.size(); ++i)
    if (const double number = message.numbers[i]; !message.texts[i].empty())
      lo_message_add_string(lo_message(written.get()), message.texts[i].c_str());
    else if (number == std::trunc(number) && std::abs(number) < max_whole)
      lo_message_add_int32(lo_message(written.get()), std::int32_t(number));
    else
      lo_message_add_float(lo_message(written.get()), float(number));
  if (!message.blob.empty()) {
    const lo_blob blob = lo_blob_new(std::int32_t(message.blob.size()), message.blob.data());
    lo_message_add_blob(lo_message(written.get()), blob);
    lo_blob_free(blob);
  }
  std::string packet(lo_message_length(lo_message(written.get()), message.address.c_str()), '\0');
  std::size_t size = packet.size();
  if (!lo_message_serialise(lo_message(written.get()), message.address.c_str(), packet.data(), &size))
    return error("{}: cannot be written as OSC", message.address);
  return packet;
}

}  // namespace
}  // namespace parvis::sound

PARVIS_MODULE(parvis::sound::LibloFunctions){parvis::sound::decode, parvis::sound::encode};
