#include "scene/script/script_reader.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/random.h"
#include "base/test_data.h"
#include "scene/script/script_tokens.h"
#include "scene/script/thesis_examples.h"

namespace parvis::scene {
namespace {

std::vector<ScriptNode> parsed(std::string_view text) {
  const auto nodes = parse_script(text, "test.xp");
  EXPECT_TRUE(nodes) << (nodes ? "" : to_string(nodes.errors()));
  return nodes ? *nodes : std::vector<ScriptNode>();
}

Errors errors_of(std::string_view text) {
  const auto nodes = parse_script(text, "test.xp");
  EXPECT_FALSE(nodes);
  return nodes ? Errors{} : nodes.errors();
}

std::string repeated(std::string_view piece, std::size_t bytes) {
  std::string text;
  while (text.size() < bytes) text += piece;
  return text;
}

TEST(ScriptReader, ReadsTheExamplesOfTheThesis) {
  const auto nodes = parsed(thesis_examples);
  ASSERT_EQ(nodes.size(), 5u);
  EXPECT_EQ(nodes[0].type, "vdobject");
  std::string names;
  for (const ScriptAttribute& attribute : nodes[0].attributes) names += attribute.name + " ";
  EXPECT_EQ(names, "cleanModels file camera file cameraFile file cameraName ");
  EXPECT_EQ(nodes[0].attributes[2].value, "10 0 1 10 10 5.5 30 1");
  EXPECT_EQ(nodes[1].attributes.size(), 6u);
  EXPECT_EQ(nodes[1].attributes[0].value, "43.70");
  ASSERT_EQ(nodes[3].children.size(), 2u);
  EXPECT_EQ(nodes[3].children[1].attributes[0].value, "duck2.pfb");
  EXPECT_EQ(nodes[4].type, "%xpShadowMap");
}

TEST(ScriptReader, KnowsThePlaceOfEveryNodeAttributeAndValue) {
  const auto nodes =
      parsed("\xEF\xBB\xBF# comment\r\ngroup() { // more\r\n  model(a=1,\r\n    file = \"x\") }");
  const ScriptNode& model = nodes.at(0).children.at(0);
  EXPECT_EQ(model.place.line, 3);
  EXPECT_EQ(model.place.column, 3);
  EXPECT_EQ(model.attributes.at(1).name_place.line, 4);
  EXPECT_EQ(model.attributes.at(1).name_place.column, 5);
  EXPECT_EQ(model.attributes.at(1).value_place.column, 12);
}

TEST(ScriptReader, JoinsStringsAndResolvesEscapes) {
  const auto nodes = parsed("a(b=\"one \\\"two\\\" \\\\ \" // points go on\n \"three\\n\", c=4,)");
  EXPECT_EQ(nodes.at(0).attributes.at(0).value, "one \"two\" \\ three\n");
  EXPECT_EQ(nodes.at(0).attributes.at(1).value, "4");
}

TEST(ScriptReader, ReportsSeveralErrorsWithTheirPlaces) {
  const Errors errors =
      errors_of("group(name=) {\n  model(file \"a\")\n  camera(name=\"b\" x=1)\n}\nsun(a=1)\nlamp\n");
  ASSERT_EQ(errors.size(), 4u) << to_string(errors);
  EXPECT_EQ(to_string(errors[0]).substr(0, 13), "test.xp:1:12:");
  EXPECT_EQ(to_string(errors[1]).substr(0, 13), "test.xp:2:14:");
  EXPECT_EQ(to_string(errors[2]).substr(0, 13), "test.xp:3:19:");
  EXPECT_EQ(to_string(errors[3]).substr(0, 12), "test.xp:6:1:");
}

TEST(ScriptReader, AMissingBracketDoesNotHideTheNextNode) {
  const Errors errors = errors_of("model(file=\"a\"\ncamera(name=\"b\")\nsun(=)\n");
  ASSERT_EQ(errors.size(), 2u) << to_string(errors);
  EXPECT_EQ(errors[0].where.line, 2);
  EXPECT_EQ(errors[1].where.line, 3);
}

TEST(ScriptReader, NamesTheBracketThatIsNeverClosed) {
  const Errors errors = errors_of("group() {\n  sun()\n");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].where.line, 1);
  EXPECT_EQ(errors[0].where.column, 9);
  EXPECT_EQ(errors_of("sun(a=1").at(0).where.column, 1);
  EXPECT_EQ(errors_of("sun() }").at(0).where.column, 7);
}

