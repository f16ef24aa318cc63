'use strict';
// Table of flights: filters and sort order.

/** The table of a campaign: columns by name, and the verdict on each flight. */
class FlightTable {
  constructor(data) {
    this.columns = new Map(data.columns.map((column) => [column.name, {...column, unit: column.unit && unitWords(column.unit)}]));
    this.count = this.columns.get('id').values.length;
    this.why = data.why.map(quoted);
    this.failed = data.failed;
    // Seeds are texts in the data, because a number is exact up to 2^53 only. Plots use the numbers.
    const seeds = this.columns.get('seed');
    if (seeds && !seeds.is_text) {
      seeds.exact = seeds.values.map((text) => text === '' ? null : BigInt(text));
      seeds.values = seeds.values.map((text) => text === '' ? null : Number(text));
    }
    const outcomes = this.columns.get('outcome'), goals = this.columns.get('goal_distance_m');
    if (!outcomes) return;
    const shown = outcomes.values.map((word, row) => shownOutcome(word, goals?.values[row]));
    this.why = this.why.map((words, row) => shown[row] === 'completed' ? words.replace(/^timeout/, 'completed') : words);
    outcomes.values = shown;
  }
  /** Returns the counts of the flights by their first failed check: [[name, count], ...], collisions and then the most frequent first. */
  failureCounts(rows) {
    const counts = new Map();
    for (const row of rows) if (this.failed[row]) counts.set(this.failed[row], (counts.get(this.failed[row]) ?? 0) + 1);
    return [...counts].sort(([first, a], [second, b]) => (second === 'no_collision') - (first === 'no_collision') || b - a);
  }
  /** Returns the rows of a group, or of all groups except these. */
  rowsOf(group, without = []) {
    const groupOf = (row) => this.value('group', row) ?? '';
    return Array.from({length: this.count}, (_, row) => row).filter((row) => group === null ? !without.includes(groupOf(row)) : groupOf(row) === group);
  }
  /** The seed of a flight as a text. */
  seed(row) { return String(this.columns.get('seed')?.exact?.[row] ?? this.value('seed', row) ?? '–'); }
  value(name, row) { return this.columns.get(name)?.values[row] ?? null; }
  /** 'passed', 'collided', 'failed' (another check), 'unchecked' (no checks) or 'missing'. */
  verdict(row) {
    if (this.value('status', row) === 'missing') return 'missing';
    if (this.value('passed', row) === 1) return 'passed';
    if (this.value('outcome', row) === 'collided') return 'collided';
    return this.why[row] === 'no checks' ? 'unchecked' : 'failed';
  }
}
const verdictColors = {passed: 'c0', collided: 'bad', failed: 'c3', unchecked: 'c2', missing: 'soft'};
const verdictWords = {passed: 'all checks hold', collided: 'collided', failed: 'other check failed', unchecked: 'no checks', missing: 'not flown'};

/** Returns the column with this name, or with this name after its last dot. */
function findColumn(table, word) {
  if (table.columns.has(word)) return table.columns.get(word);
  return [...table.columns.values()].find(({name}) => name.endsWith('.' + word)) ?? null;
}

/** Reads a filter: words that must occur, and comparisons such as seed=3, flight_time_s>20 or group="a b". {terms, fault}. */
function parseFilter(table, text) {
  const terms = [];
  for (const word of (text.match(/(?:"[^"]*"|[^\s"])+/g) ?? []).map((part) => part.replaceAll('"', '')).filter(Boolean)) {
    const parts = word.match(/^([\w.]+)(<=|>=|!=|=|<|>)(.+)$/);
    if (!parts) {
      terms.push({word: word.toLowerCase()});
      continue;
    }
    const [, name, relation, value] = parts, column = findColumn(table, name);
    if (!column) return {terms: [], fault: `no column '${name}'`};
    const number = column.exact && /^\d+$/.test(value) ? BigInt(value) : Number(value);
    if (relation !== '=' && relation !== '!=' && (column.is_text || Number.isNaN(number))) {
      return {terms: [], fault: `'${word}': ${column.is_text ? name : value} is not a number`};
    }
    terms.push({column, relation, value, number});
  }
  return {terms, fault: ''};
}

function holds({column, relation, value, number}, row) {
  const found = column.exact?.[row] ?? column.values[row];
  const same = column.is_text ? String(found).toLowerCase() === value.toLowerCase() : found == number;  // of BigInt and number, too
  switch (relation) {
    case '=': return same;
    case '!=': return !same;
    case '<': return found !== null && found < number;
    case '<=': return found !== null && found <= number;
    case '>': return found !== null && found > number;
    default: return found !== null && found >= number;
  }
}

/** Rows that meet every term. */
function filteredRows(table, terms) {
  const rows = [];
  for (let row = 0; row < table.count; ++row) {
    const text = terms.some((t) => t.word) ? ['id', 'group', 'scenario', 'outcome', 'command']
      .map((name) => table.value(name, row) ?? '').concat(table.why[row]).join(' ').toLowerCase() : '';
    if (terms.every((term) => term.word ? text.includes(term.word) : holds(term, row))) rows.push(row);
  }
  return rows;
}

/** Rows by a column, equal ones in their order, rows without a value last in both orders. */
function sortedRows(rows, column, falling) {
  const values = column.exact ?? column.values, value = (row) => values[row] === '' ? null : values[row];
  return [...rows].sort((a, b) => {
    const u = value(a), v = value(b);
    if (u === null || v === null) return (u === null) - (v === null) || a - b;
    const order = u < v ? -1 : u > v ? 1 : 0;
    return (falling ? -order : order) || a - b;
  });
}

/** Rows that no other beats: none is as good in both columns and better in one. Sorted by x. */
function paretoRows(rows, x, y, xFalls, yFalls) {
  const cost = (values, falls, row) => falls ? values[row] : -values[row];
  const known = rows.filter((row) => x[row] !== null && y[row] !== null);
  known.sort((a, b) => cost(x, xFalls, a) - cost(x, xFalls, b) || cost(y, yFalls, a) - cost(y, yFalls, b) || a - b);
  const front = [];
  let least = Infinity, at = null;
  for (const row of known) {
    const u = cost(x, xFalls, row), v = cost(y, yFalls, row);
    if (v < least || (v === least && u === at)) front.push(row);  // equal in both: neither beats the other
    if (v < least) [least, at] = [v, u];
  }
  return front;
}
