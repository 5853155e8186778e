#include "capture/view_dependent_objects/blended_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "base/checked.h"
#include "base/memory_budget.h"
#include "base/parallel.h"

namespace parvis::view_dependent_objects {
namespace {

using Triple = std::array<std::uint32_t, 3>;

/// Corners of different files that are one: equal up to a ten thousandth of the size of the thing.
class Corners {
 public:
  explicit Corners(float tolerance) : tolerance_(std::max(tolerance, 1e-7f)) {}

  std::uint32_t number(glm::vec3 at) {
    const glm::ivec3 cell(glm::floor(at / tolerance_));
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
          for (auto [found, end] = cells_.equal_range(key(cell + glm::ivec3(x, y, z))); found != end; ++found)
            if (glm::distance(places_[found->second], at) <= tolerance_) return found->second;
    cells_.emplace(key(cell), std::uint32_t(places_.size()));
    places_.push_back(at);
    return std::uint32_t(places_.size() - 1);
  }

 private:
  static std::uint64_t key(glm::ivec3 cell) {
    constexpr std::uint64_t mask = (1u << 21) - 1;
    return (std::uint64_t(cell.x) & mask) << 42 | (std::uint64_t(cell.y) & mask) << 21 |
           (std::uint64_t(cell.z) & mask);
  }
  float tolerance_;
  std::vector<glm::vec3> places_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

/// One model's texture of a triangle.
struct Texturing {
  std::array<glm::vec2, 3> uvs{};
  int picture = no_texturing;  ///< or `plain`
  glm::vec3 colour{0.0f};      ///< of a plain one, linear

  static constexpr int plain = -1, no_texturing = -2;
};

/// A triangle with what each of the piece's models says of it.
struct SharedTriangle {
  std::array<glm::vec3, 3> corners, normals;
  Triple numbers;
  std::vector<Texturing> by_view;
};

/// Gathers the pieces.
class Assembly {
 public:
  Assembly(const std::vector<ViewedModel>& models, const Merging& merging)
      : models_(models), merging_(merging) {
    Bounds all;
    for (const ViewedModel& viewed : models_) all.add(scene::bounds(*viewed.model));
    tolerance_ = all.empty() ? 0.0f : 1e-4f * glm::length(all.size());
  }

  Result<BlendedModel> assembled() {
    for (const auto& [name, parts] : parts_by_name())
      if (const Status status = add_piece(name, parts); !status) return status.errors();
    if (made_.pieces.empty())
      return error("nothing in these models has a texture{}",
                   merging_.cleans ? "; cleanModels=0 keeps what has none" : "");
    if (const Status status = make_pictures(); !status) return status.errors();
    return std::move(made_);
  }

 private:
  /// Parts by the index of each model that has the name.
  using Parts = std::map<std::size_t, std::vector<std::size_t>>;

  std::map<std::string, Parts> parts_by_name() const {
    std::map<std::string, Parts> by_name;
    for (std::size_t m = 0; m < models_.size(); ++m) {
      const scene::Model& model = *models_[m].model;
      for (std::size_t p = 0; p < model.parts.size(); ++p) {
        const scene::Part& part = model.parts[p];
        const bool has_texture =
            model.materials[std::size_t(part.material)].base_colour_texture != scene::no_index;
        if (has_texture || !merging_.cleans) by_name[merging_.merges ? part.object : ""][m].push_back(p);
      }
    }
    return by_name;
  }

  Status add_piece(const std::string& name, const Parts& parts) {
    std::vector<SharedTriangle> triangles;
    std::map<Triple, std::vector<std::size_t>> known;
    Corners corners(tolerance_);
    std::size_t view = 0;
    for (const auto& [model, of_model] : parts) {
      std::map<Triple, std::size_t> seen;  // a wall's two sides have the same corners, in each model
      for (const std::size_t part : of_model)
        add_part(model, part, view, parts.size(), corners, seen, known, triangles);
      ++view;
      const auto entries = checked_product({2, triangles.size(), parts.size()});
      if (!entries || made_.table.size() + *entries > max_entries)
        return error(
            "\"{}\": {} triangles from {} viewpoints are more than a table of {} entries holds; simplify "
            "the models, or divide them",
            name, triangles.size(), parts.size(), max_entries);
    }
    write_piece(name, parts, triangles);
    return Ok{};
  }

