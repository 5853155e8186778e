// glTF as gltfpack, glTF Transform and three.js write it; see script/written_today.
import {spawnSync} from 'node:child_process';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';

const [modules, folder, given] = process.argv.slice(2);
const require = createRequire(path.join(modules, 'any.js'));
const {Document, NodeIO} = await import(require.resolve('@gltf-transform/core'));
const extensions = await import(require.resolve('@gltf-transform/extensions'));
const {MeshoptDecoder, MeshoptEncoder} = await import(require.resolve('meshoptimizer'));
await MeshoptEncoder.ready;
const draco = require('draco3dgltf');
const io = new NodeIO().registerExtensions(extensions.ALL_EXTENSIONS).registerDependencies({
  'meshopt.decoder': MeshoptDecoder, 'meshopt.encoder': MeshoptEncoder,
  'draco3d.encoder': await draco.createEncoderModule(), 'draco3d.decoder': await draco.createDecoderModule()});
const written = [];
const file = name => { written.push(path.join(folder, name)); return written.at(-1); };

// A bench, a mirrored one, bollards as instances, a hidden one, a lamp and a camera.
function street() {
  const document = new Document(), buffer = document.createBuffer(), scene = document.createScene();
  const box = [0, 1, 2, 3, 4, 5, 6, 7].flatMap(i => [i & 1 ? 1.8 : 0, i & 2 ? 0.45 : 0, i & 4 ? 0.85 : 0]);
  const indices = [0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5];
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const colours = Uint8Array.from({length: 32}, (_, i) => i % 4 === 3 ? 255 : 40 * (i % 7));
  const primitive = document.createPrimitive().setAttribute('POSITION', accessor('VEC3', new Float32Array(box)))
      .setAttribute('COLOR_0', accessor('VEC4', colours).setNormalized(true)).setIndices(accessor('SCALAR', new Uint16Array(indices)));
  const mesh = document.createMesh('box').addPrimitive(primitive);
  scene.addChild(document.createNode('bench').setMesh(mesh));
  scene.addChild(document.createNode('mirrored').setMesh(mesh).setTranslation([-3, 0, 0]).setScale([-1, 1, 1]));
  const instances = document.createExtension(extensions.EXTMeshGPUInstancing).setRequired(true).createInstancedMesh()
      .setAttribute('TRANSLATION', accessor('VEC3', new Float32Array([0, 0, 5, 4, 0, 5, 8, 0, 5])));
  scene.addChild(document.createNode('bollards').setMesh(mesh).setExtension('EXT_mesh_gpu_instancing', instances));
  const hidden = document.createExtension(extensions.KHRNodeVisibility).createVisibility().setVisible(false);
  scene.addChild(document.createNode('hidden').setMesh(mesh).setTranslation([0, 9, 0]).setExtension('KHR_node_visibility', hidden));
  const lights = document.createExtension(extensions.KHRLightsPunctual).setRequired(true);
  scene.addChild(document.createNode('lamp').setExtension('KHR_lights_punctual', lights.createLight('lamp').setType('spot')).setTranslation([0, 4, 0]));
  scene.addChild(document.createNode('eye').setCamera(document.createCamera('eye', 'perspective').setYFov(0.8)));
  return document;
}

async function withTransform() {
  await io.write(file('transform_street.glb'), street());
  const meshopt = street();
  meshopt.createExtension(extensions.EXTMeshoptCompression).setRequired(true)
      .setEncoderOptions({method: extensions.EXTMeshoptCompression.EncoderMethod.QUANTIZE});
  await io.write(file('transform_meshopt.glb'), meshopt);
  const compressed = await io.read(given);
  compressed.createExtension(extensions.KHRDracoMeshCompression).setRequired(true).setEncoderOptions({quantizationVolume: 'scene'});
  await io.write(file('transform_draco.glb'), compressed);
}

function withGltfpack() {
  const street = path.join(folder, 'transform_street.glb');
  for (const [name, from, ...words] of [
    ['pack_saloon.glb', given], ['pack_saloon_c.glb', given, '-c'], ['pack_saloon_cc.glb', given, '-cc'], ['pack_saloon_cz.glb', given, '-cz'],
    ['pack_street.glb', street, '-kn', '-noq'], ['pack_street_instances.glb', street, '-mi', '-c', '-noq'], ['pack_street_float.glb', street, '-vpf', '-cc']]) {
    const done = spawnSync('node', [path.join(modules, 'gltfpack/cli.js'), '-i', from, '-o', path.join(folder, name), ...words], {encoding: 'utf8'});
    if (done.status === 0) file(name);
    else console.error(`gltfpack ${words.join(' ')}: ${(done.stderr || done.stdout).trim().split('\n').at(-1)}`);
  }
}

async function withThree() {
  const three = await import('file://' + path.join(modules, 'three/build/three.module.js')), {GLTFExporter} = await import('file://' + path.join(modules, 'three/examples/jsm/exporters/GLTFExporter.js'));
  globalThis.FileReader ??= class {  // Node has none
    readAsDataURL(blob) { blob.arrayBuffer().then(bytes => { this.result = `data:${blob.type};base64,${Buffer.from(bytes).toString('base64')}`; this.onloadend?.(); }); }
    readAsArrayBuffer(blob) { blob.arrayBuffer().then(result => { this.result = result; this.onloadend?.(); }); }
  };
  const scene = new three.Scene(), plain = new three.MeshStandardMaterial({color: 0x884422, side: three.DoubleSide});
  const torus = new three.Mesh(new three.TorusKnotGeometry(1, 0.3, 64, 12), plain);
  torus.position.set(0, 3, 0), torus.scale.set(-1, 2, 1);
  const posts = new three.InstancedMesh(new three.CylinderGeometry(0.1, 0.1, 1, 9), plain, 4);
  for (let i = 0; i < 4; ++i) posts.setMatrixAt(i, new three.Matrix4().makeTranslation(2 * i, 0.5, 4));
  const line = new three.Line(new three.BufferGeometry().setFromPoints([new three.Vector3(), new three.Vector3(1, 1, 1)]), new three.MeshBasicMaterial());
  scene.add(torus, posts, line, new three.PointLight(0xffffff, 5), new three.PerspectiveCamera(50, 1.5, 0.1, 100));
  scene.updateMatrixWorld(true);
  for (const [name, binary] of [['three.glb', true], ['three.gltf', false]]) {
    const result = await new GLTFExporter().parseAsync(scene, {binary, onlyVisible: true});
    fs.writeFileSync(file(name), binary ? Buffer.from(result) : JSON.stringify(result));
  }
}

for (const write of [withTransform, withGltfpack, withThree])
  try { await write(); } catch (problem) { console.error(`${write.name}: ${problem.message}`); }
console.log(written.join('\n'));
