// SPDX-License-Identifier: MIT
// Paths of Windows as the programs know paths, and back: "C:\parts\a.stl" is "/C:/parts/a.stl" in there. Elsewhere they are the same.
const isWindows = process.platform === 'win32';

export function fromSystem(text) {
  if (!isWindows) return text;
  const slashes = text.replaceAll('\\', '/');
  return /^[A-Za-z]:\//.test(slashes) ? `/${slashes}` : slashes;
}

export function toSystem(path) {
  return isWindows && /^\/[A-Za-z]:(\/|$)/.test(path) ? path.slice(1) : path;
}
