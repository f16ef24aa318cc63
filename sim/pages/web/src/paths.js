'use strict';
// Paths of all flights of a scene on its map.

class PathsView {
  /** @param select  element to choose the scene with. @param on  {choose(row)}. @param board  a leaderboard, whose modules have a color each. */
  constructor(host, select, {maps, map, path, goal}, table, on, board = null) {
    Object.assign(this, {host, select, maps, mapOf: map, goals: goal, table, on, chosen: null, near: null});
    this.modules = board?.modules ?? [];
    this.moduleOf = new Map(board?.cells.map(({group, module}) => [group, module]));
    this.paths = path.map(readPath);
    this.shown = new Set();
    const counts = this.counts(map.keys());
    // Flights without a drawn scene share an empty map, named -1.
    this.numbers = [...counts.keys()].sort((a, b) => (a < 0) - (b < 0) || counts.get(b) - counts.get(a) || a - b);
    for (const number of this.numbers) {
      const option = select.appendChild(make('option'));
      option.value = number;
    }
    select.addEventListener('change', () => this.open(Number(select.value)));
    if (this.numbers.length) this.open(this.numbers[0]);
    else host.append(make('p', 'missing', 'No flight has a recorded path.'));
  }

  counts(rows) {
    const counts = new Map();
    for (const row of rows) {
      if (this.paths[row].n.length) counts.set(this.mapOf[row], (counts.get(this.mapOf[row]) ?? 0) + 1);
    }
    return counts;
  }

  open(number) {
    this.number = number;
    this.select.value = number;
    this.rows = this.paths.map((path, row) => row).filter((row) => this.mapOf[row] === number && this.paths[row].n.length);
    const reach = {n: [], e: []};
    for (const row of this.rows) {
      for (const key of ['n', 'e']) reach[key].push(...finiteRange(this.paths[row][key]));
    }
    for (const [n, e, radius] of this.goalsOf(this.rows)) {
      reach.n.push(n - radius, n + radius);
      reach.e.push(e - radius, e + radius);
    }
    this.host.replaceChildren();
    this.map = new MapView(this.host, this.maps[number] ?? {bounds: [], footprints: [], movers: [], goal: null}, reach, {
      draw: (c) => this.draw(c),
      key: (key) => this.drawKey(key),
      hover: (x, y) => this.hover(x, y),
      leave: () => this.setNear(null),
      click: () => { if (this.near !== null) this.on.choose(this.near); },
    });
    this.nameScenes();
    this.map.draw();
  }
  nameScenes() {
    const counts = this.counts(this.shown);
    this.numbers.forEach((number, i) => {
      const count = counts.get(number) ?? 0, first = this.mapOf.indexOf(number);
      const name = `${groupWords(this.table.value('group', first))}, seed ${this.table.seed(first)}`;
      this.select.options[i].textContent = number < 0 ? `other scenes, not drawn: ${count === 1 ? name : count + ' flights'}`
        : `${number + 1} of ${this.maps.length}: ${count === 1 ? name : `${this.sceneWords(number)}, ${count} flights`}`;
    });
  }

  /** Returns the scenarios and seeds of a map: "forest, city, seeds 1:3". */
  sceneWords(number) {
    const rows = this.paths.map((path, row) => row).filter((row) => this.mapOf[row] === number);
    const names = [...new Set(rows.map((row) => this.table.value('scenario', row).split('/').at(-1).replace(/\.ya?ml$/, '')))];
    const seeds = [...new Set(rows.map((row) => this.table.seed(row)))].filter((seed) => /^\d+$/.test(seed)), most = 3;
    return `${names.slice(0, most).join(', ')}${names.length > most ? ', …' : ''}, seed${seeds.length === 1 ? '' : 's'} ${seedList(seeds)}`;
  }
  /** The color of a flight: of its module in a leaderboard, else of its verdict. */
  colorOf(row) {
    const module = this.moduleOf.get(this.table.value('group', row)), index = this.modules.findIndex(({name}) => name === module);
    return index < 0 ? themeColor(verdictColors[this.table.verdict(row)]) : markColor(index, this.modules[index].control);
  }
  /** Returns the different goals of flights; none if they are too many to be drawn. */
  goalsOf(rows) {
    const goals = new Map(rows.map((row) => [String(this.goals[row]), this.goals[row]]));
    return goals.size <= 20 ? [...goals.values()].filter(Boolean) : [];
  }
  setRows(rows) {
    this.shown = new Set(rows);
    this.nameScenes();
    this.map?.draw();
  }
  setChosen(row) {
    this.chosen = row;
    if (row === null || !this.map) return;
    if (this.paths[row].n.length && this.mapOf[row] !== this.number) this.open(this.mapOf[row]);
    else this.map.draw();
  }
  setNear(row) {
    this.map.canvas.style.cursor = row === null ? '' : 'pointer';
    if (row === this.near) return;
    this.near = row;
    this.map.draw();
  }

