#include "formats/inventor/coin_module.h"

#include <Inventor/SbImage.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLAppearance.h>
#include <Inventor/VRMLnodes/SoVRMLImageTexture.h>
#include <Inventor/VRMLnodes/SoVRMLShape.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/fields/SoSFBool.h>
#include <Inventor/fields/SoSFNode.h>
#include <Inventor/nodes/SoMaterialBinding.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShape.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "base/colour.h"
#include "base/files.h"
#include "base/image_io.h"
#include "formats/inventor/inventor_reader.h"
#include "formats/readers/plain_account.h"
#include "scene/data/placeholder.h"

namespace parvis::inventor {
namespace {
namespace fs = std::filesystem;

/// A picture that Coin is given in place of a file's: one texel, a mark and the number of the file's name.
constexpr std::array<unsigned char, 2> picture_mark{0xA7, 0x3C};

/// Brackets in the text, past strings and comments, before Coin recurses over them.
Status check_nesting(std::string_view text, const std::string& file) {
  int depth = 0, line = 1;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\n') ++line;
    if (c == '\0') return error_at({file, line, 0}, "is not text: save it as ASCII");
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size()) - 1;
    } else if (c == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at) {
        if (text[at] == '\n') ++line;
        if (text[at] == '\\') ++at;
      }
    } else if (c == '{' || c == '[') {
      if (++depth > max_nesting)
        return error_at({file, line, 0}, "nodes are nested more than {} deep; flatten the file's groups",
                        max_nesting);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return Ok{};
}

glm::vec3 vector(const SbVec3f& v) { return {v[0], v[1], v[2]}; }

/// z up: (x, y, z) of a world with y up becomes (x, -z, y).
glm::vec3 turned(glm::vec3 v, bool is_y_up) { return is_y_up ? glm::vec3(v.x, -v.z, v.y) : v; }

/// Takes over the triangles that Coin makes of its shapes.
class Assembly {
 public:
  Assembly(const fs::path& file, bool is_y_up, Errors& warnings)
      : file_(file), is_y_up_(is_y_up), warnings_(warnings) {
    model_.name = file.stem().string();
  }

  /// Walks the scene graph.
  void add(SoNode* root) {
    SoCallbackAction walk;
    walk.addPreCallback(SoVRMLShape::getClassTypeId(), begin_vrml, this);
    walk.addPostCallback(SoVRMLShape::getClassTypeId(), end_vrml, this);
    walk.addPreCallback(SoShape::getClassTypeId(), begin_shape, this);
    walk.addTriangleCallback(SoShape::getClassTypeId(), add_triangle, this);
    walk.apply(root);
  }
  /// Number by which `name_of_picture` finds the name again.
  std::uint16_t picture(const std::string& name) {
    const auto known = std::ranges::find(pictures_, name);
    if (known == pictures_.end()) pictures_.push_back(name);
    return std::uint16_t(std::min<std::size_t>(std::size_t(known - pictures_.begin()), 65535));
  }

  Result<scene::Model> take() {
    if (model_.parts.empty())
      return error_at({file_.string(), 0, 0}, "holds no triangles: nothing in it can be shown");
    for (scene::Part& part : model_.parts) {
      if (const Status status = check(part.mesh, "\"" + part.object + "\""); !status)
        return error_at({file_.string(), 0, 0}, "{}", status.errors().front().message);
      fill_normals(part.mesh);
    }
    return std::move(model_);
  }

 private:
  using Look = std::tuple<float, float, float, float, float, float, float, int, bool>;
  static constexpr float of_corners = -1.0f;  ///< in place of a look's colour

