// The place without WebGL 2: pictures that Parvis has drawn of each view in each scenario.
import {addDifference, addNotes, chips} from './panel.js';

const element = id => document.getElementById(id);

export class StillPictures {
  constructor(site) {
    this.site = site, this.view = 0, this.state = 0;
    element('picture').hidden = true, element('lines').hidden = true, element('still').hidden = false;
    element('tools').hidden = true, element('menu').hidden = true;
    element('views').style.display = 'flex';
    this.pressView = chips(element('views'), site.views.map(({name}) => name), number => { this.view = number, this.show(); });
    if (site.states.length > 1) {
      element('scenarios').hidden = false;
      this.pressState = chips(element('scenarios').lastElementChild, site.states.map(({title}) => title), number => { this.state = number, this.show(); });
    }
    this.show();
  }

  show() {
    const {site} = this, state = site.states[this.state], side = element('side');
    element('still').src = state.pictures[this.view];
    element('still').alt = `${site.views[this.view].name}, ${state.title}`;
    this.pressView(this.view), this.pressState?.(this.state);
    side.textContent = '';
    addNotes(side, site);
    addDifference(side, site, site.differences.find(({from, to}) => from === 0 && to === this.state));
    side.hidden = !side.hasChildNodes();
  }
}
