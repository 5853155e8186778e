#include "formats/ifc/ifcplusplus_module.h"

#include <fmt/format.h>
#include <ifcpp/IFC4/include/IfcAnnotation.h>
#include <ifcpp/IFC4/include/IfcBuildingStorey.h>
#include <ifcpp/IFC4/include/IfcColourRgb.h>
#include <ifcpp/IFC4/include/IfcFeatureElementSubtraction.h>
#include <ifcpp/IFC4/include/IfcFooting.h>
#include <ifcpp/IFC4/include/IfcGrid.h>
#include <ifcpp/IFC4/include/IfcIndexedColourMap.h>
#include <ifcpp/IFC4/include/IfcLabel.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcMappedItem.h>
#include <ifcpp/IFC4/include/IfcNormalisedRatioMeasure.h>
#include <ifcpp/IFC4/include/IfcPile.h>
#include <ifcpp/IFC4/include/IfcSpace.h>
#include <ifcpp/IFC4/include/IfcSurfaceStyle.h>
#include <ifcpp/IFC4/include/IfcSurfaceStyleShading.h>
#include <ifcpp/IFC4/include/IfcVirtualElement.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>
#include <ifcpp/model/BuildingModel.h>
#include <ifcpp/reader/ReaderSTEP.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "formats/ifc/ifc_4x3.h"
#include "formats/ifc/ifc_arcs.h"
#include "formats/ifc/ifc_curves.h"
#include "formats/ifc/ifc_edge_loops.h"
#include "formats/ifc/ifc_face_sets.h"
#include "formats/ifc/ifc_primitives.h"
#include "formats/ifc/ifc_profiles.h"
#include "formats/ifc/ifc_styles.h"
#include "formats/ifc/ifc_sweeps.h"
#include "formats/ifc/ifc_text.h"

namespace parvis::scene {
namespace {

constexpr std::size_t max_warnings = 20;
constexpr int max_storey_depth = 64;  // aggregates within aggregates: a file may have cycles
constexpr double cellar_m = -0.5;  // elevation of a storey: lower ones are no ground floors with a step down

/// Corners of a circle: chords of 0.05 m lie within 1 mm of it, and of 0.4 m, too.
constexpr int corners_of_large_circle = 48, corners_of_small_circle = 16;
constexpr double small_circle_m = 0.05;

/// IFC++ writes to the program's output, which belongs to the user.
class SilentOutput {
 public:
  SilentOutput() : narrow_(std::cout.rdbuf(nullptr)), wide_(std::wcout.rdbuf(nullptr)) {}
  ~SilentOutput() {
    std::cout.rdbuf(narrow_), std::cout.clear();
    std::wcout.rdbuf(wide_), std::wcout.clear();
  }
  SilentOutput(const SilentOutput&) = delete;
  SilentOutput& operator=(const SilentOutput&) = delete;

