'use strict';
// Scatter plot of two columns with its Pareto front.

class Scatter {
  constructor(host, data, table, on) {
    Object.assign(this, {table, on, rows: [], front: []});
    const columns = [...table.columns.values()].filter(({is_text}) => !is_text);
    const first = (...names) => names.find((name) => table.columns.has(name)) ?? columns[0].name;
    const controls = host.appendChild(make('div', 'controls'));
    this.x = columnSelect(controls, 'across', columns, first('flight_time_s', 'path_length_m'), () => this.update());
    this.xBest = this.bestSelect(controls, 'less');
    this.y = columnSelect(controls, 'up', columns, first('min_obstacle_clearance_m', 'min_clearance_m'), () => this.update());
    this.yBest = this.bestSelect(controls, 'more');
    const passedOnly = controls.appendChild(make('label'));
    this.passedOnly = passedOnly.appendChild(make('input'));
    this.passedOnly.type = 'checkbox';
    this.passedOnly.checked = true;
    passedOnly.append('Pareto front of passed flights only');
    this.passedOnly.addEventListener('change', () => this.update());
    this.axes = new Axes(host.appendChild(make('div')), 380, {
      draw: (c) => this.draw(c), hover: (x, y) => this.lines(x, y), pick: (x, y) => this.pick(x, y)});
    this.key = host.appendChild(make('div', 'plan-key'));
  }
  bestSelect(host, chosen) {
    const element = host.appendChild(make('select'));
    element.ariaLabel = 'direction of the column to the left';
    for (const word of ['less', 'more']) element.appendChild(make('option', '', word + ' is better')).value = word;
    element.value = chosen;
    element.addEventListener('change', () => this.update());
    return element;
  }

  setRows(rows) {
    this.rows = rows;
    this.update();
  }
  update() {
    const x = this.table.columns.get(this.x.value), y = this.table.columns.get(this.y.value);
    Object.assign(this, {xs: x.values, ys: y.values});
    this.drawn = this.rows.filter((row) => this.xs[row] !== null && this.ys[row] !== null);
    const rivals = this.passedOnly.checked ? this.drawn.filter((row) => this.table.verdict(row) === 'passed') : this.drawn;
    this.front = paretoRows(rivals, this.xs, this.ys, this.xBest.value === 'less', this.yBest.value === 'less');
    this.axes.set(numberAxis(columnLabel(x), this.drawn.map((row) => this.xs[row])),
      numberAxis(columnLabel(y), this.drawn.map((row) => this.ys[row])));
    this.drawKey();
  }
  drawKey() {
    this.key.replaceChildren();
    for (const verdict of ['passed', 'unchecked', 'failed', 'collided']) {
      const count = this.drawn.filter((row) => this.table.verdict(row) === verdict).length;
      if (!count) continue;
      const item = this.key.appendChild(make('span'));
      item.appendChild(make('i')).style.cssText = `background: ${themeColor(verdictColors[verdict])}; border-radius: 6px`;
      item.append(`${verdictWords[verdict]}: ${count}`);
    }
    this.key.append(make('span', '', `ringed: the Pareto front, ${this.front.length} flight${this.front.length === 1 ? '' : 's'}`));
  }

  draw(c) {
    if (!this.drawn) return;
    const {axes, xs, ys} = this;
    c.strokeStyle = themeColor('ink');
    c.lineWidth = 1.25;
    c.setLineDash([4, 3]);
    c.beginPath();
    this.front.forEach((row, i) => {
      // A staircase: flights behind its steps are dominated.
      if (i) c.lineTo(axes.x(xs[row]), axes.y(ys[this.front[i - 1]]));
      c.lineTo(axes.x(xs[row]), axes.y(ys[row]));
    });
    c.stroke();
    c.setLineDash([]);
    const dot = (row, radius) => { c.beginPath(); c.arc(axes.x(xs[row]), axes.y(ys[row]), radius, 0, 2 * Math.PI); };
    c.globalAlpha = this.drawn.length > 300 ? 0.55 : 0.85;
    for (const row of this.drawn) {
      c.fillStyle = themeColor(verdictColors[this.table.verdict(row)]);
      dot(row, 3);
      c.fill();
    }
    c.globalAlpha = 1;
    c.lineWidth = 1.75;
    c.strokeStyle = themeColor('ink');
    for (const row of this.front) { dot(row, 5); c.stroke(); }
  }
  at(px, py) {
    let best = null, least = 10 ** 2;
    for (const row of this.drawn) {
      const d = (this.axes.x(this.xs[row]) - px) ** 2 + (this.axes.y(this.ys[row]) - py) ** 2;
      if (d < least) [least, best] = [d, row];
    }
    return best;
  }
  lines(px, py) {
    const row = this.at(px, py);
    return row === null ? null : [...flightLines(this.table, row), `${this.x.value} ${short(this.xs[row])}`, `${this.y.value} ${short(this.ys[row])}`];
  }
  pick(px, py) {
    const row = this.at(px, py);
    if (row !== null) this.on.choose(row);
  }
}
