#include "formats/meshes/assimp_module.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "base/colour.h"
#include "base/exception_reason.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/isolated_process.h"
#include "formats/meshes/far_vertices.h"
#include "formats/meshes/file_frame.h"
#include "formats/meshes/polygon_ears.h"
#include "formats/meshes/text_account.h"
#include "formats/readers/local_origin.h"
#include "formats/readers/plain_account.h"
#include "scene/data/placeholder.h"

namespace parvis::scene {
namespace {
namespace fs = std::filesystem;

constexpr float crease_deg = 50.0f;

glm::dmat4 matrix(const aiMatrix4x4& m) {
  return glm::transpose(glm::dmat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4,
                                   m.d1, m.d2, m.d3, m.d4));
}

glm::dvec3 z_up_of(glm::dvec3 p, bool is_y_up) { return is_y_up ? glm::dvec3(p.x, -p.z, p.y) : p; }

const char* name_of(aiTextureType type) {
  switch (type) {
    case aiTextureType_NORMALS:
    case aiTextureType_HEIGHT:
      return "normals or heights";
    case aiTextureType_SPECULAR:
    case aiTextureType_SHININESS:
      return "gloss";
    case aiTextureType_OPACITY:
      return "opacity";
    case aiTextureType_EMISSIVE:
      return "emission";
    case aiTextureType_AMBIENT:
    case aiTextureType_LIGHTMAP:
      return "ambient light";
    default:
      return "other surface data";
  }
}

std::string lower_case_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

/// Copies what assimp has read into a model.
class Converter {
 public:
  Converter(const fs::path& file, const aiScene& source, FileAccount& account, Errors& warnings)
      : file_(file), source_(source), account_(account), warnings_(warnings) {}

  /// `origin`: taken off already, in the model's axes.
  Result<Model> convert(const glm::dmat4& model_from_root, glm::dvec3 origin) {
    model_.name = file_.stem().string();
    for (unsigned i = 0; i < source_.mNumMaterials; ++i) add_material(*source_.mMaterials[i]);
    if (model_.materials.empty()) model_.materials.push_back({});
    find_origin(model_from_root);
    if (Status status = add_nodes(model_from_root); !status) return status.errors();
    if (model_.parts.empty()) return nothing_drawn();
    model_.origin += origin;
    count_others();
    return std::move(model_);
  }

 private:
  void add_material(const aiMaterial& source) {
    Material material;
    material.name = source.GetName().C_Str();
    aiColor4D colour(0.8f, 0.8f, 0.8f, 1.0f);
    source.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    material.base_colour = {colour.r, colour.g, colour.b};
    float opacity = colours_have_alpha_ ? colour.a : 1.0f, shininess = 0.0f;
    source.Get(AI_MATKEY_OPACITY, opacity);
    source.Get(AI_MATKEY_SHININESS, shininess);
    if (opacity > 0.0f && opacity < 1.0f) material.alpha = opacity, material.alpha_mode = Alpha::blend;
    // Phong's exponent as the roughness of a lobe of the same width (Walter 2007).
    if (shininess > 0.0f) material.roughness = std::pow(2.0f / (shininess + 2.0f), 0.25f);
    if (material.name == AI_DEFAULT_MATERIAL_NAME && has_colours_) material.base_colour = glm::vec3(1.0f);
    aiString path;
    for (int type = aiTextureType_SPECULAR; type <= AI_TEXTURE_TYPE_MAX; ++type)
      if (type != aiTextureType_BASE_COLOR)  // the diffuse one of formats that have both
        account_.left_out(
            "textures",
            fmt::format("of {}: pictures of colours alone are read", name_of(aiTextureType(type))),
            material.name, source.GetTextureCount(aiTextureType(type)));
    if (source.GetTexture(aiTextureType_DIFFUSE, 0, &path) == aiReturn_SUCCESS) {
      material.base_colour_texture = texture(path.C_Str());
      if (has_holes(model_.textures[std::size_t(material.base_colour_texture)].image))
        material.alpha_mode = Alpha::cutout;
    }
    model_.materials.push_back(material);
  }

  static bool has_holes(const Image8& image) {
    for (std::size_t i = 3; i < image.pixels.size(); i += 4)
      if (image.pixels[i] < 128) return true;
    return false;
  }

