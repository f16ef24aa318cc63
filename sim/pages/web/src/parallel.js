'use strict';
// Parallel coordinates: each point of a sweep is a line through its parameters and means of columns.

class ParallelView {
  constructor(host, points, choice, on) {
    Object.assign(this, {points, on, chosen: null, bottom: 280, font: '11px system-ui, "DejaVu Sans", sans-serif'});
    this.host = host.appendChild(make('div', 'scroll')).appendChild(make('div', 'plot-host'));
    this.canvas = this.host.appendChild(make('canvas'));
    this.tip = this.host.appendChild(make('div', 'tip'));
    this.tip.hidden = true;
    this.canvas.addEventListener('pointermove', (event) => this.hover(event.offsetX, event.offsetY));
    this.canvas.addEventListener('pointerleave', () => this.hover(-1, -1));
    this.canvas.addEventListener('click', (event) => {
      const i = this.at(event.offsetX, event.offsetY);
      if (i !== null) on.choosePoint(i);
    });
    new ResizeObserver(() => requestAnimationFrame(() => this.draw())).observe(this.host);
    this.setChoice(choice);
  }
  setChoice(choice) {
    this.choice = choice;
    const {points} = this, extra = ['passed', 'min_obstacle_clearance_m', 'flight_time_s'].filter((name) => name !== choice.column && points.varies(name)).slice(0, 2);
    const ofParameter = (path, k) => {
      const {axis, at} = parameterAxis(points, k);
      return {name: points.headings()[k], axis, of: (i) => at(points.points[i].values[k])};
    };
    const ofColumn = (name) => {
      const figures = points.of(name);
      return {name: 'mean ' + points.label(name), axis: numberAxis('', figures.map(({mean}) => mean)), of: (i) => figures[i].mean};
    };
    this.axes = [...points.paths.map(ofParameter), ...extra.map(ofColumn), ofColumn(choice.column)];
    this.host.style.minWidth = 92 + 84 * (this.axes.length - 1) + 'px';  // for the names
    this.range = finiteRange(points.of(choice.column).map(({mean}) => mean));
    describeDrawing(this.canvas, `Parallel coordinates of ${this.axes.map(({name}) => name).join(', ')}`);
    this.draw();
  }
  setChosen(i) {
    this.chosen = i;
    this.draw();
  }
  x(k) { return 46 + k * (this.host.clientWidth - 92) / (this.axes.length - 1); }
  y(k, value) {
    const {low, high} = this.axes[k].axis;
    return this.bottom - (value - low) / (high - low) * (this.bottom - 16);
  }
  line(c, i) {
    c.beginPath();
    this.axes.forEach(({of}, k) => { if (of(i) !== null) c.lineTo(this.x(k), this.y(k, of(i))); });
    c.stroke();
  }
  draw() {
    const width = this.host.clientWidth, dpr = window.devicePixelRatio || 1;
    if (!width) return;
    const c = this.canvas.getContext('2d');
    c.font = this.font;
    // Whole names, in as many lines as they need.
    const room = Math.min(88, (width - 92) / (this.axes.length - 1) - 6);
    const names = this.axes.map(({name}) => wrappedLines(c, name, room));
    const height = this.bottom + 10 + 13 * Math.max(...names.map(({length}) => length));
    this.canvas.width = Math.round(width * dpr);
    this.canvas.height = Math.round(height * dpr);
    this.canvas.style.height = height + 'px';
    const ramp = makeRamp(themeColor('ramp')), figures = this.points.of(this.choice.column);
    c.setTransform(dpr, 0, 0, dpr, 0, 0);
    const [low, high] = this.range, count = this.points.points.length;
    c.globalAlpha = count > 300 ? 0.25 : count > 60 ? 0.5 : 0.8;
    c.lineWidth = 1.25;
    for (const i of [...this.points.ranking(this.choice)].reverse()) {  // the best on top
      const share = figures[i].mean === null || high === low ? 0.5 : (figures[i].mean - low) / (high - low);
      c.strokeStyle = ramp(this.choice.less ? 1 - share : share);
      this.line(c, i);
    }
    c.globalAlpha = 1;
    for (const i of [this.chosen, this.hovered]) {
      if (i === null || i === undefined) continue;
      c.strokeStyle = themeColor('ink');
      c.lineWidth = 3;
      this.line(c, i);
    }
    this.drawAxes(c, names);
  }
  drawAxes(c, names) {
    c.font = this.font;
    c.textAlign = 'center';
    this.axes.forEach(({axis}, k) => {
      const x = this.x(k);
      c.strokeStyle = themeColor('soft');
      c.lineWidth = 1;
      c.beginPath();
      c.moveTo(x, 16);
      c.lineTo(x, this.bottom);
      c.stroke();
      const {values} = niceTicks(axis.low, axis.high, 5), texts = tickTexts(values);
      const ticks = axis.ticks ?? values.map((value, i) => ({value, text: texts[i]}));
      for (const {value, text} of ticks) {
        const y = this.y(k, value), wide = c.measureText(text).width;
        c.fillStyle = themeColor('card');
        c.globalAlpha = 0.75;
        c.fillRect(x - wide / 2 - 2, y - 7, wide + 4, 13);
        c.globalAlpha = 1;
        c.fillStyle = themeColor('ink');
        c.fillText(text, x, y + 4);
      }
      c.fillStyle = themeColor('soft');
      names[k].forEach((line, i) => c.fillText(line, x, this.bottom + 20 + 13 * i));
    });
  }
  at(px, py) {
    let nearest = null, nearest_px = 8;
    const k = this.axes.findIndex((_, index) => index + 1 < this.axes.length && px >= this.x(index) && px <= this.x(index + 1));
    if (k < 0) return null;
    const share = (px - this.x(k)) / (this.x(k + 1) - this.x(k));
    this.points.points.forEach((_, i) => {
      const [a, b] = [this.axes[k].of(i), this.axes[k + 1].of(i)];
      if (a === null || b === null) return;
      const d = Math.abs(this.y(k, a) * (1 - share) + this.y(k + 1, b) * share - py);
      if (d < nearest_px) [nearest_px, nearest] = [d, i];
    });
    return nearest;
  }
  hover(px, py) {
    const i = this.at(px, py);
    this.tip.hidden = i === null;
    if (i !== this.hovered) {
      this.hovered = i;
      this.draw();
    }
    if (i === null) return;
    this.tip.replaceChildren(...pointLines(this.points, i, [this.choice.column]).map((line, n) => make(n ? 'div' : 'b', '', line)));
    this.tip.style.left = Math.max(0, Math.min(px + 16, this.host.clientWidth - this.tip.offsetWidth)) + 'px';
    this.tip.style.top = Math.max(0, py - this.tip.offsetHeight - 8) + 'px';
  }
}
