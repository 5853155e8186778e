// Buttons and texts around the place.

const element = id => document.getElementById(id);

export function make(tag, attributes = {}, text = '') {
  const made = Object.assign(document.createElement(tag), attributes);
  if (text) made.textContent = text;
  return made;
}

const clock = hours => {
  const minutes = Math.round(60 * hours);
  return `${String(Math.floor(minutes / 60) % 24).padStart(2, '0')}:${String(minutes % 60).padStart(2, '0')}`;
};

// Chips of which one is pressed.
export function chips(parent, names, chosen) {
  const buttons = names.map((name, number) => {
    const button = make('button', {type: 'button', onclick: () => chosen(number)}, name);
    parent.append(button);
    return button;
  });
  return number => buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(i === number)));
}

// The notes of the authors, and what the page shows otherwise than Parvis.
export function addNotes(parent, site) {
  if (site.notes.length > 0) parent.append(make('h2', {}, 'Notes of the authors'));
  for (const {about, text} of site.notes) {
    if (about) parent.append(make('p', {className: 'label'}, site.states.find(({name}) => name === about)?.title ?? about));
    parent.append(make('p', {}, text));
  }
}

export function addDifference(parent, site, difference) {
  if (!difference) return;
  parent.append(make('h2', {}, `From "${site.states[difference.from].title}" to "${site.states[difference.to].title}"`));
  const table = make('table');
  for (const {how, label, count, detail} of difference.rows) {
    const row = table.insertRow();
    row.insertCell().append(make('span', {className: how}, how));
    row.insertCell().textContent = `${count} × ${label}`;
    row.insertCell().textContent = detail;
  }
  parent.append(table);
}

export class Panel {
  constructor(app) {
    this.app = app;
    const {site} = app;
    this.noteView = chips(element('views'), site.views.map(({name}) => name), number => app.goTo(number));
    this.noteView(0);
    if (site.states.length > 1) {
      element('scenarios').hidden = false;
      this.pressState = chips(element('scenarios').lastElementChild, site.states.map(({title}) => title), number => app.choose(number));
    }
    this.tools();
    this.wipe();
    this.pad();
    element('menu').onclick = () => this.open(!document.body.classList.contains('open'));
    document.addEventListener('keydown', event => this.key(event));
  }

  open(is) {
    document.body.classList.toggle('open', is);
    element('menu').setAttribute('aria-expanded', String(is));
    if (is) this.showSide('info');
    else if (matchMedia('(max-width: 720px)').matches) element('side').hidden = true;
  }

  tools() {
    const {app} = this, {site} = app, bar = element('tools');
    const tool = (text, title, pressed) => {
      const button = make('button', {type: 'button', title}, text);
      button.setAttribute('aria-pressed', 'false');
      button.onclick = () => pressed(button.getAttribute('aria-pressed') !== 'true', button);
      bar.append(button);
      return button;
    };
    this.walkButton = tool('Walk', 'Walk on the ground, or circle round the place (G)', is => app.setWalking(is));
    if (site.states.some(({measures}) => measures.length > 0))
      this.measureButton = tool('Measures', 'Lengths, areas and heights of the authors (M)', (is, button) => {
        button.setAttribute('aria-pressed', String(is)), app.set('showsMeasures', is);
      });
    if (site.states.length > 1)
      this.compareButton = tool('Compare', 'Two scenarios side by side (C)', is => app.compare(is ? this.counterpart() : app.state));
    if (site.differences.length > 0)
      this.differenceButton = tool('Differences', 'What one scenario adds, removes, moves and changes (V)', (is, button) => {
        button.setAttribute('aria-pressed', String(is)), app.set('showsDifferences', is), this.showSide(is ? 'differences' : null);
      });
    this.infoButton = tool('About', 'Notes of the authors, keys, and how the page was made (I)', is => this.showSide(is ? 'info' : null));
  }

  counterpart() { return this.app.state === 0 ? Math.min(1, this.app.site.states.length - 1) : 0; }

  noteWalking(is) { this.walkButton.setAttribute('aria-pressed', String(is)); }

  noteState() {
    const {app} = this, {site} = app, compares = app.other !== null;
    this.pressState?.(app.state);
    this.compareButton?.setAttribute('aria-pressed', String(compares));
    for (const id of ['wipe', 'left-name', 'right-name']) element(id).hidden = !compares;
    element('left-name').textContent = site.states[app.state].title;
    if (compares) element('right-name').textContent = site.states[app.other].title;
    if (this.side === 'differences') this.showSide('differences');
  }

