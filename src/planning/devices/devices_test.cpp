#include "planning/devices/devices.h"

#include <SDL2/SDL.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "base/files.h"
#include "base/test_folder.h"
#include "planning/devices/spnav_module.h"

namespace parvis::devices {
namespace {

sound::OscMessage tracker(const std::string& name, glm::dvec3 at) {
  return {"/parvis/tracker", {0.0, at.x, at.y, at.z}, {name, "", "", ""}};
}

/// The reason for which a message is refused; empty: it is taken.
std::string refused(InputState& state, const sound::OscMessage& message, double now_s = 0.0) {
  const Status status = state.take(message, "here", now_s);
  return status ? "" : to_string(status.errors());
}

/// Sends packets to the devices of a test.
struct Sender {
  sound::Datagrams socket;
  explicit Sender(const Devices& devices)
      : socket(*sound::Datagrams::connect(fmt::format("127.0.0.1:{}", devices.osc_port()))) {}
  void send(const sound::OscMessage& message) {
    const Result<std::string> packet = sound::liblo.call(&sound::LibloFunctions::encode, message);
    ASSERT_TRUE(packet) << to_string(packet.errors());
    socket.send(*packet);
  }
};

DeviceSettings by_network_alone() {
  DeviceSettings settings;
  settings.osc_port = 0, settings.has_gamepads = settings.has_3d_mice = false;
  return settings;
}

/// Devices at a free port, by trying.
Devices at_free_port() {
  DeviceSettings settings = by_network_alone();
  for (settings.osc_port = 21'000 + int(getpid() % 20'000);; ++settings.osc_port)
    if (Result<Devices> devices = Devices::open(settings)) return *std::move(devices);
}

TEST(InputStateTest, ATrackerThatStopsStaysAndComesBackSmoothly) {
  InputState state;
  EXPECT_FALSE(state.pose("head", 0.0));
  ASSERT_EQ(refused(state, tracker("head", {0, 0, 1.7}), 0.0), "");
  EXPECT_EQ(state.pose("head", 0.1)->position.z, 1.7);
  EXPECT_EQ(state.pose("head", 5.0)->position.z, 1.7);
  ASSERT_EQ(refused(state, tracker("head", {1, 0, 1.7}), 6.0), "");  // a metre away
  double last = 0.0, longest = 0.0;
  for (double now = 6.0; now <= 6.6; now += 1.0 / 60.0) {
    ASSERT_EQ(refused(state, tracker("head", {1, 0, 1.7}), now), "");
    const double x = state.pose("head", now)->position.x;
    longest = std::max(longest, x - last), last = x;
  }
  EXPECT_EQ(last, 1.0);
  EXPECT_LT(longest, 0.15);
  const std::vector<std::string> notes = state.take_notes();
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("\"head\" has stopped"), std::string::npos);
  EXPECT_NE(notes[1].find("goes on"), std::string::npos);
}

TEST(InputStateTest, WrongMessagesChangeNothing) {
  InputState state;
  ASSERT_EQ(refused(state, tracker("wand", {1, 2, 3})), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused(state, tracker("wand", {nan, 0, 0})).find("no number"), std::string::npos);
  EXPECT_NE(refused(state, tracker("wand", {1e9, 0, 0})).find("a room has"), std::string::npos);
  EXPECT_NE(
      refused(state, {"/parvis/tracker", {0, 1, 2, 3, 0, 0, 0, 0}, {"wand", "", "", "", "", "", "", ""}})
          .find("no length"),
      std::string::npos);
  EXPECT_NE(refused(state, {"/parvis/tracker", {1.0}, {""}}).find("the name"), std::string::npos);
  EXPECT_NE(refused(state, {"/parvis/button", {0, 99, 1}, {"wand", "", ""}}).find("1 to 64"),
            std::string::npos);
  EXPECT_NE(refused(state, {"/parvis/other", {0}, {"wand"}}).find("expected /parvis/tracker"),
            std::string::npos);
  EXPECT_EQ(state.pose("wand", 0.1)->position, glm::dvec3(1, 2, 3));
  EXPECT_TRUE(state.take_buttons().empty());
}

