'use strict';
// Summary of a flight that is not a success, at the top of the report.

const BEFORE_S = 2;

/** Returns a canvas with the image of the film at an instant. It emits `drawn` when the browser has loaded the image. */
function filmStill(film, t_s, label = '') {
  const canvas = make('canvas', 'still');
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', label);
  const video = make('video');
  video.muted = true;
  video.preload = 'auto';
  video.addEventListener('loadedmetadata', () => { video.currentTime = Math.max(0, Math.min(t_s, video.duration - 0.05)); });
  video.addEventListener('seeked', () => {
    [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
    canvas.getContext('2d').drawImage(video, 0, 0);
    canvas.dispatchEvent(new Event('drawn'));
  });
  video.src = film.src;
  return canvas;
}

/** Returns the first row from which the values equal the last value. */
function heldSince(values) {
  let row = values.length - 1;
  while (row > 0 && values[row - 1] === values[values.length - 1]) --row;
  return row;
}

/** Returns sentences about the end of the flight. */
function storyLines({result, path}) {
  const end = path.t.length - 1, t_s = result.flight_time_s;
  const lines = [];
  if (result.outcome === 'collided') {
    lines.push(`Hit ${hitWords(result)} at ${fixed(t_s, 1)} s, flying ${fixed(path.speed[end], 1)} m/s at ${fixed(path.altitude[end], 1)} m altitude.`);
  } else if (['fault', 'link_lost'].includes(result.outcome)) {
    lines.push(`Ended by a fault at ${fixed(t_s, 1)} s: ${quoted(result.cause)}`);
  } else {
    const cause = result.cause || 'ended before its goal or failed a check';  // results of earlier versions name no cause
    lines.push(quoted(cause.startsWith('in ') ? 'I' + cause.slice(1) : cause) + '.');  // a cause may begin with the name of a check
  }
  if (result.goal_missed_unchecked) lines.push('No check requires the goal; to require it, add {check: reached_goal} to the checks.');
  const status = path.statuses[path.status[end]];
  if (status && ['collided', 'fault'].includes(result.outcome)) {
    const since_s = path.t[heldSince(path.status)];
    lines.push(since_s > 0 ? `Module status “${status}” for the last ${fixed(t_s - since_s, 1)} s.` : `Module status “${status}” during the whole flight.`);
  }
  const before = path.t.findIndex((t) => t >= t_s - BEFORE_S);
  const [clearance, of] = hitWords(result) === 'the ground' ? [path.ground_clearance, ' to the ground'] : [path.clearance, ''];
  if (result.outcome === 'collided' && before > 0 && (clearance[before] ?? null) !== null) {
    lines.push(`${BEFORE_S} s before: clearance${of} ${fixed(clearance[before], 1)} m, speed ${fixed(path.speed[before], 1)} m/s.`);
  }
  if (result.goal_distance_m !== null) lines.push(`Distance to the goal: ${fixed(result.goal_distance_m, 1)} m.`);
  return lines;
}

/** Returns the instant to show: the time of the first failed check of a flight to its goal, else the end. */
function tellingTime({outcome, checks, flight_time_s}) {
  if (outcome !== 'reached') return flight_time_s;
  return checks.find((check) => !check.passed)?.t_s ?? flight_time_s;
}

/** Returns a bar of the module's statuses over the flight, with their names. */
function statusRibbon({t, status, statuses}, t_s) {
  const ribbon = make('div', 'ribbon');
  const bar = ribbon.appendChild(make('div', 'ribbon-bar'));
  const end_s = t.at(-1) || 1;
  for (let from = 0; from < t.length;) {
    let to = from;
    while (to < t.length && status[to] === status[from]) ++to;
    const until_s = to < t.length ? t[to] : end_s, name = statuses[status[from]] ?? '';
    const span = bar.appendChild(make('i', ''));
    span.style.flexGrow = Math.max(0, until_s - t[from]);
    span.style.background = status[from] < 0 ? 'transparent' : themeColor(`c${status[from] % 6}`);
    span.title = `${name}: ${fixed(t[from], 1)} s to ${fixed(until_s, 1)} s`;
    from = to;
  }
  bar.appendChild(make('b')).style.left = `${100 * t_s / end_s}%`;
  const key = ribbon.appendChild(make('p', 'soft'));
  statuses.forEach((name, i) => {
    key.appendChild(make('i', 'swatch')).style.background = themeColor(`c${i % 6}`);
    key.append(`${name || 'no status'} `);
  });
  return ribbon;
}

/** Fills the section. Removes it if the flight is a success. */
function fillStory(host, data, film) {
  const {result, path, has_replay} = data;
  const missed = result.outcome === 'timeout' && result.goal_distance_m !== null;
  const failed = missed || ['collided', 'fault', 'link_lost'].includes(result.outcome) || result.checks.some((check) => !check.passed);
  if (!failed || !path.t.length) {
    host.remove();
    return;
  }
  const t_s = tellingTime(result);
  const left = host.appendChild(make('div'));
  if (film) left.append(filmStill(film, t_s, `camera images at ${fixed(t_s, 1)} s`));
  if (path.statuses.length) left.append(statusRibbon(path, t_s));
  host.classList.toggle('text-only', !left.childElementCount);  // a module that failed before its first decision
  const text = host.appendChild(make('div', 'story-text'));
  text.append(make('h2', '', 'Summary'));
  const list = text.appendChild(make('ul'));
  for (const line of storyLines(data)) list.append(make('li', '', line));
  const actions = text.appendChild(make('p', 'actions'));
  if (film) {
    const play = actions.appendChild(make('button', '', `Play the film from ${BEFORE_S} s before`));
    play.type = 'button';
    play.addEventListener('click', () => {
      film.currentTime = Math.max(0, t_s - BEFORE_S);
      film.scrollIntoView({block: 'center'});
      film.play();
    });
  }
  if (has_replay) {
    const link = actions.appendChild(make('a', '', 'Replay in three dimensions'));
    link.href = `replay.html#t=${Math.max(0, t_s - BEFORE_S).toFixed(2)}`;
  }
}