  static SoCallbackAction::Response begin_shape(void* self, SoCallbackAction* walk, const SoNode* shape) {
    static_cast<Assembly*>(self)->begin(*walk, *shape);
    return SoCallbackAction::CONTINUE;
  }
  static SoCallbackAction::Response begin_vrml(void* self, SoCallbackAction*, const SoNode* shape) {
    static_cast<Assembly*>(self)->picture_of_shape_ = picture_of(static_cast<const SoVRMLShape&>(*shape));
    return SoCallbackAction::CONTINUE;
  }
  static SoCallbackAction::Response end_vrml(void* self, SoCallbackAction*, const SoNode*) {
    static_cast<Assembly*>(self)->picture_of_shape_ = nullptr;
    return SoCallbackAction::CONTINUE;
  }
  /// Coin opens the files of VRML 2 when it draws, which is never: null where there is none.
  static const SoVRMLImageTexture* picture_of(const SoVRMLShape& shape) {
    const SoNode* look = shape.appearance.getValue();
    if (!look || !look->isOfType(SoVRMLAppearance::getClassTypeId())) return nullptr;
    const SoNode* texture = static_cast<const SoVRMLAppearance*>(look)->texture.getValue();
    if (!texture || !texture->isOfType(SoVRMLImageTexture::getClassTypeId())) return nullptr;
    const auto* image = static_cast<const SoVRMLImageTexture*>(texture);
    return image->url.getNum() > 0 ? image : nullptr;
  }
  /// A field of a shape of VRML 2; `other` where it has none of that name.
  static bool flag(const SoNode& shape, const char* name, bool other) {
    const SoField* field = shape.getField(name);
    return field && field->isOfType(SoSFBool::getClassTypeId())
               ? static_cast<const SoSFBool*>(field)->getValue()
               : other;
  }
  static void add_triangle(void* self, SoCallbackAction* walk, const SoPrimitiveVertex* a,
                           const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
    static_cast<Assembly*>(self)->add(*walk, {a, b, c});
  }

  /// Name, texture and sides hold for the whole shape; its colour may change from face to face.
  void begin(SoCallbackAction& walk, const SoNode& shape) {
    const SoPath* path = walk.getCurPath();
    name_.clear();
    for (int i = path->getLength(); i-- > 0 && name_.empty();)
      name_ = path->getNode(i)->getName().getString();
    if (name_.empty()) name_ = "shape";
    SbVec2s size(0, 0);
    int components = 0;
    const unsigned char* texels = walk.getTextureImage(size, components);
    if (picture_of_shape_)
      texture_ = texture(*picture_of_shape_);
    else
      texture_ = texels && size[0] > 0 ? texture(texels, size, components, walk) : scene::no_index;
    // Shapes whose corners have no order, or that are not solid, are seen from both sides.
    is_double_sided_ = !flag(shape, "solid", walk.getShapeType() == SoShapeHints::SOLID);
    is_clockwise_ = !flag(shape, "ccw", walk.getVertexOrdering() != SoShapeHints::CLOCKWISE);
    has_colours_of_corners_ = has_colours_of_corners(walk, shape);
    part_ = -1;
    last_look_ = {};
  }

  int texture(const SoVRMLImageTexture& image) {
    const bool repeats = image.repeatS.getValue() || image.repeatT.getValue();
    const auto [known, is_new] = textures_.try_emplace({&image, repeats}, int(model_.textures.size()));
    if (!is_new) return known->second;
    const std::string name = image.url[0].getString();
    model_.textures.push_back({name, read_picture(name)});
    model_.textures.back().set_repeats(repeats);
    return known->second;
  }

  int texture(const unsigned char* texels, SbVec2s size, int components, SoCallbackAction& walk) {
    const bool repeats = walk.getTextureWrapS() == SoTexture2::REPEAT;
    const auto [known, is_new] = textures_.try_emplace({texels, repeats}, int(model_.textures.size()));
    if (!is_new) return known->second;
    const bool is_named = components == 4 && size == SbVec2s(1, 1) &&
                          std::equal(picture_mark.begin(), picture_mark.end(), texels);
    const std::size_t number = is_named ? std::size_t(texels[2]) << 8 | texels[3] : pictures_.size();
    scene::Texture texture;
    texture.set_repeats(repeats);
    if (number < pictures_.size())
      texture.name = pictures_[number], texture.image = read_picture(texture.name);
    else
      texture.name = "inline picture", texture.image = copied(texels, size, components);
    model_.textures.push_back(std::move(texture));
    return known->second;
  }

