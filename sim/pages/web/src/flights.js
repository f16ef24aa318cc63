'use strict';
// The table of all flights: sorted by a click on a column's head, thinned out by the filter.

const rowsAtFirst = 100;

/** Returns the link to a page of a flight. */
function flightLink(data, table, row, name) {
  return table.value('id', row).split('/').map(encodeURIComponent).join('/') + '/' + name;
}

class FlightsView {
  /**
   * @param host  element to fill. @param shown  names of the columns to show at first.
   * @param on  {choose(row)}.
   */
  constructor(host, data, table, shown, on) {
    Object.assign(this, {host, data, table, on, shown: shown.filter((name) => table.columns.has(name))});
    Object.assign(this, {rows: [], sort: null, falling: false, most: rowsAtFirst, chosen: null});
  }

  setRows(rows) {
    this.rows = rows;
    this.most = rowsAtFirst;
    this.draw();
  }
  setChosen(row) {
    this.chosen = row;
    for (const line of this.host.querySelectorAll('tbody tr')) line.classList.toggle('chosen', Number(line.dataset.row) === row);
  }
  sortBy(name) {
    this.falling = this.sort === name && !this.falling;
    this.sort = name;
    this.draw();
  }
  showColumn(name, is_shown) {
    const names = [...this.table.columns.keys()];
    this.shown = names.filter((n) => n === name ? is_shown : this.shown.includes(n));
    this.draw();
  }

  draw() {
    const columns = this.shown.map((name) => this.table.columns.get(name));
    const sorted = this.sort ? sortedRows(this.rows, this.table.columns.get(this.sort), this.falling) : this.rows;
    const element = make('table'), head = element.appendChild(make('thead')).appendChild(make('tr'));
    for (const column of columns) {
      const th = head.appendChild(make('th', 'sorts ' + (column.is_text || column.name === 'passed' ? '' : 'number'), columnLabel(column)));
      th.dataset.column = column.name;
      if (this.sort === column.name) {
        th.append(make('b', '', this.falling ? ' ▼' : ' ▲'));
        th.ariaSort = this.falling ? 'descending' : 'ascending';
      }
      onChoose(th, () => this.sortBy(column.name));
    }
    head.append(make('th', '', 're-run'));
    const body = element.appendChild(make('tbody'));
    for (const row of sorted.slice(0, this.most)) body.append(this.line(row, columns));
    replaceTable(this.host, element);
    if (sorted.length > this.most) {
      const more = this.host.appendChild(make('button', 'more', `show ${Math.min(400, sorted.length - this.most)} more of ${sorted.length}`));
      more.addEventListener('click', () => { this.most += 400; this.draw(); });
    }
  }

  line(row, columns) {
    const line = make('tr', row === this.chosen ? 'chosen' : '');
    line.dataset.row = row;
    for (const column of columns) line.append(this.cell(row, column));
    line.appendChild(make('td')).append(copyButton(this.table.value('command', row)));
    onChoose(line, () => this.on.choose(row));
    return line;
  }
  cell(row, column) {
    const value = column.values[row];
    if (column.name === 'passed' && value === null) return make('td', 'soft', this.table.why[row] === 'no checks' ? 'no checks' : '–');
    if (column.name === 'passed') return make('td', value ? 'pass' : 'fail', value ? '✓' : '✕');
    if (column.exact) return make('td', 'number', String(column.exact[row] ?? '–'));
    if (!column.is_text) {
      const small = value && Math.abs(value) < 0.01 && ['s', 'ms'].includes(column.unit);
      return make('td', 'number', small ? measured(value, column.unit) : Number.isInteger(value) ? String(value).replace('-', '−') : short(value));
    }
    const linked = column.name === 'id' && this.data.report[row], cell = linked ? make('td') : breakable('td', '', value);
    cell.title = value;
    if (linked) {
      const link = cell.appendChild(breakable('a', '', value));
      link.href = flightLink(this.data, this.table, row, 'report.html');
    }
    return cell;
  }
}
