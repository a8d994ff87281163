// SPDX-License-Identifier: MIT
// Keeps the files of the page, so that it works without a network. A page with other files has another name of the store.

const STORE = 'meshrepair-@HASH@';
const FILES = @FILES@;

addEventListener('install', (event) => {
  event.waitUntil(caches.open(STORE).then((store) => store.addAll(FILES)).then(() => skipWaiting()));
});

addEventListener('activate', (event) => {
  event.waitUntil(caches.keys()
      .then((names) => Promise.all(names.filter((name) => name.startsWith('meshrepair-') && name !== STORE).map((name) => caches.delete(name))))
      .then(() => clients.claim()));
});

addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET' || new URL(event.request.url).origin !== location.origin) return;
  event.respondWith(caches.open(STORE).then(async (store) => await store.match(event.request, {ignoreSearch: true}) ?? fetch(event.request)));
});
