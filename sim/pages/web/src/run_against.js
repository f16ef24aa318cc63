'use strict';
// A run compared with another one: first difference, settings, paths, films and signals.

class RunAgainst {
  constructor(host, data, film) {
    const {against} = data;
    if (!against) {
      host.remove();
      return;
    }
    Object.assign(this, {data, against});
    host.append(make('h2', '', `Compared with ${against.name}`));
    for (const line of against.first) host.append(make('p', 'first-difference', line));
    const pair = host.appendChild(make('div', 'pair'));
    this.fillPaths(pair.appendChild(make('div')));
    const facts = pair.appendChild(make('div', 'stack'));
    this.fillFacts(facts.appendChild(make('div', 'scroll')));
    this.fillSettings(facts.appendChild(make('div')));
    this.fillFilms(host, film);
    const none = {hover: () => {}, pick: () => {}};
    this.charts = new Charts(host.appendChild(make('div')), against.panels, {}, none);
  }

  fillFacts(host) {
    const table = host.appendChild(make('table')), {result} = this.data, other = this.against.result;
    addRow(table, [['', ''], ['this run', 'number'], ['other run', 'number']], 'th');
    const row = (name, of) => addRow(table, [[name, ''], [of(result), 'number'], [of(other), 'number']]);
    row('outcome', (r) => shownOutcome(r.outcome, r.goal_distance_m));
    row('checks that hold', (r) => `${r.checks.filter((c) => c.passed).length} of ${r.checks.length}`);
    row('seed', (r) => String(r.seed));
    row('flight time, s', (r) => fixed(r.flight_time_s, 1));
    row('path length, m', (r) => fixed(r.path_length_m, 1));
    row('minimum clearance to obstacles, m', (r) => fixed(r.min_obstacle_clearance_m, 2));
    row('distance to the goal, m', (r) => fixed(r.goal_distance_m, 1));
    row('build', (r) => r.build.slice(0, 8));
  }
  fillSettings(host) {
    const {settings} = this.against;
    if (!settings.length) {
      host.append(make('p', 'soft', 'The settings are equal.'));
      return;
    }
    settingsTable(host, ['setting', 'this run', 'other run'], settings.map(([key, other, own, unit]) => [settingLabel(key, unit), own, other]));
  }
  fillPaths(host) {
    const {plan, path} = this.data, other = this.against.path;
    this.map = new MapView(host, plan, {n: path.n.concat(other.n), e: path.e.concat(other.e)}, {
      draw: (c) => {
        for (const [{n, e}, color, dash] of [[other, 'c1', [6, 4]], [path, 'c0', []]]) {
          c.strokeStyle = themeColor(color);
          c.lineWidth = 2.5;
          c.setLineDash(dash);
          c.beginPath();
          n.forEach((north, i) => c.lineTo(this.map.x(e[i]), this.map.y(north)));
          c.stroke();
          c.setLineDash([]);
          if (n.length) this.map.dot(c, this.map.x(e.at(-1)), this.map.y(n.at(-1)), 4, themeColor(color));
        }
      },
      key: (key) => {
        for (const [words, color] of [['this run', 'c0'], ['other run, dashed', 'c1']]) {
          const item = key.appendChild(make('span'));
          item.appendChild(make('i')).style.background = themeColor(color);
          item.append(words);
        }
      },
      leave: () => {}, click: () => {}, hover: (x, y) => this.map.showTip(x, y, this.map.placeLines(x, y))});
    this.map.draw();
  }
  /** Both films next to each other; they play and stop together. */
  fillFilms(host, film) {
    const {film: other} = this.against;
    if (!film || !other) return;
    const pair = host.appendChild(make('div', 'pair halves films'));
    const add = (words, src) => {
      const box = pair.appendChild(make('div')), video = make('video');
      video.muted = video.playsInline = true;
      video.src = src;
      video.setAttribute('aria-label', `camera images of ${words}`);
      box.append(make('h3', '', words), video);
      new FilmView(video);
      return video;
    };
    const own = add('this run', film.src);
    const bytes = other.bytes && Uint8Array.from(atob(other.bytes), (c) => c.charCodeAt(0));
    const second = add('other run', bytes ? URL.createObjectURL(new Blob([bytes], {type: 'video/webm'})) : other.link);
    for (const [from, to] of [[own, second], [second, own]]) {
      from.addEventListener('play', () => { to.play(); });
      from.addEventListener('pause', () => { if (!from.ended) to.pause(); });
      from.addEventListener('seeked', () => { if (Math.abs(to.currentTime - from.currentTime) > 0.1) to.currentTime = from.currentTime; });
    }
  }
  redraw() {
    this.map?.draw();
    this.charts?.build();
  }
}