  Image8 read_picture(std::string name) {
    std::ranges::replace(name, '\\', '/');
    const Result<fs::path> path = Roots(file_.parent_path()).find(name, {});
    Result<Image8> picture = path ? read_image8(*path) : Result<Image8>(path.errors());
    if (picture) return *std::move(picture);
    for (const Error& problem : picture.errors())
      warnings_.push_back({problem.message + "; a checker stands for it", {file_.string(), 0, 0}});
    return scene::placeholder_picture();
  }

  /// Coin's pictures have their bottom row first, and 1 to 4 components: grey, grey and alpha, RGB, RGBA.
  static Image8 copied(const unsigned char* texels, SbVec2s size, int components) {
    Image8 image(size[0], size[1], 4, 255);
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x) {
        const unsigned char* from = texels + components * ((size[1] - 1 - y) * int(size[0]) + x);
        for (int c = 0; c < 3; ++c) image.at(x, y)[c] = from[components < 3 ? 0 : c];
        if (components % 2 == 0) image.at(x, y)[3] = from[components - 1];
      }
    return image;
  }

  Look look_of(const SoCallbackAction& walk, int material_index) const {
    SbColor ambient, diffuse, specular, emission;
    float shininess = 0.0f, transparency = 0.0f;
    walk.getMaterial(ambient, diffuse, specular, emission, shininess, transparency, material_index);
    return {diffuse[0],  diffuse[1],   diffuse[2], emission[0],     emission[1],
            emission[2], transparency, texture_,   is_double_sided_};
  }

  int part_of(const Look& look) {
    if (part_ >= 0 && look == last_look_) return part_;
    last_look_ = look;
    const auto [material, is_new_look] = materials_.try_emplace(look, int(model_.materials.size()));
    if (is_new_look) model_.materials.push_back(material_of(look, name_));
    const auto [part, is_new] = parts_.try_emplace({name_, material->second}, int(model_.parts.size()));
    if (is_new) model_.parts.push_back({name_, {}, material->second, 0, true});
    return part_ = part->second;
  }

  /// Whether a shape gives colours to its corners, which are those of a display, as in other formats.
  static bool has_colours_of_corners(const SoCallbackAction& walk, const SoNode& shape) {
    const auto node_in = [&](const char* name) {
      const SoField* field = shape.getField(name);
      return field ? static_cast<const SoSFNode*>(field)->getValue() : nullptr;
    };
    if (shape.getField("colorPerVertex")) return flag(shape, "colorPerVertex", false) && node_in("color");
    SoMaterialBinding::Binding binding = walk.getMaterialBinding();
    if (const auto* own = dynamic_cast<const SoVertexProperty*>(node_in("vertexProperty"));
        own && own->orderedRGBA.getNum() > 0)
      binding = SoMaterialBinding::Binding(own->materialBinding.getValue());
    return binding == SoMaterialBinding::PER_VERTEX || binding == SoMaterialBinding::PER_VERTEX_INDEXED;
  }

  /// The mesh for a triangle. A texture replaces colours.
  Mesh& mesh_for(const SoCallbackAction& walk, const std::array<const SoPrimitiveVertex*, 3>& corners) {
    Look look = look_of(walk, corners[0]->getMaterialIndex());
    const bool is_plain = !has_colours_of_corners_ || texture_ != scene::no_index;
    if (!is_plain) std::get<0>(look) = std::get<1>(look) = std::get<2>(look) = of_corners;
    Mesh& mesh = model_.parts[std::size_t(part_of(look))].mesh;
    for (std::size_t k = 0; !is_plain && k < 3; ++k) {
      const Look own = look_of(walk, corners[k]->getMaterialIndex());
      mesh.colours.emplace_back(
          linear_from_srgb(glm::vec3(std::get<0>(own), std::get<1>(own), std::get<2>(own))), 1.0f);
    }
    return mesh;
  }

  scene::Material material_of(const Look& look, const std::string& name) const {
    const auto& [r, g, b, er, eg, eb, transparency, texture, is_double_sided] = look;
    scene::Material material;
    material.name = name;
    material.base_colour = r == of_corners ? glm::vec3(1.0f) : glm::vec3(r, g, b);
    material.emission = {er, eg, eb};
    material.alpha = std::clamp(1.0f - transparency, 0.0f, 1.0f);
    if (material.alpha < 1.0f) material.alpha_mode = scene::Alpha::blend;
    material.is_double_sided = is_double_sided;
    material.base_colour_texture = texture;
    if (texture == scene::no_index) return material;
    material.base_colour = glm::vec3(1.0f);  // a texture replaces the colour (VRML 97, 4.14)
    const std::vector<std::uint8_t>& texels = model_.textures[std::size_t(texture)].image.pixels;
    for (std::size_t i = 3; i < texels.size(); i += 4)
      if (texels[i] < 128) material.alpha_mode = scene::Alpha::cutout;
    return material;
  }

  void add(SoCallbackAction& walk, std::array<const SoPrimitiveVertex*, 3> corners) {
    const SbMatrix& placed = walk.getModelMatrix();
    // A mirrored triangle turns its back.
    if (is_clockwise_ != (placed.det3() < 0.0f)) std::swap(corners[1], corners[2]);
    Mesh& mesh = mesh_for(walk, corners);
    const SbMatrix normals = placed.inverse().transpose();
    for (const SoPrimitiveVertex* corner : corners) {
      SbVec3f point, normal;
      placed.multVecMatrix(corner->getPoint(), point);
      normals.multDirMatrix(corner->getNormal(), normal);
      SbVec4f at;
      walk.getTextureMatrix().multVecMatrix(corner->getTextureCoords(), at);
      const glm::vec3 direction = turned(vector(normal), is_y_up_);
      const float length = glm::length(direction);
      mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
      mesh.positions.push_back(turned(vector(point), is_y_up_));
      mesh.normals.push_back(length > 1e-12f ? direction / length : glm::vec3(0.0f));
      mesh.uvs.emplace_back(at[0], 1.0f - at[1]);  // Inventor's v runs upward
    }
  }

  fs::path file_;
  bool is_y_up_;
  Errors& warnings_;
  scene::Model model_;
  std::vector<std::string> pictures_;
  std::map<std::pair<const void*, bool>, int> textures_;  ///< by what Coin holds of them
  const SoVRMLImageTexture* picture_of_shape_ = nullptr;
  std::map<Look, int> materials_;
  std::map<std::pair<std::string, int>, int> parts_;
  std::string name_;  ///< of the shape that is being read
  int texture_ = scene::no_index, part_ = -1;
  bool is_double_sided_ = true, is_clockwise_ = false, has_colours_of_corners_ = false;
  Look last_look_;
};

