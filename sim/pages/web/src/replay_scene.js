// Meshes of a scene and a vehicle, as children of a group in W (or M, or B): the numbers of the data are used unchanged.
import * as THREE from 'three';
import {Line2} from 'three/examples/jsm/lines/Line2.js';
import {LineGeometry} from 'three/examples/jsm/lines/LineGeometry.js';
import {LineMaterial} from 'three/examples/jsm/lines/LineMaterial.js';

const colors = {solid: 0x9aa5b4, ground: 0x7f8f76, mover: 0xd08a2e, hull: 0x1f3a5f, goal: 0x009e73, path: 0x0a84d8, nose: 0xd55e00};
const material = (color, more = {}) => new THREE.MeshLambertMaterial({color, fog: false, ...more});

/** Returns many bodies of one shape as one mesh. @param rows  position, quaternion (x, y, z, w), half extents. */
function copies(geometry, rows, look, color) {
  const shades = rows.length > 5;
  if (shades) look = new THREE.MeshLambertMaterial();  // each instance has its own color
  const mesh = new THREE.InstancedMesh(geometry, look, rows.length), matrix = new THREE.Matrix4();
  rows.forEach(([x, y, z, qx, qy, qz, qw, a, b, c], i) => {
    matrix.compose(new THREE.Vector3(x, y, z), new THREE.Quaternion(qx, qy, qz, qw).normalize(), new THREE.Vector3(a, b, c));
    mesh.setMatrixAt(i, matrix);
    if (shades) mesh.setColorAt(i, new THREE.Color(color).offsetHSL(0, 0, 0.05 * Math.sin(2.4 * i)));  // neighbors differ
  });
  mesh.frustumCulled = false;  // its bounds are those of one body only
  return mesh;
}

/** Returns boxes, cylinders, spheres and triangles as one group. */
export function bodies(data, color, more) {
  const group = new THREE.Group(), look = material(color, more);
  if (data.boxes.length) group.add(copies(new THREE.BoxGeometry(2, 2, 2), data.boxes, look, color));
  // In three.js the axis of a cylinder is y, here it is z.
  if (data.cylinders.length) group.add(copies(new THREE.CylinderGeometry(1, 1, 2, 24).rotateX(Math.PI / 2), data.cylinders, look, color));
  if (data.spheres.length) group.add(copies(new THREE.SphereGeometry(1, 24, 16), data.spheres, look, color));
  const both = material(color, {...more, side: THREE.DoubleSide, flatShading: true});
  for (const {corners, faces} of data.meshes) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
    geometry.setIndex(faces);
    geometry.computeVertexNormals();
    group.add(new THREE.Mesh(geometry, both));
  }
  return group;
}

/** Returns the ground with a grid with round spacing in meters: {group, step_m}. */
export function ground([n0, n1, e0, e1]) {
  const group = new THREE.Group(), size = Math.max(n1 - n0, e1 - e0, 10);
  const rough = size / 20, power = 10 ** Math.floor(Math.log10(rough));
  const step_m = power * [1, 2, 5, 10].find((s) => s * power >= rough);
  const plane = new THREE.Mesh(new THREE.PlaneGeometry(3 * size, 3 * size), material(colors.ground, {side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 8}));
  plane.position.set((n0 + n1) / 2, (e0 + e1) / 2, 0);
  const points = [];
  const [a, b, c, d] = [Math.floor(n0 / step_m), Math.ceil(n1 / step_m), Math.floor(e0 / step_m), Math.ceil(e1 / step_m)];
  for (let n = a; n <= b; ++n) points.push(n * step_m, c * step_m, 0, n * step_m, d * step_m, 0);
  for (let e = c; e <= d; ++e) points.push(a * step_m, e * step_m, 0, b * step_m, e * step_m, 0);
  const grid = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
  group.add(plane, new THREE.LineSegments(grid, new THREE.LineBasicMaterial({color: 0xffffff, transparent: true, opacity: 0.35})));
  return {group, step_m};
}

export function goalMark([north, east, down, radius]) {
  const ring = new THREE.Mesh(new THREE.TorusGeometry(radius, Math.max(0.04, radius / 60), 8, 64), material(colors.goal));
  const pole = new THREE.Mesh(new THREE.CylinderGeometry(0.06, 0.06, Math.max(0.1, -down), 8).rotateX(Math.PI / 2), material(colors.goal));
  pole.position.z = -down / 2;
  const group = new THREE.Group();
  group.add(ring, pole);
  group.position.set(north, east, down);
  return group;
}

