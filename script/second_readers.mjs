// What other libraries read of model files beside what `parvis export` writes of them; see script/second_readers.
//
// A file is compared object by object. Of formats whose objects Parvis keeps, an object agrees where one of ours has its
// box within 1 mm, and its volume (about the middle of its box, so that it holds for open surfaces) and area within 0.1 %.
// Of cities, whose surfaces Parvis gathers by kind, an object agrees where each of its corners is one of ours within 1 mm;
// all of a file together is one object more, of which area and volume count.
import {spawnSync} from 'node:child_process';
import fs from 'node:fs';
import {createRequire, register} from 'node:module';
import os from 'node:os';
import path from 'node:path';
import zlib from 'node:zlib';

const [modules, parvis, ...rest] = process.argv.slice(2);
const require = createRequire(path.join(modules, 'any.js'));
// One of the libraries is written for bundlers, which complete names of modules.
register('data:text/javascript,' + encodeURIComponent(`export async function resolve(name, context, next) {
  try { return await next(name, context); } catch (problem) { return next(name + '.js', context); } }`));
const library = name => import('file://' + path.join(modules, name));

const LIMIT_M = 1e-3, LIMIT_SHARE = 1e-3;

// Differences that are none of Parvis's reading: part of a path, how many objects at most, and the reason.
const EXPLAINED = [
  ['08-ifc-indexed-outlines', 2, 'a slab and a column with arcs: they are divided into other chords than web-ifc has'],
  ['scenes/pavilion.ifc', 7, 'round columns: 48 chords to a circle, of which web-ifc draws 47'],
  ['ifc/wall.ifc', 1, 'a wall with a round opening: IFC++ divides a circle into other chords than web-ifc'],
  ['scenes/crossroads.osm', 1, 'parts stand in place of the outline of a church'],
  ['scenes/market.osm', 3, 'nodes with eight decimals, the last a 5: libosmium keeps seven and rounds binary fractions otherwise'],
  ['11-osm-deleted', 1, 'osmtogeojson keeps what an editor has deleted'],
];

class Skipped extends Error {}

// ---- measures of triangles

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// Triangles with a name, z up.
class Shape {
  constructor(name) { this.name = name; this.corners = []; }  // three a triangle
  add(...corners) { this.corners.push(...corners); }
  get triangles() { return this.corners.length / 3; }
  box() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const p of this.corners)
      for (let k = 0; k < 3; ++k) low[k] = Math.min(low[k], p[k]), high[k] = Math.max(high[k], p[k]);
    return {low, high};
  }
  measures() {
    const {low, high} = this.box(), middle = low.map((value, k) => (value + high[k]) / 2);
    let volume = 0, area = 0;
    for (let i = 0; i + 2 < this.corners.length; i += 3) {
      const [a, b, c] = this.corners.slice(i, i + 3).map(corner => minus(corner, middle));
      const normal = cross(minus(b, a), minus(c, a));
      area += Math.sqrt(dot(normal, normal)) / 2, volume += dot(a, normal) / 6;
    }
    return {name: this.name, low, high, volume, area, triangles: this.triangles};
  }
}

// By name, in the order of first mention.
class Shapes {
  constructor() { this.all = new Map(); }
  of(name) {
    if (!this.all.has(name)) this.all.set(name, new Shape(name));
    return this.all.get(name);
  }
  list() { return [...this.all.values()].filter(shape => shape.triangles > 0); }
}

const fromYUp = p => [p[0], -p[2], p[1]];

// ---- readers: each gives {shapes, kinds: {what the file holds: count}}

async function gltfIo() {
  const {NodeIO} = await library('@gltf-transform/core/dist/index.modern.js').catch(() => import(require.resolve('@gltf-transform/core')));
  const {ALL_EXTENSIONS} = await import(require.resolve('@gltf-transform/extensions'));
  const {MeshoptDecoder} = await import(require.resolve('meshoptimizer'));
  return new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
    'draco3d.decoder': await require('draco3dgltf').createDecoderModule(), 'meshopt.decoder': MeshoptDecoder});
}

