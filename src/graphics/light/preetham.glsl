// The sky of Preetham, Shirley and Smits 1999, A Practical Analytic Model for Daylight: the model of the
// thesis. CIE XYZ; Y in W/m2/sr weighted by the eye (683 lm/W make it cd/m2).
//
// Departures, because the fit leaves its range: below a turbidity of 2, where it begins, the distribution
// over the sky passes through zero (at 1.645), and the zenith's luminance does so above 11.5 (low sun), so
// that this is evaluated from 2 to 11 and the rest from 2 to 15; below the horizon the sun's elevation is 0
// and the luminance falls by a factor of e each 1.25 degrees, as that of a clear twilight does; directions
// below the horizon show the horizon. What is left below zero is zero.

GLSL_FUNCTION float perez(float a, float b, float c, float d, float e, float cos_zenith, float angle,
                          float cos_angle) {
  return (1.0f + a * exp(b / cos_zenith)) * (1.0f + c * exp(d * angle) + e * cos_angle * cos_angle);
}

GLSL_FUNCTION vec3 preetham_xyz(vec3 direction, vec3 to_sun, float given_turbidity) {
  float t = clamp(given_turbidity, 2.0f, 15.0f);
  float zenith_t = clamp(given_turbidity, 2.0f, 11.0f);
  float sun_elevation = asin(clamp(to_sun.z, -1.0f, 1.0f));
  float s = min(1.57079633f - sun_elevation, 1.57f);  // zenith angle of the sun
  float cos_s = cos(s);
  float chi = (4.0f / 9.0f - zenith_t / 120.0f) * (3.14159265f - 2.0f * s);
  float zenith_kcd = (4.0453f * zenith_t - 4.9710f) * sin(chi) / cos(chi) - 0.2155f * zenith_t + 2.4192f;
  float s2 = s * s;
  float s3 = s2 * s;
  float zenith_x = t * t * (0.00166f * s3 - 0.00375f * s2 + 0.00209f * s) +
                   t * (-0.02903f * s3 + 0.06377f * s2 - 0.03202f * s + 0.00394f) + 0.11693f * s3 -
                   0.21196f * s2 + 0.06052f * s + 0.25886f;
  float zenith_y = t * t * (0.00275f * s3 - 0.00610f * s2 + 0.00317f * s) +
                   t * (-0.04214f * s3 + 0.08970f * s2 - 0.04153f * s + 0.00516f) + 0.15346f * s3 -
                   0.26756f * s2 + 0.06670f * s + 0.26688f;
  float cos_zenith = max(direction.z, 0.01f);
  float cos_angle = clamp(dot(direction, to_sun), -1.0f, 1.0f);
  float angle = acos(cos_angle);
  float luminance = zenith_kcd *
                    perez(0.1787f * t - 1.4630f, -0.3554f * t + 0.4275f, -0.0227f * t + 5.3251f,
                          0.1206f * t - 2.5771f, -0.0670f * t + 0.3703f, cos_zenith, angle, cos_angle) /
                    perez(0.1787f * t - 1.4630f, -0.3554f * t + 0.4275f, -0.0227f * t + 5.3251f,
                          0.1206f * t - 2.5771f, -0.0670f * t + 0.3703f, 1.0f, s, cos_s);
  float x = zenith_x *
            perez(-0.0193f * t - 0.2592f, -0.0665f * t + 0.0008f, -0.0004f * t + 0.2125f,
                  -0.0641f * t - 0.8989f, -0.0033f * t + 0.0452f, cos_zenith, angle, cos_angle) /
            perez(-0.0193f * t - 0.2592f, -0.0665f * t + 0.0008f, -0.0004f * t + 0.2125f,
                  -0.0641f * t - 0.8989f, -0.0033f * t + 0.0452f, 1.0f, s, cos_s);
  float y = zenith_y *
            perez(-0.0167f * t - 0.2608f, -0.0950f * t + 0.0092f, -0.0079f * t + 0.2102f,
                  -0.0441f * t - 1.6537f, -0.0109f * t + 0.0529f, cos_zenith, angle, cos_angle) /
            perez(-0.0167f * t - 0.2608f, -0.0950f * t + 0.0092f, -0.0079f * t + 0.2102f,
                  -0.0441f * t - 1.6537f, -0.0109f * t + 0.0529f, 1.0f, s, cos_s);
  float dusk = exp(0.8f * 57.2957795f * min(sun_elevation, 0.0f));
  float big_y = max(luminance, 0.0f) * dusk * 1000.0f / 683.0f;
  float safe_x = clamp(x, 0.15f, 0.6f);
  float safe_y = clamp(y, 0.15f, 0.6f);
  float scale = big_y / safe_y;
  return vec3(scale * safe_x, big_y, scale * max(1.0f - safe_x - safe_y, 0.0f));
}
