// What is kept of bounced light beside a scene: read as it was traced, and traced again where that cannot be
// used.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

#include "base/registries.h"
#include "base/sealed_file.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "graphics/bounced_light/bounced_over.h"
#include "graphics/bounced_light/test_street.h"
#include "graphics/bounced_light/transfer_cache.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/bake_steps.h"
#include "graphics/render/frame_views.h"
#include "room_list.h"

namespace parvis::bounced_light {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A street whose script lies in a folder.
template <class Base>
class StreetInAFolder : public Base {
 protected:
  StreetInAFolder() : scene_(street()) {
    scene_.file = folder_.path() / "street.xp";
    scene_.data<scene::BouncedSettings>() = {true, 6.0f, 32};
  }
  std::vector<glm::vec4> lobes(const Transfer& transfer) const {
    return transfer.light(scene_.sun, sky_of(scene_)).lobes;
  }
  /// Changes what is kept of the scene.
  void change_file(const std::function<std::string(std::string)>& change) const {
    const fs::path file = TransferCache(scene_).file();
    const std::string changed = change(content_of(file));
    std::ofstream(file, std::ios::binary).write(changed.data(), std::streamsize(changed.size()));
  }

  TestFolder folder_;
  scene::Scene scene_;
};

/// Ways in which a file is none of this scene's, and a word of what is said of it.
struct Damage {
  const char* word;
  std::function<std::string(std::string)> change;
};
std::vector<Damage> damages() {
  const auto begun_by = [](std::string magic) {
    return [magic = std::move(magic)](const std::string& file) { return magic + file.substr(magic.size()); };
  };
  const auto with_another_bit = [](std::string file) {
    file[file.size() / 2] = char(file[file.size() / 2] ^ 1);
    return file;
  };
  const auto with_a_point_nowhere = [](const std::string& file) {  // as its checksum says, too
    const SealedKind kind{std::string_view(file).substr(0, 8), ""};
    Result<std::string> content = opened_sealed("", file, kind);
    if (!content) return to_string(content.errors());
    content->resize(content->size() - sizeof(float));
    append_value(*content, 1e30f);
    return sealed_bytes(kind, *content);
  };
  return {{"numbers that are no bounced light", with_a_point_nowhere},
          {"is cut short", [](const std::string& file) { return file.substr(0, file.size() / 2); }},
          {"damaged", with_another_bit},
          {"is no file of bounced light", begun_by("PARVISM1")},
          {"of another version", begun_by("PARVISB0")},
          {"is no file of bounced light", [](const std::string&) { return std::string(); }}};
}

class KeptTransfer : public StreetInAFolder<testing::Test> {};
class DrawnTransfer : public StreetInAFolder<gl::ContextTest> {};

TEST_F(KeptTransfer, IsReadAsItWasTracedAtEveryHour) {
  EXPECT_FALSE(TransferCache(scene_).read());
  const Transfer traced = trace_transfer(scene_);
  ASSERT_TRUE(TransferCache(scene_).keep(traced));
  scene_.sun.irradiance *= 0.5f, scene_.sky.intensity *= 3.0f;
  const std::optional<Transfer> kept = TransferCache(scene_).read();
  ASSERT_TRUE(kept);
  EXPECT_EQ(lobes(*kept), lobes(traced));
  EXPECT_EQ(kept->to_bytes(), traced.to_bytes());
}

TEST_F(KeptTransfer, OfAPlaceTooLargeForItsSpacingIsRead) {
  // Cells of 0.5 m would be twenty million here: they grow, and with them the grid about the place.
  scene_.objects.front().model = scene::model_of(scene::ground(600), scene::matt(glm::vec3(0.4f)));
  scene_.data<scene::BouncedSettings>() = {true, 0.5f, 16};
  const Transfer traced = trace_transfer(scene_);
  const std::optional<Transfer> read = Transfer::from_bytes(traced.to_bytes());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->to_bytes(), traced.to_bytes());
}

TEST_F(KeptTransfer, OfAnotherSceneOrDamagedIsNotUsed) {
  ASSERT_TRUE(TransferCache(scene_).keep(trace_transfer(scene_)));
  const fs::path file = TransferCache(scene_).file();
  scene_.objects[1].world_from_model[3].x += 1.0f;
  EXPECT_FALSE(TransferCache(scene_).read());
  fs::copy(file, TransferCache(scene_).file());
  EXPECT_FALSE(TransferCache(scene_).read()) << "the content is of another scene than the name";
  fs::resize_file(TransferCache(scene_).file(), 100);
  testing::internal::CaptureStderr();
  EXPECT_FALSE(TransferCache(scene_).read());
  EXPECT_NE(testing::internal::GetCapturedStderr().find("traced again"), std::string::npos);
}

TEST_F(KeptTransfer, IsTracedAgainWhereItCannotBeUsed) {
  Registries registries;
  register_room(registries);
  const render::BakeStep& step = registries.get<render::BakeSteps>().all().front();
  const auto bake = [&] {
    render::BakeInput input(scene_, registries.get<render::Drawables>(),
                            registries.get<render::Lights>().make);
    const Result<render::Baked> baked = step.run(input);
    EXPECT_TRUE(baked) << to_string(baked.errors());
    return baked ? baked->kept : std::set<fs::path>();
  };
  const fs::path file = TransferCache(scene_).file();
  EXPECT_EQ(bake(), std::set{file});
  const std::string whole = content_of(file);
  const Transfer traced = trace_transfer(scene_);
  for (const Damage& damage : damages()) {
    change_file(damage.change);
    ASSERT_NE(content_of(file), whole);
    testing::internal::CaptureStderr();
    EXPECT_EQ(bake(), std::set{file});
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("bounced light is traced again"), std::string::npos) << said;
    EXPECT_NE(said.find(damage.word), std::string::npos) << said;
    EXPECT_EQ(content_of(file), whole);
    const std::optional<Transfer> kept = TransferCache(scene_).read();
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->to_bytes(), traced.to_bytes());
  }
}

