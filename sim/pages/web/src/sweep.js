'use strict';
// The sections of a sweep's page, which follow the chosen column and the chosen point.

class SweepSections {
  constructor(host, data, table, on) {
    const points = this.points = new SweepPoints(data, table), section = (id) => host(id + '-card');
    const chosen = {choosePoint: (i) => this.choosePoint(i, on), changeColumn: () => this.changeColumn()};
    this.ranking = new RankingView(section('answer'), points, chosen);
    const {choice, best} = this.ranking;
    this.views = [this.ranking];
    const add = (id, make_view) => {
      section(id).hidden = false;
      this.views.push(make_view(section(id)));
    };
    section('answer').hidden = false;
    section('answer').after(host('head').querySelector('.tiles'));
    if (data.sweep.minimize) add('convergence', (card) => new ConvergenceView(card, points, chosen));
    add('pareto', (card) => new ParetoView(card, points, choice, chosen));
    if (points.paths.length > 1) add('heat', (card) => new HeatMap(card, points, choice, chosen));
    if (!data.sweep.minimize && points.paths.length > 1) add('effects', (card) => new EffectsView(card, points, choice));
    add('slices', (card) => new SlicesView(card.querySelector('.slices'), points, choice, best, chosen));
    add('parallel', (card) => new ParallelView(card, points, choice, chosen));
  }
  changeColumn() {
    for (const view of this.views) view.setChoice?.(this.ranking.choice);
  }
  choosePoint(i, on) {
    for (const view of this.views) view.setChosen?.(i);
    on.choose(this.points.points[i].rows[0]);
  }
  redraw() {
    for (const view of this.views) {
      view.axes?.draw?.();
      for (const panel of view.panels ?? []) panel.axes.draw();
      if (view instanceof ParallelView) view.draw();
    }
  }
}
