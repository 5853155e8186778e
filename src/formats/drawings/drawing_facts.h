// What a DXF file says beside its geometry: unit, layers, placed blocks, counts. Read from its group codes,
// because GDAL reports none of it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/drawings/drawing.h"
#include "formats/drawings/group_codes.h"

namespace parvis::formats {

/// Copies of a block in an array (MINSERT): more are not listed one by one.
inline constexpr int max_block_copies = 10'000;

/// An entity of model space.
struct DrawingEntity {
  std::string type, layer;
  std::string handle;  ///< empty where the file has none (before AC1012)
  double width = 0.0;  ///< of a polyline that is as wide everywhere, in the file's unit
};

/// A placed block, in the file's unit, and the handle of its INSERT.
struct PlacedBlockEntity {
  PlacedBlock block;
  std::string handle, layer;
};

/// Facts of a drawing in the file's own unit.
struct DrawingFacts {
  std::string version, code_page;
  std::optional<int> unit_code;  ///< $INSUNITS, where it names a unit
  std::vector<DrawingLayer> layers;
  std::vector<DrawingEntity> entities;
  std::vector<PlacedBlockEntity> blocks;
  std::map<std::string, std::map<std::string, int>> counts;  ///< as Drawing::entity_counts
  int paper_entities = 0;
};

/// The texts of `codes` are decoded (decode_texts), but for `code_page`, which is plain anyway.
DrawingFacts drawing_facts(const GroupCodes& codes);

/// $DWGCODEPAGE; empty where the header has none.
std::string code_page_of(const GroupCodes& codes);

/// Metres per unit of a value of $INSUNITS; nothing for 0 (no unit) and values that name none.
std::optional<double> metres_of_unit(int insunits);

/// Metres per unit of a name: "m", "cm", "mm", "km", "dm", "in", "ft". Nothing for others.
std::optional<double> metres_of_unit(std::string_view name);

}  // namespace parvis::formats
