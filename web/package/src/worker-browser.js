// SPDX-License-Identifier: MIT
// The worker of browsers.
import {serve} from './serve.js';

serve({
  post: (message, buffers) => self.postMessage(message, buffers),
  listen: (heard) => self.addEventListener('message', ({data}) => heard(data)),
});
