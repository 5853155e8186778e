#include "capture/facades/psd.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <span>

#include "base/files.h"
#include "base/memory_budget.h"
#include "base/random.h"
#include "base/test_folder.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/layered_picture.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

/// Noise, flat areas and short runs: every branch of the run-length coder.
Image8 noisy(int width, int height, int channels, std::uint64_t seed) {
  Random random(seed);
  Image8 image(width, height, channels);
  std::uint8_t value = 0;
  for (std::uint8_t& pixel : image.pixels) {
    if (random.uniform() < 0.4f) value = std::uint8_t(random.uniform(0, 256));
    pixel = value;
  }
  return image;
}

PsdPicture some_picture() {
  PsdPicture picture;
  picture.width = 70, picture.height = 50;
  picture.flat = noisy(70, 50, 3, 1);
  picture.layers.push_back({"photograph", {0, 0, 70, 50}, noisy(70, 50, 4, 2), {}, false, false, 255});
  picture.layers.push_back(
      {"façade – north", {10, 5, 33, 17}, noisy(33, 17, 4, 3), noisy(33, 17, 1, 4), false, false, 128});
  picture.layers.push_back({"depth", {0, 0, 1, 1}, noisy(1, 1, 4, 5), {}, false, true, 255});
  return picture;
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(Psd, ComesBackAsItWasWritten) {
  const TestFolder folder;
  const PsdPicture picture = some_picture();
  ASSERT_TRUE(write_psd(folder.path() / "a.psd", picture));
  const Result<PsdPicture> read = read_psd(folder.path() / "a.psd");
  ASSERT_TRUE(read) << to_string(read.errors());
  ASSERT_EQ(read->layers.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const PsdLayer &a = picture.layers[i], &b = read->layers[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.box, b.box);
    EXPECT_EQ(a.pixels.pixels, b.pixels.pixels) << i;
    EXPECT_EQ(a.mask.pixels, b.mask.pixels) << i;
    EXPECT_EQ(a.is_hidden, b.is_hidden);
    EXPECT_EQ(a.opacity, b.opacity);
    EXPECT_FALSE(b.is_mask_enabled);
  }
}

TEST(Psd, ATruncatedFileIsAnErrorAtEveryLength) {
  const TestFolder folder;
  ASSERT_TRUE(write_psd(folder.path() / "a.psd", some_picture()));
  const std::string whole = *read_file(folder.path() / "a.psd");
  const auto byte = [&](std::size_t i) { return std::size_t(static_cast<unsigned char>(whole[i])); };
  const std::size_t layers_end = 38 + (byte(34) << 24 | byte(35) << 16 | byte(36) << 8 | byte(37));
  ASSERT_LT(layers_end, whole.size());
  for (std::size_t size = 0; size < layers_end; size += 7) {
    const Result<PsdPicture> read = read_psd(bytes_of(whole).first(size), "a.psd");
    ASSERT_FALSE(read) << size;
    EXPECT_NE(to_string(read.errors()).find("a.psd"), std::string::npos);
  }
}

TEST(Psd, LayersAreChargedToTheBudgetBeforeTheyAreAllocated) {
  const TestFolder folder;
  PsdPicture picture;
  picture.width = picture.height = 4000;
  picture.flat = Image8(4000, 4000, 3);
  picture.layers.push_back({"wall", {0, 0, 4000, 4000}, Image8(4000, 4000, 4, 9), {}, false, false, 255});
  const auto file = folder.path() / "a.psd";
  ASSERT_TRUE(write_psd(file, picture));
  ASSERT_LT(std::filesystem::file_size(file), 1 << 21) << "it is the layer that needs memory, not the file";
  const std::uint64_t budget = max_memory();
  set_max_memory(memory_in_use() + (1 << 24));
  const Result<PsdPicture> refused = read_psd(file);
  set_max_memory(budget);
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.errors()).find("layer \"wall\" of 4000 x 4000 pixels needs 0.1 GB"),
            std::string::npos)
      << to_string(refused.errors());
  EXPECT_TRUE(read_psd(file)) << "with the whole budget";
}