 private:
  std::streambuf* narrow_;
  std::wstreambuf* wide_;
};

/// "Basic Wall:Exterior:184723" is the wall of that type that Revit numbered so: walls of a type go together.
std::string without_number(std::string name) {
  const std::size_t colon = name.find_last_of(':');
  if (colon != std::string::npos && colon + 1 < name.size() &&
      name.find_first_not_of("0123456789", colon + 1) == std::string::npos)
    name.resize(colon);
  return name;
}

std::string name_of(const IfcRoot& root) { return root.m_Name ? utf8(root.m_Name->m_value) : std::string(); }

/// The storey that an object belongs to, by itself or as part of what does; null: none.
const IfcBuildingStorey* storey_of(std::shared_ptr<IfcObjectDefinition> object) {
  for (int depth = 0; object && depth < max_storey_depth; ++depth) {
    if (const auto* storey = dynamic_cast<const IfcBuildingStorey*>(object.get())) return storey;
    std::shared_ptr<IfcObjectDefinition> above;
    if (const IfcElement* element = dynamic_cast<const IfcElement*>(object.get()))
      for (const auto& contained : element->m_ContainedInStructure_inverse)
        if (const auto relation = contained.lock(); relation && !above) above = relation->m_RelatingStructure;
    for (const auto& part : object->m_Decomposes_inverse)
      if (const auto relation = part.lock(); relation && !above) above = relation->m_RelatingObject;
    object = above;
  }
  return nullptr;
}

/// Storeys below the ground: elevations count from the ground floor. None where all would be, as of an
/// underground station: nothing says where the ground above it lies.
std::set<const IfcBuildingStorey*> cellars_of(BuildingModel& building) {
  const double metres = building.getUnitConverter()->getLengthInMeterFactor();
  std::set<const IfcBuildingStorey*> cellars;
  bool has_others = false;
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    const auto* storey = dynamic_cast<const IfcBuildingStorey*>(entity.get());
    if (!storey) continue;
    if (storey->m_Elevation && storey->m_Elevation->m_value * metres < cellar_m)
      cellars.insert(storey);
    else
      has_others = true;
  }
  if (!has_others) cellars.clear();
  return cellars;
}

bool is_foundation(const IfcObjectDefinition& object) {
  return dynamic_cast<const IfcFooting*>(&object) || dynamic_cast<const IfcPile*>(&object);
}

/// Objects that bound room or stand for others, but are not built.
bool is_built(const IfcObjectDefinition& object) {
  return !dynamic_cast<const IfcSpace*>(&object) && !dynamic_cast<const IfcAnnotation*>(&object) &&
         !dynamic_cast<const IfcGrid*>(&object) && !dynamic_cast<const IfcVirtualElement*>(&object) &&
         !dynamic_cast<const IfcFeatureElementSubtraction*>(&object);
}

/// Axes, boxes and foot prints are drawn on plans, not built.
bool is_body(const RepresentationData& representation) {
  static const std::set<std::wstring> others{L"Axis",      L"Box",        L"FootPrint",   L"Clearance",
                                             L"Profile",   L"Annotation", L"Plan",        L"Lighting",
                                             L"Reference", L"CoG",        L"SurveyPoints"};
  return !others.contains(representation.m_representation_identifier);
}

/// A style that is a picture alone lets it show as it is.
std::optional<IfcLook> look_of(const std::vector<std::shared_ptr<AppearanceData>>& appearances,
                               IfcTextures& textures) {
  for (const auto& appearance : appearances) {
    if (!appearance || appearance->m_apply_to_geometry_type == AppearanceData::GEOM_TYPE_CURVE ||
        appearance->m_apply_to_geometry_type == AppearanceData::GEOM_TYPE_TEXT)
      continue;
    const std::optional<std::size_t> picture = textures.picture_of_style(appearance->m_step_style_id);
    if (picture && !appearance->m_complete) return IfcLook{glm::vec3(1.0f), 1.0f, picture};
    vec4& colour = appearance->m_color_diffuse;
    const glm::vec3 rgb(glm::dvec3(colour.r(), colour.g(), colour.b()));
    return IfcLook{glm::clamp(rgb, 0.0f, 1.0f),
                   appearance->m_set_transparent ? float(appearance->m_transparency) : 1.0f, picture};
  }
  return std::nullopt;
}

float value_of(const std::shared_ptr<IfcNormalisedRatioMeasure>& measure) {
  return measure ? glm::clamp(float(measure->m_value), 0.0f, 1.0f) : 0.0f;
}

/// The look by the materials of which the object consists. Of a wall of several layers the first that has a
/// style shows.
std::optional<IfcLook> look_of_material(const IfcObjectDefinition& object, IfcTextures& textures) {
  for (const IfcSurfaceStyle* style : material_styles_of(object))
    for (const auto& element : style->m_Styles)
      if (const auto* shading = dynamic_cast<const IfcSurfaceStyleShading*>(element.get());
          shading && shading->m_SurfaceColour) {
        const IfcColourRgb& colour = *shading->m_SurfaceColour;
        return IfcLook{{value_of(colour.m_Red), value_of(colour.m_Green), value_of(colour.m_Blue)},
                       1.0f - value_of(shading->m_Transparency),
                       textures.picture_of_style(style->m_entity_id)};
      }
  return std::nullopt;
}

/// The triangles of one body, which is triangulated; those that are not finite are dropped.
void add_triangles(const carve::mesh::MeshSet<3>& body, carve::math::Matrix world_from_body,
                   IfcTextures& textures, IfcShape& shape) {
  for (const auto* mesh : body.meshes)
    for (const auto* face : mesh->faces) {
      if (face->nEdges() != 3) continue;
      std::array<glm::dvec3, 3> points, own;  // in the world, and in the body's frame
      const auto* edge = face->edge;
      for (std::size_t k = 0; k < 3; ++k, edge = edge->next) {
        const carve::geom::vector<3> at = world_from_body * edge->vert->v;
        points[k] = {at.x, at.y, at.z};
        own[k] = {edge->vert->v.x, edge->vert->v.y, edge->vert->v.z};
      }
      const glm::dvec3 area = glm::cross(points[1] - points[0], points[2] - points[0]);
      if (!std::isfinite(glm::dot(area, area)) || glm::dot(area, area) <= 0.0) continue;
      shape.corners.insert(shape.corners.end(), points.begin(), points.end());
      if (!shape.look || !shape.look->picture) continue;
      for (const glm::vec2 uv : textures.coordinates(*shape.look->picture, own)) shape.uvs.push_back(uv);
    }
}

/// An object as messages name it: IfcWall "entrance wall" (#48).
std::string described(const IfcObjectDefinition& object) {
  const std::string name = name_of(object);
  return fmt::format("{}{} (#{})", object.className(), name.empty() ? "" : fmt::format(" \"{}\"", name),
                     object.m_entity_id);
}

/// Collects what a file complains about, up to a number of lines.
class Complaints {
 public:
  Complaints(std::string file, Errors& warnings) : file_(std::move(file)), warnings_(warnings) {}
  ~Complaints() {
    if (count_ > max_warnings)
      warnings_.push_back({fmt::format("{} more such warnings", count_ - max_warnings), {file_, 0, 0}});
  }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  void add(const std::string& message) {
    if (++count_ <= max_warnings) warnings_.push_back({message, {file_, 0, 0}});
  }
  /// Adds a warning about an entity, which `name_entities` names by the object that it belongs to.
  void add(const BuildingEntity& entity, const std::string& message) {
    if (!seen_.emplace(entity.m_entity_id, message).second) return;
    if (count_ < max_warnings) about_.push_back({warnings_.size(), &entity});
    add(message);
  }
  void name_entities(const BuildingModel& building) {
    std::map<const BuildingEntity*, std::string> owners;
    for (const auto& [index, entity] : about_)
      if (const auto* object = dynamic_cast<const IfcObjectDefinition*>(entity))
        owners[entity] = described(*object);
      else
        owners[entity] = "";
    for (const auto& [id, entity] : building.getMapIfcEntities()) {
      const auto* product = dynamic_cast<const IfcProduct*>(entity.get());
      const bool is_open = std::ranges::any_of(owners, [](const auto& each) { return each.second.empty(); });
      if (!is_open) break;
      if (!product || !product->m_Representation) continue;
      std::map<BuildingEntity*, std::shared_ptr<BuildingEntity>> own;
      BuildingModel::collectDependentEntities(product->m_Representation, own);
      for (auto& [part, owner] : owners)
        if (owner.empty() && own.contains(const_cast<BuildingEntity*>(part))) owner = described(*product);
    }
    for (const auto& [index, entity] : about_) {
      const std::string& owner = owners[entity];
      const bool is_itself = dynamic_cast<const IfcObjectDefinition*>(entity);
      const std::string part =
          is_itself ? "" : fmt::format("{} #{}: ", entity->className(), entity->m_entity_id);
      std::string& message = warnings_[index].message;
      message = fmt::format("{}{}{}", owner.empty() ? "" : owner + ": ", part, message);
    }
    about_.clear();
  }

