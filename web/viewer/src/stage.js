// SPDX-License-Identifier: MIT
// The canvas: one camera, and what it sees of one mesh, of both beside each other, or of both left and right of a line.
//
// It draws only what changed. Where a picture takes long, as without a graphics card, fewer triangles and pixels are drawn for as long
// as things move, and all once they rest.
import {Line, BufferGeometry, LineBasicMaterial, PerspectiveCamera, Raycaster, Vector2, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {FrameClock, isSlowCard} from './frame_clock.js';

// Milliseconds.
const FLIGHT = 450;
const REST = 160;  // without a move, before all is drawn; longer where that takes long
const LONGEST_REST = 1000;
const TOO_LONG = 40;
const PIXELS_MOVING = 400000;  // at most, where a picture takes long
const PIXELS_SMOOTHED = 3e6;
const TRIANGLES_SMOOTHED = 400000;

export class Stage {
  constructor(canvas, surfaces, cut, up) {
    this.canvas = canvas;
    this.surfaces = surfaces;
    this.cut = cut;
    this.mode = surfaces[0].facts.role;
    this.split = 0.5;
    this.isSlow = isSlowCard();
    this.renderer = new WebGLRenderer({canvas, antialias: !this.isSlow, alpha: true, preserveDrawingBuffer: true});
    this.clock = new FrameClock(this.renderer.getContext());
    this.moving = false;
    this.renderer.autoClear = false;
    this.renderer.localClippingEnabled = true;
    this.renderer.setClearColor(0, 0);
    this.camera = new PerspectiveCamera(30, 1, 0.002, 60);
    this.camera.up.set(0, up === 'y' ? 1 : 0, up === 'y' ? 0 : 1);
    this.radius = Math.max(Math.hypot(...surfaces[0].grid.middle.map((m) => 2 * m / surfaces[0].grid.most)), 1e-6);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.minDistance = 0.003;
    this.controls.maxDistance = 30;
    this.controls.addEventListener('change', () => this.move());
    this.ruler = new Line(new BufferGeometry(), new LineBasicMaterial({color: 0x1d6ef0, depthTest: false}));
    this.ruler.renderOrder = 4;
    this.ruler.frustumCulled = false;
    this.ruler.visible = false;
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    this.reset();
  }

  // The boxes of the canvas that show a mesh each, as shares of its width.
  panes() {
    const [first, last] = [this.surfaces[0], this.surfaces.at(-1)];
    if (this.mode === 'both') return [{surface: first, from: 0, to: 0.5, own: true}, {surface: last, from: 0.5, to: 1, own: true}];
    if (this.mode === 'slider') return [{surface: first, from: 0, to: this.split}, {surface: last, from: this.split, to: 1}];
    return [{surface: this.mode === last.facts.role ? last : first, from: 0, to: 1}];
  }

  aspect() {
    const {clientWidth, clientHeight} = this.canvas;
    return clientWidth / Math.max(clientHeight, 1) * (this.mode === 'both' ? 0.5 : 1);
  }

  resize() {
    this.size = [0, 0];
    this.draw();
  }

  // All of it, as it is now.
  draw() {
    this.moving = false;
    clearTimeout(this.resting);
    this.ask();
  }

  // The same for now, and all of it once nothing moves any more.
  move() {
    this.moving = true;
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.draw(), Math.max(REST, Math.min(this.clock.usual, LONGEST_REST)));
    this.ask();
  }

  ask() {
    this.canvas.dataset.drawn = 'no';
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      this.render();
    });
  }

  // Without a graphics card edges are smoothed by more pixels than are shown, if there is time for that.
  pixelRatio(coarse, width, height) {
    const ratio = Math.min(devicePixelRatio, 2);
    if (coarse) return Math.min(ratio, Math.sqrt(PIXELS_MOVING / (width * height)));
    const triangles = this.panes().reduce((sum, {surface}) => sum + surface.facts.shown, 0);
    const smoothed = this.isSlow && triangles <= TRIANGLES_SMOOTHED;
    return smoothed ? Math.max(ratio, Math.min(2, Math.sqrt(PIXELS_SMOOTHED / (width * height)))) : ratio;
  }

  // The buffer that is drawn into gets this size, unless it has it.
  fit(ratio) {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (this.size[0] === width && this.size[1] === height && this.size[2] === ratio) return;
    this.size = [width, height, ratio];
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
  }

  render() {
    const coarse = this.moving && this.clock.usual > TOO_LONG;
    const {clientWidth: across, clientHeight: down} = this.canvas.parentElement;
    for (const surface of this.surfaces) surface.setCoarse(coarse);
    this.fit(this.pixelRatio(coarse, Math.max(across, 1), Math.max(down, 1)));
    this.paintPanes();
    this.canvas.dataset.frames = Number(this.canvas.dataset.frames ?? 0) + 1;
    this.canvas.dataset.drawn = this.moving ? 'no' : 'yes';
    if (!coarse) this.clock.measure();
  }

  // Before the page is printed: all of it.
  renderNow() {
    this.moving = false;
    this.render();
  }

  paintPanes() {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    this.camera.aspect = this.aspect();
    this.camera.updateProjectionMatrix();
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    for (const {surface, from, to, own} of this.panes()) {
      const [left, right] = [Math.round(from * width), Math.round(to * width)];
      if (right <= left) continue;
      if (own) this.renderer.setViewport(left, 0, right - left, height);
      else this.renderer.setViewport(0, 0, width, height);
      this.renderer.setScissor(left, 0, right - left, height);
      surface.scene.add(this.ruler);
      this.renderer.render(surface.scene, this.camera);
    }
  }

  // So far away that a ball of this size is seen whole.
  distanceFor(radius) {
    const half = this.camera.fov / 2 * Math.PI / 180;
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.aspect()));
    return radius / Math.sin(narrow);
  }

  // So far away that the whole box is seen from this direction.
  distanceForAll(direction) {
    const half = Math.tan(this.camera.fov / 2 * Math.PI / 180) * 0.94;
    const right = new Vector3().crossVectors(this.camera.up, direction).normalize();
    const upward = new Vector3().crossVectors(direction, right);
    const sides = this.surfaces[0].grid.middle.map((m) => 2 * m / this.surfaces[0].grid.most);
    let distance = 0.01;
    for (let k = 0; k < 8; ++k) {
      const corner = new Vector3(...sides.map((side, axis) => k >> axis & 1 ? side : -side));
      const beside = Math.max(Math.abs(corner.dot(right)) / this.aspect(), Math.abs(corner.dot(upward)));
      distance = Math.max(distance, beside / half + corner.dot(direction));
    }
    return distance;
  }

  reset() {
    const around = Math.PI / 4, above = 0.615;
    const flat = [Math.sin(around) * Math.cos(above), -Math.cos(around) * Math.cos(above), Math.sin(above)];
    const direction = this.camera.up.y === 1 ? new Vector3(flat[0], flat[2], -flat[1]) : new Vector3(...flat);
    this.fly(new Vector3(), direction, this.distanceForAll(direction), true);
  }

  // Looks at a place from where it is seen: from where the surface faces, else from behind, else from the side of it that is
  // farther from the middle.
  look(place, radius, surface, normal) {
    const target = new Vector3(...place);
    const now = this.camera.position.clone().sub(this.controls.target).normalize();
    const distance = this.distanceFor(radius);
    const ways = [normal, normal.clone().negate(), target.clone().normalize()].filter((way) => way.lengthSq() > 0.1)
        .map((way) => this.tilted(way, now));
    const seen = ways.find((way) => this.sees(surface, target, way, distance));
    this.fly(target, seen ?? ways[0] ?? now, distance, false);
  }

  // From the same side as now.
  lookFromHere(target, radius) {
    this.fly(target, this.camera.position.clone().sub(this.controls.target).normalize(), this.distanceFor(radius), false);
  }

  // A little towards where the camera is, and never along the axis that is up: left and right would be anywhere.
  tilted(way, now) {
    const direction = way.clone().addScaledVector(now, 0.35).normalize();
    if (direction.lengthSq() < 0.5) direction.copy(way);
    if (Math.abs(direction.dot(this.camera.up)) > 0.98) direction.add(new Vector3(0.2, 0.15, 0.1)).normalize();
    return direction;
  }

  sees(surface, target, direction, distance) {
    const caster = new Raycaster(target.clone().addScaledVector(direction, distance), direction.clone().negate(), 0, 0.97 * distance);
    return caster.intersectObject(surface.mesh, false).length === 0;
  }

  fly(target, direction, distance, at_once) {
    const end = target.clone().addScaledVector(direction, distance);
    const from = [this.camera.position.clone(), this.controls.target.clone()];
    const still = at_once || matchMedia('(prefers-reduced-motion: reduce)').matches;
    const begin = performance.now();
    const flight = this.flight = {};
    this.canvas.dataset.flying = 'yes';
    const step = () => {
      if (flight !== this.flight) return;
      const t = still ? 1 : Math.min(1, (performance.now() - begin) / FLIGHT);
      const eased = t * t * (3 - 2 * t);
      this.camera.position.lerpVectors(from[0], end, eased);
      this.controls.target.lerpVectors(from[1], target, eased);
      this.controls.update();
      if (t < 1) {
        this.move();
        requestAnimationFrame(step);
      } else {
        this.canvas.dataset.flying = 'no';
        this.draw();
      }
    };
    step();
  }

  // Turns by angles, and comes nearer by a factor.
  turn(left, upward) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
    const tilt = Math.acos(Math.max(-1, Math.min(1, offset.clone().normalize().dot(this.camera.up))));
    offset.applyAxisAngle(side, -Math.max(-(Math.PI - 0.05 - tilt), Math.min(tilt - 0.05, upward)));
    offset.applyAxisAngle(this.camera.up, left);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.move();
  }

  near(factor) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const length = Math.max(this.controls.minDistance, Math.min(this.controls.maxDistance, offset.length() * factor));
    this.camera.position.copy(this.controls.target).add(offset.setLength(length));
    this.controls.update();
    this.move();
  }

  // What is seen at a place of the canvas, in its own pixels: the surface, the triangle and the place; or nothing.
  hit(x, y) {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    const pane = this.panes().find(({from, to}) => x >= from * width && x <= to * width);
    if (!pane) return null;
    const [left, right] = pane.own ? [pane.from * width, pane.to * width] : [0, width];
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(2 * (x - left) / (right - left) - 1, 1 - 2 * y / height), this.camera);
    const {cut: {value: {x: a, y: b, z: c, w}}, cutting} = this.cut;
    const hits = caster.intersectObject(pane.surface.mesh, false);
    const first = hits.find(({point}) => !cutting.value || point.x * a + point.y * b + point.z * c <= w);
    if (!first) return null;
    const normal = first.face.normal;
    const onFace = cutting.value && pane.surface.isSolid && normal.dot(caster.ray.direction) > 0;
    const place = onFace ? caster.ray.intersectPlane(pane.surface.plane, new Vector3()) : null;
    return {surface: pane.surface, triangle: first.faceIndex, place: place ?? first.point, onFace: place !== null};
  }

  measure(places) {
    this.ruler.visible = places.length > 0;
    this.ruler.geometry.dispose();
    this.ruler.geometry = new BufferGeometry().setFromPoints(places.length === 1 ? [places[0], places[0]] : places);
    this.draw();
  }
}
