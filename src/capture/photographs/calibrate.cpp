#include "capture/photographs/calibrate.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "base/content_hash.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "base/path_inside.h"
#include "base/progress.h"
#include "capture/photographs/alignment.h"
#include "capture/photographs/camera_files.h"
#include "capture/photographs/colmap_database.h"
#include "capture/photographs/colmap_features.h"
#include "capture/photographs/developed.h"
#include "capture/photographs/neighbours.h"
#include "capture/photographs/picture.h"
#include "capture/photographs/picture_header.h"
#include "capture/photographs/picture_pairs.h"
#include "capture/photographs/program.h"
#include "capture/photographs/set_file.h"

namespace parvis::photographs {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t min_matches = 20;  ///< of a pair; COLMAP needs 15 that agree by one geometry
constexpr int work_version = 2;          ///< to be raised where the same photographs give other work
/// Number of threads of COLMAP's stages that draw numbers or add in the order of their threads: the same
/// photographs must give the same cameras.
constexpr const char* one_thread = "1";
constexpr const char* max_trials = "3000";  ///< to find a pair's geometry: enough where a third is right

/// The pictures that a job works on.
struct Pictures {
  std::vector<std::string> names;
  std::map<std::string, PictureHeader> headers;  ///< by name
  std::string hash;                              ///< of names, sizes, times
};

/// Decodes every picture once: COLMAP would take half of a file that is cut short for a whole one.
Pictures usable_pictures(const fs::path& folder, Errors& problems) {
  Pictures pictures;
  std::string identity;
  const std::vector<std::string> names = picture_names(folder);
  Progress progress("reading photographs", names.size());
  for (const std::string& name : names) {
    progress.advance();
    const Result<PictureHeader> info = read_picture_header(folder / name);
    Photograph photograph;
    photograph.name = name;
    photograph.file = folder / name;
    if (info) photograph.lens = pinhole_lens(info->width, info->height, 1.0, 1.0, 0.0, 0.0);
    const Result<Image8> image = info ? read_picture(photograph) : info.errors();
    if (!image) {
      problems.push_back(image.errors().front());
      continue;
    }
    pictures.names.push_back(name);
    pictures.headers.emplace(name, *info);
    std::error_code ignored;
    identity += fmt::format("{} {} {}\n", name, fs::file_size(folder / name, ignored),
                            fs::last_write_time(folder / name, ignored).time_since_epoch().count());
  }
  pictures.hash = identity;
  return pictures;
}

/// The files of COLMAP in the job's folder.
struct WorkFolder {
  fs::path root;
  fs::path database() const { return root / "database.db"; }
  fs::path list() const { return root / "pictures.txt"; }
  fs::path matches() const { return root / "matches.txt"; }
  fs::path inputs() const { return root / "inputs.txt"; }
  fs::path sparse() const { return root / "sparse"; }
  fs::path finished() const { return root / "sparse_finished.txt"; }
  fs::path given() const { return root / "given_cameras"; }
  fs::path log(const std::string& stage) const { return root / (stage + ".log"); }
};

/// Pictures of one camera, size and zoom share a lens: one that differs does not cost the others theirs.
FeatureJob feature_job(const CalibrationJob& job, const Pictures& pictures, const WorkFolder& work) {
  FeatureJob features{job.pictures, work.list(), work.database(), job.lens, {}, {}, job.max_features};
  std::map<std::tuple<std::string, int, int, double>, std::vector<std::string>> groups;
  for (const std::string& name : pictures.names) {
    const PictureHeader& header = pictures.headers.at(name);
    groups[{header.camera, header.width, header.height, header.focal_length_mm}].push_back(name);
  }
  for (const auto& [lens, names] : groups) {
    if (job.one_lens_for_all && names.size() > 1)
      features.groups.push_back(names);
    else
      features.alone.insert(features.alone.end(), names.begin(), names.end());
  }
  return features;
}

/// Starts afresh where pictures or options are not those of the work that lies there.
Status prepare(const CalibrationJob& job, const Pictures& pictures, const WorkFolder& work) {
  std::error_code code;
  fs::create_directories(work.root, code);
  if (code) return error("{}: cannot be made ({})", work.root.string(), code.message());
  const std::string inputs =
      fmt::format("{} {} {} {} {}\n{}\n{}", work_version, job.lens, job.one_lens_for_all, job.max_features,
                  max_feature_side_px, job.cameras.string(), pictures.hash);
  const Result<std::string> before = read_file(work.inputs());
  if (before && *before == inputs) return Ok{};
  for (const fs::path& old : {work.database(), work.sparse(), work.finished(), work.given()})
    fs::remove_all(old, code);
  return write_file(work.inputs(), inputs);
}

/// The matches of two pictures as COLMAP imports them.
std::string match_list(const PictureFeatures& a, const PictureFeatures& b) {
  const std::vector<FeatureMatch> matches = matching_features(a, b);
  if (matches.size() < min_matches) return "";
  std::string text = fmt::format("{} {}\n", a.name, b.name);
  for (const auto& [of_a, of_b] : matches) text += fmt::format("{} {}\n", of_a, of_b);
  return text + "\n";
}

/// Compares the pairs that are worth it, here: COLMAP's comparison without a GPU is many times slower.
Result<std::size_t> write_matches(const WorkFolder& work) {
  const std::vector<PictureFeatures> features = picture_features(work.database());
  const std::vector<PicturePair> pairs = promising_pairs(features);
  std::vector<std::string> lists(pairs.size());
  Progress progress("comparing pairs of photographs", pairs.size());
  parallel_for(pairs.size(), [&](std::size_t i) {
    lists[i] = match_list(features[pairs[i].first], features[pairs[i].second]);
    progress.advance();
  });
  std::string text;
  for (const std::string& list : lists) text += list;
  if (Status status = write_file(work.matches(), text); !status) return status.errors();
  return std::size_t(std::ranges::count_if(lists, [](const std::string& list) { return !list.empty(); }));
}

Status match(const Pictures& pictures, const WorkFolder& work) {
  const auto compared = [&] { return colmap_progress(work.database()).pairs; };
  const std::vector<std::string> common{"--database_path",
                                        work.database(),
                                        "--SiftMatching.use_gpu",
                                        "0",
                                        "--SiftMatching.max_num_trials",
                                        max_trials,
                                        "--SiftMatching.num_threads",
                                        one_thread};
  std::vector<std::string> arguments{"colmap", "exhaustive_matcher"};
  std::size_t count = pictures.names.size() * (pictures.names.size() - 1) / 2;
  // COLMAP's lists of pairs cannot hold names with spaces.
  if (std::ranges::none_of(pictures.names, [](const std::string& n) { return n.find(' ') != n.npos; })) {
    const Result<std::size_t> written = write_matches(work);
    if (!written) return written.errors();
    count = *written;
    arguments = {"colmap", "matches_importer", "--match_list_path", work.matches(), "--match_type", "raw"};
  }
  arguments.insert(arguments.end(), common.begin(), common.end());
  return run_stage("finding the geometry of pairs", count, compared, arguments, work.log("matches"));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

/// Which photographs have nothing in common with any other, for an error or a problem.
Error no_common_place(const std::string& name, int agreement) {
  constexpr int enough_for_a_pair = 15;
  if (agreement < enough_for_a_pair)
    return error(
        "{}: no camera was found: it has nothing in common with any other photograph; it shows another "
        "place, or "
        "photographs between are missing",
        name);
  return error(
      "{}: no camera was found, though {} of its features agree with another photograph's; photographs "
      "between "
      "are missing, or all were taken from one spot: of such ones a program like Hugin makes one picture of "
      "the "
      "whole sphere, which parvis facade panorama takes",
      name, agreement);
}

Status find_cameras(const CalibrationJob& job, const Pictures& pictures, const WorkFolder& work) {
  std::error_code code;
  fs::remove_all(work.sparse(), code);
  fs::create_directories(work.sparse(), code);
  const fs::path log = work.log("cameras");
  const auto registered = [&] {
    const Result<std::string> text = read_file(log);
    return text ? count_of(*text, "Registering image #") + 2 : std::size_t(0);
  };
  const Status status = run_stage(
      "placing photographs", pictures.names.size(), registered,
      {"colmap", "mapper", "--database_path", work.database(), "--image_path", job.pictures, "--output_path",
       work.sparse(), "--Mapper.min_model_size", "2", "--Mapper.num_threads", one_thread},
      log);
  if (fs::exists(work.sparse() / "0" / "images.bin", code)) return status;
  Errors errors{error("{}: no two photographs show one place well enough to place their cameras",
                      job.pictures.string())};
  for (const auto& [name, agreement] : best_agreement(work.database()))
    errors.push_back(no_common_place(name, agreement));
  if (errors.size() == 1 && !status) return status;
  return errors;
}

Status triangulate(const CalibrationJob& job, const PhotographSet& given, const WorkFolder& work) {
  PhotographSet cameras = given;
  cameras.points.clear();
  if (Status status = write_colmap_model(work.given(), colmap_model_of(cameras), ColmapFormat::binary);
      !status)
    return status;  // in its text names end at their first space
  std::error_code code;
  fs::create_directories(work.sparse() / "0", code);
  const fs::path log = work.log("points");
  const auto triangulated = [&] {
    const Result<std::string> text = read_file(log);
    return text ? count_of(*text, "Triangulating image #") : std::size_t(0);
  };
  return run_stage("triangulating points", given.photographs.size(), triangulated,
                   {"colmap", "point_triangulator", "--database_path", work.database(), "--image_path",
                    job.pictures, "--input_path", work.given(), "--output_path", work.sparse() / "0",
                    "--clear_points", "1", "--Mapper.num_threads", one_thread},
                   log);
}

/// The model with the most photographs; those of the others are named: they show another place.
Result<LoadedSet> largest_model(const CalibrationJob& job, const WorkFolder& work) {
  std::vector<LoadedSet> models;
  std::error_code code;
  std::vector<fs::path> folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(work.sparse(), code))
    folders.push_back(entry.path());
  std::ranges::sort(folders);
  for (const fs::path& folder : folders) {
    const Result<ColmapModel> model = read_colmap_model(folder);
    if (!model) return model.errors();
    models.push_back(photograph_set_of(*model, job.pictures));
  }
  if (models.empty()) return error("{}: COLMAP wrote no model", work.sparse().string());
  std::ranges::stable_sort(models, std::greater{},
                           [](const LoadedSet& m) { return m.set.photographs.size(); });
  for (std::size_t i = 1; i < models.size(); ++i)
    for (const Photograph& photograph : models[i].set.photographs)
      if (!find(models[0].set, photograph.name))
        models[0].problems.push_back(
            error("{}: belongs to another place than most photographs ({} show that one, {} this); "
                  "calibrate them apart",
                  photograph.name, models[i].set.photographs.size(), models[0].set.photographs.size()));
  return std::move(models[0]);
}

void name_missing(const Pictures& pictures, const WorkFolder& work, LoadedSet& loaded) {
  const std::map<std::string, int> agreement = best_agreement(work.database());
  std::set<std::string> named;
  for (const Error& problem : loaded.problems)
    named.insert(problem.message.substr(0, problem.message.find(": ")));
  for (const std::string& name : pictures.names) {
    if (find(loaded.set, name) || named.contains(name)) continue;
    const auto found = agreement.find(name);
    loaded.problems.push_back(no_common_place(name, found == agreement.end() ? 0 : found->second));
  }
}

/// Cameras are those of the pictures as they are stored, whatever side was up.
void tell_orientations(const Pictures& pictures, PhotographSet& set) {
  for (Photograph& photograph : set.photographs) {
    const auto header = pictures.headers.find(photograph.name);
    const bool is_as_stored = header != pictures.headers.end() &&
                              header->second.width == photograph.lens.width &&
                              header->second.height == photograph.lens.height;
    photograph.orientation = is_as_stored ? header->second.orientation : 1;
  }
}

/// Warns of results that are suspicious though they were calculated.
void check_result(const CalibrationJob& job, LoadedSet& loaded) {
  constexpr double max_focal_difference = 0.02;  // of the two focal lengths of one lens: pixels are square
  if (loaded.set.photographs.size() == 2)
    loaded.problems.push_back(error(
        "two photographs alone have cameras: what one of them hides becomes holes, and no third one shows "
        "whether the place is right; take more"));
  if (!job.cameras.empty()) return;
  for (const Photograph& photograph : loaded.set.photographs) {
    const glm::dvec2 focal = focal_px(photograph.lens);
    if (std::abs(focal.x - focal.y) <= max_focal_difference * std::max(focal.x, focal.y)) continue;
    loaded.problems.push_back(error(
        "{}: its lens has two focal lengths, {:.0f} and {:.0f} pixels, which no camera has: level "
        "photographs do not "
        "fix the second one, and heights come out wrong. Calibrate with --lens SIMPLE_RADIAL, which has one",
        photograph.name, focal.x, focal.y));
    return;  // the others share the lens, or its fault
  }
}

Status turn_and_scale(const CalibrationJob& job, PhotographSet& set) {
  make_z_up(set, !job.cameras.empty());
  double scale = job.scale;
  if (job.distance) {
    const Result<double> found =
        scale_of_distance(set, job.distance->a, job.distance->b, job.distance->metres);
    if (!found) return found.errors();
    scale = *found;
  }
  transform(set, glm::dmat3(1.0), scale, glm::dvec3(0.0));
  return Ok{};
}

/// Masks and gains that somebody gave the photographs of an earlier run. Errors: they cannot be read; the
/// file that holds them must not be written then.
Result<MasksAndGains> masks_and_gains(const fs::path& folder) {
  Result<MasksAndGains> given = read_masks_and_gains(folder);
  if (given) return given;
  Errors errors = given.errors();
  errors.push_back(
      error("{}: its masks and gains would be lost, so that nothing was written. Mend it, or move or delete "
            "it to calibrate without them",
            (folder / "photographs.json").string()));
  return errors;
}

Result<LoadedSet> reconstruct(const CalibrationJob& job, const Pictures& pictures, const WorkFolder& work) {
  LoadedSet given;
  if (!job.cameras.empty()) {
    Result<LoadedSet> read = read_cameras(job.cameras, job.pictures);
    if (!read) return read;
    given = std::move(*read);
    std::erase_if(given.set.photographs, [&](const Photograph& p) {
      return std::ranges::find(pictures.names, p.name) == pictures.names.end();
    });
    given.set.points.clear();
  }
  if (std::error_code code; !fs::exists(work.finished(), code)) {
    if (Status status = find_features(feature_job(job, pictures, work), work.log("features")); !status)
      return status.errors();
    if (Status status = match(pictures, work); !status) return status.errors();
    const Status status =
        job.cameras.empty() ? find_cameras(job, pictures, work) : triangulate(job, given.set, work);
    if (!status) return status.errors();
    if (Status written = write_file(work.finished(), "\n"); !written) return written.errors();
  }
  Result<LoadedSet> loaded = largest_model(job, work);
  if (loaded) loaded->problems.insert(loaded->problems.begin(), given.problems.begin(), given.problems.end());
  return loaded;
}

}  // namespace

