// Writes a flight of one rigid body by MuJoCo as a log of compare-log, world with z up, 100 Hz, 20.1 s.
//
// usage: node fly.mjs CASE LOG.csv    CASE: free, spin, flip, drag
//
// The drag is a force of the user: -|v| C v along the body axes. MuJoCo holds such forces constant over a step, so each step
// is repeated with the force of its middle (midpoint method).
import { writeFileSync } from 'node:fs';
import loadMujoco from '@mujoco/mujoco';

const [name, file] = process.argv.slice(2);
const mujoco = await loadMujoco();

const cases = {
  free: { velocity: [3, -2, 4], rates: [1.0, 0.6, -2.0], drag: [0, 0, 0] },
  spin: { velocity: [0, 0, 0], rates: [0.3, 0.2, 8.0], drag: [0, 0, 0] },
  flip: { velocity: [0, 0, 0], rates: [0.01, 3.0, 0.0], drag: [0, 0, 0] },
  drag: { velocity: [5, 2, 3], rates: [0.5, 0.3, 1.0], drag: [0.02, 0.03, 0.05] },
};
const { velocity, rates, drag } = cases[name];
const step = 0.0005, rowsPerSecond = 100, rows = 2011;
const model = mujoco.MjModel.from_xml_string(`<mujoco>
  <option timestep="${step}" integrator="RK4" gravity="0 0 -9.81"><flag contact="disable"/></option>
  <worldbody><body name="vehicle"><freejoint/><inertial pos="0 0 0" mass="0.7" diaginertia="0.007 0.009 0.012"/></body></worldbody>
</mujoco>`);
const data = new mujoco.MjData(model);
data.qvel.set([...velocity, ...rates]);

function turn([w, x, y, z], v, inverse) {
  const s = inverse ? -1 : 1, q = [s * x, s * y, s * z];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const t = cross(q, v).map((k) => 2 * k), u = cross(q, t);
  return v.map((k, i) => k + w * t[i] + u[i]);
}

function applyDrag() {
  const q = Array.from(data.qpos.subarray(3, 7)), v = turn(q, Array.from(data.qvel.subarray(0, 3)), true);
  const speed = Math.hypot(...v);
  data.xfrc_applied.set(turn(q, v.map((k, i) => -speed * drag[i] * k), false), 6);
}

function restore(qpos, qvel, time) {
  data.qpos.set(qpos);
  data.qvel.set(qvel);
  data.time = time;
}

function advance() {
  if (name === 'drag') {
    const qpos = data.qpos.slice(), qvel = data.qvel.slice(), time = data.time;
    applyDrag();
    model.opt.timestep = 0.5 * step;
    mujoco.mj_step(model, data);
    applyDrag();
    model.opt.timestep = step;
    restore(qpos, qvel, time);
  }
  mujoco.mj_step(model, data);
}

const lines = ['t_s,north_m,east_m,down_m,qw,qx,qy,qz,v_north_mps,v_east_mps,v_down_mps,p_radps,q_radps,r_radps,' +
  'motor_0_radps,motor_1_radps,motor_2_radps,motor_3_radps'];
for (let row = 0; row < rows; ++row) {
  lines.push([row / rowsPerSecond, ...data.qpos, ...data.qvel, 0, 0, 0, 0].join(','));
  for (let k = 0; k < Math.round(1 / (rowsPerSecond * step)); ++k) advance();
}
writeFileSync(file, lines.join('\n') + '\n');
