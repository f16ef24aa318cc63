'use strict';
// Line charts with linear or logarithmic axes.

/** Returns the color of each label. Lines from a paper have the color of text. */
function labelColors(lines) {
  const colors = new Map();
  for (const {label, printed} of lines) {
    if (!colors.has(label)) colors.set(label, printed ? 'ink' : 'c' + [...colors.values()].filter((c) => c !== 'ink').length % 6);
  }
  return colors;
}

/** An axis of powers of ten; its values are logarithms. */
function logAxis(label, logs) {
  const axis = numberAxis(label, logs), low = Math.floor(axis.low), high = Math.ceil(axis.high), ticks = [];
  for (let power = low; power <= high; ++power) {
    for (const digit of high - low > 3 ? [1] : [1, 2, 5]) {
      const value = power + Math.log10(digit);
      if (value >= axis.low && value <= axis.high) ticks.push({value, text: short(digit * 10 ** power)});
    }
  }
  return {...axis, ticks};
}

class LineChart {
  /** @param chart  {x, y, log_x, log_y, lines: [{label, printed, x, y}]} of the page's data. */
  constructor(host, chart) {
    const scale = (values, log) => values.map((v) => v === null || !log ? v : v > 0 ? Math.log10(v) : null);
    this.chart = chart;
    this.lines = chart.lines.map((line) => ({...line, x: scale(line.x, chart.log_x), y: scale(line.y, chart.log_y)}));
    this.colors = labelColors(chart.lines);
    this.axes = new Axes(host.appendChild(make('div')), 300, {
      draw: (c) => this.draw(c), hover: (x, y) => this.words(x, y), pick: () => {}});
    this.fillKey(host.appendChild(make('div', 'plan-key')));
    const axis = (label, log, key) => (log ? logAxis : numberAxis)(label, this.lines.flatMap((line) => line[key]));
    this.axes.set(axis(chart.x, chart.log_x, 'x'), axis(chart.y, chart.log_y, 'y'));
  }

  fillKey(key) {
    for (const [label, color] of this.colors) {
      const item = key.appendChild(make('span'));
      item.appendChild(make('i')).style.cssText = `background: var(--${color}); height: 3px; vertical-align: 3px`;
      item.append(label);
    }
  }

  draw(c) {
    for (const line of this.lines ?? []) {
      c.strokeStyle = c.fillStyle = themeColor(this.colors.get(line.label));
      c.lineWidth = 1.5;
      c.setLineDash(line.printed ? [5, 4] : []);
      c.beginPath();
      let down = false;
      line.x.forEach((x, i) => {
        if (x === null || line.y[i] === null) { down = false; return; }
        c[down ? 'lineTo' : 'moveTo'](this.axes.x(x), this.axes.y(line.y[i]));
        down = true;
      });
      c.stroke();
      c.setLineDash([]);
      if (line.x.length <= 40) this.drawDots(c, line);
    }
  }
  drawDots(c, {x, y, printed}) {
    x.forEach((value, i) => {
      if (value === null || y[i] === null) return;
      c.beginPath();
      const at = [this.axes.x(value), this.axes.y(y[i])];
      if (printed) c.rect(at[0] - 3, at[1] - 3, 6, 6);
      else c.arc(...at, 3.5, 0, 2 * Math.PI);
      c.fill();
    });
  }

  words(px, py) {
    let best = null, least = 12 ** 2;
    this.lines.forEach((line, k) => line.x.forEach((x, i) => {
      if (x === null || line.y[i] === null) return;
      const d = (this.axes.x(x) - px) ** 2 + (this.axes.y(line.y[i]) - py) ** 2;
      if (d < least) [least, best] = [d, [k, i]];
    }));
    if (!best) return null;
    const {label, x, y} = this.chart.lines[best[0]];
    return [label, `${this.chart.x}: ${short(x[best[1]])}`, `${this.chart.y}: ${short(y[best[1]])}`];
  }
}