  showSide(what) {
    const {app} = this, {site} = app, side = element('side');
    this.side = what;
    side.hidden = !what;
    side.textContent = '';
    this.infoButton.setAttribute('aria-pressed', String(what === 'info'));
    this.differenceButton?.setAttribute('aria-pressed', String(app.showsDifferences));
    if (what === 'differences') {
      addDifference(side, site, app.difference());
      if (!app.difference()) side.append(make('p', {}, 'These two scenarios place the same objects.'));
    }
    if (what !== 'info') return;
    if (matchMedia('(max-width: 720px)').matches) {
      side.append(make('h2', {}, 'Views'));
      const list = make('div', {className: 'chips'});
      chips(list, site.views.map(({name}) => name), number => (app.goTo(number), this.open(false)));
      side.append(list);
      addDifference(side, site, app.difference());
    }
    addNotes(side, site);
    side.append(make('h2', {}, 'To look around'),
                make('p', {}, 'Drag to turn, wheel or two fingers to come nearer, right button to shift.\nArrow keys and W A S D move; digits choose a view; G walks; C compares; M measures; V differences; [ and ] change the hour.'));
    if (site.instead.length > 0) side.append(make('h2', {}, 'Shown otherwise than in Parvis'));
    for (const sentence of site.instead) side.append(make('p', {}, sentence));
    side.append(make('p', {className: 'label'}, 'Nothing is sent anywhere. Made with Parvis and three.js.'));
  }

  showDays() {
    const {app} = this, {site} = app, date = element('date'), hour = element('hour');
    element('day').hidden = false;
    for (const [number, {label}] of site.days.entries()) date.append(make('option', {value: String(number)}, label));
    const range = () => {
      const {moments, rise_h: rise, set_h: set} = site.days[date.value];
      hour.min = moments[0]?.hour ?? 0, hour.max = moments.at(-1)?.hour ?? 0, hour.step = 0.25;
      const share = h => `${(100 * (h - hour.min) / (hour.max - hour.min)).toFixed(1)}%`;
      element('hours').style.background = rise === undefined || set === undefined ? '' :
        `linear-gradient(90deg, #cfd4dd ${share(rise)}, #f3dfb0 ${share(rise)} ${share(set)}, #cfd4dd ${share(set)}) 0 100% / 100% 4px no-repeat`;
      element('hours').title = rise === undefined ? '' : `Sunrise ${clock(rise)}, sunset ${clock(set)}`;
    };
    const apply = () => { element('clock').textContent = clock(Number(hour.value)), app.setMoment(Number(date.value), Number(hour.value)); };
    date.onchange = () => { range(), apply(); };
    hour.oninput = apply;
    range();
    hour.value = site.place?.hour ?? 12;
    element('clock').textContent = clock(site.place?.hour ?? 12);
  }

  wipe() {
    const {app} = this, handle = element('wipe');
    const set = share => {
      app.wipe = Math.min(Math.max(share, 0.02), 0.98), app.changed();
    };
    handle.addEventListener('pointerdown', event => handle.setPointerCapture(event.pointerId));
    handle.addEventListener('pointermove', event => { if (handle.hasPointerCapture(event.pointerId)) set(event.clientX / app.width); });
    handle.addEventListener('keydown', event => {
      const step = {ArrowLeft: -0.05, ArrowRight: 0.05}[event.key];
      if (step) event.preventDefault(), event.stopPropagation(), set(app.wipe + step);
    });
  }

  placeWipe() {
    const {app} = this;
    if (app.other === null) return;
    const x = app.wipe * app.width, left = element('left-name'), right = element('right-name');
    element('wipe').style.left = `${x}px`;
    element('wipe').setAttribute('aria-valuenow', String(Math.round(100 * app.wipe)));
    left.style.right = `${app.width - x + 26}px`, left.style.left = 'auto';
    right.style.left = `${x + 26}px`;
  }

  // A stick for the thumb, to walk with on touch screens.
  pad() {
    const {app} = this, pad = element('pad');
    const set = (x, y) => {
      app.traveller.stick.set(x, y), pad.style.setProperty('--x', `${34 * x}px`), pad.style.setProperty('--y', `${34 * y}px`), app.changed();
    };
    const move = event => {
      const box = pad.getBoundingClientRect(), x = 2 * (event.clientX - box.left) / box.width - 1, y = 2 * (event.clientY - box.top) / box.height - 1;
      const length = Math.max(Math.hypot(x, y), 1);
      set(x / length, y / length);
    };
    pad.addEventListener('pointerdown', event => { pad.setPointerCapture(event.pointerId), move(event); });
    pad.addEventListener('pointermove', event => { if (pad.hasPointerCapture(event.pointerId)) move(event); });
    for (const end of ['pointerup', 'pointercancel']) pad.addEventListener(end, () => set(0, 0));
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || ['INPUT', 'SELECT'].includes(event.target.tagName)) return;
    const {app} = this, press = button => button?.click(), hour = element('hour');
    const turn = steps => { hour.value = Number(hour.value) + steps, hour.oninput?.(); };
    const actions = {g: () => press(this.walkButton), m: () => press(this.measureButton), c: () => press(this.compareButton),
                     v: () => press(this.differenceButton), i: () => press(this.infoButton), '[': () => turn(-0.5), ']': () => turn(0.5)};
    if (/^[1-9]$/.test(event.key) && Number(event.key) <= app.site.views.length) app.goTo(Number(event.key) - 1);
    else actions[event.key.toLowerCase()]?.();
  }
}
