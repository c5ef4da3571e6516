// SPDX-License-Identifier: BSD-3-Clause
type Child = Node | string | number | null | undefined | false | Child[];
type Props = Record<string, string | number | boolean | null | undefined | ((event: Event) => void)>;

function fill(element: Element, props: Props, children: Child[]): void {
  for (const [key, value] of Object.entries(props)) {
    if (typeof value === 'function') element.addEventListener(key.replace(/^on/, ''), value);
    else if (value === true) element.setAttribute(key, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(key, String(value));
  }
  for (const child of children.flat(Infinity as 1)) {
    if (child === null || child === undefined || child === false) continue;
    element.append(child instanceof Node ? child : String(child));
  }
}

/** An element with attributes, listeners (`onclick`) and children; text never becomes markup. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, props, children);
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  fill(element, props, children);
  return element;
}

/** A colour's sample; says nothing that the text beside it does not. */
export function swatch(color: string): HTMLElement {
  const element = h('i', { class: 'swatch', 'aria-hidden': 'true' });
  element.style.setProperty('--color', color);
  return element;
}

/** Hands the reader a file. */
export function download(name: string, content: Blob | string, type = 'application/json'): void {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  const link = h('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

let live: HTMLElement | null = null;

/** Tells those who listen rather than look. */
export function announce(text: string): void {
  live ??= document.body.appendChild(h('div', { class: 'unseen', 'aria-live': 'polite', role: 'status' }));
  live.textContent = text;
}
