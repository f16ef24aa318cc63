'use strict';
// Builds the page of a batch or sweep from its data.

const shownAtFirst = ['id', 'seed', 'outcome', 'passed', 'min_obstacle_clearance_m', 'flight_time_s', 'path_length_m',
  'mean_speed_mps', 'goal_distance_m'];
const worstOfAKind = 5;
const failureWords = {failed: 'no result', missing: 'not flown', no_collision: 'collision', reached_goal: 'goal not reached'};

/** A button with the name of a flight that selects it. */
function flightButton(table, row, on) {
  const button = breakable('button', 'name', table.value('id', row));
  button.title = table.value('id', row);
  button.addEventListener('click', () => on.choose(row));
  return button;
}

/** Returns the verdict on all flights: {words, more, look}. */
function campaignVerdict(data, table) {
  const all = data.groups[0], claims = data.claims.conduct?.sequential ?? [], verdicts = data.claims.conduct?.verdicts ?? [];
  const counts = table.failureCounts(table.rowsOf(null, data.controls)).map(([name, count]) => `${failureWords[name] ?? name.replaceAll('_', ' ')}: ${count}`).join(', ');
  const more = [counts, data.controls.length ? 'without the control' : ''].filter(Boolean).join('; ');
  if (claims.length) {
    const worst = ['refuted', 'undecided', 'shown'].find((verdict) => claims.some((claim) => claim.verdict === verdict));
    return {words: `${worst[0].toUpperCase()}${worst.slice(1)}`, more: [...new Set(claims.map(({rule}) => rule))].join('; '), look: {shown: 'good', refuted: 'bad'}[worst] ?? ''};
  }
  if (all.missing) {
    return {words: `${all.missing} of ${countOf(all.flights, 'flight')} ${all.missing === 1 ? 'is' : 'are'} missing: no verdict`, more: `by collision or first failed check: ${more}`, look: ''};
  }
  if (verdicts.length) {
    const failed = verdicts.filter(({passed}) => !passed).length, words = countOf(verdicts.length, 'check');
    return {words: failed ? `${failed} of ${words} over the seeds failed` : `${words} over the seeds: passed`,
      more: [`${all.passed} of ${countOf(all.flights, 'flight')} passed`, more].filter(Boolean).join('; '), look: failed ? 'bad' : 'good'};
  }
  if (all.no_checks === all.flights) return {words: 'No checks', more: 'no checks defined', look: ''};
  const failed = all.flights - all.passed - all.no_checks;
  return failed ? {words: `${failed} of ${all.flights} did not pass`, more: `by collision or first failed check: ${more}`, look: 'bad'} : {words: `All ${all.passed} passed`, more, look: 'good'};
}