TEST(Psd, OtherFormatsAreNamed) {
  const auto message = [](std::string text) {
    const Result<PsdPicture> read = read_psd(bytes_of(text), "b.psd");
    return read ? std::string() : to_string(read.errors());
  };
  EXPECT_NE(message("GIF89a").find("not a PSD file"), std::string::npos);
  std::string header =
      std::string("8BPS\0\1\0\0\0\0\0\0\0\3\0\0\0\x10\0\0\0\x10\0\x08\0\3", 26) + std::string(12, '\0');
  EXPECT_NE(message(header).find("has no layers"), std::string::npos);
  header[25] = 4;
  EXPECT_NE(message(header).find("colour mode 4; expected RGB"), std::string::npos);
  header[5] = 2;
  EXPECT_NE(message(header).find("PSB"), std::string::npos);
  header[5] = 1, header[25] = 3, header[23] = 32;
  EXPECT_NE(message(header).find("32 bits per channel"), std::string::npos);
  header[23] = 8, header[14] = 1;
  EXPECT_NE(message(header).find("pixels; expected 1 to 30000"), std::string::npos);
}

void put(std::string& text, std::uint32_t value, int bytes) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text.push_back(char(value >> shift & 255));
}

/// A 16-bit file as Photoshop writes it: the layers in a block Lr16, zipped with prediction.
std::string photoshop_16_bit(const std::vector<std::uint16_t>& samples, int width, int height) {
  std::string differences;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = std::size_t(y * width + x);
      put(differences, std::uint16_t(samples[i] - (x ? samples[i - 1] : 0)), 2);
    }
  uLongf size = compressBound(differences.size());
  std::string zipped(size, '\0');
  compress(reinterpret_cast<Bytef*>(zipped.data()), &size, reinterpret_cast<const Bytef*>(differences.data()),
           differences.size());
  zipped.resize(size);
  std::string layer;
  put(layer, 1, 2);
  for (const int v : {0, 0, height, width}) put(layer, std::uint32_t(v), 4);
  put(layer, 3, 2);
  for (std::uint32_t c = 0; c < 3; ++c) put(layer, c, 2), put(layer, std::uint32_t(zipped.size() + 2), 4);
  layer += "8BIMnorm";
  put(layer, 0xff000000u, 4);
  put(layer, 12, 4), put(layer, 0, 4), put(layer, 0, 4), put(layer, 0x01410000u, 4);  // named "A"
  for (int c = 0; c < 3; ++c) put(layer, 3, 2), layer += zipped;
  while (layer.size() % 4) layer.push_back('\0');
  std::string info;
  put(info, 0, 4), put(info, 0, 4);
  info += "8BIMLr16";
  put(info, std::uint32_t(layer.size()), 4);
  info += layer;
  std::string file = "8BPS";
  put(file, 1, 2), put(file, 0, 4), put(file, 0, 2), put(file, 3, 2);
  put(file, std::uint32_t(height), 4), put(file, std::uint32_t(width), 4), put(file, 16, 2), put(file, 3, 2);
  put(file, 0, 4), put(file, 0, 4), put(file, std::uint32_t(info.size()), 4);
  return file + info;
}

TEST(Psd, SixteenBitsAreRoundedToEight) {
  std::vector<std::uint16_t> samples;
  for (int i = 0; i < 12 * 5; ++i) samples.push_back(std::uint16_t(i * 1097));
  const std::string file = photoshop_16_bit(samples, 12, 5);
  const Result<PsdPicture> read = read_psd(bytes_of(file), "c.psd");
  ASSERT_TRUE(read) << to_string(read.errors());
  ASSERT_EQ(read->layers.size(), 1u);
  EXPECT_EQ(read->file_bits, 16);
  EXPECT_EQ(read->layers[0].name, "A");
  for (std::size_t i = 0; i < samples.size(); ++i)
    EXPECT_EQ(read->layers[0].pixels.pixels[4 * i], (samples[i] + 128) / 257) << i;
}

/// A layer of 2 x 2 pixels, or an end of a group.
struct TestLayer {
  std::string name;
  std::uint32_t section = 0, opacity = 255;
  bool is_hidden = false;
  std::string blend = "norm";
  bool is_clipped = false, hides_all = false;
};

