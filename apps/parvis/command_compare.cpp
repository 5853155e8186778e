// parvis compare: how different two pictures are.
#include "base/image_io.h"
#include "commands.h"
#include "graphics/reference/metrics.h"

namespace parvis {
namespace {

struct CompareArguments {
  std::filesystem::path test, reference, mask, map;
};

Status compare(const CompareArguments& arguments) {
  const Result<Image8> test = read_image8(arguments.test);
  if (!test) return test.errors();
  const Result<Image8> reference = read_image8(arguments.reference);
  if (!reference) return reference.errors();
  Image8 mask;
  if (!arguments.mask.empty()) {
    Result<Image8> read = read_image8(arguments.mask);
    if (!read) return read.errors();
    mask = *std::move(read);
  }
  const Result<reference::Difference> difference = reference::compare(*test, *reference, mask);
  if (!difference) return difference.errors();
  fmt::print("FLIP {:.4f}\nPSNR {:.2f} dB\nSSIM {:.4f}\n", difference->flip, difference->psnr,
             difference->ssim);
  if (arguments.map.empty()) return Ok{};
  return write_image(arguments.map, reference::heat_map(difference->flip_map));
}

}  // namespace

void add_compare(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("compare", "How different two pictures are: FLIP, PSNR, SSIM");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("a", arguments->test, "The picture to be judged")->required();
  command->add_option("b", arguments->reference, "The picture that it is judged by")->required();
  command->add_option("--mask", arguments->mask, "Only where this picture is white");
  command->add_option("--map", arguments->map, "Write FLIP in false colours");
  command->footer("Example: parvis compare picture.png truth.png --mask mirrors.png --map flip.png");
  command->callback([arguments, &chosen] { chosen = [arguments] { return compare(*arguments); }; });
}

}  // namespace parvis
