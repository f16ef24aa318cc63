'use strict';
// Builds the page of the results compared with the papers from its data.

/** Paths of several groups of flights over the scene of the first. */
class PathChart {
  constructor(host, paths) {
    const lines = paths.labels.map((label) => ({label, printed: false}));
    const first = paths.map.findIndex((map) => map >= 0);
    this.data = paths;
    this.colors = labelColors(lines);
    this.paths = paths.path.map(readPath);
    const reach = {n: [], e: []};
    for (const {n, e} of this.paths) { reach.n.push(...finiteRange(n)); reach.e.push(...finiteRange(e)); }
    const plan = first < 0 ? {bounds: [], footprints: [], movers: []} : paths.maps[paths.map[first]];
    const goal = paths.goal.find((place) => place);
    this.view = new MapView(host, {...plan, goal: goal ? {n: goal[0], e: goal[1], radius: goal[2]} : null}, reach, {
      draw: (c) => this.draw(c), key: (key) => this.fillKey(key), leave: () => {}, click: () => {},
      hover: (x, y) => this.view.showTip(x, y, this.view.placeLines(x, y))});
    this.view.showReach();
  }
  draw(c) {
    if (!this.view) return;
    this.paths.forEach(({n, e}, i) => {
      const color = themeColor(this.colors.get(this.data.labels[this.data.series[i]]));
      c.strokeStyle = color;
      c.lineWidth = 1.5;
      c.globalAlpha = this.paths.length > 60 ? 0.5 : 0.9;
      c.beginPath();
      for (let k = 0; k < n.length; ++k) c.lineTo(this.view.x(e[k]), this.view.y(n[k]));
      c.stroke();
      c.globalAlpha = 1;
      if (this.data.outcome[i] === 'collided') this.view.cross(c, this.view.x(e.at(-1)), this.view.y(n.at(-1)), 5, themeColor('bad'));
    });
  }
  fillKey(key) {
    for (const [label, color] of this.colors) {
      const count = this.data.series.filter((s) => this.data.labels[s] === label).length;
      const item = key.appendChild(make('span'));
      item.appendChild(make('i')).style.cssText = `background: ${themeColor(color)}; height: 3px; vertical-align: 3px`;
      item.append(`${label}: ${count}`);
    }
    if (this.data.outcome.includes('collided')) key.append(make('span', '', 'a cross: collided'));
  }
}

function addRows(host, rows) {
  const table = host.appendChild(make('div', 'scroll')).appendChild(make('table'));
  const line = (cells, tag) => addRow(table, cells.map(([text, look]) => [text === '-' ? '–' : text, look]), tag);
  line(['claim', 'paper', 'required', 'published', 'modified: ideal', 'modified: day', 'modified: dull', 'flights: required, flown, faulted, with figure',
    '95 % interval', 'holds', 'build'].map((text) => [text, '']), 'th');
  for (const r of rows) {
    const row = line([[r.claim + (r.unit ? `, ${r.unit}` : ''), ''], [r.paper || '–', ''],
      [r.required, ''], r.published_holds === false ? [r.published + ' ✕', 'fail'] : [r.published, ''],
      ...[r.ideal, r.day, r.dull, r.flights, r.interval].map((text) => [text, '']),
      r.holds === null ? ['–', ''] : r.holds ? ['holds', 'pass'] : ['does not hold', 'fail'], [r.build.join(', '), '']], 'td');
    row.lastChild.append(' ', copyButton(r.command));
  }
}

/** Returns the function that draws the chart; null for a chart without flights. */
function addChart(host, chart) {
  const card = host.appendChild(make('section', 'chart card'));
  card.append(make('h3', '', chart.title), make('div', 'note', chart.note));
  const drawn = card.appendChild(make('div'));
  const empty = chart.paths ? !chart.paths.path.length : !chart.lines.some(({x}) => x.length);
  if (empty) drawn.append(make('p', 'missing', 'No curve: the flights of this chart are not flown, or the files of their paths are not there.'));
  else if (chart.paths) return new PathChart(drawn, chart.paths).view;
  else return new LineChart(drawn, chart).axes;
  return null;
}

function main() {
  const {version, build, builds, packages, quick, papers} = JSON.parse(document.getElementById('data').textContent);
  const head = document.getElementById('head');
  const rows = papers.flatMap((paper) => paper.rows), judged = rows.filter(({holds}) => holds !== null);
  if (builds.length > 1) head.append(make('p', 'fail', `Rows of ${builds.length} builds: ${builds.join(', ')}`));
  head.append(make('h1', '', 'Papers reproduced'));
  head.append(make('p', 'soft', `Hedgehop ${version}, build ${build}, ${packages}: `
    + `${judged.filter(({holds}) => holds).length} of ${judged.length} figures that are required hold.`
    + (quick ? ' Quick run: few seeds were flown.' : '')));
  head.append(make('p', 'soft', 'Hedgehop\'s developers set the requirements; no paper states them. '
    + '"Published" has a ✕ if the paper\'s own law does not meet the requirement.'));
  const drawings = [];
  for (const paper of papers) {
    const section = document.getElementById('papers').appendChild(make('section', 'paper'));
    const title = section.appendChild(make('div', 'charts-head'));
    title.append(make('h2', '', paper.title), make('span', 'soft', paper.source));
    if (paper.moved_on) section.append(make('p', 'soft', `Change of judging seeds: ${paper.moved_on}`));
    if (paper.rows.length) addRows(section.appendChild(make('div', 'card')), paper.rows);
    for (const deviation of paper.deviations) section.append(make('p', 'soft', `Deviation of the published law from the paper: ${deviation}`));
    const charts = section.appendChild(make('div', 'charts'));
    charts.style.marginTop = '16px';
    for (const chart of paper.charts) drawings.push(addChart(charts, chart));
  }
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { for (const drawing of drawings) drawing?.draw(); });
}
main();
