// How bark lies on wood. GLSL that is C++, too.

const float bark_repeats = 2.0f;  // for each of the trunks of the paper's city, whose bark is coarser
