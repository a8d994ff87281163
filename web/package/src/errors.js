// SPDX-License-Identifier: MIT
// What a call fails with, by the exit codes of the programs.

const NAMES = {2: 'usage', 3: 'input', 4: 'limit', 5: 'no_solid', 6: 'output', 70: 'internal', 130: 'interrupted'};

export class MeshRepairError extends Error {
  // `outcome`: {code, error, report, warnings}.
  constructor(outcome) {
    super(outcome.error);
    this.name = 'MeshRepairError';
    this.exitCode = outcome.code;
    this.code = NAMES[outcome.code] ?? 'internal';
    this.report = outcome.report ?? null;
    this.warnings = outcome.warnings ?? [];
  }
}

export function usage(message) {
  return new MeshRepairError({code: 2, error: message});
}
