// The map of the module and its planned paths.
import * as THREE from 'three';

const LEVEL_M = 0.05;  // of a path below the vehicle, so that both are visible

function line(places, color, dashed = false) {
  const geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(places.flat(), 3));
  const look = dashed ? new THREE.LineDashedMaterial({color, dashSize: 1, gapSize: 0.6}) : new THREE.LineBasicMaterial({color});
  const result = new THREE.Line(geometry, look);
  if (dashed) result.computeLineDistances();
  return result;
}

export class ModuleMap {
  /** @param map  of the data, or null. @param path  of the flight. */
  constructor(map, path) {
    this.group = new THREE.Group();
    this.paths = [];
    if (!map) return;
    const down = path.down_m[0] ?? 0, level = ([n, e]) => [n, e, down + LEVEL_M];
    for (const [is, color] of [[true, 0x19c596], [false, 0xd62828], [null, 0x56b4e9]]) {
      const points = map.points.filter((point) => point.true === is).flatMap(({n, e, d}) => [n, e, d]);
      if (!points.length) continue;
      const geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
      this.group.add(new THREE.Points(geometry, new THREE.PointsMaterial({color, size: 7, sizeAttenuation: false})));
    }
    if (map.course.length > 1) this.group.add(line(map.course.map(level), 0xffffff, true));
    for (const {t, places} of map.paths) {
      const drawn = places.length > 1 ? this.group.add(line(places.map(level), 0xd55e00)).children.at(-1) : null;
      if (drawn) drawn.visible = false;
      this.paths.push({t, drawn});
    }
  }
  /** Shows the path that was planned last. */
  setTime(t_s) {
    const now = this.paths.findLast(({t}) => t <= t_s);
    for (const path of this.paths) if (path.drawn) path.drawn.visible = path === now;
  }
}
