#include "formats/meshes/assimp_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <set>

#include "base/exception_reason.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/isolated_process.h"
#include "scene/data/placeholder.h"

namespace parvis::scene {
namespace {
namespace fs = std::filesystem;

constexpr float crease_deg = 50.0f;

glm::mat4 matrix(const aiMatrix4x4& m) {
  return glm::transpose(glm::mat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4,
                                  m.d1, m.d2, m.d3, m.d4));
}

/// Copies what assimp has read into a model.
class Converter {
 public:
  Converter(const fs::path& file, const aiScene& source, Errors& warnings)
      : file_(file), source_(source), warnings_(warnings) {}

  Result<Model> convert(bool is_y_up) {
    model_.name = file_.stem().string();
    for (unsigned i = 0; i < source_.mNumMaterials; ++i) add_material(*source_.mMaterials[i]);
    if (model_.materials.empty()) model_.materials.push_back({});
    const glm::mat4 z_up =
        is_y_up ? glm::rotate(glm::mat4(1.0f), glm::radians(90.0f), glm::vec3(1, 0, 0)) : glm::mat4(1.0f);
    if (Status status = add_nodes(z_up); !status) return status.errors();
    if (model_.parts.empty()) return error("no triangles are in this model");
    return std::move(model_);
  }

 private:
  void add_material(const aiMaterial& source) {
    Material material;
    material.name = source.GetName().C_Str();
    aiColor3D colour(0.8f, 0.8f, 0.8f);
    source.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    material.base_colour = {colour.r, colour.g, colour.b};
    float opacity = 1.0f, shininess = 0.0f;
    source.Get(AI_MATKEY_OPACITY, opacity);
    source.Get(AI_MATKEY_SHININESS, shininess);
    if (opacity > 0.0f && opacity < 1.0f) material.alpha = opacity, material.alpha_mode = Alpha::blend;
    // Phong's exponent as the roughness of a lobe of the same width (Walter 2007).
    if (shininess > 0.0f) material.roughness = std::pow(2.0f / (shininess + 2.0f), 0.25f);
    aiString path;
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
    const Result<fs::path> path = Roots(file_.parent_path()).find(name, {});
    Result<Image8> picture = path ? read_image8(*path) : Result<Image8>(path.errors());
    if (!picture)
      for (const Error& problem : picture.errors())
        warnings_.push_back({problem.message + "; a checker stands for it", {file_.string(), 0, 0}});
    model_.textures.push_back({name, picture ? *std::move(picture) : placeholder_picture(), true, true});
    return place->second;
  }

  /// Meshes under their nodes' transforms, which are worked into the vertices: these formats animate nothing
  /// here.
  Status add_nodes(const glm::mat4& model_from_root) {
    std::vector<std::pair<const aiNode*, glm::mat4>> open{{source_.mRootNode, model_from_root}};
    while (!open.empty()) {
      const auto [node, parent] = open.back();
      open.pop_back();
      const glm::mat4 model_from_node = parent * matrix(node->mTransformation);
      for (unsigned i = 0; i < node->mNumMeshes; ++i)
        if (Status status = add_mesh(*source_.mMeshes[node->mMeshes[i]], *node, model_from_node); !status)
          return status;
      for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], model_from_node);
    }
    return Done{};
  }

  Status add_mesh(const aiMesh& source, const aiNode& node, const glm::mat4& model_from_node) {
    Mesh mesh;
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      const aiVector3D& p = source.mVertices[i];
      mesh.positions.emplace_back(p.x, p.y, p.z);
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
    if (mesh.indices.empty()) return Done{};
    const std::string name = source.mName.length > 0 ? source.mName.C_Str() : node.mName.C_Str();
    for (glm::vec3& normal :
         mesh.normals)  // zero-area triangles leave assimp with normals that are no numbers
      if (!(glm::dot(normal, normal) > 0.25f)) normal = glm::vec3(0.0f);
    if (Status status = check(mesh, "object \"" + name + "\""); !status) return status;
    fill_normals(mesh);
    Mesh placed;
    append(placed, mesh, model_from_node);
    const int material = std::min(int(source.mMaterialIndex), int(model_.materials.size()) - 1);
    model_.parts.push_back({name, std::move(placed), material, 0, true});
    return Done{};
  }

  const fs::path& file_;
  const aiScene& source_;
  Errors& warnings_;
  Model model_;
  std::map<std::string, int> textures_;
};

/// Opens files for reading alone, and only below the folder of the model.
class RootedFiles final : public Assimp::DefaultIOSystem {
 public:
  explicit RootedFiles(const fs::path& folder) : roots_(folder) {}

  bool Exists(const char* name) const override { return find(name).has_value(); }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    const std::optional<fs::path> file = find(name);
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

std::string lower_case_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

}  // namespace

Result<Model> read_with_assimp(const fs::path& file, formats::UpAxis up, Errors& warnings) {
  const FileLocation where{file.string(), 0, 0};
  const std::string extension = lower_case_extension(file);
  const bool is_z_up_format = extension == ".ply" || extension == ".stl";
  const bool is_y_up = up == formats::UpAxis::y || (up == formats::UpAxis::file && !is_z_up_format);
  try {
    const LeftInWorker<Assimp::Importer> owned(new Assimp::Importer);
    Assimp::Importer& importer = *owned;
    keep_importers_of(extension.substr(std::min<std::size_t>(1, extension.size())), importer);
    importer.SetIOHandler(new RootedFiles(file.parent_path()));  // the importer deletes it
    importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, crease_deg);
    const aiScene* scene =
        importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_GenSmoothNormals |
                                             aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
    if (!scene && std::string_view(importer.GetErrorString()).find("bad_alloc") != std::string_view::npos)
      return error_at(where, "claims more vertices or faces than there is memory for; the file is damaged");
    if (!scene || !scene->mRootNode)
      return error_at(where, "cannot be read as a model ({})", importer.GetErrorString());
    Result<Model> model = Converter(file, *scene, warnings).convert(is_y_up);
    if (model) return model;
    return Error{model.errors().front().message, where};
  } catch (const std::exception& problem) {
    return error_at(where, "cannot be read as a model ({})", reason_of(problem));
  }
}

}  // namespace parvis::scene
