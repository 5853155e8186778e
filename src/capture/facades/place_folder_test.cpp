#include "capture/facades/place_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/files.h"
#include "capture/facades/test_street.h"
#include "capture/photographs/set_file.h"

namespace parvis::facades {
namespace {
namespace fs = std::filesystem;

/// The street, taken with a lens that distorts, as a folder.
struct DistortedPlace {
  Photos input;
  fs::path folder = input.folder.path() / "place";

  DistortedPlace() {
    for (photographs::Photograph& photo : input.photos) {
      photographs::Lens& lens = photo.lens;
      lens.model = photographs::LensModel::simple_radial;
      lens.parameters = {lens.parameters[0], 80.0, 60.0, 0.05};
    }
    photographs::PhotographSet set;
    set.photographs = input.photos;
    EXPECT_TRUE(photographs::write_photograph_set(folder, set, input.folder.path()));
  }
  PlaceSource read() const {
    Result<PlaceSource> source = read_place(folder, street(), {});
    EXPECT_TRUE(source) << to_string(source ? Errors{} : source.errors());
    return source ? *std::move(source) : PlaceSource{};
  }
  std::string straight(int i) const {
    const Result<std::string> bytes = read_file(folder / "pinhole" / fmt::format("{:04}.png.png", i));
    EXPECT_TRUE(bytes);
    return bytes ? *bytes : "";
  }
};

TEST(PlaceFolder, StraightPicturesThatAreExchangedOrDamagedAreStraightenedOnceMore) {
  const DistortedPlace place;
  ASSERT_EQ(place.read().photographs.size(), 4u);
  const std::string first = place.straight(0), last = place.straight(3);
  ASSERT_NE(first, last);
  const fs::path pinhole = place.folder / "pinhole";
  const auto written = fs::last_write_time(pinhole / "0001.png.png");
  ASSERT_TRUE(write_file(pinhole / "0000.png.png", last));
  ASSERT_TRUE(write_file(pinhole / "0003.png.png", last.substr(0, last.size() / 2)));
  EXPECT_EQ(place.read().photographs.size(), 4u);
  EXPECT_EQ(place.straight(0), first);
  EXPECT_EQ(place.straight(3), last);
  EXPECT_EQ(fs::last_write_time(pinhole / "0001.png.png"), written) << "what is as it was is taken over";
}

TEST(PlaceFolder, StraightPicturesStayInTheFolder) {
  const DistortedPlace place;
  const fs::path outside = place.input.folder.path() / "outside";
  fs::create_directories(outside);
  fs::create_directory_symlink("../outside", place.folder / "pinhole");
  const Result<PlaceSource> source = read_place(place.folder, street(), {});
  ASSERT_FALSE(source);
  EXPECT_NE(to_string(source.errors()).find("pinhole"), std::string::npos) << to_string(source.errors());
  EXPECT_TRUE(fs::is_empty(outside));
}

TEST(PlaceFolder, PhotographsOfOneNameAreRefused) {
  DistortedPlace place;
  photographs::PhotographSet set;
  set.photographs = place.input.photos;
  set.photographs[1].name = "0000.jpg";
  fs::rename(set.photographs[1].file, place.input.folder.path() / "0000.jpg");
  set.photographs[1].file = place.input.folder.path() / "0000.jpg";
  ASSERT_TRUE(photographs::write_photograph_set(place.folder, set, place.input.folder.path()));
  const Result<PlaceSource> source = read_place(place.folder, street(), {});
  ASSERT_FALSE(source);
  EXPECT_NE(to_string(source.errors()).find("rename"), std::string::npos) << to_string(source.errors());
}

TEST(PlaceFolder, ProposedColoursOfSurfacesAreRefusedByTheirNames) {
  const Photos input;
  PlaceLayers place = *place_layers(input.photos, street());
  const std::vector<Filling> of_first = place.filled[0].states;
  EXPECT_TRUE(apply_choices({{surfaces_choice, "post", Filling::refused}}, place).empty());
  EXPECT_EQ(place.surfaces, (std::vector<Filling>{Filling::proposal, Filling::proposal, Filling::refused}));
  EXPECT_EQ(place.filled[0].states, of_first);
  const Errors messages = apply_choices({{surfaces_choice, "gone", Filling::refused}}, place);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].message.find("no surface \"gone\""), std::string::npos) << messages[0].message;
  EXPECT_TRUE(apply_choices({{"*", "*", Filling::accepted}}, place).empty());
  EXPECT_EQ(place.surfaces, std::vector<Filling>(3, Filling::accepted));
}

}  // namespace
}  // namespace parvis::facades
