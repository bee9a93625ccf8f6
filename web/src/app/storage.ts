/** Small texts that outlive a reload or the page. Browsers that forbid it forget them. */

function guarded<T>(use: () => T, otherwise: T): T {
  try {
    return use();
  } catch {
    return otherwise;
  }
}

export const kept = {
  /** For as long as the tab. */
  ofTab: {
    get: (key: string): string | null => guarded(() => sessionStorage.getItem(`myotact.${key}`), null),
    set: (key: string, text: string): void => guarded(() => sessionStorage.setItem(`myotact.${key}`, text), undefined),
  },
  ofBrowser: {
    get: (key: string): string | null => guarded(() => localStorage.getItem(`myotact.${key}`), null),
    set: (key: string, text: string): void => guarded(() => localStorage.setItem(`myotact.${key}`, text), undefined),
  },
};