Result<LoadedSet> calibrate(const CalibrationJob& asked) {
  CalibrationJob job = asked;
  // Asked before COLMAP's long run, and again after it: somebody may have changed the file meanwhile.
  if (const Result<MasksAndGains> readable = masks_and_gains(job.folder); !readable) return readable.errors();
  const Result<DevelopedFolder> developed_pictures = developed(job.pictures, job.folder / "developed");
  if (!developed_pictures) return developed_pictures.errors();
  job.pictures = developed_pictures->folder;
  Errors problems = developed_pictures->problems;
  const Pictures pictures = usable_pictures(job.pictures, problems);
  if (pictures.names.size() < 2) {
    problems.push_back(error("{}: holds {} photographs that can be read; expected 2 or more",
                             asked.pictures.string(), pictures.names.size()));
    return problems;
  }
  const WorkFolder work{job.folder / "colmap"};
  for (const fs::path& used : {work.root, work.database(), work.sparse(), work.given()})
    if (const Result<fs::path> inside = path_inside(job.folder, used.lexically_relative(job.folder)); !inside)
      return inside.errors();
  if (Status status = prepare(job, pictures, work); !status) return status.errors();
  Result<LoadedSet> loaded = reconstruct(job, pictures, work);
  if (!loaded) {  // pictures that cannot be read may be the reason
    problems.insert(problems.end(), loaded.errors().begin(), loaded.errors().end());
    return problems;
  }
  loaded->problems.insert(loaded->problems.begin(), problems.begin(), problems.end());
  name_missing(pictures, work, *loaded);
  tell_orientations(pictures, loaded->set);
  check_result(job, *loaded);
  if (Status status = turn_and_scale(job, loaded->set); !status) return status.errors();
  // Given cameras are the user's own.
  const Errors misfits =
      job.cameras.empty() ? leave_out_what_does_not_fit(loaded->set) : cameras_that_do_not_fit(loaded->set);
  loaded->problems.insert(loaded->problems.end(), misfits.begin(), misfits.end());
  const Result<MasksAndGains> given = masks_and_gains(job.folder);
  if (!given) return given.errors();
  for (Photograph& photograph : loaded->set.photographs)
    if (const auto known = given->find(photograph.name); known != given->end())
      photograph.mask = known->second.mask, photograph.gain = known->second.gain;
  if (Status status = write_photograph_set(job.folder, loaded->set, job.pictures, *given); !status)
    return status.errors();
  return loaded;
}

std::string calibration_report(const PhotographSet& set) {
  const std::vector<Fit> all = fits(set);
  std::string text =
      fmt::format("{:<32} {:>10} {:>8} {:>9}\n", "photograph", "neighbours", "points", "error px");
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += fmt::format("{:<32} {:>10} {:>8} {:>9.3f}\n", set.photographs[i].name, all[i].neighbours,
                        all[i].points, all[i].reprojection_error_px);
    sum += all[i].points * std::max(all[i].reprojection_error_px, 0.0);
    count += all[i].points;
  }
  text += fmt::format("{} photographs, {} points, mean reprojection error {:.3f} pixels\n",
                      set.photographs.size(), set.points.size(), count > 0.0 ? sum / count : 0.0);
  return text;
}

}  // namespace parvis::photographs
