'use strict';
// The flight seen from above, true to scale: north up, east right, metres.

const planMargin = {left: 46, right: 12, top: 12, bottom: 34};

/** What the path can be coloured by. The clearance scale ends where more of it no longer matters. */
function pathColorings(path) {
  const colorings = [];
  if (path.clearance.some((v) => v !== null)) {
    colorings.push({name: 'clearance', unit: 'm', values: path.clearance, ramp: 'ramp', low: 0,
      high: Math.ceil(2 * Math.max(1, Math.min(10, quantile(path.clearance, 0.9)))) / 2, open: true});
  }
  const [slow, fast] = finiteRange(path.speed);
  colorings.push({name: 'time', unit: 's', values: path.t, ramp: 'ramp-time', low: path.t[0], high: path.t.at(-1)});
  colorings.push({name: 'speed', unit: 'm/s', values: path.speed, ramp: 'ramp-time', low: slow, high: fast});
  return colorings;
}

function placeText(north, east) {
  return `north ${north.toFixed(1)} m, east ${east.toFixed(1)} m`.replaceAll('-', '−');
}

class PlanView {
  /**
   * @param host  element to fill.
   * @param data  the report's data.
   * @param on  {hover(t), pick(t)}: told of the instant under the pointer, null for none.
   */
  constructor(host, data, on) {
    Object.assign(this, {host, on, plan: data.plan, path: data.path, result: data.result});
    this.colorings = pathColorings(this.path);
    this.coloring = this.colorings[0];
    this.row = null;
    this.canvas = host.appendChild(document.createElement('canvas'));
    this.tip = host.appendChild(make('div', 'tip'));
    this.tip.hidden = true;
    this.addTools();
    this.key = host.appendChild(make('div', 'plan-key'));
    this.whole = this.wholeView();
    this.view = {...this.whole};
    this.addPointer();
    new ResizeObserver(() => requestAnimationFrame(() => this.draw())).observe(host);
    this.draw();
  }

  /** Centre and extent, m, of what there is to see. */
  wholeView() {
    const {plan, path} = this;
    const norths = [...path.n, ...plan.bounds.slice(0, 2)], easts = [...path.e, ...plan.bounds.slice(2)];
    if (plan.goal) {
      norths.push(plan.goal.n - plan.goal.radius, plan.goal.n + plan.goal.radius);
      easts.push(plan.goal.e - plan.goal.radius, plan.goal.e + plan.goal.radius);
    }
    const [n0, n1] = finiteRange(norths), [e0, e1] = finiteRange(easts);
    const pad = 0.03 * Math.max(n1 - n0, e1 - e0, 1);
    return {n: (n0 + n1) / 2, e: (e0 + e1) / 2, height: n1 - n0 + 2 * pad, width: e1 - e0 + 2 * pad};
  }

  addTools() {
    const tools = this.host.appendChild(make('div', 'plan-tools'));
    const button = (text, title, action) => {
      const b = tools.appendChild(make('button', '', text));
      b.title = title;
      b.addEventListener('click', action);
    };
    button('+', 'Closer', () => this.zoom(1.6));
    button('−', 'Further', () => this.zoom(1 / 1.6));
    button('path', 'Show the path', () => this.showPath());
    button('all', 'Show the whole scene', () => this.show({...this.whole}));
  }

  show(view) {
    this.view = view;
    const moved = view.width < this.whole.width || view.height < this.whole.height;
    this.canvas.classList.toggle('moves', moved);
    this.draw();
  }
  zoom(factor) {
    const {n, e, width, height} = this.view;
    const clamp = Math.max(factor, height / this.whole.height, width / this.whole.width);
    const f = factor < 1 ? Math.min(1, clamp) : factor;
    this.show(f === 1 ? {...this.whole} : {n, e, width: width / f, height: height / f});
  }
  showPath() {
    const [n0, n1] = finiteRange(this.path.n), [e0, e1] = finiteRange(this.path.e);
    const pad = 0.08 * Math.max(n1 - n0, e1 - e0, 2);
    this.show({n: (n0 + n1) / 2, e: (e0 + e1) / 2, height: n1 - n0 + 2 * pad, width: e1 - e0 + 2 * pad});
  }

