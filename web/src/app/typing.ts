const FIELDS = 'input:not([type=range], [type=button], [type=checkbox], [type=radio]), textarea, select, dialog';

/** Whether a letter that is pressed there is typed, and no key of the page. Sliders take no letters. */
export function isTyping(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && (target.isContentEditable || target.closest(FIELDS) !== null);
}
