/** Small makers of elements. Text goes in by `textContent` only: names and notes may look like markup. */

type Child = Node | string | null;

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: { class?: string; id?: string; text?: string; [attribute: string]: string | undefined } = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined) continue;
    if (name === 'text') element.textContent = value;
    else element.setAttribute(name, value);
  }
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

export function button(className: string, onClick: () => void): HTMLButtonElement {
  const element = el('button', { class: className, type: 'button' });
  element.addEventListener('click', onClick);
  return element;
}

/** Takes all children away and puts these in their place. */
export function refill(element: Element, ...children: (Node | string)[]): void {
  element.replaceChildren(...children);
}
