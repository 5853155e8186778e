// First intersection of a ray with a heightfield. Meyer and Loscos 2003, section 4.2: grid traversal after
// Amanatides and Woo (1987), stopped by the first cell that is higher than the ray. The paper takes the point
// where the ray enters that cell; `walk_heightfield` intersects the cell's side or its top exactly, and
// `walk_pyramid` skips wide low regions at once (Tevs, Ihrke and Seidel 2008, Maximum Mipmaps). Required from
// the host:
//   float cell_height(ivec2 cell, int level)   metres; the highest of 2^level by 2^level cells

struct HeightfieldGrid {
  vec2 origin;  // south-west corner
  float cell_m;
  ivec2 cells;
  int top_level;  // of the pyramid: one cell covers everything
};

// What a ray hits: nothing, the vertical side of a cell, or its level top.
const int hit_nothing = 0;
const int hit_side = 1;
const int hit_top = 2;

struct HeightHit {
  float distance;  // in units of the direction's length
  int kind;
};

// Path of a ray through the grid's plan, in cells.
struct GridRay {
  vec2 start;
  vec2 inverse;  // of the direction in cells
  ivec2 turn;    // 1 where the ray runs towards higher cells
  float from;    // distances between which it is over the grid
  float to;
};

GLSL_FUNCTION GridRay grid_ray(HeightfieldGrid grid, vec3 origin, vec3 direction, float reach) {
  GridRay ray;
  ray.start = (vec2(origin.x, origin.y) - grid.origin) / grid.cell_m;
  vec2 step = vec2(direction.x, direction.y) / grid.cell_m;
  if (abs(step.x) < 1e-7f) step.x = 1e-7f;
  if (abs(step.y) < 1e-7f) step.y = 1e-7f;
  ray.inverse = vec2(1.0f) / step;
  ray.turn = ivec2(step.x > 0.0f ? 1 : 0, step.y > 0.0f ? 1 : 0);
  vec2 low = (vec2(0.0f) - ray.start) * ray.inverse;
  vec2 high = (vec2(grid.cells) - ray.start) * ray.inverse;
  ray.from = max(0.0f, max(min(low.x, high.x), min(low.y, high.y)));
  ray.to = min(reach, min(max(low.x, high.x), max(low.y, high.y)));
  return ray;
}

GLSL_FUNCTION ivec2 cell_at(HeightfieldGrid grid, GridRay ray, float distance) {
  ivec2 cell = ivec2(floor(ray.start + distance / ray.inverse));
  return clamp(cell, ivec2(0), grid.cells - ivec2(1));
}

// Distances at which the ray leaves a block of 2^level by 2^level cells, by its two sides.
GLSL_FUNCTION vec2 block_exits(GridRay ray, ivec2 block, int level) {
  return (vec2((block + ray.turn) << level) - ray.start) * ray.inverse;
}

// The cell beyond the block that the ray leaves at min(exits).
GLSL_FUNCTION ivec2 cell_beyond(GridRay ray, ivec2 block, int level, vec2 exits) {
  ivec2 first = block << level;
  ivec2 last = first + ivec2((1 << level) - 1);
  bool leaves_by_x = exits.x < exits.y;
  float leaves_at = min(exits.x, exits.y);
  ivec2 cell = clamp(ivec2(floor(ray.start + leaves_at / ray.inverse)), first, last);
  if (leaves_by_x) cell.x = ray.turn.x == 1 ? last.x + 1 : first.x - 1;
  if (!leaves_by_x) cell.y = ray.turn.y == 1 ? last.y + 1 : first.y - 1;
  return cell;
}

GLSL_FUNCTION bool is_in_grid(HeightfieldGrid grid, ivec2 cell) {
  return min(cell.x, cell.y) >= 0 && cell.x < grid.cells.x && cell.y < grid.cells.y;
}

// The paper's walk: the distance at which the ray enters the first cell that is higher than the ray is there.
GLSL_FUNCTION HeightHit walk_to_cell(HeightfieldGrid grid, vec3 origin, vec3 direction, float reach) {
  GridRay ray = grid_ray(grid, origin, direction, reach);
  ivec2 cell = cell_at(grid, ray, ray.from);
  float enters_at = ray.from;
  while (enters_at < ray.to && is_in_grid(grid, cell)) {
    if (cell_height(cell, 0) > origin.z + enters_at * direction.z) return HeightHit(enters_at, hit_side);
    vec2 exits = block_exits(ray, cell, 0);
    cell = cell_beyond(ray, cell, 0, exits);
    enters_at = min(exits.x, exits.y);
  }
  return HeightHit(reach, hit_nothing);
}

// Hit on the side or top of a cell between two distances. `is_first`: the ray starts in this cell; if it
// starts below the cell's top (beside a wall in the cell, under a tree), it leaves the cell without a hit.
GLSL_FUNCTION HeightHit intersect_cell(float height, float z, float rise, float enters_at, float leaves_at,
                                       bool is_first) {
  float z_in = z + enters_at * rise, z_out = z + leaves_at * rise;
  if (height > z_in) return HeightHit(enters_at, is_first ? hit_nothing : hit_side);
  if (height > z_out) return HeightHit((height - z) / rise, hit_top);
  return HeightHit(leaves_at, hit_nothing);
}

GLSL_FUNCTION HeightHit walk_heightfield(HeightfieldGrid grid, vec3 origin, vec3 direction, float reach) {
  GridRay ray = grid_ray(grid, origin, direction, reach);
  ivec2 cell = cell_at(grid, ray, ray.from);
  float enters_at = ray.from;
  bool is_first = ray.from == 0.0f;
  while (enters_at < ray.to && is_in_grid(grid, cell)) {
    vec2 exits = block_exits(ray, cell, 0);
    float leaves_at = min(min(exits.x, exits.y), ray.to);
    HeightHit hit =
        intersect_cell(cell_height(cell, 0), origin.z, direction.z, enters_at, leaves_at, is_first);
    if (hit.kind != hit_nothing) return hit;
    cell = cell_beyond(ray, cell, 0, exits);
    enters_at = leaves_at;
    is_first = false;
  }
  return HeightHit(reach, hit_nothing);
}

// The same with the pyramid of maxima: blocks below the ray are skipped, others are refined.
GLSL_FUNCTION HeightHit walk_pyramid(HeightfieldGrid grid, vec3 origin, vec3 direction, float reach) {
  GridRay ray = grid_ray(grid, origin, direction, reach);
  ivec2 cell = cell_at(grid, ray, ray.from);
  float enters_at = ray.from;
  bool is_first = ray.from == 0.0f;
  int level = 0;
  while (enters_at < ray.to && is_in_grid(grid, cell)) {
    ivec2 block = cell >> level;
    vec2 exits = block_exits(ray, block, level);
    float leaves_at = min(min(exits.x, exits.y), ray.to);
    float height = cell_height(block, level);
    bool is_above = min(enters_at * direction.z, leaves_at * direction.z) + origin.z >= height;
    if (!is_above && level > 0) {
      level -= 1;
      continue;
    }
    if (!is_above) {
      HeightHit hit = intersect_cell(height, origin.z, direction.z, enters_at, leaves_at, is_first);
      if (hit.kind != hit_nothing) return hit;
    }
    cell = cell_beyond(ray, block, level, exits);
    enters_at = leaves_at;
    is_first = false;
    level = min(level + 1, grid.top_level);
  }
  return HeightHit(reach, hit_nothing);
}