TEST(InputStateTest, TwoTrackersOfOneNameAreNamed) {
  InputState state;
  ASSERT_TRUE(state.take(tracker("head", {0, 0, 1}), "10.0.0.1:5000", 0.0));
  EXPECT_FALSE(state.take(tracker("head", {9, 0, 1}), "10.0.0.2:5000", 0.1));
  EXPECT_EQ(state.pose("head", 0.2)->position.x, 0.0);
  const std::vector<std::string> notes = state.take_notes();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("10.0.0.1:5000 is followed, 10.0.0.2:5000 is not"), std::string::npos) << notes[0];
  // Where the first has gone, the other may follow.
  EXPECT_TRUE(state.take(tracker("head", {9, 0, 1}), "10.0.0.2:5000", 2.0));
}

TEST(InputStateTest, FingersComeAndGo) {
  InputState state;
  EXPECT_EQ(refused(state, {"/tuio/2Dcur", {0, 3, 0.25, 0.5, 0, 0, 0}, {"set", "", "", "", "", "", ""}}), "");
  ASSERT_EQ(state.fingers().size(), 1u);
  EXPECT_EQ(state.fingers().at(3), glm::dvec2(0.25, 0.5));
  EXPECT_EQ(refused(state, {"/tuio/2Dcur", {0}, {"alive"}}), "");
  EXPECT_TRUE(state.fingers().empty());
}

TEST(DevicesTest, ABurstOfPacketsIsTakenInAndTheLastOneCounts) {
  Devices devices = at_free_port();
  Sender sender(devices);
  devices.poll(0.0);
  const auto began = std::chrono::steady_clock::now();
  for (int i = 0; i < 10'000; ++i) {
    sender.send(tracker("head", {i * 0.01, 0, 1.7}));
    if (i % 100 == 99) devices.poll(0.01);  // the network keeps some hundreds
  }
  devices.poll(0.02);
  EXPECT_EQ(devices.state().pose("head", 0.02)->position.x, float(99.99));
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(), 10.0);
  // Without a pause between: what the network keeps is taken, the rest is lost, nothing hangs.
  for (int i = 0; i < 10'000; ++i) sender.send(tracker("head", {1, 0, 1.7}));
  devices.poll(0.03);
  EXPECT_EQ(devices.state().pose("head", 0.03)->position.x, 1.0);
}

TEST(DevicesTest, PacketsThatAreNoneAreNotedAndTheRestOfABundleIsTaken) {
  const std::string good = *sound::liblo.call(&sound::LibloFunctions::encode, tracker("head", {1, 2, 3}));
  const auto sized = [](const std::string& part) {
    return std::string{0, 0, char(part.size() >> 8), char(part.size() & 255)} + part;
  };
  const std::string head = std::string("#bundle\0", 8) + std::string(8, '\0');
  Errors errors;
  EXPECT_EQ(messages_of(head + sized(good) + sized(head + sized(good)), errors).size(), 2u);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(messages_of(head + sized("/no_types\0\0\0") + sized(good), errors).size(), 1u);
  EXPECT_EQ(errors.size(), 1u);
  for (std::size_t size = 0; size < good.size(); ++size)
    static_cast<void>(messages_of(head + sized(good).substr(0, size), errors));
  std::string deep = good;
  for (int i = 0; i < 40; ++i) deep = head + sized(deep);
  EXPECT_TRUE(messages_of(deep, errors).empty());
}

TEST(DevicesTest, WhatIsRecordedIsReplayedAlike) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "devices.txt";
  std::vector<glm::dvec3> seen;
  const auto watch = [&](Devices& devices, double now) {
    devices.poll(now);
    if (const auto pose = devices.state().pose("head", now)) seen.push_back(pose->position);
  };
  {
    DeviceSettings settings = by_network_alone();
    settings.osc_port = at_free_port().osc_port() + 1;
    Result<Devices> devices = Devices::open(settings, file);
    ASSERT_TRUE(devices) << to_string(devices.errors());
    Sender sender(*devices);
    for (int i = 0; i < 20; ++i) {
      sender.send(tracker("head", {0.1 * i, std::sin(i), 1.7}));
      if (i == 10) sender.send({"/parvis/button", {0, 2, 1}, {"wand", "", ""}});
      watch(*devices, 100.0 + 0.05 * i);
    }
    ASSERT_EQ(devices->state().take_buttons().size(), 1u);
  }
  const std::vector<glm::dvec3> before = std::exchange(seen, {});
  Result<Devices> devices = Devices::open(by_network_alone(), {}, file);
  ASSERT_TRUE(devices) << to_string(devices.errors());
  for (int i = 0; i < 20; ++i) watch(*devices, 7.0 + 0.05 * i + 1e-6);
  EXPECT_EQ(seen, before);
  EXPECT_EQ(devices->state().take_buttons().size(), 1u);
  ASSERT_TRUE(write_file(file, "0.5 here\n"));
  const Result<Devices> half = Devices::open(by_network_alone(), {}, file);
  ASSERT_FALSE(half);
  EXPECT_NE(to_string(half.errors()).find("devices.txt:1: expected SECONDS"), std::string::npos);
}

