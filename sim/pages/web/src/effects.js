'use strict';
// Shares of the variance of a column: each parameter alone, and with its interactions.

class EffectsView {
  constructor(host, points, choice) {
    Object.assign(this, {points});
    this.note = host.appendChild(make('p', 'soft'));
    this.table = host.appendChild(make('div', 'scroll'));
    this.setChoice(choice);
  }
  setChoice({column}) {
    const {effects} = this.points.sweep, indices = effects.columns?.[column];
    this.table.replaceChildren();
    if (!effects.method) {
      this.note.textContent = 'Variance-based indices need a full grid, or design: {type: sobol, indices: true}. The blue lines of the slices only approximate the main effects.';
      return;
    }
    if (!indices) {
      this.note.textContent = `${column} is equal at all points, or a flight lacks it.`;
      return;
    }
    this.note.textContent = `Share of the variance of ${column} between the points. ` + (effects.method === 'sobol'
      ? `Sobol indices from ${effects.blocks} blocks of points with 95 % bootstrap intervals: [Saltelli2010] table 2 (b) and (f), the latter after [Jansen1999].`
      : 'Sobol indices of the grid by their definition, with equal weights: [Saltelli2010] sec. 2.');
    const element = this.table.appendChild(make('table'));
    addRow(element.appendChild(make('thead')), [['parameter', ''], ['alone: first-order index', ''], ['', 'number'], ['with interactions: total index', ''], ['', 'number'],
      ['interactions', 'number']], 'th');
    const body = element.appendChild(make('tbody'));
    const order = [...indices.keys()].sort((a, b) => indices[b][3] - indices[a][3]);
    for (const k of order) {
      const [first, firstLow, firstHigh, total, totalLow, totalHigh] = indices[k];
      const words = (value, low, high) => fixed(value, 2) + (low === high ? '' : `, ${fixed(low, 2)} to ${fixed(high, 2)}`);
      const line = addRow(body, [[this.points.paths[k], ''], ['', ''], [words(first, firstLow, firstHigh), 'number'], ['', ''], [words(total, totalLow, totalHigh), 'number'],
        [fixed(Math.max(0, total - first), 2), 'number']]);
      for (const [cell, value, low, high] of [[1, first, firstLow, firstHigh], [3, total, totalLow, totalHigh]]) {
        const bar = line.children[cell].appendChild(make('span', 'share'));
        bar.appendChild(make('b')).style.width = 100 * Math.min(1, Math.max(0, value)) + '%';
        if (low === high) continue;
        const span = bar.appendChild(make('i'));
        span.style.left = 100 * Math.min(1, Math.max(0, low)) + '%';
        span.style.width = 100 * (Math.min(1, Math.max(0, high)) - Math.min(1, Math.max(0, low))) + '%';
      }
    }
  }
}
