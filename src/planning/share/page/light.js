// The light of a moment: sun, sky and exposure as uniforms that all surfaces share, and the sun's shadow maps.
import * as THREE from 'three';

const vector = values => new THREE.Vector3(...values);

function skyTexture(bytes, sky) {
  const levels = sky.levels.map(({width, height, offset}) => ({data: new Uint32Array(bytes, offset, width * height), width, height}));
  const texture = new THREE.DataTexture(levels[0].data, levels[0].width, levels[0].height, THREE.RGBFormat, THREE.UnsignedInt5999Type);
  texture.mipmaps = levels;
  texture.internalFormat = 'RGB9_E5';
  texture.wrapS = THREE.RepeatWrapping;
  texture.magFilter = THREE.LinearFilter;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.needsUpdate = true;
  return texture;
}

function gridTexture(bytes, grid, type) {
  const [width, height, depth] = grid.cells, count = 4 * width * height * depth;
  const data = type === THREE.HalfFloatType ? new Uint16Array(bytes, grid.offset, count) : new Uint8Array(bytes, grid.offset, count);
  const texture = new THREE.Data3DTexture(data, width, height, depth);
  texture.format = THREE.RGBAFormat;
  texture.type = type;
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

// Share of white, textures, gloss and paper at a level from sketch to photograph: realism_at of graphics/shading/realism.glsl.
export function realismAt(level) {
  const step = from => Math.min(Math.max(4 * level - from, 0), 1), mix = (a, b, share) => a + (b - a) * share;
  return new THREE.Vector4(mix(0.35, 1, step(0)) * (1 - step(1)), Math.max(step(2), 0.7 * (1 - step(0))), step(3), 1 - step(0));
}
export const inkAt = level => (level < 0.25 ? 1 - level : Math.min(Math.max(1.125 - 1.5 * level, 0), 1));

const SHADOW_PX = 2048, NEAR_REACH_M = 45;

// One of the two maps: a parallel view from the sun.
class ShadowMap {
  constructor() {
    this.target = new THREE.WebGLRenderTarget(SHADOW_PX, SHADOW_PX, {depthBuffer: true});
    this.target.depthTexture = new THREE.DepthTexture(SHADOW_PX, SHADOW_PX, THREE.UnsignedIntType);
    this.target.depthTexture.compareFunction = THREE.LessEqualCompare;
    this.target.depthTexture.magFilter = this.target.depthTexture.minFilter = THREE.LinearFilter;
    this.camera = new THREE.OrthographicCamera();
    this.uvz = new THREE.Matrix4();
    this.texelM = 1;
  }

  // Looks along the sun at a box of the world; the map's texels stay where they are while the box moves.
  aim(toSun, middle, radius, depth) {
    const up = Math.abs(toSun.z) > 0.99 ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(0, 0, 1);
    const right = new THREE.Vector3().crossVectors(up, toSun).normalize();
    const above = new THREE.Vector3().crossVectors(toSun, right);
    this.texelM = 2 * radius / SHADOW_PX;
    const snapped = axis => Math.round(middle.dot(axis) / this.texelM) * this.texelM;
    const centre = new THREE.Vector3().addScaledVector(right, snapped(right)).addScaledVector(above, snapped(above))
                       .addScaledVector(toSun, middle.dot(toSun));
    const camera = this.camera;
    camera.left = camera.bottom = -radius, camera.right = camera.top = radius;
    camera.near = 0, camera.far = 2 * depth;
    camera.matrixAutoUpdate = false;
    camera.matrix.makeBasis(right, above, toSun).setPosition(centre.addScaledVector(toSun, depth));
    camera.updateMatrixWorld(true);
    camera.updateProjectionMatrix();
    const half = new THREE.Matrix4().set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1);
    this.uvz.multiplyMatrices(half, camera.projectionMatrix).multiply(camera.matrixWorldInverse);
  }
}

export class Light {
  constructor(site, bytes) {
    this.site = site, this.bytes = bytes;
    this.textures = new Map();
    this.far = new ShadowMap(), this.near = new ShadowMap();
    const open = new THREE.Data3DTexture(new Uint8Array([128, 128, 128, 255]), 1, 1, 1);
    const value = content => ({value: content});
    this.uniforms = {
      to_sun: value(new THREE.Vector3()), sun_irradiance: value(new THREE.Vector3()), sky_sh: value([]), haze_radiance: value(new THREE.Vector3()),
      haze_per_m: value(0), exposure: value(1), frame_realism: value(realismAt(1)), sky_before: value(null), sky_after: value(null),
      sky_share: value(0), sky_levels: value(new THREE.Vector4()), sky_heading: value(new THREE.Vector2()), visibility_map: value(open),
      bounced_map: value(open), visibility_origin: value(new THREE.Vector4()), bounced_origin: value(new THREE.Vector4()),
      visibility_size: value(new THREE.Vector3(1, 1, 1)), bounced_size: value(new THREE.Vector3(1, 1, 1)), bounced_layers: value(0),
      bounced_scale: value(1), far_shadow: value(this.far.target.depthTexture), near_shadow: value(this.near.target.depthTexture),
      far_uvz: value(this.far.uvz), near_uvz: value(this.near.uvz), shadow_texel_m: value(new THREE.Vector2()),
      shadow_texel_uv: value(1 / SHADOW_PX), viewer: value(new THREE.Vector3()),
    };
    this.isStale = true;
    this.nearMiddle = null;
  }

