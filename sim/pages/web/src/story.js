'use strict';
// What happened, at a glance: opens the page of a flight that ended badly.

const BEFORE_S = 2;

/** The image of the film at an instant, drawn into a canvas as soon as the browser has it; it then says `drawn`. */
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

/** Since when the last value of a list has held, as a row. */
function heldSince(values) {
  let row = values.length - 1;
  while (row > 0 && values[row - 1] === values[values.length - 1]) --row;
  return row;
}

/** What to say about the end: one sentence an item. */
function storyLines({result, path}) {
  const end = path.t.length - 1, t_s = result.flight_time_s;
  const lines = [];
  if (result.outcome === 'collided') {
    lines.push(`Hit ${result.closest_obstacle?.what || 'an obstacle'} at ${fixed(t_s, 1)} s, flying ${fixed(path.speed[end], 1)} m/s at ${fixed(path.altitude[end], 1)} m altitude.`);
  } else {
    lines.push(`Ended by a fault at ${fixed(t_s, 1)} s: ${result.cause}`);
  }
  const status = path.statuses[path.status[end]];
  if (status) {
    const since_s = path.t[heldSince(path.status)];
    lines.push(since_s > 0 ? `The module said “${status}” for the last ${fixed(t_s - since_s, 1)} s.` : `The module said “${status}” all the way.`);
  }
  const before = path.t.findIndex((t) => t >= t_s - BEFORE_S);
  if (result.outcome === 'collided' && before > 0 && path.clearance[before] !== null) {
    lines.push(`${BEFORE_S} s before, it was ${fixed(path.clearance[before], 1)} m away at ${fixed(path.speed[before], 1)} m/s.`);
  }
  if (result.goal_distance_m !== null) lines.push(`The goal was ${fixed(result.goal_distance_m, 1)} m away.`);
  return lines;
}

/** Fills the section, or removes it where the flight ended well or in time. */
function fillStory(host, data, film) {
  const {result, path, has_replay} = data;
  if (!['collided', 'fault'].includes(result.outcome) || !path.t.length) {
    host.remove();
    return;
  }
  const t_s = result.flight_time_s;
  if (film) host.append(filmStill(film, t_s, `what the cameras saw at ${fixed(t_s, 1)} s`));
  const text = host.appendChild(make('div', 'story-text'));
  text.append(make('h2', '', 'What happened'));
  const list = text.appendChild(make('ul'));
  for (const line of storyLines(data)) list.append(make('li', '', line));
  const actions = text.appendChild(make('p', 'actions'));
  if (film) {
    const play = actions.appendChild(make('button', '', `Play the last ${BEFORE_S} s of the film`));
    play.type = 'button';
    play.addEventListener('click', () => {
      film.currentTime = Math.max(0, t_s - BEFORE_S);
      film.scrollIntoView({block: 'center'});
      film.play();
    });
  }
  if (has_replay) {
    const link = actions.appendChild(make('a', '', 'Replay it in three dimensions'));
    link.href = `replay.html#t=${Math.max(0, t_s - BEFORE_S).toFixed(2)}`;
  }
}
