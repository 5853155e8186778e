// The place: the glTF of the site with Parvis's shading in place of three.js's own, and what of it each scenario shows.
import * as THREE from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {MeshoptDecoder} from 'three/addons/libs/meshopt_decoder.module.js';
import {inkAt} from './light.js';
import {depthFragment, depthVertex, skyFragment, skyVertex, surfaceFragment, surfaceVertex} from './shaders.js';

const INK_LIMIT_TRIANGLES = 150000;  // larger meshes have no lines in a sketch: to find edges takes seconds

// three.js's matrix of a texture's place on a mesh; without a texture, the identity.
function placed(texture) {
  if (!texture) return new THREE.Matrix3();
  texture.updateMatrix();
  return texture.matrix;
}

function shaded(from, geometry, light) {
  const own = from.userData.parvis ?? {}, defines = {}, define = (name, is) => { if (is) defines[name] = 1; };
  const hasColours = geometry.hasAttribute('color'), isOpaque = !from.transparent && from.alphaTest === 0;
  define('HAS_MAP', from.map), define('HAS_HOLES', from.alphaTest > 0), define('HAS_COLOURS', hasColours);
  define('HAS_OPENNESS', hasColours && isOpaque), define('HAS_NORMAL_MAP', from.normalMap);
  define('HAS_SURFACE_MAP', from.roughnessMap), define('HAS_OCCLUSION_MAP', from.aoMap), define('HAS_EMISSION_MAP', from.emissiveMap);
  define('HAS_COAT', from.clearcoat > 0), define('HAS_BACKS', from.side === THREE.DoubleSide), define('IS_GLASS', from.transmission > 0);
  define('HAS_SECOND_UV', geometry.hasAttribute('uv1')), define('HAS_RELIEF', own.relief_m > 0 && from.map && from.normalMap);
  for (const [name, map] of [['BASE_UV', from.map], ['NORMAL_UV', from.normalMap], ['SURFACE_UV', from.roughnessMap],
                             ['OCCLUSION_UV', from.aoMap], ['EMISSION_UV', from.emissiveMap]])
    defines[name] = map?.channel === 1 ? 'uv_2' : 'uv_1';
  const value = content => ({value: content});
  const uniforms = {
    ...light.uniforms,
    base_map: value(from.map), normal_map: value(from.normalMap), surface_map: value(from.roughnessMap), occlusion_map: value(from.aoMap),
    emission_map: value(from.emissiveMap), base_from_uv: value(placed(from.map)), normal_from_uv: value(placed(from.normalMap)),
    surface_from_uv: value(placed(from.roughnessMap)), occlusion_from_uv: value(placed(from.aoMap)), emission_from_uv: value(placed(from.emissiveMap)),
    base_colour: value(new THREE.Vector4(from.color.r, from.color.g, from.color.b, from.opacity)),
    emission: value(new THREE.Vector3(from.emissive.r, from.emissive.g, from.emissive.b).multiplyScalar(from.emissiveIntensity)),
    layers: value(new THREE.Vector4(from.metalness, from.roughness, from.clearcoat ?? 0, from.clearcoatRoughness ?? 0.03)),
    translucency: value(own.translucency ?? 0), normal_scale: value(from.normalScale?.x ?? 1), occlusion_strength: value(from.aoMapIntensity ?? 1),
    alpha_cutoff: value(from.alphaTest), ior: value(from.ior ?? 1.5), relief_m: value(own.relief_m ?? 0),
  };
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: surfaceVertex, fragmentShader: surfaceFragment, defines, uniforms, side: from.side,
    transparent: from.transparent, depthWrite: !from.transparent, alphaToCoverage: from.alphaTest > 0,
  });
  const depth = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: depthVertex, fragmentShader: depthFragment, side: THREE.DoubleSide,
    defines: defines.HAS_HOLES && defines.HAS_MAP ? {HAS_HOLES: 1} : {},
    uniforms: {base_map: uniforms.base_map, base_from_uv: uniforms.base_from_uv, alpha: value(from.opacity), alpha_cutoff: uniforms.alpha_cutoff},
  });
  return {material, depth};
}

