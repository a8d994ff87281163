// SPDX-License-Identifier: MIT
// How long pictures take.

const POLL = 4;  // milliseconds

// Whether there is no graphics card, so that the processor draws.
export function isSlowCard() {
  const context = document.createElement('canvas').getContext('webgl2');
  if (!context) return false;
  const names = context.getExtension('WEBGL_debug_renderer_info');
  const name = String(context.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|softpipe|basic render/i.test(name);
}

export class FrameClock {
  constructor(context) {
    this.context = context;
    this.times = [];
  }

  // The median of the last pictures that were measured, in milliseconds; the first may have been empty, and any may have had to wait.
  get usual() {
    const sorted = [...this.times].sort((a, b) => a - b);
    return sorted[Math.floor(sorted.length / 2)] ?? 0;
  }

  // Of what was drawn last, unless one is being measured.
  measure() {
    if (this.fence) return;
    const {context} = this;
    this.fence = context.fenceSync(context.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!this.fence) return;
    context.flush();
    const begin = performance.now();
    const look = () => {
      if (context.getSyncParameter(this.fence, context.SYNC_STATUS) !== context.SIGNALED && !context.isContextLost()) return setTimeout(look, POLL);
      context.deleteSync(this.fence);
      this.fence = null;
      this.times = [...this.times.slice(-2), performance.now() - begin];
      return undefined;
    };
    setTimeout(look, POLL);
  }
}