  void add_part(std::size_t m, std::size_t p, std::size_t view, std::size_t views, Corners& corners,
                std::map<Triple, std::size_t>& seen, std::map<Triple, std::vector<std::size_t>>& known,
                std::vector<SharedTriangle>& triangles) {
    const scene::Model& model = *models_[m].model;
    const scene::Part& part = model.parts[p];
    const scene::Material& material = model.materials[std::size_t(part.material)];
    const glm::mat4 placed = scene::rest_pose(model)[std::size_t(part.node)];
    const glm::mat3 normal_matrix = glm::transpose(glm::inverse(glm::mat3(placed)));
    const int picture = picture_of(m, material);
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      SharedTriangle triangle;
      Texturing texturing;
      texturing.picture = picture, texturing.colour = material.base_colour;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = part.mesh.indices[i + k];
        triangle.corners[k] = glm::vec3(placed * glm::vec4(part.mesh.positions[v], 1.0f));
        triangle.normals[k] = normal_matrix * part.mesh.normals[v];
        triangle.numbers[k] = corners.number(triangle.corners[k]);
        texturing.uvs[k] = glm::vec2(material.texture_from_mesh_uv * glm::vec3(part.mesh.uvs[v], 1.0f));
      }
      Triple key = triangle.numbers;
      std::ranges::sort(key);
      if (key[0] == key[1] || key[1] == key[2]) continue;
      std::vector<std::size_t>& twins = known[key];
      const std::size_t turn = seen[key]++;
      if (turn == twins.size()) {
        twins.push_back(triangles.size());
        triangle.by_view.resize(views);
        triangles.push_back(triangle);
      }
      SharedTriangle& shared = triangles[twins[turn]];
      Texturing& mine = shared.by_view[view];
      mine = texturing;
      for (std::size_t k = 0; k < 3; ++k)
        mine.uvs[k] = texturing.uvs[std::size_t(std::ranges::find(triangle.numbers, shared.numbers[k]) -
                                                triangle.numbers.begin())];
    }
  }

  void write_piece(const std::string& name, const Parts& parts,
                   const std::vector<SharedTriangle>& triangles) {
    Piece piece{name, made_.triangle_count(), triangles.size(), int(parts.size()), int(made_.table.size()),
                {}};
    for (const auto& [model, of_model] : parts) made_.table.emplace_back(models_[model].viewpoint, 0.0f);
    for (const SharedTriangle& triangle : triangles) {
      const glm::vec3 facet =
          glm::cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 normal = triangle.normals[k];
        made_.corners.push_back(triangle.corners[k]);
        made_.normals.push_back(glm::dot(normal, normal) > 1e-12f ? glm::normalize(normal)
                                : glm::dot(facet, facet) > 0.0f   ? glm::normalize(facet)
                                                                  : glm::vec3(0, 0, 1));
        piece.bounds.add(triangle.corners[k]);
      }
      for (const Texturing& texturing : triangle.by_view) {
        const auto& uv = texturing.uvs;
        if (texturing.picture == Texturing::plain)
          made_.table.emplace_back(texturing.colour, 0.0f);
        else
          made_.table.emplace_back(uv[0], uv[1]);
        made_.table.emplace_back(uv[2], float(texturing.picture), 0.0f);
        made_.has_holes |= texturing.picture == Texturing::no_texturing;
      }
    }
    if (piece.triangle_count > 0) made_.pieces.push_back(std::move(piece));
  }

