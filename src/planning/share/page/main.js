// The page of a shared place: what is loaded in which order, what is shown, and when it is drawn.
import * as THREE from 'three';
import {Light} from './light.js';
import {differenceMarks, Measures} from './marks.js';
import {Panel} from './panel.js';
import {loadBytes, loadJson} from './parts.js';
import {Place} from './place.js';
import {StillPictures} from './still_pictures.js';
import {Traveller} from './traveller.js';

const element = id => document.getElementById(id);
const canvas = element('picture'), stage = element('stage');

function say(text) {
  element('message').textContent = text;
  element('message').hidden = !text;
}
const progress = share => { element('progress').style.width = share < 1 ? `${100 * share}%` : '0'; };

function webgl() {
  const context = new URLSearchParams(location.search).has('still') ? null : canvas.getContext('webgl2', {antialias: true, powerPreference: 'high-performance'});
  return context;
}

class App {
  constructor(site, context) {
    this.site = site;
    this.state = 0, this.other = null, this.wipe = 0.5;
    this.day = 0, this.hour = null;  // null: the scenario's own moment
    this.showsMeasures = false, this.showsDifferences = false;
    this.isDirty = true, this.pictures = 0;
    this.renderer = new THREE.WebGLRenderer({canvas, context, antialias: true});
    this.renderer.autoClear = false;
    this.camera = new THREE.PerspectiveCamera(50, 1, 0.1, 6000);
    this.measures = new Measures(element('lines'));
    canvas.addEventListener('webglcontextlost', event => {
      event.preventDefault();
      this.isLost = true;
      say('The graphics memory was taken away. The place comes back as soon as the browser gives it again.');
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.isLost = false;
      this.light.isStale = true;
      say('');
      this.changed();
    });
  }

  async load() {
    const {site} = this;
    this.light = new Light(site, await loadBytes('light'));
    progress(0.3);
    this.place = new Place(site, this.light);
    await this.place.load(await loadBytes('place'), Math.min(8, this.renderer.capabilities.getMaxAnisotropy()));
    progress(0.6);
    this.traveller = new Traveller(this.place, this.camera, canvas, () => this.changed());
    new ResizeObserver(() => this.changed()).observe(stage);
    this.resize();
    this.choose(Math.max(site.states.findIndex(state => state.name === site.first), 0));
    this.traveller.goTo(this.view(0), true);
    requestAnimationFrame(now => this.frame(now));
    this.loadRest();
  }

  // Sharper textures and the hours of the day come while the place is looked at.
  async loadRest() {
    const {site} = this;
    try {
      if (site.days.length > 0) this.hourBytes = await loadBytes('hours'), this.panel.showDays();
      for (const [i, {part, images}] of site.textures.entries()) {
        const bytes = await loadBytes(part);
        for (const {image, offset, size} of images) await this.place.sharpen(image, bytes.slice(offset, offset + size));
        progress(0.7 + 0.3 * (i + 1) / site.textures.length);
        this.changed();
      }
    } catch (problem) { say(problem.message); }
    progress(1);
    this.isComplete = true;
    this.changed();
  }

  // A saved view; its field of view is that of a picture 16 wide and 9 high, of which a narrow window shows the middle.
  view(number) {
    const view = this.site.views[number], aspect = Math.max(this.camera.aspect, 0.8);
    const fov = 180 / Math.PI * 2 * Math.atan(Math.tan(view.fov / 2) * Math.max(1, Math.min(16 / 9 / aspect, 1.4)));
    return {...view, fovDeg: aspect >= 16 / 9 - 0.01 ? view.fov * 180 / Math.PI : fov};
  }

  goTo(number) {
    if (this.traveller.isWalking) this.setWalking(false);
    this.traveller.goTo(this.view(number), matchMedia('(prefers-reduced-motion: reduce)').matches);
    this.panel.noteView(number);
  }

  setWalking(is) {
    this.traveller.setWalking(is);
    document.body.classList.toggle('walks', is);
    this.panel.noteWalking(is);
  }

  choose(number) {
    this.state = number;
    if (this.other === number) this.other = null;
    this.applyState(number);
    this.updateMarks();
    this.panel.noteState();
    this.changed();
  }

