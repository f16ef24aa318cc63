// The flight in three dimensions: the vehicle follows its true path through the scene as the cameras see it.
import * as THREE from 'three';

import {drawCompass} from './replay_compass.js';
import {eventMark, moverTag, NameTags, scaleLabels, separateLabels} from './replay_labels.js';
import {LiveFlight, livePanels} from './replay_live.js';
import {ModuleMap} from './replay_map.js';
import {Plots} from './replay_plots.js';
import {goalMark, ground, groundMark, moverMesh, PathLine, solidsMesh, vehicle} from './replay_scene.js';
import {Screens} from './replay_screens.js';
import {eventsOf, Track} from './replay_track.js';
import {Views} from './replay_views.js';
import {addWorld} from './replay_world.js';

/**
 * Frame V, the world of three.js: x east, y up, z south. Everything in W (north, east, down) is a child of a group with
 * this matrix.
 */
const R_VW = new THREE.Matrix4().set(0, 1, 0, 0, 0, 0, -1, 0, -1, 0, 0, 0, 0, 0, 0, 1);
function inV(north, east, down) { return new THREE.Vector3(north, east, down).applyMatrix4(R_VW); }

const data = JSON.parse(document.getElementById('data').textContent);
const {scene: world, hull, path, route, goal, statuses} = data;
let {result} = data;
const element = (id) => document.getElementById(id);
const state = {t_s: 0, playing: false, speed: 1, live: data.live, get camera() { return views.kind; }};
const endTime = () => path.t_s.at(-1) ?? 0;

// --- The scene

const renderer = new THREE.WebGLRenderer({canvas: element('view'), antialias: true});
renderer.outputColorSpace = THREE.LinearSRGBColorSpace;  // the simulator's colors have no gamma either
const stage = new THREE.Scene();
stage.background = new THREE.Color(...data.surfaces.sky.horizon);
const inW = stage.add(new THREE.Group()).children.at(-1);
inW.matrixAutoUpdate = false;
inW.matrix.copy(R_VW);
const bounds = world.bounds.length ? world.bounds
  : [...finiteRange(path.north_m), ...finiteRange(path.east_m)].map((v, i) => v + (i % 2 ? 20 : -20));
const surfaces = addWorld(data.surfaces, stage, inW, renderer, bounds);
const has_surfaces = data.surfaces.meshes[0].count > 0;
const floor = ground(bounds), solids = solidsMesh(world, path), craft = vehicle(hull), shade = groundMark(craft.reach);
const movers = world.movers.map((mover, i) => {
  const group = new THREE.Group(), seen = surfaces.movers[i], solid = moverMesh(mover);
  group.add(seen, solid, moverTag(mover));
  return Object.assign(group, {seen, solid});
});
const line = new PathLine(), tags = new NameTags(world.labels, Math.min(0, ...path.down_m));
const screens = new Screens(data, craft.reach), map = new ModuleMap(data.map, path);
shade.visible = world.has_ground;
craft.group.add(screens.group);
craft.group.rotation.order = 'ZYX';  // yaw, then pitch, then roll, each about the new axis
inW.add(floor.group, solids.group, line.line, craft.group, shade, ...movers, tags.group, map.group);
for (const place of [...route, goal]) if (place) inW.add(goalMark(place));
line.set(path);
// A ceiling is cut away if it is between the viewer and the flight.
const ceiling_m = Math.max(...solids.ceilings.map(([low, high]) => high[2]), -Infinity), cut = new THREE.Plane(new THREE.Vector3(0, -1, 0), -ceiling_m - 0.01);

const views = new Views(element('view'), craft, inV, R_VW, data.cameras, Math.max(bounds[1] - bounds[0], bounds[3] - bounds[2]));

/** Shows the surfaces, or the geometry that the simulator collides with. */
function showSolids(shown) {
  surfaces.fixed.visible = !shown;
  solids.group.visible = shown;
  floor.group.visible = shown && world.has_ground;
  for (const {seen, solid} of movers) [seen.visible, solid.visible] = [!shown, shown];
}

// --- The instant

/** Returns the row before an instant, and the share of the step to the next row. */
function place(t_s) {
  const row = rowBefore(path.t_s, t_s), next = Math.min(row + 1, path.t_s.length - 1);
  const step = path.t_s[next] - path.t_s[row];
  return {row, next, share: step > 0 ? Math.min(1, Math.max(0, (t_s - path.t_s[row]) / step)) : 0};
}
const between = (values, {row, next, share}) => values[row] + share * (values[next] - values[row]);
/** Interpolates an angle along the shorter arc. */
function turnBetween(values, {row, next, share}) {
  const turn = values[next] - values[row];
  return values[row] + share * Math.atan2(Math.sin(turn), Math.cos(turn));
}

