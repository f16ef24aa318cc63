'use strict';
// A search for failures: robustness over its flights, and each stored failure on its scene.

class SearchView {
  constructor(host, {search}, table, on) {
    if (!search) {
      host.remove();
      return;
    }
    Object.assign(this, {table, on, robustness: table.columns.get('robustness').values});
    const kept = search.counterexamples, confirmed = kept.filter((c) => c.repeats && c.confirmed).length;
    host.append(make('h2', '', 'Search for failures'));
    host.append(make('p', 'soft', `${search.method}, seed ${search.seed}: ${search.flights} of ${countOf(search.budget, 'flight')}, ${countOf(search.unknowns, 'unknown')}, ` +
      `${countOf(search.infeasible_points, 'point')} not flown because of a violated constraint. ` +
      (search.failures ? `${countOf(search.failing_flights, 'point')} ${search.failing_flights === 1 ? 'fails' : 'fail'}, the first after ${countOf(search.flights_to_first, 'flight')}; ${countOf(search.failures, 'distinct failure')}` +
        (search.suite ? '.' : `, ${confirmed} of ${kept.length} confirmed.`) : 'No failure was found. This does not prove safety.')));
    this.axes = new Axes(host.appendChild(make('div')), 240, {
      draw: (c) => this.draw(c), hover: (x, y) => this.lines(x, y),
      pick: (x, y) => { const row = this.at(x, y); if (row !== null) on.choose(row); }});
    this.axes.set({...numberAxis('flight', [1, this.robustness.length]), whole: true}, numberAxis(search.suite ? 'distance beyond 1.5 m, or negative score' : 'minimum robustness', [...this.robustness, 0]));
    const searched = search.checks ? (search.checks.length ? search.checks.join(', ') : 'all checks') : 'the searched checks';  // old files do not name them
    host.append(make('div', 'plan-key', search.suite ? 'line: minimum so far; below 0 a flight is unsafe' : `minimum over ${searched}; line: minimum so far; below 0 a check fails`));
    if (search.suite) this.fillSuite(host, search.suite);
    const list = host.appendChild(make('div', 'pair halves'));
    kept.forEach((one, i) => this.fillFailure(list.appendChild(make('div')), one, search.paths, i));
  }

  draw(c) {
    const {axes, robustness} = this;
    c.strokeStyle = themeColor('ink');
    c.setLineDash([4, 3]);
    c.beginPath();
    c.moveTo(axes.x(0), axes.y(0));
    c.lineTo(axes.x(robustness.length + 1), axes.y(0));
    c.stroke();
    c.setLineDash([]);
    c.beginPath();
    let least = Infinity;
    robustness.forEach((value, row) => {
      if (value !== null) least = Math.min(least, value);
      if (isFinite(least)) c.lineTo(axes.x(row + 1), axes.y(least));
    });
    c.stroke();
    robustness.forEach((value, row) => {
      if (value === null) return;
      c.fillStyle = themeColor(value < 0 ? 'bad' : 'c0');
      c.beginPath();
      c.arc(axes.x(row + 1), axes.y(value), 3, 0, 2 * Math.PI);
      c.fill();
    });
  }
  at(x, y) {
    const row = Math.round(this.axes.xAxis.low + (x - this.axes.frame.x) / this.axes.frame.width * (this.axes.xAxis.high - this.axes.xAxis.low)) - 1;
    const value = this.robustness[row];
    return value === undefined || value === null || Math.abs(this.axes.y(value) - y) > 20 ? null : row;
  }
  lines(x, y) {
    const row = this.at(x, y);
    return row === null ? null : [this.table.value('id', row), `${this.table.value('weakest', row)}: robustness ${short(this.robustness[row])}`];
  }

  /** Adds the tests of the competition and their scores. */
  fillSuite(host, suite) {
    host.append(make('h3', '', 'Score of the UAV testing competition, 2025'));
    const words = (scores) => `failure score ${fixed(scores.failure_score, 2)}, diversity score ${scores.diversity_score === null ? '–' : fixed(scores.diversity_score, 2)}`;
    host.append(make('p', '', `${suite.confirmed} of ${suite.candidates} tests are confirmed, unsafe in each of ${suite.runs_of_test} runs: ${words(suite.of_confirmed)}. ` +
      `With the other tests: ${words(suite.of_all)}. ` +
      'The tested system is not the competition\'s, so no ranking follows.'));
    const body = host.appendChild(make('div', 'scroll')).appendChild(make('table'));
    const add = (tag, cells) => {
      const row = body.appendChild(make('tr'));
      cells.forEach((cell) => row.appendChild(make(tag, '', cell)));
      return row;
    };
    add('th', ['test', 'boxes', 'minimum distance of each run, m', 'mean time, s', 'mean points', 'score', 'confirmed', 'scenario']);
    for (const test of suite.tests) {
      const flown = test.runs.filter((run) => run.time_s !== undefined);
      const row = add('td', [test.name, String(test.boxes.length), test.runs.map((run) => run.min_distance_m === undefined ? run.outcome : fixed(run.min_distance_m, 2)).join(', '),
        flown.length ? fixed(flown.reduce((sum, run) => sum + run.time_s, 0) / flown.length, 1) : '–', fixed(test.mean_points, 1), fixed(test.score, 2), test.confirmed ? 'yes' : 'no', '']);
      if (!test.file) continue;
      const link = row.lastChild.appendChild(make('a', '', 'scenario'));
      link.href = test.file;
    }
  }

  /** Adds a minimized failure: its path over the scene, and links to its files. */
  fillFailure(host, one, paths, i) {
    host.append(make('h3', '', one.name));
    host.append(make('p', '', `${one.check}: robustness ${short(one.shrunk_robustness)}, before minimization ${short(one.robustness)}; ` +
      (one.items_before ? `${one.items} of ${one.items_before} boxes, moving obstacles and failures remain; ` : '') +
      `${short(one.duration_s)} s; ${countOf(one.shrinking_flights, 'flight')} for the minimization`));
    const repeat = one.repeats ? one.confirmed : one.repeats;  // null: not flown
    host.append(make('p', repeat ? 'pass' : 'fail', repeat ? 'confirmed: a repeated flight is equal'
      : `NOT CONFIRMED: a repeated flight ${repeat === null ? 'was not flown' : 'differs'}`));
    const links = host.appendChild(make('p'));
    for (const [file, words] of [[one.file, 'scenario'], [`${one.folder}/report.html`, 'report and film']]) {
      const link = links.appendChild(make('a', '', words));
      link.href = file;
      links.append(' ');
    }
    const {n, e} = readPath(paths.path[i]), goal = paths.goal[i];
    const plan = paths.maps[paths.map[i]] ?? {bounds: [], footprints: [], movers: []};
    let map = null;
    map = new MapView(host.appendChild(make('div')), {...plan, goal: goal ? {n: goal[0], e: goal[1], radius: goal[2]} : null}, {n, e}, {
      draw: (c) => {
        if (!map) return;
        c.strokeStyle = themeColor('bad');
        c.lineWidth = 2;
        c.beginPath();
        n.forEach((north, k) => c.lineTo(map.x(e[k]), map.y(north)));
        c.stroke();
        if (one.outcome === 'collided') map.cross(c, map.x(e.at(-1)), map.y(n.at(-1)), 5, themeColor('bad'));
      },
      key: () => {}, leave: () => {}, click: () => {}, hover: (x, y) => map.showTip(x, y, map.placeLines(x, y))});
  }
}
