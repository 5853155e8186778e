// The table of sky_view.glsl: azimuth from the sun, 0 to pi, by elevations above the horizon, then below it.
// GLSL that is C++, too.

const int sky_view_columns = 40;
const int sky_view_rows = 64;