/** The film of the run follows the time. During playback, its position is corrected only if the difference is large. */
const film = make('video'), screen = element('film');
film.muted = true;
function showFilm(image = film, width = film.videoWidth, height = film.videoHeight) {
  if (!width) return;
  element('film-card').hidden = false;
  if (screen.width !== width || screen.height !== height) [screen.width, screen.height] = [width, height];
  screen.getContext('2d').drawImage(image, 0, 0);
}
function windFilm(t_s) {
  if (film.readyState === 0) return;
  const apart_s = Math.abs(film.currentTime - t_s), most_s = state.playing ? 0.3 : 0.02;
  if (!film.seeking && apart_s > most_s) film.currentTime = Math.min(t_s, film.duration);
}
function followFilm() {
  showFilm();
  film.requestVideoFrameCallback?.(followFilm);
}
if (data.has_film) {
  film.addEventListener('loadeddata', () => windFilm(state.t_s));
  film.addEventListener('seeked', () => { showFilm(); if (!state.playing) windFilm(state.t_s); });
  film.requestVideoFrameCallback?.(followFilm);
  film.src = 'video.webm';
}

function pose(t_s) {
  const at = place(t_s), {group} = craft;
  group.position.set(between(path.north_m, at), between(path.east_m, at), between(path.down_m, at));
  group.rotation.set(turnBetween(path.roll_rad, at), turnBetween(path.pitch_rad, at), turnBetween(path.yaw_rad, at), 'ZYX');
  shade.position.set(group.position.x, group.position.y, -0.04);
  movers.forEach((mover, i) => {
    const {way} = world.movers[i], last = way.length / 3 - 1, k = Math.min(last, t_s / world.step_s), row = Math.floor(k);
    const next = Math.min(row + 1, last);
    mover.position.set(...[0, 1, 2].map((axis) => way[3 * row + axis] + (k - row) * (way[3 * next + axis] - way[3 * row + axis])));
  });
  screens.setTime(t_s);
  map.setTime(t_s);
  track.draw(t_s);
  windFilm(t_s);
  return at;
}

let written_ms = -Infinity;
/** Writes the numbers and names, not at every frame. */
function write(t_s, now_ms) {
  if (now_ms - written_ms < 80) return;
  written_ms = now_ms;
  const at = place(t_s), clearance = path.clearance_m[at.row] ?? null, status = track.statusAt(t_s);
  element('clock').textContent = `${fixed(t_s, 2)} of ${fixed(endTime(), 2)} s`;
  element('facts').textContent = `${status ? status + ', ' : ''}clearance ${clearance === null ? 'none within range' : meters(clearance)}, ` +
    `speed ${fixed(between(path.speed_mps, at), 1)} m/s, altitude ${fixed(-between(path.down_m, at), 1)} m`;
  element('track').ariaValueNow = fixed(t_s, 2);
  if (element('show-names').checked) tags.update(craft.group.position.x, craft.group.position.y);
}

// --- Controls

function setTime(t_s) {
  if (!path.t_s.length) return;
  state.t_s = Math.min(endTime(), Math.max(0, t_s));
  pose(state.t_s);
}
function setPlaying(playing) {
  if (playing && state.t_s >= endTime()) setTime(0);
  state.playing = playing;
  element('play').textContent = playing ? 'pause' : 'play';
  if (film.readyState === 0) return;
  film.playbackRate = state.speed;
  if (playing) film.play();
  else film.pause();
}

function describe() {
  const what = element('what');
  const outcome = shownOutcome(result.outcome, result.goal_distance_m);
  what.replaceChildren(make('h1', '', result.scenario), make('p', 'soft', data.live ? `seed ${result.seed}, ${outcome}`
    : `seed ${result.seed}, ${outcome} after ${fixed(result.flight_time_s, 1)} s`));
  if (result.truth_used?.length) what.append(make('p', 'fail', `The module used the truth: ${result.truth_used.join('; ')}`));
  what.appendChild(make('p')).id = 'facts';
  what.append(make('p', 'soft more', `Hedgehop ${result.version}, build ${result.build}` + (data.map ? '; map of the module: green true, red false' : '')));
  if (!data.has_report) return;
  what.appendChild(make('a', '', 'report')).href = 'report.html';
}

function fillControls() {
  const speed = element('speed');
  for (const factor of [0.1, 0.25, 0.5, 1, 2, 5, 10]) speed.appendChild(make('option', '', '× ' + factor)).value = factor;
  speed.value = 1;
  speed.addEventListener('change', () => { state.speed = film.playbackRate = Number(speed.value); });
  for (const [kind, words] of views.names) element('camera').appendChild(make('option', '', words)).value = kind;
  element('camera').addEventListener('change', () => views.set(element('camera').value));
  element('play').addEventListener('click', () => live && state.live ? live.send(live.paused ? 'play' : 'pause') : setPlaying(!state.playing));
  element('show-names').addEventListener('change', () => { tags.group.visible = element('show-names').checked; });
  element('show-solids').checked = !has_surfaces;
  element('show-solids').addEventListener('change', () => showSolids(element('show-solids').checked));
  showSolids(!has_surfaces);
  addEventListener('keydown', (event) => {
    if (event.code !== 'Space' || event.target.closest?.('button, input, select, a')) return;
    event.preventDefault();
    element('play').click();
  });
}

// --- The live view