const applied = (m, p) => [0, 1, 2].map(k => m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k]);
const product = (a, b) => Array.from({length: 16}, (_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[k * 4 + i % 4] * b[(i >> 2) * 4 + k], 0));
const turns = m => dot(cross(m.slice(0, 3), m.slice(4, 7)), m.slice(8, 11)) < 0;
function placed(t, [x, y, z, w], s) {
  const columns = [[1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)], [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
                   [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)]];
  return [...columns.flatMap((column, k) => [...column.map(value => value * s[k]), 0]), ...t, 1];
}

function trianglesOf(primitive) {
  const indices = primitive.getIndices()?.getArray() ?? Array.from({length: primitive.getAttribute('POSITION').getCount()}, (_, i) => i);
  const mode = primitive.getMode(), found = [];
  if (mode === 4) for (let i = 0; i + 2 < indices.length; i += 3) found.push([indices[i], indices[i + 1], indices[i + 2]]);
  const restart = {1: 255, 2: 65535, 4: 0xffffffff}[indices.BYTES_PER_ELEMENT];
  let run = [];
  const finish = () => {
    for (let i = 0; i + 2 < run.length; ++i)
      found.push(mode === 6 ? [run[0], run[i + 1], run[i + 2]] : i % 2 ? [run[i + 1], run[i], run[i + 2]] : [run[i], run[i + 1], run[i + 2]]);
    run = [];
  };
  if (mode > 4) { for (const index of indices) index === restart ? finish() : run.push(index); finish(); }
  return found;
}

// glTF Transform knows the older name of a compression alone, whose content its decoder reads in both.
function renamed(file) {
  const [from, to] = ['KHR_meshopt_compression', 'EXT_meshopt_compression'], bytes = fs.readFileSync(file);
  if (!bytes.includes(from) || path.extname(file) !== '.glb') return file;
  for (let at = bytes.indexOf(from); at >= 0; at = bytes.indexOf(from)) bytes.write(to, at);
  const copy = path.join(os.tmpdir(), `parvis-renamed-${process.pid}.glb`);
  fs.writeFileSync(copy, bytes);
  process.once('exit', () => fs.rmSync(copy, {force: true}));
  return copy;
}

// `nameOf(node, primitive)` groups the triangles.
async function readGltf(file, nameOf = node => node) {
  const document = await (await gltfIo()).read(renamed(file)), root = document.getRoot(), shapes = new Shapes();
  const scene = root.getDefaultScene() ?? root.listScenes()[0];
  const visit = (node, isVisible) => {
    isVisible &&= node.getExtension('KHR_node_visibility')?.getVisible() ?? true;
    const mesh = node.getMesh(), skin = node.getSkin(), world = [...node.getWorldMatrix()];
    const instances = node.getExtension('EXT_mesh_gpu_instancing'), places = [];
    if (instances) {
      const value = (name, i, otherwise) => instances.getAttribute(name)?.getElement(i, []) ?? otherwise;
      const count = Math.max(...instances.listAttributes().map(attribute => attribute.getCount()));
      for (let i = 0; i < count; ++i)
        places.push(product(world, placed(value('TRANSLATION', i, [0, 0, 0]), value('ROTATION', i, [0, 0, 0, 1]), value('SCALE', i, [1, 1, 1]))));
    } else {
      places.push(world);
    }
    const joints = skin?.listJoints().map((joint, i) => product([...joint.getWorldMatrix()], skin.getInverseBindMatrices()
        ? skin.getInverseBindMatrices().getElement(i, []) : placed([0, 0, 0], [0, 0, 0, 1], [1, 1, 1])));
    for (const [place, matrix] of places.entries())
      for (const primitive of isVisible && mesh ? mesh.listPrimitives() : []) {
        if (primitive.getMode() < 4) continue;
        const position = primitive.getAttribute('POSITION'), weights = primitive.getAttribute('WEIGHTS_0'), bones = primitive.getAttribute('JOINTS_0');
        const morphs = primitive.listTargets().map((target, i) => [target.getAttribute('POSITION'), (node.getWeights().length ? node.getWeights() : mesh.getWeights())[i] ?? 0]);
        const points = Array.from({length: position.getCount()}, (_, i) => {
          const p = position.getElement(i, []);
          for (const [moves, weight] of morphs) if (moves && weight) moves.getElement(i, []).forEach((value, k) => { p[k] += weight * value; });
          if (!joints || !weights || !bones) return fromYUp(applied(matrix, p));
          const w = weights.getElement(i, []), b = bones.getElement(i, []), sum = w.reduce((a, c) => a + c, 0) || 1;
          return fromYUp([0, 1, 2].map(k => w.reduce((total, weight, n) => total + weight / sum * (weight ? applied(joints[b[n]], p)[k] : 0), 0)));
        });
        const shape = shapes.of(nameOf(`${root.listNodes().indexOf(node)} ${place}`, primitive));
        const turned = !joints && turns(matrix);
        for (const [a, b, c] of trianglesOf(primitive)) turned ? shape.add(points[a], points[c], points[b]) : shape.add(points[a], points[b], points[c]);
      }
    node.listChildren().forEach(child => visit(child, isVisible));
  };
  scene?.listChildren().forEach(node => visit(node, true));
  const json = gltfJson(file), primitives = (json.meshes ?? []).flatMap(mesh => mesh.primitives);
  return {shapes: shapes.list(), kinds: {
    cameras: json.cameras?.length ?? 0, lights: json.extensions?.KHR_lights_punctual?.lights?.length ?? 0, animations: json.animations?.length ?? 0,
    extensions: json.extensionsUsed?.length ?? 0, primitives: primitives.length}};
}

