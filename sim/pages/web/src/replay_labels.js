// Name labels in the scene, and a mark at the collision or the closest approach.
import * as THREE from 'three';

const MOST_LABELS = 8, FARTHEST_M = 40, ABOVE_FLIGHT_M = 2;
const HEIGHT = 0.026;  // of a label, as a share of the view

const sprites = [];
let scaled = null;
/** Gives all labels the same size on the screen. @param view_m  height of the view at the distance 1 m, or of a plan. */
export function scaleLabels(view_m) {
  if (scaled === `${view_m} ${sprites.length}`) return;
  scaled = `${view_m} ${sprites.length}`;
  for (const {sprite, width} of sprites) sprite.scale.set(HEIGHT * view_m * width, HEIGHT * view_m, 1);
}

const STEPS = 4;  // positions of a label above its place
const at = new THREE.Vector3();
/** Stacks labels that would cover each other, the nearest lowest. A label without room is hidden. */
export function separateLabels(camera, aspect) {
  camera.updateMatrixWorld();
  const shown = [];
  for (const {sprite, width} of sprites) {
    let isShown = true;
    for (let node = sprite; node; node = node.parent) isShown &&= node.visible;
    sprite.getWorldPosition(at).project(camera);
    if (isShown && Math.abs(at.z) < 1) shown.push({sprite, x: at.x, y: at.y, z: at.z, half: HEIGHT * width / aspect});
  }
  const placed = [];
  for (const one of shown.sort((a, b) => a.z - b.z)) {
    // The view is 2 high and 2 wide.
    const covers = (step) => placed.some(({x, y, half}) => Math.abs(one.x - x) < one.half + half && Math.abs(one.y + 2 * HEIGHT * step - y) < 2 * HEIGHT);
    let step = 0;
    while (step < STEPS && covers(step)) ++step;
    one.sprite.material.visible = step < STEPS;
    if (step === STEPS) continue;
    one.sprite.center.y = -step;
    placed.push({...one, y: one.y + 2 * HEIGHT * step});
  }
  return placed;
}

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
  const look = new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas), sizeAttenuation: false, depthTest: false, fog: false});
  const sprite = new THREE.Sprite(look);
  sprite.center.set(0.5, 0);
  sprites.push({sprite, width: canvas.width / canvas.height});
  sprite.renderOrder = 1;
  return sprite;
}

/** Names of the obstacles closest to the vehicle, each name once. */
export class NameTags {
  /** @param labels  [name, north, east, top]. @param down_m  of the highest point of the flight: high obstacles are named there. */
  constructor(labels, highest_m) {
    Object.assign(this, {group: new THREE.Group(), labels, tags: new Map(), highest: highest_m - ABOVE_FLIGHT_M, shown: ''});
  }
  /** Shows the names around a place. */
  update(north, east) {
    const near = this.labels.map((row) => ({row, away_m: Math.hypot(row[1] - north, row[2] - east)})).filter(({away_m}) => away_m < FARTHEST_M);
    const seen = new Set(), rows = near.sort((a, b) => a.away_m - b.away_m).map(({row}) => row)
      .filter(([name]) => !seen.has(name) && seen.add(name)).slice(0, MOST_LABELS);
    for (const tag of this.tags.values()) tag.visible = false;
    for (const row of rows) {
      if (!this.tags.has(row)) {
        const tag = this.group.add(label(row[0])).children.at(-1);
        tag.position.set(row[1], row[2], Math.max(row[3], this.highest));
        this.tags.set(row, tag);
      }
      this.tags.get(row).visible = true;
    }
    return rows;
  }
}

/** Returns the name of a moving obstacle, above it in M. */
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
