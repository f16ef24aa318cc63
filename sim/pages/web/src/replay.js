// The flight in three dimensions: the vehicle follows its true path between the solids of the scene.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

import {eventMark, moverTag, nameTags} from './replay_labels.js';
import {goalMark, ground, moverMesh, pathLine, solidsMesh, vehicle} from './replay_scene.js';
import {eventsOf, Track} from './replay_track.js';

/**
 * Frame V, the world of three.js: x east, y up, z south. Everything in W (north, east, down) is a child of a group with
 * this matrix.
 */
const R_VW = new THREE.Matrix4().set(0, 1, 0, 0, 0, 0, -1, 0, -1, 0, 0, 0, 0, 0, 0, 1);
function inV(north, east, down) { return new THREE.Vector3(north, east, down).applyMatrix4(R_VW); }

const {result, scene: world, hull, path, goal, has_report, statuses, has_film} = JSON.parse(document.getElementById('data').textContent);
const element = (id) => document.getElementById(id);
const end_s = path.t_s.at(-1) ?? 0;
const events = eventsOf(result, end_s), event = events[0], collided = result.outcome === 'collided';
const state = {t_s: 0, playing: false, speed: 1, camera: 'orbit'};

// --- The scene

const renderer = new THREE.WebGLRenderer({canvas: element('view'), antialias: true});
const stage = new THREE.Scene();
stage.background = new THREE.Color(0xb9cbe0);
stage.add(new THREE.HemisphereLight(0xffffff, 0x6b7560, 1.3));
// Light that gives the four sides of a box different shades.
for (const [north, east, strength] of [[-0.5, 0.3, 1.6], [0.5, 0.2, 0.7], [0.1, -0.6, 0.4]]) {
  const light = new THREE.DirectionalLight(0xffffff, strength);
  light.position.copy(inV(north, east, -0.6));
  stage.add(light);
}

const inW = stage.add(new THREE.Group()).children.at(-1);
inW.matrixAutoUpdate = false;
inW.matrix.copy(R_VW);
const bounds = world.bounds.length ? world.bounds
  : [...finiteRange(path.north_m), ...finiteRange(path.east_m)].map((v, i) => v + (i % 2 ? 20 : -20));
const floor = ground(bounds);
floor.group.visible = world.has_ground;
const solids = solidsMesh(world, path), craft = vehicle(hull), movers = world.movers.map(moverMesh);
movers.forEach((mover, i) => mover.add(moverTag(world.movers[i])));
inW.add(floor.group, solids.group, pathLine(path), craft.group, ...movers, nameTags(world.labels, path));
if (goal) inW.add(goalMark(goal));
craft.group.rotation.order = 'ZYX';  // yaw, then pitch, then roll, each about the new axis

// --- The instant

/** Returns the row before an instant, and the share of the step to the next row. */
function place(t_s) {
  let low = 0, high = path.t_s.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (path.t_s[middle] <= t_s) low = middle; else high = middle - 1;
  }
  const next = Math.min(low + 1, path.t_s.length - 1), step = path.t_s[next] - path.t_s[low];
  return {row: low, next, share: step > 0 ? Math.min(1, Math.max(0, (t_s - path.t_s[low]) / step)) : 0};
}
const between = (values, {row, next, share}) => values[row] + share * (values[next] - values[row]);
/** Interpolates an angle along the shorter arc. */
function turnBetween(values, {row, next, share}) {
  const turn = values[next] - values[row];
  return values[row] + share * Math.atan2(Math.sin(turn), Math.cos(turn));
}

if (result.closest_obstacle || collided) {
  const at = place(event.t_s);
  const where = [path.north_m, path.east_m, path.down_m].map((values) => between(values, at));
  inW.add(eventMark({text: event.text, place: where, collided}, craft.reach));
}

/** The film follows the timeline. During playback, its position is corrected only if the difference is large. */
const film = make('video'), screen = element('film');
film.muted = true;
function showFilm() {
  [screen.hidden, screen.width, screen.height] = [false, film.videoWidth, film.videoHeight];
  screen.getContext('2d').drawImage(film, 0, 0);
}
function windFilm(t_s) {
  if (film.readyState === 0) return;
  const apart_s = Math.abs(film.currentTime - t_s), most_s = state.playing ? 0.3 : 0.02;
  if (!film.seeking && apart_s > most_s) film.currentTime = Math.min(t_s, film.duration);
  else if (state.playing) showFilm();
}
if (has_film) {
  film.addEventListener('loadeddata', () => windFilm(state.t_s));
  film.addEventListener('seeked', showFilm);
  film.src = 'video.webm';
}

