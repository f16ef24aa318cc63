// The scene as the cameras see it: its triangles, textures, light, sky and haze.
import * as THREE from 'three';

// Colors are those of the textures times the light, without gamma, as the simulator's renderers compute them.
THREE.ColorManagement.enabled = false;
// Haze as the simulator's: contrast falls to 5 % at the visibility, exponentially in the distance.
THREE.ShaderChunk.fog_fragment = THREE.ShaderChunk.fog_fragment.replace('exp( - fogDensity * fogDensity * vFogDepth * vFogDepth )', 'exp( - fogDensity * vFogDepth )');

/** Returns the bytes of a text in base64. */
export function bytesOf(text) { return Uint8Array.from(atob(text), (c) => c.charCodeAt(0)); }

function texturesOf(jpegs, anisotropy, redraw) {
  const loader = new THREE.TextureLoader();
  return jpegs.map((jpeg) => {
    const texture = loader.load('data:image/jpeg;base64,' + jpeg, redraw);
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    texture.flipY = false;  // row 0 is at v = 0
    texture.anisotropy = anisotropy;
    return texture;
  });
}

/** Returns the triangles of a mesh of the data as one group, one mesh for each texture. */
function meshOf({count, low, step, p, uv, n, texture, index}, looks) {
  const group = new THREE.Group(), steps = new Uint16Array(bytesOf(p).buffer), places = new Float32Array(3 * count);
  for (let i = 0; i < places.length; ++i) places[i] = low[i % 3] + steps[i] * step[i % 3];
  const attributes = {position: new THREE.BufferAttribute(places, 3), uv: new THREE.BufferAttribute(new Float32Array(bytesOf(uv).buffer), 2),
    normal: new THREE.BufferAttribute(new Int8Array(bytesOf(n).buffer), 3, true)};
  const layers = new Uint16Array(bytesOf(texture).buffer), indices = new Uint32Array(bytesOf(index).buffer), byLayer = new Map();
  for (let i = 0; i < indices.length; i += 3) {
    const layer = layers[indices[i]];
    if (!byLayer.has(layer)) byLayer.set(layer, []);
    byLayer.get(layer).push(indices[i], indices[i + 1], indices[i + 2]);
  }
  for (const [layer, list] of byLayer) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, values] of Object.entries(attributes)) geometry.setAttribute(name, values);
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(list), 1));
    const mesh = group.add(new THREE.Mesh(geometry, looks[layer])).children.at(-1);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;
  }
  return group;
}

/** Returns the sky, a large sphere around the camera. @param R_VW  matrix. */
function skyOf({horizon, zenith}) {
  const color = (rgb) => ({value: new THREE.Color(...rgb)});
  const sky = new THREE.Mesh(new THREE.SphereGeometry(1500, 32, 16), new THREE.ShaderMaterial({
    uniforms: {horizon: color(horizon), zenith: color(zenith)}, side: THREE.BackSide, depthWrite: false, fog: false,
    vertexShader: 'varying vec3 ray; void main() { ray = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
    fragmentShader: 'uniform vec3 horizon, zenith; varying vec3 ray; void main() { gl_FragColor = vec4(mix(horizon, zenith, max(normalize(ray).y, 0.0)), 1.0); }'}));
  sky.frustumCulled = false;
  sky.renderOrder = -1;
  return sky;
}

/**
 * Adds the scene to a stage. Returns {fixed, movers, sky}: groups in W and in M, and the sky, which follows the camera.
 * @param inW  group whose children are in W. @param redraw  called when a texture has loaded.
 */
export function addWorld(surfaces, stage, inW, renderer, bounds, redraw) {
  const {lights, sky: colors, textures, meshes} = surfaces, haze = new THREE.Color(...colors.horizon);
  const maps = texturesOf(textures, Math.min(8, renderer.capabilities.getMaxAnisotropy()), redraw);
  const looks = maps.map((map) => new THREE.MeshLambertMaterial({map}));
  const [fixed, ...movers] = meshes.map((mesh) => meshOf(mesh, looks));
  inW.add(fixed);
  // A Lambert surface reflects 1 / pi of the light in three.js.
  stage.add(new THREE.AmbientLight(0xffffff, Math.PI * lights.ambient));
  const sun = inW.add(new THREE.DirectionalLight(0xffffff, Math.PI * lights.sun)).children.at(-1);
  const [n0, n1, e0, e1] = bounds, center = [(n0 + n1) / 2, (e0 + e1) / 2, 0], reach = 0.75 * Math.max(n1 - n0, e1 - e0);
  sun.position.set(...lights.to_sun.map((v, i) => center[i] + 2 * reach * v));
  sun.target.position.set(...center);
  inW.add(sun.target);
  if (lights.shadows) {
    renderer.shadowMap.enabled = sun.castShadow = true;
    renderer.shadowMap.autoUpdate = false;  // only fixed solids cast shadows
    renderer.shadowMap.needsUpdate = true;
    sun.shadow.mapSize.set(4096, 4096);
    Object.assign(sun.shadow.camera, {left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 4 * reach});
    sun.shadow.bias = -0.002;
  }
  if (colors.visibility_m) stage.fog = new THREE.FogExp2(haze, 3 / colors.visibility_m);
  const sky = stage.add(skyOf(colors)).children.at(-1);
  return {fixed, movers, sky, textures: maps.length};
}
