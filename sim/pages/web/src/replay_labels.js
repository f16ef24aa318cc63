// Name labels in the scene, and a mark at the collision or the closest approach.
import * as THREE from 'three';

const MOST_LABELS = 8, FARTHEST_M = 30, ABOVE_FLIGHT_M = 2;

/** Returns a text that faces the camera and has a constant size on the screen. */
function label(text) {
  const canvas = document.createElement('canvas'), c = canvas.getContext('2d'), font = '600 28px system-ui, "DejaVu Sans", sans-serif';
  c.font = font;
  [canvas.width, canvas.height] = [Math.ceil(c.measureText(text).width) + 24, 44];
  c.fillStyle = 'rgba(20, 27, 38, 0.8)';
  c.fillRect(0, 0, canvas.width, canvas.height);
  c.font = font;
  c.fillStyle = '#fff';
  c.textBaseline = 'middle';
  c.fillText(text, 12, 23);
  const look = new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas), sizeAttenuation: false, depthTest: false});
  const sprite = new THREE.Sprite(look), height = 0.028;
  sprite.center.set(0.5, 0);
  sprite.scale.set(height * canvas.width / canvas.height, height, 1);
  sprite.renderOrder = 1;
  return sprite;
}

/** Returns the names of the solids closest to the path in order of distance, each name once. */
export function nearestNames(labels, {north_m, east_m}) {
  const away = ([, north, east]) => Math.min(...north_m.map((n, i) => Math.hypot(n - north, east_m[i] - east)));
  const near = labels.map((row) => ({row, away_m: away(row)})).filter(({away_m}) => away_m < FARTHEST_M);
  const seen = new Set();
  return near.sort((a, b) => a.away_m - b.away_m).map(({row}) => row)
    .filter(([name]) => !seen.has(name) && seen.add(name)).slice(0, MOST_LABELS);
}

/** Returns labels as children of a group in W: above low solids, and at flight altitude for high ones. */
export function nameTags(labels, path) {
  const group = new THREE.Group(), highest = Math.min(...path.down_m) - ABOVE_FLIGHT_M;
  for (const [name, north, east, top] of nearestNames(labels, path)) {
    const tag = group.add(label(name)).children.at(-1);
    tag.position.set(north, east, Math.max(top, highest));
  }
  return group;
}

export function moverTag({name, bodies: {boxes, cylinders, spheres}}) {
  const tag = label(name);
  tag.position.set(0, 0, Math.min(0, ...[...boxes, ...cylinders, ...spheres].map((row) => row[2] - row[9])));
  return tag;
}

/** Returns a ball at the collision, or a smaller one at the closest approach, with the name of the obstacle. */
export function eventMark({text, place, collided}, reach) {
  const group = new THREE.Group(), color = collided ? 0xd62828 : 0xe9a800;
  group.add(new THREE.Mesh(new THREE.SphereGeometry((collided ? 0.5 : 0.2) * reach, 20, 14),
    new THREE.MeshLambertMaterial({color, transparent: true, opacity: 0.75})));
  const tag = group.add(label(text)).children.at(-1);
  tag.position.z = -1.2 * reach;
  group.position.set(...place);
  return group;
}
