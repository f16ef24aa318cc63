// The flight as it happens: server-sent events extend the path; buttons pause and step the simulation.

const degreesPerRadian = 180 / Math.PI;

export class LiveFlight {
  /** @param data  of the page; its path and statuses grow. @param on  {grown(), images(sheet, film), paused(is_paused), ended(result)}. */
  constructor(data, on) {
    Object.assign(this, {data, on, paused: false});
    this.source = new EventSource('/events');
    const listen = (name, action) => this.source.addEventListener(name, (event) => action(JSON.parse(event.data)));
    listen('states', (states) => { for (const state of states) this.add(state); on.grown(); });
    listen('images', ({sheet, film}) => on.images(sheet, film));
    listen('paused', (paused) => { this.paused = paused; on.paused(paused); });
    listen('end', (result) => {
      this.source.close();
      on.ended(result);
    });
  }
  /** @param state  [t, north, east, down, roll, pitch, yaw, clearance, speed, status]. */
  add([t_s, north, east, down, roll, pitch, yaw, clearance, speed, status]) {
    const {path, statuses} = this.data;
    if (path.t_s.length && t_s <= path.t_s.at(-1)) return;
    const values = {t_s, north_m: north, east_m: east, down_m: down, roll_rad: roll, pitch_rad: pitch, yaw_rad: yaw, clearance_m: clearance, speed_mps: speed,
      altitude_m: -down, roll_deg: roll * degreesPerRadian, pitch_deg: pitch * degreesPerRadian};
    for (const [name, value] of Object.entries(values)) path[name].push(value);
    if (status && statuses.at(-1)?.[1] !== status) statuses.push([t_s, status]);
  }
  send(order) { return fetch('/' + order, {method: 'POST'}).catch(() => {}); }  // the flight may just have ended
}

/** Returns the plots of a live path. They share its arrays. */
export function livePanels(path) {
  Object.assign(path, {altitude_m: [], roll_deg: [], pitch_deg: []});  // grow with the others
  const panel = (title, unit, series, more = {}) => ({section: 'Command and motion', title, unit, note: '', lowest: null, highest: null, limits: [], t_s: path.t_s,
    series: series.map(([label, values]) => ({label, role: '', values})), ...more});
  return [panel('Clearance of the hull', 'm', [['obstacles', path.clearance_m]], {lowest: 0}), panel('Speed', 'm/s', [['speed', path.speed_mps]]),
    panel('Altitude', 'm', [['true', path.altitude_m]]), panel('Attitude', 'deg', [['roll', path.roll_deg], ['pitch', path.pitch_deg]])];
}