  /** Sizes the canvas and works out pixels per metre. The card keeps the shape of the whole scene. */
  layout() {
    const width = this.host.clientWidth;
    const inner = width - planMargin.left - planMargin.right;
    const tallest = Math.min(window.innerWidth < 600 ? 460 : 680, 1.15 * width);
    const height = Math.min(Math.max(inner * this.whole.height / this.whole.width + planMargin.top + planMargin.bottom, 220), tallest);
    const dpr = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * dpr);
    this.canvas.height = Math.round(height * dpr);
    this.canvas.style.height = height + 'px';
    const frame = {x: planMargin.left, y: planMargin.top, width: inner, height: height - planMargin.top - planMargin.bottom};
    this.frame = frame;
    this.scale = Math.min(frame.width / this.view.width, frame.height / this.view.height);
    this.dpr = dpr;
  }
  x(e) { return this.frame.x + this.frame.width / 2 + (e - this.view.e) * this.scale; }
  y(n) { return this.frame.y + this.frame.height / 2 - (n - this.view.n) * this.scale; }
  east(x) { return this.view.e + (x - this.frame.x - this.frame.width / 2) / this.scale; }
  north(y) { return this.view.n - (y - this.frame.y - this.frame.height / 2) / this.scale; }

  draw() {
    if (!this.host.clientWidth) return;
    this.layout();
    const c = this.canvas.getContext('2d');
    c.setTransform(this.dpr, 0, 0, this.dpr, 0, 0);
    c.font = '11px system-ui, "DejaVu Sans", sans-serif';
    c.lineJoin = c.lineCap = 'round';
    const {x, y, width, height} = this.frame;
    c.fillStyle = themeColor('plan');
    c.fillRect(x, y, width, height);
    this.drawAxes(c);
    c.save();
    c.beginPath();
    c.rect(x, y, width, height);
    c.clip();
    this.drawSolids(c);
    this.drawMovers(c);
    this.drawGoal(c);
    this.drawPath(c);
    this.drawMarks(c);
    c.restore();
    c.strokeStyle = themeColor('line');
    c.lineWidth = 1;
    c.strokeRect(x, y, width, height);
    this.drawKey();
  }

  drawAxes(c) {
    const {x, y, width, height} = this.frame;
    const count = (pixels) => Math.max(2, pixels / 70);
    const easts = niceTicks(this.east(x), this.east(x + width), count(width));
    const norths = niceTicks(this.north(y + height), this.north(y), count(height));
    const step = Math.max(easts.step, norths.step);
    const onStep = (v) => Math.abs(v / step - Math.round(v / step)) < 1e-6;
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const text = (v) => (Math.abs(v) < 1e-9 ? 0 : v).toFixed(digits).replace('-', '−');
    c.strokeStyle = themeColor('faint');
    c.fillStyle = themeColor('soft');
    c.lineWidth = 1;
    c.beginPath();
    c.textAlign = 'center';
    c.textBaseline = 'top';
    for (const e of easts.values.filter(onStep)) {
      c.moveTo(this.x(e), y);
      c.lineTo(this.x(e), y + height);
      c.fillText(text(e), this.x(e), y + height + 5);
    }
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const n of norths.values.filter(onStep)) {
      c.moveTo(x, this.y(n));
      c.lineTo(x + width, this.y(n));
      c.fillText(text(n), x - 6, this.y(n));
    }
    c.stroke();
    c.textAlign = 'center';
    c.textBaseline = 'alphabetic';
    c.fillText('east, m', x + width / 2, y + height + 30);
    c.save();
    c.translate(11, y + height / 2);
    c.rotate(-Math.PI / 2);
    c.fillText('north, m', 0, 0);
    c.restore();
  }

  drawSolids(c) {
    const [n0, n1, e0, e1] = this.plan.bounds;
    if (this.plan.bounds.length) {
      c.strokeStyle = themeColor('solid-edge');
      c.setLineDash([4, 4]);
      c.strokeRect(this.x(e0), this.y(n1), (e1 - e0) * this.scale, (n1 - n0) * this.scale);
      c.setLineDash([]);
    }
    for (const level of ['below', 'beside']) {
      c.fillStyle = themeColor(level === 'beside' ? 'solid' : 'low');
      c.strokeStyle = themeColor('solid-edge');
      c.lineWidth = level === 'beside' ? 1 : 0.5;
      for (const solid of this.plan.footprints) {
        if (solid.level !== level) continue;
        c.beginPath();
        for (const [n, e] of solid.corners) c.lineTo(this.x(e), this.y(n));
        c.closePath();
        c.fill();
        c.stroke();
      }
    }
  }

  /** The ways of movers: as wide as they are, their middle dashed. */
  drawMovers(c) {
    for (const {way, radius} of this.plan.movers) {
      const trace = () => {
        c.beginPath();
        for (const [n, e] of way) c.lineTo(this.x(e), this.y(n));
        if (way.length === 1) c.lineTo(this.x(way[0][1]) + 0.01, this.y(way[0][0]));
        c.stroke();
      };
      c.strokeStyle = themeColor('low');
      c.lineWidth = Math.max(2, 2 * radius * this.scale);
      trace();
      c.strokeStyle = themeColor('solid-edge');
      c.lineWidth = 1;
      c.setLineDash([6, 4]);
      trace();
      c.setLineDash([]);
    }
  }

  drawGoal(c) {
    const {goal} = this.plan;
    if (!goal) return;
    c.strokeStyle = themeColor('c2');
    c.lineWidth = 2;
    c.setLineDash([5, 3]);
    c.beginPath();
    c.arc(this.x(goal.e), this.y(goal.n), goal.radius * this.scale, 0, 2 * Math.PI);
    c.stroke();
    c.setLineDash([]);
    this.cross(c, this.x(goal.e), this.y(goal.n), 5, themeColor('c2'));
    this.label(c, 'goal', this.x(goal.e), this.y(goal.n) - Math.max(goal.radius * this.scale, 6) - 8, themeColor('c2'));
  }

  drawPath(c) {
    const {path, coloring} = this;
    const count = path.n.length;
    const trace = (from, to) => {
      c.beginPath();
      for (let i = from; i <= to; ++i) c.lineTo(this.x(path.e[i]), this.y(path.n[i]));
      c.stroke();
    };
    c.strokeStyle = themeColor('plan');
    c.lineWidth = 5;
    trace(0, count - 1);
    c.lineWidth = 2.5;
    const ramp = makeRamp(themeColor(coloring.ramp));
    const shades = 48, span = coloring.high - coloring.low || 1;
    const shade = (i) => Math.min(shades - 1, Math.max(0,
      coloring.values[i] === null ? shades - 1 : Math.floor((coloring.values[i] - coloring.low) / span * shades)));
    for (let from = 0; from < count - 1;) {
      let to = from + 1;
      while (to < count - 1 && shade(to) === shade(from)) ++to;
      c.strokeStyle = ramp(shade(from) / (shades - 1));
      trace(from, to);
      from = to;
    }
  }

  drawMarks(c) {
    const {path, result} = this;
    const ink = themeColor('ink'), last = path.n.length - 1;
    if (last < 0) return;
    this.dot(c, this.x(path.e[0]), this.y(path.n[0]), 5, themeColor('c0'));
    this.label(c, 'start', this.x(path.e[0]), this.y(path.n[0]) - 13, themeColor('c0'));
    const end = [this.x(path.e[last]), this.y(path.n[last])];
    if (result.outcome === 'collided') this.cross(c, ...end, 8, themeColor('bad'), 3.5);
    else this.dot(c, ...end, 4, ink);

    const near = result.closest_obstacle;
    if (near) {
      const x = this.x(near.east_m), y = this.y(near.north_m);
      c.strokeStyle = themeColor('bad');
      c.lineWidth = 2;
      c.beginPath();
      c.arc(x, y, 9, 0, 2 * Math.PI);
      c.stroke();
      const text = result.outcome === 'collided' && near.distance_m <= 0 ? 'collided' : 'closest: ' + metres(near.distance_m);
      this.label(c, text, x, y + 20, themeColor('bad'));
    }
    if (this.row !== null) this.drawVehicle(c, this.row, ink);
  }

  /** An arrowhead along the heading. */
  drawVehicle(c, row, ink) {
    c.save();
    c.translate(this.x(this.path.e[row]), this.y(this.path.n[row]));
    c.rotate(this.path.yaw[row]);
    c.beginPath();
    for (const [x, y] of [[0, -11], [7, 8], [0, 4], [-7, 8]]) c.lineTo(x, y);
    c.closePath();
    c.fillStyle = ink;
    c.strokeStyle = themeColor('plan');
    c.lineWidth = 1.5;
    c.fill();
    c.stroke();
    c.restore();
  }

  dot(c, x, y, radius, color) {
    c.beginPath();
    c.arc(x, y, radius, 0, 2 * Math.PI);
    c.fillStyle = color;
    c.strokeStyle = themeColor('plan');
    c.lineWidth = 2;
    c.fill();
    c.stroke();
  }
  cross(c, x, y, size, color, width = 2) {
    c.strokeStyle = color;
    c.lineWidth = width;
    c.beginPath();
    c.moveTo(x - size, y - size);
    c.lineTo(x + size, y + size);
    c.moveTo(x - size, y + size);
    c.lineTo(x + size, y - size);
    c.stroke();
  }
  /** Text with a halo, kept inside the frame. */
  label(c, text, x, y, color) {
    c.font = '600 12px system-ui, "DejaVu Sans", sans-serif';
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    const half = c.measureText(text).width / 2 + 4, {frame} = this;
    const inside = (v, low, high) => Math.min(Math.max(v, low), high);
    const visible = x > frame.x && x < frame.x + frame.width && y > frame.y - 20 && y < frame.y + frame.height + 20;
    if (!visible) return;
    const at = [inside(x, frame.x + half, frame.x + frame.width - half), inside(y, frame.y + 9, frame.y + frame.height - 9)];
    c.strokeStyle = themeColor('plan');
    c.lineWidth = 4;
    c.strokeText(text, ...at);
    c.fillStyle = color;
    c.fillText(text, ...at);
  }

  drawKey() {
    const {coloring} = this;
    this.key.replaceChildren();
    const ramp = this.key.appendChild(make('span', 'ramp'));
    ramp.append(coloring.name + ' ' + short(coloring.low));
    ramp.appendChild(make('i')).style.background = `linear-gradient(90deg, ${themeColor(coloring.ramp)})`;
    ramp.append(short(coloring.high) + (coloring.open ? ' or more ' : ' ') + coloring.unit);
    const levels = new Set(this.plan.footprints.map((f) => f.level));
    const entry = (color, text) => {
      const item = this.key.appendChild(make('span'));
      item.appendChild(make('i')).style.cssText = `background: ${themeColor(color)}; border: 1px solid ${themeColor('solid-edge')}`;
      item.append(text);
    };
    if (levels.has('beside')) entry('solid', 'obstacle at flight height');
    if (levels.has('below')) entry('low', 'below the flight');
    this.key.append(make('span', '', 'north up, true to scale'));
  }

  addPointer() {
    let drag = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      drag = {x: event.offsetX, y: event.offsetY, view: {...this.view}, moved: false};
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (drag && this.canvas.classList.contains('moves') && event.buttons) {
        const dx = event.offsetX - drag.x, dy = event.offsetY - drag.y;
        drag.moved ||= Math.hypot(dx, dy) > 4;
        this.show({...drag.view, n: drag.view.n + dy / this.scale, e: drag.view.e - dx / this.scale});
      } else {
        this.hover(event.offsetX, event.offsetY);
      }
    });
    this.canvas.addEventListener('pointerup', () => {
      if (drag && !drag.moved && this.row !== null) this.on.pick(this.path.t[this.row]);
      drag = null;
    });
    this.canvas.addEventListener('pointerleave', () => {
      this.tip.hidden = true;
      this.on.hover(null);
    });
  }

  hover(x, y) {
    const {path} = this;
    let best = null, least = 24 ** 2;
    for (let i = 0; i < path.n.length; ++i) {
      const d = (this.x(path.e[i]) - x) ** 2 + (this.y(path.n[i]) - y) ** 2;
      if (d < least) [least, best] = [d, i];
    }
    if (best !== null) {
      this.on.hover(path.t[best]);
      this.showTip(x, y, this.rowLines(best));
      return;
    }
    this.on.hover(null);
    const solid = this.solidAt(this.north(y), this.east(x));
    const lines = [placeText(this.north(y), this.east(x))];
    if (solid) lines.unshift(`${solid.name || 'obstacle'}, ${solid.bottom.toFixed(1)} to ${solid.top.toFixed(1)} m high`);
    this.showTip(x, y, lines);
  }

  rowLines(i) {
    const {path} = this;
    const status = path.status[i] >= 0 ? ', ' + path.statuses[path.status[i]] : '';
    return [`t = ${path.t[i].toFixed(2)} s${status}`,
      `clearance ${path.clearance[i] === null ? 'none in reach' : metres(path.clearance[i])}`,
      `speed ${path.speed[i].toFixed(2)} m/s, altitude ${path.altitude[i].toFixed(1)} m`,
      placeText(path.n[i], path.e[i])];
  }

  showTip(x, y, lines) {
    this.tip.replaceChildren(...lines.map((line, i) => make(i ? 'div' : 'b', '', line)));
    this.tip.hidden = false;
    const left = x + 16 + this.tip.offsetWidth > this.host.clientWidth ? x - 16 - this.tip.offsetWidth : x + 16;
    this.tip.style.left = Math.max(0, left) + 'px';
    this.tip.style.top = Math.max(0, y - this.tip.offsetHeight - 8) + 'px';
  }

  solidAt(n, e) {
    return this.plan.footprints.find(({corners, level}) => level !== 'above' && corners.every(([n0, e0], i) => {
      const [n1, e1] = corners[(i + 1) % corners.length];
      const [n2, e2] = corners[(i + 2) % corners.length];
      const side = (pn, pe) => (n1 - n0) * (pe - e0) - (e1 - e0) * (pn - n0);
      return side(n, e) * side(n2, e2) >= 0;
    }));
  }

  /** Shows the vehicle at an instant; null hides it. */
  setTime(t) {
    const {path} = this;
    let row = null;
    if (t !== null && path.t.length) {
      let low = 0, high = path.t.length - 1;
      while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (path.t[middle] <= t) low = middle; else high = middle - 1;
      }
      row = low;
    }
    if (row === this.row) return;
    this.row = row;
    this.draw();
  }
  setColoring(name) {
    this.coloring = this.colorings.find((c) => c.name === name);
    this.draw();
  }
}
