// Transfers beside their scene: folder NAME.baked/bounced_light, in it a file for each state, named by what
// it depends on. Sun and sky are not among that: one file serves every hour.
#pragma once

#include <filesystem>
#include <optional>

#include "base/kept_parts.h"
#include "graphics/bounced_light/transfer.h"

namespace parvis::bounced_light {

/// The kept transfer of one state of a scene.
class TransferCache {
 public:
  /// Nothing is kept of a scene that was made in memory.
  explicit TransferCache(const scene::Scene& scene);

  /// The kept transfer. Reports on standard error a file that cannot be used.
  std::optional<Transfer> read() const;
  /// Keeps it; `file` is not empty. Errors: it cannot be written.
  Status keep(const Transfer& transfer) const;

  /// Where this state's is kept; empty: nowhere.
  std::filesystem::path file() const { return parts_.file(name_); }
  /// The files of all states; none of a scene that was made in memory, or whose folder is a link.
  const KeptParts& parts() const { return parts_; }

 private:
  KeptParts parts_;
  std::uint64_t key_ = 0;
  std::string name_;
};

/// Traces what light of any hour hits in the scene as it stands.
Transfer trace_transfer(const scene::Scene& scene);

}  // namespace parvis::bounced_light
