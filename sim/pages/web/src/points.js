'use strict';
// The points of a sweep: means of a column over the seeds, their intervals, and the ranking.

const pointsInBin = 4;  // at least, on average

/** The points of a sweep in the order of their first flight. */
class SweepPoints {
  constructor(data, table) {
    Object.assign(this, {table, sweep: data.sweep, paths: data.swept, points: []});
    const byNumber = new Map();
    for (let row = 0; row < table.count; ++row) {
      const number = String(table.value('point', row));
      if (!byNumber.has(number)) {
        const point = {number, rows: [], values: data.swept.map((path) => table.value(path, row))};
        byNumber.set(number, point);
        this.points.push(point);
      }
      byNumber.get(number).rows.push(row);
    }
    for (const point of this.points) {
      const count = (verdict) => point.rows.filter((row) => table.verdict(row) === verdict).length;
      Object.assign(point, {passed: count('passed'), unchecked: count('unchecked'), missing: count('missing')});
    }
    const names = [...table.columns.keys()], first = names.indexOf('status');
    this.columns = names.slice(first).map((name) => table.columns.get(name))
      .filter(({name, is_text, values}) => !is_text && !name.startsWith('time.') && values.some((v) => v !== null));
    this.figures = new Map();
  }

  /** {mean, low, high, n} of a column for each point, with the 95 % interval. `mean` is null if a flight lacks the value, `low` for one seed. */
  of(name) {
    if (this.figures.has(name)) return this.figures.get(name);
    const column = this.table.columns.get(name).values;
    const figures = this.points.map(({rows}) => {
      const values = rows.map((row) => column[row]), n = rows.length;
      if (values.includes(null)) return {mean: null, low: null, high: null, n};
      const mean = values.reduce((sum, v) => sum + v, 0) / n;
      if (name === 'passed') return {mean, ...wilsonInterval(mean, n), n};
      const factor = this.sweep.student[n];
      if (factor === undefined) return {mean, low: null, high: null, n};
      const half = factor * Math.sqrt(values.reduce((sum, v) => sum + (v - mean) ** 2, 0) / (n - 1) / n);
      return {mean, low: mean - half, high: mean + half, n};
    });
    this.figures.set(name, figures);
    return figures;
  }
  /** Name and unit. */
  label(name) { return columnLabel(this.table.columns.get(name)); }
  unit(name) { return this.table.columns.get(name).unit; }
  has(name) { return this.columns.some((column) => column.name === name); }
  varies(name) { return this.has(name) && new Set(this.of(name).map(({mean}) => mean).filter((mean) => mean !== null)).size > 1; }
  /** 'more' or 'less', as it is better. */
  better(name) { return this.sweep.more_is_better.includes(name) ? 'more' : 'less'; }

  /** Indices of the points, the best first: points that were flown, points without failed flights, then the mean, then the clearance. */
  ranking({column, less, passedFirst}) {
    const figures = this.of(column), clearance = this.has('min_obstacle_clearance_m') ? this.of('min_obstacle_clearance_m') : null;
    const failing = (point) => point.missing === point.rows.length ? 2 : passedFirst && !noneFailed(point) ? 1 : 0;
    const cost = (i) => figures[i].mean === null ? Infinity : less ? figures[i].mean : -figures[i].mean;
    const close = (i) => clearance?.[i].mean ?? 0;
    return [...this.points.keys()].sort((a, b) => failing(this.points[a]) - failing(this.points[b]) ||
      (cost(a) < cost(b) ? -1 : cost(a) > cost(b) ? 1 : 0) || close(b) - close(a) || a - b);
  }
  /** Number of different values of a parameter. */
  levels(k) { return new Set(this.points.map(({values}) => values[k])).size; }
  /** Headings of the parameters, with units. */
  headings() { return this.paths.map((path) => this.label(path)); }
  /** "braking = 1.5, reaction = 0.4" with the full keys. */
  words(i) { return this.paths.map((path, k) => `${path} = ${valueWords(this.points[i].values[k])}`).join(', '); }
  /** The command that flies all seeds of a point. */
  command(i) {
    const {rows} = this.points[i], command = this.table.value('command', rows[0]);
    if (rows.length === 1) return command;
    const seeds = seedList(rows.map((row) => this.table.seed(row)));
    return command.replace(/^hedgehop run /, 'hedgehop batch ').replace(/ --seed \S+/, ` --seeds ${seeds}`);
  }
}
/** Whether no flight of a point failed. Flights without checks and flights not flown count as passed for the order only. */
function noneFailed({passed, unchecked, missing, rows}) { return passed + unchecked + missing === rows.length; }
/** "2 of 3", with the noun "2 of 3 flights passed", and the numbers of flights without checks and not flown; or "no checks", "not flown". */
function passedWords({passed, unchecked, missing, rows}, noun = '') {
  if (missing === rows.length) return 'not flown';
  if (unchecked === rows.length) return 'no checks';
  return `${passed} of ${noun ? countOf(rows.length, noun) + ' passed' : rows.length}` + (unchecked ? `; no checks: ${unchecked}` : '')
    + (missing ? `; not flown: ${missing}` : '');
}
/** The 95 % score interval of a rate, [Wilson1927] p. 212. */
function wilsonInterval(rate, n) {
  const z = 1.959964, middle = (rate + z * z / (2 * n)) / (1 + z * z / n);
  const half = z * Math.sqrt(rate * (1 - rate) / n + z * z / (4 * n * n)) / (1 + z * z / n);
  return {low: rate === 0 ? 0 : middle - half, high: rate === 1 ? 1 : middle + half};
}
function valueWords(value, figures = 4) { return typeof value === 'number' ? short(value, figures) : String(value); }