TEST(ScriptReader, ATextEndsOnItsLine) {
  const Errors errors = errors_of("a(b=\"open)\nc(d=\"\\q\")");
  ASSERT_GE(errors.size(), 2u);
  EXPECT_EQ(errors[0].where.line, 1);
  EXPECT_EQ(errors[0].where.column, 5);
}

TEST(ScriptReader, TenMegabytesOfBracketsGiveOneError) {
  const std::size_t bytes = 10u << 20;
  for (const char* piece : {"(", ")", "{", "}", "{}", "()", "a(", "a(){", "a(){\n", "a(x=", "=", ",", "]",
                            "<", "[\n", "a{", "a ", "a(x=1,"}) {
    const Errors errors = errors_of(repeated(piece, bytes));
    EXPECT_EQ(errors.size(), 1u) << piece << "\n" << to_string(errors);
    EXPECT_GE(errors.at(0).where.line, 1);
    EXPECT_LT(errors.at(0).message.size(), 300u);
  }
}

TEST(ScriptReader, TenMegabytesOfQuotesNodesOrErrorsEndSoon) {
  const std::size_t bytes = 10u << 20;
  for (const char* piece : {"\"\n", "\"", "a()", "a(b=\"\\x\")\n", "a(\n", "}a()\n", "a({", "a(x)\n"}) {
    const Errors errors = errors_of(repeated(piece, bytes));
    EXPECT_LE(errors.size(), max_script_errors + 1) << piece;
  }
  EXPECT_TRUE(parsed(repeated("#", bytes)).empty());
  EXPECT_TRUE(parsed(repeated("//{\n", bytes)).empty());
  EXPECT_TRUE(parsed(repeated(" ", bytes)).empty());
}

TEST(ScriptReader, RefusesBytesThatAreNoText) {
  const Errors errors = errors_of(std::string_view("a()\nb(\0)", 8));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].where.line, 2);
  const Errors with_escape = errors_of("\x1b[31m");
  for (const char c : with_escape.at(0).message) EXPECT_GE(static_cast<unsigned char>(c), 32);
}

TEST(ScriptReader, RandomEditsNeverCrash) {
  const std::string valid =
      "include(file=\"a.xp\")\ngroup(name=\"g\", position=\"1 2 3\") { // c\n  model(file=\"b.glb\", "
      "scale=2) {\n"
      "    material(colour=\"#AABBCC\")\n  }\n} # end\n";
  const std::string bytes = "(){}=,\"\\#/ \n\0a1\xff";
  Random random(7);
  for (int round = 0; round < 20'000; ++round) {
    std::string text = valid;
    for (int edit = random.index(6); edit >= 0; --edit) {
      const std::size_t at = std::size_t(random.index(int(text.size())));
      const char byte = bytes[std::size_t(random.index(int(bytes.size())))];
      if (random.chance(0.4f))
        text[at] = byte;
      else if (random.chance(0.5f))
        text.insert(at, 1, byte);
      else
        text.erase(at, std::size_t(1 + random.index(8)));
    }
    const auto nodes = parse_script(text, "fuzz.xp");
    EXPECT_TRUE(!nodes || nodes->size() <= text.size());
  }
}

/// script/fuzz_seeds has written them, one for each node.
TEST(ScriptReader, TheFuzzersSeedsAreScripts) {
  int seeds = 0;
  for (const auto& seed :
       std::filesystem::directory_iterator(source_folder() / "src/scene/script/fuzz/corpus/script")) {
    const auto nodes = parse_script(*read_file(seed.path()), seed.path().filename().string());
    ASSERT_TRUE(nodes) << to_string(nodes.errors());
    EXPECT_FALSE(nodes->empty());
    ++seeds;
  }
  EXPECT_GE(seeds, 40);
}

}  // namespace
}  // namespace parvis::scene
