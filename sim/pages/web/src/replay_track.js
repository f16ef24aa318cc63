// The time axis: status of the module, events and the handle of the time share one scale.

/** Returns the events of a flight: failures, closest approach, end. */
export function eventsOf(result, end_s) {
  const closest = result.closest_obstacle, events = [];
  if (closest && result.outcome !== 'collided') {
    events.push({t_s: closest.t_s, text: `closest: ${closest.what || 'obstacle'}, ${meters(closest.distance_m)}`});
  }
  const ends = {collided: `hit ${hitWords(result)}`, reached: 'goal reached'};
  if (end_s > 0) events.push({t_s: end_s, text: ends[result.outcome] ?? shownOutcome(result.outcome, result.goal_distance_m), bad: ['collided', 'fault', 'link_lost'].includes(result.outcome)});
  for (const {from_s, to_s, text} of failuresOf(result, end_s)) events.push({t_s: from_s, to_s, text, bad: true});
  return events;
}

const SIDE = 10, BAND = 14, AXIS = 18, FONT = '11px system-ui, "DejaVu Sans", sans-serif';  // px

/** Pointer and arrow keys move the time. @param jump  called with the time. */
export class Track {
  constructor(canvas, jump) {
    Object.assign(this, {canvas, t_s: 0, statuses: [], events: [], words: [], end_s: 0, back: document.createElement('canvas')});
    let held = false;
    const go = (event) => jump(this.timeAt(event.offsetX));
    canvas.addEventListener('pointerdown', (event) => { held = true; canvas.setPointerCapture(event.pointerId); go(event); });
    canvas.addEventListener('pointerup', () => { held = false; });
    canvas.addEventListener('pointermove', (event) => {
      if (held) go(event);
      canvas.title = `${fixed(this.timeAt(event.offsetX), 1)} s: ${this.statusAt(this.timeAt(event.offsetX))}`;
    });
    canvas.addEventListener('keydown', (event) => {
      const step = {ArrowLeft: -0.1, ArrowRight: 0.1, PageDown: -5, PageUp: 5, Home: -Infinity, End: Infinity}[event.key];
      if (step === undefined) return;
      event.preventDefault();
      jump(this.t_s + step);
    });
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.layout());
  }
  /** @param statuses  [since s, word]. An event with to_s has a duration. */
  set({statuses, events, end_s}) {
    Object.assign(this, {statuses, events, end_s, words: [...new Set(statuses.map(([, word]) => word))]});
    this.canvas.setAttribute('aria-label', `time; module status: ${this.words.join(', ')}; ` + events.map(({t_s, text}) => `${text} at ${fixed(t_s, 1)} s`).join('; '));
    this.canvas.ariaValueMax = end_s;
    this.layout();
  }
  x(t_s) { return SIDE + (this.end_s > 0 ? t_s / this.end_s : 0) * (this.width - 2 * SIDE); }
  timeAt(x) { return Math.min(1, Math.max(0, (x - SIDE) / (this.width - 2 * SIDE))) * this.end_s; }
  statusAt(t_s) { return this.statuses.findLast(([since]) => since <= t_s)?.[1] ?? ''; }

  /** Draws all but the handle, once for each size. */
  layout() {
    const {canvas, back, end_s} = this, ratio = window.devicePixelRatio || 1;
    [this.width, this.height] = [canvas.clientWidth, canvas.clientHeight];
    for (const one of [canvas, back]) [one.width, one.height] = [this.width * ratio, this.height * ratio];
    this.ratio = ratio;
    this.ink = themeColor('ink');
    this.accent = themeColor('c0');
    const c = back.getContext('2d'), top = this.height - AXIS - BAND;
    c.scale(ratio, ratio);
    c.font = FONT;
    this.statuses.forEach(([since, word], i) => {
      const from = this.x(since), to = this.x(this.statuses[i + 1]?.[0] ?? end_s);
      c.fillStyle = themeColor(`c${this.words.indexOf(word) % 6}`);
      c.globalAlpha = 0.55;
      c.fillRect(from, top, to - from, BAND);
      c.globalAlpha = 1;
      c.fillStyle = this.ink;
      if (to - from > c.measureText(word).width + 6) c.fillText(word, from + 3, top + BAND - 3.5);
    });
    this.drawEvents(c, top);
    c.fillStyle = themeColor('soft');
    c.textAlign = 'center';
    for (const t of end_s > 0 ? niceTicks(0, end_s, (this.width - 2 * SIDE) / 70).values : []) {
      c.fillRect(this.x(t) - 0.5, top + BAND, 1, 4);
      c.fillText(short(t) + (t === 0 ? ' s' : ''), this.x(t), top + BAND + 15);
    }
    this.draw(this.t_s);
  }
  /** Draws the events; a text that would cover another one is one row higher. */
  drawEvents(c, top) {
    const ends = [-Infinity, -Infinity];
    for (const {t_s: at, to_s = at, text, bad} of [...this.events].sort((a, b) => a.t_s - b.t_s)) {
      const wide = c.measureText(text).width, left = Math.min(this.width - wide - 2, Math.max(2, this.x(at) - wide / 2));
      const row = left > ends[0] + 6 ? 0 : left > ends[1] + 6 ? 1 : -1;
      c.fillStyle = themeColor(bad ? 'bad' : 'ink');
      c.fillRect(this.x(at) - 1, top - 4, 2, BAND + 4);
      c.fillRect(this.x(at), top - 4, this.x(to_s) - this.x(at), 3);
      if (row < 0) continue;  // its mark and the title of the track remain
      c.fillText(text, left, top - 7 - 12 * row);
      ends[row] = left + wide;
    }
  }
  /** Draws the handle. */
  draw(t_s) {
    this.t_s = t_s;
    const c = this.canvas.getContext('2d'), x = this.x(t_s), top = this.height - AXIS - BAND;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    c.drawImage(this.back, 0, 0);
    c.scale(this.ratio, this.ratio);
    c.fillStyle = this.accent;
    c.fillRect(x - 1.5, top - 5, 3, BAND + 10);
    c.beginPath();
    c.arc(x, top + BAND / 2, 7, 0, 2 * Math.PI);
    c.fill();
  }
}