let live = null;
/** @param jpeg  in base64. @param show  called with the image and its size. */
async function decoded(jpeg, show) {
  const image = new Image();
  image.src = 'data:image/jpeg;base64,' + jpeg;
  await image.decode();
  show(image, image.naturalWidth, image.naturalHeight);
}
function startLive() {
  let grown_ms = 0;
  const setTrack = () => track.set({statuses, events: eventsOf(result, result.flight_time_s), end_s: endTime()});
  const grow = () => {
    grown_ms = performance.now();
    line.set(path);
    plots.grow();
    setTrack();
  };
  element('step').hidden = element('live').hidden = false;
  element('speed').parentElement.hidden = true;
  live = new LiveFlight(data, {
    grown: () => { if (performance.now() - grown_ms > 200 || live.paused) grow(); if (state.live) setTime(endTime()); },
    images: (sheet, module) => {
      if (sheet) decoded(sheet, (...image) => screens.paint(...image));
      if (module) decoded(module, showFilm);
    },
    paused: (paused) => { element('play').textContent = paused ? 'play' : 'pause'; },
    ended: (final) => {
      Object.assign(data, {live: false});
      result = {...final, seed: result.seed};  // as a text, which is exact
      state.live = false;
      for (const id of ['step', 'live']) element(id).hidden = true;
      element('speed').parentElement.hidden = false;
      grow();
      describe();
      setPlaying(false);
    },
  });
  element('step').addEventListener('click', () => live.send('step'));
  element('live').addEventListener('click', () => { state.live = true; setTime(endTime()); });
  element('play').textContent = 'pause';
}

// --- Frames

const toViewer = new THREE.Vector3(), frame_ms = [];  // script time of the last frames
let last_ms = null;
function draw(now_ms) {
  const begin_ms = performance.now();
  if (state.playing && last_ms !== null) {
    setTime(state.t_s + state.speed * (now_ms - last_ms) / 1000);
    if (state.t_s >= endTime()) setPlaying(false);
  }
  last_ms = now_ms;
  const {clientWidth: width, clientHeight: height} = renderer.domElement.parentElement, size = renderer.getSize(new THREE.Vector2());
  if (size.x !== width || size.y !== height) {
    renderer.setPixelRatio(window.devicePixelRatio || 1);
    renderer.setSize(width, height, false);
    views.resize(width / height);
  }
  views.follow();
  const {camera} = views;
  surfaces.sky.position.copy(camera.position);
  screens.group.visible = screens.has_images && element('show-images').checked && !views.onboard;
  if (screens.group.visible) screens.face(craft.group.worldToLocal(toViewer.copy(camera.position)).normalize());
  craft.body.visible = !views.onboard;
  scaleLabels(views.label_m);
  separateLabels(camera, width / height);
  renderer.clippingPlanes = camera.position.y > -ceiling_m ? [cut] : [];
  renderer.render(stage, camera);
  drawCompass(element('compass'), camera, views.kind === 'plan');
  if (path.t_s.length) {
    write(state.t_s, now_ms);
    plots.setTime(state.t_s, now_ms);
  }
  frame_ms.push(performance.now() - begin_ms);
  if (frame_ms.length > 600) frame_ms.shift();
  requestAnimationFrame(draw);
}

const track = new Track(element('track'), (t_s) => { state.live = false; setTime(t_s); });
describe();
fillControls();
const plots = new Plots(element('plots'), element('section'), data.live ? livePanels(path) : data.panels, {pick: (t_s) => setTime(t_s)});
const events = eventsOf(result, endTime()), collided = result.outcome === 'collided';
track.set({statuses, events, end_s: endTime()});
// Starts at the instant in the address (#t=12.5), at the last seconds before a collision, or at the closest approach.
const asked_s = Number(new URLSearchParams(location.hash.slice(1)).get('t'));
setTime(asked_s > 0 ? asked_s : collided ? endTime() - 2 : events[0]?.t_s ?? 0);
if (result.closest_obstacle || (collided && path.t_s.length)) {
  const at = place(events[0].t_s), where = [path.north_m, path.east_m, path.down_m].map((values) => between(values, at));
  inW.add(eventMark({text: events[0].text, place: where, collided}, craft.reach));
}
addEventListener('resize', () => track.layout());
views.set(collided ? 'chase' : 'orbit');
element('camera').value = views.kind;
if (data.live) startLive();
requestAnimationFrame(draw);

// For tests: positions in V of the vehicle and of a point on it, the state of the controls, the number of faces of solids
// between the camera and the vehicle, and the script time of frames.
window.replay = {
  state, track, frame_ms, setTime, surfaces, screens, tags, map, path,
  facesBefore: () => {
    stage.updateMatrixWorld(true);
    const {camera} = views, toCraft = views.craftInV().sub(camera.position), ray = new THREE.Raycaster(camera.position, toCraft.clone().normalize(), 0, toCraft.length());
    return ray.intersectObject(solids.group, true).filter((hit) => hit.object.isMesh).length;
  },
  point: (forward, right, down) => {
    craft.group.updateMatrix();
    return inV(...new THREE.Vector3(forward, right, down).applyMatrix4(craft.group.matrix).toArray()).toArray();
  },
};