function fillHead(host, data, table) {
  if (!data.search) {
    const {words, more, look} = campaignVerdict(data, table), badge = host.appendChild(make('div', 'badge ' + look));
    badge.append(make('span', 'mark', {good: '✓', bad: '✕'}[look] ?? '–'));
    badge.appendChild(make('div')).append(make('strong', '', words), make('span', '', more));
  }
  for (const line of data.mixture.split('\n').filter(Boolean)) host.append(make('p', 'bad-text', line));
  host.append(make('h1', '', data.name));
  if (data.description) host.append(make('p', '', data.description));
  const swept = data.swept.length ? `, over ${data.swept.join(', ')}` : '';
  const control = data.controls.reduce((sum, group) => sum + table.rowsOf(group).length, 0), ofControl = control ? `, ${control} of them of the control` : '';
  host.append(make('p', 'soft', `${data.search ? 'search' : data.is_sweep ? 'sweep' : 'batch'} of ${data.scenarios.join(', ')}${swept}; ${countOf(table.count, 'flight')}${ofControl}; Hedgehop ${data.version}, build ${data.builds.length === 1 ? data.builds[0] : data.build}`));
  if (data.truth_used) host.append(make('p', 'bad-text', data.truth_used));
  const tiles = host.appendChild(make('div', 'tiles')), all = data.groups[0];
  const tile = (name, value, more) => {
    const element = tiles.appendChild(make('div', 'tile'));
    element.append(make('div', 'name', name), make('div', 'value', value), make('div', 'more', more));
  };
  const percent = (share) => fixed(100 * share, 1) + ' %';
  if (data.leaderboard) return fillModuleTiles(tile, data.leaderboard);
  const completed = completedCount(table, null), timeout = all.timeout - completed;
  const pair = comparedPair(data), unchecked = all.no_checks ? `; no checks: ${all.no_checks}` : '';
  if (data.search) {
    const known = table.columns.get('robustness').values.filter((v) => v !== null);
    tile(data.search.suite ? 'safe flights' : 'searched checks hold', `${known.filter((v) => v >= 0).length} of ${known.length}`, 'flights of a search for failures; they give no success rate');
  }
  else if (pair) tile('all checks hold', `${pair[1].passed} of ${pair[1].ended}`, `candidate; base: ${pair[0].passed} of ${pair[0].ended}`);
  else tile('all checks hold', all.ended ? percent(all.passed / all.ended) : all.no_checks ? 'no checks' : '–',
    `${all.passed} of ${all.ended}; 95 % interval ${percent(all.low)} to ${percent(all.high)}${unchecked}`);
  tile('collided', String(all.collided), `of ${countOf(all.flights, 'flight')}`);
  const ends = [[all.reached, 'reached'], [completed, 'completed'], [timeout, 'timeout'], [all.collided, 'collided'], [all.broken, 'fault or no result'], [all.missing, 'missing']];
  const met = ends.filter(([count]) => count > 0);
  tile(completed ? 'reached or completed' : 'reached', String(all.reached + completed), `${met.map(([count, word]) => `${count} ${word}`).join(' + ')} = ${countOf(all.flights, 'flight')}`);
  tile('minimum clearance', meters(all.min_clearance_m), `to obstacles; median over flights ${meters(all.median_clearance_m)}`);
  tile('median flight time', fixed(all.median_time_s, 1) + ' s', 'of all flights flown');
}

/** Returns the number of timeouts that are the normal end. */
function completedCount(table, group) {
  return table.rowsOf(group).filter((row) => table.value('outcome', row) === 'completed').length;
}

/** The headline of a leaderboard: one tile per module, the control last and named. Modules have no common mean. */
function fillModuleTiles(tile, board) {
  const totals = board.modules.map((module) => ({...module, ...board.totals.find((total) => total.module === module.name)}));
  totals.sort((a, b) => a.control - b.control || (b.passed ?? 0) / (b.flights || 1) - (a.passed ?? 0) / (a.flights || 1));
  for (const total of totals) {
    const {name, control, passed, flights, worlds, low, high} = total;
    const title = name + (control ? ' (control)' : '');
    if (!flights) tile(title, '–', board.cells.every((cell) => cell.module !== name || cell.reason) ? 'not flown' : 'no flight with checks');
    else tile(title, `${passed} of ${flights}`, `${fixed(100 * passed / flights, 0)} % passed (${fixed(100 * low, 0)} to ${fixed(100 * high, 0)} %), ${collidedWords(total)}; ${countOf(worlds, 'world')}`);
  }
}

function fillGroups(host, data, table) {
  const share = (g) => g.ended ? g.passed / g.ended : 2;
  const [all, ...rest] = data.groups, pair = comparedPair(data), groups = pair ?? [all, ...rest.sort((a, b) => share(a) - share(b))];
  const completed = (g) => g !== all ? completedCount(table, g.group) : table.rowsOf(null, data.controls).filter((row) => table.value('outcome', row) === 'completed').length;
  if (data.controls.length) all.group = 'all flights without the control';
  const element = host.appendChild(make('table')), head = element.appendChild(make('thead'));
  addRow(head, [['scenario', ''], ['flights', 'number'], ['passed', 'number'], ['rate with 95 % interval', ''], ['', 'number'], ['reached', 'number'],
    ['completed', 'number'], ['collided', 'number'], ['timeout', 'number'], ['fault', 'number'], ['missing', 'number'], ['minimum clearance, m', 'number'],
    ['median of minimum clearance, m', 'number'], ['median time, s', 'number']], 'th');
  const body = element.appendChild(make('tbody'));
  for (const [i, g] of groups.entries()) {
    const done = completed(g), row = addRow(body, [['', ''], [String(g.flights), 'number'], [g.no_checks && !g.ended ? 'no checks' : String(g.passed), 'number'], ['', ''],
      [g.ended ? `${fixed(g.low, 2)} to ${fixed(g.high, 2)}` : '–', 'number'],
      ...[g.reached, done, g.collided, g.timeout - done, g.broken, g.missing].map((n) => [String(n), 'number']),
      [fixed(g.min_clearance_m, 2), 'number'], [fixed(g.median_clearance_m, 2), 'number'], [fixed(g.median_time_s, 1), 'number']]);
    row.firstChild.append(breakable('span', '', (pair ? `${i ? 'candidate' : 'base'}: ` : '') + groupWords(g.group)));
    const rate = row.children[3].appendChild(make('span', 'rate')), span = rate.appendChild(make('i'));
    span.style.left = 100 * g.low + '%';
    span.style.width = 100 * (g.high - g.low) + '%';
    if (g.ended) rate.appendChild(make('b')).style.left = 100 * g.passed / g.ended + '%';
  }
}

