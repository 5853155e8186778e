// parvis share: a scene as a folder that any browser shows.
#include "commands.h"
#include "graphics/gl/context.h"
#include "planning/share/site.h"
#include "scene_arguments.h"

namespace parvis {
namespace {

struct ShareArguments : SceneArguments {
  share::SiteOptions site;
};

Status share_scene(const ShareArguments& arguments) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  const Result<std::unique_ptr<stage::Stage>> stage = arguments.open_stage();
  if (!stage) return stage.errors();
  const Result<share::WrittenSite> written = share::write_site(**stage, arguments.site);
  if (!written) return written.errors();
  for (const std::string& sentence : written->instead) fmt::print("shown otherwise: {}\n", sentence);
  fmt::print("{}: {} scenarios, {} views, {} objects, {:.1f} MB; open index.html in a browser\n",
             arguments.site.folder.string(), written->states, written->views, written->objects,
             1e-6 * double(written->bytes));
  return Ok{};
}

}  // namespace

void add_share(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("share",
                                         "A folder that any browser shows, from a server or by a double "
                                         "click: the place, its scenarios and hours");
  const auto arguments = std::make_shared<ShareArguments>();
  arguments->add_scene(*command);
  command->add_option("--time", arguments->time_s, "Seconds that have passed in the scene before")
      ->check(CLI::Range(0.0, 86400.0));
  command
      ->add_option("--view", arguments->site.views, "A camera to be shown (default: all of them); may repeat")
      ->allow_extra_args(false);
  command->add_option("--title", arguments->site.title,
                      "What stands above the page (default: the scene's name)");
  command->add_option(
      "--notes", arguments->site.notes,
      "Text of the authors (UTF-8); a paragraph that begins with [NAME] is about that view or scenario");
  command->add_option("--link", arguments->site.link,
                      "The address under which the site will stand: its QR code is written as link.svg");
  command->add_option("--texture-size", arguments->site.max_texture_px, "Longest side of textures in pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command->add_option("-o,--output", arguments->site.folder, "The folder, absent or empty")->required();
  command->footer("Example: parvis share scenes/planned_square.xp -o out/site");
  command->callback([arguments, &chosen] { chosen = [arguments] { return share_scene(*arguments); }; });
}

}  // namespace parvis
