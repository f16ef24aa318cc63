// Cameras of the viewer: orbit, chase, plan, and onboard.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

/** Frame C of an onboard camera, x right, y down, z forward, to the camera of three.js, x right, y up, z backward. */
const turned = new THREE.Quaternion(1, 0, 0, 0);

export class Views {
  /** @param craft  group of the vehicle in W. @param inV  W to V. @param R_VW  matrix. @param cameras  of the data. @param span  of the scene, m. */
  constructor(canvas, craft, inV, R_VW, cameras, span) {
    Object.assign(this, {craft, inV, cameras, span, kind: 'orbit', seen: null, aspect: 1});
    this.R_VW = new THREE.Quaternion().setFromRotationMatrix(R_VW);
    this.perspective = new THREE.PerspectiveCamera(50, 1, 0.05, 3000);
    this.plan = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 3000);
    this.plan.up.set(0, 0, -1);  // north
    this.plan_m = Math.min(span, 60);
    this.orbit = new OrbitControls(this.perspective, canvas);
    this.orbit.maxPolarAngle = 0.499 * Math.PI;
    this.behind_m = Math.max(3, 5 * craft.reach);
    canvas.addEventListener('wheel', (event) => {
      if (this.kind === 'plan') this.plan_m = Math.min(2 * span, Math.max(4, this.plan_m * Math.exp(event.deltaY / 600)));
    }, {passive: true});
  }
  get names() { return [['orbit', 'orbit'], ['chase', 'chase'], ['plan', 'plan'], ...this.cameras.map(({role}) => ['onboard:' + role, `onboard: ${role}`])]; }
  get camera() { return this.kind === 'plan' ? this.plan : this.perspective; }
  /** Height of the view at the distance 1 m, or of the plan, m. */
  get label_m() { return this.kind === 'plan' ? this.plan_m : 2 * Math.tan(this.perspective.fov * Math.PI / 360); }
  get onboard() { return this.kind.startsWith('onboard:'); }
  craftInV() { return this.inV(...this.craft.group.position.toArray()); }

  set(kind) {
    this.kind = kind;
    this.orbit.enabled = kind === 'orbit';
    this.perspective.fov = this.onboard ? this.mount().fov_deg : 50;
    this.perspective.near = this.onboard ? 0.03 : 0.2;
    this.seen = null;
    if (kind === 'orbit') {
      const {x, y, z} = this.craftInV(), far = 2 * this.behind_m;
      this.perspective.up.set(0, 1, 0);
      this.orbit.target.set(x, y, z);
      this.perspective.position.set(x + 0.6 * far, y + 0.8 * far, z + 1.2 * far);
      this.orbit.update();
    }
    this.resize(this.aspect);
  }
  mount() { return this.cameras.find(({role}) => 'onboard:' + role === this.kind); }
  resize(aspect) {
    this.aspect = this.perspective.aspect = aspect;
    this.perspective.updateProjectionMatrix();
  }

  /** Moves the camera with the vehicle. */
  follow() {
    const now = this.craftInV(), {group} = this.craft;
    if (this.kind === 'chase') {
      const yaw = group.rotation.z, p = group.position, behind = this.behind_m;
      this.perspective.up.set(0, 1, 0);
      this.perspective.position.copy(this.inV(p.x - behind * Math.cos(yaw), p.y - behind * Math.sin(yaw), p.z - 0.4 * behind));
      this.perspective.lookAt(now);
    } else if (this.kind === 'plan') {
      const half = this.plan_m / 2;
      Object.assign(this.plan, {left: -half * this.aspect, right: half * this.aspect, top: half, bottom: -half});
      this.plan.position.set(now.x, now.y + 500, now.z);
      this.plan.lookAt(now);
      this.plan.updateProjectionMatrix();
    } else if (this.onboard) {
      const {p, q} = this.mount();
      group.updateMatrix();
      this.perspective.position.copy(this.inV(...new THREE.Vector3(...p).applyMatrix4(group.matrix).toArray()));
      this.perspective.quaternion.copy(this.R_VW).multiply(group.quaternion).multiply(new THREE.Quaternion(...q)).multiply(turned);
    } else {
      if (this.seen) this.perspective.position.add(now.clone().sub(this.seen));
      this.orbit.target.copy(now);
      this.orbit.update();
    }
    this.seen = now;
  }
}