function gltfJson(file) {
  const bytes = fs.readFileSync(file);
  return JSON.parse(bytes.subarray(0, 4).toString() === 'glTF' ? bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString() : bytes.toString());
}

async function readObj(file) {
  const Parser = require('obj-file-parser'), text = fs.readFileSync(file, 'utf8').replace(/\\\r?\n/g, ' ');
  const models = new Parser(text).parse().models, shapes = new Shapes(), vertices = models.flatMap(model => model.vertices);
  for (const model of models)
    for (const face of model.faces) {
      const points = face.vertices.map(({vertexIndex: i}) => vertices[i > 0 ? i - 1 : vertices.length + i]).map(p => [p.x, p.y, p.z]);
      for (let i = 1; i + 1 < points.length; ++i) shapes.of('all').add(points[0], points[i], points[i + 1]);
    }
  return {shapes: shapes.list(), kinds: {statements: (text.match(/^\s*(l|p|curv2?|surf)\s/gm) ?? []).length}, isYUp: true};
}

async function threeMesh(loader, file) {
  const {[loader]: Loader} = await library(`three/examples/jsm/loaders/${loader}.js`);
  const bytes = fs.readFileSync(file), geometry = new Loader().parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  const position = geometry.getAttribute('position'), shapes = new Shapes(), index = geometry.getIndex();
  const point = i => [position.getX(i), position.getY(i), position.getZ(i)], corner = i => point(index ? index.getX(i) : i);
  const isMesh = index || loader === 'STLLoader', count = isMesh ? (index ?? position).count : 0;
  for (let i = 0; i + 2 < count; i += 3) shapes.of('all').add(corner(i), corner(i + 1), corner(i + 2));
  return {shapes: shapes.list(), kinds: {}};
}

async function readVrml(file) {
  const {VRMLLoader} = await library('three/examples/jsm/loaders/VRMLLoader.js'), shapes = new Shapes();
  // Three.js asks browsers for pictures; other libraries take such a document for a browser.
  globalThis.document = {createElementNS: () => ({addEventListener() {}, removeEventListener() {}, style: {}})};
  const scene = new VRMLLoader().parse(fs.readFileSync(file, 'utf8'), path.dirname(file) + '/');
  delete globalThis.document;
  scene.updateMatrixWorld(true);
  scene.traverse(object => {
    if (!object.isMesh) return;
    const position = object.geometry.getAttribute('position'), index = object.geometry.getIndex(), m = object.matrixWorld.elements;
    const corner = i => { const k = index ? index.getX(i) : i; return fromYUp(applied(m, [position.getX(k), position.getY(k), position.getZ(k)])); };
    for (let i = 0; i + 2 < (index ?? position).count; i += 3) shapes.of('all').add(corner(i), corner(i + 1), corner(i + 2));
  });
  return {shapes: shapes.list(), kinds: {}};
}

