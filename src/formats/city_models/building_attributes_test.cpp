#include "formats/city_models/building_attributes.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace parvis::scene {
namespace {

std::string words(const BuildingAttributes& attributes) { return words_of(kind_of_building(attributes)); }
std::string osm_words(const OsmTags& tags) { return words_of(kind_of_osm_building(tags)); }

TEST(BuildingAttributes, YearsAreFoundUnderTheNamesOfSeveralCountries) {
  for (const char* name : {"oorspronkelijkbouwjaar", "yearOfConstruction", "Baujahr", "year_of_construction",
                           "bldg:yearOfConstruction", "année_construction", "GBAUJ", "dateOfConstruction"})
    EXPECT_EQ(words({{name, "1911"}}), "1870-1918") << name;
  EXPECT_EQ(words({{"dateOfConstruction", "1938-01-01"}}), "1919-1945");
  EXPECT_EQ(words({{"yearOfConstruction", "1005"}}), "") << "the Dutch register knows none";
  for (const char* none : {"", "0", "0001", "9999", "unknown", "19110503", "-5"})
    EXPECT_EQ(words({{"yearOfConstruction", none}}), "") << none;
  EXPECT_EQ(words({{"yearOfConstruction", "0"}, {"baujahr", "2004"}}), "since-2000");
}

TEST(BuildingAttributes, UsesAreWordsOrCodes) {
  for (const char* dwelling : {"woonfunctie", "Wohngebäude", "Résidentiel", "1000", "31001_1010", "411"})
    EXPECT_EQ(words({{"function", dwelling}}), "dwelling") << dwelling;
  for (const char* office : {"kantoorfunctie", "Bürogebäude", "1120", "31001_2020", "401", "Office building"})
    EXPECT_EQ(words({{"function", office}}), "office") << office;
  for (const char* shop : {"winkelfunctie", "Wohn- und Geschäftsgebäude", "1160", "31001_2054", "402"})
    EXPECT_EQ(words({{"usage", shop}}), "shop") << shop;
  for (const char* works : {"industriefunctie", "Fabrik", "1310", "31001_2112", "441"})
    EXPECT_EQ(words({{"usage", works}}), "industry") << works;
  for (const char* shed : {"Garage", "1630", "31001_2463", "Scheune", "451", "Annexe"})
    EXPECT_EQ(words({{"usage", shed}}), "shed") << shed;
  for (const char* church : {"Kirche", "Église", "2220", "31001_3041"})
    EXPECT_EQ(words({{"function", church}}), "church") << church;
  EXPECT_EQ(words({{"class", "1080"}}), "church") << "of the list of classes";
  EXPECT_EQ(words({{"function", "1080"}}), "shop") << "of the list of functions";
  EXPECT_EQ(words({{"GKLAS", "1220"}}), "office");
  EXPECT_EQ(words({{"usage1", "Indifférencié"}, {"usage2", "Religieux"}}), "church");
  EXPECT_EQ(words({{"function", "http://example/codelists/function.xml#1120"}}), "office");
  for (const char* none : {"", "BB01", "overige gebruiksfunctie", "31001_9998", "99999999999999", "1"})
    EXPECT_EQ(words({{"function", none}}), "") << none;
}

TEST(BuildingAttributes, StoreysAreCounted) {
  EXPECT_EQ(words({{"storeysAboveGround", "4"}}), "4-storeys");
  EXPECT_EQ(words({{"b3_bouwlagen", "3"}, {"oorspronkelijkbouwjaar", "1960"}}), "1946-1974 3-storeys");
  for (const char* none : {"0", "-2", "9999", "many", "999999999999"})
    EXPECT_EQ(words({{"storeysAboveGround", none}}), "") << none;
}

TEST(BuildingAttributes, TagsOfOpenStreetMap) {
  EXPECT_EQ(osm_words({{"building", "yes"}}), "");
  EXPECT_EQ(osm_words({{"building", "apartments"}, {"building:levels", "4"}}), "4-storeys")
      << "with shops at the street or without";
  EXPECT_EQ(osm_words({{"building", "semidetached_house"}, {"start_date", "1890s"}}), "dwelling 1870-1918");
  EXPECT_EQ(osm_words({{"building", "yes"}, {"shop", "bakery"}}), "shop");
  EXPECT_EQ(osm_words({{"building", "yes"}, {"amenity", "place_of_worship"}, {"start_date", "C13"}}),
            "church before-1870");
  EXPECT_EQ(osm_words({{"building", "warehouse"}}), "industry");
  EXPECT_EQ(osm_words({{"building", "garages"}}), "shed");
  EXPECT_EQ(osm_words({{"building", "commercial"}}), "office");
  EXPECT_EQ(
      osm_words({{"building", "house"}, {"building:material", "brick"}, {"building:colour", "#b04030"}}),
      "dwelling brick red");
  EXPECT_EQ(osm_words({{"building", "yes"}, {"building:material", "timber_framing"}}), "wood");
  EXPECT_EQ(osm_words({{"building", "yes"}, {"building:colour", "LightGrey"}}), "grey");
  for (const auto& [colour, word] : std::map<std::string, std::string>{{"#fff", "white"},
                                                                       {"#808080", "grey"},
                                                                       {"#101010", "dark"},
                                                                       {"#f0e0a0", "yellow"},
                                                                       {"#6b4226", "brown"},
                                                                       {"#99aacc", "blue"},
                                                                       {"#12345", ""},
                                                                       {"#ggg", ""},
                                                                       {"#", ""}})
    EXPECT_EQ(osm_words({{"building", "yes"}, {"building:colour", colour}}), word) << colour;
}

TEST(BuildingAttributes, FinishAndColourAreThoseOfTheFacadeWhereTheBuildingHasNone) {
  EXPECT_EQ(osm_words({{"building", "yes"}, {"building:cladding", "metal"}, {"building:color", "red"}}),
            "metal red");
  EXPECT_EQ(osm_words({{"building", "yes"},
                       {"building:material", "brick"},
                       {"building:facade:material", "plaster"},
                       {"building:facade:colour", "white"}}),
            "brick white");
}

TEST(BuildingAttributes, ColoursAreReadByNameAndNumber) {
  const auto is_near = [](const std::string& text, glm::vec3 expected) {
    const std::optional<glm::vec3> colour = colour_in(text);
    return colour && glm::distance(*colour, expected) < 1e-3f;
  };
  EXPECT_TRUE(is_near("#336699", {0.2f, 0.4f, 0.6f}));
  EXPECT_TRUE(is_near("#36f", {0.2f, 0.4f, 1.0f}));
  EXPECT_TRUE(is_near("White", glm::vec3(1.0f)));
  const std::optional<glm::vec3> green = colour_in("green"), light = colour_in("light_green"),
                                 dark = colour_in("dark green");
  ASSERT_TRUE(green && light && dark);
  EXPECT_GT(light->y, green->y);
  EXPECT_LT(dark->y, green->y);
  for (const char* text : {"", "#", "#12345", "#ggg", "tartan"}) EXPECT_FALSE(colour_in(text)) << text;
}

TEST(BuildingAttributes, AnyBytesAreUnderstoodOrUnknown) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int k = random.index(12); k > 0; --k)
      text += random.chance(0.5f) ? "0123456789C#_ 31001"[random.index(19)] : char(random.index(256));
    for (const char* name : {"yearOfConstruction", "function", "class", "GKLAS", "storeysAboveGround"}) {
      const BuildingKind kind = kind_of_building({{name, text}, {text, "1911"}});
      EXPECT_EQ(kind_of_words(words_of(kind)), kind) << text;
    }
    const BuildingKind kind = kind_of_osm_building(
        {{"building", text}, {"start_date", text}, {"building:colour", text}, {"building:levels", text}});
    EXPECT_EQ(kind_of_words(words_of(kind)), kind) << text;
  }
}

}  // namespace
}  // namespace parvis::scene