export class Place {
  constructor(site, light) {
    this.site = site, this.light = light;
    this.scene = new THREE.Scene();
    this.scene.matrixWorldAutoUpdate = false;
    this.meshes = [];  // {mesh, material, depth, casts}
    this.images = [];  // textures by the number of their image in the file
    this.bounds = new THREE.Box3();
    const triangle = new THREE.BufferGeometry();
    triangle.setAttribute('position', new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    this.sky = new THREE.Mesh(triangle, new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: skyVertex, fragmentShader: skyFragment, depthWrite: false, depthFunc: THREE.LessEqualDepth,
      uniforms: {...light.uniforms, world_from_clip: {value: new THREE.Matrix4()}},
    }));
    this.sky.frustumCulled = false;
    this.sky.renderOrder = 0.5;
    this.inks = new THREE.LineBasicMaterial({color: 0x211f21, transparent: true});
  }

  async load(bytes, anisotropy) {
    const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
    const file = await loader.parseAsync(bytes, '');
    const root = file.scene.children[0];
    root.matrix.identity(), root.matrix.decompose(root.position, root.quaternion, root.scale);  // the page has z up, too
    this.things = root.children.slice();
    this.scene.add(root, this.sky);
    const materials = new Map();
    const around = new Set(this.site.surroundings.map(number => this.things[number]));
    root.updateMatrixWorld(true);
    this.things.forEach((thing, number) => {
      thing.userData.number = number;
      thing.traverse(mesh => {
        mesh.matrixAutoUpdate = false;
        if (!mesh.isMesh) return;
        const key = `${mesh.material.uuid} ${mesh.geometry.hasAttribute('color')} ${mesh.geometry.hasAttribute('uv1')}`;
        if (!materials.has(key)) materials.set(key, shaded(mesh.material, mesh.geometry, this.light));
        const {material, depth} = materials.get(key);
        mesh.material = material;
        if (material.transparent) mesh.renderOrder = 1;
        const isFar = around.has(thing) || mesh.userData.backdrop;
        this.meshes.push({mesh, material, depth, casts: !isFar && !material.transparent && mesh.userData.casts_shadow !== false});
        if (!isFar) this.bounds.expandByObject(mesh);
      });
    });
    for (const [texture, found] of file.parser.associations)
      if (texture.isTexture) {
        texture.anisotropy = anisotropy;
        const described = file.parser.json.textures[found.textures];
        (this.images[described.extensions?.EXT_texture_webp?.source ?? described.source] ??= []).push(texture);
      }
  }

  // Replaces a picture by a sharper one of the same.
  async sharpen(image, bytes) {
    const bitmap = await createImageBitmap(new Blob([bytes], {type: new Uint8Array(bytes)[0] === 0x89 ? 'image/png' : 'image/webp'}), {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
    for (const texture of this.images[image] ?? []) {
      texture.dispose();
      texture.image = bitmap;
      texture.needsUpdate = true;
    }
  }

  show(state) {
    const shown = new Set(state.things);
    this.things.forEach((thing, number) => { thing.visible = shown.has(number); });
    this.inks.opacity = inkAt(state.realism);
    if (this.inks.opacity > 0.01) this.addInk(shown);
    for (const lines of this.lines ?? []) lines.visible = this.inks.opacity > 0.01;
  }

  // The lines of a sketch, where surfaces meet.
  addInk(shown) {
    this.edges ??= new Map(), this.lines ??= [];
    for (const {mesh, material} of this.meshes) {
      let thing = mesh;
      while (thing.userData.number === undefined) thing = thing.parent;
      if (mesh.userData.hasInk || !shown.has(thing.userData.number) || material.defines.HAS_OPENNESS) continue;
      mesh.userData.hasInk = true;
      if ((mesh.geometry.index?.count ?? 0) > 3 * INK_LIMIT_TRIANGLES) continue;
      if (!this.edges.has(mesh.geometry)) this.edges.set(mesh.geometry, new THREE.EdgesGeometry(mesh.geometry, 25));
      const lines = new THREE.LineSegments(this.edges.get(mesh.geometry), this.inks);
      lines.matrixAutoUpdate = false;
      lines.renderOrder = 2;
      mesh.add(lines);
      lines.updateMatrixWorld(true);
      this.lines.push(lines);
    }
  }

  // Depth in place of colours, and back.
  castShadows(is) {
    this.sky.visible = !is;
    for (const each of this.meshes) {
      each.mesh.material = is ? each.depth : each.material;
      each.mesh.layers.set(!is || each.casts ? 0 : 1);
    }
    for (const lines of this.lines ?? []) lines.layers.set(is ? 1 : 0);
    if (this.marks) this.marks.layers.set(is ? 1 : 0), this.marks.traverse(each => each.layers.set(is ? 1 : 0));
  }

  draw(renderer, camera) {
    this.light.uniforms.viewer.value.copy(camera.position);
    this.sky.material.uniforms.world_from_clip.value.multiplyMatrices(camera.matrixWorld, camera.projectionMatrixInverse);
    renderer.render(this.scene, camera);
  }
}
