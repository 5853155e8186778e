#include "graphics/bounced_light/transfer_cache.h"

#include "base/content_hash.h"
#include "base/sealed_file.h"
#include "scene/data/baked_folder.h"
#include "scene/data/scene_key.h"

namespace parvis::bounced_light {
namespace {
namespace fs = std::filesystem;

constexpr SealedKind kind{"PARVISB1", "file of bounced light"};
constexpr int version = 2;  // of how transfers are traced: raise it when old ones no longer serve

std::uint64_t key_of(const scene::Scene& scene) {
  ContentHash hash;
  hash.add(version);
  hash.add(scene::fixed_shape_key(scene));
  scene.data<scene::BouncedSettings>().hash(hash);
  return hash.value();
}

}  // namespace

fs::path TransferCache::folder_of(const scene::Scene& scene) {
  return scene::baked_folder(scene, "bounced_light");
}

TransferCache::TransferCache(const scene::Scene& scene) {
  const fs::path folder = folder_of(scene);
  if (folder.empty()) return;
  key_ = key_of(scene);
  file_ = folder / fmt::format("{:016x}{}", key_, extension);
}

std::optional<Transfer> TransferCache::read() const {
  std::error_code code;
  if (file_.empty() || !fs::exists(file_, code)) return std::nullopt;
  const auto refuse = [](const Error& reason) {
    fmt::print(stderr, "warning: {}; bounced light is traced again\n", reason.message);
    return std::nullopt;
  };
  const Result<std::string> content = read_sealed(file_, kind);
  if (!content) return refuse(content.errors().front());
  Taker taker(*content);
  if (taker.take<std::uint64_t>() != key_) return refuse(error("{}: is of another scene", file_.string()));
  std::optional<Transfer> transfer = Transfer::from_bytes(taker.rest());
  if (!transfer) return refuse(error("{}: holds numbers that are no bounced light", file_.string()));
  return transfer;
}

Status TransferCache::keep(const Transfer& transfer) const {
  std::error_code code;
  fs::create_directories(file_.parent_path(), code);
  std::string content;
  append_value(content, key_);
  return write_sealed(file_, kind, content + transfer.to_bytes());
}

Transfer trace_transfer(const scene::Scene& scene) {
  return Transfer(scene, reference::RayScene(scene), scene.data<scene::BouncedSettings>());
}

}  // namespace parvis::bounced_light