/// A picture does not depend on whether what it needs was kept, or on what has become of the file.
TEST_F(DrawnTransfer, IsTheSameKeptDamagedOrTracedForThePicture) {
  const auto drawn = [&] {
    const auto renderer = render::Renderer::create(scene_, {}, with_bounced_light(light::sun_and_sky));
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    EXPECT_TRUE(render::draw_frame(**renderer, scene_, {Camera{}, 16, 16}));
    return (*renderer)->drawn_light().bounced->lobes;
  };
  const std::vector<glm::vec4> traced = drawn();
  ASSERT_FALSE(traced.empty());
  EXPECT_FALSE(fs::exists(TransferCache(scene_).file())) << "a picture keeps nothing";
  const Transfer right = trace_transfer(scene_);
  ASSERT_TRUE(TransferCache(scene_).keep(right));
  EXPECT_EQ(drawn(), traced);
  for (const Damage& damage : damages()) {
    ASSERT_TRUE(TransferCache(scene_).keep(right));
    change_file(damage.change);
    testing::internal::CaptureStderr();
    EXPECT_EQ(drawn(), traced);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("traced again"), std::string::npos);
  }
  // The control: what is kept is used where it can be.
  scene::Scene dark = scene_;
  for (scene::Object& object : dark.objects) {
    auto black = std::make_shared<scene::Model>(*object.model);
    black->materials[0].base_colour = glm::vec3(0.0f);
    object.model = std::move(black);
  }
  ASSERT_TRUE(TransferCache(scene_).keep(trace_transfer(dark)));
  EXPECT_NE(drawn(), traced);
}

TEST_F(KeptTransfer, BytesWhoseIndicesLieAreNone) {
  const std::string right = trace_transfer(scene_).to_bytes();
  ASSERT_TRUE(Transfer::from_bytes(right));
  constexpr std::size_t lists = sizeof(shading::BouncedGrid) + sizeof(glm::ivec3) + sizeof(int);
  for (const std::size_t at : {sizeof(shading::BouncedGrid), lists - sizeof(int), lists + 4}) {
    std::string wrong = right;
    wrong[at + 2] = '\x7f';  // 8 million cells along, rays, or the number of a place
    EXPECT_FALSE(Transfer::from_bytes(wrong)) << at;
  }
  EXPECT_FALSE(Transfer::from_bytes(right.substr(0, right.size() - 1)));
  EXPECT_FALSE(Transfer::from_bytes(right + "x"));
  EXPECT_FALSE(Transfer::from_bytes(""));
}

/// Light by such numbers would be none, fill the memory or stand in cells that there are not.
TEST_F(KeptTransfer, BytesOfNoPlaceAreNone) {
  const Transfer traced = trace_transfer(scene_);
  const std::string right = traced.to_bytes();
  const auto with = [&](std::string bytes, std::size_t at, const auto& value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return bytes;
  };
  constexpr std::size_t lift = 6 * sizeof(float), rays = sizeof(shading::BouncedGrid) + sizeof(glm::ivec3),
                        places = rays + sizeof(int) + sizeof(std::uint32_t);
  std::uint32_t first = 0;
  std::memcpy(&first, right.data() + places, sizeof first);
  constexpr std::size_t point_bytes = sizeof(glm::vec3),
                        patch_bytes = 3 * point_bytes + sizeof(Patch::sees_sky);
  const std::size_t count = traced.patches().size(),
                    points = right.size() - lit_points_per_patch * count * point_bytes,
                    patches = points - sizeof(std::uint32_t) - count * patch_bytes;
  EXPECT_EQ(with(right, places, first), right);
  EXPECT_EQ(with(right, patches, traced.patches().front().position), right);
  EXPECT_FALSE(Transfer::from_bytes(with(right, places + sizeof first, first))) << "one place twice";
  EXPECT_FALSE(Transfer::from_bytes(with(right, lift, 1e30f)));
  EXPECT_FALSE(Transfer::from_bytes(with(right, lift, -1.0f)));
  EXPECT_FALSE(Transfer::from_bytes(with(right, patches, glm::vec3(1e30f)))) << "a patch that is nowhere";
  EXPECT_FALSE(Transfer::from_bytes(with(right, patches + point_bytes, glm::vec3(3.0f)))) << "its normal";
  EXPECT_FALSE(Transfer::from_bytes(with(right, points, glm::vec3(1e30f))))
      << "a point in the light of lamps";
  const std::string nothing = Transfer().to_bytes();
  EXPECT_TRUE(Transfer::from_bytes(nothing));
  EXPECT_FALSE(Transfer::from_bytes(with(nothing, rays, 1 << 30)));
}

/// Seeds that are refused reach nothing of what fuzzers look for.
TEST(TransferSeeds, AreTransfers) {
  int count = 0;
  for (const auto& seed :
       fs::directory_iterator(source_folder() / "src/graphics/bounced_light/fuzz/corpus/transfer")) {
    EXPECT_TRUE(Transfer::from_bytes(content_of(seed.path()))) << seed.path() << ": run script/fuzz_seeds";
    ++count;
  }
  EXPECT_GE(count, 3);
}

}  // namespace
}  // namespace parvis::bounced_light