async function readIfc(file) {
  const web = require('web-ifc'), api = new web.IfcAPI(), shapes = new Shapes(), kinds = {};
  api.SetWasmPath(path.join(modules, 'web-ifc') + '/', true);
  await api.Init();
  api.SetLogLevel(web.LogLevel.LOG_LEVEL_OFF);
  const model = api.OpenModel(fs.readFileSync(file), {CIRCLE_SEGMENTS: 48, COORDINATE_TO_ORIGIN: false});
  if (model < 0) throw new Skipped('web-ifc cannot open it');
  const text = fs.readFileSync(file, 'latin1'), ratios = api.GetLineIDsWithType(model, web.IFCGEOMETRICREPRESENTATIONCONTEXT);
  const north = ratios.size() && !/IFCMAPCONVERSION/.test(text) ? api.GetLine(model, ratios.get(0), true).TrueNorth?.DirectionRatios?.map(r => Number(r.value ?? r)) : null;
  const [nx, ny] = north ? north.map(value => value / Math.hypot(north[0], north[1])) : [0, 1];  // true north becomes y
  const turned = ([x, y, z]) => [ny * x - nx * y, nx * x + ny * y, z];
  const unbuilt = /^Ifc(Space|OpeningElement|OpeningStandardCase|Annotation|Grid|VirtualElement)$/i;
  api.StreamAllMeshes(model, mesh => {
    const line = api.GetLine(model, mesh.expressID), kind = api.GetNameFromTypeCode(line.type);
    if (unbuilt.test(kind)) return;
    kinds[kind] = (kinds[kind] ?? 0) + 1;
    for (let g = 0; g < mesh.geometries.size(); ++g) {
      const {geometryExpressID, flatTransformation} = mesh.geometries.get(g), geometry = api.GetGeometry(model, geometryExpressID);
      const vertices = api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
      const indices = api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize());
      const corner = i => turned(fromYUp(applied(flatTransformation, vertices.subarray(6 * indices[i], 6 * indices[i] + 3))));
      for (let i = 0; i + 2 < indices.length; i += 3) shapes.of(`#${mesh.expressID}`).add(corner(i), corner(i + 1), corner(i + 2));
    }
  });
  return {shapes: shapes.list(), kinds, isCity: true};
}

function cityJson(file) {
  const json = JSON.parse(fs.readFileSync(file, 'utf8'));
  const level = lod => Number(lod ?? 0);
  // Of each object the highest level alone, as Parvis shows it; that of templates counts, too.
  for (const object of Object.values(json.CityObjects)) {
    const lodOf = geometry => level(geometry.lod ?? json['geometry-templates']?.templates[geometry.template]?.lod);
    const highest = Math.max(...(object.geometry ?? []).map(lodOf));
    object.geometry = (object.geometry ?? []).filter(geometry => lodOf(geometry) === highest);
  }
  return json;
}

async function readCityJson(file) {
  const json = cityJson(file), shapes = new Shapes(), base = 'cityjson-threejs-loader/src/parsers/geometry/';
  const {TriangleParser} = await library(base + 'TriangleParser.js');
  const scale = json.transform?.scale ?? [1, 1, 1], shift = json.transform?.translate ?? [0, 0, 0], ids = Object.keys(json.CityObjects);
  const metric = p => p.map((value, k) => value * scale[k] + shift[k]);
  const templates = json['geometry-templates'];
  for (const id of ids)
    for (const geometry of json.CityObjects[id].geometry) {
      const isPlaced = geometry.type === 'GeometryInstance';
      const parser = new TriangleParser(json, ids, {}, isPlaced ? templates['vertices-templates'] : json.vertices.map(metric));
      parser.parseGeometry(isPlaced ? templates.templates[geometry.template] : geometry, id, 0);
      const m = geometry.transformationMatrix, at = isPlaced ? metric(json.vertices[geometry.boundaries[0]]) : [0, 0, 0];
      const corner = i => {
        const p = parser.vertices[i];
        return isPlaced ? [0, 1, 2].map(k => m[4 * k] * p[0] + m[4 * k + 1] * p[1] + m[4 * k + 2] * p[2] + m[4 * k + 3] + at[k]) : p;
      };
      const indices = parser.geomData.vertexIds;
      for (let i = 0; i + 2 < indices.length; i += 3) shapes.of(id).add(...[i, i + 1, i + 2].map(k => corner(indices[k])));
    }
  return {shapes: shapes.list(), kinds: {'city objects': ids.length}, isCity: true};
}

