// SPDX-License-Identifier: MIT
// Hands a mesh to the program that serves this page, and shows what it says.
'use strict';
(() => {
  const BETWEEN_QUESTIONS = 200; // milliseconds
  const at = (id) => document.getElementById(id);
  // It is in the part of the address that is never sent.
  const token = location.hash.slice(1);
  let job = null;
  let sending = null; // the upload that is on its way
  let turn = 0; // of the mesh that is shown: what belongs to another is dropped

  async function ask(method, path, options) {
    const headers = {'X-Meshrepair-Token': token};
    if (options) headers['X-Meshrepair-Options'] = JSON.stringify(options);
    const answer = await fetch(path, {method, headers});
    const said = await answer.json().catch(() => ({}));
    if (!answer.ok) throw new Error(said.error ?? `the server says ${answer.status}`);
    return said;
  }

  // fetch() does not tell how much of a body is sent.
  function send(file) {
    return new Promise((done, failed) => {
      sending = new XMLHttpRequest();
      sending.open('POST', `/jobs?name=${encodeURIComponent(file.name)}`);
      sending.setRequestHeader('X-Meshrepair-Token', token);
      sending.responseType = 'json';
      sending.upload.onprogress = (event) => busy('send', 100 * event.loaded / event.total);
      sending.onload = () => sending.status === 201 ? done(sending.response.job) :
        failed(new Error(sending.response?.error ?? `the server says ${sending.status}`));
      sending.onerror = () => failed(new Error('the server cannot be reached'));
      sending.onabort = () => failed(new Error('cancelled'));
      sending.send(file);
    });
  }

  function busy(stage, percent) {
    at('busy').hidden = stage === null;
    at('repair').disabled = stage !== null || job === null;
    if (stage === null) return;
    at('stage').textContent = `${stage} ${Math.floor(percent)} %`;
    at('share').value = percent;
  }

  function say(text, kind) {
    at('verdict').textContent = text;
    at('verdict').className = kind ?? '';
  }

  // Another frame for each page: browsers may leave one blank that was hidden when its address changed.
  function show(path) {
    const frame = at('page').cloneNode();
    frame.hidden = path === null;
    if (path === null) frame.removeAttribute('src');
    else frame.src = path;
    at('page').replaceWith(frame);
  }

  function verdict(state) {
    const error = state.report?.error;
    if (state.task === 'check') {
      if (state.exit_code === 0) return say('It is a valid solid.', 'good');
      return say(state.exit_code === 1 ? 'It is not a valid solid.' : error ?? `The check ended with code ${state.exit_code}.`, 'bad');
    }
    if (state.exit_code === 0) return say('Repaired and certified.', 'good');
    say(error ?? `The repair ended with code ${state.exit_code}.`, 'bad');
  }

  async function follow(mine) {
    for (;;) {
      const state = await ask('GET', `/jobs/${job}`);
      if (mine !== turn) return;
      if (state.phase === 'ended') {
        busy(null);
        verdict(state);
        if (state.has_page) show(`/jobs/${job}/${state.task}.html`);
        at('result').hidden = !state.has_result;
        if (state.has_result) at('result').href = `/jobs/${job}/result`;
        document.body.dataset.ended = state.task;
        return;
      }
      busy(state.phase === 'waiting' ? 'waits for another mesh,' : state.stage || state.task, state.percent);
      await new Promise((done) => setTimeout(done, BETWEEN_QUESTIONS));
    }
  }

  async function open(file) {
    const mine = ++turn;
    sending?.abort();
    if (job !== null) ask('DELETE', `/jobs/${job}`).catch(() => {});
    job = null;
    delete document.body.dataset.ended;
    at('work').hidden = false;
    document.body.dataset.open = '';
    at('name').textContent = file.name;
    at('result').hidden = true;
    show(null);
    say('');
    busy('send', 0);
    const ending = file.name.toLowerCase().replace(/\.(gz|zst)$/, '').split('.').pop();
    at('format').value = [...at('format').options].some((one) => one.value === ending) ? ending : 'stl';
    await guarded(mine, async () => {
      const made = await send(file);
      if (mine !== turn) return;
      job = made;
      await follow(mine);
    });
  }

  async function repair() {
    const mine = turn;
    const options = {format: at('format').value};
    for (const name of ['for', 'inside', 'seal', 'thicken']) {
      const value = at(name).value.trim();
      if (value !== '') options[name] = value;
    }
    delete document.body.dataset.ended;
    at('result').hidden = true;
    say('');
    busy('repair', 0);
    await guarded(mine, async () => {
      await ask('POST', `/jobs/${job}/repair`, options);
      await follow(mine);
    });
  }

  async function guarded(mine, work) {
    try {
      await work();
    } catch (error) {
      if (mine !== turn) return;
      busy(null);
      say(error.message, 'bad');
    }
  }

  function cancel() {
    if (job === null) sending?.abort();
    else ask('POST', `/jobs/${job}/cancel`).catch((error) => say(error.message, 'bad'));
  }

  at('choose').onclick = () => at('file').click();
  at('file').onchange = () => {
    if (at('file').files.length > 0) open(at('file').files[0]);
    at('file').value = '';
  };
  at('options').onsubmit = (event) => {
    event.preventDefault();
    if (job !== null) repair();
  };
  at('cancel').onclick = cancel;
  addEventListener('dragover', (event) => {
    event.preventDefault();
    at('drop').classList.add('over');
  });
  addEventListener('dragleave', () => at('drop').classList.remove('over'));
  addEventListener('drop', (event) => {
    event.preventDefault();
    at('drop').classList.remove('over');
    if (event.dataTransfer.files.length > 0) open(event.dataTransfer.files[0]);
  });
  // Nobody could end the work, or ask for the result, once the page is gone. It starts anew where a browser brings it back.
  addEventListener('pagehide', () => {
    sending?.abort();
    if (job !== null) fetch(`/jobs/${job}`, {method: 'DELETE', headers: {'X-Meshrepair-Token': token}, keepalive: true}).catch(() => {});
  });
  addEventListener('pageshow', (event) => {
    if (event.persisted) location.reload();
  });
  if (token === '') say('The address lacks its token: use the whole one that the program prints.', 'bad');
  at('work').hidden = token !== '';
  at('options').hidden = false;
})();
