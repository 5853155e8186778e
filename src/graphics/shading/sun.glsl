// The sun's disc as it is seen from the earth. GLSL that is C++, too.

const float sun_radius_rad = 0.004653f;  // 16 minutes of arc: the mean over a year
const float sun_solid_angle_sr = 3.14159265f * sun_radius_rad * sun_radius_rad;