// Corners of polygons that a feature of WKT has; triangles would need a library more.
function addPolygons(shape, wkt) {
  for (const [ring] of wkt.matchAll(/\([-\d][^()]*\)/g)) {
    const points = ring.slice(1, -1).split(',').map(point => point.trim().split(' ').map(Number)).filter(point => point.length === 3);
    for (const point of points) shape.add(point, point, point);
  }
}

async function readGml(file, folder) {
  const copy = path.join(folder, 'copy.gml'), out = path.join(folder, 'gml'), shapes = new Shapes();
  fs.copyFileSync(file, copy);
  fs.rmSync(copy.replace('.gml', '.gfs'), {force: true}), fs.rmSync(out, {recursive: true, force: true});
  const done = spawnSync('ogr2ogr', ['-f', 'CSV', '-lco', 'GEOMETRY=AS_WKT', out, copy], {encoding: 'utf8'});
  if (done.error) throw new Skipped('ogr2ogr is not installed');
  if (/Shell/.test(done.stderr)) throw new Skipped('GDAL knows no Shell of GML 3.2');
  const tables = fs.existsSync(out) ? fs.statSync(out).isDirectory() ? fs.readdirSync(out).map(name => path.join(out, name)) : [out] : [];
  for (const table of tables)
    fs.readFileSync(table, 'utf8').split('\n').slice(1).forEach((line, i) => {
      const wkt = /^"((?:MULTI)?POLY[^"]*)"/.exec(line);
      if (wkt) addPolygons(shapes.of(`${path.basename(table)} ${i}`), wkt[1]);
    });
  if (shapes.list().length === 0) throw new Skipped('GDAL finds no polygons');
  return {shapes: shapes.list(), kinds: {}, isCity: true, isPart: true};
}

// Outlines of buildings, in plan.
async function readOsm(file) {
  const {DOMParser} = require('xmldom'), toGeojson = require('osmtogeojson'), shapes = new Shapes();
  const features = toGeojson(new DOMParser().parseFromString(fs.readFileSync(file, 'utf8'), 'text/xml')).features
      .filter(({properties: {tags}, geometry}) => tags?.building && tags.building !== 'no' && tags.area !== 'no' && /Polygon$/.test(geometry.type));
  const rings = features.flatMap(({id, geometry}) => (geometry.type === 'Polygon' ? [geometry.coordinates] : geometry.coordinates).flat().map(ring => [id, ring]));
  // OpenStreetMap has seven decimals, of which libosmium keeps no more; corners on a straight side are none.
  const rounded = ring => ring.slice(1).map(point => point.map(value => Math.round(1e7 * value) / 1e7));
  const isCorner = (point, i, ring) => {
    const [a, b] = [ring.at(i - 1), ring[(i + 1) % ring.length]], [u, v] = [minus([...point, 0], [...a, 0]), minus([...b, 0], [...a, 0])];
    return Math.abs(u[0] * v[1] - u[1] * v[0]) > 2e-7 * Math.hypot(...v);
  };
  const points = rings.flatMap(([id, ring]) => rounded(ring).filter(isCorner).map(([east, north]) => [id, east, north]));
  if (points.length === 0) return {shapes: [], kinds: {}, isCity: true, isPart: true};
  const [east, north] = [1, 2].map(k => points.reduce((sum, point) => sum + point[k], 0) / points.length);
  const zone = Math.floor((east + 180) / 6) + 1, system = `EPSG:${(north < 0 ? 32700 : 32600) + zone}`;
  const done = spawnSync('gdaltransform', ['-s_srs', 'OGC:CRS84', '-t_srs', system, '-output_xy'],
                         {encoding: 'utf8', input: points.map(point => `${point[1]} ${point[2]}`).join('\n'), maxBuffer: 1 << 28});
  if (done.error) throw new Skipped('gdaltransform is not installed');
  done.stdout.trim().split('\n').forEach((line, i) => {
    const corner = [...line.split(' ').map(Number), 0];
    shapes.of(points[i][0]).add(corner, corner, corner);
  });
  return {shapes: shapes.list(), kinds: {}, isCity: true, isPart: true, isPlan: true};
}

const UNITS = {9001: 1, 9002: 0.3048, 9003: 1200 / 3937};