/// Nodes of a kind that make no triangles.
struct KindOfNodes {
  const char* kind;
  scene::Fate fate;
  const char* reason;
  std::array<const char*, 5> types;  ///< as Coin calls them, with those that are derived from them
};

constexpr std::array kinds_of_nodes{
    KindOfNodes{"lights",
                scene::Fate::left_out,
                "lamps of models are not read; write lamp() nodes",
                {"Light", "VRMLLight"}},
    KindOfNodes{"cameras",
                scene::Fate::left_out,
                "cameras of models are not read; write camera() nodes",
                {"Camera", "VRMLViewpoint"}},
    KindOfNodes{"lines and points",
                scene::Fate::left_out,
                "points and lines have no surface",
                {"LineSet", "IndexedLineSet", "PointSet", "VRMLIndexedLineSet", "VRMLPointSet"}},
    KindOfNodes{"texts", scene::Fate::left_out, "texts without a surface are not drawn", {"Text2", "Image"}},
    KindOfNodes{"animations",
                scene::Fate::left_out,
                "models of Inventor and VRML stand still",
                {"VRMLInterpolator", "VRMLTimeSensor", "Rotor", "Pendulum", "Shuttle"}},
    KindOfNodes{"scripts", scene::Fate::left_out, "they are not run", {"VRMLScript"}},
    KindOfNodes{
        "sounds", scene::Fate::left_out, "sounds of models are not read; write sound() nodes", {"VRMLSound"}},
    KindOfNodes{"files within the file",
                scene::Fate::left_out,
                "give each file a model() of its own",
                {"VRMLInline", "WWWInline"}},
    KindOfNodes{"fog and backgrounds",
                scene::Fate::left_out,
                "the scene has its own",
                {"VRMLFog", "VRMLBackground", "Environment"}},
    KindOfNodes{"nodes of unknown kinds", scene::Fate::left_out, "Coin knows no such node", {"UnknownNode"}},
    KindOfNodes{"levels of detail",
                scene::Fate::changed,
                "shown at the level that Coin chooses",
                {"LOD", "LevelOfDetail", "VRMLLOD"}},
    KindOfNodes{"switches",
                scene::Fate::unneeded,
                "of their children those that are chosen are shown",
                {"Switch", "VRMLSwitch"}}};