function pose(t_s) {
  const at = place(t_s);
  craft.group.position.set(between(path.north_m, at), between(path.east_m, at), between(path.down_m, at));
  craft.group.rotation.set(turnBetween(path.roll_rad, at), turnBetween(path.pitch_rad, at), turnBetween(path.yaw_rad, at), 'ZYX');
  movers.forEach((mover, i) => {
    const {way} = world.movers[i], last = way.length / 3 - 1, k = Math.min(last, t_s / world.step_s), row = Math.floor(k);
    const next = Math.min(row + 1, last);
    mover.position.set(...[0, 1, 2].map((axis) => way[3 * row + axis] + (k - row) * (way[3 * next + axis] - way[3 * row + axis])));
  });
  const clearance = path.clearance_m[at.row];
  element('clock').textContent = `${t_s.toFixed(2)} of ${end_s.toFixed(1)} s`;
  element('facts').textContent = `clearance ${clearance === null ? 'none within range' : meters(clearance)}, ` +
    `speed ${fixed(between(path.speed_mps, at), 1)} m/s, altitude ${fixed(-between(path.down_m, at), 1)} m`;
  element('time').value = t_s;
  track.draw(t_s);
  windFilm(t_s);
}

// --- Cameras

const camera = new THREE.PerspectiveCamera(55, 1, 0.2, 3000);
const orbit = new OrbitControls(camera, renderer.domElement);
orbit.maxPolarAngle = 0.499 * Math.PI;
const craftInV = () => inV(...craft.group.position.toArray());
const behind_m = Math.max(3, 5 * craft.reach), orbit_m = 2 * behind_m;

/** Places the orbit camera south of and above the vehicle, or directly above. */
function aim(kind) {
  const span = Math.max(bounds[1] - bounds[0], bounds[3] - bounds[2]);
  orbit.target.copy(craftInV());
  const {x, y, z} = orbit.target;
  if (kind === 'above') camera.position.set(x, y + Math.min(span, 120), z + 0.01);
  else camera.position.set(x + 0.6 * orbit_m, y + orbit_m, z + 1.2 * orbit_m);
  orbit.update();
}
function chase() {
  const yaw = craft.group.rotation.z, p = craft.group.position;
  camera.position.copy(inV(p.x - behind_m * Math.cos(yaw), p.y - behind_m * Math.sin(yaw), p.z - 0.35 * behind_m));
  camera.lookAt(craftInV());
}
let seen = null;
/** Moves the orbit camera and its target with the vehicle. */
function follow() {
  const now = craftInV();
  if (state.camera === 'chase') {
    chase();
  } else {
    if (seen) camera.position.add(now.clone().sub(seen));
    orbit.target.copy(now);
    orbit.update();
  }
  seen = now;
}

/** Draws a compass with the direction of north on the screen. */
function drawCompass() {
  const c = element('compass').getContext('2d'), direction = camera.getWorldDirection(new THREE.Vector3());
  const heading = Math.atan2(direction.x, -direction.z);  // of the camera, from north to east
  c.clearRect(0, 0, 96, 96);
  c.save();
  c.translate(48, 48);
  c.fillStyle = themeColor('card');
  c.beginPath();
  c.arc(0, 0, 46, 0, 2 * Math.PI);
  c.fill();
  c.font = '600 12px system-ui, "DejaVu Sans", sans-serif';
  c.textAlign = 'center';
  c.textBaseline = 'middle';
  for (const [name, bearing] of [['N', 0], ['E', 90], ['S', 180], ['W', 270]]) {
    const angle = bearing * Math.PI / 180 - heading;
    c.fillStyle = themeColor(name === 'N' ? 'bad' : 'soft');
    c.fillText(name, 36 * Math.sin(angle), -36 * Math.cos(angle));
  }
  c.rotate(-heading);
  for (const [color, side] of [['bad', -1], ['soft', 1]]) {
    c.fillStyle = themeColor(color);
    c.beginPath();
    c.moveTo(0, side * 26);
    c.lineTo(6, 0);
    c.lineTo(-6, 0);
    c.fill();
  }
  c.restore();
}

