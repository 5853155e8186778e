#include "formats/readers/readers.h"

#include <gtest/gtest.h>

namespace parvis::formats {
namespace {

/// A reader whose models are called `name`.
ReadModel reader(const char* name) {
  return [name](const std::filesystem::path&, const ModelReading& reading, Errors&) -> Result<scene::Model> {
    scene::Model model;
    model.name = name;
    if (reading.cell_m) model.name += " in cells";
    return model;
  };
}

std::string read_by(const Readers& readers, const char* file, const ModelReading& reading = {}) {
  Errors warnings;
  const Result<scene::Model> model = readers.read(file, reading, warnings);
  return model ? model->name : to_string(model.errors());
}

TEST(Readers, AreFoundByExtension) {
  Readers readers;
  readers.add({".abc", ".abd"}, reader("letters"));
  readers.add({".123"}, reader("digits"));
  EXPECT_EQ(read_by(readers, "a/b.abd"), "letters");
  EXPECT_EQ(read_by(readers, "b.123", {.cell_m = 1.0}), "digits in cells");
  const std::string unknown = read_by(readers, "c.xyz");
  for (const char* expected : {"c.xyz", "\".xyz\"", ".123, .abc, .abd"})
    EXPECT_NE(unknown.find(expected), std::string::npos) << unknown;
  readers.set_fallback(reader("anything"));
  EXPECT_EQ(read_by(readers, "c.xyz"), "anything");
}

}  // namespace
}  // namespace parvis::formats