  trace(c, row) {
    const {n, e} = this.paths[row], {map} = this;
    c.beginPath();
    for (let i = 0; i < n.length; ++i) c.lineTo(map.x(e[i]), map.y(n[i]));
    c.stroke();
  }
  draw(c) {
    const rows = this.rows.filter((row) => this.shown.has(row)), {map} = this;
    for (const [n, e, radius] of this.goalsOf(rows)) map.drawGoal(c, {n, e, radius});
    c.lineWidth = rows.length > 200 ? 1 : 1.5;
    // Rare verdicts are drawn last, on top.
    for (const verdict of ['passed', 'unchecked', 'failed', 'collided']) {
      c.globalAlpha = Math.min(1, Math.max(0.25, 30 / rows.length));
      const alike = rows.filter((row) => this.table.verdict(row) === verdict);
      for (const row of alike) {
        c.strokeStyle = this.colorOf(row);
        this.trace(c, row);
      }
      c.globalAlpha = 1;
      if (verdict === 'collided') for (const row of alike) this.mark(c, row, rows.length > 100 ? 3 : 5);
    }
    for (const row of [this.near, this.chosen]) if (row !== null && this.rows.includes(row)) this.highlight(c, row);
  }
  mark(c, row, size) {
    const {n, e} = this.paths[row];
    this.map.cross(c, this.map.x(e.at(-1)), this.map.y(n.at(-1)), size, themeColor('bad'), 1.5);
  }
  highlight(c, row) {
    const {map} = this, {n, e} = this.paths[row], color = this.colorOf(row);
    c.strokeStyle = themeColor('plan');
    c.lineWidth = 7;
    this.trace(c, row);
    c.strokeStyle = color;
    c.lineWidth = 3;
    this.trace(c, row);
    map.dot(c, map.x(e[0]), map.y(n[0]), 5, themeColor('ink'));
    if (this.table.verdict(row) === 'collided') map.cross(c, map.x(e.at(-1)), map.y(n.at(-1)), 8, color, 3.5);
    else map.dot(c, map.x(e.at(-1)), map.y(n.at(-1)), 4, color);
  }

  drawKey(key) {
    const rows = this.rows.filter((row) => this.shown.has(row)), present = new Set(rows.map((row) => this.table.verdict(row)));
    const add = (color, words) => {
      const item = key.appendChild(make('span'));
      item.appendChild(make('i')).style.cssText = `background: ${color}; height: 3px; vertical-align: 3px`;
      item.append(words);
    };
    if (this.modules.length) {
      for (const {name, control} of this.modules) {
        const row = rows.find((r) => this.moduleOf.get(this.table.value('group', r)) === name);
        if (row !== undefined) add(this.colorOf(row), name + (control ? ' (control)' : ''));
      }
      if (present.has('collided')) key.append(make('span', '', 'cross: collision'));
      return;
    }
    for (const verdict of ['passed', 'unchecked', 'failed', 'collided']) {
      if (present.has(verdict)) add(themeColor(verdictColors[verdict]), verdictWords[verdict]);
    }
  }

  /** Returns the path closest to the pointer, by distance to its segments. */
  hover(x, y) {
    let best = null, least = 8 ** 2;
    for (const row of this.rows) {
      if (!this.shown.has(row)) continue;
      const {n, e} = this.paths[row];
      for (let i = 1; i < n.length; ++i) {
        const x0 = this.map.x(e[i - 1]), y0 = this.map.y(n[i - 1]), dx = this.map.x(e[i]) - x0, dy = this.map.y(n[i]) - y0;
        const along = Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1)));
        const d = (x0 + along * dx - x) ** 2 + (y0 + along * dy - y) ** 2;
        if (d < least) [least, best] = [d, row];
      }
    }
    this.setNear(best);
    this.map.showTip(x, y, best === null ? this.map.placeLines(x, y) : flightLines(this.table, best));
  }
}

/** Returns lines of text about a flight. */
function flightLines(table, row) {
  const clearance = table.value('min_obstacle_clearance_m', row);
  return [table.value('id', row), table.why[row] || table.value('outcome', row),
    `clearance ${meters(clearance)}, ${fixed(table.value('flight_time_s', row), 1)} s`];
}