  int texture(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    const auto [place, is_new] = textures_.try_emplace(name, int(model_.textures.size()));
    if (!is_new) return place->second;
    Result<Image8> picture = read_picture(name);
    if (picture) account_.used("images");
    if (!picture) account_.left_out("images", "a checker stands for them", name);
    if (!picture)
      for (const Error& problem : picture.errors())
        warnings_.push_back({problem.message + "; a checker stands for it", {file_.string(), 0, 0}});
    model_.textures.push_back({name, picture ? *std::move(picture) : placeholder_picture()});
    return place->second;
  }

  /// A file beside the model, or one that the model holds ("*0").
  Result<Image8> read_picture(const std::string& name) const {
    const aiTexture* held = source_.GetEmbeddedTexture(name.c_str());
    if (held != nullptr && held->mHeight == 0)
      return read_image8({reinterpret_cast<const std::uint8_t*>(held->pcData), held->mWidth}, name);
    const Result<fs::path> path = Roots(file_.parent_path()).find(name, {});
    return path ? read_image8(*path) : Result<Image8>(path.errors());
  }

  /// Finds the origin of coordinates that assimp has read itself, in single precision. Nodes are few: the
  /// meshes' own boxes count.
  void find_origin(const glm::dmat4& model_from_root) {
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    std::ignore = each_node(model_from_root, [&](const aiNode& node, const glm::dmat4& model_from_node) {
      for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *source_.mMeshes[node.mMeshes[i]];
        for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
          const aiVector3D& p = mesh.mVertices[v];
          const glm::dvec3 at(model_from_node * glm::dvec4(p.x, p.y, p.z, 1.0));
          low = glm::min(low, at), high = glm::max(high, at);
        }
      }
      return Status(Ok{});
    });
    model_.origin = formats::local_origin(low, high);
    formats::note_single_precision(
        model_.origin, is_exact_in_single_precision() ? "the file has" : "the format's reader has", account_);
  }

  /// Whether the format's coordinates are written in single precision themselves.
  bool is_exact_in_single_precision() const {
    const std::string extension = file_.extension().string();
    return extension == ".ply" || extension == ".stl" || extension == ".3ds" || extension == ".lwo";
  }

  template <class Visit>
  Status each_node(const glm::dmat4& model_from_root, const Visit& visit) const {
    std::vector<std::pair<const aiNode*, glm::dmat4>> open{{source_.mRootNode, model_from_root}};
    while (!open.empty()) {
      const auto [node, parent] = open.back();
      open.pop_back();
      const glm::dmat4 model_from_node = parent * matrix(node->mTransformation);
      if (Status status = visit(*node, model_from_node); !status) return status;
      for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], model_from_node);
    }
    return Ok{};
  }

  /// Meshes under their nodes' transforms, which are worked into the vertices: these formats animate nothing
  /// here.
  Error nothing_drawn() const {
    std::size_t points = 0;
    for (unsigned i = 0; i < source_.mNumMeshes; ++i) points += source_.mMeshes[i]->mNumVertices;
    if (points == 0) return error("no triangles are in this model");
    return error(
        "no triangles are in this model, but {} points: they need a surface, as photogrammetry's "
        "programs make one of them (a mesh)",
        points);
  }
  Status add_nodes(const glm::dmat4& model_from_root) {
    return each_node(model_from_root, [&](const aiNode& node, const glm::dmat4& model_from_node) -> Status {
      for (unsigned i = 0; i < node.mNumMeshes; ++i)
        if (Status status = add_mesh(*source_.mMeshes[node.mMeshes[i]], node, model_from_node); !status)
          return status;
      return Ok{};
    });
  }

  /// Whether numbers up to 255 were written where 1 is the brightest: OFF, and OBJ of some programs.
  static bool has_colours_in_bytes(const aiMesh& source) {
    if (!source.HasVertexColors(0)) return false;
    return std::any_of(source.mColors[0], source.mColors[0] + source.mNumVertices, [](const aiColor4D& c) {
      return std::max({c.r, c.g, c.b}) > 1.0f;
    });
  }

  /// Whole meshes stand in the model's frame: positions are placed in double precision, and rounded about the
  /// origin.
  Status add_mesh(const aiMesh& source, const aiNode& node, const glm::dmat4& model_from_node) {
    Mesh mesh;
    const float unit = has_colours_in_bytes(source) ? 1.0f / 255.0f : 1.0f;
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      const aiVector3D& p = source.mVertices[i];
      mesh.positions.emplace_back(glm::dvec3(model_from_node * glm::dvec4(p.x, p.y, p.z, 1.0)) -
                                  model_.origin);
      if (source.HasVertexColors(0)) {
        const aiColor4D& c = source.mColors[0][i];
        mesh.colours.emplace_back(linear_from_srgb(unit * glm::vec3(c.r, c.g, c.b)),
                                  c.a > 1.0f ? unit * c.a : c.a);
      }
      mesh.normals.push_back(source.HasNormals()
                                 ? glm::vec3(source.mNormals[i].x, source.mNormals[i].y, source.mNormals[i].z)
                                 : glm::vec3(0.0f));
      // assimp's v runs upward
      mesh.uvs.push_back(source.HasTextureCoords(0)
                             ? glm::vec2(source.mTextureCoords[0][i].x, 1.0f - source.mTextureCoords[0][i].y)
                             : glm::vec2(0.0f));
    }
    for (unsigned i = 0; i < source.mNumFaces; ++i)
      if (source.mFaces[i].mNumIndices == 3)
        for (unsigned k = 0; k < 3; ++k) mesh.indices.push_back(source.mFaces[i].mIndices[k]);
    account_.left_out("primitives", "points and lines have no surface", source.mName.C_Str(),
                      source.mNumFaces - mesh.indices.size() / 3);
    if (mesh.indices.empty()) return Ok{};
    count_attributes(source);
    const std::string name = source.mName.length > 0 ? source.mName.C_Str() : node.mName.C_Str();
    for (glm::vec3& normal :
         mesh.normals)  // zero-area triangles leave assimp with normals that are no numbers
      if (!(glm::dot(normal, normal) > 0.25f)) normal = glm::vec3(0.0f);
    if (Status status = check(mesh, "object \"" + name + "\""); !status) return status;
    const glm::mat3 linear{glm::dmat3(model_from_node)};
    for (glm::vec3& normal : mesh.normals)
      if (const glm::vec3 turned = glm::transpose(glm::inverse(linear)) * normal; glm::length(turned) > 0.0f)
        normal = glm::normalize(turned);
    if (glm::determinant(linear) < 0.0f)  // a mirrored triangle turns its back: turn it round
      for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    fill_normals(mesh);
    const int material = std::min(int(source.mMaterialIndex), int(model_.materials.size()) - 1);
    model_.parts.push_back({name, std::move(mesh), material, 0, true});
    return Ok{};
  }

  void count_attributes(const aiMesh& source) {
    const char* name = source.mName.C_Str();
    for (unsigned set = 1; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set)
      account_.unneeded("texture coordinates", "no texture takes them", name, source.HasTextureCoords(set));
    for (unsigned set = 1; set < AI_MAX_NUMBER_OF_COLOR_SETS; ++set)
      account_.left_out("vertex colours", "the first set is shown", name, source.HasVertexColors(set));
    account_.used("vertex colours", source.HasVertexColors(0) ? source.mNumVertices : 0);
    account_.left_out("skins", "the mesh stands as at rest", name, source.HasBones());
    account_.left_out("morph targets", "the mesh stands as at rest", name, source.mNumAnimMeshes);
  }

  void count_others() {
    formats::count_what_is_shown(model_, account_);
    for (unsigned i = 0; i < source_.mNumCameras; ++i)
      account_.left_out("cameras", "cameras of models are not read; write camera() nodes",
                        source_.mCameras[i]->mName.C_Str());
    for (unsigned i = 0; i < source_.mNumLights; ++i)
      account_.left_out("lights", "lamps of models are not read; write lamp() nodes",
                        source_.mLights[i]->mName.C_Str());
    for (unsigned i = 0; i < source_.mNumAnimations; ++i)
      account_.left_out("animations", "these formats are read at rest",
                        source_.mAnimations[i]->mName.C_Str());
  }

  static bool any_colours(const aiScene& scene) {
    for (unsigned i = 0; i < scene.mNumMeshes; ++i)
      if (scene.mMeshes[i]->HasVertexColors(0)) return true;
    return false;
  }

  const fs::path& file_;
  const aiScene& source_;
  const bool has_colours_ = any_colours(source_);
  const bool colours_have_alpha_ =
      lower_case_extension(file_) == ".3mf" || lower_case_extension(file_) == ".x";
  FileAccount& account_;
  Errors& warnings_;
  Model model_;
  std::map<std::string, int> textures_;
};

