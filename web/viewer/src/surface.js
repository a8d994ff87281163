// A mesh as it is drawn: flat triangles in the colours that are asked for, edges of defects, and the places of defects.
import {BufferAttribute, BufferGeometry, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh, Points, Scene, ShaderMaterial,
  Vector3, Vector4} from 'three';

import {plain} from './words.js';

const PLAIN = [200, 204, 210];
// Of triangles that are seen from behind: nobody should see that, unless a solid is cut open.
const BEHIND = [0.8, 0.25, 0.2];
const BEHIND_SOLID = [0.5, 0.54, 0.62];

// Each corner is a vertex of its own, so its number says which corner of the triangle it is.
const VERTEX = `
attribute vec3 tint;
varying vec3 place; varying vec3 seen; varying vec3 colour; varying vec3 corner;
void main() {
  place = position;
  colour = tint;
  int which = gl_VertexID % 3;
  corner = vec3(float(which == 0), float(which == 1), float(which == 2));
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  seen = view.xyz;
  gl_Position = projectionMatrix * view;
}`;
const FRAGMENT = `
uniform vec4 cut; uniform bool cutting; uniform bool wires; uniform bool kinds; uniform vec3 behind;
varying vec3 place; varying vec3 seen; varying vec3 colour; varying vec3 corner;
void main() {
  if (cutting && dot(place, cut.xyz) > cut.w) discard;
  vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
  float light = 0.42 + 0.5 * max(dot(normal, normalize(vec3(0.25, 0.5, 0.85))), 0.0) + 0.08 * normal.y;
  vec3 base = (gl_FrontFacing ? colour : kinds ? 0.7 * colour : behind) * light;
  if (wires) {
    vec3 width = fwidth(corner);
    vec3 near = smoothstep(vec3(0.0), width * 1.3, corner);
    base = mix(base * 0.35, base, min(near.x, min(near.y, near.z)));
  }
  gl_FragColor = vec4(base, 1.0);
}`;
const DOT_VERTEX = `
attribute vec3 tint; varying vec3 colour; varying vec3 place; uniform float size;
void main() {
  colour = tint;
  place = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_Position.z -= 0.001 * gl_Position.w;  // in front of what it lies in
  gl_PointSize = size;
}`;
const DOT_FRAGMENT = `
uniform vec4 cut; uniform bool cutting; uniform bool ring;
varying vec3 colour; varying vec3 place;
void main() {
  if (cutting && dot(place, cut.xyz) > cut.w) discard;
  float from = length(gl_PointCoord - 0.5) * 2.0;
  if (from > 1.0 || (ring && from < 0.66)) discard;
  gl_FragColor = vec4(from > 0.72 && !ring ? vec3(1.0) : colour, 1.0);
}`;

function dots(places, tints, options) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(places), 3));
  geometry.setAttribute('tint', new BufferAttribute(new Uint8Array(tints), 3, true));
  const uniforms = {size: {value: options.size}, ring: {value: options.ring}, ...options.cut};
  const material = new ShaderMaterial({uniforms, vertexShader: DOT_VERTEX, fragmentShader: DOT_FRAGMENT, depthTest: !options.ring});
  const points = new Points(geometry, material);
  points.frustumCulled = false;
  points.renderOrder = options.ring ? 3 : 2;
  return points;
}

export class Surface {
  // `facts` are those of the mesh in the page's data, `cut` the uniforms of the plane that all share, `plane` the
  // same for three.js.
  constructor(facts, data, grid, cut, plane, looks) {
    this.facts = facts;
    this.data = data;
    this.grid = grid;
    this.cut = cut;
    this.plane = plane;
    this.looks = looks;
    this.scene = new Scene();
    this.mesh = new Mesh(this.geometry(), new ShaderMaterial({
      uniforms: {...cut, wires: {value: false}, kinds: {value: false}, behind: {value: new Vector3(...facts.check.valid_solid ? BEHIND_SOLID : BEHIND)}},
      vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2}));
    this.mesh.frustumCulled = false;
    this.scene.add(this.mesh);
    this.markers = new Map(looks.map((look) => [look.key, this.marker(look)]));
    this.ring = dots([0, 0, 0], [20, 110, 240], {size: 30 * devicePixelRatio, ring: true, cut: {cut: {value: new Vector4()}, cutting: {value: false}}});
    this.ring.visible = false;
    this.scene.add(this.ring);
  }

