'use strict';
// A leaderboard: every module in every world, worlds from the easiest to the hardest.

/** Fills the card with the matrix. Removes the card if there is no leaderboard. */
function fillBoard(host, board, on) {
  if (!board) {
    host.remove();
    return;
  }
  host.append(make('h2', '', 'Leaderboard'), make('p', 'soft', 'Flights whose checks all hold, with the 95 % interval of their rate. ' +
    'Below: collisions, median of the minimum clearance, path length beyond the shortest path, speed, and time per decision. Difficulty of a world: ' +
    'mean share of failed flights over the modules, without the control.'));
  const scroll = host.appendChild(make('div', 'scroll')), table = scroll.appendChild(make('table', 'board'));
  const head = addRow(table.appendChild(make('thead')), [['world', ''], ['difficulty', 'number']], 'th');
  for (const module of board.modules) head.append(make('th', '', module.name + (module.control ? ' (control)' : '')));
  const body = table.appendChild(make('tbody'));
  for (const world of board.worlds) {
    const row = addRow(body, [[world.name, ''], [fixed(world.difficulty, 2), 'number']]);
    for (const module of board.modules) {
      row.append(boardCell(board.cells.find((c) => c.world === world.name && c.module === module.name), on));
    }
  }
  for (const [reason, cells] of groupedBy(board.cells.filter((c) => c.reason), (c) => `${c.module}: ${c.reason}`)) {
    host.append(make('p', 'soft', `Not flown in ${cells.map((c) => c.world).join(', ')}: ${reason}.`));
  }
}

/** [[key, items], ...] in the order of the keys' first items. */
function groupedBy(items, keyOf) {
  const groups = new Map();
  for (const item of items) groups.set(keyOf(item), [...groups.get(keyOf(item)) ?? [], item]);
  return [...groups];
}

/** "1 collided". The number of flights without a fault follows if it is not that of the flights with checks, then the number of faults. */
function collidedWords({collided, flown, flights, broken}) {
  return `${collided}${flown === flights ? '' : ` of ${flown}`} collided` + (broken ? `, ${broken} with a fault or no result` : '');
}

function boardCell(cell, on) {
  const element = make('td', 'cell');
  if (cell.passed === undefined) {
    element.classList.add('empty');
    element.append(make('span', 'soft', cell.no_checks ? 'no checks' : cell.reason ? 'not flown' : 'missing'));
    element.title = cell.reason;
    return element;
  }
  element.style.setProperty('--share', 100 * cell.passed / cell.flights + '%');
  element.append(make('b', '', `${cell.passed} of ${cell.flights}`), make('span', 'soft', ` ${fixed(cell.low, 2)} to ${fixed(cell.high, 2)}`));
  const words = [collidedWords(cell)];
  if (cell.median_clearance_m !== null) words.push(`${fixed(cell.median_clearance_m, 2)} m`);
  if (cell.path_excess !== null) words.push(`${cell.path_excess < 0 ? '' : '+'}${fixed(100 * cell.path_excess, 0)} %`);
  words.push(`${fixed(cell.mean_speed_mps, 1)} m/s`, measured(cell.decision_ms, 'ms', 2));
  element.append(make('div', 'soft', words.join(', ')));
  element.title = 'show only these flights';
  onChoose(element, () => on.filter(/\s/.test(cell.group) ? `group="${cell.group}"` : `group=${cell.group}`));
  return element;
}

/** Returns the place of the strips that the page lacks. */
function omittedWords(count) {
  const file = count === 1 ? 'It is strip.jpg in the folder of the flight.' : 'Each is strip.jpg in the folder of its flight.';
  return `${countOf(count, 'film strip')} ${count === 1 ? 'is' : 'are'} not shown, because a page has at most 2.5 MB of them. ${file}`;
}

/** Film strips of the flights that have one, with links to more of each. */
function fillStrips(host, data, table, on) {
  const {images, omitted} = data.strips;
  if (!images.length && !omitted) {
    host.remove();
    return;
  }
  host.append(make('h2', '', 'Film strips of the worst flights'),
    make('p', 'soft', 'Camera images with the overlays of the modules before the collision or the closest approach, from a re-simulation.'));
  if (omitted) host.append(make('p', 'soft', omittedWords(omitted)));
  for (const [row, jpeg] of images) {
    const figure = host.appendChild(make('figure', 'strip')), line = figure.appendChild(make('figcaption', 'flight-line'));
    line.classList.add('long');
    line.append(flightButton(table, row, on), make('span', 'soft', table.why[row] || `passed, clearance ${meters(table.value('min_obstacle_clearance_m', row))}`),
      linkTo(data, table, row), copyButton(table.value('command', row)));
    const image = figure.appendChild(make('img'));
    image.src = 'data:image/jpeg;base64,' + jpeg;
    image.alt = `images before the end of ${table.value('id', row)}`;
  }
}
