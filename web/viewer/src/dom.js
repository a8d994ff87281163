// SPDX-License-Identifier: MIT
// Makes an element. Text is always text, never markup.
export function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else if (value === true) element.setAttribute(key, '');
    else if (value !== false && value !== undefined) element.setAttribute(key, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

export function button(text, attributes) {
  return make('button', {type: 'button', ...attributes}, text);
}

export function swatch(colour) {
  const box = make('span', {class: 'swatch', 'aria-hidden': 'true'});
  box.style.background = `rgb(${colour.join(',')})`;
  return box;
}

export function table(heads, rows, attributes = {}) {
  const head = make('tr', {}, ...heads.map((text, i) => make('th', {scope: 'col', class: i > 0 ? 'number' : ''}, text)));
  const body = rows.map(([first, ...cells]) => make('tr', {}, make('th', {scope: 'row'}, first),
      ...cells.map((cell) => make('td', {class: 'number'}, cell))));
  return make('table', attributes, make('thead', {}, head), make('tbody', {}, ...body));
}