  kept(key, make) {
    if (!this.textures.has(key)) this.textures.set(key, make());
    return this.textures.get(key);
  }

  sky(moment, bytes) { return this.kept(moment, () => skyTexture(bytes, moment.sky)); }

  // A moment, or `share` of the way to a later one.
  show(before, after, share, bytes) {
    const u = this.uniforms, mix = (a, b) => vector(a).lerp(vector(b), share);
    u.to_sun.value.copy(mix(before.to_sun, after.to_sun)).normalize();
    u.sun_irradiance.value.copy(mix(before.sun, after.sun));
    u.exposure.value = before.exposure * (after.exposure / before.exposure) ** share;
    u.sky_sh.value = before.sky.sh.map((each, i) => mix(each, after.sky.sh[i]));
    u.haze_radiance.value.copy(mix(before.sky.haze, after.sky.haze));
    u.sky_before.value = this.sky(before, bytes), u.sky_after.value = this.sky(after, bytes);
    u.sky_share.value = share;
    u.sky_levels.value.set(before.sky.sharpest + before.sky.levels.length, before.sky.sharpest, after.sky.sharpest + after.sky.levels.length, after.sky.sharpest);
    u.sky_heading.value.set(before.sky.heading, after.sky.heading);
    this.isStale = true;
  }

  // What a scenario changes beside its things.
  showState(state) {
    const u = this.uniforms, grid = this.site.visibilities[state.visibility], bounced = this.site.bounced[state.bounced];
    u.haze_per_m.value = state.haze_per_m;
    u.frame_realism.value = realismAt(state.realism);
    u.visibility_map.value = this.kept(grid, () => gridTexture(this.bytes, grid, THREE.UnsignedByteType));
    u.visibility_origin.value.set(...grid.origin, grid.lift);
    u.visibility_size.value.set(...grid.size);
    u.bounced_layers.value = bounced ? bounced.layers : 0;
    if (bounced) {
      u.bounced_map.value = this.kept(bounced, () => gridTexture(this.bytes, bounced, THREE.HalfFloatType));
      u.bounced_origin.value.set(...bounced.origin, bounced.lift);
      u.bounced_size.value.set(...bounced.size);
      // It was found for the scene's own moment, and goes with the light of sun and sky.
      const light = moment => moment.sun[1] * Math.max(moment.to_sun[2], 0) + Math.max(moment.sky.sh[0][1], 0);
      const now = {sun: u.sun_irradiance.value.toArray(), to_sun: u.to_sun.value.toArray(), sky: {sh: [u.sky_sh.value[0].toArray()]}};
      u.bounced_scale.value = light(now) / Math.max(light(this.site.moments[state.moment]), 1e-6);
    }
    this.isStale = true;
  }

  // Draws the maps that are out of date for a viewer.
  drawShadows(renderer, place, camera) {
    const u = this.uniforms, toSun = u.to_sun.value, box = place.bounds;
    const middle = box.getCenter(new THREE.Vector3()), radius = 0.5 * box.getSize(new THREE.Vector3()).length() + 1;
    const ahead = camera.getWorldDirection(new THREE.Vector3()).setZ(0);
    const wanted = camera.position.clone().addScaledVector(ahead, 0.6 * NEAR_REACH_M).setZ(Math.min(camera.position.z, box.max.z));
    const isFar = this.isStale, isNear = isFar || !this.nearMiddle || this.nearMiddle.distanceTo(wanted) > 0.15 * NEAR_REACH_M;
    if (!isNear) return;
    if (isFar) this.far.aim(toSun, middle, radius, radius);
    this.nearMiddle = wanted;
    this.near.aim(toSun, wanted, Math.min(NEAR_REACH_M, radius), 2 * radius);
    u.shadow_texel_m.value.set(this.far.texelM, this.near.texelM);
    place.castShadows(true);
    for (const map of isFar ? [this.far, this.near] : [this.near]) {
      renderer.setRenderTarget(map.target);
      renderer.clear();
      if (toSun.z > -0.02) renderer.render(place.scene, map.camera);
    }
    renderer.setRenderTarget(null);
    place.castShadows(false);
    this.isStale = false;
  }
}
