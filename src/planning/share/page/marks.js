// What is laid over the place: measures as lines with their values, and what differs between two scenarios.
import * as THREE from 'three';

const COLOURS = {added: 0x2f7d4f, removed: 0xb3402e, moved: 0x2f6fa3, changed: 0xb07d1a};

// Lines and values of measures, drawn in the page above the picture.
export class Measures {
  constructor(svg) { this.svg = svg, this.measures = []; }

  show(measures) { this.measures = measures; }

  draw(camera, width, height) {
    const at = new THREE.Vector3(), behind = new THREE.Vector3();
    const seen = point => {
      behind.set(...point).applyMatrix4(camera.matrixWorldInverse);
      at.set(...point).project(camera);
      return behind.z < -0.1 ? [(0.5 + 0.5 * at.x) * width, (0.5 - 0.5 * at.y) * height] : null;
    };
    const text = [];
    for (const {line, at: middle, text: value} of this.measures) {
      const points = line.map(seen), place = seen(middle);
      if (points.includes(null) || !place) continue;
      const path = points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ');
      text.push(`<polyline class="below" points="${path}"/><polyline points="${path}"/>`);
      text.push(`<text x="${place[0].toFixed(1)}" y="${(place[1] - 8).toFixed(1)}"></text>`);
    }
    this.svg.innerHTML = text.join('');
    const values = this.measures.filter(({line, at: middle}) => !line.map(seen).includes(null) && seen(middle));
    this.svg.querySelectorAll('text').forEach((label, i) => { label.textContent = values[i].text; });
  }
}

// The bodies of what differs, in the colours of the table.
export function differenceMarks(items) {
  const group = new THREE.Group();
  for (const {how, outlines} of items)
    for (const {z, height, corners} of outlines) {
      const shape = new THREE.Shape(corners.map(([x, y]) => new THREE.Vector2(x, y)));
      const body = new THREE.ExtrudeGeometry(shape, {depth: Math.max(height, 0.06), bevelEnabled: false});
      body.translate(0, 0, z + 0.04);  // above the ground that it covers
      const mesh = new THREE.Mesh(body, new THREE.MeshBasicMaterial({color: COLOURS[how], transparent: true, opacity: height < 0.2 ? 0.16 : 0.28, depthWrite: false, side: THREE.FrontSide}));
      const lines = new THREE.LineSegments(new THREE.EdgesGeometry(body, 30), new THREE.LineBasicMaterial({color: COLOURS[how], depthTest: false, transparent: true, opacity: 0.9}));
      mesh.renderOrder = 3, lines.renderOrder = 4;
      group.add(mesh, lines);
    }
  group.updateMatrixWorld(true);
  return group;
}
