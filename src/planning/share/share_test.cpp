#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/test_folder.h"
#include "graphics/gl/test_context.h"
#include "planning/share/notes.h"
#include "planning/share/site.h"
#include "planning/share/site_files.h"
#include "rooms/rooms.h"

namespace parvis::share {
namespace {

using Json = nlohmann::json;

TEST(SiteFiles, SpellsBytesInBase64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64(std::string("\0\xff\x10", 3)), "AP8Q");
}

TEST(SiteFiles, KeepsWhatIsInAFolderAlready) {
  const TestFolder folder;
  folder.write("site/mine.txt", "mine");
  const Result<SiteFiles> files = SiteFiles::create(folder.path() / "site");
  ASSERT_FALSE(files);
  EXPECT_NE(files.errors().front().message.find("is not empty"), std::string::npos);
  EXPECT_EQ(*read_file(folder.path() / "site/mine.txt"), "mine");
}

TEST(SiteFiles, LeavesNothingWhereTheSiteIsNotFinished) {
  const TestFolder folder;
  {
    Result<SiteFiles> files = SiteFiles::create(folder.path() / "site");
    ASSERT_TRUE(files);
    ASSERT_TRUE(files->write("pictures/a.jpg", "bytes"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Notes, ArePartedByEmptyLinesAndAboutWhatTheirBracketsName) {
  const TestFolder folder;
  folder.write("notes.txt", "Three umbrellas stay.\n\n[street] The benches\nlook at the monument.\n");
  const Result<std::vector<Note>> notes = read_notes(folder.path() / "notes.txt", {"street"});
  ASSERT_TRUE(notes) << to_string(notes.errors());
  ASSERT_EQ(notes->size(), 2u);
  EXPECT_EQ((*notes)[0].about, "");
  EXPECT_EQ((*notes)[1].about, "street");
  EXPECT_EQ((*notes)[1].text, "The benches\nlook at the monument.");
}

TEST(Notes, NameTheLineOfAViewThatIsNone) {
  const TestFolder folder;
  folder.write("notes.txt", "One.\n\n[stret] Two.\n");
  const Result<std::vector<Note>> notes = read_notes(folder.path() / "notes.txt", {"street"});
  ASSERT_FALSE(notes);
  EXPECT_EQ(notes.errors().front().where.line, 3);
  EXPECT_NE(notes.errors().front().message.find("street"), std::string::npos);
}

constexpr const char* court = R"(
dayLight(latitude=43.70, longitude=7.27, julianDay=172, timeOfDay=16)
model(name="floor", file="floor.obj", up=z)
design(name="stone") {
  placed(name=bench, kind=bench_stone, position="0 0 0", heading_deg=180)
  measured(name=way, kind=distance, points="0 0 0, 3 4 0")
}
design(name="green", visible=0) { placed(name=tree, kind=tree_orange, position="2 0 0") }
scenario(name="trees", title="With an orange tree") {
  override(of=stone, visible=0)
  override(of=green, visible=1)
}
)";
constexpr const char* floor_model = "v -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3 4\n";

/// The JSON that a script of the site hands over.
Json part_of(const std::filesystem::path& file) {
  const std::string text = *read_file(file);
  const std::size_t begin = text.find(',') + 1;
  return Json::parse(text.substr(begin, text.rfind(')') - begin));
}

class ShareTest : public gl::ContextTest {
 protected:
  std::unique_ptr<stage::Stage> open(std::string script) {
    folder_.write("court.xp", script), folder_.write("floor.obj", floor_model);
    Result<stage::Simulation> simulation =
        stage::open_simulation(rooms::all_registries(), folder_.path() / "court.xp", {});
    if (!simulation) throw std::runtime_error(to_string(simulation.errors()));
    return *stage::Stage::create(*std::move(simulation));
  }
  std::filesystem::path site() const { return folder_.path() / "site"; }

  TestFolder folder_;
};

#define WRITE_SITE(name, stage, ...)                                                         \
  const Result<WrittenSite> name = write_site(stage, __VA_ARGS__);                           \
  if (!name && name.errors().front().message.find("built without npm") != std::string::npos) \
    GTEST_SKIP() << "skipped: the page of shared sites was not packed: no npm here";         \
  ASSERT_TRUE(name) << to_string(name.errors())

TEST_F(ShareTest, WritesScenariosDifferencesMeasuresAndHours) {
  const auto stage = open(court);
  SiteOptions options;
  options.folder = site();
  WRITE_SITE(written, *stage, options);
  EXPECT_EQ(written->states, 2u);
  const Json json = part_of(site() / "scene.js");
  ASSERT_EQ(json["states"].size(), 2u);
  EXPECT_EQ(json["states"][1]["title"], "With an orange tree");
  EXPECT_NE(json["states"][0]["things"], json["states"][1]["things"]);
  ASSERT_EQ(json["states"][0]["measures"].size(), 1u);
  EXPECT_EQ(json["states"][0]["measures"][0]["text"], "5.00 m");
  EXPECT_TRUE(json["states"][1]["measures"].empty());
  ASSERT_EQ(json["differences"].size(), 1u);
  EXPECT_EQ(json["differences"][0]["rows"].size(), 2u);  // the bench goes, the tree comes
  ASSERT_EQ(json["days"].size(), 3u);                    // its own day is a solstice
  EXPECT_EQ(json["days"][0]["label"], "21 June");
  EXPECT_GT(json["days"][0]["moments"].size(), json["days"][2]["moments"].size());
  for (const char* file : {"index.html", "page.js", "place.js", "light.js", "hours.js"})
    EXPECT_TRUE(std::filesystem::exists(site() / file)) << file;
  for (const Json& state : json["states"])
    for (const Json& picture : state["pictures"])
      EXPECT_TRUE(std::filesystem::exists(site() / picture.get<std::string>())) << picture;
}

TEST_F(ShareTest, HasAnOverviewWhereTheSceneHasNoCamera) {
  const auto stage = open(court);
  SiteOptions options;
  options.folder = site();
  WRITE_SITE(written, *stage, options);
  EXPECT_EQ(written->views, 1u);
  EXPECT_EQ(part_of(site() / "scene.js")["views"][0]["name"], "overview");
}

TEST_F(ShareTest, SaysWhatABrowserShowsInstead) {
  const auto stage = open(std::string(court) + "lamp(position=\"0 0 4\", flux_lm=4000)\n");
  SiteOptions options;
  options.folder = site();
  WRITE_SITE(written, *stage, options);
  EXPECT_TRUE(std::ranges::any_of(
      written->instead, [](const std::string& sentence) { return sentence.starts_with("lamp (1): "); }));
  EXPECT_EQ(part_of(site() / "scene.js")["instead"].size(), written->instead.size());
}

TEST_F(ShareTest, NamesACameraThatIsNoneAndLeavesNothing) {
  const auto stage =
      open(std::string(court) + "camera(name=\"street\", position=\"0 -8 2\", target=\"0 0 1\")\n");
  SiteOptions options;
  options.folder = site();
  options.views = {"stret"};
  const Result<WrittenSite> written = write_site(*stage, options);
  ASSERT_FALSE(written);
  if (written.errors().front().message.find("built without npm") != std::string::npos)
    GTEST_SKIP() << "skipped: the page of shared sites was not packed: no npm here";
  EXPECT_NE(written.errors().front().message.find("street"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(site()));
}

}  // namespace
}  // namespace parvis::share