/// Opens files for reading alone, and only below the folder of the model; of the model itself, these bytes.
class RootedFiles final : public Assimp::DefaultIOSystem {
 public:
  RootedFiles(const fs::path& model, const std::string& bytes)
      : roots_(model.parent_path()), model_(model.string()), bytes_(bytes) {}

  bool Exists(const char* name) const override { return find(name).has_value(); }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    const std::optional<fs::path> file = find(name);
    if (!bytes_.empty() && name == model_)
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
    if (!file || std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
    return DefaultIOSystem::Open(file->c_str(), mode);
  }

 private:
  std::optional<fs::path> find(std::string name) const {
    std::ranges::replace(name, '\\', '/');
    const Result<fs::path> file = roots_.find(name, {});
    std::error_code code;
    if (!file || !fs::is_regular_file(*file, code) || fs::file_size(*file, code) > max_file_bytes || code)
      return std::nullopt;
    return *file;
  }

  Roots roots_;
  std::string model_;
  const std::string& bytes_;
};

/// Leaves the importers of files with this extension ("obj") alone: assimp would try all others by content.
void keep_importers_of(const std::string& extension, Assimp::Importer& importer) {
  std::vector<Assimp::BaseImporter*> others;
  for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
    std::set<std::string> extensions;
    importer.GetImporter(i)->GetExtensionList(extensions);
    if (!extensions.contains(extension)) others.push_back(importer.GetImporter(i));
  }
  for (Assimp::BaseImporter* const other : others) {
    importer.UnregisterLoader(other);
    delete other;  // it was the importer's until now
  }
}

