'use strict';
// Heat map of a column over two parameters: the mean over all points of a cell.

class HeatMap {
  constructor(host, points, choice, on) {
    Object.assign(this, {points, on});
    const columns = points.paths.map((name) => ({name}));
    const [x, y] = points.paths.filter((path, k) => points.levels(k) > 1).concat(points.paths);
    const controls = host.appendChild(make('div', 'controls'));
    this.x = columnSelect(controls, 'across', columns, x, () => this.update());
    this.y = columnSelect(controls, 'up', columns, y, () => this.update());
    this.axes = new Axes(host.appendChild(make('div')), 340, {
      draw: (c) => this.draw(c), hover: (px, py) => this.lines(px, py), pick: (px, py) => this.pick(px, py)});
    this.key = host.appendChild(make('div', 'plan-key'));
    this.setChoice(choice);
  }
  setChoice(choice) {
    this.choice = choice;
    this.update();
  }
  update() {
    const {points, choice} = this, [kx, ky] = [this.x.value, this.y.value].map((path) => points.paths.indexOf(path));
    this.xBins = parameterBins(points, kx);
    this.yBins = parameterBins(points, ky);
    this.cells = heatCells(points, points.of(choice.column), this.xBins, this.yBins, kx, ky);
    this.range = finiteRange([...this.cells.values()].map(({mean}) => mean));
    const unit = points.unit(choice.column);
    const ends = this.range.map((v) => short(v, figuresFor(this.range)) + (unit ? ' ' + unit : ''));
    const ramp = make('span', 'ramp');
    ramp.append(ends[0], make('i'), ends[1]);
    ramp.querySelector('i').style.background = `linear-gradient(${choice.less ? 270 : 90}deg, var(--ramp))`;
    this.key.replaceChildren(ramp, make('span', '', `mean of ${choice.column} over the points and seeds of a cell`));
    this.axes.set(wordAxis(points.label(this.x.value), this.xBins.words), wordAxis(points.label(this.y.value), this.yBins.words));
  }
  draw(c) {
    if (!this.cells) return;
    const {axes, choice} = this, ramp = makeRamp(themeColor('ramp')), [low, high] = this.range;
    const width = axes.x(1) - axes.x(0), height = axes.y(0) - axes.y(1);
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    for (const {x, y, mean} of this.cells.values()) {
      const share = mean === null ? null : high > low ? (mean - low) / (high - low) : 0.5;
      const color = share === null ? themeColor('faint') : ramp(choice.less ? 1 - share : share);
      c.fillStyle = color;
      c.fillRect(axes.x(x - 0.5) + 1, axes.y(y + 0.5) + 1, width - 2, height - 2);
      const text = mean === null ? '–' : short(mean, figuresFor(this.range, 3));
      if (c.measureText(text).width + 6 > width || height < 14) continue;
      c.fillStyle = share === null ? themeColor('soft') : inkOn(color);
      c.fillText(text, axes.x(x), axes.y(y));
    }
  }
  lines(px, py) {
    const cell = this.cells.get(this.axes.cellKey(px, py));
    return cell ? [`${this.choice.column}: ${short(cell.mean)}`, `${this.x.value}: ${this.xBins.words[cell.x]}`,
      `${this.y.value}: ${this.yBins.words[cell.y]}`, `${cell.points.length} point${cell.points.length === 1 ? '' : 's'}`] : null;
  }
  pick(px, py) {
    const cell = this.cells.get(this.axes.cellKey(px, py));
    if (cell) this.on.choosePoint(cell.points[0]);
  }
}
/** Cells "x,y": {x, y, mean, points}. The mean is null if a point lacks the column. */
function heatCells(points, figures, xBins, yBins, kx, ky) {
  const cells = new Map();
  points.points.forEach(({values}, i) => {
    const x = xBins.of(values[kx]), y = yBins.of(values[ky]), key = x + ',' + y;
    if (!cells.has(key)) cells.set(key, {x, y, mean: null, points: []});
    cells.get(key).points.push(i);
  });
  for (const cell of cells.values()) {
    const means = cell.points.map((i) => figures[i].mean);
    cell.mean = means.includes(null) ? null : means.reduce((sum, v) => sum + v, 0) / means.length;
  }
  return cells;
}
