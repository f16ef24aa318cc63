// Plots next to the view, at the time of the view.

const HEIGHT = 120;    // of a plot, px
const APART_MS = 60;  // between two movements of the cursors

export class Plots {
  /** @param host  element. @param select  of the section. @param panels  of the data. @param on  {pick(t)}. */
  constructor(host, select, panels, on) {
    Object.assign(this, {host, panels, on, last_ms: 0, now_s: 0});
    this.sections = [...new Set(panels.map(({section}) => section))];
    for (const name of this.sections) select.append(make('option', '', name));
    select.parentElement.hidden = this.sections.length < 2;
    select.addEventListener('change', () => this.open(select.value));
    if (this.sections.length) this.open(this.sections[0]);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.charts?.build());
  }
  open(section) {
    this.host.replaceChildren();
    const shown = this.panels.filter((panel) => panel.section === section);
    this.charts = new Charts(this.host, shown, {}, {hover: () => {}, pick: (t) => this.on.pick(t)}, [], timeAxis, HEIGHT);
    this.charts.setTime(this.now_s);
  }
  setTime(t_s, now_ms) {
    this.now_s = t_s;
    if (now_ms - this.last_ms < APART_MS) return;
    this.last_ms = now_ms;
    this.charts?.setTime(t_s);
  }
  /** Shows the grown values of a live flight. */
  grow() {
    for (const {u, panel} of this.charts?.plots ?? []) u?.setData([panel.t_s, ...panel.series.map(({values}) => values)]);
  }
}
