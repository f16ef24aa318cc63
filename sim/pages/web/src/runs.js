'use strict';
// The index of all results in a folder tree: tables that a click on a heading sorts.

const linkTo = (folder, name) => (folder === '.' ? '' : folder.split('/').map(encodeURIComponent).join('/') + '/') + name;

/** A table of objects, sorted by a click on a heading. */
class SortedTable {
  /** @param columns  {key, label, number, order(row), words(row), look(row)}; the first one links the report. */
  constructor(host, columns, rows, key, falling) {
    Object.assign(this, {host, columns, rows, key, falling, most: 200});
    this.draw();
  }
  setRows(rows) {
    this.rows = rows;
    this.draw();
  }
  draw() {
    const {order} = this.columns.find(({key}) => key === this.key), value = (row) => order ? order(row) : row[this.key] ?? '';
    const sorted = [...this.rows].sort((a, b) => {
      const u = value(a), v = value(b);
      if (u === '' || v === '') return (u === '') - (v === '');
      return (u < v ? -1 : u > v ? 1 : 0) * (this.falling ? -1 : 1);
    });
    const element = make('table'), head = element.appendChild(make('thead')).appendChild(make('tr'));
    for (const {key, label, number} of this.columns) {
      const th = head.appendChild(make('th', 'sorts' + (number ? ' number' : ''), label));
      th.dataset.column = key;
      if (key === this.key) {
        th.append(make('b', '', this.falling ? ' ▼' : ' ▲'));
        th.ariaSort = this.falling ? 'descending' : 'ascending';
      }
      onChoose(th, () => {
        this.falling = this.key === key && !this.falling;
        this.key = key;
        this.draw();
      });
    }
    const body = element.appendChild(make('tbody'));
    for (const row of sorted.slice(0, this.most)) {
      const line = body.appendChild(make('tr'));
      this.columns.forEach(({key, number, words, look}, i) => {
        const text = words ? words(row) : row[key] === null || row[key] === '' ? '–' : String(row[key]);
        const cell = line.appendChild(make('td', (number ? 'number' : '') + (look ? ' ' + look(row) : '')));
        if (i || !row.report) return cell.append(breakable('span', '', text));
        const link = cell.appendChild(breakable('a', '', text));
        link.href = linkTo(row.folder, 'report.html');
      });
    }
    replaceTable(this.host, element);
    if (sorted.length <= this.most) return;
    const more = this.host.appendChild(make('button', 'more', `show ${Math.min(1000, sorted.length - this.most)} more of ${sorted.length}`));
    more.addEventListener('click', () => { this.most += 1000; this.draw(); });
  }
}

function main() {
  const data = JSON.parse(document.getElementById('data').textContent), host = (id) => document.getElementById(id);
  host('head').append(make('h1', '', 'Runs'), make('p', 'soft', `${data.runs.length} runs and ${data.campaigns.length} batches and sweeps in ${data.folder}`));
  for (const line of data.unread) host('head').append(make('p', 'bad-text', `not read: ${line}`));
  const verdictLook = ({verdict}) => ({passed: 'pass', failed: 'fail'}[verdict] ?? 'soft');
  if (data.campaigns.length) {
    host('campaigns-card').hidden = false;
    new SortedTable(host('campaigns'), [{key: 'folder', label: 'folder'}, {key: 'kind', label: 'kind'}, {key: 'flights', label: 'flights', number: true},
      {key: 'passed', label: 'passed', number: true}, {key: 'build', label: 'build'}, {key: 'date', label: 'date, UTC'}], data.campaigns, 'date', true);
  }
  const columns = [{key: 'name', label: 'name'}, {key: 'folder', label: 'folder', look: () => 'folder'}, {key: 'module', label: 'module'}, {key: 'seed', label: 'seed', number: true, order: (r) => BigInt(r.seed)},
    {key: 'outcome', label: 'outcome'}, {key: 'verdict', label: 'checks', look: verdictLook},
    {key: 'flight_time_s', label: 'time, s', number: true, words: (r) => fixed(r.flight_time_s, 1)},
    {key: 'min_obstacle_clearance_m', label: 'clearance, m', number: true, words: (r) => fixed(r.min_obstacle_clearance_m, 2)},
    {key: 'date', label: 'date, UTC'}, {key: 'build', label: 'build', words: (r) => r.build.slice(0, 8)},
    {key: 'tags', label: 'tags', words: (r) => r.tags.join(', ') || '–'}, {key: 'notes', label: 'notes', look: () => 'notes'}];
  const table = new SortedTable(host('runs'), columns, [], 'date', true);
  const inside = host('inside').querySelector('input'), loose = data.runs.filter(({campaign}) => !campaign);
  host('inside').hidden = loose.length === data.runs.length;
  inside.checked = !loose.length;
  const texts = new Map(data.runs.map((run) => [run, Object.values(run).join(' ').toLowerCase()]));
  const update = () => {
    const words = host('filter').value.toLowerCase().split(/\s+/).filter(Boolean);
    const rows = (inside.checked ? data.runs : loose).filter((run) => words.every((word) => texts.get(run).includes(word)));
    host('filter-note').textContent = `${rows.length} of ${data.runs.length} runs`;
    table.setRows(rows);
  };
  host('filter').addEventListener('input', update);
  inside.addEventListener('change', update);
  update();
}
main();
