'use strict';
// Map of a module and true corners in plan view: landmarks with their ellipses, true corners, route, path, planned detours.

const mapSigmas = 3, pathsShown = 4;

/** Returns half axes and rotation, from north to east, of an ellipse of one standard deviation, m and rad. */
function ellipseOf([nn, ne, ee]) {
  const mean = (nn + ee) / 2, spread = Math.hypot((nn - ee) / 2, ne);
  return {major: Math.sqrt(Math.max(0, mean + spread)), minor: Math.sqrt(Math.max(0, mean - spread)),
    turn: Math.atan2(2 * ne, nn - ee) / 2};
}

class LandmarksView {
  /**
   * @param host  element to fill.
   * @param data  the report's data, with `map`.
   */
  constructor(host, data) {
    Object.assign(this, {chart: data.map, path: data.path, t: null});
    const {points, corners, course} = this.chart;
    const reachOf = (some) => {
      const places = [...some, ...corners, ...course.map(([n, e]) => ({n, e}))];
      return {n: places.map((p) => p.n).concat(this.path.n), e: places.map((p) => p.e).concat(this.path.e)};
    };
    const all = reachOf(points), bounds = [...finiteRange(all.n), ...finiteRange(all.e)];
    this.map = new MapView(host, {...data.plan, bounds}, reachOf(points.filter((p) => p.true !== false)), {
      draw: (c) => this.drawOver(c),
      key: (key) => this.drawKey(key),
      hover: (x, y) => this.hover(x, y),
      leave: () => {},
      click: () => {},
    });
    this.map.plan = {...data.plan, bounds: []};  // the bounds of the landmarks are not those of the scene, and are not drawn
    this.map.showReach();  // false landmarks may be far away
  }
  draw() { this.map.draw(); }

  drawOver(c) {
    this.trace(c, this.chart.course, 'soft', 1.5, [7, 5]);
    this.trace(c, this.path.n.map((n, i) => [n, this.path.e[i]]), 'c0', 2);
    const paths = this.pathsUntil(this.t ?? Infinity);
    paths.forEach(({places, from}, i) => {
      c.globalAlpha = (i + 1) / paths.length;
      this.trace(c, [from, ...places], 'c3', 2, [3, 4]);
      for (const [n, e] of places.slice(0, -1)) this.map.dot(c, this.map.x(e), this.map.y(n), 3.5, themeColor('c3'));
    });
    c.globalAlpha = 1;
    for (const corner of this.chart.corners) this.drawCorner(c, corner);
    for (const point of this.chart.points) this.drawPoint(c, point);
  }

  trace(c, places, color, width, dash = []) {
    c.strokeStyle = themeColor(color);
    c.lineWidth = width;
    c.setLineDash(dash);
    c.beginPath();
    for (const [n, e] of places) c.lineTo(this.map.x(e), this.map.y(n));
    c.stroke();
    c.setLineDash([]);
  }

  /** Returns the latest detours planned until an instant, each with the position of the vehicle at that time. */
  pathsUntil(t) {
    const paths = this.chart.paths.filter((path) => path.t <= t && path.places.length > 1).slice(-pathsShown);
    return paths.map((path) => ({...path, from: this.placeAt(path.t)}));
  }
  placeAt(t) {
    const after = this.path.t.findIndex((s) => s >= t), row = after < 0 ? this.path.t.length - 1 : after;
    return [this.path.n[row], this.path.e[row]];
  }

  /** Draws a corner as a square. Corners on the ground are smaller, to distinguish them from the corner above. */
  drawCorner(c, corner) {
    const half = this.onGround(corner) ? 3.5 : 6;
    c.strokeStyle = themeColor(this.cornerColor(corner));
    c.lineWidth = 1.5;
    c.strokeRect(this.map.x(corner.e) - half, this.map.y(corner.n) - half, 2 * half, 2 * half);
  }
  onGround(place) { return Math.abs(place.d) < 0.5; }
  cornerColor({counts, found}) { return !counts ? 'solid-edge' : found ? 'ink' : 'c1'; }
  pointColor(point) { return point.true === null ? 'c0' : point.true ? 'c2' : 'bad'; }

  drawPoint(c, point) {
    const {major, minor, turn} = ellipseOf(point.covariance);
    const x = this.map.x(point.e), y = this.map.y(point.n), size = mapSigmas * this.map.scale;
    c.strokeStyle = c.fillStyle = themeColor(this.pointColor(point));
    c.lineWidth = 1.25;
    c.beginPath();
    c.ellipse(x, y, size * major, size * minor, turn - Math.PI / 2, 0, 2 * Math.PI);
    c.globalAlpha = 0.15;
    c.fill();
    c.globalAlpha = 1;
    c.stroke();
    if (point.true === false) this.map.cross(c, x, y, 5, themeColor('bad'));
    else this.map.dot(c, x, y, 2.5, themeColor(this.pointColor(point)));
  }

  drawKey(host) {
    const {points, corners, course, paths} = this.chart;
    const entry = (color, text, style = 'solid') => {
      const item = host.appendChild(make('span'));
      const mark = item.appendChild(make('i'));
      mark.style.cssText = style === 'box' ? `border: 2px solid ${themeColor(color)}`
        : style === 'disc' ? `border-radius: 50%; background: ${themeColor(color)}`
          : `width: 20px; height: 0; vertical-align: 3px; border-top: 2px ${style} ${themeColor(color)}`;
      item.append(text);
    };
    const share = (list) => `${list.length} `;
    const counting = corners.filter((corner) => corner.counts);
    if (corners.length) {
      entry('ink', share(counting.filter((corner) => corner.found)) + 'true corners found (small: on the ground)', 'box');
      entry('c1', share(counting.filter((corner) => !corner.found)) + 'missing', 'box');
      entry('solid-edge', share(corners.filter((corner) => !corner.counts)) + 'rarely in view', 'box');
      entry('c2', share(points.filter((point) => point.true)) + `landmarks, ellipses of ${mapSigmas} standard deviations`, 'disc');
      entry('bad', share(points.filter((point) => !point.true)) + 'false (✕)', 'disc');
    } else {
      entry('c0', share(points) + `landmarks, ellipses of ${mapSigmas} standard deviations`, 'disc');
    }
    entry('c0', 'flown');
    if (course.length) entry('soft', 'route', 'dashed');
    if (paths.length) entry('c3', `planned detours, the latest ${pathsShown}`, 'dotted');
  }

  hover(x, y) {
    const {map} = this;
    const near = (place) => Math.hypot(map.x(place.e) - x, map.y(place.n) - y) < 9;
    const point = this.chart.points.find(near), corner = this.chart.corners.find(near);
    const lines = [];
    const placed = ({n, e, d}) => `${placeText(n, e)}, ${fixed(-d, 1)} m high`;
    if (point) {
      const {major, minor} = ellipseOf(point.covariance);
      lines.push(point.true === false ? 'false landmark' : 'landmark', placed(point),
        `standard deviations ${fixed(major, 2)} and ${fixed(minor, 2)} m`);
    }
    if (corner) lines.push('true corner', placed(corner));
    map.showTip(x, y, lines.length ? lines : map.placeLines(x, y));
  }

  /** Shows the detours planned until an instant; null for the end. */
  setTime(t) {
    if (t === this.t) return;
    this.t = t;
    if (this.chart.paths.length) this.draw();
  }
}