// --- Controls

function setTime(t_s) {
  state.t_s = Math.min(end_s, Math.max(0, t_s));
  pose(state.t_s);
}
function setPlaying(playing) {
  if (playing && state.t_s >= end_s) setTime(0);
  state.playing = playing;
  element('play').textContent = playing ? 'pause' : 'play';
  if (film.readyState === 0) return;
  film.playbackRate = state.speed;
  if (playing) film.play();
  else film.pause();
}
function setCamera(kind) {
  state.camera = kind;
  orbit.enabled = kind !== 'chase';
  if (kind !== 'chase') aim(kind);
}

function fillControls() {
  const what = element('what');
  what.append(make('h1', '', result.scenario), make('p', 'soft', `seed ${result.seed}, ${result.outcome} after ${fixed(result.flight_time_s, 1)} s; Hedgehop ${result.version}, build ${result.build}`));
  if (result.truth_used?.length) what.append(make('p', 'fail', `The module used the truth: ${result.truth_used.join('; ')}`));
  what.appendChild(make('p')).id = 'facts';
  what.append(make('p', 'soft', `${world.has_ground ? `grid lines ${short(floor.step_m)} m apart; ` : ''}collision geometry${solids.ceilings ? ', ceilings as edges' : ''}`));
  if (has_report) {
    const link = what.appendChild(make('a', '', 'report'));
    link.href = 'report.html';
  }
  const speed = element('speed');
  for (const factor of [0.1, 0.25, 0.5, 1, 2, 5, 10]) speed.appendChild(make('option', '', '× ' + factor)).value = factor;
  speed.value = 1;
  speed.addEventListener('change', () => { state.speed = film.playbackRate = Number(speed.value); });
  element('time').max = end_s;
  element('time').addEventListener('input', () => setTime(Number(element('time').value)));
  element('play').addEventListener('click', () => setPlaying(!state.playing));
  element('camera').addEventListener('change', () => setCamera(element('camera').value));
  addEventListener('keydown', (event) => {
    if (event.code !== 'Space' || event.target.tagName === 'BUTTON') return;
    event.preventDefault();
    setPlaying(!state.playing);
  });
}

let last_ms = null;
function draw(now_ms) {
  if (state.playing && last_ms !== null) {
    setTime(state.t_s + state.speed * (now_ms - last_ms) / 1000);
    if (state.t_s >= end_s) setPlaying(false);
  }
  last_ms = now_ms;
  follow();
  const {innerWidth: width, innerHeight: height} = window, size = renderer.getSize(new THREE.Vector2());
  if (size.x !== width || size.y !== height) {
    renderer.setPixelRatio(window.devicePixelRatio || 1);
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
  }
  renderer.render(stage, camera);
  drawCompass();
  requestAnimationFrame(draw);
}

const track = new Track(element('track'), {statuses, events, end_s}, setTime);
fillControls();
// Starts at the instant in the address (#t=12.5), at the last seconds before a collision, or at the closest approach.
const asked_s = Number(new URLSearchParams(location.hash.slice(1)).get('t'));
if (path.t_s.length) setTime(asked_s > 0 ? Math.min(asked_s, end_s) : collided ? Math.max(0, end_s - 2) : event.t_s);
addEventListener('resize', () => track.draw(state.t_s));
setCamera(collided ? 'chase' : 'orbit');
element('camera').value = collided ? 'chase' : 'orbit';
requestAnimationFrame(draw);

// For tests: positions in V of the vehicle and of a point on it, the state of the controls, and the number of faces of solids
// between the camera and the vehicle.
window.replay = {
  state,
  facesBefore: () => {
    stage.updateMatrixWorld(true);
    const toCraft = craftInV().sub(camera.position), ray = new THREE.Raycaster(camera.position, toCraft.clone().normalize(), 0, toCraft.length());
    return ray.intersectObject(solids.group, true).filter((hit) => hit.object.isMesh).length;
  },
  point: (forward, right, down) => {
    craft.group.updateMatrix();
    return inV(...new THREE.Vector3(forward, right, down).applyMatrix4(craft.group.matrix).toArray()).toArray();
  },
};
