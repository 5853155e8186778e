// The visitor's eye: walking on the ground, circling round the place, flying to a saved view; by mouse, fingers and keys.
import * as THREE from 'three';
import {acceleratedRaycast, MeshBVH} from 'three-mesh-bvh';

const EYE_M = 1.7, STEP_M = 0.6, BODY_M = 0.3, WALK_M_S = 2.2, TURN_S = 1.4, FLIGHT_MS = 1200;
const up = new THREE.Vector3(0, 0, 1);

export class Traveller {
  constructor(place, camera, element, changed) {
    Object.assign(this, {place, camera, element, changed});
    this.isWalking = false;
    this.target = new THREE.Vector3();
    this.keys = new Set();
    this.fingers = new Map();
    this.stick = new THREE.Vector2();  // of the pad on touch screens
    this.ray = new THREE.Raycaster();
    this.ray.firstHitOnly = true;
    camera.up.copy(up);
    element.addEventListener('pointerdown', event => this.press(event));
    element.addEventListener('pointermove', event => this.drag(event));
    for (const end of ['pointerup', 'pointercancel']) element.addEventListener(end, event => this.fingers.delete(event.pointerId));
    element.addEventListener('wheel', event => { event.preventDefault(), this.zoom(Math.exp(0.0012 * event.deltaY)); }, {passive: false});
    element.addEventListener('keydown', event => this.key(event, true));
    window.addEventListener('keyup', event => this.keys.delete(event.key.toLowerCase()));
    window.addEventListener('blur', () => this.keys.clear());
  }

  get heading() { const d = this.camera.getWorldDirection(new THREE.Vector3()); return Math.atan2(d.y, d.x); }

  look(heading, pitch) {
    const flat = Math.cos(pitch);
    this.camera.lookAt(this.camera.position.clone().add(new THREE.Vector3(flat * Math.cos(heading), flat * Math.sin(heading), Math.sin(pitch))));
  }

  // A saved view, at once or by a flight.
  goTo(view, isAtOnce) {
    const position = new THREE.Vector3(...view.position), forward = new THREE.Vector3(...view.forward);
    const end = this.camera.clone();
    end.position.copy(position), end.lookAt(position.clone().add(forward));
    this.flight = {from: this.camera.position.clone(), to: position, turn: this.camera.quaternion.clone(), end: end.quaternion.clone(),
                   began: isAtOnce ? -Infinity : performance.now()};
    this.camera.fov = view.fovDeg;
    this.camera.updateProjectionMatrix();
    this.aimAhead(position, forward);
    this.step(performance.now(), 0);
    this.changed();
  }

  // The point that is circled: what lies ahead, or the middle of the place.
  aimAhead(position, forward) {
    const hit = this.nearest(position, forward, 400);
    this.target.copy(hit ? hit.point : position.clone().addScaledVector(forward, 30));
  }

  prepare() {
    if (this.solids) return;
    this.solids = this.place.meshes.filter(({casts, material}) => casts && !material.defines.HAS_HOLES && !material.defines.HAS_OPENNESS).map(({mesh}) => mesh);
    for (const mesh of this.solids) {
      mesh.geometry.boundsTree ??= new MeshBVH(mesh.geometry);
      mesh.raycast = acceleratedRaycast;
    }
  }

  nearest(from, direction, far) {
    this.prepare();
    this.ray.set(from, direction);
    this.ray.near = 0, this.ray.far = far;
    const isShown = mesh => { for (let each = mesh; each; each = each.parent) if (!each.visible) return false; return true; };
    return this.ray.intersectObjects(this.solids.filter(isShown), false)[0];
  }

  setWalking(is) {
    this.isWalking = is;
    this.flight = null;
    if (is) {
      const {camera} = this, direction = camera.getWorldDirection(new THREE.Vector3());
      // From above: to where the view points; from eye height: where one is.
      const ground = this.groundBelow(camera.position, camera.position.z + 1);
      if (ground === null || camera.position.z - ground > 3) {
        const hit = this.nearest(camera.position, direction, 1000), lands = hit && this.groundBelow(hit.point, hit.point.z + 0.5);
        if (hit && lands !== null) camera.position.set(hit.point.x - 4 * direction.x, hit.point.y - 4 * direction.y, 0);
      }
      const below = this.groundBelow(camera.position, 1e4);
      camera.position.z = (below ?? 0) + EYE_M;
      this.look(this.heading, 0);
    } else this.aimAhead(this.camera.position, this.camera.getWorldDirection(new THREE.Vector3()));
    this.changed();
  }

  // Height of the ground below a point, from a height down; null: there is none.
  groundBelow(at, from) {
    const hit = this.nearest(new THREE.Vector3(at.x, at.y, Math.min(from, this.place.bounds.max.z + 1)), new THREE.Vector3(0, 0, -1), 1e5);
    return hit ? hit.point.z : null;
  }

  // One step on the ground: up a stair, not through a wall, not off an edge.
  walk(way) {
    const {camera} = this, length = way.length();
    if (length < 1e-6) return;
    const direction = way.clone().divideScalar(length);
    const knee = camera.position.clone().setZ(camera.position.z - EYE_M + STEP_M + 0.05);
    for (const from of [knee, camera.position])
      if (this.nearest(from, direction, length + BODY_M)) return;
    const next = camera.position.clone().add(way), ground = this.groundBelow(next, camera.position.z - EYE_M + STEP_M);
    if (ground === null || camera.position.z - EYE_M - ground > 4) return;
    camera.position.set(next.x, next.y, ground + EYE_M);
  }

