// How haze scatters light (Henyey and Greenstein 1941). GLSL that is C++, too.

const float haze_asymmetry = 0.76f;  // mainly forward

// Per steradian, of the cosine between the directions before and after.
GLSL_FUNCTION float haze_phase(float cosine) {
  float g = haze_asymmetry;
  float base = 1.0f + g * g - 2.0f * g * cosine;
  return 0.07957747f * (1.0f - g * g) / (base * sqrt(base));
}