async function readTiff(file) {
  const {fromArrayBuffer} = require('geotiff'), bytes = fs.readFileSync(file), shapes = new Shapes();
  const image = await (await fromArrayBuffer(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length))).getImage();
  const keys = image.getGeoKeys() ?? {}, [heights] = await image.readRasters(), width = image.getWidth(), height = image.getHeight();
  if (keys.GTModelTypeGeoKey !== 1) throw new Skipped('geotiff knows no projection of degrees');
  if (image.fileDirectory.actualizedFields?.has?.('GDAL_NODATA') || image.getGDALNoData() !== null) throw new Skipped('holes are left to Parvis');
  const xml = await image.getGDALMetadata(0) ?? {}, unitText = String(xml.UNITTYPE ?? '');
  const feet = /us survey/i.test(unitText) ? UNITS[9003] : /f(oo|ee)?t/i.test(unitText) ? UNITS[9002] : 1;
  const up = feet * (UNITS[keys.VerticalUnitsGeoKey] ?? 1), plan = UNITS[keys.ProjLinearUnitsGeoKey] ?? (keys.ProjectedCSTypeGeoKey === 2263 ? UNITS[9003] : 1);
  const [x0, y0] = image.getOrigin(), [dx, dy] = image.getResolution(), half = keys.GTRasterTypeGeoKey === 2 ? 0 : 0.5;
  const point = (i, j) => [plan * (x0 + (i + half) * dx), plan * (y0 + (j + half) * dy), up * heights[j * width + i]];
  for (let j = 0; j + 1 < height; ++j)
    for (let i = 0; i + 1 < width; ++i) {
      const [a, b, c, d] = [point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j)];
      shapes.of('all').add(a, b, c), shapes.of('all').add(a, c, d);
    }
  return {shapes: shapes.list(), kinds: {samples: width * height}, isCity: true};
}

const READERS = {'.gltf': file => readGltf(file), '.glb': file => readGltf(file), '.obj': readObj, '.ply': file => threeMesh('PLYLoader', file), '.stl': file => threeMesh('STLLoader', file),
                 '.wrl': readVrml, '.ifc': readIfc, '.gml': readGml, '.osm': readOsm, '.json': readCityJson, '.cityjson': readCityJson, '.tif': readTiff};

// ---- Parvis

function run(...words) {
  const done = spawnSync(parvis, words, {encoding: 'utf8', maxBuffer: 1 << 28});
  if (done.status !== 0) throw new Error((done.stderr || 'no message').trim().split('\n').at(-1));
  return done;
}

// Each file has a folder of its own: what one leaves there must not be read for another.
async function readOurs(file, parent) {
  const folder = fs.mkdtempSync(path.join(parent, 'ours-')), scene = path.join(folder, 'one.xp'), out = path.join(folder, 'one.glb');
  const up = /\.(wrl|iv)$/.test(file) ? ', up="y"' : '';
  fs.writeFileSync(scene, `model(name="thing", file="${path.basename(file)}"${up})\n`);
  const data = ['--data', path.dirname(path.resolve(file))];
  run('export', scene, ...data, '-o', out);
  const accounts = JSON.parse(run('check', scene, ...data, '--json').stdout);
  const {shapes} = await readGltf(out, (node, primitive) => `${node} ${primitive.getExtras().object}`);
  return {shapes, lines: accounts.flatMap(account => account.lines), accounts: accounts.length};
}

// ---- comparison

function boxesAgree(a, b, shift) {
  return ['low', 'high'].every(end => [0, 1, 2].every(k => Math.abs(a[end][k] - b[end][k] - shift[k]) <= LIMIT_M));
}
const near = (a, b, least) => Math.abs(a - b) <= LIMIT_SHARE * Math.max(Math.abs(a), Math.abs(b), least);

function whole(shapes) {
  const all = new Shape('all together');
  for (const shape of shapes) for (const corner of shape.corners) all.corners.push(corner);
  return all.measures();
}

// Ours are about a local origin of whole metres where the coordinates are those of a grid.
function originOf(theirs, ours) {
  return [0, 1, 2].map(k => { const shift = Math.round(theirs.low[k] - ours.low[k]); return Math.abs(shift) > 1 ? shift : 0; });
}