/// Cuts the concave polygons of a mesh into triangles: assimp cuts ears off that have another corner on their
/// side, as an even L has.
void cut_concave_polygons(aiMesh& mesh) {
  constexpr unsigned max_corners = 2000;  // the work grows with their square; assimp cuts larger ones
  std::vector<aiFace> faces;
  bool is_cut = false;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    std::vector<glm::dvec2> corners;
    if (face.mNumIndices > 3 && face.mNumIndices <= max_corners) {
      std::vector<glm::dvec3> in_space;
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices) break;
        const aiVector3D& p = mesh.mVertices[face.mIndices[k]];
        in_space.emplace_back(p.x, p.y, p.z);
      }
      if (in_space.size() == face.mNumIndices) corners = corners_in_plan(in_space);
    }
    if (!is_concave(corners)) {
      faces.push_back(face);
      continue;
    }
    is_cut = true;
    for (const std::array<std::uint32_t, 3>& ear : ears(corners)) {
      aiFace& triangle = faces.emplace_back();
      triangle.mNumIndices = 3, triangle.mIndices = new unsigned[3];  // the face deletes it
      for (std::size_t k = 0; k < 3; ++k) triangle.mIndices[k] = face.mIndices[ear[k]];
    }
  }
  if (!is_cut) return;
  delete[] mesh.mFaces;
  mesh.mNumFaces = unsigned(faces.size()), mesh.mFaces = new aiFace[faces.size()];  // the mesh deletes them
  std::ranges::copy(faces, mesh.mFaces);
  mesh.mPrimitiveTypes |= aiPrimitiveType_TRIANGLE;
  // assimp ends the process where a mesh is said to have polygons and has none.
  if (std::ranges::none_of(faces, [](const aiFace& face) { return face.mNumIndices > 3; }))
    mesh.mPrimitiveTypes &= ~unsigned(aiPrimitiveType_POLYGON);
}

