'use strict';
// Builds the pages about a vehicle from their data: trim over speed, responses over time or frequency.

const speedAxis = {key: 'speed_mps', label: 'speed through the air, m/s', symbol: 'V', unit: 'm/s', points: true};

function main() {
  const {title, notes, panels, axis = speedAxis} = JSON.parse(document.getElementById('data').textContent);
  const head = document.getElementById('head');
  head.append(make('h1', '', title), ...notes.map((note) => make('p', 'soft', note)));
  const hints = {[panels[0].section]: 'drag to zoom, double click to see all'};
  const on = {hover: (speed) => charts.setTime(speed), pick: () => {}};
  const charts = new Charts(document.getElementById('charts'), panels, hints, on, [], axis);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => charts.build());
}
main();
