// SPDX-License-Identifier: MIT
// How meshes look in their files: colours, and pictures that lie on them. Packed as apps/page/pack_looks.h says.
import {BufferAttribute, BufferGeometry, ClampToEdgeWrapping, LinearFilter, LinearMipmapLinearFilter, Mesh, MirroredRepeatWrapping,
  NearestFilter, RepeatWrapping, ShaderMaterial, Texture} from 'three';

import {bytesOf, numbersOf} from './decode.js';

const STEPS = 8192;  // of the side of a picture
const MOST_SIDE = 4096;  // pixels
const WRAPS = {repeat: RepeatWrapping, mirror: MirroredRepeatWrapping, clamp: ClampToEdgeWrapping};

// Of each triangle its material (-1: none), and whether its picture is to be drawn; of each of its corners the place in the picture
// and the colour.
export async function decodeLooks(text, looks, shown) {
  const numbers = await numbersOf(text);
  const material = new Int32Array(shown), pictured = new Uint8Array(shown);
  for (let t = 0; t < shown; ++t) {
    const number = numbers.next();
    material[t] = (number >> 1) - 1;
    pictured[t] = number & 1;
  }
  const places = looks.has_places ? decodePlaces(numbers, pictured) : null;
  const colours = looks.has_colours ? decodeColours(numbers, shown) : null;
  return {material, pictured, places, colours};
}

function decodePlaces(numbers, pictured) {
  const at = new Uint32Array(3 * pictured.length);
  let count = 0;
  for (let t = 0; t < pictured.length; ++t) {
    for (let k = 0; pictured[t] && k < 3; ++k) {
      const back = numbers.next();
      at[3 * t + k] = back === 0 ? count++ : count - back;
    }
  }
  const values = new Float32Array(2 * count);
  for (let axis = 0; axis < 2; ++axis) {
    let value = 0;
    for (let i = 0; i < count; ++i) values[2 * i + axis] = (value += numbers.nextSigned()) / STEPS;
  }
  const places = new Float32Array(2 * at.length);
  for (let i = 0; i < at.length; ++i) {
    if (pictured[Math.floor(i / 3)]) places.set(values.subarray(2 * at[i], 2 * at[i] + 2), 2 * i);
  }
  return places;
}

function decodeColours(numbers, shown) {
  const at = new Int32Array(3 * shown);
  let count = 0;
  for (let i = 0; i < at.length; ++i) {
    const number = numbers.next();
    at[i] = number === 0 ? -1 : number === 1 ? count++ : count - number + 1;
  }
  const values = Array.from({length: 3}, () => Uint8Array.from({length: count}, () => numbers.next()));
  const colours = new Int16Array(9 * shown).fill(-1);
  for (let i = 0; i < at.length; ++i) {
    for (let k = 0; at[i] >= 0 && k < 3; ++k) colours[3 * i + k] = values[k][at[i]];
  }
  return colours;
}

// A canvas with a picture, upside down as textures are; white shows through where it is clear.
function canvasOf(image, width, height) {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext('2d');
  context.fillStyle = '#fff';
  context.fillRect(0, 0, width, height);
  context.setTransform(1, 0, 0, -1, 0, height);
  context.imageSmoothingQuality = 'high';
  context.drawImage(image, 0, 0, width, height);
  return canvas;
}

// A picture, the lower row first, and its colour from afar; null where the browser cannot read it. It is not loaded: no policy has to
// allow that.
export async function decodePicture(base64) {
  try {
    const whole = await createImageBitmap(new Blob([bytesOf(base64)]));
    const scale = Math.min(1, MOST_SIDE / Math.max(whole.width, whole.height));
    const canvas = canvasOf(whole, Math.max(1, Math.floor(whole.width * scale)), Math.max(1, Math.floor(whole.height * scale)));
    const mean = canvasOf(canvas, 1, 1).getContext('2d').getImageData(0, 0, 1, 1).data.subarray(0, 3);
    whole.close();
    return {canvas, mean: [...mean]};
  } catch {
    return null;
  }
}

function textureOf(canvas, {wrap, nearest}) {
  const texture = new Texture(canvas);
  [texture.wrapS, texture.wrapT] = wrap.map((word) => WRAPS[word]);
  texture.flipY = false;  // it is turned already
  texture.magFilter = nearest ? NearestFilter : LinearFilter;
  texture.minFilter = nearest ? NearestFilter : LinearMipmapLinearFilter;
  texture.generateMipmaps = !nearest;
  texture.needsUpdate = true;
  return texture;
}

export class Looks {
  // `facts` are what the page says of the looks of a mesh, `data` is what decodeLooks() gave, `plain` the colour of what has none.
  constructor(facts, data, pictures, plain) {
    this.materials = facts.materials;
    this.data = data;
    this.pictures = pictures;
    this.plain = plain;
  }

  pictureOf(t) {
    if (!this.data.pictured[t]) return null;
    return this.pictures[this.materials[this.data.material[t]].picture];
  }

  // Of a corner, without the picture: colours of a material and of a corner are multiplied.
  colourOf(t, corner) {
    const {material, colours} = this.data;
    const own = colours && colours[9 * t + 3 * corner] >= 0 ? colours.subarray(9 * t + 3 * corner, 9 * t + 3 * corner + 3) : null;
    const base = material[t] >= 0 ? this.materials[material[t]].colour : own ? [255, 255, 255] : this.plain;
    return own ? base.map((value, k) => value * own[k] / 255) : base;
  }

  // The same from afar.
  farColourOf(t, corner) {
    const mean = this.pictureOf(t)?.mean ?? [255, 255, 255];
    return this.colourOf(t, corner).map((value, k) => value * mean[k] / 255);
  }

  // Draws the triangles of a mesh whose corners have these positions. Those with one picture follow each other.
  mesh(positions, base) {
    const order = Array.from(this.data.material, (_, t) => t);
    const keyOf = (t) => this.pictureOf(t) ? this.data.material[t] : -1;
    order.sort((a, b) => keyOf(a) - keyOf(b) || a - b);
    const geometry = new BufferGeometry();
    const [position, tint, spot] = [new Float32Array(9 * order.length), new Uint8Array(9 * order.length), new Float32Array(6 * order.length)];
    const materials = [];
    let last;
    order.forEach((t, i) => {
      position.set(positions.subarray(9 * t, 9 * t + 9), 9 * i);
      for (let k = 0; k < 3; ++k) tint.set(this.colourOf(t, k), 9 * i + 3 * k);
      if (this.data.places) spot.set(this.data.places.subarray(6 * t, 6 * t + 6), 6 * i);
      if (keyOf(t) !== last) {
        last = keyOf(t);
        geometry.addGroup(3 * i, 0, materials.length);
        materials.push(this.materialFor(last, base));
      }
      geometry.groups.at(-1).count += 3;
    });
    geometry.setAttribute('position', new BufferAttribute(position, 3));
    geometry.setAttribute('tint', new BufferAttribute(tint, 3, true));
    geometry.setAttribute('spot', new BufferAttribute(spot, 2));
    return new Mesh(geometry, materials);
  }

  // As the base, with a picture.
  materialFor(key, base) {
    const texture = key < 0 ? null : textureOf(this.pictures[this.materials[key].picture].canvas, this.materials[key]);
    return new ShaderMaterial({uniforms: {...base.uniforms, picture: {value: texture}, pictured: {value: texture !== null}},
      vertexShader: base.vertexShader, fragmentShader: base.fragmentShader, side: base.side, polygonOffset: true,
      polygonOffsetFactor: base.polygonOffsetFactor, polygonOffsetUnits: base.polygonOffsetUnits});
  }
}
