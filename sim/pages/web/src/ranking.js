'use strict';
// The answer of a sweep: its best point, and the ranking of all points by a column.

const rankedAtFirst = 10;

class RankingView {
  /** @param on  {choosePoint(i), changeColumn()}. */
  constructor(host, points, on) {
    Object.assign(this, {host, points, on, most: rankedAtFirst, chosen: null});
    const {sweep} = points, optimized = sweep.minimize && points.has(sweep.minimize);
    const column = optimized ? sweep.minimize : points.varies('passed') ? 'passed'
      : points.has('min_obstacle_clearance_m') ? 'min_obstacle_clearance_m' : points.columns[0].name;
    const head = host.appendChild(make('div', 'card-head'));
    head.append(make('h2', '', 'Best point'));
    const controls = head.appendChild(make('div', 'controls'));
    this.column = columnSelect(controls, 'column', points.columns, column, () => {
      this.better.value = points.better(this.column.value);
      this.change();
    });
    this.better = controls.appendChild(make('select'));
    this.better.ariaLabel = 'direction of the column';
    for (const word of ['less', 'more']) this.better.appendChild(make('option', '', word + ' is better')).value = word;
    this.better.value = points.better(column);
    this.better.addEventListener('change', () => this.change());
    const label = controls.appendChild(make('label'));
    this.passedFirst = label.appendChild(make('input'));
    this.passedFirst.type = 'checkbox';
    this.passedFirst.checked = true;
    label.append('points with failed flights last');
    this.passedFirst.addEventListener('change', () => this.change());
    this.answer = host.appendChild(make('div', 'answer'));
    this.list = host.appendChild(make('div', 'scroll'));
    this.draw();
  }
  get choice() { return {column: this.column.value, less: this.better.value === 'less', passedFirst: this.passedFirst.checked}; }
  get best() { return this.order[0]; }
  change() {
    this.draw();
    this.on.changeColumn();
  }
  setChosen(i) {
    this.chosen = i;
    for (const line of this.list.querySelectorAll('tbody tr')) line.classList.toggle('chosen', Number(line.dataset.point) === i);
  }

  draw() {
    const {points, choice} = this;
    this.order = points.ranking(choice);
    const best = this.best, point = points.points[best];
    this.answer.replaceChildren(make('p', 'best', points.words(best)),
      make('p', 'soft', `mean of ${choice.column} ${meanWords(points.of(choice.column)[best], points.unit(choice.column))} over ` +
        `${countOf(point.rows.length, 'seed')}; ${passedWords(point, 'flight')}; ${this.tieWords()}. It is flown by`));
    addCommand(this.answer, points.command(best));
    this.drawList();
  }
  /** "best of 9 points", "best of 2 flown of 9 points", or the number of points with an equal mean. */
  tieWords() {
    const {points, order, best} = this, figures = points.of(this.choice.column), all = points.points.length;
    const flown = points.points.filter(({missing, rows}) => missing < rows.length).length;
    const count = (flown < all ? `${flown} flown of ` : '') + countOf(all, 'point');
    const failing = (i) => this.choice.passedFirst && !noneFailed(points.points[i]);
    const ties = order.filter((i) => figures[i].mean === figures[best].mean && failing(i) === failing(best)).length;
    return ties === 1 ? `best of ${count}` : `${ties} of ${count} share this best mean, ordered by minimum clearance`;
  }
  drawList() {
    const {points, choice, order} = this, figures = points.of(choice.column);
    const element = make('table', 'ranking'), head = element.appendChild(make('thead'));
    addHeadings(head, [['rank', 'number'], ...points.headings().map((name) => [name, 'number']), [`mean of ${points.label(choice.column)}`, 'number'],
      ['95 % interval', 'number'], ['', ''], ['passed', 'number']]);
    const body = element.appendChild(make('tbody'));
    const [least, most] = finiteRange(figures.flatMap(({mean, low, high}) => [mean, low, high]));
    const share = (v) => 100 * (v - least) / (most - least || 1) + '%';
    order.slice(0, this.most).forEach((i, rank) => {
      const {mean, low, high} = figures[i], point = points.points[i], {values} = point;
      const line = addRow(body, [[String(rank + 1), 'number'], ...values.map((value) => [valueWords(value), 'number']), [short(mean), 'number'],
        [low === null ? '–' : `${short(low)} to ${short(high)}`, 'number'], ['', ''],
        [passedWords(point), noneFailed(point) ? 'number' : 'number bad-text']]);
      line.dataset.point = i;
      line.className = i === this.chosen ? 'chosen' : '';
      onChoose(line, () => this.on.choosePoint(i));
      if (mean === null) return;
      const bar = line.children[line.children.length - 2].appendChild(make('span', 'rate'));
      if (low !== null) {
        const span = bar.appendChild(make('i'));
        span.style.left = share(low);
        span.style.width = 100 * (high - low) / (most - least || 1) + '%';
      }
      bar.appendChild(make('b')).style.left = share(mean);
    });
    this.list.replaceChildren(element);
    if (order.length <= this.most) return;
    const more = this.list.appendChild(make('button', 'more', `show ${Math.min(100, order.length - this.most)} more of ${order.length}`));
    more.addEventListener('click', () => { this.most += 100; this.drawList(); });
  }
}
