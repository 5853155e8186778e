// A place on disk, stage by stage: what `parvis facade` keeps in a folder of calibrated photographs
// (photographs/set_file.h) with a model. Each stage takes over what is finished and still fits.
//   model.glb           the coarse model
//   pinhole/            the photographs freed from distortion, where they had some
//   layers/NAME.psd     layered pictures, for an image editor
//   layers/written/     as they were written, with their model and cameras: edits are what differs
//   layers/edits/       what an artist painted, apart from the layers
//   layers/kept/        what is finished of the layers (kept_layers.h)
//   filling.txt         proposals that were accepted or refused
//   place.facade        packed layers; place.xp: a scene that shows them
//   packed.txt          what they were packed from, so that it is not done twice
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture/facades/packed_facade.h"
#include "capture/photographs/photograph.h"
#include "scene/data/model.h"

namespace parvis::facades {

/// The objects of a model, in world coordinates; parts of one name are one object. Ordered by name: layers
/// are numbered and named by the order of objects, which no file format has to keep.
std::vector<NamedMesh> named_meshes(const scene::Model& model);

/// A place on disk with the model that its layers are made of.
struct PlaceSource {
  std::filesystem::path folder;
  std::vector<NamedMesh> meshes;
  std::vector<photographs::Photograph> photographs;  ///< without distortion
  Errors notes;                                      ///< photographs that were left out
};

/// Reads the photographs of a folder and frees them from distortion (into pinhole/, once); borders that this
/// leaves empty are cropped. Photographs named in `left_out` are passed over.
Result<PlaceSource> read_place(const std::filesystem::path& folder, std::vector<NamedMesh> meshes,
                               const std::vector<std::string>& left_out = {});

/// A FillingChoice's word in place of a photograph: colours for what no photograph shows
/// (PlaceLayers::surfaces). Its layers are the objects of the model.
inline constexpr const char* surfaces_choice = "surfaces";

/// An artist's decision about proposals, per photograph and layer; "*" stands for all.
struct FillingChoice {
  std::string photograph = "*", layer = "*";
  Filling state = Filling::accepted;
};
/// Adds choices to the folder's filling.txt; later lines win.
Status write_choices(const std::filesystem::path& folder, const std::vector<FillingChoice>& choices);
/// Those of filling.txt; none where it is absent. Errors carry file and line.
Result<std::vector<FillingChoice>> read_choices(const std::filesystem::path& folder);
/// Sets the states of the proposals. Messages name choices that fit no layer.
Errors apply_choices(const std::vector<FillingChoice>& choices, PlaceLayers& place);

/// The layers of the place with its choices and edits: collects what was painted in layers/*.psd since they
/// were written, keeps it in layers/edits/, and paints it on the present layers. What no longer fits is in
/// the warnings, and stays in the edits. Views between photographs mix them: an edit that others show, too,
/// is in the warnings, or is painted into those where `settings` carry edits.
Result<PlaceLayers> make_place(const PlaceSource& source, const PlaceSettings& settings = {});

/// Writes layers/NAME.psd of every photograph, with proposals that were not refused. A picture that holds
/// edits not collected yet is never overwritten: `make_place` has collected them.
Status write_layered_pictures(const PlaceSource& source, const PlaceLayers& place);

/// Packs the place into place.facade, and writes place.xp with a camera for each photograph and a tour.
/// A scene that somebody changed is left alone.
Result<PackedFacade> pack_place(const PlaceSource& source, const PlaceLayers& place);

/// Appends `more` to `all`.
inline void append(Errors& all, const Errors& more) { all.insert(all.end(), more.begin(), more.end()); }

}  // namespace parvis::facades
