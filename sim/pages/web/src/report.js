'use strict';
// Builds the report of a run from its data: verdict, checks, plan, video, plots, details.

/** Returns the text of an outcome, and whether the outcome is good without checks. */
function judge({outcome, goal_distance_m}) {
  switch (outcome) {
    case 'reached': return {words: 'Reached the goal', good: true};
    case 'collided': return {words: 'Collided', good: false};
    case 'timeout': return goal_distance_m !== null ? {words: 'Timeout before the goal', good: false} : {words: 'Completed', good: true};
    case 'fault': return {words: 'Ended by a fault', good: false};
    case 'link_lost': return {words: 'Lost the autopilot', good: false};
    default: return {words: outcome, good: false};
  }
}

function fillVerdict(host, {result, description, has_replay, module}) {
  const what = host.appendChild(make('div', 'what'));
  what.appendChild(make('h1', '', result.scenario)).append(make('small', 'soft', ` ${module}`));
  if (description) what.append(make('p', '', description));
  what.append(make('p', 'soft', `seed ${result.seed}, Hedgehop ${result.version}, build ${result.build}`));

  if (has_replay) {
    const link = what.appendChild(make('p')).appendChild(make('a', '', 'Replay in three dimensions'));
    link.href = 'replay.html';
  }

  const failed = result.checks.filter((c) => !c.passed).length, all = result.checks.length;
  const {words, good} = judge(result), faulted = ['fault', 'link_lost'].includes(result.outcome);
  const bad = faulted || (all ? failed > 0 : !good);  // without a fault, checks decide, as for the exit status
  const badge = host.appendChild(make('div', 'badge ' + (bad ? 'bad' : all ? 'good' : '')));
  badge.append(make('span', 'mark', bad ? '✕' : all ? '✓' : '–'));
  const lines = badge.appendChild(make('div'));
  lines.append(make('strong', '', words));
  lines.append(make('span', '', !all ? 'no checks' : failed ? `${failed} of ${all} checks fail` : all === 1 ? 'the check holds' : `all ${all} checks hold`));
  if (result.failures?.length) what.append(make('p', 'fail', `Failures injected by the scenario: ${result.failures.join('; ')}`));
  if (result.truth_used?.length) what.append(make('p', 'fail', `The module used the truth: ${result.truth_used.join('; ')}`));
}

function fillTiles(host, result) {
  const tile = (name, value, unit, more = '') => {
    const element = host.appendChild(make('div', 'tile'));
    element.append(make('div', 'name', name));
    const line = element.appendChild(make('div', 'value', value));
    if (unit) line.append(' ', make('small', '', unit));
    element.append(make('div', 'more', more));
  };
  const where = (p) => p ? `${p.what || 'obstacle'} at ${fixed(p.t_s, 1)} s` : 'no obstacle within range';
  tile('flight time', fixed(result.flight_time_s, 1), 's', `${result.decisions} decisions`);
  tile('path length', fixed(result.path_length_m, 1), 'm', `mean speed ${fixed(result.mean_speed_mps, 2)} m/s`);
  tile('minimum clearance to obstacles', fixed(result.min_obstacle_clearance_m, 2), 'm', where(result.closest_obstacle));
  tile('minimum clearance to the ground', fixed(result.min_ground_clearance_m, 2), 'm', where(result.closest_ground));
  if (result.goal_distance_m !== null) tile('distance to the goal', fixed(result.goal_distance_m, 1), 'm', 'at the end, horizontal');
  const stage = (name, {median, p95}) => {
    const [value, unit = ''] = measured(median, 'ms', 3).split(' ');
    tile(name, value, unit, `median; 95 % below ${measured(p95, 'ms', 3)}`);
  };
  stage('decision time', result.decision_ms);
  stage('rendering, per image instant', result.render_ms);
  tile('speed of simulation', short(result.realtime_factor, 3), '× real time', `${measured(result.wall_s, 's', 3)} of wall time`);
}

const localMapColors = 'Light: free; grey: unknown; dark: obstacle; green: planned path and hull; blue: route; orange: moving obstacle; red circle: place to look at.';
const RELATIONS = {'<=': '≤', '>=': '≥', '>': '>'};

/** Returns the figures with which a value differs from its limit, so that no failure reads as "2.04 ≤ 2.04". */
function checkFigures(value, limit, unit) {
  const most = 17;  // these distinguish all numbers
  let figures = 4;
  if (value !== limit) while (figures < most && measured(value, unit, figures) === measured(limit, unit, figures)) ++figures;
  return figures;
}