  compare(number) {
    this.other = number === this.state ? null : number;
    this.updateMarks();
    this.panel.noteState();
    this.changed();
  }

  applyState(number) {
    const state = this.site.states[number];
    this.place.show(state);
    this.applyMoment(state);
    this.light.showState(state);
  }

  applyMoment(state) {
    const {site, light} = this;
    if (this.hour === null || !this.hourBytes || site.days[this.day].moments.length === 0) {
      const moment = site.moments[state.moment];
      return light.show(moment, moment, 0, light.bytes);
    }
    const {moments} = site.days[this.day];
    const later = moments.findIndex(moment => moment.hour >= this.hour), last = moments.length - 1;
    const b = later < 0 ? last : later, a = Math.max(moments[b].hour > this.hour ? b - 1 : b, 0);
    const share = a === b ? 0 : (this.hour - moments[a].hour) / (moments[b].hour - moments[a].hour);
    light.show(moments[a], moments[b], share, this.hourBytes);
  }

  setMoment(day, hour) {
    this.day = day, this.hour = hour;
    this.applyState(this.state);
    this.changed();
  }

  // What differs between the two scenarios that are compared, or between the first one and the one shown.
  difference() {
    const from = this.other === null ? 0 : this.state, to = this.other === null ? this.state : this.other;
    const [low, high] = [Math.min(from, to), Math.max(from, to)];
    const found = this.site.differences.find(each => each.from === low && each.to === high);
    if (!found || from === low) return found && {...found, from, to};
    const turned = {added: 'removed', removed: 'added', moved: 'moved', changed: 'changed'};
    const turn = list => list.map(each => ({...each, how: turned[each.how]}));
    return {from, to, rows: turn(found.rows), items: turn(found.items)};
  }

  updateMarks() {
    const {place} = this;
    if (place.marks) place.scene.remove(place.marks), place.marks = null;
    const difference = this.showsDifferences && this.difference();
    if (difference) place.scene.add(place.marks = differenceMarks(difference.items));
    this.measures.show(this.showsMeasures ? this.site.states[this.state].measures : []);
  }

  set(name, is) {
    this[name] = is;
    this.updateMarks();
    this.changed();
  }

  changed() { this.isDirty = true; }

  resize() {
    const width = Math.max(stage.clientWidth, 1), height = Math.max(stage.clientHeight, 1);
    const ratio = Math.min(window.devicePixelRatio, 2);
    if (this.width === width && this.height === height && this.ratio === ratio) return;
    Object.assign(this, {width, height, ratio});
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  frame(now) {
    requestAnimationFrame(later => this.frame(later));
    const moves = this.traveller.step(now, (now - (this.before ?? now)) / 1000);
    this.before = now;
    if (this.isLost || (!this.isDirty && !moves)) return;
    this.isDirty = false;
    this.resize();
    this.draw();
    if (++this.pictures === 1) performance.mark('first picture');
  }

  draw() {
    const {renderer, camera, width, height} = this;
    camera.updateMatrixWorld();
    const part = (state, x, size) => {
      renderer.setScissorTest(false);
      if (state !== this.applied) this.applyState(state), this.applied = this.other === null ? null : state;
      this.light.drawShadows(renderer, this.place, camera);
      renderer.setScissorTest(true);
      renderer.setScissor(x, 0, size, height);
      renderer.clear();
      this.place.draw(renderer, camera);
    };
    if (this.other === null) {
      if (this.applied != null) this.applyState(this.state);
      this.applied = this.state;
      part(this.state, 0, width);
    } else {
      const at = Math.round(this.wipe * width);
      part(this.state, 0, at), part(this.other, at, width - at);
    }
    this.measures.draw(camera, width, height);
    this.panel.placeWipe();
  }
}

async function start() {
  const site = await loadJson('scene');
  document.title = site.title;
  element('title').textContent = site.title;
  const context = webgl();
  if (!context) {
    new StillPictures(site);
    say('This browser has no WebGL 2: it shows pictures that Parvis has drawn of each view. A current Firefox, Chrome, Edge or Safari lets you walk about.');
    progress(1);
    return;
  }
  const app = window.parvis_app = new App(site, context);
  app.panel = new Panel(app);
  await app.load();
}

start().catch(problem => { say(problem.message), progress(1); console.error(problem); });
