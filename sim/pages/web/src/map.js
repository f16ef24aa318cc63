'use strict';
// Plan view of a scene to scale: north up, east right, meters. Other files draw the flights.

const narrowestView = 0.01;  // m
const mapMargin = {left: 56, right: 12, top: 12, bottom: 34};

function placeText(north, east) {
  return `north ${fixed(north, 1)} m, east ${fixed(east, 1)} m`;
}

class MapView {
  /**
   * @param host  element to fill.
   * @param plan  scene as in the pages' data: bounds, goal, route (may be absent), footprints, movers.
   * @param reach  {n, e}: positions outside the scene that must be in view, m.
   * @param on  {draw(c, map) over the scene; key(host) fills the legend; hover(x, y), leave(), click()}: pixels of the map.
   */
  constructor(host, plan, reach, on) {
    Object.assign(this, {host, plan, reach, on, lowest: 0});  // lowest: minimum height, px
    host.classList.add('map');
    this.canvas = host.appendChild(document.createElement('canvas'));
    this.tip = host.appendChild(make('div', 'tip'));
    this.tip.hidden = true;
    this.key = host.appendChild(make('div', 'plan-key'));
    this.whole = this.wholeView();
    new MapControls(this);
    this.setView(this.firstView());
    new ResizeObserver(() => requestAnimationFrame(() => this.draw())).observe(host);
  }

  /** Returns center and extent, m, of positions with a margin, which is a share of the extent. */
  static viewOf(norths, easts, share) {
    const [n0, n1] = finiteRange(norths), [e0, e1] = finiteRange(easts);
    const pad = share * Math.max(n1 - n0, e1 - e0, 2);
    return {n: (n0 + n1) / 2, e: (e0 + e1) / 2, height: n1 - n0 + 2 * pad, width: e1 - e0 + 2 * pad};
  }
  /** Returns the goal and the waypoints before it, each with its name. */
  marks() {
    const {goal, route = []} = this.plan;
    return route.map((place, i) => [place, String(i + 1)]).concat(goal ? [[goal, 'goal']] : []);
  }
  /** Returns the north and east bounds of the goal and the waypoints; empty without a goal. */
  goalEnds() {
    const ends = (axis) => this.marks().flatMap(([place]) => [place[axis] - place.radius, place[axis] + place.radius]);
    return [ends('n'), ends('e')];
  }
  wholeView() {
    const {plan, reach} = this, [norths, easts] = this.goalEnds();
    return MapView.viewOf(plan.bounds.slice(0, 2).concat(reach.n, norths), plan.bounds.slice(2).concat(reach.e, easts), 0.03);
  }
  /** Shows the flights and the goal if the scene is much wider. */
  firstView() {
    const {reach, whole} = this, [norths, easts] = this.goalEnds();
    const near = MapView.viewOf(reach.n.concat(norths), reach.e.concat(easts), 0.25);
    return Math.max(near.height / whole.height, near.width / whole.width) < 0.5 ? near : {...whole};
  }

  setView(view) {
    this.view = view;
    const moved = view.width < this.whole.width || view.height < this.whole.height;
    this.canvas.classList.toggle('moves', moved);
  }
  show(view) {
    this.setView(view);
    this.draw();
  }
  zoom(factor) {
    const {n, e, width, height} = this.view;
    const clamp = Math.max(factor, height / this.whole.height, width / this.whole.width);
    const f = factor < 1 ? Math.min(1, clamp) : Math.max(1, Math.min(factor, Math.min(width, height) / narrowestView));
    this.show(f === 1 && factor < 1 ? {...this.whole} : {n, e, width: width / f, height: height / f});
  }
  showReach() { this.show(MapView.viewOf(this.reach.n, this.reach.e, 0.08)); }

