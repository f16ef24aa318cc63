'use strict';
// Collision rate over speed of the modules of a leaderboard: one plot for all worlds together, and one per world.

const markColors = 6, markRadius = 4.5;

/** An axis from 0 to 1, with space for marks at its ends. */
function shareAxis() {
  return {label: 'share of flights that collide', low: -0.04, high: 1.04, ticks: [0, 0.25, 0.5, 0.75, 1].map((value) => ({value, text: String(value)}))};
}

function markColor(index, control) { return themeColor(control ? 'soft' : 'c' + index % markColors); }

/** A dot, a square for the seventh module and on, a cross for a control. */
function drawMark(c, index, control, x, y) {
  c.strokeStyle = c.fillStyle = markColor(index, control);
  c.lineWidth = 2;
  c.beginPath();
  if (control) {
    for (const way of [-1, 1]) {
      c.moveTo(x - markRadius, y - way * markRadius);
      c.lineTo(x + markRadius, y + way * markRadius);
    }
    c.stroke();
  } else if (index >= markColors) {
    c.fillRect(x - markRadius, y - markRadius, 2 * markRadius, 2 * markRadius);
  } else {
    c.arc(x, y, markRadius, 0, 2 * Math.PI);
    c.fill();
  }
}

/** Points of one plot: {module, index, control, flown, broken, collided, collided_low, collided_high, mean_speed_mps}. */
class CollisionPlot {
  constructor(host, title, points, speedAxis) {
    this.points = points;
    const figure = host.appendChild(make('figure', 'collisions'));
    figure.append(make('figcaption', '', title));
    this.axes = new Axes(figure.appendChild(make('div')), 210, {
      draw: (c) => this.draw(c), hover: (x, y) => this.lines(x, y), pick: () => {}});
    this.axes.set(speedAxis, shareAxis());
  }
  draw(c) {
    const {axes} = this;
    for (const p of this.points) {
      const x = axes.x(p.mean_speed_mps);
      c.strokeStyle = markColor(p.index, p.control);
      c.lineWidth = 1.5;
      c.globalAlpha = 0.6;
      c.beginPath();
      c.moveTo(x, axes.y(p.collided_low));
      c.lineTo(x, axes.y(p.collided_high));
      c.stroke();
      c.globalAlpha = 1;
      drawMark(c, p.index, p.control, x, axes.y(p.collided / p.flown));
    }
  }
  lines(px, py) {
    const distance = (p) => Math.hypot(this.axes.x(p.mean_speed_mps) - px, this.axes.y(p.collided / p.flown) - py);
    const near = this.points.filter((p) => distance(p) < 12);
    if (!near.length) return null;
    return near.flatMap((p) => [p.module, `${p.collided} of ${p.flown} collided, 95 % interval ${fixed(p.collided_low, 3)} to ${fixed(p.collided_high, 3)}`,
      ...(p.broken ? [`not counted: ${p.broken} with a fault or no result`] : []),
      `median of the mean speeds ${fixed(p.mean_speed_mps, 2)} m/s`]);
  }
}

/** Fills the card with the plots and returns them. Removes the card if there is no leaderboard. */
function fillCollisions(host, board) {
  if (!board) {
    host.remove();
    return [];
  }
  const indexOf = new Map(board.modules.map((module, index) => [module.name, index]));
  const control = new Set(board.modules.filter((module) => module.control).map((module) => module.name));
  const points = (cells) => cells.filter((cell) => cell.flown && cell.mean_speed_mps !== null).map((cell) =>
    ({...cell, index: indexOf.get(cell.module), control: control.has(cell.module)}));
  host.append(make('h2', '', 'Collisions against speed'), make('p', 'soft', 'Share of the flights without a fault that end in a collision, with its 95 % interval, ' +
    'over the median of the mean speeds. Low and to the right is better. A module that hovers has no collisions.'));
  const all = points(board.totals), axis = {...numberAxis('mean speed, m/s', [0, ...points(board.cells).map((p) => p.mean_speed_mps)]), low: 0};
  const grid = host.appendChild(make('div', 'collision-plots'));
  const plots = [new CollisionPlot(grid, 'all worlds', all, axis)];
  for (const world of board.worlds) plots.push(new CollisionPlot(grid, world.name, points(board.cells.filter((cell) => cell.world === world.name)), axis));
  const key = host.appendChild(make('div', 'plan-key'));
  for (const p of all) {
    const item = key.appendChild(make('span')), mark = item.appendChild(make('canvas'));
    mark.width = mark.height = 28;
    plots.push({axes: {draw: () => {
      const c = mark.getContext('2d');
      c.setTransform(2, 0, 0, 2, 0, 0);
      c.clearRect(0, 0, 14, 14);
      drawMark(c, p.index, p.control, 7, 7);
    }}});
    item.append(p.module + (p.control ? ' (control)' : '') + (p.worlds < board.worlds.length ? `, flies in ${p.worlds} of ${board.worlds.length} worlds` : ''));
  }
  for (const plot of plots) plot.axes.draw();
  return plots;
}
