'use strict';
// Two axes on a canvas, of numbers or categories, with ticks, names and units.

const axesMargin = {left: 62, right: 14, top: 12, bottom: 44};

/** An axis of numbers. */
function numberAxis(label, values) {
  let [low, high] = finiteRange(values);
  if (low === high) [low, high] = [low - 0.5, high + 0.5];
  const pad = 0.04 * (high - low);
  return {label, low: low - pad, high: high + pad, ticks: null};
}
/** An axis of categories, the i-th one from i - 0.5 to i + 0.5. */
function wordAxis(label, words) {
  return {label, words, low: -0.5, high: words.length - 0.5, ticks: words.map((text, value) => ({value, text}))};
}
/** Name and unit of a column. */
function columnLabel(column) { return column.unit ? `${column.name}, ${column.unit}` : column.name; }

class Axes {
  /** @param on  {draw(c, axes), hover(x, y) -> lines of text or null, pick(x, y)}: pixels of the canvas. */
  constructor(host, height, on) {
    Object.assign(this, {host, height, on, xAxis: numberAxis('', []), yAxis: numberAxis('', [])});
    host.classList.add('plot-host');
    this.canvas = host.appendChild(document.createElement('canvas'));
    this.tip = host.appendChild(make('div', 'tip'));
    this.tip.hidden = true;
    this.canvas.addEventListener('pointermove', (event) => this.showTip(event.offsetX, event.offsetY));
    this.canvas.addEventListener('pointerleave', () => { this.tip.hidden = true; });
    this.canvas.addEventListener('click', (event) => this.on.pick(event.offsetX, event.offsetY));
    new ResizeObserver(() => requestAnimationFrame(() => this.draw())).observe(host);
  }

  set(xAxis, yAxis) {
    Object.assign(this, {xAxis, yAxis});
    describeDrawing(this.canvas, `Plot of ${yAxis.label} over ${xAxis.label}`);
    this.draw();
  }
  x(value) { return this.frame.x + (value - this.xAxis.low) / (this.xAxis.high - this.xAxis.low) * this.frame.width; }
  y(value) { return this.frame.y + this.frame.height - (value - this.yAxis.low) / (this.yAxis.high - this.yAxis.low) * this.frame.height; }

  draw() {
    const width = this.host.clientWidth, dpr = window.devicePixelRatio || 1;
    if (!width) return;
    this.canvas.width = Math.round(width * dpr);
    this.canvas.height = Math.round(this.height * dpr);
    this.canvas.style.height = this.height + 'px';
    const {right, top, bottom} = axesMargin, left = axesMargin.left + (this.yAxis.words ? 60 : 0);
    this.left = left;
    this.frame = {x: left, y: top, width: width - left - right, height: this.height - top - bottom};
    const c = this.canvas.getContext('2d');
    c.setTransform(dpr, 0, 0, dpr, 0, 0);
    c.fillStyle = themeColor('plan');
    c.fillRect(this.frame.x, this.frame.y, this.frame.width, this.frame.height);
    this.drawTicks(c);
    c.save();
    c.beginPath();
    c.rect(this.frame.x, this.frame.y, this.frame.width, this.frame.height);
    c.clip();
    this.on.draw(c, this);
    c.restore();
    c.strokeStyle = themeColor('line');
    c.lineWidth = 1;
    c.strokeRect(this.frame.x, this.frame.y, this.frame.width, this.frame.height);
  }

  ticks(axis, pixels, spacing) {
    if (axis.ticks) {
      const every = Math.max(1, Math.ceil((axis.ticks.length - 1) * spacing / pixels));
      return axis.ticks.filter((tick, i) => i % every === 0);
    }
    return niceTicks(axis.low, axis.high, Math.max(2, pixels / 70)).values.map((value) => ({value, text: short(Math.abs(value) < 1e-12 ? 0 : value)}));
  }

  drawTicks(c) {
    const {x, y, width, height} = this.frame;
    c.font = '11px system-ui, "DejaVu Sans", sans-serif';
    c.strokeStyle = themeColor('faint');
    c.fillStyle = themeColor('soft');
    c.lineWidth = 1;
    c.textAlign = 'center';
    c.textBaseline = 'top';
    c.beginPath();
    const clipped = (text, width_px) => {
      let shown = text;
      while (shown.length > 2 && c.measureText(shown).width > width_px) shown = shown.slice(0, -2) + '…';
      return shown;
    };
    const wide = this.xAxis.ticks ? Math.max(38, Math.min(90, width / this.xAxis.ticks.length)) : 70;
    for (const {value, text} of this.ticks(this.xAxis, width, wide * 0.98)) {
      if (!this.xAxis.ticks) { c.moveTo(this.x(value), y); c.lineTo(this.x(value), y + height); }
      c.fillText(clipped(text, wide - 4), this.x(value), y + height + 5);
    }
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const {value, text} of this.ticks(this.yAxis, height, 16)) {
      if (!this.yAxis.ticks) { c.moveTo(x, this.y(value)); c.lineTo(x + width, this.y(value)); }
      c.fillText(clipped(text, this.left - 22), x - 5, this.y(value));
    }
    c.stroke();
    c.textAlign = 'center';
    c.textBaseline = 'alphabetic';
    c.fillText(this.xAxis.label, x + width / 2, y + height + 34);
    c.save();
    c.translate(11, y + height / 2);
    c.rotate(-Math.PI / 2);
    c.fillText(this.yAxis.label, 0, 0);
    c.restore();
  }

  showTip(x, y) {
    const lines = this.on.hover(x, y);
    this.tip.hidden = !lines;
    if (!lines) return;
    this.tip.replaceChildren(...lines.map((line, i) => make(i ? 'div' : 'b', '', line)));
    const left = x + 16 + this.tip.offsetWidth > this.host.clientWidth ? x - 16 - this.tip.offsetWidth : x + 16;
    this.tip.style.left = Math.max(0, left) + 'px';
    this.tip.style.top = Math.max(0, y - this.tip.offsetHeight - 8) + 'px';
  }
}