TEST(DevicesTest, FilesOfDevicesAreRead) {
  const Result<DeviceSettings> settings = read_devices(
      R"({"parvis_devices": 1, "wand": "w", "buttons": {"1": "view plan", "12": "do undo", "3": "key space"}})",
      "d.json");
  ASSERT_TRUE(settings) << to_string(settings.errors());
  EXPECT_EQ(settings->buttons[0].kind, ButtonUse::Kind::view);
  EXPECT_EQ(settings->buttons[11].text, "undo");
  EXPECT_EQ(settings->buttons[1].kind, ButtonUse::Kind::none);
  for (const auto& [text, expected] :
       {std::pair(R"({"parvis_devices": 1, "buttons": {"1": "view roof"}})", "view plan|street|balcony"),
        std::pair(R"({"parvis_devices": 1, "buttons": {"13": "menu"}})", "\"13\" is no name"),
        std::pair(R"({"parvis_devices": 1, "osc_port": 99999})", "from 0 to 65535")})
    EXPECT_NE(to_string(read_devices(text, "d.json").errors()).find(expected), std::string::npos) << text;
}

TEST(DevicesTest, AGamepadIsReadAndRumbles) {
  static std::atomic<int> low = 0;
  SDL_SetHint(SDL_HINT_JOYSTICK_HIDAPI, "0");
  DeviceSettings settings = by_network_alone();
  settings.has_gamepads = true;
  Result<Devices> devices = Devices::open(settings);
  ASSERT_TRUE(devices) << to_string(devices.errors());
  SDL_VirtualJoystickDesc description{};
  description.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
  description.type = SDL_JOYSTICK_TYPE_FLIGHT_STICK;  // a joystick: its buttons keep their numbers
  description.naxes = 2, description.nbuttons = 12;
  description.Rumble = [](void*, Uint16 slow, Uint16) {
    low = slow;
    return 0;
  };
  const int made = SDL_JoystickAttachVirtualEx(&description);
  ASSERT_GE(made, 0) << SDL_GetError();
  devices->poll(0.0);
  SDL_Joystick* const joystick = SDL_JoystickFromInstanceID(SDL_JoystickGetDeviceInstanceID(made));
  ASSERT_NE(joystick, nullptr);
  SDL_JoystickSetVirtualButton(joystick, 11, 1);
  SDL_JoystickSetVirtualAxis(joystick, 1, -32'767);
  devices->poll(0.1);
  devices->poll(0.2);
  const std::vector<ButtonEvent> events = devices->state().take_buttons();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].device, "gamepad1");
  EXPECT_EQ(events[0].number, 12);
  EXPECT_EQ(devices->state().stick("gamepad1"), glm::dvec2(0.0, 1.0));  // ahead
  EXPECT_EQ(devices->pulse({0.5f, 0.0f, 0.0f, 0.1f}), 1);
  EXPECT_NEAR(low, 32'767, 2);
  SDL_JoystickDetachVirtual(made);
  devices->poll(0.3);
}

TEST(DevicesTest, A3dMousePushedAheadMovesAhead) {
  InputState state;
  ASSERT_EQ(refused(state, motion_message({0, 0, 175, 0, 350, 0})), "");
  EXPECT_EQ(state.motion(), (std::array{0.0, 0.5, 0.0, 1.0, 0.0}));
}

}  // namespace
}  // namespace parvis::devices
