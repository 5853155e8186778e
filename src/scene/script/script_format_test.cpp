#include "scene/script/script_format.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/files.h"
#include "base/random.h"
#include "base/test_data.h"
#include "scene/script/script_reader.h"
#include "scene/script/thesis_examples.h"

namespace parvis::scene {
namespace {

std::string formatted(const std::string& text) {
  const auto root = parse_script_file(text, "test.xp");
  EXPECT_TRUE(root) << text << (root ? "" : to_string(root.errors()));
  return root ? format_script(*root) : "";
}

/// Types, names and values, without layout.
std::string essence(const std::vector<ScriptNode>& nodes) {
  std::string text;
  for (const ScriptNode& node : nodes) {
    text += node.type + "(";
    for (const ScriptAttribute& attribute : node.attributes)
      text += fmt::format("{}={:?},", attribute.name, attribute.value);
    text += "){" + essence(node.children) + "}";
  }
  return text;
}

/// The comments of a script, sorted: formatting may move one to the next line, but loses none.
std::vector<std::string> comments_of(const ScriptNode& node) {
  std::vector<std::string> all;
  const auto add = [&](const std::vector<std::string>& some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  add(node.comments_before), add(node.comments_behind), add(node.comments_in_list), add(node.comments_at_end);
  add(node.comments_behind_end);
  for (const ScriptAttribute& attribute : node.attributes)
    add(attribute.comments_before), add(attribute.comments_behind);
  for (const ScriptNode& child : node.children) add(comments_of(child));
  std::erase(all, "");  // blank lines
  std::sort(all.begin(), all.end());
  return all;
}

void expect_kept(const std::string& text) {
  const auto before = parse_script_file(text, "before.xp");
  if (!before) return;
  const std::string once = format_script(*before);
  const auto after = parse_script_file(once, "after.xp");
  ASSERT_TRUE(after) << text << "\nbecame\n" << once << to_string(after.errors());
  EXPECT_EQ(essence(after->children), essence(before->children)) << text << "\nbecame\n" << once;
  EXPECT_EQ(comments_of(*after), comments_of(*before)) << text << "\nbecame\n" << once;
  EXPECT_EQ(format_script(*after), once) << text;
}

TEST(ScriptFormat, WritesOneStyle) {
  EXPECT_EQ(formatted("a( b = 1,c=\"two\" ,)  {d()e(f=g){}}"),
            "a(b=1, c=\"two\") {\n"
            "  d()\n"
            "  e(f=g)\n"
            "}\n");
}

TEST(ScriptFormat, KeepsCommentsWhereTheyStood) {
  const std::string text =
      "// the head\n"
      "# of the file\n"
      "\n"
      "group(name=\"trees\") {  // all of them\n"
      "  // an oak\n"
      "  model(file=\"oak.glb\")  // tall\n"
      "\n"
      "  model(\n"
      "      // a small one\n"
      "      file=\"orange.glb\",  // why\n"
      "      scale=0.5)\n"
      "  // the last\n"
      "}  // end\n"
      "\n"
      "// nothing more\n";
  expect_kept(text);
  const std::string once = formatted(text);
  for (const char* line :
       {"// the head\n# of the file\n\ngroup(name=\"trees\") {  // all of them\n  // an oak\n",
        "oak.glb\")  // tall\n\n  model(", "file=\"orange.glb\",  // why\n", "\n  // the last\n}  // end\n",
        "\n\n// nothing more\n"})
    EXPECT_NE(once.find(line), std::string::npos) << line << "\nin\n" << once;
}

TEST(ScriptFormat, EmptyBlocksAndBlankLinesGo) {
  EXPECT_EQ(formatted("\n\na() {\n\n\n}\n\n\n\nb() {\n\n  c()\n\n}\n\n"), "a()\n\nb() {\n  c()\n}\n");
}

TEST(ScriptFormat, BreaksLongLinesBetweenAttributesAndKeepsJoinedTexts) {
  std::string text = "model(file=\"a.glb\"";
  for (int i = 0; i < 12; ++i) text += ", positions=\"" + std::to_string(i) + " 200 300\"";
  text += ")\nroad(path=\"0 0, \" \"1 1\")";
  const std::string once = formatted(text);
  expect_kept(text);
  EXPECT_NE(once.find("road(path=\n    \"0 0, \"\n    \"1 1\")\n"), std::string::npos) << once;
  for (std::size_t start = 0, end; (end = once.find('\n', start)) != std::string::npos; start = end + 1)
    EXPECT_LE(end - start, longest_line + 10) << once;
}

TEST(ScriptFormat, RandomScriptsKeepTheirMeaningAndCommentsAndFormattingIsDoneOnce) {
  const std::string valid =
      "include(file=\"a.xp\") // i\n\n\n# g\ngroup(name=\"g\" // n\n, position=\"1 2 3\" \"4\") { // c\n  "
      "model(file=\"b.glb\",\n"
      " // s\n scale=2) {\n    material(colour=\"#AABBCC\")//m\n  } // e\n # l\n} # end\n// last";
  const std::string bytes = "(){}=,\"\\#/ \n\n\na1";
  Random random(11);
  expect_kept(valid);
  for (int round = 0; round < 20'000; ++round) {
    std::string text = valid;
    for (int edit = random.index(5); edit >= 0; --edit) {
      const std::size_t at = std::size_t(random.index(int(text.size())));
      const char byte = bytes[std::size_t(random.index(int(bytes.size())))];
      if (random.chance(0.3f))
        text[at] = byte;
      else if (random.chance(0.7f))
        text.insert(at, 1, byte);
      else
        text.erase(at, 1);
    }
    expect_kept(text);
    if (HasFailure()) return;
  }
}

TEST(ScriptFormat, TheScenesOfTheHouseKeepTheirMeaningAndStandInItsStyle) {
  const std::filesystem::path scenes = source_folder() / "scenes";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes))
    if (entry.path().extension() == ".xp") {
      expect_kept(*read_file(entry.path()));
      EXPECT_EQ(formatted(*read_file(entry.path())), *read_file(entry.path())) << entry.path();
    }
}

TEST(ScriptFormat, TheExamplesOfTheThesisKeepTheirMeaning) { expect_kept(thesis_examples); }

}  // namespace
}  // namespace parvis::scene
