'use strict';
// Plots with a common horizontal axis and cursor. The axis is time unless the data name another one.

const plotHeight = 190;
/** The horizontal axis: key of its values in a panel, names, unit, whether points are marked, and whether it is logarithmic. */
const timeAxis = {key: 't_s', label: 'time, s', symbol: 't', unit: 's', points: false};
const roleColors = {left: 'c0', right: 'c1', front: 'c2', rear: 'c3', down: 'c4',
  true: 'true', est: 'est', cmd: 'cmd', a: 'c0', b: 'c1', c: 'c2', d: 'c3'};

/** Returns color, width and dashes of each series of a panel. That of another run is dashed, in the color of the series before it. */
function seriesLooks(series) {
  let next = 0, color;
  return series.map(({label, role}) => {
    const other = label.endsWith(', other run');
    if (!other) color = themeColor(roleColors[role] || 'c' + next++ % 6);
    return {color, width: role === 'true' ? 1.75 : role === 'est' ? 1 : 1.25, dash: other ? [6, 4] : undefined};
  });
}

/** Returns the ends of the value axis: the range of the data with a margin, or the fixed end of the panel. */
function valueRange(panel) {
  return (u, low, high) => {
    if (low === null) [low, high] = [0, 1];
    for (const {value} of panel.limits) [low, high] = [Math.min(low, value), Math.max(high, value)];
    const pad = high - low > 1e-12 ? 0.08 * (high - low) : Math.max(Math.abs(high), 1) * 0.1;
    return [panel.lowest ?? low - pad, panel.highest === null ? high + pad : Math.min(panel.highest, high + pad)];
  };
}

/** Returns the ends of the horizontal axis around a single value; undefined for several values. */
function onlyRange([value, ...others]) {
  return value === undefined || others.length ? undefined : [value - 1, value + 1];
}

/** Draws limits as dashed lines with their names. */
function drawLimits(u, panel) {
  for (const {label, value} of panel.limits) {
    const y = u.valToPos(value, 'y', true);
    const {left, width} = u.bbox, c = u.ctx;
    c.save();
    c.strokeStyle = c.fillStyle = themeColor('bad');
    c.lineWidth = devicePixelRatio;
    c.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
    c.beginPath();
    c.moveTo(left, y);
    c.lineTo(left + width, y);
    c.stroke();
    c.font = `${11 * devicePixelRatio}px system-ui, "DejaVu Sans", sans-serif`;
    c.textAlign = 'right';
    c.textBaseline = 'bottom';
    c.fillText(`${label} ${short(value)} ${unitWords(panel.unit)}`.trim(), left + width - 4 * devicePixelRatio, y - 2 * devicePixelRatio);
    c.restore();
  }
}

/** Shades the failures of the scenario behind the curves. */
function drawFailures(u, failures) {
  const {top, height} = u.bbox, c = u.ctx;
  c.save();
  c.fillStyle = themeColor('bad');
  c.font = `${11 * devicePixelRatio}px system-ui, "DejaVu Sans", sans-serif`;
  c.textAlign = 'left';
  c.textBaseline = 'top';
  let row = 0, end = -Infinity;  // of the texts: one that begins before the end of another is in the next row
  for (const {from_s, to_s, text} of failures) {
    const [from, to] = [from_s, to_s].map((t) => Math.min(Math.max(u.valToPos(t, 'x', true), u.bbox.left), u.bbox.left + u.bbox.width));
    if (to <= from) continue;
    c.globalAlpha = 0.12;
    c.fillRect(from, top, to - from, height);
    c.globalAlpha = 1;
    row = from < end ? row + 1 : 0;
    end = from + c.measureText(text).width + 6 * devicePixelRatio;
    c.fillText(text, from + 3 * devicePixelRatio, top + (2 + 13 * row) * devicePixelRatio);
  }
  c.restore();
}

/** Returns "north 0, east 0, down 0 m/s (constant)" for a panel with constant series, else "". */
function flatWords({series, unit, limits}) {
  const isFlat = ({values}) => values.length > 1 && values[0] !== null && values.every((v) => v === values[0]);
  if (limits.length || !series.length || !series.every(isFlat)) return '';
  return series.map(({label, values}) => `${label} ${short(values[0])}`).join(', ') + ` ${unit} (constant)`;
}