/** Returns the worst flights: {title, rows, words(row)} of each kind. */
function worstFlights(table, rows) {
  const flown = rows.filter((row) => table.value('status', row) === 'flown');
  const column = (name) => table.columns.get(name);
  const first = (some, name, falling) => !column(name) ? []
    : sortedRows(some.filter((row) => column(name).values[row] !== null), column(name), falling).slice(0, worstOfAKind);
  const clear = flown.filter((row) => table.verdict(row) !== 'collided');
  const failing = (outcome) => flown.filter((row) => table.value('outcome', row) === outcome && table.value('passed', row) === 0);
  return [
    {title: 'Collided, earliest first', rows: first(flown.filter((row) => table.verdict(row) === 'collided'), 'flight_time_s', false),
      words: (row) => quoted(table.value('cause', row) || `after ${fixed(table.value('flight_time_s', row), 1)} s`)},
    {title: 'Minimum clearance without a collision', rows: first(clear, 'min_obstacle_clearance_m', false),
      words: (row) => meters(table.value('min_obstacle_clearance_m', row))},
    {title: 'Timeout, largest distance to the goal first', rows: first(failing('timeout'), 'goal_distance_m', true), words: (row) => meters(table.value('goal_distance_m', row))},
    {title: 'Completed, but a check failed', rows: failing('completed').slice(0, worstOfAKind), words: (row) => table.why[row]},
    {title: 'Goal reached, but a check failed', rows: failing('reached').slice(0, worstOfAKind), words: (row) => table.why[row]},
    {title: 'Passed, slowest first', rows: first(clear.filter((row) => table.verdict(row) === 'passed'), 'flight_time_s', true), words: (row) => fixed(table.value('flight_time_s', row), 1) + ' s'},
    {title: 'Fault, or no result', rows: rows.filter((row) => table.value('status', row) === 'failed' || ['fault', 'link_lost'].includes(table.value('outcome', row))).slice(0, worstOfAKind),
      words: (row) => table.why[row]},
  ];
}
function fillWorst(host, data, table, rows, on) {
  host.replaceChildren();
  for (const kind of worstFlights(table, rows)) {
    if (!kind.rows.length) continue;
    host.append(make('h3', '', kind.title));
    for (const row of kind.rows) {
      const line = host.appendChild(make('div', 'flight-line'));
      const words = kind.words(row), long = words.length > 24;
      line.classList.toggle('long', long);  // a sentence has a row of its own
      line.append(flightButton(table, row, on), make('span', 'soft', words), linkTo(data, table, row), copyButton(table.value('command', row)));
    }
  }
}
function linkTo(data, table, row) {
  if (!data.report[row]) return make('span');
  const link = make('a', '', 'report');
  link.href = flightLink(data, table, row, 'report.html');
  return link;
}

