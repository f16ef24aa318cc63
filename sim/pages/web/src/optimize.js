'use strict';
// The convergence of an optimizer: the cost of each point that it tried, and the best so far.

class ConvergenceView {
  constructor(host, points, on) {
    const {minimize, failure_cost: failure} = points.sweep, column = points.table.columns.get(minimize);
    host.append(make('h2', '', 'Convergence'));
    this.costs = points.points.map(({rows}) => {
      const costs = rows.map((row) => ['passed', 'unchecked'].includes(points.table.verdict(row)) && column ? column.values[row] : null);
      return costs.includes(null) ? null : costs.reduce((sum, v) => sum + v, 0) / costs.length;
    });
    Object.assign(this, {points, minimize});
    const failed = this.costs.filter((cost) => cost === null).length;
    const seeds = points.points[0].rows.length, tried = points.points.length;
    host.append(make('p', 'soft', `Minimized: mean of ${minimize} over ${countOf(seeds, 'seed')}; ${countOf(tried, 'point')} tried` +
      (failed ? `, ${failed} of them with a failed flight, which costs ${failure.toLocaleString('en-US')}${failed < tried ? ' (crosses)' : ''}` : '') + '.'));
    if (failed === tried) {
      host.append(make('p', 'missing', 'Every point has a failed flight, so no cost can be drawn.'));
      return;
    }
    this.axes = new Axes(host.appendChild(make('div')), 260, {
      draw: (c) => this.draw(c), hover: (x) => this.lines(x), pick: (x) => { const i = this.at(x); if (i !== null) on.choosePoint(i); }});
    const order = numberAxis('point, in the order of the search', [1, this.costs.length]);
    order.ticks = this.costs.map((_, i) => ({value: i + 1, text: String(i + 1)}));
    this.axes.set(order, numberAxis('mean of ' + (column ? columnLabel(column) : minimize), this.costs));
    host.append(make('div', 'plan-key', 'line: best so far'));
  }
  draw(c) {
    const {axes} = this;
    let best = Infinity;
    c.strokeStyle = themeColor('ink');
    c.beginPath();
    this.costs?.forEach((cost, i) => {
      if (isFinite(best)) c.lineTo(axes.x(i + 1), axes.y(best));
      if (cost !== null) best = Math.min(best, cost);
      if (isFinite(best)) c.lineTo(axes.x(i + 1), axes.y(best));
    });
    c.stroke();
    this.costs?.forEach((cost, i) => {
      const x = axes.x(i + 1);
      c.fillStyle = c.strokeStyle = themeColor(cost === null ? 'bad' : 'c0');
      c.beginPath();
      if (cost === null) {
        const y = axes.frame.y + 10;
        c.moveTo(x - 4, y - 4); c.lineTo(x + 4, y + 4); c.moveTo(x + 4, y - 4); c.lineTo(x - 4, y + 4);
        c.stroke();
      } else {
        c.arc(x, axes.y(cost), cost === best ? 5 : 3, 0, 2 * Math.PI);
        c.fill();
      }
    });
  }
  at(px) {
    const {xAxis, frame} = this.axes, i = Math.round(xAxis.low + (px - frame.x) / frame.width * (xAxis.high - xAxis.low)) - 1;
    return this.costs[i] === undefined ? null : i;
  }
  lines(px) {
    const i = this.at(px);
    return i === null ? null : pointLines(this.points, i, [this.minimize]);
  }
}
