// SPDX-License-Identifier: MIT
// meshrepair: turns any triangle mesh into the boundary of a solid.

/** Bytes of a file: STL, OBJ, OFF, PLY, glTF or 3MF, optionally compressed (.gz, .zst, .zip). */
export type FileBytes = Uint8Array | ArrayBuffer | ArrayBufferView | Blob;

/** What corners carry: of corner k of face f the number of its value is `corners[3 * f + k]`, 4294967295 for none. */
export interface Attribute {
  /** "texture", "normal", "tangent", "colour", "skin_weights", with "_1" and so on behind it for further ones, or any other. */
  name: string;
  components: number;
  values: Float64Array;
  corners: Uint32Array;
}

export interface Mesh {
  /** x, y, z each. */
  vertices: Float64Array | Float32Array;
  /** Three numbers of vertices each, from 0 on, counterclockwise seen from outside. */
  faces: Uint32Array;
  attributes?: Attribute[];
}

export interface Progress {
  /** "read", "tree", "cells" and so on, as the report names them. */
  stage: string;
  /** Of this stage, 0 to 1. */
  share: number;
}

/** What all calls take. Any other name is a long option of the program that does the same, in camelCase, or with "_". */
export interface Options {
  /** Told some twenty times a second. */
  progress?: (progress: Progress) => void;
  /** Aborted, it ends the worker, and the promise is rejected with its reason. */
  signal?: AbortSignal;
  [option: string]: unknown;
}

export interface FileOptions extends Options {
  /** What the bytes are: a format, or the name of the file. Not needed for a File, or where the bytes tell. */
  from?: string;
  /** Files that stand beside it, by their names: materials, pictures, buffers. */
  files?: Record<string, FileBytes>;
}

export type Format = 'stl' | 'obj' | 'off' | 'ply' | 'glb' | 'gltf' | '3mf';

/** Options of the program meshrepair. The most common ones are named here. */
export interface RepairOptions extends FileOptions {
  /** What is to be written: a format, one with ".gz" or ".zst" behind it, or the name of a file. That of the input by default, or STL. */
  to?: Format | (string & {});
  for?: 'print' | 'simulation' | 'render' | 'boolean';
  inside?: 'auto' | 'winding' | 'solidity' | 'parity';
  cavities?: 'keep' | 'fill';
  sew?: 'auto' | 'none' | number | string;
  /** Conditions of the result: "parts=same, volume=1%". If one is not met, `certified` is false. */
  require?: string;
  /** Of the beams of a 3MF lattice. */
  beamSides?: number;
  joinGaps?: 'auto' | 'none' | number | string;
  seal?: 'auto' | 'double-walls' | 'none' | number | string;
  thicken?: 'auto' | 'none' | number | string;
  holes?: 'patch' | 'curved' | 'flat' | 'extend' | 'none';
  keep?: 'all' | 'outer' | 'largest' | number;
  simplify?: number;
  triangles?: number | string;
  maxError?: number | string;
  /** Outward, or inward if it is negative. */
  offset?: number | string;
  /** Thickness of the walls that cavities leave. */
  hollow?: number | string;
  /** Diameter of drain holes; `drainAt` is "X,Y,Z". */
  drain?: number | string;
  drainAt?: string;
  /** What is thinner in the result is told. */
  thickness?: number | string;
  always?: boolean;
  precision?: 'float32' | 'float64';
  /** Make the page that --html writes, too. Of files. */
  html?: boolean;
}

export interface Repaired extends Mesh {
  /** Whether every guarantee holds of it; `error` says which do not. */
  certified: boolean;
  error: string;
  /** The report of the program. */
  report: any;
  warnings: string[];
  /** Of each face the face of the input that it lies in. Of meshes alone; those of several count through. */
  sources?: Uint32Array;
  /** Files that belong to the one that was written, by their names. */
  files: Record<string, Uint8Array>;
  html?: Uint8Array;
  /** The file. In another format than it was asked for it is made of the mesh, and not certified again. */
  bytes(format?: string): Promise<Uint8Array>;
}

export interface Checked {
  /** Whether it is the boundary of a solid. */
  valid: boolean;
  error: string;
  report: any;
  warnings: string[];
  /** Of a mesh: of each face a bit for each of `defects` that it has. */
  marks?: Uint16Array;
  defects?: string[];
  /** Of a file, where it is asked for. */
  html?: Uint8Array;
}

export interface Written {
  bytes: Uint8Array;
  files: Record<string, Uint8Array>;
  report: any;
  warnings: string[];
}

/** Turns a mesh, or the points of a scan, into the boundary of a solid: the bytes that the program writes. */
export function repair(input: Mesh | FileBytes, options?: RepairOptions): Promise<Repaired>;
/** What is wrong with it. */
export function check(
    input: Mesh | FileBytes, options?: FileOptions & {html?: boolean, thickness?: number | string}): Promise<Checked>;
/** Combines solids; options are those of bspbool. */
export function boolean(
    inputs: Array<Mesh | FileBytes>, op: 'union' | 'intersection' | 'difference' | 'xor', options?: RepairOptions): Promise<Repaired>;
/** The mesh as the file has it. */
export function read(input: FileBytes, options?: FileOptions): Promise<Mesh & {report: any; warnings: string[]}>;
/** A file of the mesh. */
export function write(mesh: Mesh, options: Options & {to: Format | (string & {})}): Promise<Written>;

/** The names of what is written. */
export const formats: Format[];

export class MeshRepairError extends Error {
  code: 'usage' | 'input' | 'limit' | 'no_solid' | 'output' | 'internal' | 'interrupted';
  /** That of the program. */
  exitCode: number;
  report: any;
  warnings: string[];
}
