// SPDX-License-Identifier: MIT
// A mesh as it is drawn: flat triangles in the colours that are asked for, edges of defects, and the places of defects.
import {Box3, BufferAttribute, BufferGeometry, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh, Scene, ShaderMaterial, Vector3,
  Vector4} from 'three';

import {coarseMesh} from './coarse.js';
import {HEAT} from './heat.js';
import {partsOf} from './parts.js';
import {dots, FRAGMENT, VERTEX} from './shaders.js';
import {plain} from './words.js';

export const PLAIN = [200, 204, 210];
const CHOSEN = [40, 120, 240];  // of the part that was chosen in the list
// Of triangles that are seen from behind: nobody should see that, unless a solid is cut open.
const BEHIND = [0.8, 0.25, 0.2];
const BEHIND_SOLID = [0.5, 0.54, 0.62];
const WHILE_MOVING = 20000;  // triangles

export class Surface {
  // `facts` are those of the mesh in the page's data, `cut` the uniforms of the plane that all share, `plane` the same for three.js.
  constructor(facts, data, grid, cut, plane, page) {
    this.facts = facts;
    this.data = data;
    this.grid = grid;
    this.cut = cut;
    this.plane = plane;
    this.looks = page.looks;
    this.steps = page.scale?.steps;
    this.isValid = facts.check?.valid_solid ?? false;
    // Meshes that are checked alone may overlap: where they do, the back of one is not all that a cut shows.
    this.isSolid = this.isValid && facts.objects.length <= 1 && !(page.subject === 'boolean' && facts === page.meshes[0]);
    this.scene = new Scene();
    this.material = this.shading();
    this.mesh = this.added(data.corners);
    this.coarse = null;
    this.fileLooks = null;
    this.looksMesh = null;
    this.markers = new Map(page.looks.map((look) => [look.key, this.marker(look)]));
    const uncut = {cut: {value: new Vector4()}, cutting: {value: false}};
    this.ring = dots([0, 0, 0], [20, 110, 240], {size: 30 * devicePixelRatio, ring: true, cut: uncut});
    this.ring.visible = false;
    this.scene.add(this.ring);
  }

  shading() {
    const value = (what) => ({value: what});
    const uniforms = {...this.cut, wires: value(false), kinds: value(false), heated: value(false), top: value(1), solid: value(this.isSolid),
      heat_colours: value(HEAT.map((colour) => new Vector3(...colour).divideScalar(255))),
      behind: value(new Vector3(...this.isValid ? BEHIND_SOLID : BEHIND)), picture: value(null), pictured: value(false)};
    return new ShaderMaterial({uniforms, vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide, polygonOffset: true,
      polygonOffsetFactor: 1, polygonOffsetUnits: 2});
  }

