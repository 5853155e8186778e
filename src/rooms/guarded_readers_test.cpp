// Whatever a reader does, for every kind of file that is read: an error that names the file.
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "base/image_io.h"
#include "base/isolated_process.h"
#include "base/process_limits.h"
#include "base/test_folder.h"
#include "formats/readers/readers.h"
#include "rooms/rooms.h"

namespace parvis::rooms {
namespace {

const formats::Readers& readers() { return all_registries().get<formats::Readers>(); }

/// The first bytes of the files of each kind.
const std::map<std::string, std::string> fronts{{".3ds", "MM"},
                                                {".3mf", "PK\x03\x04"},
                                                {".ac", "AC3D"},
                                                {".citygml", "<CityModel>"},
                                                {".cityjson", "{}"},
                                                {".dae", "<COLLADA>"},
                                                {".fbx", "; FBX 7.3.0"},
                                                {".glb", "glTF"},
                                                {".gltf", "{}"},
                                                {".gml", "<CityModel>"},
                                                {".ifc", "ISO-10303-21;"},
                                                {".iv", "#Inventor V2.1 ascii"},
                                                {".json", "{}"},
                                                {".jsonl", "{}"},
                                                {".lwo", "FORM"},
                                                {".obj", "v 0 0 0"},
                                                {".off", "OFF"},
                                                {".osm", "<osm>"},
                                                {".pbf", std::string("\0\0\0\x0d\n\tOSMHeader", 15)},
                                                {".ply", "ply"},
                                                {".stl", "solid"},
                                                {".tif", std::string("II*\0", 4)},
                                                {".tiff", std::string("II*\0", 4)},
                                                {".wrl", "#VRML V2.0 utf8"},
                                                {".x", "xof "},
                                                {".xml", "<CityModel>"}};

/// The kinds that the rooms register, as the error about another one lists them.
std::vector<std::string> registered_kinds(const TestFolder& folder) {
  Errors warnings;
  const auto model = readers().read(folder.write("a.unknown", "x"), {}, warnings);
  std::string text = to_string(model.errors());
  text = text.substr(text.find("read from") + 10);
  std::vector<std::string> kinds;
  std::istringstream words(text);
  for (std::string word; words >> word;) kinds.push_back(word.substr(0, word.find(',')));
  return kinds;
}

Status crash(std::string_view, IsolatedOutput&) {
  raise(SIGSEGV);
  return Ok{};
}
Status hang(std::string_view, IsolatedOutput&) {
  for (;;) pause();
}
Status take_all_memory(std::string_view, IsolatedOutput&) {
  std::vector<std::unique_ptr<char[]>> all;
  for (;;) all.push_back(std::make_unique_for_overwrite<char[]>(std::size_t{256} << 20));
}
Status open_outside(std::string_view, IsolatedOutput&) {
  return error("{}", std::ifstream("/etc/passwd") ? "opened" : "kept out");
}
/// Bytes that are no model, no map and no picture.
Status return_garbage(std::string_view, IsolatedOutput& output) {
  std::ranges::fill(output.allocate(1000), std::byte{0xa5});
  return Ok{};
}

constexpr double max_seconds = 0.1;

/// The error of each file and of a picture while their reader is another one, by the file's name.
std::map<std::string, std::string> errors_of_each_kind(IsolatedWork reader) {
  const TestFolder folder;
  std::map<std::string, std::string> said;
  for (const std::string& kind : registered_kinds(folder)) {
    const auto front = fronts.find(kind);
    EXPECT_NE(front, fronts.end()) << kind << ": what do its files begin with?";
    if (front == fronts.end()) continue;
    const std::filesystem::path file = folder.write("file" + kind, front->second);
    const WithOtherWork other(reader, max_seconds);
    Errors warnings;
    const Result<scene::Model> model = readers().read(file, {}, warnings);
    EXPECT_FALSE(model) << kind;
    said["file" + kind] = to_string(model.errors());
  }
  const std::filesystem::path picture = folder.write("picture.png", "\x89PNG\r\n\x1a\n");
  const WithOtherWork other(reader, max_seconds);
  const Result<Image8> image = read_image8(picture);
  EXPECT_FALSE(image);
  said["picture.png"] = to_string(image.errors());
  return said;
}

void expect_error(IsolatedWork reader, const std::string& words) {
  for (const auto& [name, said] : errors_of_each_kind(reader)) {
    EXPECT_NE(said.find(name), std::string::npos) << name << ": " << said;
    EXPECT_NE(said.find(words), std::string::npos) << name << ": " << said;
  }
}

TEST(GuardedReaders, EachKindIsTried) { EXPECT_EQ(registered_kinds(TestFolder()).size(), fronts.size()); }

TEST(GuardedReaders, ThatCrashAreAnError) { expect_error(crash, "its reader crashed"); }

TEST(GuardedReaders, ThatHangAreEnded) { expect_error(hang, "its reader took more than"); }

TEST(GuardedReaders, ThatTakeAllMemoryAreAnError) {
  if (has_shadow_memory) GTEST_SKIP() << "the address sanitizer needs an address space without a limit";
  expect_error(take_all_memory, "of memory");
}

TEST(GuardedReaders, ThatReturnGarbageAreAnError) { expect_error(return_garbage, ""); }

TEST(GuardedReaders, OpenNoFileOutsideOfTheirFolder) {
  if (syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) <= 0)
    GTEST_SKIP() << "this kernel has no Landlock";
  for (const auto& [name, said] : errors_of_each_kind(open_outside))
    EXPECT_NE(said.find("kept out"), std::string::npos) << name << ": " << said;
}

}  // namespace
}  // namespace parvis::rooms
