#include "formats/readers/packed_file.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/test_folder.h"
#include "formats/readers/readers.h"
#include "formats/readers/test_packing.h"

namespace parvis::formats {
namespace {

/// A text of some pieces, which packs well, but not like zeros.
std::string long_text() {
  std::string text;
  for (int i = 0; i < 300'000; ++i) text += fmt::format("{} ", i);
  return text;
}

/// The content of a file with these bytes, or its errors.
std::string content(const TestFolder& folder, const std::string& bytes) {
  const Result<std::string> text = read_unpacked(folder.write("town.osm.gz", bytes));
  return text ? *text : to_string(text.errors());
}

TEST(PackedFile, GzipAndBzip2AreUnpackedAndOtherBytesStay) {
  const TestFolder folder;
  const std::string text = long_text();
  EXPECT_TRUE(content(folder, gzipped(text)) == text);
  EXPECT_TRUE(content(folder, bzipped(text)) == text);
  EXPECT_EQ(content(folder, "as it is"), "as it is") << "browsers unpack files and keep their names";
  EXPECT_EQ(content(folder, ""), "");
  EXPECT_EQ(content(folder, gzipped("")), "");
}

TEST(PackedFile, StreamsAfterEachOtherAreOneText) {
  const TestFolder folder;
  EXPECT_EQ(content(folder, gzipped("one ") + gzipped("two")), "one two");
  EXPECT_EQ(content(folder, bzipped("one ") + bzipped("two")), "one two");
  EXPECT_EQ(content(folder, gzipped("padded") + std::string(512, '\0')), "padded");
}

TEST(PackedFile, CutShortOrDamagedItIsAnErrorWithItsName) {
  const TestFolder folder;
  const std::string text = long_text();
  for (const std::string& packed : {gzipped(text), bzipped(text)}) {
    const std::string cut = content(folder, packed.substr(0, packed.size() / 2));
    EXPECT_NE(cut.find("town.osm.gz"), std::string::npos) << cut.substr(0, 200);
    EXPECT_NE(cut.find("cut short"), std::string::npos) << cut.substr(0, 200);
    std::string spoilt = packed;
    for (std::size_t i = packed.size() / 2; i < packed.size() / 2 + 40; ++i) spoilt[i] = char(~spoilt[i]);
    const std::string damaged = content(folder, spoilt);
    EXPECT_NE(damaged.find("is damaged"), std::string::npos) << damaged.substr(0, 200);
    EXPECT_NE(damaged.find("town.osm.gz"), std::string::npos) << damaged.substr(0, 200);
  }
}

TEST(PackedFile, WhatIsMadeToFillTheMemoryIsRefused) {
  const TestFolder folder;
  const std::string zeros(std::size_t{80} << 20, '0');
  for (const std::string& packed : {gzipped(zeros), bzipped(zeros)}) {
    const std::string message = content(folder, packed);
    EXPECT_NE(message.find("times its size"), std::string::npos) << message.substr(0, 200);
    EXPECT_NE(message.find("town.osm.gz"), std::string::npos) << message.substr(0, 200);
  }
  constexpr std::uint64_t few_bytes = 2'000'000;
  const Result<std::string> limited = read_unpacked(folder.write("a.gz", gzipped(zeros)), few_bytes);
  ASSERT_FALSE(limited);
  EXPECT_NE(to_string(limited.errors()).find("more than the 2.0 MB"), std::string::npos);
}

TEST(PackedFile, TheFrontIsThatOfTheContent) {
  const TestFolder folder;
  const std::string text = long_text();
  for (const std::string& packed : {gzipped(text), bzipped(text), text}) {
    const Result<std::string> front = unpacked_front(folder.write("a", packed), 100);
    ASSERT_TRUE(front) << to_string(front.errors());
    EXPECT_EQ(*front, text.substr(0, 100));
  }
}

TEST(PackedFile, NamesAreThoseBelowThePacking) {
  EXPECT_EQ(model_extension("town.city.JSON.GZ"), ".json");
  EXPECT_EQ(model_extension("town.osm.bz2"), ".osm");
  EXPECT_EQ(model_extension("town.PBF"), ".pbf");
  EXPECT_EQ(model_extension("town.gz"), "");
  EXPECT_EQ(model_stem("a/town.city.json.gz"), "town.city");
  EXPECT_EQ(model_stem("town.glb"), "town");
}

TEST(PackedFile, DamagedBytesNeverCrash) {
  const TestFolder folder;
  Random random(7);
  const std::string text = long_text().substr(0, 20'000);
  const std::string packings[] = {gzipped(text), bzipped(text)};
  for (int round = 0; round < 200; ++round) {
    std::string bytes = packings[round % 2];
    for (int change = 0; change <= round % 5; ++change)
      bytes[std::size_t(random.index(int(bytes.size())))] = char(random.index(256));
    static_cast<void>(content(folder, bytes));
  }
}

/// A reader that gives the content as the model's name.
Result<FileContent> content_as_name(const std::filesystem::path& file, const ModelReading&, Errors&) {
  const Result<std::string> text = read_unpacked(file);
  if (!text) return text.errors();
  scene::Model model;
  model.name = *text;
  return FileContent{std::move(model), scene::FileAccount("digits")};
}

bool starts_with_digits(std::string_view front) { return front.starts_with("digits"); }

TEST(PackedFile, ReadersThatTakePackedFilesAreAskedByTheNameBelowThePacking) {
  const TestFolder folder;
  Readers readers;
  readers.add({".123"}, content_as_name, starts_with_digits, TakesPacked::yes);
  const auto read_by = [&](const char* name, const std::string& bytes) {
    Errors warnings;
    const Result<scene::Model> model = readers.read(folder.write(name, bytes), {}, warnings);
    return model ? model->name : to_string(model.errors());
  };
  EXPECT_EQ(read_by("a.123.gz", gzipped("digits 1")), "digits 1");
  EXPECT_EQ(read_by("a.123.BZ2", bzipped("digits 2")), "digits 2");
  EXPECT_EQ(read_by("a.123", gzipped("digits 3")), "digits 3");
  EXPECT_EQ(read_by("a.123.gz", "digits 4"), "digits 4");
  EXPECT_NE(read_by("a.123.gz", gzipped("letters")).find("of another format"), std::string::npos);
  EXPECT_NE(read_by("a.gz", gzipped("digits 5")).find("gunzip"), std::string::npos);
}

}  // namespace
}  // namespace parvis::formats