/// A file with groups as editors write them: bottom first, the end of a group below its layers, the group
/// itself above them.
std::string psd_of(const std::vector<TestLayer>& layers) {
  std::string info, data;
  put(info, std::uint32_t(layers.size()), 2);
  for (const TestLayer& layer : layers) {
    const std::uint32_t side = layer.section ? 0 : 2;
    for (const std::uint32_t v : {0u, 0u, side, side}) put(info, v, 4);
    put(info, 4, 2);
    for (const std::uint32_t id : {0xffffu, 0u, 1u, 2u}) {
      put(info, id, 2), put(info, 2 + side * side, 4);
      put(data, 0, 2), data += std::string(side * side, '\xff');
    }
    info += "8BIM" + layer.blend;
    put(info, layer.opacity, 1), put(info, layer.is_clipped, 1), put(info, layer.is_hidden ? 2u : 0u, 1);
    put(info, 0, 1);
    std::string extra;
    put(extra, layer.hides_all ? 20u : 0u, 4);
    if (layer.hides_all) extra += std::string(20, '\0');  // no area, black outside of it, enabled
    put(extra, 0, 4);
    put(extra, std::uint32_t(layer.name.size()), 1), extra += layer.name;
    while (extra.size() % 4) extra.push_back('\0');
    if (layer.section) extra += "8BIMlsct", put(extra, 4, 4), put(extra, layer.section, 4);
    put(info, std::uint32_t(extra.size()), 4);
    info += extra;
  }
  info += data;
  if (info.size() % 2) info.push_back('\0');
  std::string file = "8BPS";
  put(file, 1, 2), put(file, 0, 4), put(file, 0, 2), put(file, 3, 2);
  put(file, 2, 4), put(file, 2, 4), put(file, 8, 2), put(file, 3, 2);
  put(file, 0, 4), put(file, 0, 4), put(file, std::uint32_t(info.size() + 8), 4);
  put(file, std::uint32_t(info.size()), 4);
  file += info;
  put(file, 0, 4);
  return file;
}

TEST(Psd, LayersHaveWhatTheirGroupsDoToThem) {
  const Result<PsdPicture> read = read_psd(bytes_of(psd_of({{"base"},
                                                            {"</Layer group>", 3},
                                                            {"</Layer group>", 3},
                                                            {"deep", 0, 128},
                                                            {"inner", 1, 128, false, "pass"},
                                                            {"hidden", 0, 255, true},
                                                            {"outer", 2, 255, false, "mul "},
                                                            {"</Layer group>", 3},
                                                            {"unseen"},
                                                            {"dark", 1, 255, true, "pass"},
                                                            {"top", 0, 255, false, "scrn", true, true}})),
                                           "groups.psd");
  ASSERT_TRUE(read) << to_string(read.errors());
  const auto layer = [&](const std::string& name) {
    const auto found = std::ranges::find(read->layers, name, &PsdLayer::name);
    return found == read->layers.end() ? PsdLayer{} : *found;
  };
  ASSERT_EQ(read->layers.size(), 5u) << "groups are none";
  EXPECT_EQ(layer("base").blend, "norm");
  EXPECT_EQ(layer("base").opacity, 255);
  EXPECT_FALSE(layer("base").is_hidden);
  EXPECT_EQ(layer("deep").opacity, 64);
  EXPECT_EQ(layer("deep").blend, "mul ");
  EXPECT_FALSE(layer("deep").is_hidden);
  EXPECT_TRUE(layer("hidden").is_hidden);
  EXPECT_TRUE(layer("unseen").is_hidden) << "its group is";
  EXPECT_EQ(layer("top").blend, "scrn");
  EXPECT_TRUE(layer("top").is_clipped);
  EXPECT_TRUE(layer("top").is_mask_enabled);
  EXPECT_EQ(layer("top").mask.pixels, std::vector<std::uint8_t>(4, 0)) << "a mask that hides all";
}

struct WrittenPsd {
  LayeredView layered;
  LayerPixels pixels;
  PsdPicture picture;
};

/// A photograph of noise, three layers deep.
WrittenPsd written_layers() {
  LayerModel model = model_of(
      {wall("far", 8, -6, 6, -5, 5), wall("middle", 5, -2, 2, -2, 2), wall("near", 4, -1, 1, -1, 1)});
  const View view = test_view(128, 96);
  const VisibilityLayers visibility = visibility_layers(model, view, "test");
  WrittenPsd written{image_layers(model, view, visibility), {}, {}};
  const Image8 photograph = noisy(128, 96, 4, 9);
  written.pixels = original_pixels(photograph, written.layered);
  written.picture =
      layered_picture(photograph, written.layered, written.pixels, item_buffer(model, view).depths);
  return written;
}

Result<ReadLayers> read_back(const WrittenPsd& written, const PsdPicture& edited) {
  return read_layers(edited, written.layered, written.pixels, 128, 96, "0001.psd");
}

