// A compass with the direction of north on the screen.
import * as THREE from 'three';

const direction = new THREE.Vector3(), colors = {};
function color(name) { return colors[name] ??= themeColor(name); }
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { for (const name in colors) delete colors[name]; });

/** Draws it if the view has turned. @param plan  whether the view is the plan, north up. */
export function drawCompass(canvas, camera, plan) {
  camera.getWorldDirection(direction);
  const heading = plan ? 0 : Math.atan2(direction.x, -direction.z);  // of the camera, from north to east
  const turned = heading.toFixed(3);
  if (canvas.dataset.heading === turned) return;
  canvas.dataset.heading = turned;
  const c = canvas.getContext('2d'), half = canvas.width / 2;
  c.clearRect(0, 0, canvas.width, canvas.height);
  c.save();
  c.translate(half, half);
  c.fillStyle = color('card');
  c.beginPath();
  c.arc(0, 0, half - 2, 0, 2 * Math.PI);
  c.fill();
  c.font = '600 11px system-ui, "DejaVu Sans", sans-serif';
  c.textAlign = 'center';
  c.textBaseline = 'middle';
  for (const [name, bearing] of [['N', 0], ['E', 90], ['S', 180], ['W', 270]]) {
    const angle = bearing * Math.PI / 180 - heading;
    c.fillStyle = color(name === 'N' ? 'bad' : 'soft');
    c.fillText(name, (half - 11) * Math.sin(angle), (11 - half) * Math.cos(angle));
  }
  c.rotate(-heading);
  for (const [name, side] of [['bad', -1], ['soft', 1]]) {
    c.fillStyle = color(name);
    c.beginPath();
    c.moveTo(0, side * (half - 20));
    c.lineTo(5, 0);
    c.lineTo(-5, 0);
    c.fill();
  }
  c.restore();
}
