// SPDX-License-Identifier: BSD-3-Clause
/**
 * Puts new contents into a container. Focus stays on the element with the same `data-key`, and what was folded open stays open.
 */
export function refresh(container: Element, ...contents: Node[]): void {
  const active = document.activeElement;
  const focused = active && container.contains(active) ? active.closest('[data-key]')?.getAttribute('data-key') : null;
  const open = [...container.querySelectorAll('details[data-key]')].map((each) => [each.getAttribute('data-key'), (each as HTMLDetailsElement).open] as const);
  container.replaceChildren(...contents);
  for (const [key, isOpen] of open) {
    const each = container.querySelector(`details[data-key="${CSS.escape(key!)}"]`);
    if (each) (each as HTMLDetailsElement).open = isOpen;
  }
  if (focused) container.querySelector<HTMLElement>(`[data-key="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
}
