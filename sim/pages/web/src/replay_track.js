// The event track above the slider: module status over time, and events.

/** Returns the events of a flight: failures, closest approach, end. */
export function eventsOf(result, end_s) {
  const closest = result.closest_obstacle, events = [];
  if (closest && result.outcome !== 'collided') {
    events.push({t_s: closest.t_s, text: `closest: ${closest.what || 'obstacle'}, ${meters(closest.distance_m)}`});
  }
  const ends = {collided: `hit ${closest?.what || 'an obstacle'}`, reached: 'goal reached', timeout: 'timeout', fault: 'fault'};
  events.push({t_s: end_s, text: ends[result.outcome] ?? result.outcome, bad: ['collided', 'fault'].includes(result.outcome)});
  for (const {from_s, to_s, text} of failuresOf(result, end_s)) events.push({t_s: from_s, to_s, text, bad: true});
  return events;
}

/** Draws the track; a click moves the time there. @param statuses  [since s, word]. An event with to_s has a duration. */
export class Track {
  constructor(canvas, {statuses, events, end_s}, jump) {
    Object.assign(this, {canvas, statuses, events, end_s, t_s: 0});
    this.words = [...new Set(statuses.map(([, word]) => word))];
    canvas.setAttribute('aria-label', `module status: ${this.words.join(', ')}; ` +
      events.map(({t_s, text}) => `${text} at ${fixed(t_s, 1)} s`).join('; '));
    canvas.addEventListener('click', (event) => jump(event.offsetX / canvas.clientWidth * end_s));
    canvas.addEventListener('pointermove', (event) => { canvas.title = this.statusAt(event.offsetX / canvas.clientWidth * end_s); });
  }

  statusAt(t_s) { return this.statuses.findLast(([since]) => since <= t_s)?.[1] ?? ''; }

  draw(t_s) {
    const {canvas, end_s} = this, ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight], c = canvas.getContext('2d');
    [canvas.width, canvas.height] = [width * ratio, height * ratio];
    c.scale(ratio, ratio);
    const x = (t) => (end_s > 0 ? t / end_s : 0) * width, band = 12;
    c.font = '11px system-ui, "DejaVu Sans", sans-serif';
    this.statuses.forEach(([since, word], i) => {
      const from = x(since), to = x(this.statuses[i + 1]?.[0] ?? end_s);
      c.fillStyle = themeColor(`c${this.words.indexOf(word) % 6}`);
      c.globalAlpha = 0.55;
      c.fillRect(from, height - band, to - from, band);
      c.globalAlpha = 1;
      c.fillStyle = themeColor('ink');
      if (to - from > c.measureText(word).width + 6) c.fillText(word, from + 3, height - 2.5);
    });
    for (const {t_s: at, to_s = at, text, bad} of this.events) {
      c.fillStyle = themeColor(bad ? 'bad' : 'ink');
      c.fillRect(x(at) - 1, height - band - 4, 2, band + 4);
      c.fillRect(x(at), height - band - 4, x(to_s) - x(at), 3);
      const wide = c.measureText(text).width;
      c.fillText(text, Math.min(width - wide, Math.max(0, x(at) - wide / 2)), height - band - 6);
    }
    c.fillStyle = themeColor('ink');
    c.fillRect(x(t_s) - 1, height - band, 2, band);
  }
}
