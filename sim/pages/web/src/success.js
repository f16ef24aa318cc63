'use strict';
// Success rate by two columns: one cell for each pair of values, or of ranges if there are many values.

const mostCategories = 16, numberBins = 8;

/** Returns groups of the values of a column: {axis, words, of(row) -> index or -1}. */
function columnBins(column, rows) {
  const exact = column.exact ?? column.values, values = [...new Set(rows.map((row) => exact[row]))].filter((v) => v !== null && v !== '');
  if (column.is_text || values.length <= mostCategories) {
    values.sort((a, b) => a < b ? -1 : a > b ? 1 : 0);
    const index = new Map(values.map((v, i) => [v, i]));
    const is_word = column.is_text || column.exact, figures = is_word || figuresFor(values), words = values.map((v) => column.name === 'group' ? groupWords(v) : is_word ? String(v) : short(v, figures));
    return {axis: wordAxis(columnLabel(column), words), words, of: (row) => index.get(exact[row]) ?? -1};
  }
  const [low, high] = finiteRange(values.map(Number)), step = (high - low) / numberBins;
  const ends = Array.from({length: numberBins + 1}, (_, i) => low + i * step), words = rangeWords(ends);
  const of = (row) => {
    const v = column.values[row];
    return v === null ? -1 : Math.min(numberBins - 1, Math.floor((v - low) / step));
  };
  const axis = wordAxis(columnLabel(column), words);
  axis.words = null;  // its ticks are the ends of the ranges
  axis.ticks = ends.map((value, i) => ({value: i - 0.5, text: short(value, figuresFor(ends, 3))}));
  return {axis, words, of};
}

/** Returns "0.1 to 0.2" for each range between neighboring ends. */
function rangeWords(ends) {
  const texts = ends.map((value) => short(value, figuresFor(ends, 3)));
  return texts.slice(1).map((end, i) => `${texts[i]} to ${end}`);
}

/** Counts of flights in cells "x,y": {passed, ended, rows}. Flights that were not flown do not count. */
function successCells(table, rows, xBins, yBins) {
  const cells = new Map();
  for (const row of rows) {
    const x = xBins.of(row), y = yBins.of(row), verdict = table.verdict(row);
    if (x < 0 || y < 0 || verdict === 'missing' || verdict === 'unchecked') continue;
    const key = x + ',' + y;
    if (!cells.has(key)) cells.set(key, {x, y, passed: 0, ended: 0, rows: []});
    const cell = cells.get(key);
    ++cell.ended;
    cell.passed += verdict === 'passed' ? 1 : 0;
    cell.rows.push(row);
  }
  return cells;
}

/** Adds a labeled list for selecting a column. */
function columnSelect(host, label, columns, chosen, on) {
  const element = host.appendChild(make('label', '', label)).appendChild(make('select'));
  for (const {name} of columns) element.append(make('option', '', name));
  element.value = chosen;
  element.addEventListener('change', on);
  return element;
}

class SuccessMap {
  constructor(host, data, table, on) {
    Object.assign(this, {table, on, rows: []});
    const columns = [...table.columns.values()].filter(({name, is_text}) =>
      !is_text || ['group', 'scenario'].includes(name) || data.swept.includes(name));
    const several = (name) => table.columns.has(name) && new Set(table.columns.get(name).values).size > 1;
    const [x = 'seed', y = 'group'] = data.swept.filter(several).slice(0, 2);
    const controls = host.appendChild(make('div', 'controls'));
    this.x = columnSelect(controls, 'across', columns, x, () => this.update());
    this.y = columnSelect(controls, 'up', columns, y, () => this.update());
    this.axes = new Axes(host.appendChild(make('div')), 380, {
      draw: (c) => this.draw(c), hover: (px, py) => this.lines(px, py), pick: (px, py) => this.pick(px, py)});
    const key = host.appendChild(make('div', 'plan-key')), ramp = key.appendChild(make('span', 'ramp'));
    ramp.append('0');
    ramp.appendChild(make('i')).style.background = 'linear-gradient(90deg, var(--ramp))';
    ramp.append('1: share of passed flights');
  }
  setRows(rows) {
    this.rows = rows;
    this.update();
  }
  update() {
    this.xBins = columnBins(this.table.columns.get(this.x.value), this.rows);
    this.yBins = columnBins(this.table.columns.get(this.y.value), this.rows);
    this.cells = successCells(this.table, this.rows, this.xBins, this.yBins);
    this.axes.set(this.xBins.axis, this.yBins.axis);
  }
  draw(c) {
    if (!this.cells) return;
    const {axes} = this, ramp = makeRamp(themeColor('ramp'));
    const width = axes.x(1) - axes.x(0), height = axes.y(0) - axes.y(1);
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    for (const {x, y, passed, ended} of this.cells.values()) {
      const color = c.fillStyle = ramp(passed / ended);
      c.fillRect(axes.x(x - 0.5) + 1, axes.y(y + 0.5) + 1, width - 2, height - 2);
      const text = `${passed}/${ended}`;
      if (c.measureText(text).width + 6 > width || height < 14) continue;
      c.fillStyle = inkOn(color);
      c.fillText(text, axes.x(x), axes.y(y));
    }
  }
  lines(px, py) {
    const cell = this.cells.get(this.axes.cellKey(px, py));
    if (!cell) return null;
    const collided = cell.rows.filter((row) => this.table.verdict(row) === 'collided').length;
    return [`${cell.passed} of ${cell.ended} passed`, `${collided} collided`,
      `${this.x.value}: ${this.xBins.words[cell.x]}`, `${this.y.value}: ${this.yBins.words[cell.y]}`];
  }
  pick(px, py) {
    const cell = this.cells.get(this.axes.cellKey(px, py));
    if (cell) this.on.choose(cell.rows.find((row) => this.table.verdict(row) !== 'passed') ?? cell.rows[0]);
  }
}
