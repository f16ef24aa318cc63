'use strict';
// Changes since an earlier campaign: flights with equal names side by side.

const outcomeOf = (table, row) => table.value('outcome', row);

class AgainstView {
  constructor(host, {against}, table, on) {
    if (!against) {
      host.remove();
      return;
    }
    Object.assign(this, {table, on, before: against.flights});
    host.append(make('h2', '', `Compared with ${against.name}`));
    for (const line of against.mixture.split('\n').filter(Boolean)) host.append(make('p', 'bad-text', line));
    const both = [...this.before.keys()].filter((row) => this.before[row]);
    this.changed = both.filter((row) => this.before[row].outcome !== outcomeOf(table, row)
      || this.before[row].passed !== (table.value('passed', row) === 1));
    const fresh = table.count - both.length;
    host.append(make('p', 'soft', `${countOf(both.length, 'flight')} in both, ${this.changed.length} with a different outcome; ` +
      `${fresh} only in this campaign, ${against.gone.length} only in the other.`));
    if (against.no_change) host.append(make('p', 'soft', against.no_change));
    this.fillGroups(host.appendChild(make('div', 'scroll tall')), against);
    this.fillSettings(host, against.settings);
    this.fillChecks(host, both);
    const pair = host.appendChild(make('div', 'pair halves'));
    this.fillChanged(pair.appendChild(make('div')));
    this.both = both.filter((row) => this.clearance(row) !== null && this.before[row].clearance_m !== null);
    if (!this.both.length) return;
    const plot = pair.appendChild(make('div'));
    plot.append(make('h3', '', 'Minimum clearance to obstacles'));
    this.axes = new Axes(plot.appendChild(make('div')), 340, {
      draw: (c) => this.draw(c), hover: (x, y) => this.lines(x, y),
      pick: (x, y) => { const row = this.at(x, y); if (row !== null) on.choose(row); }});
    const all = this.both.flatMap((row) => [this.clearance(row), this.before[row].clearance_m]);
    this.axes.set(numberAxis('before, m', all), numberAxis('now, m', all));
    plot.append(make('div', 'plan-key', 'above the line: more clearance than before; ringed: different outcome'));
  }
  clearance(row) { return this.table.value('min_obstacle_clearance_m', row); }

  fillGroups(host, {groups, no_change}) {
    const element = host.appendChild(make('table'));
    addRow(element, [['scenario', ''], ['passed before', 'number'], ['passed now', 'number'],
      ['change of the success rate', 'number'], ['95 % interval', 'number']], 'th');
    const percent = (v) => fixed(100 * v, 1) + ' %';
    const rate = ({passed, ended, low, high}) => `${passed} of ${ended}` + (no_change && ended ? `, ${percent(low)} to ${percent(high)}` : '');
    for (const {group, now, before, change} of groups) {
      addRow(element, [[group, ''], [rate(before), 'number'], [rate(now), 'number'],
        [change ? percent(change[0]) : '–', 'number'], [change ? `${percent(change[1])} to ${percent(change[2])}` : '–', 'number']]);
    }
  }
  fillSettings(host, settings) {
    if (!settings?.length) return;
    host.append(make('h3', '', 'Changed settings'));
    const names = (groups) => groups.length > 3 ? countOf(groups.length, 'scenario') : groups.map(groupWords).join(', ');
    const all = new Set(Array.from({length: this.table.count}, (_, row) => this.table.value('group', row))).size;
    const apart = settings.some(([, , , , groups]) => groups.length < all);
    settingsTable(host.appendChild(make('div')), ['setting', 'before', 'now', ...(apart ? ['scenarios'] : [])],
      settings.map(([key, old, now, unit, groups]) => [settingLabel(key, unit), old, now, ...(apart ? [names(groups)] : [])]));
  }
  /** Checks whose values changed, also if the outcome did not, the largest relative change first. */
  fillChecks(host, both) {
    const most = 20, changes = [];
    for (const row of both) {
      for (const [name, old] of Object.entries(this.before[row].checks ?? {})) {
        const now = this.table.value(name, row), size = Math.max(Math.abs(old), Math.abs(now));
        if (old === null || now === null || short(old, 6) === short(now, 6)) continue;
        changes.push({row, name, old, now, share: Math.abs(now - old) / size});
      }
    }
    if (!changes.length) return;
    changes.sort((a, b) => b.share - a.share);
    host.append(make('h3', '', 'Changed values of checks'));
    const element = host.appendChild(make('div', 'scroll')).appendChild(make('table'));
    element.id = 'changed-checks';
    addRow(element, [['flight and check', ''], ['before', 'number'], ['now', 'number']], 'th');
    for (const {row, name, old, now} of changes.slice(0, most)) {
      const {unit} = this.table.columns.get(name), figures = figuresFor([old, now], 3);
      addRow(element, [['', ''], [measured(old, unit, figures), 'number'], [measured(now, unit, figures), 'number']]);
      element.lastChild.firstChild.append(flightButton(this.table, row, this.on), ' ' + wordsOf(name.replace('check.', ''), unit));
    }
    if (changes.length > most) host.append(make('p', 'soft', `and ${changes.length - most} more`));
  }
  fillChanged(host) {
    host.append(make('h3', '', 'Flights with a different outcome'));
    const box = host.appendChild(make('div', 'scroll tall'));
    if (!this.changed.length) {
      box.append(make('p', 'soft', 'None.'));
      return;
    }
    const element = box.appendChild(make('table'));
    element.id = 'changed';
    addRow(element, [['flight', ''], ['before', ''], ['now', ''], ['clearance before, m', 'number'], ['now, m', 'number'], ['re-run', '']], 'th');
    for (const row of this.changed) {
      const old = this.before[row], passes = this.table.value('passed', row) === 1;
      addRow(element, [['', ''], [old.outcome, old.passed ? 'pass' : 'fail'], [outcomeOf(this.table, row), passes ? 'pass' : 'fail'],
        [fixed(old.clearance_m, 2), 'number'], [fixed(this.clearance(row), 2), 'number'], ['', '']]);
      const cells = element.lastChild.children;
      cells[0].append(flightButton(this.table, row, this.on));
      cells[5].append(copyButton(this.table.value('command', row)));
    }
  }

  draw(c) {
    const {axes} = this;
    if (!this.both) return;
    c.strokeStyle = themeColor('soft');
    c.beginPath();
    c.moveTo(axes.x(axes.xAxis.low), axes.y(axes.xAxis.low));
    c.lineTo(axes.x(axes.xAxis.high), axes.y(axes.xAxis.high));
    c.stroke();
    const changed = new Set(this.changed);
    for (const row of this.both) {
      c.beginPath();
      c.arc(axes.x(this.before[row].clearance_m), axes.y(this.clearance(row)), changed.has(row) ? 4 : 3, 0, 2 * Math.PI);
      c.fillStyle = themeColor(verdictColors[this.table.verdict(row)]);
      c.fill();
      if (!changed.has(row)) continue;
      c.strokeStyle = themeColor('ink');
      c.lineWidth = 1.5;
      c.stroke();
    }
  }
  at(px, py) {
    let best = null, least = 10 ** 2;
    for (const row of this.both) {
      const d = (this.axes.x(this.before[row].clearance_m) - px) ** 2 + (this.axes.y(this.clearance(row)) - py) ** 2;
      if (d < least) [least, best] = [d, row];
    }
    return best;
  }
  lines(px, py) {
    const row = this.at(px, py);
    return row === null ? null : [...flightLines(this.table, row),
      `before: ${this.before[row].outcome}, clearance ${meters(this.before[row].clearance_m)}`];
  }
}
