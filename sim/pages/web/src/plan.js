'use strict';
// A flight on its map: colored path, marks, vehicle at an instant.

/** Returns the quantities for coloring the path. The clearance scale ends at a clearance above which it is irrelevant. */
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

class PlanView {
  /**
   * @param host  element to fill.
   * @param data  the report's data.
   * @param on  {hover(t), pick(t)}: called with the instant under the pointer, null for none.
   */
  constructor(host, data, on) {
    Object.assign(this, {on, path: data.path, result: data.result});
    this.colorings = pathColorings(this.path);
    this.coloring = this.colorings[0];
    this.row = null;
    this.references = data.references ?? [];
    const all = (axis) => this.path[axis].concat(...this.references.map((reference) => reference[axis]));
    this.map = new MapView(host, data.plan, {n: all('n'), e: all('e')}, {
      draw: (c) => { this.drawReferences(c); this.drawPath(c); this.drawMarks(c); },
      key: (key) => this.drawKey(key),
      hover: (x, y) => this.hover(x, y),
      leave: () => this.on.hover(null),
      click: () => { if (this.row !== null) this.on.pick(this.path.t[this.row]); },
    });
    this.draw();
  }
  draw() { this.map.draw(); }

  /** Draws the reference trajectories of the checks, dashed. */
  drawReferences(c) {
    c.save();
    c.strokeStyle = themeColor('ink');
    c.lineWidth = 1.5;
    c.setLineDash([6, 5]);
    for (const {n, e} of this.references) {
      c.beginPath();
      n.forEach((north, i) => c.lineTo(this.map.x(e[i]), this.map.y(north)));
      c.stroke();
      this.map.label(c, 'reference', this.map.x(e.at(-1)), this.map.y(n.at(-1)) - 13, themeColor('ink'));
    }
    c.restore();
  }

  drawPath(c) {
    const {path, coloring, map} = this;
    const count = path.n.length;
    const trace = (from, to) => {
      c.beginPath();
      for (let i = from; i <= to; ++i) c.lineTo(map.x(path.e[i]), map.y(path.n[i]));
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
    const {path, result, map} = this;
    const ink = themeColor('ink'), last = path.n.length - 1;
    if (last < 0) return;
    map.dot(c, map.x(path.e[0]), map.y(path.n[0]), 5, themeColor('c0'));
    map.label(c, 'start', map.x(path.e[0]), map.y(path.n[0]) - 13, themeColor('c0'));
    const end = [map.x(path.e[last]), map.y(path.n[last])];
    if (result.outcome === 'collided') map.cross(c, ...end, 8, themeColor('bad'), 3.5);
    else map.dot(c, ...end, 4, ink);

    const near = result.closest_obstacle;
    if (near) {
      const x = map.x(near.east_m), y = map.y(near.north_m);
      c.strokeStyle = themeColor('bad');
      c.lineWidth = 2;
      c.beginPath();
      c.arc(x, y, 9, 0, 2 * Math.PI);
      c.stroke();
      const text = result.outcome === 'collided' && near.distance_m <= 0 ? 'collided' : 'closest: ' + meters(near.distance_m);
      const from = [map.x(path.e[0]), map.y(path.n[0]) - 13], covers = Math.abs(x - from[0]) < 75 && Math.abs(y + 20 - from[1]) < 16;
      map.label(c, text, x, covers ? from[1] - 16 : y + 20, themeColor('bad'));
    }
    if (this.row !== null) this.drawVehicle(c, this.row, ink);
  }

  /** Draws an arrowhead along the heading. */
  drawVehicle(c, row, ink) {
    const {map} = this;
    c.save();
    c.translate(map.x(this.path.e[row]), map.y(this.path.n[row]));
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

  drawKey(host) {
    const {coloring} = this;
    const ramp = host.appendChild(make('span', 'ramp'));
    ramp.append(coloring.name + ' ' + short(coloring.low));
    ramp.appendChild(make('i')).style.background = `linear-gradient(90deg, ${themeColor(coloring.ramp)})`;
    ramp.append(short(coloring.high) + (coloring.open ? ' or more ' : ' ') + coloring.unit);
  }

  hover(x, y) {
    const {path, map} = this;
    let best = null, least = 24 ** 2;
    for (let i = 0; i < path.n.length; ++i) {
      const d = (map.x(path.e[i]) - x) ** 2 + (map.y(path.n[i]) - y) ** 2;
      if (d < least) [least, best] = [d, i];
    }
    if (best !== null) {
      this.on.hover(path.t[best]);
      map.showTip(x, y, this.rowLines(best));
      return;
    }
    this.on.hover(null);
    map.showTip(x, y, map.placeLines(x, y));
  }

  rowLines(i) {
    const {path} = this;
    const status = path.status[i] >= 0 ? ', ' + path.statuses[path.status[i]] : '';
    return [`t = ${fixed(path.t[i], 2)} s${status}`,
      `clearance ${path.clearance[i] === null ? 'none within range' : meters(path.clearance[i])}`,
      `speed ${fixed(path.speed[i], 2)} m/s, altitude ${fixed(path.altitude[i], 1)} m`,
      placeText(path.n[i], path.e[i])];
  }

  /** Shows the vehicle at an instant; null hides it. */
  setTime(t) {
    const {path} = this;
    const row = t !== null && path.t.length ? rowBefore(path.t, t) : null;
    if (row === this.row) return;
    this.row = row;
    this.draw();
  }
  setColoring(name) {
    this.coloring = this.colorings.find((c) => c.name === name);
    this.draw();
  }
}