/// Counts the nodes of which no triangles come, each once, wherever in the file it stands.
void account_for_nodes(SoNode* root, scene::FileAccount& account) {
  for (const KindOfNodes& kind : kinds_of_nodes)
    for (const char* name : kind.types) {
      const SoType type = name ? SoType::fromName(name) : SoType::badType();
      if (type.isBad()) continue;
      SoSearchAction search;
      search.setType(type);
      search.setInterest(SoSearchAction::ALL);
      search.setSearchingAll(TRUE);
      search.apply(root);
      std::set<const SoNode*> counted;  // a node may stand in several places
      for (int i = 0; i < search.getPaths().getLength(); ++i) {
        const SoNode* node = search.getPaths()[i]->getTail();
        if (!counted.insert(node).second) continue;
        const std::string given = node->getName().getString();
        account.add(kind.fate, kind.kind, kind.reason,
                    given.empty() ? node->getTypeId().getName().getString() : given, 1);
      }
    }
}

/// Coin asks for the content of a picture.
SbBool note_picture(const SbString& name, SbImage* image, void* assembly) {
  const std::uint16_t number = static_cast<Assembly*>(assembly)->picture(name.getString());
  const std::array<unsigned char, 4> texel{picture_mark[0], picture_mark[1], std::uint8_t(number >> 8),
                                           std::uint8_t(number & 255)};
  image->setValue(SbVec2s(1, 1), 4, texel.data());
  return TRUE;
}

/// The first thing that Coin complains about; later ones follow from it.
void note_problem(const SoError* problem, void* text) {
  auto& first = *static_cast<std::string*>(text);
  if (first.empty()) first = problem->getDebugString().getString();
  std::ranges::replace(first, '\n', ' ');
}

Result<formats::FileContent> read(const fs::path& file, const formats::ModelReading& reading,
                                  Errors& warnings) {
  const Result<std::string> text = read_file(file, max_bytes);
  if (!text) return text.errors();
  if (const Status status = check_nesting(*text, file.string()); !status) return status.errors();
  SoDB::init();
  std::string problem;
  SoReadError::setHandlerCallback(note_problem, &problem);
  SoDebugError::setHandlerCallback(note_problem, &problem);
  scene::FileAccount account("Inventor or VRML");
  Assembly assembly(file, reading.up != formats::UpAxis::z, warnings);
  SbImage::addReadImageCB(note_picture, &assembly);
  SoInput input;
  input.setBuffer(text->data(), text->size());
  SoSeparator* root = SoDB::readAll(&input);
  if (root) {
    root->ref();
    account_for_nodes(root, account);
    assembly.add(root);
    root->unref();
  }
  SbImage::removeReadImageCB(note_picture, &assembly);
  if (!root)
    return error_at({file.string(), 0, 0}, "cannot be read as Inventor or VRML ({})",
                    problem.empty() ? "no reason given" : problem);
  Result<scene::Model> model = assembly.take();
  if (!model) return model.errors();
  formats::count_what_is_shown(*model, account);
  return formats::FileContent{*std::move(model), std::move(account)};
}

}  // namespace
}  // namespace parvis::inventor

PARVIS_MODULE(parvis::inventor::CoinFunctions){parvis::inventor::read};