TEST(LayeredPicture, UntouchedLayersComeBackExactly) {
  const WrittenPsd written = written_layers();
  ASSERT_EQ(written.picture.layers.size(), 5u);
  const Result<ReadLayers> read = read_back(written, written.picture);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->messages.empty()) << to_string(read->messages);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(read->pixels[i].pixels, written.pixels[i].pixels);
}

TEST(LayeredPicture, OpacityAndMasksCountAndTheRestIsNamed) {
  const WrittenPsd written = written_layers();
  const auto edited = [&](const auto& edit) {
    PsdPicture picture = written.picture;
    edit(picture.layers[1]);  // the farthest: the last of the image layers
    const Result<ReadLayers> read = read_back(written, picture);
    EXPECT_TRUE(read);
    return *read;
  };
  const auto alpha = [](const ReadLayers& read) { return int(read.pixels[2].at(0, 0)[3]); };
  EXPECT_EQ(alpha(edited([](PsdLayer&) {})), 255);
  EXPECT_EQ(alpha(edited([](PsdLayer& layer) { layer.opacity = 128; })), 128);
  const ReadLayers ours = edited([](PsdLayer& layer) { layer.is_mask_enabled = true; });
  EXPECT_EQ(ours.pixels[2].pixels, written.pixels[2].pixels) << "the mask that was written hides nothing";
  const ReadLayers masked = edited([](PsdLayer& layer) {
    layer.is_mask_enabled = true;
    std::ranges::fill(layer.mask.pixels, std::uint8_t(0));
  });
  EXPECT_EQ(alpha(masked), 0);
  EXPECT_TRUE(masked.messages.empty()) << to_string(masked.messages);
  const ReadLayers hidden = edited([](PsdLayer& layer) {
    layer.is_hidden = true;
    std::ranges::fill(layer.pixels.pixels, std::uint8_t(7));
  });
  EXPECT_EQ(hidden.pixels[2].pixels, written.pixels[2].pixels);
  EXPECT_NE(to_string(hidden.messages).find("\"L02-000 far\" is hidden"), std::string::npos);
  const std::string named =
      to_string(edited([](PsdLayer& layer) { layer.blend = "mul ", layer.is_clipped = true; }).messages);
  EXPECT_NE(named.find("its blend mode \"mul \", its clipping to the layer below is left out"),
            std::string::npos)
      << named;
}

TEST(LayeredPicture, TheMaskIsWhiteWhereTheSurfaceIsSeen) {
  const WrittenPsd written = written_layers();
  const PsdLayer& far = written.picture.layers[1];  // above the photograph
  EXPECT_EQ(far.name, "L02-000 far");
  EXPECT_FALSE(far.is_mask_enabled);
  EXPECT_EQ(*far.mask.at(64 - far.box.x, 48 - far.box.y), 0);
  EXPECT_EQ(*far.mask.at(0, 0), 255);
  const PsdLayer& depth = written.picture.layers.back();
  EXPECT_TRUE(depth.is_hidden);
  EXPECT_EQ(depth.pixels.at(64, 48)[0], 255);
  EXPECT_EQ(depth.pixels.at(64, 10)[0], 0);
}

TEST(LayeredPicture, ReorderedLayersAreFoundByName) {
  const WrittenPsd written = written_layers();
  PsdPicture edited = written.picture;
  std::ranges::reverse(edited.layers);
  const Result<ReadLayers> read = read_back(written, edited);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->messages.empty());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(read->pixels[i].pixels, written.pixels[i].pixels);
}

