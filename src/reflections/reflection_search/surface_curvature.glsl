// Curvature of a surface at one of its points, which Newton's method needs beside position and normal:
// measured once, by two further lookups, and updated after each step from the change of the normal (Powell's
// symmetric secant update). Required from the host:
//   SurfacePoint surface_at(vec3 direction)   where a ray from the centre, of any length, hits the surface
// Needs surface_point.glsl.

const float probe_size =
    0.02f;  // distance of the two lookups, relative to that from the centre, for a body seen all around

struct TangentPlane {
  SurfacePoint at;
  vec3 u;  // unit vectors
  vec3 v;
};

// `u`: approximate direction of the plane's first axis.
GLSL_FUNCTION TangentPlane tangent_plane(SurfacePoint at, vec3 u) {
  vec3 across = abs(at.normal.x) < 0.8f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
  vec3 along = u - dot(u, at.normal) * at.normal;
  if (dot(along, along) < 1e-4f) along = across - dot(across, at.normal) * at.normal;
  along = normalize(along);
  return TangentPlane(at, along, cross(at.normal, along));
}

GLSL_FUNCTION vec2 in_tangent_plane(TangentPlane plane, vec3 d) {
  return vec2(dot(d, plane.u), dot(d, plane.v));
}

GLSL_FUNCTION vec3 on_tangent_plane(TangentPlane plane, vec2 d) {
  return plane.at.position + d.x * plane.u + d.y * plane.v;
}

GLSL_FUNCTION vec2 times(vec3 symmetric, vec2 d) {
  return vec2(symmetric.x * d.x + symmetric.y * d.y, symmetric.y * d.x + symmetric.z * d.y);
}

// Derivative of the normal along u and v, as a symmetric matrix (uu, uv, vv), from two lookups, which are
// closer for a patch that its centre sees in a `breadth` below 1.
GLSL_FUNCTION vec3 surface_curvature(TangentPlane plane, vec3 centre, float breadth) {
  vec3 from_centre = plane.at.position - centre;
  float probe = probe_size * breadth * length(from_centre);
  SurfacePoint along_u = surface_at(from_centre + probe * plane.u),
               along_v = surface_at(from_centre + probe * plane.v);
  vec2 su = in_tangent_plane(plane, along_u.position - plane.at.position),
       nu = in_tangent_plane(plane, along_u.normal);
  vec2 sv = in_tangent_plane(plane, along_v.position - plane.at.position),
       nv = in_tangent_plane(plane, along_v.normal);
  float area = su.x * sv.y - su.y * sv.x;
  if (abs(area) < 0.1f * probe * probe) return vec3(nu.x / probe, 0.5f * (nu.y + nv.x) / probe, nv.y / probe);
  return vec3(nu.x * sv.y - nv.x * su.y, 0.5f * (nv.x * su.x - nu.x * sv.x + nu.y * sv.y - nv.y * su.y),
              nv.y * su.x - nu.y * sv.x) /
         area;
}

// The curvature closest to `curvature` that agrees with a step s along which the normal turned by n.
GLSL_FUNCTION vec3 curvature_after_step(vec3 curvature, vec2 s, vec2 n) {
  float size = dot(s, s);
  if (size < 1e-20f) return curvature;
  vec2 off = n - times(curvature, s);
  float part = dot(off, s) / (size * size);
  return curvature + vec3(2.0f * off.x * s.x / size - part * s.x * s.x,
                          (off.x * s.y + off.y * s.x) / size - part * s.x * s.y,
                          2.0f * off.y * s.y / size - part * s.y * s.y);
}