/// A file whose coordinates are those of a national grid.
struct FarFile {
  std::string bytes;  ///< with the origin taken off, and names that assimp knows; empty: read the file itself
  glm::dvec3 origin{0.0};  ///< in the model's axes
  bool is_y_up;
};

FarFile brought_near(const fs::path& file, const std::string& extension, formats::UpAxis up,
                     FileAccount& account) {
  const bool is_z_up_format = extension == ".ply" || extension == ".stl" || extension == ".3mf";
  FarFile near{
      {}, glm::dvec3(0.0), up == formats::UpAxis::y || (up == formats::UpAxis::file && !is_z_up_format)};
  const Result<std::string> bytes = read_file(file);
  if (!bytes) return near;  // assimp says what is wrong
  count_what_assimp_drops(*bytes, file, extension, account);
  near.bytes = with_known_names(*bytes, extension);
  const std::string& read = near.bytes.empty() ? *bytes : near.bytes;
  const std::optional<VertexBox> box = far_vertices(read, extension);
  if (!box) return near;
  // No height is that of a northing.
  if (near.is_y_up && up == formats::UpAxis::file && std::abs(box->low.y) > formats::max_local_m &&
      std::abs(box->low.z) < formats::max_local_m) {
    near.is_y_up = false;
    account.changed("axes", "taken as z up, for y is no height; give up=\"y\" if it is one");
  }
  const glm::dvec3 low = z_up_of(box->low, near.is_y_up), high = z_up_of(box->high, near.is_y_up);
  near.origin = formats::local_origin(glm::min(low, high), glm::max(low, high));
  const glm::dvec3 o = near.origin, in_file = near.is_y_up ? glm::dvec3(o.x, o.z, -o.y) : o;
  if (in_file != glm::dvec3(0.0)) near.bytes = moved_vertices(read, extension, in_file);
  return near;
}

/// The bytes of a file whose unit stands in its archive; of others none.
std::string bytes_of_archive(const fs::path& file, const std::string& extension) {
  if (extension != ".3mf") return {};
  Result<std::string> bytes = read_file(file);
  return bytes ? *std::move(bytes) : std::string();
}

/// The format's name as its users know it.
std::string format_of(const std::string& extension) {
  std::string name = extension.substr(std::min<std::size_t>(1, extension.size()));
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return name == "DAE" ? "COLLADA" : name;
}

Result<formats::FileContent> read(const fs::path& file, formats::UpAxis up, Errors& warnings) {
  const FileLocation where{file.string(), 0, 0};
  const std::string extension = lower_case_extension(file);
  FileAccount account(format_of(extension));
  const FarFile near = brought_near(file, extension, up, account);
  try {
    const LeftInWorker<Assimp::Importer> owned(new Assimp::Importer);
    Assimp::Importer& importer = *owned;
    keep_importers_of(extension.substr(std::min<std::size_t>(1, extension.size())), importer);
    importer.SetIOHandler(new RootedFiles(file, near.bytes));  // the importer deletes it
    importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, crease_deg);
    const aiScene* scene = importer.ReadFile(file.string(), 0);
    for (unsigned i = 0; scene && i < scene->mNumMeshes; ++i) cut_concave_polygons(*scene->mMeshes[i]);
    if (scene)
      scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_GenSmoothNormals |
                                           aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
    if (!scene && std::string_view(importer.GetErrorString()).find("bad_alloc") != std::string_view::npos)
      return error_at(where, "claims more vertices or faces than there is memory for; the file is damaged");
    if (!scene || !scene->mRootNode)
      return error_at(where, "cannot be read as a model ({})", importer.GetErrorString());
    const glm::dmat4 frame =
        model_from_file(*scene, extension, bytes_of_archive(file, extension), up, near.is_y_up, account);
    Result<Model> model = Converter(file, *scene, account, warnings).convert(frame, near.origin);
    if (model) return formats::FileContent{*std::move(model), std::move(account)};
    return Error{model.errors().front().message, where};
  } catch (const std::exception& problem) {
    return error_at(where, "cannot be read as a model ({})", reason_of(problem));
  }
}

}  // namespace
}  // namespace parvis::scene

PARVIS_MODULE(parvis::scene::AssimpFunctions){parvis::scene::read};
