'use strict';
// A column over each parameter: all points, the mean of each level or range, and the slice through one point.

class SlicesView {
  constructor(host, points, choice, chosen, on) {
    Object.assign(this, {points, on, chosen});
    this.panels = points.paths.map((path, k) => {
      const axes = new Axes(host.appendChild(make('div')), 230, {
        draw: (c) => this.draw(c, k), hover: (x, y) => this.lines(x, y, k),
        pick: (x, y) => { const i = this.at(x, y, k); if (i !== null) on.choosePoint(i); }});
      return {axes, bins: parameterBins(points, k), ...parameterAxis(points, k)};
    });
    this.setChoice(choice);
  }
  setChoice(choice) {
    this.choice = choice;
    this.figures = this.points.of(choice.column);
    const y = numberAxis(this.points.label(choice.column), this.figures.flatMap(({mean, low, high}, i) => this.points.points.length > 60 && i !== this.chosen ? [mean] : [mean, low, high]));
    for (const {axes, axis} of this.panels) axes.set(axis, y);
  }
  setChosen(i) {
    this.chosen = i;
    for (const {axes} of this.panels) axes.draw();
  }
  /** Means over all points of a level or range of a parameter: [{x, mean}]. */
  effect(k) {
    const {bins} = this.panels[k], groups = bins.words.map(() => []);
    this.points.points.forEach(({values}, i) => groups[bins.of(values[k])]?.push(this.figures[i].mean));
    return groups.map((means, i) => ({x: bins.at(i), mean: means.length && !means.includes(null) ? means.reduce((sum, v) => sum + v, 0) / means.length : null}))
      .filter(({mean}) => mean !== null);
  }
  /** Points that differ from the chosen one in one parameter only, along it. */
  slice(k) {
    const base = this.points.points[this.chosen].values, {at} = this.panels[k];
    return [...this.points.points.keys()]
      .filter((i) => this.figures[i].mean !== null && this.points.points[i].values.every((v, other) => other === k || v === base[other]))
      .sort((a, b) => at(this.points.points[a].values[k]) - at(this.points.points[b].values[k]));
  }
  place(i, k) {
    const {axes, at} = this.panels[k];
    return [axes.x(at(this.points.points[i].values[k])), axes.y(this.figures[i].mean)];
  }
  draw(c, k) {
    if (!this.figures || !this.panels) return;
    const {axes} = this.panels[k];
    c.globalAlpha = 0.35;
    c.fillStyle = themeColor('soft');
    this.figures.forEach(({mean}, i) => {
      if (mean === null) return;
      c.beginPath();
      c.arc(...this.place(i, k), 2.5, 0, 2 * Math.PI);
      c.fill();
    });
    c.globalAlpha = 1;
    const line = (places, color, dash) => {
      c.strokeStyle = c.fillStyle = themeColor(color);
      c.lineWidth = 2;
      c.setLineDash(dash);
      c.beginPath();
      for (const place of places) c.lineTo(...place);
      c.stroke();
      c.setLineDash([]);
      for (const place of places) {
        c.beginPath();
        c.arc(...place, 3, 0, 2 * Math.PI);
        c.fill();
      }
    };
    line(this.effect(k).map(({x, mean}) => [axes.x(x), axes.y(mean)]), 'c0', []);
    const slice = this.slice(k);
    line(slice.map((i) => this.place(i, k)), 'c1', [5, 3]);
    for (const i of slice) {  // intervals over the seeds
      const {low, high} = this.figures[i];
      if (low === null) continue;
      const [x] = this.place(i, k);
      c.beginPath();
      c.moveTo(x, axes.y(low));
      c.lineTo(x, axes.y(high));
      c.stroke();
    }
  }
  at(px, py, k) {
    let best = null, least = 12 ** 2;
    this.figures.forEach(({mean}, i) => {
      if (mean === null) return;
      const [x, y] = this.place(i, k), d = (x - px) ** 2 + (y - py) ** 2;
      if (d < least) [least, best] = [d, i];
    });
    return best;
  }
  lines(px, py, k) {
    const i = this.at(px, py, k);
    return i === null ? null : pointLines(this.points, i, [this.choice.column]);
  }
}