/** Seeds as the command line takes them: "1:3,7". */
function seedList(seeds) {
  const sorted = seeds.map(BigInt).sort((a, b) => a < b ? -1 : a > b ? 1 : 0), parts = [];
  for (let i = 0; i < sorted.length;) {
    let last = i;
    while (sorted[last + 1] === sorted[last] + 1n) ++last;
    parts.push(last > i ? `${sorted[i]}:${sorted[last]}` : String(sorted[i]));
    i = last + 1;
  }
  return parts.join(',');
}

/** Mean with its interval, such as "0.55 m, 0.48 to 0.62". */
function meanWords({mean, low, high}, unit) {
  if (mean === null) return 'a flight lacks the value';
  const words = short(mean) + (unit ? ' ' + unit : '');
  return low === null ? words : `${words}, 95 % interval ${short(low)} to ${short(high)}`;
}

/** The axis of a parameter: {axis, at(value)}. Logarithmic if its range was; categories if its values are not numbers. */
function parameterAxis(points, k) {
  const path = points.paths[k], values = points.points.map((point) => point.values[k]);
  if (points.table.columns.get(path).is_text) {
    const words = [...new Set(values)];
    return {axis: wordAxis(points.label(path), words), at: (value) => words.indexOf(value), levels: words};
  }
  const levels = [...new Set(values)].sort((a, b) => a - b);
  if (!points.sweep.parameters[k]?.log) return {axis: numberAxis(points.label(path), values), at: (value) => value, levels};
  const axis = numberAxis(points.label(path), values.map(Math.log10));
  const shown = levels.length <= 8 ? levels : [0, 0.25, 0.5, 0.75, 1].map((share) => levels[Math.round(share * (levels.length - 1))]);
  const figures = figuresFor(shown, 3);
  axis.ticks = shown.map((value) => ({value: Math.log10(value), text: short(value, figures)}));
  return {axis, at: Math.log10, levels};
}

/**
 * Levels of a parameter, or ranges if there are many levels or few points per level:
 * {words, of(value) -> index, at(index) -> position on the axis}.
 */
function parameterBins(points, k) {
  const {axis, at, levels} = parameterAxis(points, k), count = points.points.length;
  const is_text = points.table.columns.get(points.paths[k]).is_text, others_vary = points.paths.some((path, other) => other !== k && points.levels(other) > 1);
  const single = !is_text && others_vary && 1.5 * levels.length > count;
  if (levels.length <= mostCategories && !single) {
    const figures = is_text || figuresFor(levels);
    return {axis, words: levels.map((value) => valueWords(value, figures)), of: (value) => levels.indexOf(value), at: (i) => at(levels[i]), levels: true};
  }
  const bins = single ? Math.max(2, Math.min(numberBins, Math.floor(count / pointsInBin))) : numberBins;
  const [low, high] = finiteRange(levels.map(at)), step = (high - low) / bins;
  const back = (x) => points.sweep.parameters[k]?.log ? 10 ** x : x;
  const words = rangeWords(Array.from({length: bins + 1}, (_, i) => back(low + i * step)));
  return {axis, words, of: (value) => Math.min(bins - 1, Math.floor((at(value) - low) / step)), at: (i) => low + (i + 0.5) * step, levels: false};
}
