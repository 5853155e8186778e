// Pictures of the catalogue's kinds, drawn by the program itself and kept on disk.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "base/kept_parts.h"
#include "graphics/gl/objects.h"
#include "planning/design/kind.h"
#include "stage/stage.h"

namespace parvis::viewer {

class KindPictures {
 public:
  /// `folder`: where pictures are kept; empty: nowhere. The scene outlives this.
  KindPictures(const Registries& registries, const scene::Scene& scene, std::filesystem::path folder);
  ~KindPictures();

  static constexpr int size = 192;  ///< pixels of a side
  /// The texture of a kind's picture; 0: it has not been drawn yet.
  GLuint of(const std::string& kind) const;
  /// Makes one picture that is missing. False: none is.
  bool make_one();

 private:
  Status draw(const design::Kind& kind, Image8& picture);

  const Registries& registries_;
  const scene::Scene& scene_;
  KeptParts kept_;
  std::map<std::string, gl::Texture> textures_;
  std::unique_ptr<stage::Stage> stage_;  ///< of all kinds beside each other
  std::size_t shown_kinds_ = 0;          ///< how many of them
};

}  // namespace parvis::viewer