  geometry() {
    const {corners, places} = this.data;
    const position = new Float32Array(3 * corners.length);
    for (let i = 0; i < corners.length; ++i) {
      for (let axis = 0; axis < 3; ++axis) position[3 * i + axis] = this.grid.drawn(places[3 * corners[i] + axis], axis);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    geometry.setAttribute('tint', new BufferAttribute(new Uint8Array(3 * corners.length), 3, true));
    return geometry;
  }

  // What shows where a defect is: its edges, or a dot at each place. Nothing where there is none.
  marker(look) {
    const {at, ends} = this.facts.places[look.key];
    const all = ends.length > 0 ? ends : at;
    const places = [];
    for (let i = 0; i < all.length; ++i) places.push(this.grid.drawn(all[i], i % 3));
    if (places.length === 0) return null;
    let shown;
    if (ends.length > 0) {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(new Float32Array(places), 3));
      shown = new LineSegments(geometry, new LineBasicMaterial({color: new Color(`rgb(${look.colour.join(',')})`), clippingPlanes: [this.plane]}));
      shown.renderOrder = 1;
    } else {
      const tints = Array.from({length: places.length}, (_, i) => look.colour[i % 3]);
      shown = dots(places, tints, {size: 8 * devicePixelRatio, ring: false, cut: this.cut});
    }
    shown.frustumCulled = false;
    this.scene.add(shown);
    return shown;
  }

  // `mode` is "defects", "fate" or "plain"; `layers` the keys of the defects that are shown.
  paint(mode, layers) {
    const tint = this.mesh.geometry.getAttribute('tint');
    const shown = this.looks.filter((look) => layers.has(look.key) && look.bit !== null);
    for (let t = 0; t < this.facts.shown; ++t) {
      let colour = PLAIN;
      if (mode === 'fate') colour = this.facts.kinds[this.data.kinds[t]].colour;
      if (mode === 'defects') colour = (shown.find((look) => this.data.marks[t] >> look.bit & 1) ?? {colour: PLAIN}).colour;
      for (let corner = 0; corner < 3; ++corner) tint.array.set(colour, 9 * t + 3 * corner);
    }
    tint.needsUpdate = true;
    this.mesh.material.uniforms.kinds.value = mode === 'fate';  // also of turned triangles
    for (const [key, marker] of this.markers) if (marker) marker.visible = mode === 'defects' && layers.has(key);
  }

  wires(on) {
    this.mesh.material.uniforms.wires.value = on;
  }

  corner(triangle, which) {
    return new Vector3().fromBufferAttribute(this.mesh.geometry.getAttribute('position'), 3 * triangle + which);
  }

  // The triangle whose middle is nearest to a place, of those that have the bit among their marks; undefined if none has.
  nearest(place, bit) {
    const {array} = this.mesh.geometry.getAttribute('position');
    const along = (t, axis) => (array[9 * t + axis] + array[9 * t + 3 + axis] + array[9 * t + 6 + axis]) / 3 - place[axis];
    let least = Infinity, found;
    for (let t = 0; t < this.facts.shown; ++t) {
      if (bit !== null && !(this.data.marks[t] >> bit & 1)) continue;
      const distance = along(t, 0) ** 2 + along(t, 1) ** 2 + along(t, 2) ** 2;
      if (distance < least) [least, found] = [distance, t];
    }
    return found;
  }

  // Where the surface faces at a place where there is a defect.
  normalAt(place, bit) {
    const triangle = this.nearest(place, bit) ?? this.nearest(place, null);
    if (triangle === undefined) return new Vector3();
    const [a, b, c] = [0, 1, 2].map((which) => this.corner(triangle, which));
    return b.sub(a).cross(c.sub(a)).normalize();
  }

  // What a triangle is, in words.
  describe(triangle) {
    const found = this.looks.filter((look) => look.bit !== null && this.data.marks[triangle] >> look.bit & 1).map((look) => look.words);
    const kind = this.facts.kinds.length > 0 ? [plain(this.facts.kinds[this.data.kinds[triangle]].words)] : [];
    return [...kind, ...(found.length > 0 ? found : ['nothing wrong with it'])].join('; ');
  }
}