class Charts {
  /**
   * @param host  element to fill with a heading and a grid of plots for each section.
   * @param panels  of the report's data.
   * @param on  {hover(t), pick(t)}.
   * @param failures  of failuresOf(), shaded.
   * @param axis  like timeAxis. @param height  of a plot, px.
   */
  constructor(host, panels, sectionNotes, on, failures = [], axis = timeAxis, height = plotHeight) {
    Object.assign(this, {on, failures, axis, height, plots: [], following: false});
    const sections = new Map();
    for (const panel of panels) {
      if (!sections.has(panel.section)) sections.set(panel.section, this.addSection(host, panel.section, sectionNotes));
      const card = sections.get(panel.section).appendChild(make('section', 'chart card'));
      card.append(make('h3', '', panel.title), make('div', 'note', panel.note));
      const flat = axis === timeAxis && flatWords(panel);
      if (flat) {
        card.classList.add('flat');
        card.append(make('p', '', flat));
        continue;
      }
      const plot = card.appendChild(make('div', 'plot'));
      describeDrawing(plot, `Plot of ${panel.series.map(({label}) => label).join(', ')} over ${axis.label}`);
      this.plots.push({panel, host: plot, u: null});
    }
    this.build();
    const fit = () => this.plots.forEach(({u, host: {clientWidth}}) => {
      if (clientWidth && u.width !== clientWidth) u.setSize({width: clientWidth, height});
    });
    const observer = new ResizeObserver(() => requestAnimationFrame(fit));
    for (const {host: plot} of this.plots) observer.observe(plot);
  }

  addSection(host, name, notes) {
    const head = host.appendChild(make('div', 'charts-head'));
    head.append(make('h2', '', name), make('span', 'soft', notes[name] || ''));
    return host.appendChild(make('div', 'charts'));
  }

  /** Builds all plots in the colors of the current theme. */
  build() {
    for (const plot of this.plots) {
      plot.u?.destroy();
      plot.u = new uPlot(this.options(plot), [plot.panel[this.axis.key], ...plot.panel.series.map((s) => s.values)], plot.host);
    }
  }

  options({panel, host}) {
    const soft = themeColor('soft'), grid = {stroke: themeColor('faint'), width: 1};
    const font = '11px system-ui, "DejaVu Sans", sans-serif';
    const axis = {stroke: soft, grid, ticks: {...grid, size: 4}, font, labelFont: font, labelSize: 16, labelGap: 0};
    const looks = seriesLooks(panel.series), {label: xLabel, symbol, unit, points} = this.axis;
    return {
      width: host.clientWidth || 400, height: this.height,
      scales: {x: {time: false, distr: this.axis.log ? 3 : 1, range: onlyRange(panel[this.axis.key])}, y: {range: valueRange(panel)}},
      cursor: {y: false, drag: {x: true, y: false}, points: {size: 6}, bind: {
        mouseup: (u, target, handler) => (event) => {
          const clicked = u.select.width < 3;
          handler(event);
          if (clicked && u.cursor.left >= 0) this.on.pick(u.posToVal(u.cursor.left, 'x'));
          return null;
        },
        mouseleave: (u, target, handler) => (event) => {
          handler(event);
          this.on.hover(null);
          return null;
        }}},
      axes: [{...axis, size: 30, label: xLabel, labelSize: 14,
        values: (u, splits) => splits.map((v) => v === null ? '' : v.toLocaleString('en-US').replace('-', '−'))},
        {...axis, space: Math.min(30, this.height / 7), size: (u, texts) => Math.max(46, 14 + 7 * Math.max(...(texts ?? []).map(({length}) => length))), label: unitWords(panel.unit) || (panel.series.length === 1 ? panel.series[0].label : panel.title), values: (u, splits) => tickTexts(splits)}],
      series: [{label: symbol, value: (u, v) => v === null ? '' : `${fixed(v, 2)} ${unit}`},
        ...panel.series.map(({label, role}, i) => ({
          label, stroke: looks[i].color, width: looks[i].width, dash: looks[i].dash, points: points && role !== 'est' ? {show: true, size: 5, fill: looks[i].color} : {show: false},
          paths: role === 'cmd' ? uPlot.paths.stepped({align: 1}) : undefined,
          value: (u, v) => v === null || v === undefined ? '–' : short(v)}))],
      hooks: {
        drawAxes: [(u) => drawFailures(u, this.failures)],
        draw: [(u) => drawLimits(u, panel)],
        setScale: [(u, key) => key === 'x' && this.zoomAll(u)],
        setCursor: [(u) => !this.following && u.cursor.left >= 0 && this.on.hover(u.posToVal(u.cursor.left, 'x'))],
      },
    };
  }

  /** Sets the axis range of all plots to that of one of them. */
  zoomAll(source) {
    if (this.zooming) return;
    this.zooming = true;
    const {min, max} = source.scales.x;
    for (const {u} of this.plots) if (u && u !== source && min !== null) u.setScale('x', {min, max});
    this.zooming = false;
  }

  /** Moves the cursor of all plots to a position on the axis; null hides it. */
  setTime(t) {
    this.following = true;
    for (const {u} of this.plots) {
      if (u) u.setCursor(t === null ? {left: -10, top: -10} : {left: u.valToPos(t, 'x'), top: u.over.clientHeight / 2});
    }
    this.following = false;
  }
}