function fillChosen(host, data, table, row) {
  host.replaceChildren();
  if (row === null) {
    host.append(make('p', 'soft', 'Select a flight on the map, in a plot or in a table.'));
    return;
  }
  const id = table.value('id', row), verdict = table.verdict(row);
  host.append(make('h3', '', id), make('p', verdict === 'passed' ? 'pass' : verdict === 'unchecked' ? 'soft' : 'bad-text', table.why[row] || 'passed'));
  const facts = data.swept.map((name) => `${name} = ${typeof table.value(name, row) === 'number' ? short(table.value(name, row)) : table.value(name, row)}`);
  host.append(make('p', 'soft', [...facts, `clearance ${meters(table.value('min_obstacle_clearance_m', row))}`,
    `${fixed(table.value('flight_time_s', row), 1)} s`].join(', ')));
  const links = host.appendChild(make('p'));
  for (const [there, name, word] of [[data.report[row], 'report.html', 'report'], [data.replay[row], 'replay.html', 'replay']]) {
    if (!there) continue;
    const link = links.appendChild(make('a', '', word));
    link.href = flightLink(data, table, row, name);
    links.append(' ');
  }
  host.append(make('p', 'soft', 'Re-simulate this flight with video and report:'));
  addCommand(host, table.value('command', row));
  if (!data.report[row]) {
    host.append(make('p', 'soft', 'Write the replay of the recorded flight:'));
    addCommand(host, `hedgehop report --replay ${shellQuoted(`${data.folder}/${id}`)}`);
  }
}

function fillColumns(host, table, flights) {
  for (const {name} of table.columns.values()) {
    const label = host.appendChild(make('label')), box = label.appendChild(make('input'));
    box.type = 'checkbox';
    box.checked = flights.shown.includes(name);
    box.addEventListener('change', () => flights.showColumn(name, box.checked));
    label.append(' ' + name);
  }
}

function main() {
  const data = JSON.parse(document.getElementById('data').textContent), table = new FlightTable(data);
  const host = (id) => document.getElementById(id);
  fillHead(host('head'), data, table);
  fillGroups(host('groups'), data, table);
  if (data.search) {
    host('groups-card').remove();
    host('claims-card').remove();
  } else {
    fillClaims(host('claims-card'), data);
    if (data.is_sweep) host('groups-card').querySelector('h2').textContent = 'Success by point';
  }

  const on = {
    choose: (row) => {
      fillChosen(host('selected'), data, table, row);
      paths.setChosen(row);
      flights.setChosen(row);
    },
    filter: (text) => {
      filter.value = text;
      update();
      host('flights-card').scrollIntoView();
    },
  };
  fillBoard(host('board-card'), data.leaderboard, on);
  const collisions = fillCollisions(host('collisions-card'), data.leaderboard);
  fillStrips(host('strips-card'), data, table, on);
  const flights = new FlightsView(host('flights'), data, table, [...shownAtFirst.slice(0, 2), ...data.swept, ...shownAtFirst.slice(2)], on);
  const paths = new PathsView(host('paths'), host('scene'), data.paths, table, on, data.leaderboard);
  const flightPlots = data.sweep ? [] : [new SuccessMap(host('success'), data, table, on), new Scatter(host('scatter'), data, table, on)];
  if (data.sweep) host('success-card').parentElement.remove();
  else host('pareto-card').parentElement.remove();
  const sweep = data.sweep ? new SweepSections(host, data, table, on) : null;
  const against = new AgainstView(host('against-card'), data, table, on);
  const search = new SearchView(host('search-card'), data, table, on);
  fillColumns(host('columns').querySelector('div'), table, flights);
  fillChosen(host('selected'), data, table, null);

  const filter = host('filter'), example = [...data.swept.slice(0, 1).map((name) => name + '>0'), 'outcome=collided', 'seed=3'];
  filter.placeholder = 'words, or comparisons: ' + example.join(' ');
  const update = () => {
    const {terms, fault} = parseFilter(table, filter.value), rows = filteredRows(table, terms);
    host('filter-note').textContent = fault || `${rows.length} of ${countOf(table.count, 'flight')}, in the table and in all plots`;
    host('filter-note').className = fault ? 'bad-text' : 'soft';
    for (const view of [flights, paths, ...flightPlots]) view.setRows(rows);
    fillWorst(host('worst'), data, table, rows, on);
  };
  filter.addEventListener('input', update);
  update();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    paths.map?.draw();
    for (const view of [...flightPlots, against, search, ...collisions]) view.axes?.draw();
    for (const view of flightPlots) view.drawKey?.();
    sweep?.redraw();
  });
}
main();