function sameMeasures(a, b, shift) {
  const size = a.high.map((value, k) => value - a.low[k]), bulk = Math.max(size[0] * size[1] * size[2], 1e-9);
  return boxesAgree(a, b, shift) && near(a.area, b.area, 1e-9) && near(a.volume, b.volume, 0.01 * bulk);
}

function compareObjects(theirs, ours) {
  const shift = originOf(whole(theirs), whole(ours)), left = ours.map(shape => shape.measures());
  const missing = [];
  for (const shape of theirs) {
    const one = shape.measures(), at = left.findIndex(other => sameMeasures(one, other, shift));
    at < 0 ? missing.push(one) : left.splice(at, 1);
  }
  // What one reader keeps apart the other may gather: then both together have to agree.
  if (missing.length > 0 && sameMeasures(whole(theirs), whole(ours), shift)) {
    const restOfOurs = new Set(left.map(one => one.name));
    const remaining = theirs.filter(shape => missing.some(one => one.name === shape.name)), others = ours.filter(shape => restOfOurs.has(shape.name));
    if (others.length > 0 && sameMeasures(whole(remaining), whole(others), shift)) return [];
  }
  return missing;
}

function compareCorners({shapes: theirs, isPart, isPlan}, ours) {
  if (theirs.length === 0) return [];
  const all = whole(theirs), ourAll = whole(ours), cells = new Set();
  let shift = originOf(all, ourAll);
  if (isPart) shift = shiftOfParts(theirs, ours, isPlan);
  const key = p => p.slice(0, isPlan ? 2 : 3).map(value => Math.round(value / LIMIT_M)).join(' ');
  for (const shape of ours)
    for (const p of shape.corners)
      for (let n = 0; n < 27; ++n) cells.add(key([p[0] + (n % 3 - 1) * LIMIT_M, p[1] + (Math.floor(n / 3) % 3 - 1) * LIMIT_M, p[2] + (Math.floor(n / 9) - 1) * LIMIT_M]));
  const lost = shape => shape.corners.find(p => !cells.has(key(minus(p, shift))));
  const missing = theirs.filter(lost).map(shape => ({...shape.measures(), corner: minus(lost(shape), shift)}));
  if (!isPart && !sameMeasures(all, ourAll, shift)) missing.push(all);
  return missing;
}

// Of a file of which the second reader has a part: the whole metres that bring most corners together.
function shiftOfParts(theirs, ours, isPlan) {
  const fraction = value => value - Math.floor(value), cell = value => Math.round(fraction(value) / LIMIT_M) % 1000, places = new Map();
  const known = new Set();
  for (const shape of ours) for (const p of shape.corners) {
    const spot = p.map(value => value.toFixed(3)).slice(0, isPlan ? 2 : 3).join(' '), key = `${cell(p[0])} ${cell(p[1])}`;
    if (known.has(spot)) continue;
    known.add(spot);
    places.set(key, [...places.get(key) ?? [], p]);
  }
  const votes = new Map();
  for (const shape of theirs.slice(0, 50))
    for (const p of shape.corners.slice(0, 60))
      for (const dx of [-1, 0, 1]) for (const dy of [-1, 0, 1])
        for (const other of places.get(`${(cell(p[0]) + dx + 1000) % 1000} ${(cell(p[1]) + dy + 1000) % 1000}`) ?? []) {
          const shift = [0, 1, 2].map(k => isPlan && k === 2 ? 0 : Math.round(p[k] - other[k])).join(' ');
          votes.set(shift, (votes.get(shift) ?? 0) + 1);
        }
  const best = [...votes].sort((a, b) => b[1] - a[1])[0];
  return best ? best[0].split(' ').map(Number) : [0, 0, 0];
}

// Things of a kind that neither a picture shows nor the account names.
function unnamed(kinds, lines) {
  const lost = [];
  for (const [kind, count] of Object.entries(kinds)) {
    const told = lines.filter(line => line.kind.toLowerCase().startsWith(kind.toLowerCase())).reduce((sum, line) => sum + line.count, 0);
    if (told < count) lost.push(`${count - told} of ${count} ${kind}`);
  }
  return lost;
}

