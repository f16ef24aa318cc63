'use strict';
// Two axes on a canvas, of numbers or categories, with ticks, names and units.

const axesMargin = {left: 62, right: 14, top: 12, bottom: 44};

/** An axis of numbers. Its range is wide enough for ticks that differ. If `whole` is set in the result, only whole numbers have ticks. */
function numberAxis(label, values) {
  let [low, high] = finiteRange(values);
  const middle = low / 2 + high / 2, least = 1e-9 * Math.max(1, Math.abs(middle));
  const half = low === high ? Math.max(0.5, least) : high - low < least ? least / 2 : 0;
  if (half) [low, high] = [middle - half, middle + half];
  const pad = 0.04 * (high - low);
  return {label, low: low - pad, high: high + pad, ticks: null};
}
/** An axis of categories, the i-th one from i - 0.5 to i + 0.5. */
function wordAxis(label, words) {
  return {label, words, low: -0.5, high: words.length - 0.5, ticks: words.map((text, value) => ({value, text}))};
}

/** Returns a text in lines of this width, broken after spaces, underscores, slashes and dots, or anywhere in a long word. */
function wrappedLines(c, text, width_px) {
  const lines = [''];
  for (const part of text.split(/(?<=[ _/.])/).flatMap((word) => c.measureText(word).width > width_px ? [...word] : [word])) {
    if (lines.at(-1) && c.measureText(lines.at(-1) + part).width > width_px) lines.push('');
    lines[lines.length - 1] += part;
  }
  return lines;
}

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
  /** Returns "x,y", the whole numbers of the axes nearest to a pixel. */
  cellKey(px, py) {
    const {xAxis, yAxis, frame} = this;
    const x = Math.round(xAxis.low + (px - frame.x) / frame.width * (xAxis.high - xAxis.low));
    const y = Math.round(yAxis.low + (frame.y + frame.height - py) / frame.height * (yAxis.high - yAxis.low));
    return `${x},${y}`;
  }

  draw() {
    const width = this.host.clientWidth, dpr = window.devicePixelRatio || 1;
    if (!width) return;
    const c = this.canvas.getContext('2d'), {right, top} = axesMargin;
    c.font = '11px system-ui, "DejaVu Sans", sans-serif';
    this.lines = this.yAxis.words?.map((word) => wrappedLines(c, word, 0.32 * width)) ?? [];
    const longest = (words) => Math.max(...words.map((word) => c.measureText(word).width));
    const {words} = this.yAxis;
    const texts = words ? this.lines.flat() : this.ticks(this.yAxis, this.height - top - axesMargin.bottom, 16).map(({text}) => text);
    const left = Math.max(axesMargin.left, longest(texts) + 28);
    // All names remain visible: the plot grows with the rows, and long names below it are turned.
    this.turned = this.xAxis.words && longest(this.xAxis.words) + 8 > (width - left - right) / this.xAxis.words.length ? longest(this.xAxis.words) : 0;
    const bottom = axesMargin.bottom + this.turned;
    const height = Math.max(this.height, words ? words.length * (4 + 13 * Math.max(...this.lines.map(({length}) => length))) + top : 0) + this.turned;
    this.canvas.width = Math.round(width * dpr);
    this.canvas.height = Math.round(height * dpr);
    this.canvas.style.height = height + 'px';
    this.frame = {x: left, y: top, width: width - left - right, height: height - top - bottom};
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
    if (axis.words) return axis.ticks;
    if (axis.ticks) {
      const every = Math.max(1, Math.ceil((axis.ticks.length - 1) * spacing / pixels));
      return axis.ticks.filter((tick, i) => i % every === 0);
    }
    const {values} = niceTicks(axis.low, axis.high, axis.whole ? Math.min(pixels / 70, axis.high - axis.low) : Math.max(2, pixels / (axis === this.yAxis ? 45 : 70))), texts = tickTexts(values);
    return values.map((value, i) => ({value, text: texts[i]}));
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
    const wide = this.xAxis.ticks ? Math.max(38, Math.min(90, width / this.xAxis.ticks.length)) : 70;
    for (const {value, text} of this.ticks(this.xAxis, width, wide * 0.98)) {
      if (!this.xAxis.ticks) { c.moveTo(this.x(value), y); c.lineTo(this.x(value), y + height); }
      if (this.turned) {
        c.save();
        c.translate(this.x(value), y + height + 5);
        c.rotate(-Math.PI / 2);
        c.textAlign = 'right';
        c.textBaseline = 'middle';
        c.fillText(text, 0, 0);
        c.restore();
      } else {
        c.fillText(text, this.x(value), y + height + 5);
      }
    }
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const {value, text} of this.ticks(this.yAxis, height, 16)) {
      if (!this.yAxis.ticks) { c.moveTo(x, this.y(value)); c.lineTo(x + width, this.y(value)); }
      const lines = this.lines[value] ?? [text];
      lines.forEach((line, i) => c.fillText(line, x - 5, this.y(value) + 13 * (i - (lines.length - 1) / 2)));
    }
    c.stroke();
    c.textAlign = 'center';
    c.textBaseline = 'alphabetic';
    c.fillText(this.xAxis.label, x + width / 2, y + height + 34 + this.turned);
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
