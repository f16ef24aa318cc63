'use strict';
// Functions for all pages: elements, formatted numbers, colors, ticks.

/** Returns a new element. `text` is never markup. */
function make(tag, className = '', text = '') {
  const element = document.createElement(tag);
  if (className) element.className = className;
  if (text !== '') element.textContent = text;
  return element;
}

/** Adds a row of [text, class] cells to a table and returns it. */
function addRow(table, cells, tag = 'td') {
  const row = table.appendChild(make('tr'));
  for (const [text, className] of cells) row.append(make(tag, className, text));
  return row;
}

/** Returns a number with this many significant figures and a typographic minus. */
function short(value, figures = 4) {
  if (value === null || value === undefined) return '–';
  const size = Math.abs(value);
  if (size < 1e-12) return '0';  // a rounding error
  if (size >= 1e6 || size < 1e-4) return value.toExponential(Math.max(2, figures - 2)).replaceAll('-', '−');
  const digits = Math.max(0, figures - 1 - Math.floor(Math.log10(size)));
  return String(Number(value.toFixed(digits))).replace('-', '−');
}
/** Returns the number of figures, at least `minimum`, with which short() distinguishes these numbers. */
function figuresFor(values, minimum = 4) {
  const different = new Set(values.filter((v) => v !== null)), texts = (figures) => new Set([...different].map((v) => short(v, figures)));
  let figures = minimum;
  while (figures < 7 && texts(figures).size < different.size) ++figures;
  return figures;
}
/** Returns the texts of evenly spaced numbers, with the figures of their step. */
function tickTexts(values) {
  const size = Math.max(...values.map(Math.abs)), step = values[1] - values[0];
  const figures = step > 0 ? Math.ceil(Math.log10(size / step) - 1e-9) + 1 : 0;
  return values.map((v) => short(Math.abs(v) < 1e-9 * step ? 0 : v, Math.max(4, figures)));
}
/** Returns a number with this many decimals and a typographic minus; zero has no minus. */
function fixed(value, decimals) {
  if (value === null || value === undefined) return '–';
  return value.toFixed(decimals).replace(/^-(?=0\.?0*$)/, '').replace('-', '−');
}
/** Returns a text of the simulator with quotation marks around names. */
function quoted(text) { return text.replace(/`([^`]*)`/g, '“$1”'); }
/** Returns a unit with raised powers: "m/s³". */
function unitWords(unit) { return unit.replace('^2', '²').replace('^3', '³'); }
/** Returns a number with its unit; a small time in a smaller unit: "0.25 µs", not "0.00025 ms". @param like  number that chooses this unit. */
function measured(value, unit, figures = 4, like = value) {
  const units = ['s', 'ms', 'µs', 'ns'];
  let i = units.indexOf(unit);
  if (like && i >= 0) for (; Math.abs(like) < 0.01 && i < units.length - 1; ++i) [value, like] = [1000 * value, 1000 * like];
  return short(value, figures) + (unit && value !== null ? ' ' + (units[i] ?? unitWords(unit)) : '');
}
/** Returns the outcome for pages: "completed" for a timeout without a goal, which is a normal end. */
function shownOutcome(outcome, goal_distance_m) {
  return outcome === 'timeout' && (goal_distance_m ?? null) === null ? 'completed' : outcome;
}
function settingLabel(key, unit) { return columnLabel({name: key, unit: unitWords(unit)}); }
/** A table of settings that differ: rows of [label, before, now, ...more]. Long values wrap. */
function settingsTable(host, heads, rows) {
  const maximum = 30, table = host.appendChild(make('table', 'settings'));
  addRow(table, heads.map((head) => [head, '']), 'th');
  for (const row of rows.slice(0, maximum)) addRow(table, row.map((text) => [text === '' ? '–' : text, '']));
  if (rows.length > maximum) host.append(make('p', 'soft', `and ${rows.length - maximum} more`));
}
function meters(value) { return value === null ? '–' : fixed(value, 2) + ' m'; }

/** Returns a CSS variable of the current theme. */
function themeColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}

/** Returns a function from 0..1 to a color, through evenly spaced stops "#rrggbb, ...". */
function makeRamp(stops) {
  const colors = stops.split(',').map((s) => [1, 3, 5].map((i) => parseInt(s.trim().slice(i, i + 2), 16)));
  return (share) => {
    const x = Math.min(Math.max(share, 0), 1) * (colors.length - 1);
    const i = Math.min(Math.floor(x), colors.length - 2);
    return 'rgb(' + colors[i].map((c, k) => Math.round(c + (colors[i + 1][k] - c) * (x - i))).join(',') + ')';
  };
}

/** Returns the color of text on an "rgb(r,g,b)" background: the one with more contrast. */
function inkOn(color) {
  const [r, g, b] = color.match(/\d+/g).map((v) => v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? '#000000' : '#ffffff';  // the contrast is at least 4.5
}

/** Returns round numbers in [low, high], about `count` of them and never many more: {step, values}. */
function niceTicks(low, high, count) {
  const rough = (high - low) / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((s) => s * power >= rough);
  const first = Math.ceil(low / step), steps = Math.min(Math.floor(high / step + 1e-9) - first, Math.ceil(Math.max(count, 1)));
  const values = [];
  for (let k = 0; k <= steps; ++k) values.push((first + k) * step);  // first + k may equal first: the count ends the loop
  return {step, values};
}

/** Returns the last row at or before an instant, the first row if there is none. @param times  increasing. */
function rowBefore(times, t_s) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t_s) low = middle; else high = middle - 1;
  }
  return low;
}

/** Returns the minimum and maximum finite value, or [0, 1] if there is none. */
function finiteRange(values) {
  let low = Infinity, high = -Infinity;
  for (const v of values) {
    if (v === null || !isFinite(v)) continue;
    low = Math.min(low, v);
    high = Math.max(high, v);
  }
  return low <= high ? [low, high] : [0, 1];
}

function quantile(values, share) {
  const sorted = values.filter((v) => v !== null).sort((a, b) => a - b);
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] : 1;
}

/** Returns a path as {n, e} in m, from steps in centimeters. */
function readPath(steps) {
  const n = [], e = [];
  let north = 0, east = 0;
  for (let i = 0; i < steps.length; i += 2) {
    n.push((north += steps[i]) / 100);
    e.push((east += steps[i + 1]) / 100);
  }
  return {n, e};
}

/** Makes an element that is not a button selectable by pointer and keyboard. */
function onChoose(element, action) {
  element.tabIndex = 0;
  element.addEventListener('click', action);
  element.addEventListener('keydown', (event) => {
    if (event.target !== element || (event.key !== 'Enter' && event.key !== ' ')) return;
    event.preventDefault();
    action(event);
  });
}

/** Returns the end of a name in this unit, such as "_mps". */
function unitSuffix(unit) { return '_' + unit.toLowerCase().replace('/', 'p').replace('^', '').replace('²', '2').replace('³', '3'); }
/** Returns a count with its noun: "1 flight", "2 flights". */
function countOf(count, noun) { return `${count} ${noun}${count === 1 ? '' : 's'}`; }
/** Returns the name of a group without the number of a sweep's point, and its values rounded. */
function groupWords(group) {
  return group.replace(/^point \S+ (?=.*=)/, '').replace(/\d+\.\d{5,}/g, (digits) => short(Number(digits)));
}
/** Returns an element whose words break only if they are longer than a line, then after dots, underscores and slashes. */
function breakable(tag, className, text) {
  const element = make(tag, className);
  text.split(' ').forEach((word, i) => {
    element.append(i ? ' ' : '');
    const whole = element.appendChild(make('span', 'whole'));
    for (const part of word.split(/(?<=[_/]|\.(?!\d))/)) whole.append(part, make('wbr'));
  });
  return element;
}
/** Adds a row of headings [text, class] that break in long names. */
function addHeadings(table, cells) {
  const row = table.appendChild(make('tr'));
  for (const [text, className] of cells) row.append(breakable('th', className, text));
}
/** Returns the words of a check or metric. A name without its unit, because the unit is next to the value. */
function wordsOf(name, unit) {
  const words = unit && name.endsWith(unitSuffix(unit)) ? name.slice(0, -unitSuffix(unit).length) : name;
  return words.replace(/^(module\.)?least_/, '$1minimum_').replace(/^(module\.)?most_/, '$1maximum_')
    .replace(/^module\.(.*)/, '$1, reported by the module').replaceAll('_', ' ');
}
/** Name and unit of a column. A name that ends in its unit needs no other. */
function columnLabel({name, unit}) { return !unit || name.endsWith(unitSuffix(unit)) ? name : `${name}, ${unit}`; }

/** Returns a word as a shell reads it back. */
function shellQuoted(word) { return /^[\w\-+=.,/:@%]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`; }