const CONTROLS = {
  // Half of each of our objects is lost, and the account says nothing.
  loss: ours => ({...ours, shapes: ours.shapes.map(shape => Object.assign(new Shape(shape.name), {corners: shape.corners.slice(3 * Math.ceil(shape.triangles / 2))})), lines: []}),
  // Ours are a tenth of a percent larger in height, as in another unit of feet; 5 mm at least.
  size: ours => ({...ours, shapes: ours.shapes.map(shape => Object.assign(new Shape(shape.name), {corners: shape.corners.map(p => [p[0], p[1], 1.001 * p[2] + 5e-3])}))}),
};

async function main() {
  const option = name => { const at = rest.indexOf(name); return at < 0 ? undefined : rest.splice(at, 2)[1]; };
  const json = option('--json'), control = CONTROLS[option('--control')];
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'parvis-second-')), figures = {files: 0, objects: 0, agree: 0, explained: 0, silent: 0, without_account: 0};
  const rows = [];
  for (const file of rest) {
    const row = {file, objects: 0, missing: [], unnamed: [], note: ''};
    try {
      const reader = READERS[path.extname(file).toLowerCase()];
      if (!reader) throw new Skipped('no second reader');
      let theirs;
      try { theirs = await reader(file, folder); } catch (problem) { throw new Skipped(`its second reader: ${problem.message ?? problem}`); }
      let ours;
      try {
        ours = await readOurs(file, folder);
      } catch (problem) {
        // A cloud of points is no surface for either; that it is refused is said.
        if (theirs.shapes.length > 0 || !/no triangles/.test(problem.message)) throw problem;
        throw new Skipped(`neither reader finds a surface: ${problem.message}`);
      }
      // Parvis takes a y that is a northing for one, and says so.
      if (theirs.isYUp && !ours.lines.some(line => line.kind === 'axes'))
        for (const shape of theirs.shapes) shape.corners = shape.corners.map(fromYUp);
      if (control) ours = control(ours);
      if (ours.accounts === 0 || ours.lines.length === 0) ++figures.without_account;
      row.missing = theirs.isCity ? compareCorners(theirs, ours.shapes) : compareObjects(theirs.shapes, ours.shapes);
      row.objects = theirs.shapes.length + (theirs.isCity && !theirs.isPart ? 1 : 0);
      row.unnamed = unnamed(theirs.kinds, ours.lines);
      const reason = EXPLAINED.find(([part, most]) => file.includes(part) && row.missing.length > 0 && row.missing.length <= most)?.[2];
      row.note = reason ?? '';
      ++figures.files, figures.objects += row.objects;
      figures.agree += row.objects - row.missing.length;
      if (reason) figures.explained += row.missing.length;
      // That coordinates are given about another origin explains no object that is not there.
      const isNamed = ours.lines.some(line => line.fate === 'left out' || (line.fate === 'changed' && !['coordinates', 'axes'].includes(line.kind)));
      if (!reason && !isNamed) figures.silent += row.missing.length;
      figures.silent += row.unnamed.length;
    } catch (problem) {
      row.note = `skipped: ${problem.message}`;
      if (!(problem instanceof Skipped)) row.note = `REFUSED: ${problem.message}`, ++figures.silent;
    }
    rows.push(row);
    console.log(`${file}: ${row.objects - row.missing.length} of ${row.objects} agree${row.note ? ` (${row.note})` : ''}`);
    for (const one of row.missing.slice(0, 4))
      console.log(`    "${one.name}" ${one.low.map(v => v.toFixed(3))} .. ${one.high.map(v => v.toFixed(3))}, ${one.volume.toFixed(4)} m3, ${one.area.toFixed(4)} m2, ${one.triangles} triangles${one.corner ? `, without ${one.corner.map(v => v.toFixed(3))}` : ''}`);
    for (const kind of row.unnamed) console.log(`    not named: ${kind}`);
  }
  fs.rmSync(folder, {recursive: true});
  figures.agree_percent = figures.objects ? 100 * figures.agree / figures.objects : 0;
  console.log(Object.entries(figures).map(([key, value]) => `${key} ${Math.round(1000 * value) / 1000}`).join(', '));
  if (json) fs.writeFileSync(json, JSON.stringify({figures, rows}));
  process.exitCode = figures.silent > 0 || figures.agree + figures.explained < figures.objects ? 1 : 0;
}

await main();
