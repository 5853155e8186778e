#include "capture/photographs/colmap_features.h"

#include <algorithm>

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

Status find_features(const FeatureJob& job, std::size_t count, const std::filesystem::path& log) {
  return run_stage(
      "finding features", count, [&] { return colmap_progress(job.database).pictures; },
      {"colmap", "feature_extractor", "--database_path", job.database, "--image_path", job.pictures,
       "--image_list_path", job.list, "--ImageReader.camera_model", job.lens, "--ImageReader.single_camera",
       job.one_lens ? "1" : "0", "--SiftExtraction.use_gpu", "0", "--SiftExtraction.max_image_size",
       std::to_string(max_feature_side_px), "--SiftExtraction.max_num_features",
       std::to_string(job.max_features)},
      log);
}

}  // namespace parvis::photographs
