#include "capture/photographs/colmap_features.h"

#include <algorithm>

#include "base/files.h"
#include "base/progress.h"
#include "capture/photographs/colmap_database.h"
#include "capture/photographs/program.h"

namespace parvis::photographs {

Status run_stage(const std::string& what, std::size_t total, const std::function<std::size_t()>& done,
                 const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  Progress progress(what, total);
  std::size_t counted = 0;
  return run_program(arguments, log, [&] {
    const std::size_t now = std::min(done(), total);
    if (now > counted) progress.advance(now - counted);
    counted = std::max(counted, now);
  });
}

Status find_features(const FeatureJob& job, const std::filesystem::path& log) {
  const auto find = [&](const std::vector<std::string>& names, bool one_lens) -> Status {
    std::string list;
    for (const std::string& name : names) list += name + "\n";
    if (Status status = write_file(job.list, list); !status) return status;
    const std::size_t before = colmap_progress(job.database).pictures;
    return run_stage(
        "finding features", names.size(), [&] { return colmap_progress(job.database).pictures - before; },
        {"colmap", "feature_extractor", "--database_path", job.database, "--image_path", job.pictures,
         "--image_list_path", job.list, "--ImageReader.camera_model", job.lens, "--ImageReader.single_camera",
         one_lens ? "1" : "0", "--SiftExtraction.use_gpu", "0", "--SiftExtraction.max_image_size",
         std::to_string(max_feature_side_px), "--SiftExtraction.max_num_features",
         std::to_string(job.max_features)},
        log);
  };
  for (const std::vector<std::string>& group : job.groups)
    if (Status status = find(group, true); !status) return status;
  if (!job.alone.empty())
    if (Status status = find(job.alone, false); !status) return status;
  return number_by_name(job.database);
}

}  // namespace parvis::photographs
