// The images of the cameras as textures at the ends of their frustums.
import * as THREE from 'three';

import {bytesOf} from './replay_world.js';

/** Returns the screen of a camera in B, at a distance, m: the image where its rays end, and its edges. */
function screenOf({p, rays, columns, rows, sheet}, texture, distance_m) {
  const places = [], uv = [], faces = [], at = (c, r) => r * columns + c;
  rays.forEach((ray, i) => {
    const column = i % columns, row = Math.floor(i / columns), [x, y, width, height] = sheet;
    places.push(...(ray ?? [0, 0, 0]).map((v, axis) => p[axis] + distance_m * v));
    uv.push(x + width * column / (columns - 1), y + height * row / (rows - 1));
  });
  for (let r = 0; r + 1 < rows; ++r) {
    for (let c = 0; c + 1 < columns; ++c) {
      const corners = [at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1)];
      if (corners.every((i) => rays[i])) faces.push(corners[0], corners[1], corners[2], corners[0], corners[2], corners[3]);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute('uv', new THREE.Float32BufferAttribute(uv, 2));
  geometry.setIndex(faces);
  const group = new THREE.Group();
  group.add(new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({map: texture, side: THREE.DoubleSide, fog: false, transparent: true, opacity: 0.92})));
  const edges = [], corner = (i) => places.slice(3 * i, 3 * i + 3);
  const border = [[0, 0], [columns - 1, 0], [columns - 1, rows - 1], [0, rows - 1]].map(([c, r]) => at(c, r));
  border.forEach((i, k) => {
    if (rays[i]) edges.push(...p, ...corner(i));
    if (rays[i] && rays[border[(k + 1) % 4]]) edges.push(...corner(i), ...corner(border[(k + 1) % 4]));
  });
  const lines = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(edges, 3));
  group.add(new THREE.LineSegments(lines, new THREE.LineBasicMaterial({color: 0xf0c040, fog: false, transparent: true, opacity: 0.6})));
  return group;
}

/** The camera images: from the film in the page, or from images of the live view. */
export class Screens {
  /** @param reach_m  of the vehicle. */
  constructor({cameras, film, film_rate_hz}, reach_m) {
    Object.assign(this, {group: new THREE.Group(), rate_hz: film_rate_hz, video: null, t_s: 0});
    this.canvas = document.getElementById('images');
    this.texture = new THREE.CanvasTexture(this.canvas);
    Object.assign(this.texture, {flipY: false, generateMipmaps: false, minFilter: THREE.LinearFilter});
    this.ways = cameras.map(({q}) => new THREE.Vector3(0, 0, 1).applyQuaternion(new THREE.Quaternion(...q)));
    for (const camera of cameras) this.group.add(screenOf(camera, this.texture, 1.6 * reach_m));
    this.group.visible = this.has_images = false;
    if (film) {
      this.video = document.createElement('video');
      this.video.muted = true;
      this.video.preload = 'auto';
      for (const name of ['seeked', 'loadeddata']) {
        this.video.addEventListener(name, () => {
          this.paint(this.video, this.video.videoWidth, this.video.videoHeight);
          this.setTime(this.t_s);
        });
      }
      this.video.src = URL.createObjectURL(new Blob([bytesOf(film)], {type: 'video/webm'}));
    }
  }
  paint(image, width, height) {
    if (this.canvas.width !== width || this.canvas.height !== height) {
      [this.canvas.width, this.canvas.height] = [width, height];
      this.texture.dispose();
    }
    this.canvas.getContext('2d', {willReadFrequently: true}).drawImage(image, 0, 0);
    this.texture.needsUpdate = this.has_images = true;
    document.getElementById('images-card').hidden = false;
  }
  /** Hides the images between the viewer and the vehicle, which are seen from behind. @param viewer_B  direction to the viewer. */
  face(viewer_B) {
    this.group.children.forEach((screen, i) => { screen.visible = this.ways[i].dot(viewer_B) < 0.2; });
  }
  /** Shows the images of an instant. Seeks one frame at a time. */
  setTime(t_s) {
    this.t_s = t_s;
    const {video} = this;
    if (!video || video.readyState < 1 || video.seeking) return;
    const row = Math.min(Math.floor(t_s * this.rate_hz + 1e-6), Math.ceil(video.duration * this.rate_hz) - 1);
    if (row === this.row) return;
    this.row = row;
    video.currentTime = (row + 0.5) / this.rate_hz;
  }
}