/** The path of the flight, which may grow. */
export class PathLine {
  constructor() {
    this.line = new Line2(new LineGeometry(), new LineMaterial({color: colors.path, linewidth: 3, fog: false}));
    this.line.frustumCulled = false;
  }
  set({north_m, east_m, down_m}) {
    this.line.visible = north_m.length > 1;
    if (!this.line.visible) return;
    this.line.geometry.dispose();
    const points = new Float32Array(3 * north_m.length);
    north_m.forEach((north, i) => points.set([north, east_m[i], down_m[i]], 3 * i));
    this.line.geometry = new LineGeometry().setPositions(points);
  }
}

/** Returns a soft dark disc below the vehicle, which shows its place above the ground. */
export function groundMark(reach) {
  const canvas = document.createElement('canvas'), c = canvas.getContext('2d');
  canvas.width = canvas.height = 64;
  const shade = c.createRadialGradient(32, 32, 4, 32, 32, 32);
  shade.addColorStop(0, 'rgba(0, 0, 0, 0.55)');
  shade.addColorStop(1, 'rgba(0, 0, 0, 0)');
  c.fillStyle = shade;
  c.fillRect(0, 0, 64, 64);
  const look = new THREE.MeshBasicMaterial({map: new THREE.CanvasTexture(canvas), transparent: true, depthWrite: false, side: THREE.DoubleSide, fog: false});
  return new THREE.Mesh(new THREE.PlaneGeometry(2.4 * reach, 2.4 * reach), look);
}

/** Returns the collision geometry of the hull, half transparent, and a forward arrow. */
export function vehicle(hull) {
  const group = new THREE.Group(), body = bodies(hull, colors.hull, {transparent: true, opacity: 0.85});
  const reach = Math.max(0.3, ...[...hull.boxes, ...hull.cylinders].map(([x, y, z, qx, qy, qz, qw, a]) => x + a));
  const nose = new THREE.Mesh(new THREE.ConeGeometry(0.12 * reach, 0.4 * reach, 12).rotateZ(-Math.PI / 2), material(colors.nose));
  nose.position.set(1.1 * reach, 0, Math.min(...[...hull.boxes, ...hull.cylinders].map(([x, y, z]) => z)));  // above all rotors
  const shown = new THREE.Group();
  shown.add(body, nose);
  group.add(shown);
  return {group, body: shown, reach};
}

export function moverMesh(mover) { return bodies(mover.bodies, colors.mover); }

/** Returns whether a body is a ceiling above the path: flat, above all of it, and over some of it. @param low, high  its corners in W. */
function isCeiling(low, high, {north_m, east_m, down_m}) {
  const kFlat_m = 1;
  return high[2] < Math.min(...down_m) && high[2] - low[2] < kFlat_m &&
    north_m.some((north, i) => low[0] < north && north < high[0] && low[1] < east_m[i] && east_m[i] < high[1]);
}
function boxCorners([x, y, z, qx, qy, qz, qw, a, b, c]) {
  const box = new THREE.Box3(new THREE.Vector3(-a, -b, -c), new THREE.Vector3(a, b, c));
  box.applyMatrix4(new THREE.Matrix4().compose(new THREE.Vector3(x, y, z), new THREE.Quaternion(qx, qy, qz, qw), new THREE.Vector3(1, 1, 1)));
  return [box.min.toArray(), box.max.toArray()];
}
function meshCorners({corners}) {
  const box = new THREE.Box3().setFromArray(corners);
  return [box.min.toArray(), box.max.toArray()];
}

/** Returns the solids of the scene: {group, ceilings}. Ceilings are drawn as edges, because they would hide the flight. */
export function solidsMesh(scene, path) {
  const over = {boxes: [], meshes: []}, rest = {...scene, boxes: [], meshes: []};
  for (const box of scene.boxes) (isCeiling(...boxCorners(box), path) ? over : rest).boxes.push(box);
  for (const mesh of scene.meshes) (isCeiling(...meshCorners(mesh), path) ? over : rest).meshes.push(mesh);
  const group = bodies(rest, colors.solid), ceilings = [...over.boxes.map(boxCorners), ...over.meshes.map(meshCorners)];
  for (const [low, high] of ceilings) {
    group.add(new THREE.Box3Helper(new THREE.Box3(new THREE.Vector3(...low), new THREE.Vector3(...high)), colors.solid));
  }
  return {group, ceilings};
}
