#include "formats/city_models/osm_file_bytes.h"

#include <cmath>
#include <cstring>

#include "base/memory_budget.h"
#include "base/sealed_file.h"
#include "formats/readers/isolated_reader.h"

namespace parvis::scene {
namespace {

void append_text(std::string& bytes, const std::string& text) {
  append_value(bytes, std::uint64_t(text.size()));
  bytes += text;
}

std::string take_text(ByteReader& reader) {
  return std::string(reader.take_bytes(reader.take<std::uint64_t>()));
}

void append_tags(std::string& bytes, const OsmTags& tags) {
  append_value(bytes, std::uint64_t(tags.size()));
  for (const auto& [key, value] : tags) append_text(bytes, key), append_text(bytes, value);
}

/// Calls `each` as often as the count at the front says, or until the bytes end.
template <class Each>
void take_each(ByteReader& reader, const Each& each) {
  for (auto left = reader.take<std::uint64_t>(); left > 0 && !reader.has_ended_early(); --left) each();
}

OsmTags take_tags(ByteReader& reader) {
  OsmTags tags;
  take_each(reader, [&] {
    std::string key = take_text(reader);
    tags.insert_or_assign(std::move(key), take_text(reader));
  });
  return tags;
}

/// Reads a file in the worker; the input is the map and the file's path.
Status read_in_worker(std::string_view input, IsolatedOutput& output) {
  ByteReader reader(input);
  const std::string map = take_text(reader);
  const std::filesystem::path file = take_text(reader);
  Errors warnings;
  const Result<OsmFile> osm = read_osm_file(file, warnings, map);
  if (!osm) return osm.errors();
  std::string bytes = formats::bytes_of_warnings(warnings);
  bytes += bytes_of(*osm);
  const std::span<std::byte> to = output.allocate(bytes.size());
  if (to.empty()) return error("{}: there is no memory for its {} bytes", file.string(), bytes.size());
  std::memcpy(to.data(), bytes.data(), bytes.size());
  return Ok{};
}

}  // namespace

std::string bytes_of(const OsmFile& osm) {
  std::string bytes;
  for (const glm::dvec2& corner : osm.corners) append_value(bytes, corner);
  append_value(bytes, osm.middle), append_value(bytes, osm.middle_deg);
  append_text(bytes, osm.map), append_value(bytes, osm.true_north_deg), append_value(bytes, osm.deleted);
  append_value(bytes, std::uint64_t(osm.nodes.size()));
  for (const auto& [id, place] : osm.nodes) append_value(bytes, id), append_value(bytes, place);
  append_value(bytes, std::uint64_t(osm.tagged_nodes.size()));
  for (const OsmNode& node : osm.tagged_nodes) append_value(bytes, node.id), append_tags(bytes, node.tags);
  append_value(bytes, std::uint64_t(osm.ways.size()));
  for (const OsmWay& way : osm.ways) {
    append_value(bytes, way.id), append_tags(bytes, way.tags);
    append_value(bytes, std::uint64_t(way.nodes.size()));
    for (const OsmId node : way.nodes) append_value(bytes, node);
  }
  append_value(bytes, std::uint64_t(osm.relations.size()));
  for (const OsmRelation& relation : osm.relations) {
    append_value(bytes, relation.id), append_tags(bytes, relation.tags);
    append_value(bytes, std::uint64_t(relation.members.size()));
    for (const OsmRelation::Member& member : relation.members)
      append_text(bytes, member.type), append_text(bytes, member.role), append_value(bytes, member.id);
  }
  return bytes;
}

Result<OsmFile> osm_file_of(std::string_view bytes, const std::string& subject) {
  if (Status status = check_memory(bytes.size(), subject + ": its elements"); !status) return status.errors();
  ByteReader reader(bytes);
  OsmFile osm;
  bool is_finite = true;
  const auto take_place = [&] {
    const glm::dvec2 place = reader.take<glm::dvec2>();
    is_finite = is_finite && std::isfinite(place.x) && std::isfinite(place.y);
    return place;
  };
  for (glm::dvec2& corner : osm.corners) corner = take_place();
  osm.middle = take_place(), osm.middle_deg = take_place();
  osm.map = take_text(reader), osm.true_north_deg = reader.take<double>();
  osm.deleted = reader.take<std::uint64_t>();
  is_finite = is_finite && std::isfinite(osm.true_north_deg);
  take_each(reader, [&] {
    const OsmId id = reader.take<OsmId>();
    osm.nodes[id] = take_place();
  });
  take_each(reader, [&] {
    OsmNode& node = osm.tagged_nodes.emplace_back();
    node.id = reader.take<OsmId>(), node.tags = take_tags(reader);
  });
  take_each(reader, [&] {
    OsmWay& way = osm.ways.emplace_back();
    way.id = reader.take<OsmId>(), way.tags = take_tags(reader);
    take_each(reader, [&] { way.nodes.push_back(reader.take<OsmId>()); });
    osm.way_of[way.id] = osm.ways.size() - 1;
  });
  take_each(reader, [&] {
    OsmRelation& relation = osm.relations.emplace_back();
    relation.id = reader.take<OsmId>(), relation.tags = take_tags(reader);
    take_each(reader, [&] {
      OsmRelation::Member& member = relation.members.emplace_back();
      member.type = take_text(reader), member.role = take_text(reader), member.id = reader.take<OsmId>();
    });
  });
  if (!reader.is_at_end() || !is_finite)
    return error("{}: its reader returned no whole map; the file is damaged or made to do harm", subject);
  return osm;
}

Result<OsmFile> read_osm_file_isolated(const std::filesystem::path& file, const std::string& map,
                                       Errors& warnings) {
  const std::string subject = file.string();
  std::string input;
  append_text(input, map), append_text(input, std::filesystem::absolute(file).string());
  const Result<IsolatedBytes> made = run_isolated(read_in_worker, input, subject, formats::limits_for(file));
  if (!made) return made.errors();
  const std::string_view bytes(reinterpret_cast<const char*>(made->bytes().data()), made->bytes().size());
  ByteReader reader(bytes);
  formats::take_warnings(reader, warnings);
  return osm_file_of(reader.rest(), subject);
}

}  // namespace parvis::scene