 private:
  std::string file_;
  Errors& warnings_;
  std::size_t count_ = 0;
  std::set<std::pair<int, std::string>> seen_;
  std::vector<std::pair<std::size_t, const BuildingEntity*>> about_;  ///< by the index of the warning
};

/// Whether IFC++ has made anything of an item: surfaces, or lines, which are not shown.
bool has_geometry(const ItemShapeData& item) {
  return !item.m_meshsets.empty() || !item.m_meshsets_open.empty() || !item.m_polylines.empty();
}

/// Reports the items of an object's bodies that IFC++ has made nothing of.
void report_lost_items(const ProductShapeData& product, const IfcObjectDefinition& object,
                       Complaints& complaints) {
  for (const auto& representation : product.m_vec_representations) {
    const auto given = representation ? representation->m_ifc_representation.lock() : nullptr;
    if (!given || !is_body(*representation)) continue;
    std::vector<const BuildingEntity*> items;  // those that are not mapped, as IFC++ counts them
    for (const auto& item : given->m_Items)
      if (!dynamic_cast<const IfcMappedItem*>(item.get())) items.push_back(item.get());
    const bool are_named = items.size() == representation->m_vec_item_data.size();
    for (std::size_t i = 0; i < representation->m_vec_item_data.size(); ++i) {
      const auto& made = representation->m_vec_item_data[i];
      if (made && has_geometry(*made)) continue;
      const BuildingEntity& about =
          are_named && items[i] ? *items[i] : static_cast<const BuildingEntity&>(object);
      complaints.add(about,
                     "IFC++ makes no surface of it, and it is left out; export it as a body of faces "
                     "(IfcTriangulatedFaceSet, IfcFacetedBrep)");
    }
    if (representation->m_vec_item_data.empty() && !given->m_Items.empty())
      complaints.add(object,
                     "IFC++ makes no surface of its body, and it is left out; export it as a body of faces "
                     "(IfcTriangulatedFaceSet, IfcFacetedBrep)");
  }
}

void add_bodies(IfcShape shape, std::vector<std::shared_ptr<carve::mesh::MeshSet<3>>>& bodies, bool is_closed,
                const carve::math::Matrix& world_from_body, IfcTextures& textures,
                std::vector<IfcShape>& shapes) {
  shape.is_closed = is_closed;
  for (auto& body : bodies) {
    CSG_Adapter::retriangulateMeshSet(body);
    if (body) add_triangles(*body, world_from_body, textures, shape);
  }
  if (!shape.corners.empty()) shapes.push_back(std::move(shape));
}

void add_product(ProductShapeData& product, const std::shared_ptr<IfcObjectDefinition>& object,
                 const std::set<const IfcBuildingStorey*>& cellars, IfcTextures& textures,
                 std::vector<IfcShape>& shapes) {
  const carve::math::Matrix world_from_product = product.getTransform();
  const IfcBuildingStorey* const storey = storey_of(object);
  IfcShape shape{.storey = storey ? name_of(*storey) : std::string(),
                 .kind = object->className(),
                 .name = without_number(name_of(*object)),
                 .look = {},
                 .is_closed = false,
                 .is_below_ground = cellars.contains(storey) || is_foundation(*object),
                 .corners = {},
                 .uvs = {}};
  const std::optional<IfcLook> of_material = look_of_material(*object, textures);
  for (const auto& representation : product.m_vec_representations) {
    if (!representation || !is_body(*representation)) continue;
    for (const auto& item : representation->m_vec_item_data) {
      shape.look = look_of(item->m_vec_item_appearances, textures);
      if (!shape.look) shape.look = look_of(representation->m_vec_representation_appearances, textures);
      if (!shape.look) shape.look = look_of(product.getAppearances(), textures);
      if (!shape.look) shape.look = of_material;
      add_bodies(shape, item->m_meshsets, true, world_from_product, textures, shapes);
      add_bodies(shape, item->m_meshsets_open, false, world_from_product, textures, shapes);
    }
  }
}

/// An object by its kind, and its representations that are no bodies.
void account_for(const ProductShapeData& product, const IfcObjectDefinition& object, bool is_shown,
                 FileAccount& account) {
  const bool has_body = std::ranges::any_of(product.m_vec_representations, [](const auto& representation) {
    return representation && is_body(*representation);
  });
  if (is_shown)
    account.used(object.className());
  else if (!is_built(object))
    account.unneeded(object.className(), "it bounds room or stands for others, and is not built");
  else if (has_body)
    account.left_out(object.className(), "IFC++ makes no surface of its body", described(object));
  for (const auto& representation : product.m_vec_representations)
    if (representation && !is_body(*representation))
      account.unneeded("representations " + utf8(representation->m_representation_identifier),
                       "they are drawn on plans, not built");
}

/// Instances of the text that IFC++ has no entity of, by their kinds.
void account_for_unknown(const std::string& text, const BuildingModel& building, FileAccount& account) {
  const auto& known = building.getMapIfcEntities();
  for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
    std::size_t first = at;
    while (first > 0 && std::isdigit(static_cast<unsigned char>(text[first - 1]))) --first;
    if (first == 0 || first == at || text[first - 1] != '#') continue;
    int id = 0;
    if (std::from_chars(text.data() + first, text.data() + at, id).ec != std::errc()) continue;
    if (const auto entity = known.find(id); entity != known.end() && entity->second) continue;
    std::size_t end = at + 1;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
      ++end;
    if (end > at + 1)
      account.left_out(text.substr(at + 1, end - at - 1), "IFC++ knows no such entity",
                       fmt::format("#{}", id));
  }
}