  /// Number among the pictures of all models.
  int picture_of(std::size_t m, const scene::Material& material) {
    if (material.base_colour_texture == scene::no_index) return Texturing::plain;
    const scene::Texture& texture = models_[m].model->textures[std::size_t(material.base_colour_texture)];
    const auto [known, is_new] = numbers_.try_emplace(&texture, int(sources_.size()));
    if (is_new) sources_.push_back(&texture);
    made_.has_holes |= material.alpha_mode == scene::Alpha::cutout;
    return known->second;
  }

  /// All pictures in the size of the largest, so that they are layers of one texture.
  Status make_pictures() {
    constexpr int max_side = 4096;
    constexpr std::uint64_t bytes_per_pixel = 4 * 3;  // with mipmaps, here and on the GPU
    int width = 1, height = 1;
    bool repeats = false;
    for (const scene::Texture* source : sources_) {
      width = std::max(width, std::min(source->image.width, max_side));
      height = std::max(height, std::min(source->image.height, max_side));
      repeats |= source->wrap_u != scene::Wrap::clamp || source->wrap_v != scene::Wrap::clamp;
    }
    if (const Status status = check_memory(
            checked_product({bytes_per_pixel, std::uint64_t(width), std::uint64_t(height), sources_.size()}),
            fmt::format("{} pictures of a view-dependent object, {} x {} pixels each", sources_.size(), width,
                        height));
        !status)
      return status.errors();
    made_.pictures.resize(sources_.size());
    parallel_for(sources_.size(), [&](std::size_t i) {
      made_.pictures[i] = *sources_[i];
      made_.pictures[i].image = resized(sources_[i]->image, width, height);
      made_.pictures[i].set_repeats(repeats), made_.pictures[i].is_srgb = true;
    });
    if (made_.pictures.empty()) made_.pictures.push_back({"none", Image8(1, 1, 4, 255)});
    return Ok{};
  }

  /// Bilinear. Pictures are enlarged to the largest; those beyond the limit lose what a mipmap would.
  static Image8 resized(const Image8& from, int width, int height) {
    if (from.width == width && from.height == height) return from;
    Image8 to(width, height, 4);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const glm::vec2 at = (glm::vec2(x, y) + 0.5f) * glm::vec2(from.width, from.height) /
                                 glm::vec2(float(width), float(height)) -
                             0.5f;
        const glm::vec2 low = glm::floor(at), part = at - low;
        for (int c = 0; c < 4; ++c) {
          const auto texel = [&](int dx, int dy) {
            return float(from.at(std::clamp(int(low.x) + dx, 0, from.width - 1),
                                 std::clamp(int(low.y) + dy, 0, from.height - 1))[c]);
          };
          const float value = glm::mix(glm::mix(texel(0, 0), texel(1, 0), part.x),
                                       glm::mix(texel(0, 1), texel(1, 1), part.x), part.y);
          to.at(x, y)[c] = std::uint8_t(std::lround(value));
        }
      }
    return to;
  }

  const std::vector<ViewedModel>& models_;
  const Merging merging_;
  float tolerance_ = 0.0f;
  BlendedModel made_;
  std::map<const scene::Texture*, int> numbers_;
  std::vector<const scene::Texture*> sources_;
};

}  // namespace

Bounds BlendedModel::bounds() const {
  Bounds all;
  for (const Piece& piece : pieces) all.add(piece.bounds);
  return all;
}

void BlendedModel::hash(ContentHash& hash) const {
  hash.add(corners), hash.add(table);
  for (const scene::Texture& picture : pictures) hash.add(picture.image.pixels);
}

Result<BlendedModel> blended_model(const std::vector<ViewedModel>& models, const Merging& merging) {
  if (models.size() > max_views)
    return error("{} models: a view-dependent object blends {} at most; a captured place is a facade(...)",
                 models.size(), max_views);
  return Assembly(models, merging).assembled();
}

}  // namespace parvis::view_dependent_objects
