// Converts every <figure class="viewer"> of the page to an interactive view of states.
//
// A figure contains a <script type="application/json"> with `attitude` (view direction and up direction),
// `bonds` between monomers, and `states` with bodies as plain numbers (nm, lab frame), described in
// crates/actin-view/src/states.rs. space.js handles camera and input, bodies.js the bodies.

(() => {
  'use strict';

  class View {
    constructor(figure) {
      this.data = JSON.parse(figure.querySelector('script').textContent);
      this.legend = figure.querySelector('.legend');
      this.space = new Space(figure.querySelector('canvas'));
      if (!this.space.isThere) return;
      this.groups = [...new Set(this.data.states.map((s) => s.group))];
      this.space.drawn = () => this.explain();
      this.controls(figure);
      this.choose(this.groups[0]);
      this.space.reset();
      Bodies.DARK.addEventListener('change', () => this.put());
    }

    // Menus and buttons; menus with a single entry are omitted.
    controls(figure) {
      const bar = figure.querySelector('.controls');
      const add = (name, text, act) => {
        const element = document.createElement(name);
        element.textContent = text;
        if (name === 'button') element.type = 'button';
        element.addEventListener(name === 'select' ? 'change' : 'click', act);
        bar.append(element);
        return element;
      };
      this.groupMenu = add('select', '', () => this.choose(this.groupMenu.value));
      this.groupMenu.setAttribute('aria-label', 'Setting');
      this.groupMenu.append(...this.groups.map((g) => new Option(g, g)));
      this.groupMenu.hidden = this.groups.length < 2;
      this.stateMenu = add('select', '', () => {
        this.state = this.members[this.stateMenu.selectedIndex];
        this.put();
      });
      this.stateMenu.setAttribute('aria-label', 'Resolution');
      this.compare = add('button', 'Compare', () => {
        const on = this.compare.getAttribute('aria-pressed') !== 'true';
        this.compare.setAttribute('aria-pressed', String(on));
        this.put();
      });
      this.compare.setAttribute('aria-pressed', 'false');
      add('button', '−', () => this.space.zoomBy(1 / 1.3)).setAttribute('aria-label', 'Smaller');
      add('button', '+', () => this.space.zoomBy(1.3)).setAttribute('aria-label', 'Larger');
      add('button', 'Reset', () => this.space.reset());
    }

    // Shows a group and selects the state with the previous name, or the middle one.
    choose(group) {
      const before = this.state && this.state.name;
      this.members = this.data.states.filter((s) => s.group === group);
      this.stateMenu.replaceChildren(...this.members.map((s) => new Option(s.name)));
      const same = this.members.findIndex((s) => s.name === before);
      const index = same < 0 ? Math.floor(this.members.length / 2) : same;
      this.state = this.members[index];
      this.stateMenu.selectedIndex = index;
      this.stateMenu.hidden = this.members.length < 2;
      this.compare.hidden = this.members.length < 2;
      // The camera includes all states of the group, so that they have the same scale.
      this.space.frame(this.data.attitude, this.members.flatMap((s) => [
        ...s.lines.flat(), ...s.linkers.flatMap((l) => [l.slice(0, 3), l.slice(3)])]));
      this.put();
    }

    get isCompared() {
      return this.compare.getAttribute('aria-pressed') === 'true';
    }

    // Shows the selected state, or the centre lines of the whole group.
    put() {
      this.pose = Bodies.pose(this.state);
      Bodies.put(this.space, this.pose, { bonds: this.data.bonds });
      if (!this.isCompared) return;
      this.space.labels = [];
      this.space.show((batch) => {
        for (const state of this.members) {
          for (const line of state.lines) batch.line(line, 0.5, Bodies.resolution(state.share), 0, 2.4);
        }
      });
    }

    // Legend of the selected state or of the compared states.
    explain() {
      const entries = this.isCompared
        ? this.members.map((s) => [s.name, Bodies.resolution(s.share)])
        : Bodies.legend(this.pose, {
          level: this.space.level, sample: Bodies.sample(this.pose, this.data.bonds) });
      Bodies.explain(this.legend, entries);
    }
  }

  document.querySelectorAll('figure.viewer').forEach((figure) => new View(figure));
})();