/// Faces of one body that have colours of their own are shown in that of the body.
void warn_of_coloured_faces(const BuildingModel& building, Complaints& complaints) {
  for (const auto& [id, entity] : building.getMapIfcEntities())
    if (dynamic_cast<const IfcIndexedColourMap*>(entity.get()))
      complaints.add(
          fmt::format("#{}: colours of single faces (IfcIndexedColourMap) are left out; give each colour a "
                      "body of its own",
                      id));
}

/// IFC++ reads any schema as if it were one that it knows.
Result<IfcSchema> check_schema(const std::string& text, const std::string& name) {
  const std::string named = schema_of_ifc(text);
  for (const char* known : {"'IFC2X3", "'IFC4'", "'IFC4_ADD", "'IFC2X2"})
    if (named.find(known) != std::string::npos) return IfcSchema::known;
  if (named.find("'IFC4X3") != std::string::npos) return IfcSchema::ifc_4x3;
  return Error{fmt::format("the schema is {}; IFC2X3, IFC4 and IFC4X3 are read: export the building as one "
                           "of them (IFC4 Reference View, say)",
                           named.empty() ? "not named" : named),
               {name, 0, 0}};
}

Result<IfcBodies> bodies_of(std::string text, const std::string& name, Errors& warnings) {
  const Result<IfcSchema> schema = check_schema(text, name);
  if (!schema) return schema.errors();
  const SilentOutput silent;
  Complaints complaints(name, warnings);
  if (*schema == IfcSchema::ifc_4x3) {
    if (const std::string left_out = kinds_beyond_ifc_4(text); !left_out.empty())
      complaints.add(
          fmt::format("kinds of IFC4X3 that IFC4 has not are left out: {}; export them as IFC4, in "
                      "IfcBuildingElementProxy, say",
                      left_out));
    text = ifc_4_of_4x3(std::move(text));
  }
  text = with_plain_curves(std::move(text));
  IfcBodies bodies;
  try {
    auto building = std::make_shared<BuildingModel>();
    GeometryConverter converter(building);
    converter.setMessageCallBack(  // IFC++ hands it over by value. NOLINTNEXTLINE(performance-*)
        &complaints, [](void* list, std::shared_ptr<StatusCallback::Message> message) {
          if (!message || message->m_message_type != StatusCallback::MESSAGE_TYPE_ERROR) return;
          const std::string words = utf8(message->m_message_text);
          if (message->m_entity)
            static_cast<Complaints*>(list)->add(*message->m_entity, words);
          else
            static_cast<Complaints*>(list)->add(words);
        });
    const std::string read = text;  // IFC++ takes the text apart
    ReaderSTEP().loadModelFromString(text, building);
    GeometrySettings& settings = *converter.getGeomSettings();
    settings.setNumVerticesPerCircle(corners_of_large_circle);
    settings.setNumVerticesPerCircleGivenRadius([](double radius) {
      return radius < small_circle_m ? corners_of_small_circle : corners_of_large_circle;
    });
    settings.setNumVerticesPerControlPoint(1);  // of straightened splines
    settle_unit_of_angles(*building);
    replace_trimmed_curves(*building, *converter.getRepresentationConverter());
    replace_profiles(*building, *converter.getRepresentationConverter());
    replace_face_sets(*building);
    replace_edge_loops(*building, *converter.getRepresentationConverter(),
                       [&](int id, const std::string& problem) {
                         complaints.add(*building->getMapIfcEntities().at(id), problem);
                       });
    replace_sweeps(*building, *converter.getRepresentationConverter(),
                   [&](int id, const std::string& problem) {
                     complaints.add(*building->getMapIfcEntities().at(id), problem);
                   });
    replace_primitives(*building, *converter.getRepresentationConverter());
    converter.convertGeometry();
    warn_of_coloured_faces(*building, complaints);
    IfcTextures textures(*building, [&](const std::string& message) { complaints.add(message); });
    const std::set<const IfcBuildingStorey*> cellars = cellars_of(*building);
    for (const auto& [id, product] : converter.getShapeInputData()) {
      const std::shared_ptr<IfcObjectDefinition> object =
          product ? product->m_ifc_object_definition.lock() : nullptr;
      if (!object) continue;
      const std::size_t before = bodies.shapes.size();
      if (is_built(*object)) add_product(*product, object, cellars, textures, bodies.shapes);
      account_for(*product, *object, bodies.shapes.size() > before, bodies.account);
      if (!is_built(*object)) continue;
      report_lost_items(*product, *object, complaints);
    }
    complaints.name_entities(*building);
    account_for_unknown(read, *building, bodies.account);
    bodies.pictures = textures.pictures();
    bodies.place = georeference_of(*building, bodies.account);
  } catch (const std::exception& failure) {
    return Error{fmt::format("IFC++ cannot read it: {}", failure.what()), {name, 0, 0}};
  } catch (const carve::exception& failure) {
    return Error{fmt::format("IFC++ cannot build it: {}", failure.str()), {name, 0, 0}};
  }
  return bodies;
}

}  // namespace
}  // namespace parvis::scene

PARVIS_MODULE(parvis::scene::IfcFunctions){parvis::scene::bodies_of};
