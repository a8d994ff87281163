// SPDX-License-Identifier: MIT
// What the graphics card does for each corner and each pixel.
import {BufferAttribute, BufferGeometry, Points, ShaderMaterial} from 'three';

// Each corner is a vertex of its own, so its number says which corner of the triangle it is.
export const VERTEX = `
attribute vec3 tint; attribute float heat; attribute vec2 spot;
varying vec3 place; varying vec3 seen; varying vec3 colour; varying vec3 corner; varying float warmth;
varying vec2 on_picture;
void main() {
  place = position;
  colour = tint;
  warmth = heat;
  on_picture = spot;
  int which = gl_VertexID % 3;
  corner = vec3(float(which == 0), float(which == 1), float(which == 2));
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  seen = view.xyz;
  gl_Position = projectionMatrix * view;
}`;
// Where a solid is cut open one sees the back of its far side, just there where the cut goes through what is solid: drawn as the face
// of the cut, it is hatched along the plane.
export const FRAGMENT = `
uniform vec4 cut; uniform bool cutting; uniform bool wires; uniform bool kinds; uniform bool heated; uniform bool solid;
uniform vec3 behind; uniform vec3 heat_colours[5]; uniform float top; uniform sampler2D picture; uniform bool pictured;
varying vec3 place; varying vec3 seen; varying vec3 colour; varying vec3 corner; varying float warmth;
varying vec2 on_picture;
vec3 face_of_cut() {
  vec3 way = place - cameraPosition;
  vec3 at = cameraPosition + way * (cut.w - dot(cameraPosition, cut.xyz)) / dot(way, cut.xyz);
  float along = 26.0 * (at.x + at.y + at.z);
  float width = 0.7 * fwidth(along);
  float line = smoothstep(-width, width, abs(fract(along) - 0.5) - 0.38);
  return mix(vec3(0.62, 0.66, 0.73), vec3(0.47, 0.51, 0.59), line);
}
void main() {
  if (cutting && dot(place, cut.xyz) > cut.w) discard;
  if (cutting && solid && !gl_FrontFacing) {
    gl_FragColor = vec4(face_of_cut(), 1.0);
    return;
  }
  vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
  float light = 0.42 + 0.5 * max(dot(normal, normalize(vec3(0.25, 0.5, 0.85))), 0.0) + 0.08 * normal.y;
  vec3 own = pictured ? colour * texture2D(picture, on_picture).rgb : colour;
  if (heated) {
    float step_of = min(warmth / top, 1.0) * 3.9999;
    int low = int(step_of);
    own = mix(heat_colours[low], heat_colours[low + 1], fract(step_of));
    light = 0.55 + 0.5 * light;  // colours are to be compared with those of the scale
  }
  vec3 base = (gl_FrontFacing ? own : kinds ? 0.7 * own : behind) * light;
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

export function dots(places, tints, options) {
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
