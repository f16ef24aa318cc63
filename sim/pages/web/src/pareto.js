'use strict';
// Means of two columns over the points of a sweep, with the Pareto front.

class ParetoView {
  constructor(host, points, choice, on) {
    Object.assign(this, {points, on, chosen: null});
    const second = ['flight_time_s', 'path_length_m', 'metric.jerk_rms', 'min_obstacle_clearance_m', ...points.columns.map(({name}) => name)]
      .find((name) => name !== choice.column && points.varies(name)) ?? points.columns[0].name;
    const controls = host.appendChild(make('div', 'controls'));
    this.x = columnSelect(controls, 'across', points.columns, second, () => {
      this.xBest.value = points.better(this.x.value);
      this.update();
    });
    this.xBest = controls.appendChild(make('select'));
    this.xBest.ariaLabel = 'direction of the column across';
    for (const word of ['less', 'more']) this.xBest.appendChild(make('option', '', word + ' is better')).value = word;
    this.xBest.value = points.better(second);
    this.xBest.addEventListener('change', () => this.update());
    this.axes = new Axes(host.appendChild(make('div')), 340, {
      draw: (c) => this.draw(c), hover: (x, y) => this.lines(x, y),
      pick: (x, y) => { const i = this.at(x, y); if (i !== null) on.choosePoint(i); }});
    this.key = host.appendChild(make('div', 'plan-key'));
    this.list = host.appendChild(make('div', 'scroll tall'));
    this.setChoice(choice);
  }
  setChoice(choice) {
    this.choice = choice;
    this.update();
  }
  setChosen(i) {
    this.chosen = i;
    this.axes.draw();
  }
  update() {
    const {points, choice} = this, x = this.x.value, y = choice.column;
    Object.assign(this, {xs: points.of(x), ys: points.of(y)});
    this.drawn = [...points.points.keys()].filter((i) => this.xs[i].mean !== null && this.ys[i].mean !== null);
    const passing = this.drawn.filter((i) => noneFailed(points.points[i]));
    const rivals = choice.passedFirst && passing.length && y !== 'passed' ? passing : this.drawn;
    this.front = paretoRows(rivals, this.xs.map(({mean}) => mean), this.ys.map(({mean}) => mean), this.xBest.value === 'less', choice.less);
    this.axes.set(numberAxis('mean of ' + points.label(x), this.drawn.map((i) => this.xs[i].mean)),
      numberAxis('mean of ' + points.label(y), this.drawn.map((i) => this.ys[i].mean)));
    this.key.replaceChildren(make('span', '', `ringed: the Pareto front, ${this.front.length} of ${points.points.length} points` +
      (rivals === passing ? '; only points without failed flights are on it' : '')));
    const element = make('table', 'ranking');
    addHeadings(element.appendChild(make('thead')), [...points.headings().map((name) => [name, 'number']), [points.label(x), 'number'], [points.label(y), 'number']]);
    const body = element.appendChild(make('tbody'));
    for (const i of this.front) {
      const line = addRow(body, [...points.points[i].values.map((value) => [valueWords(value), 'number']), [short(this.xs[i].mean), 'number'], [short(this.ys[i].mean), 'number']]);
      onChoose(line, () => this.on.choosePoint(i));
    }
    this.list.replaceChildren(element);
  }
  draw(c) {
    if (!this.drawn) return;
    const {axes, xs, ys, points} = this, at = (i) => [axes.x(xs[i].mean), axes.y(ys[i].mean)];
    const dot = (i, radius) => { c.beginPath(); c.arc(...at(i), radius, 0, 2 * Math.PI); };
    c.strokeStyle = themeColor('ink');
    c.setLineDash([4, 3]);
    c.beginPath();
    this.front.forEach((i, k) => {  // a staircase: points behind its steps are dominated
      if (k) c.lineTo(at(i)[0], at(this.front[k - 1])[1]);
      c.lineTo(...at(i));
    });
    c.stroke();
    c.setLineDash([]);
    c.globalAlpha = this.drawn.length > 300 ? 0.6 : 0.9;
    for (const i of this.drawn) {
      c.fillStyle = themeColor(noneFailed(points.points[i]) ? 'c0' : 'bad');
      dot(i, 3.5);
      c.fill();
    }
    c.globalAlpha = 1;
    c.lineWidth = 1.75;
    for (const i of this.front) { dot(i, 6); c.stroke(); }
    if (this.chosen === null || !this.drawn.includes(this.chosen)) return;
    c.strokeStyle = themeColor('c1');
    c.lineWidth = 2.5;
    dot(this.chosen, 8);
    c.stroke();
  }
  at(px, py) {
    let best = null, least = 12 ** 2;
    for (const i of this.drawn) {
      const d = (this.axes.x(this.xs[i].mean) - px) ** 2 + (this.axes.y(this.ys[i].mean) - py) ** 2;
      if (d < least) [least, best] = [d, i];
    }
    return best;
  }
  lines(px, py) {
    const i = this.at(px, py);
    return i === null ? null : pointLines(this.points, i, [this.x.value, this.choice.column]);
  }
}
/** Lines of a tip: the point's values, and the means of some columns. */
function pointLines(points, i, names) {
  return [passedWords(points.points[i], 'flight'), ...points.paths.map((path, k) => `${path} = ${valueWords(points.points[i].values[k])}`),
    ...new Set(names.map((name) => `${name}: ${meanWords(points.of(name)[i], points.unit(name))}`))];
}