/** Shows a table whose headings sort it. A heading with the focus keeps it. */
function replaceTable(host, element) {
  const focused = host.contains(document.activeElement) ? document.activeElement.dataset.column : undefined;
  host.replaceChildren(element);
  if (focused !== undefined) [...element.querySelectorAll('th')].find((th) => th.dataset.column === focused)?.focus({preventScroll: true});
}

/** Sets the text alternative of a drawing. */
function describeDrawing(element, text) {
  element.setAttribute('role', 'img');
  element.setAttribute('aria-label', text);
}

/** A button that copies a text. */
function copyButton(text) {
  const button = make('button', 'copy', 'copy');
  button.title = 'Copy the command line that re-simulates this flight';
  button.addEventListener('click', (event) => {
    event.stopPropagation();
    navigator.clipboard?.writeText(text).then(() => { button.textContent = 'copied'; }, () => { button.textContent = 'failed'; });
  });
  return button;
}
/** A command line with a button that copies it. */
function addCommand(host, text) {
  const command = host.appendChild(make('div', 'command'));
  command.append(breakable('code', '', text), copyButton(text));
}

/** Returns the name of the object that a flight hit, as in its cause; without a cause, the closer of the nearest obstacle and the ground. */
function hitWords({cause, closest_obstacle, closest_ground}) {
  const named = cause?.match(/^hit (.+) at [\d.]+ s/)?.[1];
  if (named) return named;
  const is_ground = closest_ground && !(closest_obstacle?.distance_m <= closest_ground.distance_m);
  return is_ground ? 'the ground' : closest_obstacle?.what || 'an obstacle';
}

/** Returns the failures of the scenario: {from_s, to_s, text} of result.failures, such as "20 s to 22 s: camera.front black". */
function failuresOf(result, end_s) {
  return (result.failures ?? []).map((words) => {
    const [, from, to, text] = words.match(/^(\S+) s to (?:(\S+) s|the end): (.*)$/);
    return {from_s: +from, to_s: Math.min(to === undefined ? end_s : +to, end_s), text};
  }).filter(({from_s}) => from_s < end_s);
}