  // Each corner is a vertex of its own.
  added(corners) {
    const {places, values} = this.data;
    const position = new Float32Array(3 * corners.length);
    for (let i = 0; i < corners.length; ++i) {
      for (let axis = 0; axis < 3; ++axis) position[3 * i + axis] = this.grid.drawn(places[3 * corners[i] + axis], axis);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    geometry.setAttribute('tint', new BufferAttribute(new Uint8Array(3 * corners.length), 3, true));
    if (values) geometry.setAttribute('heat', new BufferAttribute(Float32Array.from(corners, (p) => values[p] / this.steps), 1));
    const mesh = new Mesh(geometry, this.material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
    return mesh;
  }

  // Fewer triangles are drawn, if there are many.
  setCoarse(on) {
    if (on && !this.coarse && this.facts.shown > WHILE_MOVING) {
      const {source, corners} = coarseMesh(this.data, this.grid.most, WHILE_MOVING);
      this.coarse = this.added(corners);
      this.coarseSource = source;
      this.tintCoarse();
    }
    const coarse = on && this.coarse !== null;
    const looks = this.mode === 'looks' && this.looksMesh !== null;
    this.mesh.visible = !coarse && !looks;
    if (this.looksMesh) this.looksMesh.visible = !coarse && looks;
    if (this.coarse) this.coarse.visible = coarse;
  }

  tintCoarse() {
    if (!this.coarse) return;
    const [from, to] = [this.mesh, this.coarse].map(({geometry}) => geometry.getAttribute('tint'));
    this.coarseSource.forEach((t, i) => to.array.set(from.array.subarray(9 * t, 9 * t + 9), 9 * i));
    to.needsUpdate = true;
  }

  // What shows where a defect is: its edges, or a dot at each place. Nothing where there is none.
  marker(look) {
    const {at, ends} = this.facts.places[look.key] ?? {at: [], ends: []};
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

  colourOf(t, mode, shown) {
    if (this.isChosen?.(t)) return CHOSEN;
    if (mode === 'fate' && this.facts.kinds.length > 0) return this.facts.kinds[this.data.kinds[t]].colour;
    if (mode !== 'defects') return PLAIN;
    return (shown.find((look) => this.data.marks[t] >> look.bit & 1) ?? {colour: PLAIN}).colour;
  }

  // What it looks like in its file, which may be nothing.
  setLooks(looks) {
    this.fileLooks = looks;
  }

  // `mode` is "defects", "fate", "heat", "looks" or "plain"; `layers` the keys of the defects that are shown.
  paint(mode, layers) {
    this.mode = mode;
    const tint = this.mesh.geometry.getAttribute('tint');
    const looks = mode === 'looks' ? this.fileLooks : null;
    if (looks) this.showLooks();
    const shown = this.looks.filter((look) => layers.has(look.key) && look.bit !== null);
    for (let t = 0; t < this.facts.shown; ++t) {
      const colour = looks ? null : this.colourOf(t, mode, shown);
      for (let corner = 0; corner < 3; ++corner) tint.array.set(colour ?? looks.farColourOf(t, corner), 9 * t + 3 * corner);
    }
    tint.needsUpdate = true;
    this.tintCoarse();
    this.material.uniforms.kinds.value = mode === 'fate' || mode === 'heat';  // also of turned triangles
    this.material.uniforms.heated.value = mode === 'heat';
    for (const [key, marker] of this.markers) if (marker) marker.visible = mode === 'defects' && layers.has(key);
  }

  showLooks() {
    if (this.looksMesh) return;
    this.looksMesh = this.fileLooks.mesh(this.mesh.geometry.getAttribute('position').array, this.material);
    this.looksMesh.frustumCulled = false;
    this.scene.add(this.looksMesh);
  }

  // Colours the part in which a place is, or none; paint() shows it.
  choosePart(place) {
    this.isChosen = null;
    const triangle = place ? this.nearest(place, null) : undefined;
    if (triangle === undefined) return;
    this.parts ??= partsOf(this.data.corners);
    this.isChosen = (t) => this.parts[t] === this.parts[triangle];
  }

  // The first triangle of an object, and the one behind its last.
  objectRange(i) {
    const {objects} = this.facts;
    return [i > 0 ? objects[i - 1].until : 0, objects[i].until];
  }

  // Colours an object of a scene.
  chooseObject(i) {
    const [first, end] = this.objectRange(i);
    this.isChosen = (t) => t >= first && t < end;
  }

  // Around an object that has triangles.
  objectBox(i) {
    const [first, end] = this.objectRange(i);
    const box = new Box3().setFromArray(this.mesh.geometry.getAttribute('position').array.subarray(9 * first, 9 * end));
    return {centre: box.getCenter(new Vector3()), radius: box.getSize(new Vector3()).length() / 2};
  }

  wires(on) {
    this.material.uniforms.wires.value = on;
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

  // The value at a place of a triangle, as a share of the largest.
  valueAt(triangle, place) {
    const [a, b, c] = [0, 1, 2].map((which) => this.corner(triangle, which));
    const heat = this.mesh.geometry.getAttribute('heat');
    const opposite = [[b, c], [c, a], [a, b]].map(([p, q]) => p.clone().sub(place).cross(q.clone().sub(place)).length());
    const sum = opposite[0] + opposite[1] + opposite[2];
    return [0, 1, 2].reduce((all, k) => all + heat.getX(3 * triangle + k) * (sum > 0 ? opposite[k] / sum : 1 / 3), 0);
  }

  // What a triangle is, in words.
  describe(triangle) {
    const found = this.looks.filter((look) => look.bit !== null && this.data.marks[triangle] >> look.bit & 1).map((look) => look.words);
    const kind = this.facts.kinds.length > 0 ? [plain(this.facts.kinds[this.data.kinds[triangle]].words)] : [];
    return [...kind, ...(found.length > 0 ? found : ['nothing wrong with it'])].join('; ');
  }
}
