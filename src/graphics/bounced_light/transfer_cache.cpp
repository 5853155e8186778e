#include "graphics/bounced_light/transfer_cache.h"

#include "base/content_hash.h"
#include "scene/data/baked_folder.h"
#include "scene/data/scene_key.h"

namespace parvis::bounced_light {
namespace {

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

TransferCache::TransferCache(const scene::Scene& scene)
    : parts_(scene::baked_folder(scene, "bounced_light"), kind, ".transfer", FolderOf::program) {
  if (!parts_.keeps_parts()) return;
  key_ = key_of(scene);
  name_ = fmt::format("{:016x}", key_);
}

std::optional<Transfer> TransferCache::read() const {
  constexpr std::string_view consequence = "bounced light is traced again";
  const std::optional<std::string> bytes = parts_.find(name_, key_, consequence);
  if (!bytes) return std::nullopt;
  std::optional<Transfer> transfer = Transfer::from_bytes(*bytes);
  if (!transfer)
    fmt::print(stderr, "warning: {}: holds numbers that are no bounced light; {}\n", file().string(),
               consequence);
  return transfer;
}

Status TransferCache::keep(const Transfer& transfer) const {
  return parts_.keep(name_, key_, transfer.to_bytes());
}

Transfer trace_transfer(const scene::Scene& scene) {
  return Transfer(scene, reference::RayScene(scene), scene.data<scene::BouncedSettings>());
}

}  // namespace parvis::bounced_light