function fillChecks(host, {checks, closest_obstacle, closest_ground}) {
  if (!checks.length) {
    host.append(make('p', 'soft', 'The scenario defines no checks.'));
    return;
  }
  host.classList.add('scroll');
  const table = host.appendChild(make('table'));
  addRow(table, [['', ''], ['check', ''], ['value', 'number'], ['must be', 'number'], ['at', 'number']], 'th');
  for (const {name, passed, value, limit, unit, must, t_s, cause} of checks) {
    const figures = checkFigures(value, limit, unit), measure = (v) => measured(v, unit, figures);
    const tiny = figures === 4 && Math.abs(value) < 0.01 && (limit === 0 || Math.abs(limit) >= 0.01);
    addRow(table, [[passed ? '✓' : '✕', passed ? 'pass' : 'fail'], [wordsOf(name, unit), ''],
      [measured(value, unit, tiny ? 2 : figures), 'number'], [limit === null ? '–' : `${RELATIONS[must] ?? must} ${measure(limit)}`, 'number'],
      [t_s === null || t_s === undefined ? '' : `${fixed(t_s, 2)} s`, 'number']]);
    const closest = [closest_obstacle, closest_ground].find((place) => place?.distance_m === value && place.t_s === t_s);
    if (passed && closest?.what) table.lastChild.children[1].append(make('span', 'soft', ` (${closest.what})`));
    table.lastChild.firstChild.append(make('span', 'word', passed ? ' holds' : ' fails'));
    if (passed || !cause) continue;
    addRow(table, [['', ''], [quoted(cause), 'soft']]);
    table.lastChild.lastChild.colSpan = 4;
  }
}

function fillDetails(host, {result, module, scene, vehicle, scenario_yaml}) {
  host.append(make('h2', '', 'Details'));
  addCommand(host, result.command_line);

  const facts = host.appendChild(make('div', 'facts')), first = facts.appendChild(make('div', 'stack'));
  const add = (title, rows, place = facts) => {
    const table = place.appendChild(make('div', 'scroll')).appendChild(make('table'));
    addRow(table, [[title, ''], ['', 'number']], 'th');
    rows.forEach(([name, value]) => addRow(table, [[name, ''], [value, 'number']]));
  };
  const stage = (s) => s ? `${measured(s.median, 'ms', 3)}, 95 % below ${measured(s.p95, 'ms', 3, s.median)}` : '–';
  add('run', [['module', module], ['scene', scene], ['vehicle', vehicle], ['trajectory hash', result.trajectory_hash]], first);
  add('wall time, median', [['decision', stage(result.decision_ms)], ['images of all cameras', stage(result.render_ms)],
    ...(result.velocimeter_ms?.p95 ? [['velocity from flow', stage(result.velocimeter_ms)]] : []), ['physics step', stage(result.physics_ms)]], first);
  const metrics = Object.entries(result.metrics).map(([name, value]) => {
    const unit = result.metric_units?.[name] ?? '';
    return [wordsOf(name, unit), measured(value, unit)];
  });
  const half = Math.max(8, Math.ceil(metrics.length / 2));
  for (const rows of [metrics.slice(0, half), metrics.slice(half)]) if (rows.length) add('metric', rows);
  const scenario = host.appendChild(make('details'));
  scenario.append(make('summary', '', 'Resolved scenario'), make('pre', '', scenario_yaml));
}

/** Converts an embedded video to a file in memory, because browsers can seek only in files. */
function openFilm() {
  const film = document.getElementById('film');
  if (!film) {
    document.getElementById('film-card').remove();
    return null;
  }
  const text = document.getElementById('film-bytes');
  if (text) {
    const bytes = Uint8Array.from(atob(text.textContent), (c) => c.charCodeAt(0));
    film.src = URL.createObjectURL(new Blob([bytes], {type: 'video/webm'}));
    text.remove();
  }
  return film;
}

/** Shows the closest approach as the still image of the film. */
function setPoster(film, t) {
  const still = filmStill(film, t);
  still.addEventListener('drawn', () => {
    try {
      film.poster = still.toDataURL('image/jpeg');
    } catch { /* browsers may forbid a page to read a linked film */ }
  });
}

/** Returns the notes on the headings of the plots. */
function sectionNotes(module) {
  const notes = {'Command and motion': 'drag to zoom, double click to see all, click to seek the video there'};
  if (module === 'flow_balance') notes['Module signals'] = 'as in Garratt and Cheung 2009, fig. 7';
  return notes;
}

