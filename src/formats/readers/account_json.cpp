#include "formats/readers/account_json.h"

#include <nlohmann/json.hpp>

namespace parvis::formats {

std::string accounts_json(std::span<const scene::FileAccount* const> accounts) {
  using Json = nlohmann::json;
  Json list = Json::array();
  for (const scene::FileAccount* account : accounts) {
    Json lines = Json::array();
    for (const scene::AccountLine& line : account->lines()) {
      lines.push_back({{"kind", line.kind},
                       {"fate", scene::name_of(line.fate)},
                       {"count", line.count},
                       {"names", line.names}});
      if (!line.reason.empty()) lines.back()["reason"] = line.reason;
    }
    list.push_back({{"file", account->file()}, {"format", account->format()}, {"lines", std::move(lines)}});
  }
  return list.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace parvis::formats
