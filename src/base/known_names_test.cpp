#include "base/known_names.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/test_folder.h"

namespace parvis {
namespace {

TEST(KnownNames, CountsEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("camrea", "camera"), 1);  // neighbours swapped
  EXPECT_EQ(edit_distance("Camera", "camera"), 0);
}

TEST(KnownNames, SuggestsOnlyWhatIsNear) {
  const std::vector<std::string> known{"camera", "model", "material"};
  EXPECT_EQ(did_you_mean("modle", known), "; did you mean \"model\"?");
  EXPECT_EQ(did_you_mean("xyzzy", known), "");
  EXPECT_EQ(did_you_mean(std::string(100'000, 'm'), known), "");
}

TEST(KnownNames, ListsEachNameOnceTheNearestFirst) {
  const auto list = [](const char* word, const std::vector<std::string>& known) {
    return names_that_exist(word, known);
  };
  EXPECT_EQ(list("hill", {}), "; there is none");
  EXPECT_EQ(list("hill", {""}), "; there is none") << "an empty name is none";
  EXPECT_EQ(list("xyzzy", {"quarter"}), "; there is \"quarter\"");
  EXPECT_EQ(list("hil", {"quarter", "hill", "lake", "hill"}),
            "; did you mean \"hill\"? There are also \"lake\", \"quarter\"");
  EXPECT_EQ(list("hil", {"hill"}), "; did you mean \"hill\"?");
  EXPECT_EQ(list("hil", {"quarter", "hill"}), "; did you mean \"hill\"? There is also \"quarter\"");
  EXPECT_EQ(list("Wheels", {"bonnet", "front wheels of the car", "door"}),
            "; there are \"front wheels of the car\", \"bonnet\", \"door\"")
      << "a name that holds the word is nearest";
  EXPECT_EQ(list("*wheels", {"bonnet", "all wheels"}), "; there are \"all wheels\", \"bonnet\"");
}

TEST(KnownNames, LongListsSayHowManyMoreThereAre) {
  std::vector<std::string> known;
  for (int i = 0; i < 11; ++i) known.push_back(fmt::format("some house {:02}", i));
  EXPECT_EQ(names_that_exist("x", known).find("others"), std::string::npos);
  EXPECT_NE(names_that_exist("x", known).find("\"some house 10\""), std::string::npos);
  for (int i = 11; i < 5000; ++i) known.push_back(fmt::format("some house {:02}", i));
  known.push_back("lamp");
  const std::string list = names_that_exist("x", known);
  EXPECT_TRUE(list.starts_with("; there are \"lamp\", \"some house 00\"")) << list;
  EXPECT_TRUE(list.ends_with("\"some house 08\" and 4991 others")) << list;
  const std::vector<std::string> long_names{std::string(100'000, 'm')};
  EXPECT_LT(names_that_exist("x", long_names).size(), 100u);
  EXPECT_LT(names_that_exist(std::string(100'000, 'x'), known).size(), 300u);
}

TEST(KnownNames, AMissingFolderIsReportedWithThoseBesideIt) {
  const TestFolder folder;
  folder.write("data/towns/delft.osm", "");
  folder.write("data/cars/car.glb", "");
  folder.write("data/readme.txt", "");
  folder.write("data/.hidden/x", "");
  EXPECT_EQ(missing_folder(folder.path() / "data"), "");
  const std::string data = (folder.path() / "data").string();
  for (const char* missing : {"data/town", "data/town/", "data/town/delft/centre", "data/cars/../town"})
    EXPECT_EQ(missing_folder(folder.path() / missing),
              data + " has no folder \"town\"; did you mean \"towns\"? There is also \"cars\"")
        << missing;
  EXPECT_EQ(missing_folder(folder.path() / "data/cars/delft"),
            (folder.path() / "data/cars").string() + " has no folder \"delft\"; there is none");
  EXPECT_EQ(missing_folder(folder.path() / "data/readme.txt"), "it is a file; expected a folder");
}

}  // namespace
}  // namespace parvis