/** Removes a goal that is not the end of the planned route of the module: it is irrelevant to the flight. */
function dropUnflownGoal({map, plan}) {
  if (!map || !map.course.length || !plan.goal) return;
  const {n, e, radius} = plan.goal;
  if (!map.course.some(([cn, ce]) => Math.hypot(cn - n, ce - e) <= radius)) plan.goal = null;
}

/** Fits the columns of plan and film, so that both end at the same height, and stretches the plan to its column. */
function fitPair(pair, map, filmView) {
  const width = pair.clientWidth, stack = pair.lastElementChild, planCard = pair.firstElementChild;
  const scene = map.whole.width / map.whole.height, apart = 16;
  const stacked = width < 868 || scene > 2.2;
  pair.classList.toggle('stacked', stacked);
  let columns = '';
  map.lowest = 0;
  if (!stacked) {
    const aspect = filmView?.aspect || 1.5, film = document.getElementById('film-card');
    const rest = stack.scrollHeight - (film ? (film.clientWidth - 32) / aspect : 0);
    const planHeight = (w) => Math.min(680, Math.max(220, (w - 90) / scene + 46)) + 110;
    const stackHeight = (w) => (film ? (width - apart - w - 32) / aspect : 0) + rest;
    let best = 0.5 * width, least = Infinity;
    for (let w = 0.3 * width; w <= 0.68 * width; w += 10) {
      const apart_px = Math.abs(planHeight(w) - stackHeight(w));
      if (apart_px < least) [least, best] = [apart_px, w];
    }
    columns = `${Math.round(best)}px minmax(0, 1fr)`;
  }
  pair.style.gridTemplateColumns = columns;
  if (!stacked) map.lowest = stack.clientHeight - (planCard.clientHeight - map.canvas.clientHeight);
  map.draw();
}

function main() {
  const data = JSON.parse(document.getElementById('data').textContent);
  dropUnflownGoal(data);
  fillVerdict(document.getElementById('verdict'), data);
  fillTiles(document.getElementById('tiles'), data.result);
  fillChecks(document.getElementById('checks'), data.result);
  fillDetails(document.getElementById('details'), data);
  const film = openFilm(), filmView = film && new FilmView(film);
  if (film) setPoster(film, data.result.closest_obstacle?.t_s ?? 0);
  if (film && data.module === 'local_map') document.getElementById('film-card').append(make('p', 'plan-key', localMapColors));
  fillStory(document.getElementById('story'), data, film);
  const against = new RunAgainst(document.getElementById('against'), data, film);
  if (!data.map) document.getElementById('landmarks-card').remove();

  // Plan and plots show the same instant: that of the pointer, else that of the video.
  let pointer = null, drawn;
  const show = () => {
    const t = pointer ?? (film && film.currentTime > 0 ? film.currentTime : null);
    if (t === drawn) return;
    drawn = t;
    plan.setTime(t);
    landmarks?.setTime(t);
    charts.setTime(t);
  };
  let pending = false;
  const ask = () => {
    if (pending) return;
    pending = true;
    requestAnimationFrame(() => { pending = false; show(); });
  };
  const on = {
    hover: (t) => { pointer = t; ask(); },
    pick: (t) => { if (film) film.currentTime = Math.max(0, t); },
  };
  const plan = new PlanView(document.getElementById('plan'), data, on);
  const landmarks = data.map ? new LandmarksView(document.getElementById('landmarks'), data) : null;
  const charts = new Charts(document.getElementById('charts'), data.panels, sectionNotes(data.module), on,
    failuresOf(data.result, data.result.flight_time_s));
  if (film) {
    const follow = () => { ask(); if (!film.paused) requestAnimationFrame(follow); };
    film.addEventListener('play', follow);
    film.addEventListener('seeked', ask);
  }

  // Without a film, the first plots are next to the plan.
  const pair = document.querySelector('.pair'), stack = pair.lastElementChild;
  if (!film) stack.append(...[...document.querySelectorAll('#charts .chart')].slice(0, 4).filter((chart, i) => i % 2 === 0));
  const fit = () => fitPair(pair, plan.map, filmView);
  fit();
  film?.addEventListener('opened', fit);
  addEventListener('resize', fit);

  const color = document.getElementById('plan-color');
  plan.colorings.forEach(({name}) => color.append(make('option', '', name)));
  color.addEventListener('change', () => plan.setColoring(color.value));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { plan.draw(); landmarks?.draw(); charts.build(); against.redraw(); });
}
main();
