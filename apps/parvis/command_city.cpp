// parvis city: procedural places.
#include "commands.h"
#include "places/kitchen/kitchen.h"
#include "places/paper_city/paper_city.h"
#include "places/square/square.h"

namespace parvis {
namespace {

struct CityArguments {
  std::string name;
  std::filesystem::path folder;
  std::uint64_t seed = 1;
};

Status write_city(const CityArguments& arguments) {
  const auto write = arguments.name == "kitchen"  ? kitchen::write_kitchen
                     : arguments.name == "square" ? square::write_square
                                                  : city::write_paper_city;
  if (Status status = write(arguments.folder, arguments.seed); !status) return status;
  fmt::print("{} is written; see it with: parvis view \"{}\"\n", arguments.name,
             (arguments.folder / (arguments.name + ".xp")).string());
  return Ok{};
}

}  // namespace

void add_city(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("city", "Writes a procedural place: script, models, pictures");
  const auto arguments = std::make_shared<CityArguments>();
  command
      ->add_option("name", arguments->name,
                   "paper: the city of Meyer and Loscos 2003, 1 km2, 500,000 triangles; "
                   "kitchen: mirrors of many shapes, after Estalella and others 2005; "
                   "square: an arcaded square in the spirit of Place Garibaldi in Nice")
      ->required()
      ->check(CLI::IsMember({"paper", "kitchen", "square"}));
  command->add_option("-o,--output", arguments->folder, "The folder to write")->required();
  command->add_option("--seed", arguments->seed, "Another seed gives another city")->capture_default_str();
  command->footer(
      "Example: parvis city paper -o out/paper\nExample: parvis city kitchen -o out/kitchen\n"
      "Example: parvis city square -o out/square");
  command->callback([arguments, &chosen] { chosen = [arguments] { return write_city(*arguments); }; });
}

}  // namespace parvis