  /** Sets the size of the canvas and the pixels per meter. The card keeps the aspect ratio of the whole scene. */
  layout() {
    const width = this.host.clientWidth;
    const inner = width - mapMargin.left - mapMargin.right;
    const tallest = Math.min(window.innerWidth < 600 ? 460 : 680, 1.15 * width);
    const own = Math.min(Math.max(inner * this.whole.height / this.whole.width + mapMargin.top + mapMargin.bottom, 220), tallest);
    const height = Math.max(own, this.lowest);
    const dpr = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * dpr);
    this.canvas.height = Math.round(height * dpr);
    this.canvas.style.height = height + 'px';
    const frame = {x: mapMargin.left, y: mapMargin.top, width: inner, height: height - mapMargin.top - mapMargin.bottom};
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
    for (const [place, name] of this.marks()) this.drawGoal(c, place, name);
    this.on.draw(c, this);
    c.restore();
    c.strokeStyle = themeColor('line');
    c.lineWidth = 1;
    c.strokeRect(x, y, width, height);
    this.key.replaceChildren();
    this.on.key(this.key);
    this.drawKey();
  }

  drawAxes(c) {
    const {x, y, width, height} = this.frame;
    const count = (pixels) => Math.max(2, pixels / 60);
    const easts = niceTicks(this.east(x), this.east(x + width), count(width));
    const norths = niceTicks(this.north(y + height), this.north(y), count(height));
    // Squares, unless the shorter axis of a narrow scene would lose its numbers.
    const squares = Math.max(easts.step, norths.step);
    const onSquares = ({values}) => values.filter((v) => Math.abs(v / squares - Math.round(v / squares)) < 1e-6);
    for (const ticks of [easts, norths]) {
      const shared = onSquares(ticks);
      if (shared.length >= 2) Object.assign(ticks, {values: shared, step: squares});
    }
    const digits = Math.max(0, -Math.floor(Math.log10(Math.min(easts.step, norths.step)) + 1e-9));
    const text = (v) => fixed(Math.abs(v) < 1e-9 ? 0 : v, digits);
    c.strokeStyle = themeColor('faint');
    c.fillStyle = themeColor('soft');
    c.lineWidth = 1;
    c.beginPath();
    c.textAlign = 'center';
    c.textBaseline = 'top';
    for (const e of easts.values) {
      c.moveTo(this.x(e), y);
      c.lineTo(this.x(e), y + height);
      c.fillText(text(e), this.x(e), y + height + 5);
    }
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const n of norths.values) {
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
    for (const level of ['below', 'at_altitude']) {
      c.fillStyle = themeColor(level === 'at_altitude' ? 'solid' : 'low');
      c.strokeStyle = themeColor('solid-edge');
      c.lineWidth = level === 'at_altitude' ? 1 : 0.5;
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

  /** Draws the paths of moving obstacles at their width, with dashed center lines. */
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

  drawGoal(c, goal, name = 'goal') {
    c.strokeStyle = themeColor('c2');
    c.lineWidth = 2;
    c.setLineDash([5, 3]);
    c.beginPath();
    c.arc(this.x(goal.e), this.y(goal.n), goal.radius * this.scale, 0, 2 * Math.PI);
    c.stroke();
    c.setLineDash([]);
    this.cross(c, this.x(goal.e), this.y(goal.n), 5, themeColor('c2'));
    this.label(c, name, this.x(goal.e), this.y(goal.n) - Math.max(goal.radius * this.scale, 6) - 8, themeColor('c2'));
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
    const levels = new Set(this.plan.footprints.map((f) => f.level));
    const entry = (color, text) => {
      const item = this.key.appendChild(make('span'));
      item.appendChild(make('i')).style.cssText = `background: ${themeColor(color)}; border: 1px solid ${themeColor('solid-edge')}`;
      item.append(text);
    };
    if (levels.has('at_altitude')) entry('solid', 'obstacle at flight altitude');
    if (levels.has('below')) entry('low', 'obstacle below the flight');
    const {frame} = this, [n0, n1, e0, e1] = this.plan.bounds, crosses = (value, from, size) => value > from && value < from + size;
    if ([e0, e1].some((e) => crosses(this.x(e), frame.x, frame.width)) || [n0, n1].some((n) => crosses(this.y(n), frame.y, frame.height))) {
      const item = this.key.appendChild(make('span'));
      item.appendChild(make('i')).style.border = `1px dashed ${themeColor('solid-edge')}`;
      item.append('area of the scene');
    }
    this.key.append(make('span', '', 'north up, to scale'));
  }

  showTip(x, y, lines) {
    this.tip.replaceChildren(...lines.map((line, i) => make(i ? 'div' : 'b', '', line)));
    this.tip.hidden = false;
    const left = x + 16 + this.tip.offsetWidth > this.host.clientWidth ? x - 16 - this.tip.offsetWidth : x + 16;
    this.tip.style.left = Math.max(0, left) + 'px';
    this.tip.style.top = Math.max(0, y - this.tip.offsetHeight - 8) + 'px';
  }

  /** Returns lines of text about the position of a pixel. */
  placeLines(x, y) {
    const solid = this.solidAt(this.north(y), this.east(x));
    const lines = [placeText(this.north(y), this.east(x))];
    if (solid) lines.unshift(`${solid.name || 'obstacle'}, ${fixed(solid.bottom, 1)} to ${fixed(solid.top, 1)} m high`);
    return lines;
  }

  solidAt(n, e) {
    return this.plan.footprints.find(({corners, level}) => level !== 'above' && corners.length > 2 && corners.every(([n0, e0], i) => {
      const [n1, e1] = corners[(i + 1) % corners.length];
      const [n2, e2] = corners[(i + 2) % corners.length];
      const side = (pn, pe) => (n1 - n0) * (pe - e0) - (e1 - e0) * (pn - n0);
      return side(n, e) * side(n2, e2) >= 0;
    }));
  }
}
