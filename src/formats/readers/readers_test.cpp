#include "formats/readers/readers.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/test_folder.h"
#include "formats/readers/plain_account.h"

namespace parvis::formats {
namespace {

/// A reader whose models are called `name`.
ReadModel reader(const char* name) {
  return [name](const std::filesystem::path&, const ModelReading& reading, Errors&) -> Result<FileContent> {
    scene::Model model;
    model.name = name;
    if (reading.cell_m) model.name += " in cells";
    return with_plain_account("letters", std::move(model));
  };
}

std::string read_by(const Readers& readers, const std::filesystem::path& file,
                    const ModelReading& reading = {}) {
  Errors warnings;
  const Result<scene::Model> model = readers.read(file, reading, warnings);
  return model ? model->name : to_string(model.errors());
}

bool is_any(std::string_view) { return true; }
bool has_mark(std::string_view front) { return front.starts_with("digits"); }

TEST(Readers, AreFoundByExtensionInAnyCase) {
  const TestFolder folder;
  Readers readers;
  readers.add({".abc", ".abd"}, reader("letters"), is_any);
  readers.add({".123"}, reader("digits"), has_mark);
  EXPECT_EQ(read_by(readers, folder.write("b.abd", "")), "letters");
  EXPECT_EQ(read_by(readers, folder.write("b.ABD", "")), "letters");
  EXPECT_EQ(read_by(readers, folder.write("b.123", "digits"), {.cell_m = 1.0}), "digits in cells");
  const std::string unknown = read_by(readers, folder.write("c.xyz", "digits"));
  for (const char* expected : {"c.xyz", "\".xyz\"", ".123, .abc, .abd"})
    EXPECT_NE(unknown.find(expected), std::string::npos) << unknown;
}

TEST(Readers, PicturesThatAReaderHasCountedAreCountedOnce) {
  scene::Model model;
  model.textures.resize(3);
  scene::FileAccount account("letters");
  account.used("images"), account.left_out("images", "a checker stands for them", "lost.png");
  count_what_is_shown(model, account);
  EXPECT_EQ(account.count(scene::Fate::used, "images"), 2u);
  EXPECT_EQ(account.count(scene::Fate::left_out, "images"), 1u);
  const Result<FileContent> plain = with_plain_account("letters", model);
  EXPECT_EQ(plain->account.count(scene::Fate::used, "images"), 3u);
}

TEST(Readers, TheModelCarriesTheAccountAndItsShortFormIsAWarning) {
  const TestFolder folder;
  Readers readers;
  readers.add(
      {".abc"},
      [](const std::filesystem::path&, const ModelReading&, Errors&) -> Result<FileContent> {
        scene::FileAccount account("letters");
        account.used("letters", 20);
        account.changed("letters", "in capitals", "x");
        account.left_out("letters", "not of this alphabet",
                         "\xff"
                         "th");
        return FileContent{{}, std::move(account)};
      },
      is_any);
  Errors warnings;
  const Result<scene::Model> model = readers.read(folder.write("b.abc", ""), {}, warnings);
  ASSERT_TRUE(model.ok());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(to_string(warnings).find("b.abc: 1 letters left out: not of this alphabet (\ufffdth)"),
            std::string::npos)
      << to_string(warnings);
  ASSERT_NE(model->account, nullptr);
  EXPECT_EQ(model->account->count(scene::Fate::used), 20u);
  EXPECT_NE(model->account->text().find("b.abc: letters\n  20 letters used\n  1 letters changed"),
            std::string::npos)
      << model->account->text();
}

TEST(Readers, ContentOfAnotherFormatIsRefused) {
  const TestFolder folder;
  Readers readers;
  readers.add({".123"}, reader("digits"), has_mark);
  EXPECT_NE(read_by(readers, folder.write("c.123", "letters")).find("of another format"), std::string::npos);
  EXPECT_NE(read_by(readers, folder.path() / "absent.123").find("absent.123"), std::string::npos);
  EXPECT_NE(read_by(readers, folder.path()).find("no reader"), std::string::npos);
  ASSERT_EQ(mkfifo((folder.path() / "pipe.123").c_str(), 0600), 0);
  EXPECT_NE(read_by(readers, folder.path() / "pipe.123").find("regular"), std::string::npos);
}

TEST(Readers, PackedFilesAreRefusedWithWhatUnpacksThem) {
  const TestFolder folder;
  Readers readers;
  readers.add({".123"}, reader("digits"), has_mark);
  readers.add({".3mf"}, reader("a format that is an archive itself"), is_any);
  const std::string by_name = read_by(readers, folder.write("tile.123.gz", "\x1f\x8b rest"));
  EXPECT_NE(by_name.find("gunzip -k \"tile.123.gz\""), std::string::npos) << by_name;
  const std::string archive = read_by(readers, folder.write("town.zip", "PK\x03\x04 rest"));
  EXPECT_NE(archive.find("unzip \"town.zip\""), std::string::npos) << archive;
  const std::string by_content = read_by(readers, folder.write("tile.123", "\x1f\x8b rest"));
  EXPECT_NE(by_content.find("is packed"), std::string::npos) << by_content;
  EXPECT_EQ(read_by(readers, folder.write("part.3mf", "PK\x03\x04 rest")),
            "a format that is an archive itself");
  EXPECT_EQ(read_by(readers, folder.write("letters.gz", "no such thing")).find("is packed"),
            std::string::npos)
      << "control";
}

TEST(Readers, NamesBecomeValidUtf8) {
  const TestFolder folder;
  Readers readers;
  readers.add({".123"}, reader("caf\xe9"), is_any);
  EXPECT_EQ(read_by(readers, folder.write("c.123", "")), "caf\xef\xbf\xbd");
}

}  // namespace
}  // namespace parvis::formats