  press(event) {
    this.element.focus({preventScroll: true});
    this.element.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, {x: event.clientX, y: event.clientY, isPan: event.button !== 0 || event.shiftKey});
    this.flight = null;
  }

  drag(event) {
    const finger = this.fingers.get(event.pointerId);
    if (!finger) return;
    const dx = event.clientX - finger.x, dy = event.clientY - finger.y;
    const others = [...this.fingers.entries()].filter(([id]) => id !== event.pointerId).map(([, each]) => each);
    if (others.length > 0) {
      const before = Math.hypot(finger.x - others[0].x, finger.y - others[0].y);
      const after = Math.hypot(event.clientX - others[0].x, event.clientY - others[0].y);
      if (before > 10 && after > 10) this.zoom(before / after);
      this.pan(0.5 * dx, 0.5 * dy);
    } else if (finger.isPan) this.pan(dx, dy);
    else this.turn(-dx, -dy);
    finger.x = event.clientX, finger.y = event.clientY;
    this.changed();
  }

  // By pixels.
  turn(dx, dy) {
    const angle = this.camera.fov * Math.PI / 180 / this.element.clientHeight, direction = this.camera.getWorldDirection(new THREE.Vector3());
    if (this.isWalking) {
      const pitch = Math.asin(direction.z);
      this.look(this.heading - dx * angle, Math.min(Math.max(pitch - dy * angle, -1.3), 1.3));
      return;
    }
    const around = new THREE.Spherical(), offset = this.camera.position.clone().sub(this.target);
    around.setFromVector3(new THREE.Vector3(offset.x, offset.z, -offset.y));  // three.js's angles have y up
    around.theta += 4 * dx * angle, around.phi = Math.min(Math.max(around.phi + 4 * dy * angle, 0.05), Math.PI / 2 - 0.02);
    const turned = new THREE.Vector3().setFromSpherical(around);
    this.camera.position.copy(this.target).add(new THREE.Vector3(turned.x, -turned.z, turned.y));
    this.camera.lookAt(this.target);
  }

  pan(dx, dy) {
    const distance = this.isWalking ? 8 : this.camera.position.distanceTo(this.target);
    const metres = distance * 2 * Math.tan(this.camera.fov * Math.PI / 360) / this.element.clientHeight;
    const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0), ahead = new THREE.Vector3().crossVectors(up, right);
    const way = right.multiplyScalar(-dx * metres).addScaledVector(ahead, dy * metres);
    if (this.isWalking) return this.walk(way);
    this.camera.position.add(way), this.target.add(way);
  }

  zoom(factor) {
    this.flight = null;
    if (this.isWalking) this.walk(new THREE.Vector3(Math.cos(this.heading), Math.sin(this.heading), 0).multiplyScalar(4 * (1 - factor)));
    else {
      const offset = this.camera.position.clone().sub(this.target), length = Math.min(Math.max(offset.length() * factor, 1.5), 3000);
      this.camera.position.copy(this.target).add(offset.setLength(length));
    }
    this.changed();
  }

  key(event, is) {
    const moves = ['arrowup', 'arrowdown', 'arrowleft', 'arrowright', 'w', 'a', 's', 'd', '+', '-', 'pageup', 'pagedown'];
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey || event.altKey || !moves.includes(key)) return;
    event.preventDefault();
    if (is) this.keys.add(key);
    this.flight = null;
    this.changed();
  }

  // Goes on by the clock; true while something moves.
  step(now, seconds) {
    const {camera} = this;
    if (this.flight) {
      const {from, to, turn, end, began} = this.flight, t = Math.min((now - began) / FLIGHT_MS, 1), eased = t * t * (3 - 2 * t);
      camera.position.lerpVectors(from, to, eased);
      camera.quaternion.slerpQuaternions(turn, end, eased);
      camera.updateMatrixWorld();
      if (t >= 1) this.flight = null;
      return true;
    }
    const has = (...names) => names.some(name => this.keys.has(name)) ? 1 : 0;
    const ahead = has('arrowup', 'w') - has('arrowdown', 's') - this.stick.y, aside = has('d') - has('a') + this.stick.x;
    const turned = has('arrowleft') - has('arrowright'), nearer = has('+', 'pageup') - has('-', 'pagedown');
    if (!ahead && !aside && !turned && !nearer) return false;
    seconds = Math.min(seconds, 0.2);
    if (this.isWalking) {
      const h = this.heading, metres = WALK_M_S * seconds;
      if (turned) this.look(h + turned * TURN_S * seconds, Math.asin(camera.getWorldDirection(new THREE.Vector3()).z));
      this.walk(new THREE.Vector3(Math.cos(h), Math.sin(h), 0).multiplyScalar(ahead * metres));
      this.walk(new THREE.Vector3(Math.sin(h), -Math.cos(h), 0).multiplyScalar(aside * metres));
    } else {
      const pixels = 0.5 * this.element.clientHeight * seconds;
      this.turn(turned * 0.5 * pixels, 0);
      this.pan(-aside * pixels, ahead * pixels);
      if (nearer) this.zoom(Math.exp(-nearer * 1.2 * seconds));
    }
    camera.updateMatrixWorld();
    return true;
  }
}