TEST(LayeredPicture, WhatAnArtistDidToTheLayersIsSaid) {
  const WrittenPsd written = written_layers();
  const auto messages = [&](PsdPicture edited) {
    const Result<ReadLayers> read = read_back(written, edited);
    return read ? to_string(read->messages) : to_string(read.errors());
  };
  PsdPicture renamed = written.picture;
  renamed.layers[2].name = "my wall";
  EXPECT_EQ(messages(renamed),
            "0001.psd: layer \"my wall\" was renamed; by its rectangle it is \"L01-000 middle\"\n");

  PsdPicture deleted = written.picture;
  deleted.layers.erase(deleted.layers.begin() + 2);
  EXPECT_EQ(messages(deleted),
            "0001.psd: layer \"L01-000 middle\" is missing (deleted, or merged into another?); it stays as "
            "it was\n");

  PsdPicture merged = deleted;  // "near" merged down into "middle", with a size of its own
  merged.layers[2].name = "merged", merged.layers[2].box = {3, 3, 50, 50},
  merged.layers[2].pixels = Image8(50, 50, 4);
  EXPECT_NE(
      messages(merged).find("layer \"merged\" (50 x 50 at 3,3) is none of the layers that were written"),
      std::string::npos);
  EXPECT_NE(messages(merged).find("\"L00-000 near\" is missing"), std::string::npos);

  PsdPicture moved = written.picture;
  moved.layers[3].box.x += 4;
  EXPECT_NE(messages(moved).find(
                "\"L00-000 near\" was moved or resized: 32 x 32 at 52,32, expected 32 x 32 at 48,32"),
            std::string::npos);

  PsdPicture sixteen = written.picture;
  sixteen.file_bits = 16;
  EXPECT_NE(messages(sixteen).find("16 bits per channel"), std::string::npos);

  PsdPicture twice = written.picture;
  twice.layers.push_back(twice.layers[1]);
  EXPECT_NE(messages(twice).find("is there twice"), std::string::npos);

  PsdPicture resized = written.picture;
  resized.width = 64;
  EXPECT_NE(messages(resized).find("resized to 64 x 96; expected 128 x 96"), std::string::npos);
}

TEST(LayeredPicture, AlphaThatAnArtistPaintedIsKept) {
  const WrittenPsd written = written_layers();
  PsdPicture edited = written.picture;
  for (int y = 0; y < 20; ++y) edited.layers[3].pixels.at(5, y)[3] = 40;  // between the bars of a balcony
  const Result<ReadLayers> read = read_back(written, edited);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->pixels[0].at(5, 7)[3], 40);
  EXPECT_EQ(read->pixels[0].at(6, 7)[3], 255);
}

/// GIMP itself: opens what is written, clones and heals on one layer, saves; the others must be pixel-exact.
TEST(LayeredPicture, GimpEditsOneLayerAndLeavesTheOthers) {
  if (std::system("command -v gimp-console-2.10 > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "skipped: no gimp-console-2.10 here (package gimp)";
  const TestFolder folder;
  const WrittenPsd written = written_layers();
  ASSERT_TRUE(write_psd(folder.path() / "in.psd", written.picture));
  folder.write("edit.scm", R"((let* ((image (car (gimp-file-load RUN-NONINTERACTIVE "in.psd" "in.psd")))
       (far (car (gimp-image-get-layer-by-name image "L02-000 far")))
       (photograph (car (gimp-image-get-layer-by-name image "photograph"))))
  (gimp-context-set-brush-size 9)
  (gimp-clone far far CLONE-IMAGE 10 10 4 #(60 30 62 30))
  (gimp-heal far far 12 12 4 #(20 40 24 40))
  (gimp-message (string-append "names " (car (gimp-item-get-name far))))
  (file-psd-save RUN-NONINTERACTIVE image far "out.psd" "out.psd" 0 0))
)");
  const std::string run =
      "cd '" + folder.path().string() + "' && HOME='" + folder.path().string() +
      "' timeout 120 gimp-console-2.10 -i -f -b '(load \"edit.scm\")' -b '(gimp-quit 0)' > gimp.log 2>&1";
  ASSERT_EQ(std::system(run.c_str()), 0) << *read_file(folder.path() / "gimp.log");
  const Result<PsdPicture> edited = read_psd(folder.path() / "out.psd");
  ASSERT_TRUE(edited) << to_string(edited.errors()) << *read_file(folder.path() / "gimp.log");
  const Result<ReadLayers> read = read_back(written, *edited);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->messages.empty()) << to_string(read->messages);
  const auto differing = [&](std::size_t i) {
    int count = 0;
    for (std::size_t p = 0; p < read->pixels[i].pixels.size(); p += 4) {
      const std::uint8_t *a = &read->pixels[i].pixels[p], *b = &written.pixels[i].pixels[p];
      count +=
          a[3] != b[3] || (b[3] && !std::equal(a, a + 3, b));  // colour below full transparency is nobody's
    }
    return count;
  };
  EXPECT_EQ(differing(0), 0);
  EXPECT_EQ(differing(1), 0);
  EXPECT_GT(differing(2), 50) << "GIMP painted nothing: the test tests nothing";
  EXPECT_LT(differing(2), 600);
}

}  // namespace
}  // namespace parvis::facades
