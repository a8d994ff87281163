// SPDX-License-Identifier: MIT
// Paths of Windows as the programs know paths, and back: "C:\parts\a.stl" is "/C:/parts/a.stl" in there. Elsewhere they are the same.
const isWindows = process.platform === 'win32';

export function fromSystem(text) {
  if (!isWindows) return text;
  return text.replaceAll('\\', '/').replace(/(^|=)(?=[A-Za-z]:\/)/, '$1/');  // also in --report=C:\report.json
}

export function toSystem(path) {
  return isWindows && /^\/[A-Za-z]:(\/|$)/.test(path) ? path.slice(1) : path;
}
